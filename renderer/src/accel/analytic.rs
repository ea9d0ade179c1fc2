//! Spheres and disks, intersected in `f64`.
//!
//! Each is the unit sphere or unit disk under an affine map, so that an ellipsoid is no special case, and a
//! ground sphere of radius 1e7 under a teapot keeps its digits.

use glam::{DVec3, Vec3};

use super::build::Bounds;
use super::kernel::{Blocks, ShearedRay};
use super::{Frame64, Hit, Ray};

/// The form in object space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AnalyticKind {
    /// |p| = 1.
    Sphere,
    /// z = 0, |p| ≤ 1.
    Disk,
}

/// A sphere or a disk in render space.
#[derive(Clone, Copy, Debug)]
pub struct Analytic {
    /// The form in object space.
    pub kind: AnalyticKind,
    /// Where it is.
    pub frame: Frame64,
}

impl Analytic {
    /// A box around it, rounded outwards.
    pub fn bounds(&self) -> Bounds {
        let m = self.frame.render_from_object;
        let (x, y, z) = (m.matrix3.x_axis, m.matrix3.y_axis, m.matrix3.z_axis);
        let z = if self.kind == AnalyticKind::Disk { DVec3::ZERO } else { z };
        let half = (x * x + y * y + z * z).map(f64::sqrt);
        let (min, max) = (m.translation - half, m.translation + half);
        Bounds {
            min: Vec3::from_array(min.to_array().map(round_down)),
            max: Vec3::from_array(max.to_array().map(round_up)),
        }
    }

    /// The nearest distance in (0, ∞).
    #[inline(always)]
    fn intersect(&self, ray: &Ray) -> Option<f64> {
        let o = self.frame.object_from_render.transform_point3(ray.o.as_dvec3());
        let d = self.frame.object_from_render.transform_vector3(ray.d.as_dvec3());
        match self.kind {
            AnalyticKind::Sphere => intersect_unit_sphere(o, d),
            AnalyticKind::Disk => {
                let t = -o.z / d.z;
                let p = o + t * d;
                (t > 0.0 && p.x * p.x + p.y * p.y <= 1.0).then_some(t)
            }
        }
    }
}

/// First positive root of |o + t d| = 1. The discriminant is taken at the point of closest approach, which
/// keeps its digits from afar, and the smaller root by division, which keeps them near the surface
/// (Hearn and Baker; Haines, Günther and Akenine-Möller 2019).
fn intersect_unit_sphere(o: DVec3, d: DVec3) -> Option<f64> {
    let a = d.length_squared();
    let b = -o.dot(d);
    let length = o.length();
    let c = (length - 1.0) * (length + 1.0);
    let closest = o + (b / a) * d;
    let discriminant = 1.0 - closest.length_squared();
    if discriminant < 0.0 || discriminant.is_nan() {
        return None;
    }
    let q = b + (a * discriminant).sqrt().copysign(b);
    let (t0, t1) = if b < 0.0 { (q / a, c / q) } else { (c / q, q / a) };
    // From inside, c < 0 and the roots have different signs; the order above holds in either case.
    if t0 > 0.0 { Some(t0) } else { (t1 > 0.0).then_some(t1) }
}

fn round_down(x: f64) -> f32 {
    let y = x as f32;
    if f64::from(y) > x { y.next_down() } else { y }
}

fn round_up(x: f64) -> f32 {
    let y = x as f32;
    if f64::from(y) < x { y.next_up() } else { y }
}

/// A leaf of analytic shapes.
#[derive(Clone, Debug)]
pub struct Analytics {
    shapes: Vec<(u32, Analytic)>,
}

impl Analytics {
    /// Gathers the shapes with these indices; `first` is the primitive id of shape 0.
    pub fn new(shapes: &[Analytic], first: u32, indices: &[u32]) -> Self {
        Self { shapes: indices.iter().map(|&i| (first + i, shapes[i as usize])).collect() }
    }
}

impl Blocks for Analytics {
    #[inline(always)]
    fn closest(&self, ray: &Ray, _: &ShearedRay, hit: &mut Hit) {
        for &(prim, shape) in &self.shapes {
            if let Some(t) = shape.intersect(ray).map(|t| t as f32)
                && prim != ray.skip
                && hit.beaten_by(t, prim)
                && t < ray.t_max
            {
                *hit = Hit { t, prim, u: 0.0, v: 0.0 };
            }
        }
    }

    #[inline(always)]
    fn occluded(&self, ray: &Ray, _: &ShearedRay) -> bool {
        self.shapes.iter().any(|(prim, shape)| {
            *prim != ray.skip && shape.intersect(ray).is_some_and(|t| (t as f32) < ray.t_max)
        })
    }
}
