//! Daylight: the clear sky of Hošek and Wilkie 2012, "An Analytic Model for Full Spectral Sky-Dome Radiance", in its data
//! set for red, green and blue, and the sun seen through it (2013, "Adding a Solar-Radiance Function to the Hošek-Wilkie
//! Skylight Model"), as Mitsuba 3.9 has them.
//!
//! The sky comes from the published coefficients (crate `hw-skymodel`); the sun's brightness from a table that
//! `scenes/tools/sun.py` prints. Radiance is in W·sr⁻¹·m⁻²·nm⁻¹ weighted by the observer, the unit of Mitsuba 3. A light so red
//! that Rec. 709 does not hold it, such as a low sun, has a negative blue.

mod position;
mod sun_table;

use std::f64::consts::FRAC_PI_2;

use glam::{DMat4, DVec3};
use hw_skymodel::rgb::{SkyParams, SkyState};

pub(crate) use position::{Moment, sun_position};

use crate::Rgb;

/// Angle under which the sun is seen, in degrees, as Mitsuba 3 has it.
pub(crate) const APERTURE_DEG: f64 = 0.5358;

/// 1 over the integral of the observer's y over wavelengths in nanometres (CIE 1931), as Mitsuba 3 rounds it.
const PER_OBSERVER: f32 = 1.0 / 106.750_26;

/// A clear day.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Daylight {
    /// Towards the sun, unit, in light space; its y is not negative.
    pub sun: DVec3,
    /// How hazy the air is, in [1, 10].
    pub turbidity: f64,
    /// Reflectance of the ground beyond the scene, which brightens the sky; in [0, 1].
    pub albedo: Rgb,
    /// From a light space with +y up. Only its linear part counts.
    pub world_from_light: DMat4,
}

/// The sky's radiance in all directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkyRadiance {
    sun: DVec3,
    /// A to I of the paper's equation 8, per channel.
    coefficients: [Rgb; 9],
    /// By which the distribution is multiplied.
    mean: Rgb,
}

impl Daylight {
    /// The sky around the sun.
    pub fn sky(&self) -> SkyRadiance {
        let state = SkyState::new(&SkyParams {
            elevation: (self.elevation() as f32).clamp(0.0, std::f32::consts::FRAC_PI_2),
            turbidity: (self.turbidity as f32).clamp(1.0, 10.0),
            albedo: self.albedo.map(|a| if a > 0.0 { a.min(1.0) } else { 0.0 }),
        });
        let (coefficients, mean) = state.expect("the parameters are within their ranges").raw();
        SkyRadiance {
            sun: self.sun,
            coefficients: std::array::from_fn(|i| std::array::from_fn(|c| coefficients[9 * c + i])),
            mean: mean.map(|m| m * PER_OBSERVER),
        }
    }

    /// Radiance of a sun that is `2 half_deg` wide, the same all over: its solid angle times its radiance does not depend on
    /// its size.
    pub fn sun(&self, half_deg: f64) -> Rgb {
        let turbidity = (self.turbidity - 1.0).clamp(0.0, 9.0);
        let elevation = ((self.elevation().to_degrees() - 2.0) / 3.0).clamp(0.0, 29.0);
        let (t, i) = ((turbidity as usize).min(8), (elevation as usize).min(28));
        let (ft, fi) = (turbidity - t as f64, elevation - i as f64);
        let one_minus_cos = |half_deg: f64| (0.5 * half_deg.to_radians()).sin().powi(2);
        let spread = one_minus_cos(0.5 * APERTURE_DEG) / one_minus_cos(half_deg);
        std::array::from_fn(|c| {
            let at = |t: usize, i: usize| f64::from(sun_table::RADIANCE[t][i][c]);
            let row = |t| at(t, i) * (1.0 - fi) + at(t, i + 1) * fi;
            ((row(t) * (1.0 - ft) + row(t + 1) * ft) * spread) as f32
        })
    }

    /// Of the sun above the horizon, in radians.
    fn elevation(&self) -> f64 {
        FRAC_PI_2 - self.sun.angle_between(DVec3::Y)
    }
}

impl SkyRadiance {
    /// From a unit direction of light space, with equation 8 of the paper; 0 from below the horizon.
    #[inline]
    pub fn arriving_from(&self, direction: DVec3) -> Rgb {
        if direction.y < 0.0 {
            return [0.0; 3];
        }
        let gamma = self.sun.dot(direction).clamp(-1.0, 1.0).acos() as f32;
        let cos_gamma = gamma.cos();
        let cos_gamma2 = cos_gamma * cos_gamma;
        let cos_theta = direction.y as f32;
        // the published code adds a hundredth, against a division by 0 at the horizon
        let (air, zenith) = (1.0 / (cos_theta + 0.01), cos_theta.sqrt());
        let [a, b, c, d, e, f, g, h, i] = &self.coefficients;
        std::array::from_fn(|k| {
            let halo = 1.0 + i[k] * i[k] - 2.0 * i[k] * cos_gamma;
            let chi = (1.0 + cos_gamma2) / (halo * halo.sqrt());
            let around = c[k] + d[k] * (e[k] * gamma).exp() + f[k] * cos_gamma2 + g[k] * chi + h[k] * zenith;
            (1.0 + a[k] * (b[k] * air).exp()) * around * self.mean[k]
        })
    }
}

#[cfg(test)]
mod tests;
