//! What is common to all mesh formats: vertices are rounded, bad faces dropped, normals supplied.

use std::sync::Arc;

use glam::DVec3;

use super::{LoadedMesh, MeshOptions, Note, attributes, normals};
use crate::{AttributeDomain, Mesh, MeshAttribute};

/// A mesh as it came out of its file: indices are in range, values may be anything.
#[derive(Debug, Default)]
pub(crate) struct RawMesh {
    pub positions: Positions,
    /// One a vertex, or none; a zero or non-finite one is "not given".
    pub normals: Vec<[f32; 3]>,
    /// One a vertex, or none.
    pub uvs: Vec<[f32; 2]>,
    pub triangles: Vec<[u32; 3]>,
    /// Of vertices, and of the faces of the file.
    pub attributes: Vec<MeshAttribute>,
    /// The number of the face in the file that each triangle was cut from, counted from 1; empty: its own number.
    pub faces: Vec<u32>,
    /// The number in the file that each vertex has, counted from 1; empty: its own number.
    pub numbers: Vec<u32>,
    pub notes: Vec<Note>,
}

/// Vertex positions in the precision of the file.
#[derive(Debug)]
pub(crate) enum Positions {
    Single(Vec<[f32; 3]>),
    Double(Vec<[f64; 3]>),
}

impl Default for Positions {
    fn default() -> Self {
        Self::Single(Vec::new())
    }
}

impl Positions {
    /// One vertex.
    pub fn get(&self, index: usize) -> DVec3 {
        match self {
            Self::Single(positions) => DVec3::from(positions[index].map(f64::from)),
            Self::Double(positions) => DVec3::from(positions[index]),
        }
    }
}

impl RawMesh {
    /// The mesh that a scene can hold.
    pub fn finish(self, options: MeshOptions) -> LoadedMesh {
        let Self { positions, normals: file_normals, uvs, triangles, attributes, faces, numbers, mut notes } =
            self;
        let (positions, offset) = match positions {
            Positions::Single(positions) => (positions, DVec3::ZERO),
            Positions::Double(positions) => round(positions),
        };
        let mut mesh = Mesh { positions, normals: file_normals, uvs, triangles, attributes };
        attributes::of_triangles(&mut mesh.attributes, &faces);
        if options.face_normals {
            mesh.normals = Vec::new();
        }
        if options.flip_tex_coords {
            mesh.uvs.iter_mut().for_each(|uv| uv[1] = 1.0 - uv[1]);
        }
        drop_non_finite(&mut mesh, &faces, &numbers, &mut notes);
        let bad_uvs = mesh.uvs.iter_mut().filter(|uv| !(uv[0].is_finite() && uv[1].is_finite()));
        let bad_uvs = bad_uvs.map(|uv| *uv = [0.0; 2]).count();
        if bad_uvs > 0 {
            let message = format!("{bad_uvs} texture coordinates are not finite; (0, 0) stands in");
            notes.push(Note { line: 0, message });
        }
        attributes::make_finite(&mut mesh.attributes, &mut notes);
        if !options.face_normals {
            normals::complete(&mut mesh);
        }
        LoadedMesh { mesh: Arc::new(mesh), offset, notes }
    }
}

/// Rounds to `f32`. Where that would lose digits because the mesh lies far from its origin compared with
/// its size, a point near its centre is subtracted first. That point has few digits itself (a multiple
/// of a power of two near the size), so that the differences are exact or nearly so.
fn round(positions: Vec<[f64; 3]>) -> (Vec<[f32; 3]>, DVec3) {
    let finite = || positions.iter().map(|p| DVec3::from(*p)).filter(|p| p.is_finite());
    let (low, high) = finite().fold((DVec3::MAX, DVec3::MIN), |(low, high), p| (low.min(p), high.max(p)));
    let far = low.abs().max(high.abs());
    let extent = (high - low).max_element();
    // Below a factor of 8 the offset would save less than three bits.
    let is_far = extent.is_finite() && far.max_element() > 8.0 * extent;
    let rounds = || positions.iter().flatten().any(|&v| v.is_finite() && f64::from(v as f32) != v);
    let mut offset = DVec3::ZERO;
    if is_far && rounds() {
        let grid = if extent > 0.0 { extent.log2().ceil().exp2() } else { 0.0 };
        let centre = 0.5 * low + 0.5 * high;
        offset = if grid > 0.0 { (centre / grid).round() * grid } else { centre };
        if !offset.is_finite() {
            offset = DVec3::ZERO;
        }
    }
    let rounded = positions.iter().map(|p| (DVec3::from(*p) - offset).as_vec3().to_array()).collect();
    (rounded, offset)
}

/// Drops the faces that have a vertex that is not finite, and those vertices.
fn drop_non_finite(mesh: &mut Mesh, faces: &[u32], numbers: &[u32], notes: &mut Vec<Note>) {
    let is_finite = |p: &[f32; 3]| p.iter().all(|v| v.is_finite());
    if mesh.positions.iter().all(is_finite) {
        return;
    }
    let Mesh { positions, normals, uvs, triangles, attributes } = mesh;
    let bad_vertex = |t: &[u32; 3]| t.iter().copied().find(|&i| !is_finite(&positions[i as usize]));
    let first = triangles.iter().enumerate().find_map(|(i, t)| bad_vertex(t).map(|vertex| (i, vertex)));
    let before = triangles.len();
    let keep: Vec<bool> = triangles.iter().map(|t| bad_vertex(t).is_none()).collect();
    attributes::retain(attributes, AttributeDomain::Face, &keep);
    retain(triangles, &keep);
    if let Some((index, vertex)) = first {
        let in_file =
            |own: usize, numbers: &[u32]| numbers.get(own).map_or(own + 1, |number| *number as usize);
        let (face, vertex) = (in_file(index, faces), in_file(vertex as usize, numbers));
        let dropped = before - triangles.len();
        let s = if dropped == 1 { "" } else { "s" };
        let message = format!(
            "{dropped} triangle{s} with vertices that are not finite numbers dropped, first face {face} with vertex {vertex}"
        );
        notes.push(Note { line: 0, message });
    }
    let mut kept = 0;
    let new_index: Vec<u32> = positions
        .iter()
        .map(|p| {
            let index = kept;
            kept += u32::from(is_finite(p));
            index
        })
        .collect();
    let keep: Vec<bool> = positions.iter().map(is_finite).collect();
    retain(positions, &keep);
    retain(normals, &keep);
    retain(uvs, &keep);
    attributes::retain(attributes, AttributeDomain::Vertex, &keep);
    triangles.iter_mut().flatten().for_each(|index| *index = new_index[*index as usize]);
}

/// Keeps the entries that `keep` marks; an empty list stays empty.
fn retain<T>(values: &mut Vec<T>, keep: &[bool]) {
    let mut marks = keep.iter();
    values.retain(|_| marks.next().is_some_and(|mark| *mark));
}

#[cfg(test)]
mod tests {
    use super::*;

    const SMOOTH: MeshOptions = MeshOptions { flip_tex_coords: false, face_normals: false };

    fn triangle(positions: Vec<[f64; 3]>) -> RawMesh {
        RawMesh { positions: Positions::Double(positions), triangles: vec![[0, 1, 2]], ..RawMesh::default() }
    }

    #[test]
    fn a_mesh_far_away_keeps_the_digits_of_its_file() {
        let positions = [[1e7 + 0.123, 0.5, -3.0], [1e7 + 1.456, 0.25, -3.1], [1e7 + 0.789, 1.75, -2.9]];
        let loaded = triangle(positions.to_vec()).finish(SMOOTH);
        for (rounded, exact) in loaded.mesh.positions.iter().zip(positions) {
            let back = DVec3::from(rounded.map(f64::from)) + loaded.offset;
            let error = (back - DVec3::from(exact)).abs().max_element();
            assert!(error < 1e-7, "{back} for {exact:?}");
        }
        // f32 alone is worse by far: this is what the offset is for
        assert!((f64::from((1e7 + 0.123) as f32) - (1e7 + 0.123)).abs() > 0.1);
    }

    #[test]
    fn a_mesh_near_its_origin_is_left_where_it_is() {
        let loaded = triangle(vec![[0.1, 0.2, 0.3], [1.1, 0.2, 0.3], [0.1, 1.2, 0.3]]).finish(SMOOTH);
        assert_eq!(loaded.offset, DVec3::ZERO);
        assert_eq!(loaded.mesh.positions[0], [0.1, 0.2, 0.3]);
    }

    #[test]
    fn a_face_with_a_nan_goes_with_its_vertex_and_is_named() {
        let mut raw =
            triangle(vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [f64::NAN, 0.0, 0.0], [1.0, 1.0, 0.0]]);
        raw.triangles = vec![[0, 1, 2], [1, 3, 2], [1, 4, 2]];
        raw.uvs = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.5], [1.0, 1.0]];
        let loaded = raw.finish(SMOOTH);
        assert_eq!(loaded.mesh.triangles, [[0, 1, 2], [1, 3, 2]]);
        assert_eq!(loaded.mesh.positions.len(), 4);
        assert_eq!(loaded.mesh.uvs[3], [1.0, 1.0]);
        assert!(loaded.notes[0].message.contains("first face 2 with vertex 4"), "{:?}", loaded.notes);
    }

    #[test]
    fn coordinates_beyond_f32_are_not_finite() {
        let loaded = triangle(vec![[0.0; 3], [1e300, 0.0, 0.0], [0.0, 1.0, 0.0]]).finish(SMOOTH);
        assert!(loaded.mesh.triangles.is_empty());
        assert!(loaded.mesh.positions.iter().flatten().all(|v| v.is_finite()));
    }
}
