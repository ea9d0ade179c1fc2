//! A first look at the data windows in a file's headers.

use std::io::{self, ErrorKind, Read, Seek, SeekFrom};

/// The flag of files of several parts, in the word after the magic number.
const SEVERAL_PARTS: i32 = 1 << 12;

/// The corners xMin, yMin, xMax, yMax of a `dataWindow` without pixels, if a header has one. The exr crate
/// swaps the corners of such a window and makes a picture of it.
///
/// Stops without a word at whatever is not an attribute, which is the crate's to judge; leaves the stream
/// at its start. An error is the system's.
pub(super) fn empty_window(bytes: &mut (impl Read + Seek)) -> io::Result<Option<[i32; 4]>> {
    let found = match scan(bytes) {
        Err(error) if error.kind() == ErrorKind::UnexpectedEof => None,
        other => other?,
    };
    bytes.rewind()?;
    Ok(found)
}

fn scan(bytes: &mut (impl Read + Seek)) -> io::Result<Option<[i32; 4]>> {
    bytes.seek(SeekFrom::Start(4))?;
    let several_parts = read_i32(bytes)? & SEVERAL_PARTS != 0;
    let mut in_header = false;
    loop {
        let Some(name) = read_name(bytes)? else { return Ok(None) };
        if name.is_empty() {
            // The end of a header; an empty header ends a list of them.
            if !several_parts || !in_header {
                return Ok(None);
            }
            in_header = false;
            continue;
        }
        in_header = true;
        let Some(kind) = read_name(bytes)? else { return Ok(None) };
        let length = read_i32(bytes)?;
        if name == b"dataWindow" && kind == b"box2i" && length == 16 {
            let corners = [read_i32(bytes)?, read_i32(bytes)?, read_i32(bytes)?, read_i32(bytes)?];
            if corners[2] < corners[0] || corners[3] < corners[1] {
                return Ok(Some(corners));
            }
        } else if length < 0 {
            return Ok(None);
        } else {
            bytes.seek(SeekFrom::Current(i64::from(length)))?;
        }
    }
}

/// Up to the next zero byte; `None` if that is no name of EXR's.
fn read_name(bytes: &mut impl Read) -> io::Result<Option<Vec<u8>>> {
    let mut name = Vec::new();
    loop {
        let mut byte = [0];
        bytes.read_exact(&mut byte)?;
        if byte[0] == 0 {
            return Ok(Some(name));
        }
        if name.len() == 255 {
            return Ok(None);
        }
        name.push(byte[0]);
    }
}

fn read_i32(bytes: &mut impl Read) -> io::Result<i32> {
    let mut word = [0; 4];
    bytes.read_exact(&mut word)?;
    Ok(i32::from_le_bytes(word))
}
