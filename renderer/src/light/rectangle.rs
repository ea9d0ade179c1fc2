//! Rectangles by solid angle where they are wide (Ureña, Fajardo and King 2013), parallelograms and distant rectangles
//! by area. Textured ones by their texels; wide ones in one half of all draws, by solid angle in the other: a bright spot
//! far off and a dark part near by both matter.

use glam::{DVec2, DVec3, Vec2};
use limpid_scenes::Color;

use super::texels::{Texels, luminance_at};
use super::triangle::WIDE;
use super::{Drawn, LightRectangle, area_pdf};
use crate::texture::Textures;

/// Cosine between the edges up to which a parallelogram counts as a rectangle: what is left of a right angle
/// after a rotation in `f32`.
const SQUARE: f64 = 1e-6;

/// Solid angles below this are not worth their rounding.
const SMALLEST: f64 = 1e-6;

/// A parallelogram that emits on one side.
pub struct Rectangle {
    corner: DVec3,
    edges: [DVec3; 2],
    /// Lengths of the edges.
    size: DVec2,
    /// Towards the side that emits; its length is the area.
    normal: DVec3,
    is_rectangle: bool,
    texels: Option<Texels>,
    /// Luminance.
    mean: f64,
    prims: [u32; 2],
}

/// The rectangle in a frame with the point at the origin, the axes along the edges, at the distance `z` > 0, and its
/// solid angle.
struct Spherical {
    x: [f64; 2],
    y: [f64; 2],
    z: f64,
    /// First of the inner angles' differences, from which the angle of the sampled part is counted.
    start: f64,
    solid: f64,
}

impl Rectangle {
    pub fn new(rectangle: &LightRectangle, emission: Color, textures: &Textures) -> Self {
        let texels = Texels::new(emission, textures);
        let mean = match (&texels, emission) {
            (Some(texels), _) => texels.mean(),
            (None, Color::Constant(_)) => luminance_at(emission, textures, Vec2::ZERO),
            (None, Color::Texture(_)) => 0.0,
        };
        let edges = [rectangle.edge_u, rectangle.edge_v].map(|e| e.as_dvec3());
        let size = DVec2::new(edges[0].length(), edges[1].length());
        let side = if rectangle.turned { -1.0 } else { 1.0 };
        Self {
            corner: rectangle.corner.as_dvec3(),
            edges,
            size,
            normal: edges[0].cross(edges[1]) * side,
            is_rectangle: edges[0].dot(edges[1]).abs() <= SQUARE * size.x * size.y,
            texels,
            mean,
            prims: rectangle.prims,
        }
    }

    pub fn area(&self) -> f64 {
        self.normal.length()
    }

    /// Mean luminance.
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// `choice` is uniform in [0, 1), as `u`.
    pub fn sample(&self, p: DVec3, choice: f64, u: DVec2) -> Option<Drawn> {
        if !self.emits_towards(p) {
            return None;
        }
        let spherical = self.spherical(p);
        let st = match (&spherical, &self.texels) {
            (None, None) => u,
            (Some(spherical), None) => spherical.draw(u),
            (Some(spherical), Some(_)) if choice < 0.5 => spherical.draw(u),
            (_, Some(texels)) => texels.sample(u),
        };
        let q = self.corner + st.x * self.edges[0] + st.y * self.edges[1];
        let d = q - p;
        let uv = st.as_vec2();
        Some(Drawn {
            wi: d.try_normalize()?,
            distance: d.length(),
            pdf: self.density(p, q, uv, spherical.as_ref()),
            uv: uv.into(),
            prim: self.prims[usize::from(st.x < st.y)],
        })
    }

    /// Of the point `q`.
    pub fn pdf(&self, p: DVec3, q: DVec3, uv: Vec2) -> f64 {
        if !self.emits_towards(p) {
            return 0.0;
        }
        self.density(p, q, uv, self.spherical(p).as_ref())
    }

    fn density(&self, p: DVec3, q: DVec3, uv: Vec2, spherical: Option<&Spherical>) -> f64 {
        let by_texel = |texels: &Texels| texels.density(uv) * area_pdf(p, q, self.normal);
        match (spherical, &self.texels) {
            (None, None) => area_pdf(p, q, self.normal),
            (Some(spherical), None) => 1.0 / spherical.solid,
            (None, Some(texels)) => by_texel(texels),
            (Some(spherical), Some(texels)) => 0.5 * (1.0 / spherical.solid + by_texel(texels)),
        }
    }

    fn emits_towards(&self, p: DVec3) -> bool {
        (p - self.corner).dot(self.normal) > 0.0
    }

    /// `None` where points are drawn by area.
    fn spherical(&self, p: DVec3) -> Option<Spherical> {
        if !self.is_rectangle {
            return None;
        }
        let [x_axis, y_axis] = [self.edges[0] / self.size.x, self.edges[1] / self.size.y];
        let to = self.corner - p;
        let (x0, y0) = (to.dot(x_axis), to.dot(y_axis));
        let (x, y) = ([x0, x0 + self.size.x], [y0, y0 + self.size.y]);
        let z = to.dot(self.normal.normalize()).abs();
        // The nearest point of the rectangle.
        let beyond = |[a, b]: [f64; 2]| a.max(-b).max(0.0);
        let nearest2 = beyond(x).powi(2) + beyond(y).powi(2) + z * z;
        if self.size.length_squared() <= WIDE * nearest2 {
            return None;
        }
        // The inner angle at a corner has cotangent ±xy / (z · distance): arc tangents keep the digits of small ones,
        // where the paper's arc cosines lose half of them.
        let angle = |x: f64, y: f64| (z * (x * x + y * y + z * z).sqrt()).atan2(x * y);
        let (a00, a01, a10, a11) =
            (angle(x[0], y[0]), angle(x[0], y[1]), angle(x[1], y[0]), angle(x[1], y[1]));
        let solid = (a10 - a11) + (a01 - a00);
        (solid > SMALLEST).then_some(Spherical { x, y, z, start: a00 - a01, solid })
    }
}

impl Spherical {
    /// A point uniform in solid angle, in [0, 1]² along the edges. First the strip to the left of x, by its solid
    /// angle, then y uniform in the sine of its elevation.
    fn draw(&self, u: DVec2) -> DVec2 {
        let Self { x: [x0, x1], y: [y0, y1], z, .. } = *self;
        let phi = u.x * self.solid + self.start;
        let (h0, h1) = (y0.hypot(z), y1.hypot(z));
        // b0 cos φ + b1 with b0 = −y0 / h0, b1 = y1 / h1, of which little may be left.
        let sum = if y0 * y1 > 0.0 {
            z * z * (y1 - y0) * (y1 + y0) / (h0 * h1 * (y1 * h0 + y0 * h1))
        } else {
            y1 / h1 - y0 / h0
        };
        let half = (0.5 * phi).sin();
        let f = (sum + y0 / h0 * 2.0 * half * half) / phi.sin();
        let under = f * f - (z / h0).powi(2);
        let x = if under > 0.0 { (z / under.sqrt()).copysign(f) } else { f64::INFINITY.copysign(f) };
        let x = x.max(x0).min(x1);
        let d = x.hypot(z);
        let (e0, e1) = (y0 / y0.hypot(d), y1 / y1.hypot(d));
        let e = e0 + u.y * (e1 - e0);
        let y = e * d / ((1.0 - e) * (1.0 + e)).sqrt();
        let y = y.max(y0).min(y1);
        DVec2::new(((x - x0) / (x1 - x0)).clamp(0.0, 1.0), ((y - y0) / (y1 - y0)).clamp(0.0, 1.0))
    }
}
