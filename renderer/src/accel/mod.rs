//! Ray queries: the only folder that knows obvhs.
//!
//! The interface takes whole arrays of rays, so that a traversal may interleave them. Every hit that
//! is returned has passed an exact inside test and has its distance from the plane equation in `f64`
//! (see [`triangle`]), so that there is no leak between triangles, no scene-dependent epsilon and no `t_min`.

mod analytic;
mod build;
mod kernel;
mod triangle;

use glam::{DAffine3, Vec3};

use analytic::Analytics;
pub use analytic::{Analytic, AnalyticKind};
use build::Bounds;
use kernel::Tree;
use triangle::TriangleBlock;

/// "No primitive": a miss, or a ray that ignores nothing.
pub const NONE: u32 = u32::MAX;

/// A ray; `d` is unit, so that `t` is a length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Origin in render space.
    pub o: Vec3,
    /// Nothing at this distance or farther is hit.
    pub t_max: f32,
    /// Unit direction; no component is −0.0.
    pub d: Vec3,
    /// A primitive that is not there for this ray, or [`NONE`].
    pub skip: u32,
}

impl Ray {
    /// An unbounded ray. A −0.0 in `d` becomes +0.0, so that equal directions take equal ways.
    pub fn new(o: Vec3, d: Vec3) -> Self {
        Self { o, t_max: f32::INFINITY, d: d + Vec3::ZERO, skip: NONE }
    }
}

/// What a ray hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance; infinite for a miss.
    pub t: f32,
    /// Triangles count from 0 in the order given to [`Accel::build`], analytic shapes follow; [`NONE`]: a miss.
    pub prim: u32,
    /// Barycentric coordinate of the triangle's second vertex.
    pub u: f32,
    /// Barycentric coordinate of the triangle's third vertex.
    pub v: f32,
}

impl Hit {
    /// Nothing was hit.
    pub const MISS: Self = Self { t: f32::INFINITY, prim: NONE, u: 0.0, v: 0.0 };

    /// Nearer, or equally far and declared earlier: one rule for all pixels where surfaces coincide.
    #[inline(always)]
    fn beaten_by(&self, t: f32, prim: u32) -> bool {
        t < self.t || (t == self.t && prim < self.prim)
    }
}

/// The acceleration structure of a scene.
pub struct Accel {
    triangles: Tree<TriangleBlock>,
    analytics: Tree<Analytics>,
    bounds: Bounds,
}

impl Accel {
    /// Builds over triangles (three corners each, finite) and analytic shapes.
    pub fn build(triangles: &[[Vec3; 3]], analytics: &[Analytic]) -> Self {
        let first_analytic = triangles.len() as u32;
        let triangle_bounds: Vec<Bounds> = triangles.iter().map(|t| Bounds::of_points(t)).collect();
        let analytic_bounds: Vec<Bounds> = analytics.iter().map(Analytic::bounds).collect();
        let mut bounds = Bounds::EMPTY;
        triangle_bounds.iter().chain(&analytic_bounds).for_each(|b| bounds = bounds.union(b));
        Self {
            triangles: build::wide_tree(&triangle_bounds, |prims| TriangleBlock::new(triangles, prims)),
            analytics: build::wide_tree(&analytic_bounds, |prims| {
                Analytics::new(analytics, first_analytic, prims)
            }),
            bounds,
        }
    }

    /// The nearest hit of each ray before its `t_max`. Both slices have the same length.
    pub fn closest(&self, rays: &[Ray], hits: &mut [Hit]) {
        for (ray, hit) in rays.iter().zip(hits.iter_mut()) {
            *hit = Hit { t: ray.t_max, ..Hit::MISS };
        }
        kernel::closest(&self.triangles, rays, hits);
        if !self.analytics.is_empty() {
            kernel::closest(&self.analytics, rays, hits);
        }
        for hit in hits {
            if hit.prim == NONE {
                hit.t = f32::INFINITY;
            }
        }
    }

    /// Whether anything lies on each ray before its `t_max`. Both slices have the same length.
    pub fn occluded(&self, rays: &[Ray], blocked: &mut [bool]) {
        blocked.fill(false);
        kernel::occluded(&self.triangles, rays, blocked);
        if !self.analytics.is_empty() {
            kernel::occluded(&self.analytics, rays, blocked);
        }
    }

    /// Radius of a sphere around everything; 0 for an empty scene.
    pub fn radius(&self) -> f64 {
        self.bounds.radius()
    }
}

/// An affine map and its inverse in `f64`.
#[derive(Clone, Copy, Debug)]
pub struct Frame64 {
    /// From object space to render space.
    pub render_from_object: DAffine3,
    /// Its inverse.
    pub object_from_render: DAffine3,
}

#[cfg(test)]
mod tests;
