//! Groups of primitives that instances show: a tree of instances, each of which leads into the trees of its group.
//!
//! A ray goes into a group's own space in `f64`. There it is rounded to `f32` at the point where it comes near the group,
//! so that the rounding is small against the group however far the ray has come. Which triangles it passes through is
//! decided for the rounded ray, the same for all of them, so that meshes stay watertight; distances are those
//! of the ray that is not rounded, so that they compare with those of everything else.

use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::build::Bounds;
use super::kernel::{Blocks, Isa, ShearedRay, Slabs, Stack, closest_along, occluded_along};
use super::{Hit, Level, NONE, Ray};

/// A group in a place.
#[derive(Clone, Copy, Debug)]
pub struct Instance {
    /// Index of the group.
    pub group: u32,
    /// Where it is.
    pub render_from_group: DAffine3,
    /// Triangles that are declared before it: where it coincides with them, they are seen.
    pub after: u32,
}

/// A leaf: one instance.
pub struct Placed {
    group: Arc<Level>,
    group_from_render: DAffine3,
    index: u32,
    after: u32,
}

/// A ray in the space of a group.
struct Inside {
    /// Rounded; its `t_max` is that of the true ray.
    ray: Ray,
    sheared: ShearedRay,
    slabs: Slabs<true>,
}

/// A box around the image of a box, rounded outwards.
pub fn image(bounds: &Bounds, map: &DAffine3) -> Bounds {
    let (min, max) = (bounds.min.as_dvec3(), bounds.max.as_dvec3());
    let corner = |i: usize| {
        let pick = |axis: usize| if i >> axis & 1 == 0 { min[axis] } else { max[axis] };
        map.transform_point3(DVec3::new(pick(0), pick(1), pick(2)))
    };
    let (low, high) = (0..8)
        .map(corner)
        .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
    // A few roundings of the sums above.
    let largest = map.matrix3.abs() * min.abs().max(max.abs()) + map.translation.abs();
    let slack = largest * (8.0 * f64::EPSILON);
    Bounds::outwards(low - slack, high + slack)
}

impl Placed {
    pub fn new(instance: &Instance, index: u32, group: &Arc<Level>) -> Self {
        Self {
            group: Arc::clone(group),
            group_from_render: instance.render_from_group.inverse(),
            index,
            after: instance.after,
        }
    }

    /// The ray in the group's space; `None` where it has no direction there.
    #[inline(always)]
    fn enter(&self, ray: &Ray, outside: &ShearedRay) -> Option<Inside> {
        let o = self.group_from_render.transform_point3(outside.o64);
        let d = self.group_from_render.transform_vector3(outside.d64);
        let (center, radius) = (self.group.center, self.group.radius);
        // Distances at which the ray enters and leaves a sphere around the group if it went through its middle; they may
        // be too far apart, never too close.
        let length2 = d.length_squared();
        let middle = (center - o).dot(d) / length2;
        let reach = radius / length2.sqrt() * 1.001 + middle.abs() * 1e-12;
        let (start, end) = ((middle - reach).max(0.0), middle + reach);
        // A power of two, which changes no digit.
        let unit = power_of_two_near(d.abs().max_element())?.recip();
        let (from, along) = (o + start * d, d * unit);
        let rounded = Ray::new(from.as_vec3(), along.as_vec3());
        let inside = Ray { t_max: ray.t_max, skip: ray.skip, ..rounded };
        let farthest = ((end - start) / unit).max(0.0) as f32;
        let pad = f32::EPSILON * (inside.o.abs() + farthest * inside.d.abs());
        let distances = [start, unit];
        Some(Inside {
            sheared: ShearedRay { o64: o, d64: d, distances, ..ShearedRay::new(&inside) },
            slabs: Slabs::padded(&inside, pad.to_array(), distances),
            ray: inside,
        })
    }

    /// Whether it is seen in place of an equally far hit.
    #[inline(always)]
    fn comes_before(&self, hit: &Hit) -> bool {
        if hit.instance == NONE { self.after <= hit.prim } else { self.index < hit.instance }
    }
}

/// The largest power of two that is not above `x`; `None` where `x` is 0, infinite, no number, or nearly so.
#[inline(always)]
fn power_of_two_near(x: f64) -> Option<f64> {
    let exponent = x.to_bits() & (0x7ff << 52);
    let power = f64::from_bits(exponent);
    (power.is_normal() && power.recip().is_normal()).then_some(power)
}

impl Blocks for Placed {
    const MOST: usize = 1;

    #[inline(always)]
    fn closest<I: Isa>(
        &self,
        isa: I,
        ray: &Ray,
        sheared: &ShearedRay,
        stack: &mut Stack,
        base: usize,
        hit: &mut Hit,
    ) {
        let Some(Inside { ray, sheared, slabs }) = self.enter(ray, sheared) else { return };
        let mut inner = Hit { t: hit.t, ..Hit::MISS };
        if !self.group.triangles.is_empty() {
            closest_along(isa, &self.group.triangles, &ray, &slabs, &sheared, stack, base, &mut inner);
        }
        if !self.group.analytics.is_empty() {
            closest_along(isa, &self.group.analytics, &ray, &slabs, &sheared, stack, base, &mut inner);
        }
        if inner.prim != NONE && (inner.t < hit.t || self.comes_before(hit)) {
            *hit = Hit { instance: self.index, ..inner };
        }
    }

    #[inline(always)]
    fn occluded<I: Isa>(
        &self,
        isa: I,
        ray: &Ray,
        sheared: &ShearedRay,
        stack: &mut Stack,
        base: usize,
    ) -> bool {
        let Some(Inside { ray, sheared, slabs }) = self.enter(ray, sheared) else { return false };
        let Level { triangles, analytics, .. } = &*self.group;
        (!triangles.is_empty() && occluded_along(isa, triangles, &ray, &slabs, &sheared, stack, base))
            || (!analytics.is_empty() && occluded_along(isa, analytics, &ray, &slabs, &sheared, stack, base))
    }

    fn stack_need(&self) -> usize {
        self.group.triangles.stack_need.max(self.group.analytics.stack_need).max(1)
    }
}

#[cfg(test)]
mod tests;
