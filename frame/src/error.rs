//! What can go wrong with a frame, and whose fault it is.

use std::io;
use std::path::{Path, PathBuf};

/// What can go wrong in this crate. Every message names the file, channel or layer it is about.
#[derive(Debug, thiserror::Error)]
pub enum FrameError {
    /// The file cannot be opened or read.
    #[error("{}: cannot be read: {source}", path.display())]
    CannotRead {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The file can be read, but is not what it should be.
    #[error("{}: {problem}", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        problem: String,
    },
    /// No file can be made at this path: its folder is missing, is a file, or may not be written to.
    #[error("{}: no file can be made there: {source}", path.display())]
    OutputPath {
        /// The output that was asked for.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The path is fine, but writing failed: disk full, an I/O error.
    #[error("{}: writing failed, nothing was kept: {source}", path.display())]
    WriteFailed {
        /// The output that was asked for.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The format cannot hold this frame.
    #[error("{}: cannot be written: {problem}", path.display())]
    Unwritable {
        /// The output that was asked for.
        path: PathBuf,
        /// What stands in the way.
        problem: String,
    },
    /// The frame lacks a channel that the operation needs.
    #[error("the frame has no channel `{channel}`")]
    MissingChannel {
        /// Its full name.
        channel: String,
    },
    /// A picture and its reference differ in size.
    #[error(
        "the pictures differ in size: {}x{}, the reference {}x{}",
        picture.0, picture.1, reference.0, reference.1
    )]
    SizesDiffer {
        /// Width and height in pixels.
        picture: (usize, usize),
        /// Width and height in pixels.
        reference: (usize, usize),
    },
    /// Not one pixel is finite in both pictures.
    #[error("nothing to compare: of {pixels} pixels none is finite in both pictures")]
    NothingToCompare {
        /// Pixels of each picture.
        pixels: usize,
    },
    /// `--layers` names a layer that there is not.
    #[error("unknown layer `{name}`; known, nearest first: {}, all", known.join(", "))]
    UnknownLayer {
        /// As it was written.
        name: String,
        /// The names of all layers, nearest first.
        known: Vec<&'static str>,
    },
    /// `--layers` asks for a statistic that the layer does not have.
    #[error("layer `{layer}` has no `{statistic}`; {}", cure(layer))]
    UnknownStatistic {
        /// The layer.
        layer: &'static str,
        /// As it was written.
        statistic: String,
    },
}

/// Whose fault an error is; the program's exit code follows from it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The input or the call is wrong: exit code 2.
    Input,
    /// The machine failed: exit code 3.
    Machine,
}

impl FrameError {
    /// Whose fault it is.
    pub fn fault(&self) -> Fault {
        match self {
            FrameError::WriteFailed { .. } => Fault::Machine,
            FrameError::CannotRead { .. }
            | FrameError::Malformed { .. }
            | FrameError::OutputPath { .. }
            | FrameError::Unwritable { .. }
            | FrameError::MissingChannel { .. }
            | FrameError::SizesDiffer { .. }
            | FrameError::NothingToCompare { .. }
            | FrameError::UnknownLayer { .. }
            | FrameError::UnknownStatistic { .. } => Fault::Input,
        }
    }

    pub(crate) fn malformed(path: &Path, problem: impl Into<String>) -> Self {
        FrameError::Malformed { path: path.to_owned(), problem: problem.into() }
    }

    pub(crate) fn unwritable(path: &Path, problem: impl Into<String>) -> Self {
        FrameError::Unwritable { path: path.to_owned(), problem: problem.into() }
    }
}

/// Which statistics can be asked for of a layer, as a hint.
fn cure(layer: &str) -> &'static str {
    match crate::Layer::from_name(layer) {
        Some(layer) if layer.has_statistics() => "it has `variance` and `halves`",
        _ => "it has its mean only",
    }
}
