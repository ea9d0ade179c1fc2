//! Rough metal.

use glam::{Vec2, Vec3};

use super::conductor::{Ior, tint};
use super::microfacet::Microfacet;
use super::{BsdfEval, BsdfFeatures, BsdfSample, albedo};
use crate::color::{Rgb, Split};

/// Mirrors of metal in all directions of a microfacet distribution, with single scattering.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughConductor {
    /// Distribution of the facets.
    pub facets: Microfacet,
    /// `None`: the facets reflect everything.
    pub ior: Option<Ior>,
    /// Factor on the reflection.
    pub specular: Rgb,
}

impl RoughConductor {
    /// By visible normals: D cancels, and the weight is F G1(wi).
    #[inline]
    pub fn sample(&self, wo: Vec3, u: Vec2) -> Option<BsdfSample> {
        let wi = self.facets.sample(wo, u)?;
        let lobe = self.facets.reflection(wo, wi)?;
        let weight = tint(self.ior, self.specular, lobe.cos_m) * lobe.weight;
        // A density can underflow in the far tail, but not be zero where a sample was drawn.
        let pdf = lobe.pdf.max(f32::MIN_POSITIVE);
        Some(BsdfSample { wi, weight: Split::specular(weight), pdf, delta: false, eta: 1.0 })
    }

    /// Value and density.
    #[inline]
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> BsdfEval {
        let Some(lobe) = self.facets.reflection(wo, wi) else { return BsdfEval::ZERO };
        let f_cos = tint(self.ior, self.specular, lobe.cos_m) * (lobe.weight * lobe.pdf);
        BsdfEval { f_cos: Split::specular(f_cos), pdf: lobe.pdf }
    }

    /// For the feature layers.
    pub fn features(&self, wo: Vec3) -> BsdfFeatures {
        let reflectance = |cos| tint(self.ior, self.specular, cos);
        let albedo = match self.facets.isotropic() {
            Some((distribution, alpha)) => albedo::albedo(distribution, alpha, wo.z, reflectance),
            None => self.integrated_albedo(wo),
        };
        BsdfFeatures { albedo, diffuse_albedo: Rgb::ZERO, roughness: self.facets.widest().sqrt() }
    }

    /// By quadrature over the visible normals: right for any facets, at the price of as many samples.
    fn integrated_albedo(&self, wo: Vec3) -> Rgb {
        let weight = |u: Vec2| self.sample(wo, u).map_or(Rgb::ZERO, |s| s.weight.specular);
        albedo::lattice::<55, 34>().map(weight).sum::<Rgb>() / 55.0
    }
}
