//! Spheres, cylinders and disks, intersected in `f64`.
//!
//! Each is the unit sphere, cylinder or disk under an affine map, so that an ellipsoid is no special case, and a
//! ground sphere of radius 1e7 under a teapot keeps its digits.

use glam::DVec3;

use super::build::Bounds;
use super::kernel::{Blocks, Isa, ShearedRay, Stack};
use super::{Frame64, Hit, NONE, Ray};

/// The form in object space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AnalyticKind {
    /// |p| = 1.
    Sphere,
    /// x² + y² = 1, 0 ≤ z ≤ 1.
    Cylinder,
    /// z = 0, |p| ≤ 1.
    Disk,
}

/// A sphere, cylinder or disk in render space.
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
        let round = |v: DVec3| v.map(f64::sqrt);
        let (center, half) = match self.kind {
            AnalyticKind::Sphere => (m.translation, round(x * x + y * y + z * z)),
            AnalyticKind::Cylinder => (m.translation + 0.5 * z, round(x * x + y * y) + 0.5 * z.abs()),
            AnalyticKind::Disk => (m.translation, round(x * x + y * y)),
        };
        let (min, max) = (center - half, center + half);
        Bounds::outwards(min, max)
    }

    /// The nearest distance in (0, ∞).
    #[inline(always)]
    fn intersect(&self, ray: &ShearedRay) -> Option<f64> {
        let o = self.frame.object_from_render.transform_point3(ray.o64);
        let d = self.frame.object_from_render.transform_vector3(ray.d64);
        match self.kind {
            AnalyticKind::Sphere => intersect_unit_sphere(o, d),
            AnalyticKind::Cylinder => intersect_unit_cylinder(o, d),
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
    let [t0, t1] = roots(a, b, c, 1.0 - closest.length_squared())?;
    if t0 > 0.0 { Some(t0) } else { (t1 > 0.0).then_some(t1) }
}

/// First positive root of |o + t d| = 1 in the plane z = 0 at which 0 ≤ z ≤ 1; as for the sphere.
fn intersect_unit_cylinder(o: DVec3, d: DVec3) -> Option<f64> {
    let (o2, d2) = (o.truncate(), d.truncate());
    let a = d2.length_squared();
    let b = -o2.dot(d2);
    let length = o2.length();
    let c = (length - 1.0) * (length + 1.0);
    let closest = o2 + (b / a) * d2;
    let roots = roots(a, b, c, 1.0 - closest.length_squared())?;
    roots.into_iter().find(|&t| t > 0.0 && (0.0..=1.0).contains(&(o.z + t * d.z)))
}

/// Both roots of a t² − 2 b t + c = 0, the smaller first; `discriminant` is (b² − a c) / a.
fn roots(a: f64, b: f64, c: f64, discriminant: f64) -> Option<[f64; 2]> {
    if discriminant < 0.0 || discriminant.is_nan() {
        return None;
    }
    let q = b + (a * discriminant).sqrt().copysign(b);
    // From inside, c < 0 and the roots have different signs; the order holds in either case.
    Some(if b < 0.0 { [q / a, c / q] } else { [c / q, q / a] })
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
    const MOST: usize = 4;

    #[inline(always)]
    fn closest<I: Isa>(&self, _: I, ray: &Ray, sheared: &ShearedRay, _: &mut Stack, _: usize, hit: &mut Hit) {
        for &(prim, shape) in &self.shapes {
            if let Some(t) = shape.intersect(sheared).map(|t| t as f32)
                && prim != ray.skip
                && hit.beaten_by(t, prim)
                && t < ray.t_max
            {
                *hit = Hit { t, prim, u: 0.0, v: 0.0, instance: NONE };
            }
        }
    }

    #[inline(always)]
    fn occluded<I: Isa>(&self, _: I, ray: &Ray, sheared: &ShearedRay, _: &mut Stack, _: usize) -> bool {
        self.shapes.iter().any(|(prim, shape)| {
            *prim != ray.skip && shape.intersect(sheared).is_some_and(|t| (t as f32) < ray.t_max)
        })
    }
}
