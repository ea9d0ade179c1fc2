//! An OBJ file as a scene: its faces by object and material, with smoothing groups.

use std::collections::HashMap;
use std::path::Path;

use glam::DVec3;

use super::super::polygon::{self, triangulate};
use super::super::raw::{Positions, RawMesh};
use super::super::{LoadedMesh, MeshOptions, Note};
use super::{ABSENT, Face, Statements};
use crate::SceneError;

/// `usemtl` or `o`: from a face on, another name holds.
#[derive(Debug)]
pub(super) struct Change {
    /// Number of faces before it.
    first: usize,
    line: u32,
    is_material: bool,
    name: String,
}

/// Faces of one object that are made of one material.
pub(crate) struct ObjPart {
    /// What `o` says.
    pub object: Option<String>,
    /// What `usemtl` says.
    pub material: Option<String>,
    /// Where the material is first asked for; 0 where it is not.
    pub line: u32,
    pub mesh: LoadedMesh,
}

/// Reads the text of an OBJ file, its faces apart by object and material; also gives the material libraries, with
/// their lines, and remarks about the whole file.
///
/// # Errors
///
/// As [`read`](super::read).
#[expect(clippy::type_complexity, reason = "three lists, named above")]
pub(crate) fn read_parts(
    text: &[u8],
    file: &Path,
) -> Result<(Vec<ObjPart>, Vec<(u32, String)>, Vec<Note>), SceneError> {
    let mut statements = Statements::parse(text, file)?;
    statements.check_indices(file)?;
    let groups = statements.groups();
    let mut budget = polygon::BUDGET;
    let mut parts = Vec::with_capacity(groups.len());
    for Group { object, material, line, faces } in groups {
        let mesh = statements.part(&faces, &mut budget);
        parts.push(ObjPart { object, material, line, mesh });
    }
    let remarks = statements.remarks();
    Ok((parts, statements.libraries, remarks))
}

/// A part before its mesh is made: the ranges of its faces.
struct Group {
    object: Option<String>,
    material: Option<String>,
    line: u32,
    faces: Vec<std::ops::Range<usize>>,
}

impl Statements {
    /// Takes in a line that says what the next faces belong to.
    pub(super) fn grouping(&mut self, word: &[u8], line: &[u8], number: u32) {
        let text = String::from_utf8_lossy(line);
        let rest = text.trim_start().get(word.len()..).unwrap_or_default();
        let rest = rest.split('#').next().unwrap_or_default().trim();
        match word {
            b"mtllib" => self.libraries.push((number, rest.into())),
            b"s" => {
                self.smoothing = match rest {
                    "off" | "" => 0,
                    group => group.parse().unwrap_or(1),
                }
            }
            _ => self.changes.push(Change {
                first: self.faces.len(),
                line: number,
                is_material: word == b"usemtl",
                name: rest.into(),
            }),
        }
    }

    /// The parts in the order of their first faces.
    fn groups(&self) -> Vec<Group> {
        let mut groups: Vec<Group> = Vec::new();
        let mut known: HashMap<(Option<&str>, Option<&str>), usize> = HashMap::new();
        let (mut object, mut material, mut line) = (None, None, 0);
        let mut start = 0;
        let mut close = |object, material, line, faces: std::ops::Range<usize>| {
            if !faces.is_empty() {
                let group = *known.entry((object, material)).or_insert_with(|| {
                    let [object, material] =
                        [object, material].map(|name: Option<&str>| name.map(String::from));
                    groups.push(Group { object, material, line, faces: Vec::new() });
                    groups.len() - 1
                });
                groups[group].faces.push(faces);
            }
        };
        for change in &self.changes {
            close(object, material, line, start..change.first);
            start = change.first;
            if change.is_material {
                (material, line) = (Some(change.name.as_str()), change.line);
            } else {
                object = Some(change.name.as_str());
            }
        }
        close(object, material, line, start..self.faces.len());
        groups
    }

    /// The mesh of some faces. Faces without normals are flat outside smoothing groups; in one, normals are computed.
    fn part(&self, ranges: &[std::ops::Range<usize>], budget: &mut u64) -> LoadedMesh {
        let faces = || ranges.iter().cloned().flatten();
        let corners = |face: usize| {
            let start = face.checked_sub(1).map_or(0, |before| self.faces[before].end);
            &self.corners[start..self.faces[face].end]
        };
        let has = |i: usize| faces().any(|face| corners(face).iter().any(|corner| corner[i] != ABSENT));
        let (has_uvs, has_normals) = (has(1), has(2));
        let is_smooth = has_normals || faces().any(|face| self.faces[face].smoothing != 0);
        let mut raw = RawMesh::default();
        let mut positions = Vec::new();
        let mut vertices: HashMap<[u32; 4], u32> = HashMap::new();
        let (mut polygon, mut points) = (Vec::new(), Vec::new());
        for face in faces() {
            polygon.clear();
            points.clear();
            let Face { smoothing, .. } = self.faces[face];
            // Corners share a normal within a smoothing group only; a flat face shares none of its own.
            let own = match smoothing {
                0 if is_smooth => 1 << 31 | face as u32,
                group => group & !(1 << 31),
            };
            for corner in corners(face) {
                let [p, t, n] = *corner;
                let key = [p, t, n, if n == ABSENT { own } else { 0 }];
                points.push(DVec3::from(self.positions[p as usize]));
                polygon.push(*vertices.entry(key).or_insert_with(|| {
                    positions.push(self.positions[p as usize]);
                    raw.numbers.push(p + 1);
                    if has_uvs {
                        raw.uvs.push(self.uvs.get(t as usize).copied().unwrap_or_default());
                    }
                    if has_normals {
                        raw.normals.push(self.normals.get(n as usize).copied().unwrap_or_default());
                    }
                    positions.len() as u32 - 1
                }));
            }
            triangulate(&points, budget, |triangle| {
                raw.triangles.push(triangle.map(|i| polygon[i]));
                raw.faces.push(face as u32 + 1);
            });
        }
        raw.positions = Positions::Double(positions);
        // an OBJ file's v runs upwards
        raw.finish(MeshOptions { flip_tex_coords: true, face_normals: !is_smooth })
    }
}
