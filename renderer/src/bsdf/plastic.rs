//! A diffuse base under a smooth or rough dielectric coating.
//!
//! Light enters with transmittance T(θi), is scattered diffusely and internally reflected until it leaves with
//! T(θo): f_d = ρ T(θi) T(θo) / (π η² (1 − ρ' R)), with R the coating's internal reflectance of diffuse light and
//! ρ' = ρ where the colour shift of internal reflections counts (`nonlinear`), else 1.

use glam::{Vec2, Vec3};
use limpid_scenes::Distribution;

use super::microfacet::{Microfacet, half_vector};
use super::{BsdfEval, BsdfSample, albedo, fresnel};
use crate::color::{Rgb, Split};
use crate::sampling::warp::{cosine_hemisphere, cosine_hemisphere_pdf};

/// What of a coating depends on neither the hit nor the colours: made once for a material.
#[derive(Clone, Debug, PartialEq)]
pub struct Coating {
    /// Index below the surface over that above.
    pub eta: f32,
    /// The facets of a rough one.
    microfacet: Option<Microfacet>,
    /// Transmittance from outside at equally spaced cosines from 0 to 1, of a rough one.
    transmittance: Vec<f32>,
    /// Mean transmittance of diffuse light from outside.
    mean_transmittance: f32,
    /// Internal reflectance of diffuse light.
    internal_reflectance: f32,
}

const TABLE: usize = 64;

impl Coating {
    /// A smooth coating.
    pub fn smooth(eta: f32) -> Self {
        Self {
            eta,
            microfacet: None,
            transmittance: Vec::new(),
            mean_transmittance: 1.0 - fresnel::diffuse_reflectance(eta),
            internal_reflectance: fresnel::diffuse_reflectance(1.0 / eta),
        }
    }

    /// A rough coating.
    pub fn rough(eta: f32, distribution: Distribution, alpha: f32) -> Self {
        let facets = Microfacet::new(distribution, alpha, alpha);
        let cos = |i: usize| (i as f32 / (TABLE - 1) as f32).max(1e-6);
        let transmittance: Vec<f32> = (0..TABLE).map(|i| scattered(&facets, cos(i), eta).1).collect();
        // ∫ g(cos) 2 cos dcos by the trapezium rule.
        let diffuse = |g: &dyn Fn(usize) -> f32| {
            let weight = |i: usize| if i == 0 || i == TABLE - 1 { 0.5 } else { 1.0 };
            (0..TABLE).map(|i| 2.0 * cos(i) * g(i) * weight(i)).sum::<f32>() / (TABLE - 1) as f32
        };
        let mean_transmittance = diffuse(&|i| transmittance[i]);
        let internal_reflectance = diffuse(&|i| scattered(&facets, cos(i), 1.0 / eta).0);
        Self { eta, microfacet: Some(facets), transmittance, mean_transmittance, internal_reflectance }
    }

    /// Fraction that passes from outside at a cosine.
    fn transmittance(&self, cos: f32) -> f32 {
        if self.microfacet.is_none() {
            return 1.0 - fresnel::dielectric(cos, self.eta).reflectance;
        }
        let x = cos.clamp(0.0, 1.0) * (TABLE - 1) as f32;
        let i = (x as usize).min(TABLE - 2);
        let t = x - i as f32;
        self.transmittance[i] * (1.0 - t) + self.transmittance[i + 1] * t
    }
}

/// Fractions of light from `cos` that a rough boundary reflects and transmits, each with single scattering.
fn scattered(facets: &Microfacet, cos: f32, eta: f32) -> (f32, f32) {
    const N: u32 = 32;
    let wo = Vec3::new((1.0 - cos * cos).max(0.0).sqrt(), 0.0, cos);
    let (mut reflected, mut transmitted) = (0.0, 0.0);
    for k in 0..N * N {
        let u = Vec2::new((k % N) as f32 + 0.5, (k / N) as f32 + 0.5) / N as f32;
        let m = facets.sample_visible(wo, u);
        let cos_m = wo.dot(m);
        let f = fresnel::dielectric(cos_m, eta);
        let wi = 2.0 * cos_m * m - wo;
        if wi.z > 0.0 {
            reflected += f.reflectance * facets.g1(wi, m);
        }
        if f.cos_t != 0.0 {
            let wi = (cos_m / f.eta + f.cos_t) * m - wo / f.eta;
            if wi.z < 0.0 {
                transmitted += (1.0 - f.reflectance) * facets.g1(wi, m);
            }
        }
    }
    let n = (N * N) as f32;
    (reflected / n, transmitted / n)
}

/// A coating over a base of a colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plastic<'a> {
    /// The coating.
    pub coating: &'a Coating,
    /// ρ.
    pub diffuse: Rgb,
    /// Factor on the coating's reflection.
    pub tint: Rgb,
    /// Colour shift by internal reflections counts.
    pub nonlinear: bool,
}

impl Plastic<'_> {
    /// Chance of sampling the coating's reflection.
    fn specular_chance(&self, transmittance: f32) -> f32 {
        let (s, d) = (self.tint.element_sum(), self.diffuse.element_sum());
        let specular = (1.0 - transmittance) * s;
        let diffuse = transmittance * d;
        if specular + diffuse > 0.0 { specular / (specular + diffuse) } else { 0.0 }
    }

    /// ρ / (η² (1 − ρ' R)).
    fn base(&self) -> Rgb {
        let shift = if self.nonlinear { self.diffuse } else { Rgb::ONE };
        let eta2 = self.coating.eta * self.coating.eta;
        self.diffuse / ((Rgb::ONE - shift * self.coating.internal_reflectance) * eta2)
    }

    /// Draws from the coating's reflection or from the base.
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample> {
        if wo.z <= 0.0 {
            return None;
        }
        let through = self.coating.transmittance(wo.z);
        let chance = self.specular_chance(through);
        let specular = u_lobe < chance;
        let wi = match (specular, &self.coating.microfacet) {
            (true, None) => {
                let weight = self.tint * ((1.0 - through) / chance);
                let wi = Vec3::new(-wo.x, -wo.y, wo.z);
                return Some(BsdfSample {
                    wi,
                    weight: Split::specular(weight),
                    pdf: 1.0,
                    delta: true,
                    eta: 1.0,
                });
            }
            (true, Some(facets)) => {
                let m = facets.sample_visible(wo, u);
                (2.0 * wo.dot(m) * m - wo).normalize()
            }
            (false, _) => cosine_hemisphere(u),
        };
        let value = self.eval(wo, wi);
        (value.pdf > 0.0).then(|| BsdfSample {
            wi,
            weight: value.f_cos * (1.0 / value.pdf),
            pdf: value.pdf,
            delta: false,
            eta: 1.0,
        })
    }

    /// Value and density of the base and of a rough coating's reflection.
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> BsdfEval {
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return BsdfEval::ZERO;
        }
        let through = self.coating.transmittance(wo.z);
        let chance = self.specular_chance(through);
        let cosine = cosine_hemisphere_pdf(wi);
        let mut pdf = (1.0 - chance) * cosine;
        let mut f_cos = Split::diffuse(self.base() * (through * self.coating.transmittance(wi.z) * cosine));
        if let (Some(facets), Some(m)) = (&self.coating.microfacet, half_vector(wo, wi)) {
            let density = facets.d(m) * facets.g1(wo, m) / (4.0 * wo.z);
            let f = fresnel::dielectric(wo.dot(m).max(0.0), self.coating.eta).reflectance;
            f_cos.specular = self.tint * (f * density * facets.g1(wi, m));
            pdf += chance * density;
        }
        if pdf.is_finite() && f_cos.total().is_finite() { BsdfEval { f_cos, pdf } } else { BsdfEval::ZERO }
    }

    /// Albedos of the whole and of the base.
    pub fn albedo(&self, wo: Vec3) -> (Rgb, Rgb) {
        let cos = wo.z.max(0.0);
        let through = self.coating.transmittance(cos);
        let diffuse = self.base() * (through * self.coating.mean_transmittance);
        let specular = match &self.coating.microfacet {
            None => self.tint * (1.0 - through),
            Some(facets) => {
                let normal = fresnel::dielectric(1.0, self.coating.eta).reflectance;
                albedo::specular(facets, cos, self.tint * normal, self.tint)
            }
        };
        (diffuse + specular, diffuse)
    }
}
