//! Bytes, lines and columns of XML text.

use std::path::Path;

use crate::SceneError;

/// Turns byte offsets into lines and columns. Offsets that do not go back cost a walk over the text in all.
#[derive(Clone, Debug)]
pub(super) struct Cursor<'t> {
    text: &'t str,
    byte: usize,
    line: u32,
    column: u32,
}

impl<'t> Cursor<'t> {
    pub fn new(text: &'t str) -> Self {
        Self { text, byte: 0, line: 1, column: 1 }
    }

    /// Both counted from 1, the column in characters.
    pub fn line_column(&mut self, byte: usize) -> (u32, u32) {
        if byte < self.byte {
            *self = Self::new(self.text);
        }
        for c in self.text.get(self.byte..byte).unwrap_or_default().chars() {
            if c == '\n' {
                self.line = self.line.saturating_add(1);
                self.column = 1;
            } else {
                self.column = self.column.saturating_add(1);
            }
        }
        self.byte = byte;
        (self.line, self.column)
    }
}

/// Bytes as text.
///
/// # Errors
///
/// Anything but UTF-8, with or without a byte order mark.
pub(super) fn decode(bytes: Vec<u8>, file: &Path) -> Result<String, SceneError> {
    let error = |line, column, problem: String| SceneError {
        file: file.into(),
        line,
        column,
        element: "XML".into(),
        problem,
        help: "save the file as UTF-8".into(),
    };
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        return Err(error(0, 0, "the text is UTF-16".into()));
    }
    let mut text = String::from_utf8(bytes).map_err(|invalid| {
        let valid = invalid.utf8_error().valid_up_to();
        let text = String::from_utf8_lossy(&invalid.as_bytes()[..valid]).into_owned();
        let (line, column) = Cursor::new(&text).line_column(valid);
        error(line, column, format!("the byte 0x{:02x} is not UTF-8", invalid.as_bytes()[valid]))
    })?;
    if text.starts_with('\u{feff}') {
        text.drain(..'\u{feff}'.len_utf8());
    }
    Ok(text)
}

/// A syntax error of the XML parser, its position taken out of the sentence.
pub(super) fn xml_error(file: &Path, text: &str, error: &roxmltree::Error) -> SceneError {
    let position = error.pos();
    let sentence = error.to_string();
    let problem = sentence.strip_suffix(&format!(" at {position}")).unwrap_or(&sentence).to_string();
    let (line, column) = match error {
        // these carry no position: the end is where the parser found out
        roxmltree::Error::UnexpectedEndOfStream | roxmltree::Error::NoRootNode => {
            Cursor::new(text).line_column(text.len())
        }
        roxmltree::Error::UnclosedRootNode => Cursor::new(text).line_column(text.len()),
        _ => (position.row, position.col),
    };
    let help = match error {
        _ if text.trim().is_empty() => "the file is empty: write a <scene version=\"3.0.0\">",
        roxmltree::Error::UnexpectedEndOfStream
        | roxmltree::Error::UnclosedRootNode
        | roxmltree::Error::NoRootNode => "the file ends too early: was it cut off?",
        roxmltree::Error::DtdDetected => "remove the DOCTYPE: scenes have none",
        roxmltree::Error::UnexpectedCloseTag(..) => "close each element before the one around it",
        _ => "mend the XML",
    };
    SceneError { file: file.into(), line, column, element: "XML".into(), problem, help: help.into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters_and_lines_count_from_one() {
        let text = "<a>\n  é<b/>";
        let mut cursor = Cursor::new(text);
        assert_eq!(cursor.line_column(0), (1, 1));
        assert_eq!(cursor.line_column(text.find("<b").unwrap()), (2, 4));
        assert_eq!(cursor.line_column(1), (1, 2)); // backwards too
    }

    #[test]
    fn other_encodings_are_refused_where_they_begin() {
        let error = decode(b"<a>\n\xe9</a>".to_vec(), Path::new("s.xml")).unwrap_err().to_string();
        assert!(error.starts_with("s.xml:2:1: XML: the byte 0xe9 is not UTF-8"), "{error}");
        assert!(decode(vec![0xff, 0xfe, b'<', 0], Path::new("s.xml")).is_err());
        assert_eq!(decode("\u{feff}<a/>".into(), Path::new("s.xml")).unwrap(), "<a/>");
    }
}
