//! A rough dielectric coating over a diffuse base.

use glam::{Vec2, Vec3};
use limpid_scenes::Distribution;
use rayon::prelude::*;

use super::microfacet::Microfacet;
use super::plastic::coated_base;
use super::{BsdfEval, BsdfFeatures, BsdfSample, fresnel, specular_share};
use crate::color::{Rgb, Split};
use crate::sampling::warp::{cosine_hemisphere, cosine_hemisphere_pdf};

/// Entries of a table over the cosine, from 0 to 1.
const SIZE: usize = 64;

/// What a rough coating reflects and lets through, by single scattering: depends on the coating alone, is made once
/// and shared.
#[derive(Clone, Debug, PartialEq)]
pub struct Coating {
    facets: Microfacet,
    eta: f32,
    /// Transmitted fraction from outside.
    transmittance: [f32; SIZE],
    /// Mean of it over the hemisphere, weighted by the cosine.
    mean_transmittance: f32,
    /// Reflected fraction from outside; with the transmitted one it falls short of 1 by what a second facet would get.
    reflectance: [f32; SIZE],
    /// Reflected fraction of diffuse light from inside.
    internal: f32,
}

impl Coating {
    /// `eta` is the index of the coating over that outside. Takes 65 thousand facets on the current rayon pool.
    pub fn new(distribution: Distribution, alpha: f32, eta: f32) -> Self {
        let facets = Microfacet::new(distribution, alpha, alpha);
        let quadrature = quadrature();
        let cos: [f32; SIZE] = std::array::from_fn(|i| (i as f32 / (SIZE - 1) as f32).max(1e-6));
        let scattered: Vec<_> =
            cos.par_iter().map(|&cos| scattered(&facets, cos, [eta, 1.0 / eta], &quadrature)).collect();
        let [outside, inside] = [0, 1].map(|side| std::array::from_fn(|i| scattered[i][side]));
        let transmittance = outside.map(|s: Scattered| s.transmitted);
        // Of the table's values as they are, end points in full, because Mitsuba does so.
        let mean = |table: [f32; SIZE]| {
            2.0 / SIZE as f32 * table.iter().zip(cos).map(|(x, cos)| x * cos).sum::<f32>()
        };
        Self {
            facets,
            eta,
            transmittance,
            mean_transmittance: mean(transmittance) / mean([1.0; SIZE]),
            reflectance: outside.map(|s| s.reflected),
            internal: mean(inside.map(|s| s.reflected)),
        }
    }

    /// Transmitted fraction at a cosine.
    #[inline]
    pub(super) fn transmittance(&self, cos: f32) -> f32 {
        lerp(&self.transmittance, cos)
    }

    /// Reflected fraction of diffuse light from inside.
    #[cfg(test)]
    pub(super) fn internal(&self) -> f32 {
        self.internal
    }
}

/// Between the two entries around a cosine.
#[inline]
fn lerp(table: &[f32; SIZE], cos: f32) -> f32 {
    let x = cos.clamp(0.0, 1.0) * (SIZE - 1) as f32;
    let i = (x as usize).min(SIZE - 2);
    let t = x - i as f32;
    (1.0 - t) * table[i] + t * table[i + 1]
}

/// A coating with its base and colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughPlastic<'a> {
    coating: &'a Coating,
    /// See [`Plastic::base`](super::Plastic::base).
    base: Rgb,
    specular: Rgb,
    specular_weight: f32,
}

impl<'a> RoughPlastic<'a> {
    /// `diffuse` is the albedo of the base, `specular` a factor on the coating's reflection.
    #[inline]
    pub fn new(coating: &'a Coating, diffuse: Rgb, specular: Rgb, nonlinear: bool) -> Self {
        let base = coated_base(diffuse, coating.internal, coating.eta, nonlinear);
        Self { coating, base, specular, specular_weight: specular_share(specular, diffuse) }
    }

    /// Probability of the specular lobe where the coating transmits `t`.
    #[inline]
    fn specular_probability(&self, t: f32) -> f32 {
        let (specular, diffuse) = ((1.0 - t) * self.specular_weight, t * (1.0 - self.specular_weight));
        if specular > 0.0 { specular / (specular + diffuse) } else { 0.0 }
    }

    /// Chooses a lobe by its share of the reflected light.
    #[inline]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample> {
        if wo.z.is_nan() || wo.z <= 0.0 {
            return None;
        }
        let probability = self.specular_probability(self.coating.transmittance(wo.z));
        let wi = if u_lobe < probability { self.coating.facets.sample(wo, u)? } else { cosine_hemisphere(u) };
        self.eval(wo, wi).drawn(wi, 1.0)
    }

    /// Value and density of both lobes.
    #[inline]
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> BsdfEval {
        let coating = self.coating;
        let Some(lobe) = coating.facets.reflection(wo, wi) else { return BsdfEval::ZERO };
        let t = coating.transmittance(wo.z);
        let probability = self.specular_probability(t);
        let f = fresnel::dielectric(lobe.cos_m, coating.eta).reflectance;
        let cosine = cosine_hemisphere_pdf(wi);
        BsdfEval {
            f_cos: Split {
                diffuse: self.base * (t * coating.transmittance(wi.z) * cosine),
                specular: self.specular * (f * lobe.weight * lobe.pdf),
            },
            pdf: probability * lobe.pdf + (1.0 - probability) * cosine,
        }
    }

    /// For the feature layers; the table holds the albedos.
    pub fn features(&self, wo: Vec3) -> BsdfFeatures {
        let t = self.coating.transmittance(wo.z);
        let diffuse_albedo = self.base * (t * self.coating.mean_transmittance);
        let albedo = self.specular * lerp(&self.coating.reflectance, wo.z) + diffuse_albedo;
        let roughness = if self.has_base() { 1.0 } else { self.coating.facets.widest().sqrt() };
        BsdfFeatures { albedo, diffuse_albedo, roughness }
    }

    /// Whether there is a diffuse part.
    #[inline]
    pub fn has_base(&self) -> bool {
        self.base != Rgb::ZERO
    }

    /// Width of the specular lobe.
    #[inline]
    pub fn alpha(&self) -> f32 {
        self.coating.facets.widest()
    }
}

/// Fractions of light that a rough boundary reflects and transmits.
#[derive(Clone, Copy)]
struct Scattered {
    reflected: f32,
    transmitted: f32,
}

/// For light from the cosine `cos`, for two indices of the far side: means of F G1 and (1 − F) G1 over the visible
/// normals.
fn scattered(facets: &Microfacet, cos: f32, etas: [f32; 2], quadrature: &[(f32, f32)]) -> [Scattered; 2] {
    let wo = Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
    let mut sums = [Scattered { reflected: 0.0, transmitted: 0.0 }; 2];
    for &(y, weight_y) in quadrature {
        for &(x, weight_x) in quadrature {
            let m = facets.visible_normal(wo, Vec2::new(x, y));
            let cos_m = wo.dot(m);
            let mirrored = 2.0 * cos_m * m - wo;
            let mirrored = if mirrored.z > 0.0 { facets.g1(mirrored) } else { 0.0 };
            for (sum, eta) in sums.iter_mut().zip(etas) {
                let boundary = fresnel::dielectric(cos_m.clamp(0.0, 1.0), eta);
                let refracted = (cos_m / eta - boundary.cos_t) * m - wo / eta;
                let refracted = if refracted.z < 0.0 { facets.g1(refracted) } else { 0.0 };
                sum.reflected += weight_x * weight_y * boundary.reflectance * mirrored;
                sum.transmitted += weight_x * weight_y * (1.0 - boundary.reflectance) * refracted;
            }
        }
    }
    sums
}

/// Nodes and weights of Gauss and Legendre's rule over [0, 1].
fn quadrature() -> Vec<(f32, f32)> {
    const N: usize = 32;
    let node = |i: usize| {
        let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (N as f64 + 0.5)).cos();
        let mut derivative = 1.0;
        for _ in 0..8 {
            // P_N by its three-term recurrence, and its derivative from P_N and P_{N−1}.
            let (mut p, mut before) = (x, 1.0);
            for n in 2..=N {
                let n = n as f64;
                (p, before) = (((2.0 * n - 1.0) * x * p - (n - 1.0) * before) / n, p);
            }
            derivative = N as f64 * (x * p - before) / (x * x - 1.0);
            x -= p / derivative;
        }
        let weight = 2.0 / ((1.0 - x * x) * derivative * derivative);
        ((0.5 + 0.5 * x) as f32, (0.5 * weight) as f32)
    };
    (0..N).map(node).collect()
}
