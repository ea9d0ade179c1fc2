//! Emissive shapes, as lights are made from them.

use glam::{DAffine3, Vec2, Vec3};
use limpid_scenes::Color;

/// An emissive shape in render space.
#[derive(Clone, Debug)]
pub struct LightShape {
    /// The shape's index.
    pub shape: u32,
    /// What emits.
    pub form: LightForm,
    /// Emitted radiance.
    pub emission: Color,
}

/// The form of an emissive shape.
#[derive(Clone, Debug)]
pub enum LightForm {
    /// With consecutive primitive ids.
    Triangles(Vec<LightTriangle>),
    /// A parallelogram.
    Rectangle(LightRectangle),
    /// The unit sphere under an affine map.
    Sphere(LightAnalytic),
    /// x² + y² = 1, 0 ≤ z ≤ 1 under an affine map.
    Cylinder(LightAnalytic),
    /// The unit disk in z = 0 under an affine map.
    Disk(LightAnalytic),
}

/// A triangle of an emissive mesh.
#[derive(Clone, Copy, Debug)]
pub struct LightTriangle {
    /// Counter-clockwise seen from the side that emits.
    pub corners: [Vec3; 3],
    /// Texture coordinates of the corners.
    pub uvs: [Vec2; 3],
    /// Its primitive id.
    pub prim: u32,
    /// The second and third corner have changed places, so that it is counter-clockwise.
    pub turned: bool,
}

/// A parallelogram of two triangles that share the diagonal through `corner`.
#[derive(Clone, Copy, Debug)]
pub struct LightRectangle {
    /// Where uv = (0, 0).
    pub corner: Vec3,
    /// To where uv = (1, 0).
    pub edge_u: Vec3,
    /// To where uv = (0, 1).
    pub edge_v: Vec3,
    /// Emits on the side of −(`edge_u` × `edge_v`).
    pub turned: bool,
    /// The triangles where u ≥ v and where not.
    pub prims: [u32; 2],
}

/// A sphere, a cylinder or a disk.
#[derive(Clone, Copy, Debug)]
pub struct LightAnalytic {
    /// Maps the unit shape into render space. A mirrored sphere or cylinder still emits outwards.
    pub render_from_unit: DAffine3,
    /// A sphere or cylinder that emits inwards, a disk that emits on the side of its −z.
    pub turned: bool,
    /// Its primitive id.
    pub prim: u32,
}
