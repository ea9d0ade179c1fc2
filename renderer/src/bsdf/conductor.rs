//! Smooth metal.

use glam::Vec3;

use super::{BsdfFeatures, BsdfSample, fresnel};
use crate::color::{Rgb, Split};

/// Complex index of refraction η + ik, relative to the outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ior {
    /// Real part.
    pub eta: Rgb,
    /// Imaginary part, not negative.
    pub k: Rgb,
}

/// A mirror with the Fresnel reflectance of a metal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conductor {
    /// `None`: reflects everything.
    pub ior: Option<Ior>,
    /// Factor on the reflection.
    pub specular: Rgb,
}

/// Fresnel reflectance times `specular` at the cosine `cos`.
#[inline]
pub(super) fn tint(ior: Option<Ior>, specular: Rgb, cos: f32) -> Rgb {
    match ior {
        Some(ior) => specular * fresnel::conductor(cos, ior.eta, ior.k),
        None => specular,
    }
}

impl Conductor {
    /// The mirror direction.
    #[inline]
    pub fn sample(&self, wo: Vec3) -> Option<BsdfSample> {
        (wo.z > 0.0).then(|| BsdfSample {
            wi: Vec3::new(-wo.x, -wo.y, wo.z),
            weight: Split::specular(tint(self.ior, self.specular, wo.z.min(1.0))),
            pdf: 1.0,
            delta: true,
            eta: 1.0,
        })
    }

    /// For the feature layers.
    pub fn features(&self, wo: Vec3) -> BsdfFeatures {
        let albedo = tint(self.ior, self.specular, wo.z.clamp(0.0, 1.0));
        BsdfFeatures { albedo, diffuse_albedo: Rgb::ZERO, roughness: 0.0 }
    }
}
