//! Smooth glass.

use glam::Vec3;

use super::{BsdfSample, fresnel};
use crate::color::{Rgb, Split};

/// A smooth boundary between two dielectrics; both sides are alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dielectric {
    /// Index below the surface over that above.
    pub eta: f32,
    /// Factor on the reflection.
    pub reflectance: Rgb,
    /// Factor on the transmission.
    pub transmittance: Rgb,
}

impl Dielectric {
    /// Reflects or refracts in proportion to Fresnel's reflectance. Radiance is squeezed into a smaller solid angle in
    /// the denser medium: transmission carries 1/η² (Veach 1997, section 5.2).
    pub fn sample(&self, wo: Vec3, u_lobe: f32) -> Option<BsdfSample> {
        if wo.z == 0.0 {
            return None;
        }
        let f = fresnel::dielectric(wo.z, self.eta);
        let sample = |wi: Vec3, weight: Rgb, eta: f32| BsdfSample {
            wi,
            weight: Split::specular(weight),
            pdf: 1.0,
            delta: true,
            eta,
        };
        if u_lobe < f.reflectance || f.cos_t == 0.0 {
            return Some(sample(Vec3::new(-wo.x, -wo.y, wo.z), self.reflectance, 1.0));
        }
        let wi = Vec3::new(-wo.x / f.eta, -wo.y / f.eta, f.cos_t).normalize();
        Some(sample(wi, self.transmittance / (f.eta * f.eta), f.eta))
    }
}
