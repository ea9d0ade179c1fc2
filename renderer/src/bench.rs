//! The ray queries, opened for `benches/traversal.rs` alone: no part of the interface.

use std::path::Path;

use glam::{DVec3, Vec3};
use limpid_scenes::Scene;

use crate::accel::{Accel, Prims};
pub use crate::accel::{Hit, NONE, Ray};
#[cfg(feature = "embree")]
pub use crate::embree::Embree;
use crate::geometry::Geometry;

/// The triangles of a scene's own shapes that emit nothing, in world space and in their order.
pub fn triangles(scene: &Scene) -> Vec<[Vec3; 3]> {
    let geometry = Geometry::new(scene, DVec3::ZERO);
    let emits = |prim: u32| scene.shapes[geometry.shape_of(prim) as usize].emission.is_some();
    let own = geometry.groups.first().map_or(geometry.triangles.len() as u32, |group| group.triangles.start);
    (0..own).filter(|&prim| !emits(prim)).map(|prim| geometry.corners(prim)).collect()
}

/// Rays as `bench_embree.py --dump` writes them: origin, nearest distance (0), direction, farthest distance.
///
/// # Errors
///
/// Where the file cannot be read.
pub fn read_rays(path: &Path) -> std::io::Result<Vec<Ray>> {
    let ray = |f: [f32; 8]| Ray {
        t_max: f[7],
        ..Ray::new(Vec3::new(f[0], f[1], f[2]), Vec3::new(f[4], f[5], f[6]))
    };
    Ok(numbers::<8>(path)?.into_iter().map(|n| ray(n.map(f32::from_bits))).collect())
}

/// Hits as the same program writes them: distance and triangle.
///
/// # Errors
///
/// Where the file cannot be read.
pub fn read_hits(path: &Path) -> std::io::Result<Vec<(f32, u32)>> {
    Ok(numbers::<2>(path)?.into_iter().map(|[t, prim]| (f32::from_bits(t), prim)).collect())
}

fn numbers<const N: usize>(path: &Path) -> std::io::Result<Vec<[u32; N]>> {
    let bytes = std::fs::read(path)?;
    let number = |b: &[u8]| u32::from_le_bytes([b[0], b[1], b[2], b[3]]);
    Ok(bytes.chunks_exact(4 * N).map(|row| std::array::from_fn(|i| number(&row[4 * i..]))).collect())
}

/// The acceleration structure over triangles.
pub struct Ours(Accel);

impl Ours {
    /// Builds it.
    pub fn new(triangles: &[[Vec3; 3]]) -> Self {
        let prims =
            Prims { triangles, first_triangle: 0, analytics: &[], first_analytic: triangles.len() as u32 };
        Self(Accel::new(&prims, &[], &[]))
    }

    /// See [`Accel::closest`].
    pub fn closest(&self, rays: &[Ray], hits: &mut [Hit]) {
        self.0.closest(rays, hits);
    }

    /// See [`Accel::occluded`].
    pub fn occluded(&self, rays: &[Ray], blocked: &mut [bool]) {
        self.0.occluded(rays, blocked);
    }

    /// The same by the scalar kernel.
    pub fn closest_scalar(&self, rays: &[Ray], hits: &mut [Hit]) {
        self.0.closest_scalar(rays, hits);
    }

    /// The same by the scalar kernel.
    pub fn occluded_scalar(&self, rays: &[Ray], blocked: &mut [bool]) {
        self.0.occluded_scalar(rays, blocked);
    }

    /// What it holds.
    pub fn bytes(&self) -> usize {
        self.0.triangle_bytes()
    }
}

/// CPU seconds of this thread, as Linux counts them; NaN elsewhere.
pub fn cpu_seconds() -> f64 {
    let read = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = read.and_then(|text| text.split_whitespace().next()?.parse::<f64>().ok());
    nanoseconds.map_or(f64::NAN, |ns| ns * 1e-9)
}
