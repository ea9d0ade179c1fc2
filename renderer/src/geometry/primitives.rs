//! Built-in shapes as meshes.

use limpid_scenes::Mesh;

/// \[−1, 1\]² in z = 0, facing +z.
pub fn rectangle() -> Mesh {
    Mesh {
        positions: vec![[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]],
        normals: Vec::new(),
        uvs: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
        triangles: vec![[0, 1, 2], [2, 3, 0]],
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
    }
}
