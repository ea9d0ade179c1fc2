//! Built-in shapes as meshes, and as maps of unit shapes.

use glam::{DMat4, DVec3};
use limpid_scenes::Mesh;

/// \[−1, 1\]² in z = 0, facing +z.
pub fn rectangle() -> Mesh {
    Mesh {
        positions: vec![[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]],
        normals: Vec::new(),
        uvs: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
        triangles: vec![[0, 1, 2], [2, 3, 0]],
        attributes: Vec::new(),
    }
}

/// \[−1, 1\]³, facing outwards; corner order and texture coordinates as in Mitsuba's `cube`, whose textures
/// would otherwise be turned.
pub fn cube() -> Mesh {
    #[rustfmt::skip]
    let corners: [[i8; 3]; 24] = [
        [1, -1, -1], [1, -1, 1], [-1, -1, 1], [-1, -1, -1],
        [1, 1, -1], [-1, 1, -1], [-1, 1, 1], [1, 1, 1],
        [1, -1, -1], [1, 1, -1], [1, 1, 1], [1, -1, 1],
        [1, -1, 1], [1, 1, 1], [-1, 1, 1], [-1, -1, 1],
        [-1, -1, 1], [-1, 1, 1], [-1, 1, -1], [-1, -1, -1],
        [1, 1, -1], [1, -1, -1], [-1, -1, -1], [-1, 1, -1],
    ];
    let face = |f: u32| [[4 * f, 4 * f + 1, 4 * f + 2], [4 * f + 3, 4 * f, 4 * f + 2]];
    Mesh {
        positions: corners.iter().map(|c| c.map(f32::from)).collect(),
        normals: Vec::new(),
        uvs: [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]].repeat(6),
        triangles: (0..6).flat_map(face).collect(),
        attributes: Vec::new(),
    }
}

/// Maps x² + y² = 1, 0 ≤ z ≤ 1 to the cylinder from `p0` to `p1`: around the axis, x and y are where Duff et al. (2017,
/// "Building an orthonormal basis, revisited") put them, as in Mitsuba, whose textures would otherwise be turned.
pub fn cylinder(p0: DVec3, p1: DVec3, radius: f64) -> DMat4 {
    let axis = p1 - p0;
    let n = axis.normalize_or(DVec3::Z);
    let sign = 1.0f64.copysign(n.z);
    let a = -1.0 / (sign + n.z);
    let b = n.x * n.y * a;
    let x = DVec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x);
    let y = DVec3::new(b, sign + n.y * n.y * a, -n.y);
    DMat4::from_cols((radius * x).extend(0.0), (radius * y).extend(0.0), axis.extend(0.0), p0.extend(1.0))
}
