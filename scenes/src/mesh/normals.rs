//! Vertex normals where a file gives none.

use glam::{DVec3, Vec3};

use crate::Mesh;

/// Computes the normals that are missing: all where the mesh has none, else those that are zero or not finite.
///
/// A normal is the sum of the unit normals of the faces around, weighted with their angles at the
/// vertex (Thürmer and Wüthrich 1998): how a flat patch is cut into triangles does not matter. Where that sum
/// is nothing, as at degenerate faces, +z stands in, so that a normal can always be normalised.
pub(super) fn complete(mesh: &mut Mesh) {
    let usable = |n: &[f32; 3]| {
        let n = Vec3::from(*n);
        n.is_finite() && n != Vec3::ZERO
    };
    if !mesh.normals.is_empty() && mesh.normals.iter().all(usable) {
        return;
    }
    let computed = angle_weighted(mesh);
    if mesh.normals.is_empty() {
        mesh.normals = computed;
        return;
    }
    for (normal, computed) in mesh.normals.iter_mut().zip(computed) {
        if !usable(normal) {
            *normal = computed;
        }
    }
}

/// In `f64`, where neither squares of the smallest `f32` lengths nor of the largest are lost.
fn angle_weighted(mesh: &Mesh) -> Vec<[f32; 3]> {
    let mut sums = vec![DVec3::ZERO; mesh.positions.len()];
    for triangle in &mesh.triangles {
        let corners = triangle.map(|i| DVec3::from(mesh.positions[i as usize].map(f64::from)));
        let Some(normal) = (corners[1] - corners[0]).cross(corners[2] - corners[0]).try_normalize() else {
            continue;
        };
        for i in 0..3 {
            let a = corners[(i + 1) % 3] - corners[i];
            let b = corners[(i + 2) % 3] - corners[i];
            // atan2 keeps its precision where the angle is near 0 or π, and needs no normalised edges
            let angle = a.cross(b).length().atan2(a.dot(b));
            sums[triangle[i] as usize] += angle * normal;
        }
    }
    sums.into_iter().map(|sum| sum.try_normalize().unwrap_or(DVec3::Z).as_vec3().to_array()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A corner of a cube whose three squares are cut so that the corner touches five triangles.
    fn cube_corner(scale: f32) -> Mesh {
        let positions = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 1, 1], [0, 0, 1], [1, 0, 1]];
        Mesh {
            positions: positions.iter().map(|p| p.map(|v| v as f32 * scale)).collect(),
            triangles: vec![[0, 2, 1], [0, 3, 2], [0, 4, 3], [0, 5, 4], [0, 1, 5], [1, 6, 5]],
            ..Mesh::default()
        }
    }

    #[test]
    fn a_corner_of_a_cube_points_along_its_diagonal_however_it_is_cut_and_scaled() {
        for scale in [1e-30, 1.0, 1e30] {
            let mut mesh = cube_corner(scale);
            complete(&mut mesh);
            let diagonal = Vec3::splat(-1.0).normalize();
            let normal = Vec3::from(mesh.normals[0]);
            assert!(normal.distance(diagonal) < 1e-6, "{normal} at scale {scale}");
        }
    }

    #[test]
    fn given_normals_stay_and_missing_ones_are_computed() {
        let mut mesh = cube_corner(1.0);
        mesh.normals = vec![[0.0, 0.0, 2.0]; 7];
        mesh.normals[0] = [0.0; 3];
        mesh.normals[1] = [f32::NAN; 3];
        complete(&mut mesh);
        assert_eq!(mesh.normals[2], [0.0, 0.0, 2.0]);
        assert!(mesh.normals[0][0] < -0.5);
        assert!(mesh.normals[1].iter().all(|v| v.is_finite()));
    }

    #[test]
    fn a_vertex_of_degenerate_faces_has_a_unit_normal_all_the_same() {
        let mut mesh = Mesh { positions: vec![[1.0; 3]; 3], triangles: vec![[0, 1, 2]], ..Mesh::default() };
        complete(&mut mesh);
        assert_eq!(mesh.normals, [[0.0, 0.0, 1.0]; 3]);
    }
}
