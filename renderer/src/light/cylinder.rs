//! Cylinders and their affine images, by area over the part that faces the point.
//!
//! In the space where the cylinder is x² + y² = 1, 0 ≤ z ≤ 1, what faces a point at the distance ρ > 1 from the axis are
//! the angles within acos(1/ρ) of it on the outside, and the rest on the inside. Angle and height are drawn
//! uniformly: on a round cylinder that is uniform in area.

use std::f64::consts::{PI, TAU};

use glam::{DAffine3, DVec2, DVec3, Vec2};

use super::{Drawn, LightAnalytic, area_pdf};

/// A cylinder without caps that emits outwards or inwards.
pub struct Cylinder {
    render_from_unit: DAffine3,
    unit_from_render: DAffine3,
    inwards: bool,
    area: f64,
    prim: u32,
}

/// The angles that are drawn: `half` to either side of `middle`.
#[derive(Clone, Copy, Debug)]
struct Arc {
    middle: f64,
    half: f64,
}

impl Cylinder {
    pub fn new(cylinder: &LightAnalytic) -> Self {
        let map = cylinder.render_from_unit;
        let inverse = map.inverse();
        let mut this = Self {
            render_from_unit: map,
            unit_from_render: inverse,
            inwards: cylinder.turned,
            area: 0.0,
            prim: cylinder.prim,
        };
        if inverse.is_finite() {
            // The trapezium rule converges at once on a smooth periodic function.
            const STEPS: u32 = 64;
            let step = TAU / f64::from(STEPS);
            this.area = (0..STEPS).map(|i| step * this.stretch(f64::from(i) * step).length()).sum();
        }
        this
    }

    pub fn area(&self) -> f64 {
        self.area
    }

    /// ∂p/∂φ × ∂p/∂z in render space: its length is the area of a unit of angle and height.
    fn stretch(&self, phi: f64) -> DVec3 {
        let m = self.render_from_unit.matrix3;
        (phi.cos() * m.y_axis - phi.sin() * m.x_axis).cross(m.z_axis)
    }

    /// The angles that emit towards the point `o` of unit space; `None` where there are none.
    fn arc(&self, o: DVec3) -> Option<Arc> {
        let rho = o.x.hypot(o.y);
        let towards = o.y.atan2(o.x);
        // acos(1/ρ) in a form that keeps its digits near the surface; no number inside.
        let half = ((rho - 1.0) * (rho + 1.0)).sqrt().atan();
        let is_inside = rho < 1.0;
        let arc = match (is_inside, self.inwards) {
            (true, true) => Arc { middle: towards, half: PI },
            (true, false) => return None,
            (false, false) => Arc { middle: towards, half },
            (false, true) => Arc { middle: towards + PI, half: PI - half },
        };
        (arc.half > 0.0 && arc.middle.is_finite()).then_some(arc)
    }

    /// Whether the near side of the cylinder stands between `o`, which is outside, and the point `q` of its inside.
    fn is_hidden(&self, o: DVec3, q: DVec3) -> bool {
        let d = q - o;
        // Both crossings of x² + y² = 1 along o + t d: one is at q, where t = 1, and the product of them is c / a.
        let (a, c) = (d.x * d.x + d.y * d.y, o.x * o.x + o.y * o.y - 1.0);
        let t = c / a;
        c > 0.0 && t < 1.0 && (0.0..=1.0).contains(&(o.z + t * d.z))
    }

    pub fn sample(&self, p: DVec3, u: DVec2) -> Option<Drawn> {
        let o = self.unit_from_render.transform_point3(p);
        let arc = self.arc(o)?;
        let phi = arc.middle + (2.0 * u.x - 1.0) * arc.half;
        let q = DVec3::new(phi.cos(), phi.sin(), u.y);
        if self.inwards && self.is_hidden(o, q) {
            return None; // a shadow ray would not see it: it passes over the light's own primitive
        }
        let q_render = self.render_from_unit.transform_point3(q);
        let d = q_render - p;
        Some(Drawn {
            wi: d.try_normalize()?,
            distance: d.length(),
            pdf: area_pdf(p, q_render, 2.0 * arc.half * self.stretch(phi)),
            uv: Vec2::new((phi / TAU).rem_euclid(1.0) as f32, u.y as f32).into(),
            prim: self.prim,
        })
    }

    /// Of the point `q` in render space, which is known to be seen from `p`.
    pub fn pdf(&self, p: DVec3, q: DVec3) -> f64 {
        let o = self.unit_from_render.transform_point3(p);
        let Some(arc) = self.arc(o) else { return 0.0 };
        let at = self.unit_from_render.transform_point3(q);
        area_pdf(p, q, 2.0 * arc.half * self.stretch(at.y.atan2(at.x)))
    }
}
