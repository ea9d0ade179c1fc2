//! Buffers and the pieces of them: from the binary chunk, from files, from data URIs.

use std::ops::Range;
use std::sync::Arc;

use base64::alphabet;
use base64::engine::{DecodePaddingMode, Engine, GeneralPurpose, GeneralPurposeConfig};

use super::Reader;
use super::json::{EXPORT_AGAIN, Item};
use crate::SceneError;

/// A run of bytes; several may share one buffer.
#[derive(Clone)]
pub(super) struct Bytes {
    buffer: Arc<Vec<u8>>,
    range: Range<usize>,
}

impl Bytes {
    /// What tells it from others as long as the reader lives: the address of the buffer, and the offset.
    pub fn key(&self) -> (usize, usize) {
        (Arc::as_ptr(&self.buffer) as usize, self.range.start)
    }

    /// Without the first `offset` bytes; there must be so many.
    pub fn from(self, offset: usize) -> Self {
        Self { range: self.range.start + offset..self.range.end, buffer: self.buffer }
    }
}

impl std::ops::Deref for Bytes {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        &self.buffer[self.range.clone()]
    }
}

impl Reader<'_> {
    /// The bytes of a buffer.
    fn buffer(&mut self, index: usize) -> Result<Bytes, SceneError> {
        if let Some(known) = self.buffers.get(&index) {
            return Ok(known.clone());
        }
        let item = self.document.entry("buffers", index)?;
        let bytes = match item.string("uri")? {
            Some(uri) => self.uri(uri, &item)?,
            None => match (index, &self.binary) {
                (0, Some(binary)) => Bytes { buffer: Arc::clone(&self.file_bytes), range: binary.clone() },
                _ => {
                    let help = "a .gltf file names the file of its buffers; only a .glb has one inside";
                    return Err(item.error("uri", "not there", help));
                }
            },
        };
        let announced = item.unsigned("byteLength")?.unwrap_or(0);
        if announced > bytes.len() as u64 {
            let problem = format!("{announced} bytes are announced, but there are {}", bytes.len());
            return Err(item.error("byteLength", problem, "copy the files again: one may be cut off"));
        }
        self.buffers.insert(index, bytes.clone());
        Ok(bytes)
    }

    /// A buffer view, and its stride in bytes where it has one.
    pub(super) fn view(&mut self, index: usize) -> Result<(Bytes, Option<usize>), SceneError> {
        let item = self.document.entry("bufferViews", index)?;
        let Some(buffer) = item.index("buffer", "buffers")? else {
            return Err(item.error("buffer", "not there", EXPORT_AGAIN));
        };
        let Bytes { buffer, range } = self.buffer(buffer)?;
        let offset = item.unsigned("byteOffset")?.unwrap_or(0);
        let length = item.unsigned("byteLength")?.unwrap_or(0);
        if offset.checked_add(length).is_none_or(|end| end > range.len() as u64) {
            let problem = format!("{length} bytes from {offset} on, but the buffer ends at {}", range.len());
            return Err(item.error("byteLength", problem, EXPORT_AGAIN));
        }
        let start = range.start + offset as usize;
        let stride = item.unsigned("byteStride")?.map(|stride| stride.min(u64::from(u32::MAX)) as usize);
        Ok((Bytes { buffer, range: start..start + length as usize }, stride))
    }

    /// What a URI stands for: a file beside the scene, or the data in itself.
    pub(super) fn uri(&mut self, uri: &str, item: &Item<'_>) -> Result<Bytes, SceneError> {
        let whole = |bytes: Vec<u8>| Bytes { range: 0..bytes.len(), buffer: Arc::new(bytes) };
        if let Some(data) = uri.strip_prefix("data:") {
            return match data.split_once(',') {
                Some((kind, text)) if kind.ends_with(";base64") => base64(text).map(whole),
                Some((_, text)) => Some(whole(unescape(text))),
                None => None,
            }
            .ok_or_else(|| item.error("uri", "data that is not base64", EXPORT_AGAIN));
        }
        if let Some(known) = self.uris.get(uri) {
            return Ok(known.clone());
        }
        let path = self.find(uri, item)?;
        let bytes = self.files.read(&path).map_err(|e| {
            item.error("uri", format!("{}: {e}", path.display()), "name a file that can be read")
        })?;
        self.allowance = self.allowance.saturating_add(super::allowance(bytes.len()));
        let bytes = whole(bytes);
        self.uris.insert(uri.into(), bytes.clone());
        Ok(bytes)
    }

    /// The file that a URI names, percent signs decoded; some writers do not encode them.
    fn find(&mut self, uri: &str, item: &Item<'_>) -> Result<std::path::PathBuf, SceneError> {
        if let Some((scheme, _)) = uri.split_once("://") {
            let problem = format!("a file at {}://…: nothing is fetched from the net", shorten(scheme));
            return Err(item.error("uri", problem, "copy the file beside the model and name it there"));
        }
        let decoded = String::from_utf8(unescape(uri)).unwrap_or_else(|_| uri.into());
        let mut found = self.files.find(&decoded, &self.document.file);
        if found.is_none() && decoded != uri {
            found = self.files.find(uri, &self.document.file);
        }
        let Some(found) = found else {
            let problem = format!("the file \"{}\" is not there", shorten(&decoded));
            return Err(item.error("uri", problem, "names are looked for beside the model"));
        };
        if found.respelt {
            let message = format!("the file \"{}\" was found as {}", shorten(&decoded), found.path.display());
            self.warn(&item.at("uri"), message);
        }
        Ok(found.path)
    }
}

/// The beginning of a text that may be long.
fn shorten(text: &str) -> String {
    text.chars().take(80).collect()
}

/// RFC 4648, in either alphabet, with or without padding; blanks and line ends are passed over.
fn base64(text: &str) -> Option<Vec<u8>> {
    const LENIENT: GeneralPurposeConfig = GeneralPurposeConfig::new()
        .with_decode_padding_mode(DecodePaddingMode::Indifferent)
        .with_decode_allow_trailing_bits(true);
    const ENGINE: GeneralPurpose = GeneralPurpose::new(&alphabet::STANDARD, LENIENT);
    let plain = |c: char| match c {
        '-' => '+',
        '_' => '/',
        c => c,
    };
    let text: String = text.chars().filter(|c| !c.is_whitespace()).map(plain).collect();
    ENGINE.decode(text).ok()
}

/// `%41` becomes `A`; what is no such code stays.
fn unescape(text: &str) -> Vec<u8> {
    let bytes = text.as_bytes();
    let mut decoded = Vec::with_capacity(bytes.len());
    let mut at = 0;
    while at < bytes.len() {
        let digit = |i: usize| bytes.get(i).and_then(|&b| (b as char).to_digit(16));
        match (bytes[at], digit(at + 1), digit(at + 2)) {
            (b'%', Some(high), Some(low)) => {
                decoded.push((16 * high + low) as u8);
                at += 3;
            }
            (byte, ..) => {
                decoded.push(byte);
                at += 1;
            }
        }
    }
    decoded
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_rfc_4648() {
        // its section 10
        for (text, bytes) in
            [("", ""), ("Zg==", "f"), ("Zm8=", "fo"), ("Zm9vYg", "foob"), ("Zm9v\nYmFy", "foobar")]
        {
            assert_eq!(base64(text).as_deref(), Some(bytes.as_bytes()), "{text}");
        }
        assert_eq!(base64("Zm9*"), None);
    }

    #[test]
    fn percent_codes_are_decoded_and_other_percent_signs_stay() {
        assert_eq!(unescape("a%20b%4"), b"a b%4");
        assert_eq!(unescape("100%"), b"100%");
    }
}
