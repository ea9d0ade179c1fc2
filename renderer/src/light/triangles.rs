//! Emissive meshes: a triangle by its area and by what its texture emits, then a point on it.

use glam::{DVec2, DVec3, Vec2, Vec3};
use limpid_scenes::Color;

use super::texels::{FLOOR, luminance_at};

use super::triangle::Seen;
use super::{Drawn, LightTriangle};
use crate::sampling::Distribution1d;
use crate::texture::{TexturePoint, Textures};

/// Look-ups of one triangle, and of a whole mesh.
const LOOK_UPS: [usize; 2] = [64, 4_000_000];

/// A mesh that emits on one side.
pub struct Triangles {
    triangles: Box<[LightTriangle]>,
    /// `None` if no triangle has an area.
    choice: Option<Distribution1d>,
    area: f64,
    /// Luminance.
    mean: f64,
}

impl Triangles {
    pub fn new(triangles: Vec<LightTriangle>, emission: Color, textures: &Textures) -> Self {
        let areas: Vec<f64> = triangles.iter().map(area).collect();
        let total: f64 = areas.iter().sum();
        let (means, mean) = match emission {
            Color::Constant(_) => (Vec::new(), luminance_at(emission, textures, Vec2::ZERO)),
            Color::Texture(_) => {
                let most = LOOK_UPS[0].min(LOOK_UPS[1] / triangles.len().max(1));
                let means: Vec<f64> =
                    triangles.iter().map(|t| triangle_mean(t, emission, textures, most)).collect();
                let mean = areas.iter().zip(&means).map(|(a, m)| a * m).sum::<f64>() / total;
                (means, mean)
            }
        };
        let choice = if means.is_empty() || !(mean > 0.0 && mean.is_finite()) {
            Distribution1d::new(areas)
        } else {
            Distribution1d::new(areas.iter().zip(&means).map(|(a, m)| a * (m + FLOOR * mean)))
        };
        Self { triangles: triangles.into(), choice, area: total, mean }
    }

    pub fn area(&self) -> f64 {
        self.area
    }

    /// Mean luminance.
    pub fn mean(&self) -> f64 {
        self.mean
    }

    pub fn sample(&self, p: DVec3, choice: f64, u: DVec2) -> Option<Drawn> {
        let triangles = self.choice.as_ref()?;
        let (index, _) = triangles.sample(choice);
        let triangle = &self.triangles[index];
        let corners = triangle.corners.map(Vec3::as_dvec3);
        let point = Seen::new(p, corners)?.draw(u.x, u.y);
        let [a, b, c] = point.bary;
        let d = a * (corners[0] - p) + b * (corners[1] - p) + c * (corners[2] - p);
        Some(Drawn {
            wi: d.try_normalize()?,
            distance: d.length(),
            pdf: triangles.pmf(index) * point.pdf,
            uv: texture_point(triangle, [a, b, c]),
            prim: triangle.prim,
        })
    }

    /// Of the point `q` on the primitive `prim`.
    pub fn pdf(&self, p: DVec3, q: DVec3, prim: u32) -> f64 {
        let index = prim.wrapping_sub(self.triangles.first().map_or(0, |t| t.prim)) as usize;
        let (Some(triangle), Some(choice)) = (self.triangles.get(index), &self.choice) else { return 0.0 };
        match Seen::new(p, triangle.corners.map(Vec3::as_dvec3)) {
            Some(seen) => choice.pmf(index) * seen.pdf(q.distance(p)),
            None => 0.0,
        }
    }
}

/// Where textures are looked up at a point, by the weights of its corners.
fn texture_point(triangle: &LightTriangle, [a, b, c]: [f64; 3]) -> TexturePoint {
    let [uv_a, uv_b, uv_c] = triangle.uvs;
    let (second, third) = if triangle.turned { (c, b) } else { (b, c) };
    TexturePoint {
        uv: a as f32 * uv_a + b as f32 * uv_b + c as f32 * uv_c,
        prim: triangle.prim,
        bary: DVec2::new(second, third).as_vec2(),
    }
}

fn area(triangle: &LightTriangle) -> f64 {
    let [a, b, c] = triangle.corners.map(Vec3::as_dvec3);
    0.5 * (b - a).cross(c - a).length()
}

/// Mean luminance over a triangle, from about a look-up a texel, 4 at least.
fn triangle_mean(triangle: &LightTriangle, emission: Color, textures: &Textures, most: usize) -> f64 {
    let [a, b, c] = triangle.uvs.map(Vec2::as_dvec2);
    let texels =
        0.5 * (b - a).perp_dot(c - a).abs() * textures.detail(emission).max(DVec2::ONE).element_product();
    let count = (texels.min(1e9) as usize).min(most).max(4);
    // The R2 sequence (Roberts 2018), folded into the triangle.
    let values = (0..count).map(|i| {
        let fract = |step: f64| (0.5 + step * i as f64).fract();
        let (mut s, mut t) = (fract(0.754_877_666_246_692_7), fract(0.569_840_290_998_053_3));
        if s + t > 1.0 {
            (s, t) = (1.0 - s, 1.0 - t);
        }
        luminance_at(emission, textures, texture_point(triangle, [1.0 - s - t, s, t]))
    });
    values.sum::<f64>() / count as f64
}
