//! Scattering at a surface.
//!
//! A [`Bsdf`] is plain numbers in the local frame (`+z` is the shading normal, on the side that the
//! scene's author gave it), made from a material at each hit; it sees neither textures nor samplers nor
//! the scene. `wo` and `wi` are unit and point away from the surface. One-sided models are zero
//! unless both lie above; the caller turns `wo` and `wi` over for two-sided materials.

mod diffuse;

use glam::{Vec2, Vec3};

use crate::color::{Rgb, Split};
pub use diffuse::Diffuse;

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

/// Scattering at one hit.
#[derive(Clone, Copy, Debug)]
pub enum Bsdf {
    /// Lambert.
    Diffuse(Diffuse),
}

impl Bsdf {
    /// Draws `wi`. `u` is uniform in `[0, 1)²` and `u_lobe` in `[0, 1)`; `None` where nothing is scattered.
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample> {
        let _ = u_lobe;
        match self {
            Self::Diffuse(b) => b.sample(wo, u),
        }
    }

    /// Value and density of everything but delta lobes.
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> BsdfEval {
        match self {
            Self::Diffuse(b) => b.eval(wo, wi),
        }
    }

    /// Whether there is anything that `eval` can see: whether a light sample is worth its ray.
    pub fn has_non_delta(&self) -> bool {
        match self {
            Self::Diffuse(_) => true,
        }
    }

    /// Albedo and roughness for the feature layers.
    pub fn features(&self, wo: Vec3) -> BsdfFeatures {
        let _ = wo;
        match self {
            Self::Diffuse(b) => BsdfFeatures { albedo: b.albedo, diffuse_albedo: b.albedo, roughness: 1.0 },
        }
    }
}
