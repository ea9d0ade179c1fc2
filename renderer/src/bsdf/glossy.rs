//! What the models without Fresnel's laws have in common: a white lobe, tinted, beside a diffuse one.

use glam::{Vec2, Vec3};

use super::{BsdfEval, BsdfFeatures, BsdfSample, albedo, specular_share};
use crate::color::{Rgb, Split};
use crate::sampling::warp::{cosine_hemisphere, cosine_hemisphere_pdf};

/// The colours of the two lobes, and how to choose between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glossy {
    diffuse: Rgb,
    specular: Rgb,
    specular_share: f32,
}

/// A white lobe for a pair of directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WhiteLobe {
    /// Of its own sampling, per steradian.
    pub pdf: f32,
    /// f · cos θi / pdf.
    pub weight: f32,
}

impl Glossy {
    /// Colours that add up to more than 1 in a channel are scaled together until they do not, as in Mitsuba 0.x (which
    /// scales to 0.99, and a textured surface as a whole).
    #[inline]
    pub fn new(diffuse: Rgb, specular: Rgb) -> Self {
        let total = (diffuse + specular).max_element();
        let scale = if total > 1.0 { 1.0 / total } else { 1.0 };
        let specular_share = specular_share(specular, diffuse);
        Self { diffuse: diffuse * scale, specular: specular * scale, specular_share }
    }

    /// Value and density of both lobes, both directions being above the surface.
    #[inline]
    pub fn eval(&self, wi: Vec3, lobe: WhiteLobe) -> BsdfEval {
        let cosine = cosine_hemisphere_pdf(wi);
        BsdfEval {
            f_cos: Split {
                diffuse: self.diffuse * cosine,
                specular: self.specular * (lobe.weight * lobe.pdf),
            },
            pdf: self.specular_share * lobe.pdf + (1.0 - self.specular_share) * cosine,
        }
    }

    /// Draws from the white lobe by `draw`, or the diffuse one; `eval` is of both.
    #[inline]
    pub fn sample(
        &self,
        u_lobe: f32,
        u: Vec2,
        draw: impl FnOnce(Vec2) -> Vec3,
        eval: impl FnOnce(Vec3) -> BsdfEval,
    ) -> Option<BsdfSample> {
        let wi = if u_lobe < self.specular_share { draw(u) } else { cosine_hemisphere(u) };
        let value = eval(wi);
        // Below, in the far tail of a needle over a black base, the quotient would lose its digits.
        (value.pdf >= f32::MIN_POSITIVE).then(|| BsdfSample {
            wi,
            weight: value.f_cos * (1.0 / value.pdf),
            pdf: value.pdf,
            delta: false,
            eta: 1.0,
        })
    }

    /// For the feature layers: the white lobe's albedo by quadrature over `POINTS` of its own draws, whose weights `lobe`
    /// gives (0 below the horizon). `alpha` is its width as a microfacet lobe.
    pub fn features<const POINTS: u32, const STEP: u32>(
        &self,
        alpha: f32,
        lobe: impl Fn(Vec2) -> f32,
    ) -> BsdfFeatures {
        let white = albedo::lattice::<POINTS, STEP>().map(lobe).sum::<f32>() / POINTS as f32;
        let roughness = if self.has_base() { 1.0 } else { alpha.sqrt() };
        BsdfFeatures { albedo: self.diffuse + self.specular * white, diffuse_albedo: self.diffuse, roughness }
    }

    /// Whether there is a diffuse part.
    #[inline]
    pub fn has_base(&self) -> bool {
        self.diffuse != Rgb::ZERO
    }
}
