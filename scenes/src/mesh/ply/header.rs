//! The header: which elements follow, with which properties.

use super::{Bad, bad};

/// How numbers are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    Little,
    Big,
}

/// Number types.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn parse(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    /// In bytes.
    pub fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// Whether `f32` may round its values.
    pub fn exceeds_f32(self) -> bool {
        matches!(self, Self::I32 | Self::U32 | Self::F64)
    }
}

/// A property of an element.
#[derive(Debug)]
pub(super) struct Property {
    pub name: String,
    pub scalar: Scalar,
    /// For a list, the type of its length.
    pub length: Option<Scalar>,
}

/// A table of the file.
#[derive(Debug)]
pub(super) struct Element {
    pub name: String,
    /// Its rows.
    pub count: u32,
    pub properties: Vec<Property>,
    /// Byte offset of its line in the header.
    pub at: usize,
}

impl Element {
    /// Bytes of a row, where all rows have the same.
    pub fn stride(&self) -> Option<usize> {
        self.properties.iter().map(|p| p.length.is_none().then_some(p.scalar.size())).sum()
    }

    /// The number of a property among the properties.
    pub fn position(&self, name: &str) -> Option<usize> {
        self.properties.iter().position(|p| p.name == name)
    }
}

/// What stands before the numbers.
#[derive(Debug)]
pub(super) struct Header {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
    /// Where the numbers begin.
    pub end: usize,
}

impl Header {
    pub fn parse(bytes: &[u8]) -> Result<Self, Bad> {
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        let mut at = 0;
        // a lone carriage return ends the lines of old Macintosh files
        let line_end =
            if bytes.starts_with(b"ply\r") && bytes.get(4) != Some(&b'\n') { b'\r' } else { b'\n' };
        loop {
            let Some(length) = bytes[at..].iter().position(|&byte| byte == line_end) else {
                return bad(at, "the header does not end", "the file is no PLY, or it is cut off");
            };
            let line = String::from_utf8_lossy(&bytes[at..at + length]);
            let words: Vec<_> = line.split_ascii_whitespace().collect();
            match words[..] {
                ["ply"] if at == 0 => {}
                _ if at == 0 => return bad(0, "no \"ply\" in the first line", "the file is no PLY"),
                ["format", format, _] => {
                    encoding = Some(match format {
                        "ascii" => Encoding::Ascii,
                        "binary_little_endian" => Encoding::Little,
                        "binary_big_endian" => Encoding::Big,
                        _ => return bad(at, format!("unknown format \"{format}\""), FORMATS),
                    });
                }
                ["element", name, count] => {
                    let Ok(count) = count.parse() else {
                        return bad(at, format!("{count} rows of \"{name}\""), "at most 4294967295 are read");
                    };
                    elements.push(Element { name: name.into(), count, properties: Vec::new(), at });
                }
                ["property", "list", length, scalar, name] => {
                    let length = Some(scalar_type(length, at)?);
                    push(
                        &mut elements,
                        Property { name: name.into(), scalar: scalar_type(scalar, at)?, length },
                        at,
                    )?;
                }
                ["property", scalar, name] => {
                    let scalar = scalar_type(scalar, at)?;
                    push(&mut elements, Property { name: name.into(), scalar, length: None }, at)?;
                }
                ["end_header"] => {
                    let Some(encoding) = encoding else {
                        return bad(at, "a header without \"format\"", FORMATS);
                    };
                    return Ok(Self { encoding, elements, end: at + length + 1 });
                }
                [] | ["comment" | "obj_info", ..] => {}
                _ => {
                    return bad(at, format!("unknown header line \"{}\"", line.trim()), "the file is no PLY");
                }
            }
            at += length + 1;
        }
    }
}

const FORMATS: &str = "formats are ascii, binary_little_endian and binary_big_endian";

fn scalar_type(name: &str, at: usize) -> Result<Scalar, Bad> {
    let help = "types are char, uchar, short, ushort, int, uint, float and double";
    Scalar::parse(name).map_or_else(|| bad(at, format!("unknown type \"{name}\""), help), Ok)
}

fn push(elements: &mut [Element], property: Property, at: usize) -> Result<(), Bad> {
    match elements.last_mut() {
        Some(element) => element.properties.push(property),
        None => return bad(at, "a property before any element", "the file is no PLY"),
    }
    Ok(())
}
