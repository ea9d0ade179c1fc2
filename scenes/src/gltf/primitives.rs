//! Triangles of a primitive: its attributes, deformed, only the vertices that it uses.

use std::sync::Arc;

use glam::DVec3;

use super::Reader;
use super::accessors::Floats;
use super::deform::{Bound, Skin};
use super::json::Item;
use super::materials::VERTEX_COLOR;
use crate::mesh::{LoadedMesh, MeshOptions, Note, Positions, RawMesh};
use crate::{AttributeDomain, MeshAttribute, SceneError};

/// Vertices of a primitive, before those that no triangle uses are dropped.
struct Vertices {
    positions: Vec<[f32; 3]>,
    normals: Option<Vec<[f32; 3]>>,
}

impl Reader<'_> {
    /// Reads a primitive. A list of points or lines gives an empty mesh, with a warning.
    pub(super) fn triangles(
        &mut self,
        item: &Item<'_>,
        weights: &[f32],
        skin: Option<&Skin>,
        uv_set: u32,
    ) -> Result<LoadedMesh, SceneError> {
        let empty = || LoadedMesh { mesh: Arc::default(), offset: DVec3::ZERO, notes: Vec::new() };
        let mode = item.unsigned("mode")?.unwrap_or(4);
        if !(4..=6).contains(&mode) {
            let what = if mode == 0 { "points" } else { "lines" };
            self.warn(&item.path, format!("{what} are not rendered; they are left out"));
            return Ok(empty());
        }
        let attributes = item.object("attributes")?;
        let Some(positions) = self.attribute(attributes.as_ref(), "POSITION", None)? else {
            self.warn(&item.path, "no POSITION; the primitive is left out");
            return Ok(empty());
        };
        let count = positions.len();
        let normals = self.attribute(attributes.as_ref(), "NORMAL", Some(count))?;
        let uvs = self.attribute(attributes.as_ref(), &format!("TEXCOORD_{uv_set}"), Some(count))?;
        let colors = self.attribute(attributes.as_ref(), "COLOR_0", Some(count))?;
        self.take(72 * count as u64, item)?;
        let mut vertices =
            Vertices { positions: positions.rows(), normals: normals.map(|normals| normals.rows()) };
        self.morph(item, weights, &mut vertices)?;

        let indices = match item.index("indices", "accessors")? {
            Some(accessor) => self.unsigned(accessor)?,
            None => (0..count as u32).collect(),
        };
        self.take(12 * indices.len() as u64, item)?;
        let mut triangles = triangles_of(mode, &indices);
        let all = triangles.len();
        triangles.retain(|t| t.iter().all(|&i| (i as usize) < count));
        let mut notes = Vec::new();
        if triangles.len() < all {
            let dropped = all - triangles.len();
            let message = format!("{dropped} triangles with vertices beyond the last one, {count}, dropped");
            notes.push(Note { line: 0, message });
        }
        if triangles.is_empty() {
            self.warn(&item.path, "no triangles; the primitive is left out");
            return Ok(LoadedMesh { notes, ..empty() });
        }
        let used = compact(&mut triangles, count);
        let pick = |rows: Vec<[f32; 3]>| -> Vec<[f32; 3]> {
            match &used {
                Some(used) => used.iter().map(|&i| rows[i as usize]).collect(),
                None => rows,
            }
        };
        let Vertices { positions, normals } = vertices;
        let (positions, mut normals) = (pick(positions), normals.map(pick));
        let positions = match skin {
            None => Positions::Single(positions),
            Some(skin) => {
                let bound = self.bound(attributes.as_ref(), count)?;
                Positions::Double(pose(skin, &bound, used.as_deref(), &positions, &mut normals))
            }
        };
        let uvs = uvs.map_or(Vec::new(), |uvs| match &used {
            Some(used) => used.iter().map(|&i| uvs.get(i as usize)).collect(),
            None => uvs.rows(),
        });
        let colors = colors.map(|colors| {
            let color = |i: usize| colors.get::<3>(i);
            MeshAttribute {
                name: VERTEX_COLOR.into(),
                domain: AttributeDomain::Vertex,
                channels: 3,
                values: match &used {
                    Some(used) => used.iter().flat_map(|&i| color(i as usize)).collect(),
                    None => (0..count).flat_map(color).collect(),
                },
            }
        });
        let has_normals = normals.is_some();
        let raw = RawMesh {
            positions,
            normals: normals.unwrap_or_default(),
            uvs,
            triangles,
            attributes: colors.into_iter().collect(),
            notes,
            ..RawMesh::default()
        };
        // without normals, faces are flat (specification, 3.7.2.1)
        Ok(raw.finish(MeshOptions { flip_tex_coords: false, face_normals: !has_normals }))
    }

    /// An attribute of the vertices, which must have `count` elements where that is said.
    pub(super) fn attribute(
        &mut self,
        attributes: Option<&Item<'_>>,
        name: &str,
        count: Option<usize>,
    ) -> Result<Option<Arc<Floats>>, SceneError> {
        let Some(attributes) = attributes else { return Ok(None) };
        let Some(accessor) = attributes.index(name, "accessors")? else { return Ok(None) };
        let floats = self.floats(accessor)?;
        match count {
            Some(count) if count != floats.len() => {
                let problem = format!("{} elements for {count} vertices", floats.len());
                Err(attributes.error(name, problem, super::json::EXPORT_AGAIN))
            }
            _ => Ok(Some(floats)),
        }
    }

    /// Adds the morph targets with their weights.
    fn morph(&mut self, item: &Item<'_>, weights: &[f32], vertices: &mut Vertices) -> Result<(), SceneError> {
        for (target, &weight) in weights.iter().enumerate().take(item.count("targets")) {
            if weight == 0.0 {
                continue;
            }
            let target = item.nth("targets", target)?;
            let count = Some(vertices.positions.len());
            let add = |rows: &mut [[f32; 3]], delta: &Floats| {
                for (i, row) in rows.iter_mut().enumerate() {
                    let delta: [f32; 3] = delta.get(i);
                    *row = std::array::from_fn(|c| row[c] + weight * delta[c]);
                }
            };
            if let Some(delta) = self.attribute(Some(&target), "POSITION", count)? {
                add(&mut vertices.positions, &delta);
            }
            if let Some(normals) = &mut vertices.normals
                && let Some(delta) = self.attribute(Some(&target), "NORMAL", count)?
            {
                add(normals, &delta);
            }
        }
        Ok(())
    }
}

/// Moves vertices and their normals to where a skin has them at rest, in world space.
fn pose(
    skin: &Skin,
    bound: &Bound,
    used: Option<&[u32]>,
    positions: &[[f32; 3]],
    normals: &mut Option<Vec<[f32; 3]>>,
) -> Vec<[f64; 3]> {
    let mut posed = Vec::with_capacity(positions.len());
    for (i, position) in positions.iter().enumerate() {
        let vertex = used.map_or(i, |used| used[i] as usize);
        let matrix = skin.matrix(bound, vertex);
        posed.push(matrix.transform_point3(DVec3::from(position.map(f64::from))).to_array());
        if let Some(normals) = normals {
            let normal =
                glam::DMat3::from_mat4(matrix).inverse().transpose() * DVec3::from(normals[i].map(f64::from));
            normals[i] = normal.try_normalize().unwrap_or(DVec3::ZERO).as_vec3().to_array();
        }
    }
    posed
}

/// Corners of the triangles of a list (4), strip (5) or fan (6), each with the same orientation.
pub(super) fn triangles_of(mode: u64, indices: &[u32]) -> Vec<[u32; 3]> {
    match mode {
        4 => indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
        5 => {
            let turned =
                |(i, t): (usize, &[u32])| if i % 2 == 0 { [t[0], t[1], t[2]] } else { [t[1], t[0], t[2]] };
            indices.windows(3).enumerate().map(turned).collect()
        }
        _ => match indices.split_first() {
            Some((&first, rest)) => rest.windows(2).map(|t| [first, t[0], t[1]]).collect(),
            None => Vec::new(),
        },
    }
}

/// Numbers the vertices that are used anew; gives their old numbers, or `None` where all of `count` are used.
///
/// Many writers let all primitives of a model share one list of vertices.
fn compact(triangles: &mut [[u32; 3]], count: usize) -> Option<Vec<u32>> {
    let mut used: Vec<u32> = triangles.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    if used.len() == count {
        return None;
    }
    for index in triangles.iter_mut().flatten() {
        *index = used.binary_search(index).expect("every index is in the list made of all") as u32;
    }
    Some(used)
}
