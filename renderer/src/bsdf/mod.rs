//! Scattering at a surface.
//!
//! A [`Bsdf`] is plain numbers in the local frame (`+z` is the shading normal, on the side that the
//! scene's author gave it), made from a material at each hit; it sees neither textures nor samplers nor
//! the scene. `wo` and `wi` are unit and point away from the surface. One-sided models are zero
//! unless both lie above; the caller turns `wo` and `wi` over for two-sided materials.

mod albedo;
mod beckmann;
mod burley;
mod clearcoat;
mod coat;
mod conductor;
mod dielectric;
mod diffuse;
mod fresnel;
mod glossy;
mod gltf;
mod lobes;
mod microfacet;
mod phong;
mod plastic;
mod principled;
mod principled_thin;
mod rough_conductor;
mod rough_dielectric;
mod rough_diffuse;
mod rough_plastic;
mod sheen;
mod thin_dielectric;
mod ward;

use glam::{Vec2, Vec3};

use crate::color::{Rgb, Split};
pub use coat::{Coat, Layer};
pub use conductor::{Conductor, Ior};
pub use dielectric::Dielectric;
pub use diffuse::Diffuse;
pub use gltf::{Gltf, GltfDials};
pub use lobes::{Lobes, MOST_COATS, MOST_LOBES, Perturbation, Turn};
pub use microfacet::Microfacet;
pub use phong::Phong;
pub use plastic::Plastic;
pub use principled::{Principled, PrincipledDials};
pub use principled_thin::{PrincipledThin, PrincipledThinDials};
pub use rough_conductor::RoughConductor;
pub use rough_dielectric::RoughDielectric;
pub use rough_diffuse::RoughDiffuse;
pub use rough_plastic::{Coating, RoughPlastic};
pub use thin_dielectric::ThinDielectric;
pub use ward::Ward;

/// A sampled direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BsdfSample {
    /// Unit, away from the surface.
    pub wi: Vec3,
    /// `f · cos θi / pdf` of the whole BSDF towards `wi` (one-sample model over the lobes), part by part.
    pub weight: Split,
    /// Density per steradian over all lobes; 1 for a delta lobe, where it means nothing.
    pub pdf: f32,
    /// `wi` came from a delta lobe: no light sample can reach it.
    pub delta: bool,
    /// Index of refraction on the far side of `wo` over that on its side, where `wi` went through; else 1.
    pub eta: f32,
}

/// `f · cos θi`, part by part, and the density with which `sample` draws `wi`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BsdfEval {
    /// `f · cos θi`.
    pub f_cos: Split,
    /// Per steradian.
    pub pdf: f32,
}

impl BsdfEval {
    /// Nothing scattered, never sampled.
    pub const ZERO: Self = Self { f_cos: Split::ZERO, pdf: 0.0 };

    /// The sample of a direction drawn by this density. `None` below the smallest normal number: in the far tail of a
    /// needle the quotient would lose its digits.
    #[inline]
    fn drawn(self, wi: Vec3, eta: f32) -> Option<BsdfSample> {
        let Self { f_cos, pdf } = self;
        (pdf >= f32::MIN_POSITIVE).then(|| BsdfSample {
            wi,
            weight: f_cos * (1.0 / pdf),
            pdf,
            delta: false,
            eta,
        })
    }
}

/// What the feature layers want to know of a BSDF, for one `wo`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BsdfFeatures {
    /// Directional-hemispherical reflectance, within 5 %; a pure delta BSDF gives its tint here too.
    pub albedo: Rgb,
    /// Of the diffuse part alone.
    pub diffuse_albedo: Rgb,
    /// √alpha of the widest microfacet lobe; 1 where there is a diffuse part; 0 for pure delta.
    pub roughness: f32,
}

/// A lobe narrower than this counts as a mirror for the feature layers.
const NEAR_DELTA_ALPHA: f32 = 0.01;

/// Scattering at one hit. It borrows the tables of its material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bsdf<'a> {
    /// Lambert.
    Diffuse(Diffuse),
    /// Smooth metal.
    Conductor(Conductor),
    /// Rough metal.
    RoughConductor(RoughConductor),
    /// Smooth glass.
    Dielectric(Dielectric),
    /// Smooth coating over a diffuse base.
    Plastic(Plastic),
    /// Rough coating over a diffuse base.
    RoughPlastic(RoughPlastic<'a>),
    /// Rough glass.
    RoughDielectric(RoughDielectric),
    /// A pane of glass.
    ThinDielectric(ThinDielectric),
    /// Oren and Nayar.
    RoughDiffuse(RoughDiffuse),
    /// Modified Phong.
    Phong(Phong),
    /// Ward.
    Ward(Ward),
    /// Burley's, with an inside.
    Principled(Principled),
    /// Burley's, of a sheet.
    PrincipledThin(PrincipledThin),
    /// The material of glTF.
    Gltf(Gltf),
}

impl Bsdf<'_> {
    /// Draws `wi`. `u` is uniform in `[0, 1)²` and `u_lobe` in `[0, 1)`; `None` where nothing is scattered.
    #[inline]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample> {
        match self {
            Self::Diffuse(b) => b.sample(wo, u),
            Self::Conductor(b) => b.sample(wo),
            Self::RoughConductor(b) => b.sample(wo, u),
            Self::Dielectric(b) => b.sample(wo, u_lobe),
            Self::Plastic(b) => b.sample(wo, u_lobe, u),
            Self::RoughPlastic(b) => b.sample(wo, u_lobe, u),
            Self::RoughDielectric(b) => b.sample(wo, u_lobe, u),
            Self::ThinDielectric(b) => b.sample(wo, u_lobe),
            Self::RoughDiffuse(b) => b.sample(wo, u),
            Self::Phong(b) => b.sample(wo, u_lobe, u),
            Self::Ward(b) => b.sample(wo, u_lobe, u),
            Self::Principled(b) => b.sample(wo, u_lobe, u),
            Self::PrincipledThin(b) => b.sample(wo, u_lobe, u),
            Self::Gltf(b) => b.sample(wo, u_lobe, u),
        }
    }

    /// Value and density of everything but delta lobes.
    #[inline]
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> BsdfEval {
        match self {
            Self::Diffuse(b) => b.eval(wo, wi),
            Self::Conductor(_) | Self::Dielectric(_) | Self::ThinDielectric(_) => BsdfEval::ZERO,
            Self::RoughConductor(b) => b.eval(wo, wi),
            Self::Plastic(b) => b.eval(wo, wi),
            Self::RoughPlastic(b) => b.eval(wo, wi),
            Self::RoughDielectric(b) => b.eval(wo, wi),
            Self::RoughDiffuse(b) => b.eval(wo, wi),
            Self::Phong(b) => b.eval(wo, wi),
            Self::Ward(b) => b.eval(wo, wi),
            Self::Principled(b) => b.eval(wo, wi),
            Self::PrincipledThin(b) => b.eval(wo, wi),
            Self::Gltf(b) => b.eval(wo, wi),
        }
    }

    /// Whether there is anything that `eval` can see: whether a light sample is worth its ray.
    #[inline]
    pub fn has_non_delta(&self) -> bool {
        match self {
            Self::Diffuse(_) | Self::RoughDiffuse(_) => true,
            Self::RoughConductor(_) | Self::RoughPlastic(_) | Self::Phong(_) | Self::Ward(_) => true,
            Self::Conductor(_) | Self::Dielectric(_) | Self::ThinDielectric(_) => false,
            Self::Plastic(b) => b.has_base(),
            Self::RoughDielectric(b) => !b.is_matched(),
            Self::Principled(_) | Self::PrincipledThin(_) | Self::Gltf(_) => true,
        }
    }

    /// Whether all of it is a mirror or glass, or so nearly that what it shows is a better feature than itself: every
    /// lobe is delta or has an alpha below 0.01.
    #[inline]
    pub fn near_delta(&self) -> bool {
        match self {
            Self::Diffuse(_) | Self::RoughDiffuse(_) => false,
            Self::Conductor(_) | Self::Dielectric(_) | Self::ThinDielectric(_) => true,
            Self::RoughConductor(b) => b.facets.widest() < NEAR_DELTA_ALPHA,
            Self::Plastic(b) => !b.has_base(),
            Self::RoughPlastic(b) => !b.has_base() && b.alpha() < NEAR_DELTA_ALPHA,
            Self::RoughDielectric(b) => b.is_matched() || b.facets.widest() < NEAR_DELTA_ALPHA,
            Self::Phong(b) => !b.has_base() && b.alpha() < NEAR_DELTA_ALPHA,
            Self::Ward(b) => !b.has_base() && b.alpha() < NEAR_DELTA_ALPHA,
            Self::Principled(b) => b.near_delta(),
            Self::PrincipledThin(b) => b.near_delta(),
            Self::Gltf(b) => b.near_delta(),
        }
    }

    /// Albedo and roughness for the feature layers.
    pub fn features(&self, wo: Vec3) -> BsdfFeatures {
        match self {
            Self::Diffuse(b) => BsdfFeatures { albedo: b.albedo, diffuse_albedo: b.albedo, roughness: 1.0 },
            Self::Conductor(b) => b.features(wo),
            Self::RoughConductor(b) => b.features(wo),
            Self::Dielectric(b) => b.features(wo),
            Self::Plastic(b) => b.features(wo),
            Self::RoughPlastic(b) => b.features(wo),
            Self::RoughDielectric(b) => b.features(wo),
            Self::ThinDielectric(b) => b.features(wo),
            Self::RoughDiffuse(b) => b.features(wo),
            Self::Phong(b) => b.features(wo),
            Self::Ward(b) => b.features(wo),
            Self::Principled(b) => b.features(wo),
            Self::PrincipledThin(b) => b.features(wo),
            Self::Gltf(b) => b.features(wo),
        }
    }
}

/// Share of the specular lobe in the choice between it and the diffuse one, by the means of their colours, before what
/// the coating reflects counts; ½ where neither scatters.
fn specular_share(specular: Rgb, diffuse: Rgb) -> f32 {
    let (specular, diffuse) = (specular.element_sum().max(0.0), diffuse.element_sum().max(0.0));
    let share = specular / (specular + diffuse);
    if share.is_finite() { share } else { 0.5 }
}

#[cfg(test)]
mod tests;
