//! Surfaces in the world: their forms and what they emit.

use std::sync::Arc;

use glam::{DMat4, DVec3};

use crate::{Color, GroupId, MaterialId, MediumId, Place};

/// A surface in the world.
#[derive(Clone, Debug)]
pub struct Shape {
    /// The file's id, or its kind and a number.
    pub name: String,
    /// Its form in object space.
    pub kind: ShapeKind,
    /// Affine.
    pub world_from_object: DMat4,
    /// Turns the geometric normal to the other side.
    pub flip_normals: bool,
    /// What it is made of.
    pub material: MaterialId,
    /// What it emits, on the side of its geometric normal only.
    pub emission: Option<Emission>,
    /// The medium on the side away from the normal.
    pub interior: Option<MediumId>,
    /// The medium on the side of the normal.
    pub exterior: Option<MediumId>,
    /// Where it stands.
    pub place: Place,
}

/// Shapes that instances show, at the cost of a transform each.
#[derive(Clone, Debug)]
pub struct Group {
    /// The file's id, or its kind and a number.
    pub name: String,
    /// In a space of their own, which is the object space of the instances. None of them emits or is an instance.
    pub shapes: Vec<Shape>,
    /// Where it stands.
    pub place: Place,
}

/// The form of a shape in object space.
#[derive(Clone, Debug)]
pub enum ShapeKind {
    /// Triangles; several shapes may share one mesh.
    Mesh(Arc<Mesh>),
    /// Normal outwards; u is the longitude from +x towards +y over 2π, v the angle from +z over π.
    Sphere {
        /// In object space.
        center: DVec3,
        /// Positive.
        radius: f64,
    },
    /// Open at both ends, normal outwards; u is the angle around the axis over 2π, counted in the frame that Duff et
    /// al. (2017) put around it (from +x towards +y for an axis along +z), v runs from 0 at `p0` to 1 at `p1`.
    Cylinder {
        /// Centre of one end, in object space.
        p0: DVec3,
        /// Centre of the other, not the same.
        p1: DVec3,
        /// Positive.
        radius: f64,
    },
    /// The shapes of a group, with their materials and normals; the instance's own count for nothing.
    Instance {
        /// What it shows.
        group: GroupId,
    },
    /// Unit disk in z = 0, normal +z; u is the radius, v the angle from +x over 2π.
    Disk,
    /// \[−1, 1\]² in z = 0, normal +z; uv from (0, 0) at (−1, −1) to (1, 1) at (1, 1).
    Rectangle,
    /// \[−1, 1\]³, normals outwards, each face with uv over \[0, 1\]²:
    ///
    /// ```text
    /// face    2u − 1   2v − 1
    /// x = −1     y        z
    /// x = +1     y       −z
    /// y = −1     z        x
    /// y = +1    −x       −z
    /// z = −1    −y        x
    /// z = +1     y        x
    /// ```
    Cube,
}

/// A triangle mesh. All vertices are finite, all indices in range: readers drop what is not, with a warning.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertex positions in object space.
    pub positions: Vec<[f32; 3]>,
    /// One a vertex, finite and not zero, not necessarily unit; empty: flat faces.
    pub normals: Vec<[f32; 3]>,
    /// One a vertex, finite; empty: the barycentric coordinates of each face stand in.
    pub uvs: Vec<[f32; 2]>,
    /// Counter-clockwise seen from the side of the normal.
    pub triangles: Vec<[u32; 3]>,
    /// What textures of the kind [`MeshAttribute`](crate::TextureKind::MeshAttribute) look up.
    pub attributes: Vec<MeshAttribute>,
}

/// Values that a mesh carries beside its form, such as vertex colours.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshAttribute {
    /// With the prefix `vertex_` or `face_`.
    pub name: String,
    /// What has a value.
    pub domain: AttributeDomain,
    /// Numbers of a value: 1 or 3.
    pub channels: u32,
    /// Finite; `channels` for each vertex or triangle, in their order.
    pub values: Vec<f32>,
}

/// What the values of a [`MeshAttribute`] belong to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AttributeDomain {
    /// Each vertex has one; they are interpolated over a triangle.
    Vertex,
    /// Each triangle has one.
    Face,
}

/// Emitted radiance of a surface.
#[derive(Clone, Debug)]
pub struct Emission {
    /// The emitter's id where it has one; what `--light-groups` will take.
    pub name: Option<String>,
    /// W·sr⁻¹·m⁻² per channel.
    pub radiance: Color,
    /// Where it stands.
    pub place: Place,
}
