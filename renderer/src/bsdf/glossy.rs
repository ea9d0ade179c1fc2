//! What the models without Fresnel's laws have in common: a white lobe, tinted, beside a diffuse one.

use glam::{Vec2, Vec3};

use super::{BsdfEval, BsdfFeatures, BsdfSample, albedo, specular_share};
use crate::color::{Rgb, Split};
use crate::sampling::warp::{cosine_hemisphere, cosine_hemisphere_pdf};

/// A white lobe, tinted, over a diffuse base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glossy<L> {
    diffuse: Rgb,
    specular: Rgb,
    specular_share: f32,
    lobe: L,
}

/// A lobe before its colour, above the surface.
pub trait WhiteLobe {
    /// A direction, perhaps below the horizon.
    fn draw(&self, wo: Vec3, u: Vec2) -> Vec3;
    /// For a pair of directions above the surface.
    fn at(&self, wo: Vec3, wi: Vec3) -> White;
    /// Its width as a microfacet lobe.
    fn alpha(&self) -> f32;
}

/// A white lobe for a pair of directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct White {
    /// Of its own sampling, per steradian.
    pub pdf: f32,
    /// f · cos θi / pdf.
    pub weight: f32,
}

impl<L: WhiteLobe> Glossy<L> {
    /// Colours that add up to more than 1 in a channel are scaled together until they do not, as in Mitsuba 0.x (which
    /// scales to 0.99, and a textured surface as a whole).
    #[inline]
    pub fn of(lobe: L, diffuse: Rgb, specular: Rgb) -> Self {
        let total = (diffuse + specular).max_element();
        let scale = if total > 1.0 { 1.0 / total } else { 1.0 };
        let specular_share = specular_share(specular, diffuse);
        Self { diffuse: diffuse * scale, specular: specular * scale, specular_share, lobe }
    }

    /// Chooses a lobe by its colour.
    #[inline]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample> {
        if wo.z.is_nan() || wo.z <= 0.0 {
            return None;
        }
        let wi = if u_lobe < self.specular_share { self.lobe.draw(wo, u) } else { cosine_hemisphere(u) };
        self.eval(wo, wi).drawn(wi, 1.0)
    }

    /// Value and density of both lobes.
    #[inline]
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> BsdfEval {
        if !(wo.z > 0.0 && wi.z > 0.0) {
            return BsdfEval::ZERO;
        }
        let White { pdf, weight } = self.lobe.at(wo, wi);
        let cosine = cosine_hemisphere_pdf(wi);
        BsdfEval {
            f_cos: Split { diffuse: self.diffuse * cosine, specular: self.specular * (weight * pdf) },
            pdf: self.specular_share * pdf + (1.0 - self.specular_share) * cosine,
        }
    }

    /// For the feature layers: the white lobe's albedo by quadrature over its own draws.
    pub fn features(&self, wo: Vec3) -> BsdfFeatures {
        let weight = |u| {
            let wi = self.lobe.draw(wo, u);
            if wi.z > 0.0 { self.lobe.at(wo, wi).weight } else { 0.0 }
        };
        let white = albedo::lattice::<55, 34>().map(weight).sum::<f32>() / 55.0;
        let roughness = if self.has_base() { 1.0 } else { self.alpha().sqrt() };
        BsdfFeatures { albedo: self.diffuse + self.specular * white, diffuse_albedo: self.diffuse, roughness }
    }

    /// Width of the lobe as a microfacet lobe.
    #[inline]
    pub fn alpha(&self) -> f32 {
        self.lobe.alpha()
    }

    /// Whether there is a diffuse part.
    #[inline]
    pub fn has_base(&self) -> bool {
        self.diffuse != Rgb::ZERO
    }
}
