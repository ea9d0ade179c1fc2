//! Columns beside position, normal and texture coordinates, joined to attributes as Mitsuba joins them.
//!
//! `r g b` and `red green blue` are a colour. Of the rest, neighbours that differ in what follows the last underscore,
//! counting up from 0, x or r, are one attribute; it must have one or three of them.

use super::header::{Element, Scalar};
use crate::spectrum::linear_from_srgb;
use crate::{AttributeDomain, MeshAttribute};

/// Columns that make one attribute.
#[derive(Debug, PartialEq)]
pub(super) struct Columns {
    name: String,
    /// Numbers of the properties; one or three.
    properties: Vec<usize>,
    /// Of a colour in whole numbers, the largest: it is encoded as in a picture.
    white: Option<f32>,
}

/// What the names of a sequence end in.
const ENDINGS: [&str; 3] = ["0123456789", "xyzw", "rgba"];
const TAKEN: [&str; 14] =
    ["x", "y", "z", "nx", "ny", "nz", "u", "v", "s", "t", "texture_u", "texture_v", "texture_s", "texture_t"];

/// The attributes among the columns of an element.
pub(super) fn columns(element: &Element, domain: AttributeDomain) -> Vec<Columns> {
    let prefix = match domain {
        AttributeDomain::Vertex => "vertex",
        AttributeDomain::Face => "face",
    };
    let mut found = Vec::new();
    let is_number = |&i: &usize| element.properties[i].length.is_none();
    for names in [["r", "g", "b"], ["red", "green", "blue"]] {
        let places = names.map(|name| element.position(name).filter(is_number));
        if let [Some(r), Some(g), Some(b)] = places {
            let white = [r, g, b].map(|i| white(element.properties[i].scalar));
            let (name, white) = (format!("{prefix}_color"), white[0].filter(|_| white[0] == white[2]));
            found.push(Columns { name, properties: vec![r, g, b], white });
            break;
        }
    }
    let parts = |i: usize| {
        let name = element.properties[i].name.as_str();
        let (stem, ending) = name.rsplit_once('_').filter(|_| !TAKEN.contains(&name) && is_number(&i))?;
        Some((stem, ending))
    };
    let mut i = 0;
    while i < element.properties.len() {
        let first = i;
        i += 1;
        let Some((stem, ending)) = parts(first) else { continue };
        let Some(endings) = ENDINGS.iter().find(|endings| endings[..1] == *ending) else { continue };
        while parts(i.min(element.properties.len() - 1))
            == endings.get(i - first..=i - first).map(|e| (stem, e))
            && i < element.properties.len()
        {
            i += 1;
        }
        let middle = if ending == "r" { "_color" } else { "" };
        let name = format!("{prefix}_{stem}{middle}");
        // of two of one name the first counts
        if matches!(i - first, 1 | 3) && found.iter().all(|other| other.name != name) {
            found.push(Columns { name, properties: (first..i).collect(), white: None });
        }
    }
    found
}

/// The largest number of an unsigned type, which stands for white.
fn white(scalar: Scalar) -> Option<f32> {
    match scalar {
        Scalar::U8 => Some(255.0),
        Scalar::U16 => Some(65535.0),
        _ => None,
    }
}

impl Columns {
    /// The attribute, still without values.
    pub fn attribute(&self, domain: AttributeDomain) -> MeshAttribute {
        let channels = self.properties.len() as u32;
        MeshAttribute { name: self.name.clone(), domain, channels, values: Vec::new() }
    }

    /// Adds the values of a row.
    pub fn store(&self, row: impl Fn(usize) -> f64, values: &mut Vec<f32>) {
        values.extend(self.properties.iter().map(|&i| {
            let value = row(i) as f32;
            self.white.map_or(value, |white| linear_from_srgb(value / white))
        }));
    }

    /// What is to be said of it.
    pub fn note(&self) -> Option<String> {
        let white = self.white?;
        Some(format!("{} in whole numbers is read as sRGB with white at {white}", self.name))
    }
}

#[cfg(test)]
mod tests {
    use super::super::header::Header;
    use super::*;

    fn names(properties: &[&str]) -> Vec<(String, usize)> {
        let lines: String = properties.iter().map(|name| format!("property float {name}\n")).collect();
        let text = format!("ply\nformat ascii 1.0\nelement vertex 1\n{lines}end_header\n");
        let header = Header::parse(text.as_bytes()).unwrap();
        let found = columns(&header.elements[0], AttributeDomain::Vertex);
        found.into_iter().map(|c| (c.name, c.properties.len())).collect()
    }

    #[test]
    fn columns_are_joined_as_mitsuba_joins_them() {
        // As Mitsuba 3.9.1 reads the same files.
        type Case = (&'static [&'static str], &'static [(&'static str, usize)]);
        let cases: [Case; 11] = [
            (&["r", "g", "b"], &[("vertex_color", 3)]),
            (&["red", "green", "blue"], &[("vertex_color", 3)]),
            (&["color_0", "color_1", "color_2"], &[("vertex_color", 3)]),
            (&["color_r", "color_g", "color_b"], &[("vertex_color_color", 3)]),
            (&["w"], &[]),
            (&["weight_0"], &[("vertex_weight", 1)]),
            (&["weight_x", "nx"], &[("vertex_weight", 1)]),
            (&["foo_0", "foo_1"], &[]),
            (&["foo_1", "foo_0", "foo_2"], &[("vertex_foo", 1)]), // Mitsuba drops it whole
            (&["x", "foo_bar_0", "foo_bar_1", "foo_bar_2", "w_0"], &[("vertex_foo_bar", 3), ("vertex_w", 1)]),
            (&["foo_0", "quality", "foo_2", "texture_u"], &[("vertex_foo", 1)]),
        ];
        for (properties, expected) in cases {
            let expected: Vec<_> = expected.iter().map(|(name, n)| (name.to_string(), *n)).collect();
            assert_eq!(names(properties), expected, "{properties:?}");
        }
    }
}
