//! Spheres and their affine images, by solid angle in the space where they are unit spheres.
//!
//! From outside, directions are uniform in the cone that the unit sphere fills; from inside, uniform over the sphere of
//! directions. A linear map M turns a density per steradian of the direction w into that of M w by the factor
//! |M w|³ / |det M|, which is 1 for rotations and uniform scales: a sphere is drawn uniformly in its solid angle.

use std::f64::consts::{PI, TAU};

use glam::{DAffine3, DVec2, DVec3, Vec2};

use super::{Drawn, LightAnalytic};

/// A sphere or ellipsoid that emits outwards or inwards.
pub struct Sphere {
    render_from_unit: DAffine3,
    unit_from_render: DAffine3,
    /// |det M|; 0 if the map has no inverse: such a sphere has no inside and is never drawn.
    det: f64,
    inwards: bool,
    prim: u32,
}

/// How directions are drawn in unit space.
enum Scheme {
    /// In the cone around −o with this 1 − cos of its half angle.
    Cone(f64),
    /// Everywhere.
    Uniform,
}

impl Sphere {
    pub fn new(sphere: &LightAnalytic) -> Self {
        let map = sphere.render_from_unit;
        let inverse = map.inverse();
        let det = map.matrix3.determinant().abs();
        let det = if inverse.is_finite() && det.is_finite() { det } else { 0.0 };
        Self {
            render_from_unit: map,
            unit_from_render: inverse,
            det,
            inwards: sphere.turned,
            prim: sphere.prim,
        }
    }

    /// Thomsen's formula from the lengths of the axes, right to 1 % where those are perpendicular.
    pub fn area(&self) -> f64 {
        const P: f64 = 1.6075;
        let m = self.render_from_unit.matrix3;
        let [a, b, c] = [m.x_axis, m.y_axis, m.z_axis].map(|axis| axis.length().powf(P));
        if self.det > 0.0 { 4.0 * PI * ((a * b + b * c + c * a) / 3.0).powf(1.0 / P) } else { 0.0 }
    }

    /// From the point `o` in unit space; `None` where the sphere does not emit towards it.
    fn scheme(&self, o: DVec3) -> Option<Scheme> {
        let d = o.length();
        let inside = d < 1.0;
        if inside != self.inwards || self.det == 0.0 || !d.is_finite() {
            return None;
        }
        if inside {
            return Some(Scheme::Uniform);
        }
        // (d − 1)(d + 1) and sin² / (1 + cos) keep their digits near the surface and from afar.
        let sin2 = 1.0 / (d * d);
        let cos = ((d - 1.0) * (d + 1.0)).sqrt() / d;
        let one_minus_cos = sin2 / (1.0 + cos);
        (one_minus_cos > 0.0).then_some(Scheme::Cone(one_minus_cos))
    }

    pub fn sample(&self, p: DVec3, u: DVec2) -> Option<Drawn> {
        let o = self.unit_from_render.transform_point3(p);
        let d = o.length();
        let c = (d - 1.0) * (d + 1.0);
        let (w, t, unit_pdf) = match self.scheme(o)? {
            Scheme::Cone(full) => {
                let one_minus_cos = u.x * full;
                let (cos, sin2) = (1.0 - one_minus_cos, one_minus_cos * (2.0 - one_minus_cos));
                let w = around(-o / d, cos, sin2.sqrt(), TAU * u.y);
                // The nearer root, by division, so that it keeps its digits near the surface.
                let root = (1.0 - d * d * sin2).max(0.0).sqrt();
                (w, c / (d * cos + root), 1.0 / (TAU * full))
            }
            Scheme::Uniform => {
                let cos = 1.0 - 2.0 * u.x;
                let w = around(DVec3::Z, cos, (1.0 - cos * cos).sqrt(), TAU * u.y);
                // The positive root, in the form that does not cancel.
                let b = -o.dot(w);
                let root = (b * b - c).sqrt();
                let t = if b < 0.0 { c / (b - root) } else { b + root };
                (w, t, 1.0 / (2.0 * TAU))
            }
        };
        let stretched = self.render_from_unit.transform_vector3(w);
        let length = stretched.length();
        let pdf = unit_pdf * length * length * length / self.det;
        let distance = t * length;
        let wi = stretched / length;
        (distance > 0.0 && wi.is_finite()).then(|| Drawn {
            wi,
            distance,
            pdf,
            uv: uv(o + t * w).into(),
            prim: self.prim,
        })
    }

    /// Of the unit direction `wi`, which is known to meet the sphere.
    pub fn pdf(&self, p: DVec3, wi: DVec3) -> f64 {
        let o = self.unit_from_render.transform_point3(p);
        let unit_pdf = match self.scheme(o) {
            Some(Scheme::Cone(one_minus_cos)) => 1.0 / (TAU * one_minus_cos),
            Some(Scheme::Uniform) => 1.0 / (2.0 * TAU),
            None => return 0.0,
        };
        let length = self.unit_from_render.transform_vector3(wi).length();
        unit_pdf / (length * length * length * self.det)
    }
}

/// Texture coordinates of a point of the unit sphere.
fn uv(q: DVec3) -> Vec2 {
    let turn = q.y.atan2(q.x) / TAU;
    let turn = if turn < 0.0 { turn + 1.0 } else { turn };
    Vec2::new(turn as f32, (q.z.clamp(-1.0, 1.0).acos() / PI) as f32)
}

/// The direction at an angle to the unit `axis`, and at `phi` around it.
fn around(axis: DVec3, cos: f64, sin: f64, phi: f64) -> DVec3 {
    let (x, y) = axis.any_orthonormal_pair();
    cos * axis + sin * (phi.cos() * x + phi.sin() * y)
}
