//! Values that meshes carry at their vertices or triangles.

use std::sync::Arc;

use limpid_scenes::{AttributeDomain, Mesh, Scene, ShapeKind};

use super::TexturePoint;
use crate::color::Rgb;
use crate::geometry::triangle_count;

/// An attribute, with all meshes of the scene that have it.
pub struct Attribute {
    scale: f32,
    /// In the order of their triangles.
    meshes: Vec<Carrier>,
}

/// A mesh that has the attribute.
struct Carrier {
    /// Id of its first triangle.
    first: u32,
    mesh: Arc<Mesh>,
    /// Index among the mesh's attributes.
    attribute: usize,
}

impl Attribute {
    /// Looks for the attribute in the meshes of a scene and of its groups.
    pub fn new(scene: &Scene, name: &str, scale: f32) -> Self {
        let mut meshes = Vec::new();
        let mut first = 0;
        // Triangles are numbered in this order.
        for shape in scene.shapes.iter().chain(scene.groups.iter().flat_map(|group| &group.shapes)) {
            if let ShapeKind::Mesh(mesh) = &shape.kind
                && let Some(attribute) = mesh.attributes.iter().position(|a| a.name == name)
            {
                meshes.push(Carrier { first, mesh: Arc::clone(mesh), attribute });
            }
            first += triangle_count(shape) as u32;
        }
        Self { scale, meshes }
    }

    /// Interpolated over the triangle for vertices. One channel is grey; black where the mesh lacks the attribute.
    pub fn color(&self, at: &TexturePoint) -> Rgb {
        let before = self.meshes.partition_point(|carrier| carrier.first <= at.prim);
        let Some(Carrier { first, mesh, attribute }) = before.checked_sub(1).map(|i| &self.meshes[i]) else {
            return Rgb::ZERO;
        };
        let Some(triangle) = mesh.triangles.get((at.prim - first) as usize) else { return Rgb::ZERO };
        let attribute = &mesh.attributes[*attribute];
        let value = |index: u32| match attribute.channels {
            1 => Rgb::splat(attribute.values[index as usize]),
            _ => {
                let start = 3 * index as usize;
                Rgb::from_slice(&attribute.values[start..start + 3])
            }
        };
        let value = match attribute.domain {
            AttributeDomain::Face => value(at.prim - first),
            AttributeDomain::Vertex => {
                let [a, b, c] = triangle.map(value);
                (1.0 - at.bary.x - at.bary.y) * a + at.bary.x * b + at.bary.y * c
            }
        };
        value * self.scale
    }
}
