//! Ray queries: the only folder that knows obvhs.
//!
//! The interface takes whole arrays of rays, so that a traversal may interleave them. Every hit that
//! is returned has passed an exact inside test and has its distance from the plane equation in `f64`
//! (see [`triangle`]), so that there is no leak between triangles, no scene-dependent epsilon and no `t_min`.
//!
//! From obvhs's binary tree [`build`] makes one with eight children a node, whose boxes are rounded outwards to 8 bits ([`kernel`]:
//! a node is two cache lines), and whose leaves hold up to four triangles that share up to eight corners ([`triangle`]:
//! two more). 32 rays go through it at a time (`kernel/batch.rs`), so that none waits for memory. What was tried and what
//! each idea gave is in `docs/speed.md`.

mod analytic;
mod build;
mod instance;
mod kernel;
mod triangle;

use std::sync::Arc;

use glam::{DAffine3, DVec3, Vec3};

use analytic::Analytics;
pub use analytic::{Analytic, AnalyticKind};
pub use build::Bounds;
use instance::Placed;
pub use instance::{Instance, image};
use kernel::Query::{Closest, Occluded};
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
    /// As numbered by `Prims`; [`NONE`]: a miss.
    pub prim: u32,
    /// Barycentric coordinate of the triangle's second vertex.
    pub u: f32,
    /// Barycentric coordinate of the triangle's third vertex.
    pub v: f32,
    /// The instance through which it was hit, or [`NONE`].
    pub instance: u32,
}

impl Hit {
    /// Nothing was hit.
    pub const MISS: Self = Self { t: f32::INFINITY, prim: NONE, u: 0.0, v: 0.0, instance: NONE };

    /// Nearer, or equally far and declared earlier: one rule for all pixels where surfaces coincide.
    #[inline(always)]
    fn beaten_by(&self, t: f32, prim: u32) -> bool {
        t < self.t || (t == self.t && prim < self.prim)
    }
}

/// Primitives in one space, with their ids.
pub struct Prims<'a> {
    /// Three corners each, finite.
    pub triangles: &'a [[Vec3; 3]],
    /// Id of the first triangle; the others count on.
    pub first_triangle: u32,
    /// Spheres and the like.
    pub analytics: &'a [Analytic],
    /// Id of the first of them.
    pub first_analytic: u32,
}

/// The trees over primitives of one space.
struct Level {
    triangles: Tree<TriangleBlock>,
    analytics: Tree<Analytics>,
    bounds: Bounds,
    /// Of the sphere around the box.
    center: DVec3,
    radius: f64,
}

impl Level {
    fn build(prims: &Prims) -> Self {
        let triangle_bounds: Vec<Bounds> = prims.triangles.iter().map(|t| Bounds::of_points(t)).collect();
        let analytic_bounds: Vec<Bounds> = prims.analytics.iter().map(Analytic::bounds).collect();
        let mut bounds = Bounds::EMPTY;
        triangle_bounds.iter().chain(&analytic_bounds).for_each(|b| bounds = bounds.union(b));
        Self {
            triangles: build::wide_tree(
                &triangle_bounds,
                |indices| TriangleBlock::fits(prims.triangles, indices),
                |indices| TriangleBlock::new(prims.triangles, prims.first_triangle, indices),
            ),
            analytics: build::wide_tree(
                &analytic_bounds,
                |_| true,
                |indices| Analytics::new(prims.analytics, prims.first_analytic, indices),
            ),
            bounds,
            center: 0.5 * (bounds.min.as_dvec3() + bounds.max.as_dvec3()),
            radius: bounds.radius(),
        }
    }

    fn is_empty(&self) -> bool {
        self.triangles.is_empty() && self.analytics.is_empty()
    }
}

/// The acceleration structure of a scene.
pub struct Accel {
    top: Level,
    /// Empty in scenes without, which then pay nothing for them.
    instances: Tree<Placed>,
    bounds: Bounds,
}

impl Accel {
    /// Builds over primitives in render space, groups of others and instances that show these.
    pub fn new(top: &Prims, groups: &[Prims], instances: &[Instance]) -> Self {
        let top = Level::build(top);
        let groups: Vec<Arc<Level>> = groups.iter().map(|group| Arc::new(Level::build(group))).collect();
        let mut bounds = top.bounds;
        // A group of nothing has no box.
        let shown: Vec<u32> = (0..instances.len() as u32)
            .filter(|&i| !groups[instances[i as usize].group as usize].is_empty())
            .collect();
        let boxes: Vec<Bounds> = shown
            .iter()
            .map(|&i| {
                let Instance { group, render_from_group, .. } = &instances[i as usize];
                image(&groups[*group as usize].bounds, render_from_group)
            })
            .collect();
        boxes.iter().for_each(|b| bounds = bounds.union(b));
        let place = |indices: &[u32]| {
            let index = shown[indices[0] as usize];
            let instance = &instances[index as usize];
            Placed::new(instance, index, &groups[instance.group as usize])
        };
        let instances = build::wide_tree(&boxes, |_| true, place);
        Self { top, instances, bounds }
    }

    /// Builds over triangles and analytic shapes, numbered in this order.
    #[cfg(test)]
    pub fn build(triangles: &[[Vec3; 3]], analytics: &[Analytic]) -> Self {
        let first_analytic = triangles.len() as u32;
        Self::new(&Prims { triangles, first_triangle: 0, analytics, first_analytic }, &[], &[])
    }

    /// The nearest hit of each ray before its `t_max`. Both slices have the same length.
    pub fn closest(&self, rays: &[Ray], hits: &mut [Hit]) {
        for (ray, hit) in rays.iter().zip(hits.iter_mut()) {
            *hit = Hit { t: ray.t_max, ..Hit::MISS };
        }
        kernel::interleaved(&self.top.triangles, rays, Closest(hits));
        if !self.top.analytics.is_empty() {
            kernel::one_by_one(&self.top.analytics, rays, Closest(hits));
        }
        if !self.instances.is_empty() {
            kernel::one_by_one(&self.instances, rays, Closest(hits));
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
        kernel::interleaved(&self.top.triangles, rays, Occluded(blocked));
        if !self.top.analytics.is_empty() {
            kernel::one_by_one(&self.top.analytics, rays, Occluded(blocked));
        }
        if !self.instances.is_empty() {
            kernel::one_by_one(&self.instances, rays, Occluded(blocked));
        }
    }

    /// [`closest`](Self::closest) of the triangles by the scalar kernel.
    #[cfg(feature = "bench")]
    pub fn closest_scalar(&self, rays: &[Ray], hits: &mut [Hit]) {
        for (ray, hit) in rays.iter().zip(hits.iter_mut()) {
            *hit = Hit { t: ray.t_max, ..Hit::MISS };
        }
        kernel::reference(&self.top.triangles, rays, Closest(hits));
        hits.iter_mut().filter(|hit| hit.prim == NONE).for_each(|hit| *hit = Hit::MISS);
    }

    /// [`occluded`](Self::occluded) of the triangles by the scalar kernel.
    #[cfg(feature = "bench")]
    pub fn occluded_scalar(&self, rays: &[Ray], blocked: &mut [bool]) {
        blocked.fill(false);
        kernel::reference(&self.top.triangles, rays, Occluded(blocked));
    }

    /// Size of the tree over the triangles with its leaves.
    #[cfg(feature = "bench")]
    pub fn triangle_bytes(&self) -> usize {
        self.top.triangles.bytes()
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
