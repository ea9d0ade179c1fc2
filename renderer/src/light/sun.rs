//! The sun of a clear day: a round disk at infinity.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec2, DVec3, Vec3};
use limpid_scenes::Daylight;

use crate::color::{Rgb, luminance};

/// Directions within a cone, uniform in solid angle; those below the horizon are black.
pub struct Sun {
    /// An orthonormal frame whose z points to the middle.
    frame: [DVec3; 3],
    /// 1 − cos of the half angle: keeps its digits for thin cones.
    one_minus_cos: f64,
    radiance: Rgb,
    /// What is above the horizon has a positive product with it.
    up: DVec3,
}

impl Sun {
    pub fn new(daylight: &Daylight, half_deg: f64, scale: f32) -> Self {
        let linear = DMat3::from_mat4(daylight.world_from_light);
        let z = (linear * daylight.sun).normalize_or(DVec3::Z);
        let (x, y) = z.any_orthonormal_pair();
        Self {
            frame: [x, y, z],
            one_minus_cos: 2.0 * (0.5 * half_deg.to_radians()).sin().powi(2),
            radiance: Rgb::from(daylight.sun(half_deg)) * scale,
            up: linear.inverse().transpose().y_axis,
        }
    }

    /// A direction, its radiance and its density per steradian.
    pub fn sample(&self, u: DVec2) -> (Vec3, Rgb, f64) {
        let one_minus_cos = u.x * self.one_minus_cos;
        let sin = (one_minus_cos * (2.0 - one_minus_cos)).sqrt();
        let (sin_phi, cos_phi) = (TAU * u.y).sin_cos();
        let [x, y, z] = self.frame;
        let wi = sin * cos_phi * x + sin * sin_phi * y + (1.0 - one_minus_cos) * z;
        (wi.as_vec3(), self.above_horizon(wi), self.pdf())
    }

    /// Radiance against the direction `wi`, and the density of drawing it.
    pub fn eval(&self, wi: Vec3) -> (Rgb, f64) {
        // 1 − cos by the chord, for a cosine next to 1.
        let wi = wi.as_dvec3().normalize_or_zero();
        let one_minus_cos = 0.5 * (wi - self.frame[2]).length_squared();
        if one_minus_cos <= self.one_minus_cos {
            (self.above_horizon(wi), self.pdf())
        } else {
            (Rgb::ZERO, 0.0)
        }
    }

    /// Luminance times solid angle, of the disk above and below the horizon.
    pub fn integral(&self) -> f64 {
        (TAU * self.one_minus_cos * f64::from(luminance(self.radiance))).max(0.0)
    }

    fn above_horizon(&self, wi: DVec3) -> Rgb {
        if self.up.dot(wi) < 0.0 { Rgb::ZERO } else { self.radiance }
    }

    fn pdf(&self) -> f64 {
        0.5 / (PI * self.one_minus_cos)
    }
}
