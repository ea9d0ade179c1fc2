//! Wavefront OBJ: one mesh of the whole file, as Mitsuba reads it (groups and materials of the file do not count).
//!
//! A reader of our own because a ready one would have to be fed a filtered copy and asked again for the line of every
//! error: groups split vertices that faces share, comments need not be UTF-8, and coordinates need `f64` to the end.

mod parts;

use std::collections::HashMap;
use std::path::Path;

use glam::DVec3;

use super::polygon::{self, triangulate};
use super::raw::{Positions, RawMesh};
use super::{LoadedMesh, MeshOptions, Note, mesh_error};
use crate::SceneError;
pub(crate) use parts::{ObjPart, read_parts};

/// "No texture coordinate" or "no normal" in a corner.
const ABSENT: u32 = u32::MAX;
/// Mitsuba reads none either.
const NO_COLORS: &str = "the colours of vertices are not read; save the mesh as PLY to keep them";
/// An index that the file cannot hold.
const BEYOND: u32 = u32::MAX - 1;

/// Reads the text of an OBJ file.
///
/// # Errors
///
/// A line that is no number, vertex or face, and an index that the file does not hold, with their line.
pub(crate) fn read(text: &[u8], file: &Path, options: MeshOptions) -> Result<LoadedMesh, SceneError> {
    Ok(Statements::parse(text, file)?.into_mesh(file)?.finish(options))
}

/// The statements of a file that make its shape.
#[derive(Debug, Default)]
struct Statements {
    positions: Vec<[f64; 3]>,
    uvs: Vec<[f32; 2]>,
    normals: Vec<[f32; 3]>,
    /// Position, texture coordinate and normal of each corner of each face, counted from 0.
    corners: Vec<[u32; 3]>,
    faces: Vec<Face>,
    /// Where the material or the object changes, in the order of the faces.
    changes: Vec<parts::Change>,
    /// Material libraries: line and the rest of it.
    libraries: Vec<(u32, String)>,
    /// The smoothing group that is on; 0 for none.
    smoothing: u32,
    notes: Vec<Note>,
    /// The line of the first vertex with a colour.
    colored: Option<u32>,
}

/// A face: its line, its smoothing group and where its corners end.
#[derive(Debug)]
struct Face {
    line: u32,
    smoothing: u32,
    end: usize,
}

/// A line that could not be read, before its number is known.
type Bad = (String, &'static str);

impl Statements {
    fn parse(text: &[u8], file: &Path) -> Result<Self, SceneError> {
        let mut statements = Self::default();
        let mut joined = Vec::new(); // a line that goes on behind a backslash
        let mut number = 0u32;
        let mut first = 1;
        for line in text.split(|&byte| byte == b'\n') {
            number = number.saturating_add(1);
            let line = line.strip_suffix(b"\r").unwrap_or(line);
            if let Some(part) = line.strip_suffix(b"\\") {
                joined.extend_from_slice(part);
                joined.push(b' ');
                continue;
            }
            let whole = if joined.is_empty() {
                first = number;
                line
            } else {
                joined.extend_from_slice(line);
                &joined
            };
            statements
                .statement(whole, first)
                .map_err(|(problem, help)| mesh_error(file, first, 1, problem, help))?;
            joined.clear();
            first = number.saturating_add(1);
        }
        Ok(statements)
    }

    /// Takes in one line; statements that are not about triangles are passed over.
    fn statement(&mut self, line: &[u8], line_number: u32) -> Result<(), Bad> {
        let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        match words.next() {
            Some(b"v") => {
                // x y z, and perhaps w, or r g b
                if words.clone().nth(5).is_some_and(|sixth| number(sixth).is_ok()) {
                    self.colored.get_or_insert(line_number);
                }
                self.positions.push(numbers(words, 3)?);
            }
            Some(b"vt") => {
                let [u, v] = numbers(words, 1)?;
                self.uvs.push([u as f32, v as f32]);
            }
            Some(b"vn") => self.normals.push(numbers(words, 3)?.map(|v| v as f32)),
            Some(b"f" | b"fo") => {
                let start = self.corners.len();
                for word in words.take_while(|word| word[0] != b'#') {
                    let corner = self.corner(word)?;
                    self.corners.push(corner);
                }
                let corners = self.corners.len() - start;
                if corners < 3 {
                    self.corners.truncate(start);
                    let message = format!("face with {corners} corners dropped");
                    self.notes.push(Note { line: line_number, message });
                } else {
                    let smoothing = self.smoothing;
                    self.faces.push(Face { line: line_number, smoothing, end: self.corners.len() });
                }
            }
            Some(word @ (b"usemtl" | b"o" | b"mtllib" | b"s")) => self.grouping(word, line, line_number),
            _ => {}
        }
        Ok(())
    }

    /// `position`, `position/uv`, `position//normal` or `position/uv/normal`.
    fn corner(&self, word: &[u8]) -> Result<[u32; 3], Bad> {
        let counts = [self.positions.len(), self.uvs.len(), self.normals.len()];
        let mut corner = [ABSENT; 3];
        let mut parts = word.split(|&byte| byte == b'/');
        for (i, (index, count)) in corner.iter_mut().zip(counts).enumerate() {
            match parts.next() {
                Some(b"") | None if i > 0 => {}
                part => {
                    let text = std::str::from_utf8(part.unwrap_or_default()).unwrap_or_default();
                    let number = text.parse::<i64>().map_err(|_| bad_corner(word))?;
                    *index = match absolute(number, count) {
                        Some(index) => index,
                        None if i == 0 => return Err(bad_vertex(number)),
                        None => BEYOND,
                    };
                }
            }
        }
        if parts.next().is_some() { Err(bad_corner(word)) } else { Ok(corner) }
    }

    /// Joins equal corners into vertices and cuts faces into triangles.
    fn into_mesh(mut self, file: &Path) -> Result<RawMesh, SceneError> {
        self.check_indices(file)?;
        let has_uvs = self.corners.iter().any(|corner| corner[1] != ABSENT);
        let has_normals = self.corners.iter().any(|corner| corner[2] != ABSENT);
        let mut raw = RawMesh::default();
        let mut positions = Vec::new();
        let mut vertices: HashMap<[u32; 3], u32> = HashMap::new();
        let mut budget = polygon::BUDGET;
        let mut start = 0;
        let (mut polygon, mut points) = (Vec::new(), Vec::new());
        for (face, number) in self.faces.iter().zip(1..) {
            polygon.clear();
            points.clear();
            for corner in &self.corners[start..face.end] {
                let position = self.positions[corner[0] as usize];
                points.push(DVec3::from(position));
                polygon.push(*vertices.entry(*corner).or_insert_with(|| {
                    positions.push(position);
                    raw.numbers.push(corner[0] + 1);
                    if has_uvs {
                        raw.uvs.push(self.uvs.get(corner[1] as usize).copied().unwrap_or_default());
                    }
                    if has_normals {
                        raw.normals.push(self.normals.get(corner[2] as usize).copied().unwrap_or_default());
                    }
                    positions.len() as u32 - 1
                }));
            }
            triangulate(&points, &mut budget, |triangle| {
                raw.triangles.push(triangle.map(|i| polygon[i]));
                raw.faces.push(number);
            });
            start = face.end;
        }
        raw.positions = Positions::Double(positions);
        raw.notes = self.remarks();
        Ok(raw)
    }

    /// What is to be said about the file.
    fn remarks(&mut self) -> Vec<Note> {
        let mut notes = summary(std::mem::take(&mut self.notes));
        notes.extend(self.colored.map(|line| Note { line, message: NO_COLORS.into() }));
        notes
    }

    /// Every vertex must be one that the file holds, if only further down. A texture coordinate or a normal that it
    /// does not hold counts as not given.
    fn check_indices(&mut self, file: &Path) -> Result<(), SceneError> {
        let mut start = 0;
        for face in &self.faces {
            for corner in &mut self.corners[start..face.end] {
                if corner[0] as usize >= self.positions.len() {
                    let (problem, help) = bad_vertex(i64::from(corner[0]) + 1);
                    let problem = format!("{problem}: the file has {}", self.positions.len());
                    return Err(mesh_error(file, face.line, 1, problem, help));
                }
                let counts = [(1, self.uvs.len(), "texture coordinates"), (2, self.normals.len(), "normals")];
                for (i, count, what) in counts {
                    if corner[i] != ABSENT && corner[i] as usize >= count {
                        corner[i] = ABSENT;
                        let message =
                            format!("face with {what} that the file does not hold; it is read without");
                        self.notes.push(Note { line: face.line, message });
                    }
                }
            }
            start = face.end;
        }
        Ok(())
    }
}

/// The first `N` numbers of a statement, of which the first `needed` must be there.
fn numbers<'a, const N: usize>(
    mut words: impl Iterator<Item = &'a [u8]>,
    needed: usize,
) -> Result<[f64; N], Bad> {
    let mut values = [0.0; N];
    for (i, value) in values.iter_mut().enumerate() {
        match words.next() {
            Some(word) if word[0] != b'#' => *value = number(word)?,
            _ if i < needed => {
                return Err((format!("{i} numbers where {needed} belong"), "complete the line"));
            }
            _ => break,
        }
    }
    Ok(values)
}

/// A number, or what C libraries print for one that is none.
fn number(word: &[u8]) -> Result<f64, Bad> {
    let text = String::from_utf8_lossy(word);
    if let Ok(value) = text.parse() {
        return Ok(value);
    }
    let lower = text.to_ascii_lowercase();
    if ["nan", "#ind", "#qnan", "#snan", "#inf"].iter().any(|no_number| lower.contains(no_number)) {
        return Ok(f64::NAN);
    }
    Err((format!("\"{text}\" is not a number"), "write numbers like 1.5 or -2e-3"))
}

/// From the file's counting (from 1, or backwards from the latest with −1) to counting from 0.
fn absolute(number: i64, count: usize) -> Option<u32> {
    let index = if number > 0 { number - 1 } else { i64::try_from(count).ok()?.checked_add(number)? };
    let index = u32::try_from(index).ok()?;
    (number != 0 && index < BEYOND).then_some(index)
}

fn bad_corner(word: &[u8]) -> Bad {
    let word = String::from_utf8_lossy(word);
    (format!("face with the corner \"{word}\""), "write corners as v, v/vt, v//vn or v/vt/vn")
}

fn bad_vertex(number: i64) -> Bad {
    let help = "count from 1, or backwards from -1, within what the file defines";
    (format!("face with vertex {number}"), help)
}

/// One remark for all faces, at the line of the first.
fn summary(notes: Vec<Note>) -> Vec<Note> {
    let count = notes.len();
    let mut first: Vec<Note> = notes.into_iter().take(1).collect();
    if let [note] = &mut first[..]
        && count > 1
    {
        note.message += &format!(", and {} more", count - 1);
    }
    first
}

#[cfg(test)]
mod tests;
