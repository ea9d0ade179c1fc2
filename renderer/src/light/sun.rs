//! A round disk at infinity.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3, Vec3};

use crate::color::{Rgb, luminance};

/// Directions within a cone, uniform in solid angle.
pub struct Sun {
    /// An orthonormal frame whose z points to the middle.
    frame: [DVec3; 3],
    /// 1 − cos of the half angle: keeps its digits for thin cones.
    one_minus_cos: f64,
    radiance: Rgb,
}

impl Sun {
    pub fn new(direction: DVec3, half_deg: f64, radiance: Rgb) -> Self {
        let z = direction.normalize_or(DVec3::Z);
        let (x, y) = z.any_orthonormal_pair();
        Self { frame: [x, y, z], one_minus_cos: 2.0 * (0.5 * half_deg.to_radians()).sin().powi(2), radiance }
    }

    /// A direction, its radiance and its density per steradian.
    pub fn sample(&self, u: DVec2) -> (Vec3, Rgb, f64) {
        let one_minus_cos = u.x * self.one_minus_cos;
        let sin = (one_minus_cos * (2.0 - one_minus_cos)).sqrt();
        let (sin_phi, cos_phi) = (TAU * u.y).sin_cos();
        let [x, y, z] = self.frame;
        let wi = sin * cos_phi * x + sin * sin_phi * y + (1.0 - one_minus_cos) * z;
        (wi.as_vec3(), self.radiance, self.pdf())
    }

    /// Radiance against the direction `wi`, and the density of drawing it.
    pub fn eval(&self, wi: Vec3) -> (Rgb, f64) {
        // 1 − cos by the chord, for a cosine next to 1.
        let one_minus_cos = 0.5 * (wi.as_dvec3().normalize_or_zero() - self.frame[2]).length_squared();
        if one_minus_cos <= self.one_minus_cos { (self.radiance, self.pdf()) } else { (Rgb::ZERO, 0.0) }
    }

    /// Luminance times solid angle.
    pub fn integral(&self) -> f64 {
        TAU * self.one_minus_cos * f64::from(luminance(self.radiance))
    }

    fn pdf(&self) -> f64 {
        0.5 / (PI * self.one_minus_cos)
    }
}
