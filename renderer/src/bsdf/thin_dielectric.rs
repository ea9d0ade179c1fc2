//! A thin sheet of glass.

use glam::Vec3;

use super::{BsdfFeatures, BsdfSample, fresnel};
use crate::color::{Rgb, Split};

/// Two smooth boundaries with nothing worth mentioning between them: a pane whose faces are one surface. What goes
/// through keeps its direction; scatters on both sides alike. With F the reflectance of one boundary, the light that goes
/// to and fro between them adds up to
///
/// ```text
/// R = F + (1 − F)² F (1 + F² + F⁴ + …) = 2F / (1 + F),   T = 1 − R
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThinDielectric {
    /// Index of the sheet over that around it, positive.
    pub eta: f32,
    /// Factor on the reflection.
    pub reflectance: Rgb,
    /// Factor on the transmission.
    pub transmittance: Rgb,
}

impl ThinDielectric {
    /// R from the cosine of either side.
    #[inline]
    fn reflected(&self, cos: f32) -> f32 {
        let f = fresnel::dielectric(cos.abs().min(1.0), self.eta).reflectance;
        2.0 * f / (1.0 + f)
    }

    /// Reflects with R as probability, else passes straight on.
    #[inline]
    pub fn sample(&self, wo: Vec3, u_lobe: f32) -> Option<BsdfSample> {
        if wo.z == 0.0 || wo.z.is_nan() {
            return None;
        }
        let (wi, tint) = if u_lobe < self.reflected(wo.z) {
            (Vec3::new(-wo.x, -wo.y, wo.z), self.reflectance)
        } else {
            (-wo, self.transmittance)
        };
        Some(BsdfSample { wi, weight: Split::specular(tint), pdf: 1.0, delta: true, eta: 1.0 })
    }

    /// For the feature layers.
    pub fn features(&self, wo: Vec3) -> BsdfFeatures {
        let r = self.reflected(wo.z);
        let albedo = r * self.reflectance + (1.0 - r) * self.transmittance;
        BsdfFeatures { albedo, diffuse_albedo: Rgb::ZERO, roughness: 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// R at cosines, as Mitsuba 3.9.1 (`scalar_rgb`) has it.
    #[test]
    fn reflectances_are_those_of_mitsuba() {
        for (eta, cos, r) in [
            (1.504_183_4, 1.0, 0.077_914_335),
            (1.504_183_4, -0.7, 0.097_963_86),
            (1.33, 0.3, 0.286_858_74),
            (1.33, 0.05, 0.845_160_2),
            (0.7, 1.0, 0.060_402_684),
            (0.7, 0.3, 1.0),
        ] {
            let pane = ThinDielectric { eta, reflectance: Rgb::ONE, transmittance: Rgb::ONE };
            let wo = Vec3::new((1.0f32 - cos * cos).sqrt(), 0.0, cos);
            assert!((pane.reflected(cos) / r - 1.0).abs() < 1e-5, "{eta} {cos}: {}", pane.reflected(cos));
            let mirrored = pane.sample(wo, r - 1e-4).expect("scatters everything").wi;
            assert_eq!(mirrored, Vec3::new(-wo.x, 0.0, cos));
            if r < 1.0 {
                assert_eq!(pane.sample(wo, r + 1e-4).expect("scatters everything").wi, -wo);
            }
        }
    }
}
