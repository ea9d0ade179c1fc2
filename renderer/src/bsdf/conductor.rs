//! Metals: smooth and rough.

use glam::{Vec2, Vec3};

use super::fresnel;
use super::microfacet::{Microfacet, half_vector};
use super::{BsdfEval, BsdfSample, albedo};
use crate::color::{Rgb, Split};

/// What a metal's boundary reflects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metal {
    /// η and k per channel; `None` reflects everything.
    pub ior: Option<(Rgb, Rgb)>,
    /// Factor on the reflection.
    pub tint: Rgb,
}

impl Metal {
    /// Reflected fraction at a cosine that is not negative.
    pub fn reflectance(&self, cos: f32) -> Rgb {
        match self.ior {
            Some((eta, k)) => self.tint * fresnel::conductor(cos, eta, k),
            None => self.tint,
        }
    }
}

/// A mirror of metal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conductor {
    /// Its boundary.
    pub metal: Metal,
}

impl Conductor {
    /// The mirror direction.
    pub fn sample(&self, wo: Vec3) -> Option<BsdfSample> {
        (wo.z > 0.0).then(|| BsdfSample {
            wi: Vec3::new(-wo.x, -wo.y, wo.z),
            weight: Split::specular(self.metal.reflectance(wo.z)),
            pdf: 1.0,
            delta: true,
            eta: 1.0,
        })
    }
}

/// Rough metal, single scattering: f = F D G / (4 cos θi cos θo) (Cook and Torrance; Walter et al. 2007).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughConductor {
    /// Its boundary.
    pub metal: Metal,
    /// The facets.
    pub microfacet: Microfacet,
}

impl RoughConductor {
    /// Mirrors `wo` at a visible normal: what remains of the weight is F G1(wi).
    pub fn sample(&self, wo: Vec3, u: Vec2) -> Option<BsdfSample> {
        if wo.z <= 0.0 {
            return None;
        }
        let m = self.microfacet.sample_visible(wo, u);
        let cos = wo.dot(m);
        let wi = (2.0 * cos * m - wo).normalize();
        if wi.z <= 0.0 || cos <= 0.0 {
            return None;
        }
        let pdf = self.microfacet.visible_pdf(wo, m) / (4.0 * cos);
        if !(pdf > 0.0 && pdf.is_finite()) {
            return None;
        }
        let weight = self.metal.reflectance(cos) * self.microfacet.g1(wi, m);
        Some(BsdfSample { wi, weight: Split::specular(weight), pdf, delta: false, eta: 1.0 })
    }

    /// Value and density.
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> BsdfEval {
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return BsdfEval::ZERO;
        }
        let Some(m) = half_vector(wo, wi) else { return BsdfEval::ZERO };
        let facets = &self.microfacet;
        let cos = wo.dot(m);
        let pdf = facets.d(m) * facets.g1(wo, m) / (4.0 * wo.z);
        let f_cos = self.metal.reflectance(cos.max(0.0)) * (pdf * facets.g1(wi, m));
        if !(f_cos.is_finite() && pdf.is_finite()) {
            return BsdfEval::ZERO;
        }
        BsdfEval { f_cos: Split::specular(f_cos), pdf }
    }

    /// Directional albedo, within a few per cent.
    pub fn albedo(&self, wo: Vec3) -> Rgb {
        let normal = self.metal.reflectance(1.0);
        albedo::specular(&self.microfacet, wo.z, normal, self.metal.reflectance(0.0))
    }
}
