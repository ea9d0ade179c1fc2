//! A smooth dielectric coating over a diffuse base.

use glam::{Vec2, Vec3};

use super::{BsdfEval, BsdfFeatures, BsdfSample, fresnel, specular_share};
use crate::color::{Rgb, Split};
use crate::sampling::warp::{cosine_hemisphere, cosine_hemisphere_pdf};

/// Reflection at the coating and, below it, light that enters, is scattered by the base any number of times between
/// base and coating, and leaves:
///
/// ```text
/// f_d = ρ' T(cos θo) T(cos θi) / (π η²),   ρ' = ρ / (1 − ρ R) (nonlinear) or ρ / (1 − R)
/// ```
///
/// with R the coating's diffuse reflectance from inside and T = 1 − F.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plastic {
    /// Index of the coating over that outside.
    pub eta: f32,
    /// ρ' / η².
    pub base: Rgb,
    /// Factor on the reflection.
    pub specular: Rgb,
    /// Share of the specular lobe in the choice of a lobe, before the Fresnel factors.
    pub specular_weight: f32,
}

impl Plastic {
    /// R of a coating, which `new` wants: it depends on the index alone.
    pub fn internal_reflectance(eta: f32) -> f32 {
        fresnel::diffuse_reflectance(1.0 / eta)
    }

    /// `diffuse` is the base's albedo ρ, `internal` is R.
    #[inline]
    pub fn new(eta: f32, internal: f32, diffuse: Rgb, specular: Rgb, nonlinear: bool) -> Self {
        let base = coated_base(diffuse, internal, eta, nonlinear);
        Self { eta, base, specular, specular_weight: specular_share(specular, diffuse) }
    }

    /// Probability of the specular lobe where the coating reflects `f`.
    #[inline]
    fn specular_probability(&self, f: f32) -> f32 {
        let (specular, diffuse) = (f * self.specular_weight, (1.0 - f) * (1.0 - self.specular_weight));
        if specular > 0.0 { specular / (specular + diffuse) } else { 0.0 }
    }

    /// Chooses a lobe by its share of the reflected light.
    #[inline]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample> {
        if wo.z.is_nan() || wo.z <= 0.0 {
            return None;
        }
        let f = fresnel::dielectric(wo.z.min(1.0), self.eta).reflectance;
        let probability = self.specular_probability(f);
        if u_lobe < probability {
            let weight = Split::specular(self.specular * (f / probability));
            return Some(BsdfSample {
                wi: Vec3::new(-wo.x, -wo.y, wo.z),
                weight,
                pdf: 1.0,
                delta: true,
                eta: 1.0,
            });
        }
        let wi = cosine_hemisphere(u);
        if wi.z <= 0.0 {
            return None;
        }
        let through = (1.0 - f) * (1.0 - fresnel::dielectric(wi.z, self.eta).reflectance);
        Some(BsdfSample {
            wi,
            weight: Split::diffuse(self.base * (through / (1.0 - probability))),
            pdf: (1.0 - probability) * cosine_hemisphere_pdf(wi),
            delta: false,
            eta: 1.0,
        })
    }

    /// The diffuse part; the pdf accounts for the choice between the lobes.
    #[inline]
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> BsdfEval {
        if !(wo.z > 0.0 && wi.z > 0.0) {
            return BsdfEval::ZERO;
        }
        let f = fresnel::dielectric(wo.z.min(1.0), self.eta).reflectance;
        let f_i = fresnel::dielectric(wi.z.min(1.0), self.eta).reflectance;
        let cosine = cosine_hemisphere_pdf(wi);
        BsdfEval {
            f_cos: Split::diffuse(self.base * ((1.0 - f) * (1.0 - f_i) * cosine)),
            pdf: (1.0 - self.specular_probability(f)) * cosine,
        }
    }

    /// For the feature layers.
    pub fn features(&self, wo: Vec3) -> BsdfFeatures {
        let f = fresnel::dielectric(wo.z.clamp(0.0, 1.0), self.eta).reflectance;
        let diffuse_albedo = self.base * ((1.0 - f) * (1.0 - fresnel::diffuse_reflectance(self.eta)));
        BsdfFeatures {
            albedo: f * self.specular + diffuse_albedo,
            diffuse_albedo,
            roughness: if self.has_base() { 1.0 } else { 0.0 },
        }
    }

    /// Whether there is a diffuse part.
    #[inline]
    pub fn has_base(&self) -> bool {
        self.base != Rgb::ZERO
    }
}

/// ρ' / η² of the formula above: a base of albedo `diffuse` under a coating that reflects `internal` of diffuse light
/// back onto it.
#[inline]
pub(super) fn coated_base(diffuse: Rgb, internal: f32, eta: f32, nonlinear: bool) -> Rgb {
    let scattered =
        if nonlinear { diffuse / (Rgb::ONE - diffuse * internal) } else { diffuse / (1.0 - internal) };
    scattered / (eta * eta)
}
