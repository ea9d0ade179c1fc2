//! What can go wrong in this crate.

use limpid_frame::FrameError;

/// What can go wrong when a picture is to be denoised. Each is the input's or the caller's fault.
#[derive(Debug, thiserror::Error)]
pub enum DenoiseError {
    /// There is no method of this name.
    #[error("unknown method `{name}`; known, nearest first: {}", known.join(", "))]
    UnknownMethod {
        /// As it was written.
        name: String,
        /// The names of all methods, nearest first.
        known: Vec<&'static str>,
    },
    /// What was to be set is not of the form `key=value` with a number.
    #[error("`{text}` sets nothing: write key=value with a number, such as `{example}`")]
    Assignment {
        /// As it was written.
        text: String,
        /// One that this method takes.
        example: String,
    },
    /// The method has no parameter of this name.
    #[error("{}", unknown_parameter(method, key, known))]
    UnknownParameter {
        /// The method.
        method: &'static str,
        /// As it was written.
        key: String,
        /// The names of its parameters, nearest first.
        known: Vec<&'static str>,
    },
    /// A parameter's value is outside its range.
    #[error("{method}: `{key}={value}` is out of range: it goes from {min} to {max}{}", whole(*integer))]
    OutOfRange {
        /// The method.
        method: &'static str,
        /// The parameter.
        key: &'static str,
        /// What it was to be.
        value: f64,
        /// The least value.
        min: f64,
        /// The greatest value.
        max: f64,
        /// Whether it has to be a whole number.
        integer: bool,
    },
    /// The frame lacks a channel that every picture has.
    #[error(transparent)]
    Frame(#[from] FrameError),
    /// A buffer's length is not what the picture's size wants.
    #[error(
        "buffer `{buffer}` holds {values} values, but a {width}x{height} picture wants [h, w, 3] of them"
    )]
    BufferSize {
        /// Which buffer.
        buffer: &'static str,
        /// Its length.
        values: usize,
        /// In pixels.
        width: usize,
        /// In pixels.
        height: usize,
    },
}

fn unknown_parameter(method: &str, key: &str, known: &[&str]) -> String {
    if known.is_empty() {
        return format!("{method}: unknown parameter `{key}`; it has none");
    }
    format!("{method}: unknown parameter `{key}`; known, nearest first: {}", known.join(", "))
}

fn whole(integer: bool) -> &'static str {
    if integer { ", in whole numbers" } else { "" }
}
