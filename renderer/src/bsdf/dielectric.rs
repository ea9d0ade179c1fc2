//! Smooth glass.

use glam::Vec3;

use super::{BsdfFeatures, BsdfSample, fresnel};
use crate::color::{Rgb, Split};

/// A smooth boundary between two dielectrics; scatters on both sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dielectric {
    /// Index below the surface over that above, positive.
    pub eta: f32,
    /// Factor on the reflection.
    pub reflectance: Rgb,
    /// Factor on the transmission.
    pub transmittance: Rgb,
}

impl Dielectric {
    /// Index on the far side of `wo` over that on its side.
    #[inline]
    pub(super) fn relative_eta(&self, wo: Vec3) -> f32 {
        if wo.z > 0.0 { self.eta } else { 1.0 / self.eta }
    }

    /// Reflects with the Fresnel reflectance as probability, else refracts. Radiance that enters a medium of
    /// relative index η is spread over a solid angle smaller by η², hence the weight 1/η² seen from `wo`.
    #[inline]
    pub fn sample(&self, wo: Vec3, u_lobe: f32) -> Option<BsdfSample> {
        if wo.z == 0.0 || wo.z.is_nan() {
            return None;
        }
        let eta = self.relative_eta(wo);
        let boundary = fresnel::dielectric(wo.z.abs().min(1.0), eta);
        let (wi, tint, eta) = if u_lobe < boundary.reflectance {
            (Vec3::new(-wo.x, -wo.y, wo.z), self.reflectance, 1.0)
        } else {
            let wi = Vec3::new(-wo.x / eta, -wo.y / eta, -boundary.cos_t.copysign(wo.z));
            (wi, self.transmittance / (eta * eta), eta)
        };
        Some(BsdfSample { wi, weight: Split::specular(tint), pdf: 1.0, delta: true, eta })
    }

    /// For the feature layers: what is reflected and what goes through, without the change of solid angle.
    pub fn features(&self, wo: Vec3) -> BsdfFeatures {
        let f = fresnel::dielectric(wo.z.abs().min(1.0), self.relative_eta(wo)).reflectance;
        let albedo = f * self.reflectance + (1.0 - f) * self.transmittance;
        BsdfFeatures { albedo, diffuse_albedo: Rgb::ZERO, roughness: 0.0 }
    }
}
