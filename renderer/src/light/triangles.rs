//! Emissive meshes: a triangle by its area, then a point on it.

use glam::{DVec2, DVec3, Vec3};

use super::triangle::Seen;
use super::{Drawn, LightTriangle};
use crate::sampling::Distribution1d;

/// A mesh that emits on one side.
pub struct Triangles {
    triangles: Box<[LightTriangle]>,
    /// `None` if no triangle has an area.
    choice: Option<Distribution1d>,
}

impl Triangles {
    pub fn new(triangles: Vec<LightTriangle>) -> Self {
        let choice = Distribution1d::new(triangles.iter().map(area));
        Self { triangles: triangles.into(), choice }
    }

    pub fn area(&self) -> f64 {
        self.choice.as_ref().map_or(0.0, Distribution1d::total)
    }

    pub fn sample(&self, p: DVec3, choice: f64, u: DVec2) -> Option<Drawn> {
        let triangles = self.choice.as_ref()?;
        let (index, _) = triangles.sample(choice);
        let triangle = &self.triangles[index];
        let corners = triangle.corners.map(Vec3::as_dvec3);
        let point = Seen::new(p, corners)?.draw(u.x, u.y);
        let [a, b, c] = point.bary;
        let d = a * (corners[0] - p) + b * (corners[1] - p) + c * (corners[2] - p);
        let [uv_a, uv_b, uv_c] = triangle.uvs;
        Some(Drawn {
            wi: d.try_normalize()?,
            distance: d.length(),
            pdf: triangles.pmf(index) * point.pdf,
            uv: a as f32 * uv_a + b as f32 * uv_b + c as f32 * uv_c,
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

fn area(triangle: &LightTriangle) -> f64 {
    let [a, b, c] = triangle.corners.map(Vec3::as_dvec3);
    0.5 * (b - a).cross(c - a).length()
}
