//! Meshes of nodes become shapes, one a primitive. Shapes that show the same primitive share its triangles.

use std::sync::Arc;

use glam::DMat4;

use super::Reader;
use super::deform::Skin;
use super::json::Item;
use super::nodes::Nodes;
use crate::mesh::LoadedMesh;
use crate::{Emission, SceneError, Shape, ShapeKind};

/// Shapes that a file may show: a primitive at a node costs the file a few bytes at least.
const SHAPES_A_BYTE: usize = 4;

/// What makes two primitives the same but for their material.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct MeshKey {
    /// Attributes, indices, mode and morph targets as the file writes them.
    text: String,
    /// Weights of the morph targets, as bits.
    weights: Vec<u32>,
    uv_set: u32,
    /// The node, where a skin moves the primitive.
    node: Option<usize>,
}

impl Reader<'_> {
    /// All primitives of a mesh at a node.
    pub(super) fn mesh(
        &mut self,
        node_index: usize,
        node: &Item<'_>,
        index: usize,
        world: DMat4,
        nodes: &Nodes,
    ) -> Result<(), SceneError> {
        let item = self.document.entry("meshes", index)?;
        let weights = match node.number_list("weights")? {
            Some(weights) => weights,
            None => item.number_list("weights")?.unwrap_or_default(),
        };
        let weights: Vec<f32> = weights.into_iter().map(|weight| weight as f32).collect();
        let skin = match node.index("skin", "skins")? {
            Some(skin) => Some(self.skin(skin, nodes)?),
            None => None,
        };
        let places = match (node.extension("EXT_mesh_gpu_instancing")?, &skin) {
            (Some(instances), None) => self.instances(&instances, world)?,
            // a skin says itself where its vertices are
            (_, Some(_)) => vec![DMat4::IDENTITY],
            (None, None) => vec![world],
        };
        let name = match node.get("name") {
            Some(_) => node.name_or("node", node_index),
            None => item.name_or("mesh", index),
        };
        let count = item.count("primitives");
        for number in 0..count {
            let primitive = item.nth("primitives", number)?;
            let name = if count == 1 { name.clone() } else { format!("{name} {}", number + 1) };
            let skin = skin.as_ref().map(|skin| (node_index, skin));
            self.primitive(&primitive, name, &weights, skin, &places)?;
        }
        Ok(())
    }

    fn primitive(
        &mut self,
        item: &Item<'_>,
        name: String,
        weights: &[f32],
        skin: Option<(usize, &Skin)>,
        places: &[DMat4],
    ) -> Result<(), SceneError> {
        if item.extension("KHR_materials_variants")?.is_some() {
            self.warn("extensions.KHR_materials_variants", "the default materials are shown, no variant");
        }
        let has_color = item.object("attributes")?.is_some_and(|a| a.get("COLOR_0").is_some());
        let surface = self.surface(item.index("material", "materials")?, has_color)?;
        let has_targets = item.get("targets").is_some();
        let key = MeshKey {
            text: item.text_of(&["attributes", "indices", "mode", "targets"]),
            weights: weights.iter().filter(|_| has_targets).map(|weight| weight.to_bits()).collect(),
            uv_set: surface.uv_set,
            node: skin.map(|(node, _)| node),
        };
        let loaded = match self.meshes.get(&key) {
            Some(known) => known.clone(),
            None => {
                let loaded = self.triangles(item, weights, skin.map(|(_, skin)| skin), surface.uv_set)?;
                for note in &loaded.notes {
                    self.warn(&item.path, note.message.clone());
                }
                self.meshes.insert(key, loaded.clone());
                loaded
            }
        };
        let LoadedMesh { mesh, offset, .. } = loaded;
        if mesh.triangles.is_empty() {
            return Ok(()); // said where the mesh was made
        }
        for place in places {
            if !place.is_finite() {
                self.warn(&item.path, "a place that is not finite; the shape is left out there");
                continue;
            }
            if self.scene.shapes.len() >= SHAPES_A_BYTE * self.file_bytes.len() {
                let problem = "shown more often than the size of the file makes sense of";
                return Err(item.error("", problem, "show fewer copies"));
            }
            let emission =
                surface.emission.map(|radiance| Emission { name: None, radiance, place: self.place() });
            self.scene.shapes.push(Shape {
                name: name.clone(),
                kind: ShapeKind::Mesh(Arc::clone(&mesh)),
                world_from_object: *place * DMat4::from_translation(offset),
                flip_normals: false,
                material: surface.material,
                emission,
                interior: None,
                exterior: None,
                place: self.place(),
            });
        }
        Ok(())
    }

    /// The places of EXT_mesh_gpu_instancing: each its own translation, rotation and scale, within the node.
    fn instances(&mut self, item: &Item<'_>, world: DMat4) -> Result<Vec<DMat4>, SceneError> {
        let Some(attributes) = item.object("attributes")? else { return Ok(vec![world]) };
        let mut columns = Vec::new();
        for name in ["TRANSLATION", "ROTATION", "SCALE"] {
            columns.push(match attributes.index(name, "accessors")? {
                Some(accessor) => Some(self.floats(accessor)?),
                None => None,
            });
        }
        let count = columns.iter().flatten().map(|floats| floats.len()).min().unwrap_or(0);
        self.take((size_of::<DMat4>() * count) as u64, item)?;
        let place = |i: usize| {
            let wide = |v: [f32; 3]| glam::DVec3::from(v.map(f64::from));
            let translation = columns[0].as_ref().map_or(glam::DVec3::ZERO, |c| wide(c.get(i)));
            let rotation = columns[1]
                .as_ref()
                .map_or(glam::DQuat::IDENTITY, |c| super::nodes::unit(c.get::<4>(i).map(f64::from)));
            let scale = columns[2].as_ref().map_or(glam::DVec3::ONE, |c| wide(c.get(i)));
            world * DMat4::from_scale_rotation_translation(scale, rotation, translation)
        };
        Ok((0..count).map(place).collect())
    }
}
