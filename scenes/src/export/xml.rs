//! Elements, indented and escaped.

use std::fmt::Write;

use glam::{DMat4, DVec3};

/// An XML text that grows.
pub struct Xml {
    text: String,
    depth: usize,
}

impl Xml {
    pub fn new() -> Self {
        Self { text: "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n".into(), depth: 0 }
    }

    pub fn open(&mut self, tag: &str, attributes: &[(&str, &str)]) {
        self.tag(tag, attributes, ">");
        self.depth += 1;
    }

    pub fn close(&mut self, tag: &str) {
        self.depth -= 1;
        self.indent();
        let _ = writeln!(self.text, "</{tag}>"); // a string takes everything
    }

    pub fn leaf(&mut self, tag: &str, attributes: &[(&str, &str)]) {
        self.tag(tag, attributes, "/>");
    }

    /// `<tag name="…" value="…"/>`
    pub fn value(&mut self, tag: &str, name: &str, value: &str) {
        self.leaf(tag, &[("name", name), ("value", value)]);
    }

    pub fn float(&mut self, name: &str, value: impl Into<f64>) {
        self.value("float", name, &number(value.into()));
    }

    pub fn rgb(&mut self, name: &str, value: [f32; 3]) {
        self.value("rgb", name, &value.map(|v| v.to_string()).join(" "));
    }

    pub fn point(&mut self, name: &str, value: DVec3) {
        self.value("point", name, &value.to_array().map(number).join(" "));
    }

    pub fn vector(&mut self, name: &str, value: DVec3) {
        self.value("vector", name, &value.to_array().map(number).join(" "));
    }

    /// A transform as 16 numbers, row by row; nothing for the identity.
    pub fn transform(&mut self, name: &str, matrix: DMat4) {
        if matrix == DMat4::IDENTITY {
            return;
        }
        self.open("transform", &[("name", name)]);
        let rows = matrix.transpose().to_cols_array().map(number);
        self.leaf("matrix", &[("value", &rows.join(" "))]);
        self.close("transform");
    }

    pub fn finish(self) -> String {
        self.text
    }

    fn tag(&mut self, tag: &str, attributes: &[(&str, &str)], end: &str) {
        self.indent();
        let _ = write!(self.text, "<{tag}");
        for (name, value) in attributes {
            let _ = write!(self.text, " {name}=\"{}\"", escape(value));
        }
        let _ = writeln!(self.text, "{end}");
    }

    fn indent(&mut self) {
        let _ = write!(self.text, "{:width$}", "", width = 4 * self.depth);
    }
}

/// The shortest text that is read as the same number; a float's digits stay those of the float.
fn number(value: f64) -> String {
    let short = value as f32;
    if f64::from(short) == value { short.to_string() } else { value.to_string() }
}

/// Text that may stand in an attribute: without what XML 1.0 cannot hold.
fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\u{fffe}' | '\u{ffff}' => out.push('?'),
            c if c.is_control() => out.push('?'),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_come_back_as_they_were() {
        let mut xml = Xml::new();
        xml.leaf("a", &[("name", "<&\">'ü")]);
        let text = xml.finish();
        let document = roxmltree::Document::parse(&text).unwrap();
        assert_eq!(document.root_element().attribute("name"), Some("<&\">'ü"));
        assert_eq!(escape("a\u{1}b\u{ffff}"), "a?b?");
    }

    #[test]
    fn numbers_come_back_as_they_were() {
        for x in [0.1, 1.0 / 3.0, 1e-30, -2.5e20, f64::from(0.1f32), f64::from(f32::MAX)] {
            assert_eq!(number(x).parse::<f64>().unwrap() as f32, x as f32, "{x}");
        }
        assert_eq!(number(f64::from(0.1f32)), "0.1");
        assert_eq!(number(1.0 / 3.0), "0.3333333333333333");
    }
}
