//! Frames as OpenEXR files: one flat part whose channels have the frame's own names.
//!
//! The exr crate codes blocks and attributes. The order of both is ours: its header is a hash map, whose
//! order changes from run to run, and the same frame must be the same file.

mod read;
mod window;
mod write;

#[cfg(test)]
mod tests;

pub use read::read_exr;
pub use write::{write_exr, write_exr_half};

use exr::meta::attribute::AttributeValue;
use exr::meta::header::standard_names as standard;

/// Standard attributes that are text and do not steer decoding; like any other name they may be metadata.
const STANDARD_TEXTS: [&[u8]; 8] = [
    standard::OWNER,
    standard::COMMENTS,
    standard::CAPTURE_DATE,
    standard::SOFTWARE,
    standard::VIEW,
    standard::WRAP_MODES,
    standard::RENDERING_TRANSFORM,
    standard::LOOK_MOD_TRANSFORM,
];

/// Whether a text attribute of this name can stand in a header without a change of its meaning.
fn is_metadata_name(name: &[u8]) -> bool {
    let reserved = standard::ALL.contains(&name) && !STANDARD_TEXTS.contains(&name);
    !reserved && is_name(name)
}

/// Whether this can be a channel's or an attribute's name: 1–255 bytes, none of them zero.
fn is_name(name: &[u8]) -> bool {
    (1..=255).contains(&name.len()) && !name.contains(&0)
}

/// The value of a text attribute; what is not UTF-8 is taken for Latin-1.
fn text_of(value: &AttributeValue) -> Option<String> {
    match value {
        AttributeValue::Text(text) => Some(decode_text(text.as_slice())),
        _ => None,
    }
}

fn decode_text(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&b| char::from(b)).collect(),
    }
}
