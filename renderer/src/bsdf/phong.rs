//! The modified Phong model.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};

use super::glossy::{Glossy, White, WhiteLobe};
use crate::color::Rgb;

/// A cosine lobe around the mirror direction r over a diffuse base (Lafortune and Willems 1994):
///
/// ```text
/// f = ρ_d / π + ρ_s (n + 2) / 2π · max(r·wi, 0)ⁿ
/// ```
///
/// Seen from straight above the lobe reflects ρ_s; towards the horizon it loses most of that, 93 % of it for n = 30.
pub type Phong = Glossy<PhongLobe>;

/// The lobe of [`Phong`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhongLobe {
    exponent: f32,
}

/// Beyond, the lobe would be narrower than f32 directions resolve.
const LARGEST_EXPONENT: f32 = 2e8;

impl Phong {
    /// `exponent` is kept within [0, 2e8]; a NaN becomes 0.
    #[inline]
    pub fn new(exponent: f32, diffuse: Rgb, specular: Rgb) -> Self {
        let exponent = exponent.clamp(0.0, LARGEST_EXPONENT).max(0.0); // the latter for NaN
        Self::of(PhongLobe { exponent }, diffuse, specular)
    }
}

impl WhiteLobe for PhongLobe {
    /// A direction around the mirror one with density (n + 1) / 2π · cosⁿ.
    #[inline]
    fn draw(&self, wo: Vec3, u: Vec2) -> Vec3 {
        // 1 − cos, with the digits that a narrow lobe needs; u = 0 is the far end.
        let away = -((1.0 - u.y).ln() / (self.exponent + 1.0)).exp_m1();
        let sin = (away * (2.0 - away)).sqrt();
        let (sin_phi, cos_phi) = (TAU * u.x).sin_cos();
        let r = mirrored(wo);
        let (x, y) = r.any_orthonormal_pair();
        (sin * (cos_phi * x + sin_phi * y) + (1.0 - away) * r).normalize()
    }

    #[inline]
    fn at(&self, wo: Vec3, wi: Vec3) -> White {
        // By what r·wi is short of 1: the power multiplies what rounding leaves of the difference.
        let away = 0.5 * (mirrored(wo) - wi).length_squared();
        let power = if away < 1.0 { (self.exponent * (-away).ln_1p()).exp() } else { 0.0 };
        let pdf = (self.exponent + 1.0) / TAU * power;
        White { pdf, weight: (self.exponent + 2.0) / (self.exponent + 1.0) * wi.z }
    }

    /// Width of a Beckmann lobe like this one (Walter et al. 2007).
    #[inline]
    fn alpha(&self) -> f32 {
        (2.0 / (self.exponent + 2.0)).sqrt()
    }
}

#[inline]
fn mirrored(wo: Vec3) -> Vec3 {
    Vec3::new(-wo.x, -wo.y, wo.z)
}

#[cfg(test)]
mod tests {
    use limpid_testkit::furnace;

    use super::*;

    #[test]
    fn value_is_that_of_the_formula() {
        let (wo, wi) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.36, 0.48, 0.8));
        let value = Phong::new(20.0, Rgb::splat(0.3), Rgb::splat(0.4)).eval(wo, wi);
        // r·wi = 0.856, to the 20th 0.044634
        let f = 0.4 * 22.0 / TAU * 0.856f32.powi(20);
        assert!((value.f_cos.specular.x / (0.8 * f) - 1.0).abs() < 1e-4, "{value:?}");
        assert!((value.f_cos.diffuse.x / (0.8 * 0.6 / TAU) - 1.0).abs() < 1e-5, "{value:?}");
    }

    /// Its integral over the hemisphere is 1 from straight above, whatever the exponent.
    #[test]
    fn lobe_keeps_all_light_from_above() {
        for exponent in [0.0, 1.0, 30.0, 1e4, 1e8] {
            let phong = Phong::new(exponent, Rgb::ZERO, Rgb::ONE);
            let weight = |lobe, u| phong.sample(Vec3::Z, lobe, u).map_or(Rgb::ZERO, |s| s.weight.specular);
            let albedo = furnace(1 << 16, weight).x;
            assert!((albedo - 1.0).abs() < 1e-3, "{exponent}: {albedo}");
        }
    }

    #[test]
    fn colours_beyond_one_are_scaled_to_it() {
        let bsdf = Phong::new(5.0, Rgb::new(0.8, 0.2, 0.1), Rgb::new(0.8, 0.2, 0.5));
        let albedo = bsdf.features(Vec3::Z).albedo;
        assert!((albedo - Rgb::new(1.0, 0.25, 0.375)).abs().max_element() < 0.01, "{albedo}");
    }
}
