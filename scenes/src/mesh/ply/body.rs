//! The numbers behind the header, in reading order.

use super::header::{Element, Encoding, Scalar};
use super::{Bad, bad};

/// A place in the numbers of a file.
#[derive(Clone, Debug)]
pub(super) struct Body<'a> {
    bytes: &'a [u8],
    pub at: usize,
    encoding: Encoding,
}

impl<'a> Body<'a> {
    pub fn new(bytes: &'a [u8], at: usize, encoding: Encoding) -> Self {
        Self { bytes, at, encoding }
    }

    /// The next number.
    pub fn value(&mut self, scalar: Scalar) -> Result<f64, Bad> {
        if self.encoding == Encoding::Ascii {
            return self.word();
        }
        let bytes = self.take(scalar.size())?;
        Ok(decode(bytes, scalar, self.encoding))
    }

    /// The next number where it must count something.
    pub fn count(&mut self, scalar: Scalar) -> Result<usize, Bad> {
        let at = self.at;
        let value = self.value(scalar)?;
        if value >= 0.0 && value <= f64::from(u32::MAX) && value.fract() == 0.0 {
            Ok(value as usize)
        } else {
            bad(at, format!("{value} where a count or an index belongs"), "the file is damaged")
        }
    }

    /// Passes over the rows of an element.
    pub fn skip(&mut self, element: &Element) -> Result<(), Bad> {
        if element.properties.is_empty() {
            return Ok(()); // rows of nothing: their count may be anything
        }
        if let (Some(stride), true) = (element.stride(), self.encoding != Encoding::Ascii) {
            return self.take(stride.saturating_mul(element.count as usize)).map(|_| ());
        }
        for _ in 0..element.count {
            self.row(element, |_, _| ())?;
        }
        Ok(())
    }

    /// Reads one row and hands each number over with the number of its property; those of a list one by one.
    pub fn row(&mut self, element: &Element, mut store: impl FnMut(usize, f64)) -> Result<(), Bad> {
        for (i, property) in element.properties.iter().enumerate() {
            let count = property.length.map_or(Ok(1), |length| self.count(length))?;
            for _ in 0..count {
                store(i, self.value(property.scalar)?);
            }
        }
        Ok(())
    }

    /// The next bytes of a binary file.
    pub fn take(&mut self, length: usize) -> Result<&'a [u8], Bad> {
        let Some(bytes) = self.bytes[self.at..].get(..length) else {
            return bad(
                self.bytes.len(),
                "the file ends before what its header announces",
                "the file is cut off",
            );
        };
        self.at += length;
        Ok(bytes)
    }

    /// Bytes that are left.
    pub fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    pub fn encoding(&self) -> Encoding {
        self.encoding
    }

    /// The next number of an ASCII file. Line ends count as blanks.
    fn word(&mut self) -> Result<f64, Bad> {
        let rest = &self.bytes[self.at..];
        let start = rest.iter().position(|byte| !byte.is_ascii_whitespace()).unwrap_or(rest.len());
        let word = &rest[start..];
        let end = word.iter().position(u8::is_ascii_whitespace).unwrap_or(word.len());
        let at = self.at + start;
        self.at = at + end;
        let text = String::from_utf8_lossy(&word[..end]);
        match text.parse() {
            Ok(value) => Ok(value),
            Err(_) if text.is_empty() => {
                bad(at, "the file ends before what its header announces", "the file is cut off")
            }
            // what C libraries print for a number that is none
            Err(_) if text.to_ascii_lowercase().contains("nan") => Ok(f64::NAN),
            Err(_) => bad(at, format!("\"{text:.40}\" is not a number"), "the file is damaged"),
        }
    }
}

/// A number from its bytes, of which there are as many as its type has.
pub(super) fn decode(bytes: &[u8], scalar: Scalar, encoding: Encoding) -> f64 {
    let mut raw = [0u8; 8];
    let raw = &mut raw[..scalar.size()];
    raw.copy_from_slice(&bytes[..scalar.size()]);
    if encoding == Encoding::Big {
        raw.reverse();
    }
    match *raw {
        [a] if scalar == Scalar::I8 => f64::from(a as i8),
        [a] => f64::from(a),
        [a, b] if scalar == Scalar::I16 => f64::from(i16::from_le_bytes([a, b])),
        [a, b] => f64::from(u16::from_le_bytes([a, b])),
        [a, b, c, d] => match scalar {
            Scalar::I32 => f64::from(i32::from_le_bytes([a, b, c, d])),
            Scalar::U32 => f64::from(u32::from_le_bytes([a, b, c, d])),
            _ => f64::from(f32::from_le_bytes([a, b, c, d])),
        },
        [a, b, c, d, e, f, g, h] => f64::from_le_bytes([a, b, c, d, e, f, g, h]),
        _ => f64::NAN, // no type has another size
    }
}
