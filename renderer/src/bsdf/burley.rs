//! What Burley's models share: widths of the facets, Schlick's reflectances, the diffuse base with its sheen
//! (Burley 2012, "Physically Based Shading at Disney"; 2015, "Extending the Disney BRDF to a BSDF with Integrated
//! Subsurface Scattering"), in the form that Mitsuba 3 gives them.

use std::f32::consts::{FRAC_1_PI, PI};

use glam::Vec3;
use limpid_scenes::Distribution;

use super::microfacet::Microfacet;
use crate::color::{Rgb, luminance};

/// Mitsuba's bound on the widths.
const SMALLEST_ALPHA: f32 = 1e-3;

/// GGX of width roughness², stretched along u by `anisotropic` (2012, section 5.4).
#[inline]
pub fn facets(roughness: f32, anisotropic: f32) -> Microfacet {
    let (alpha, aspect) = (roughness * roughness, (1.0 - 0.9 * anisotropic).sqrt());
    let [u, v] = [alpha / aspect, alpha * aspect].map(|alpha| alpha.max(SMALLEST_ALPHA));
    Microfacet::new(Distribution::Ggx, u, v)
}

/// A dial in [0, 1]; NaN counts as 0.
#[inline]
pub fn dial(x: f32) -> f32 {
    if x > 0.0 { x.min(1.0) } else { 0.0 }
}

/// Mean of the channels for the choice between lobes: finite whatever a texture holds.
#[inline]
pub fn mean(c: Rgb) -> f32 {
    let mean = c.element_sum() / 3.0;
    if mean > 0.0 { mean.min(1e3) } else { 0.0 }
}

/// `(1 − cos)⁵`.
#[inline]
pub fn schlick_weight(cos: f32) -> f32 {
    let x = (1.0 - cos).clamp(0.0, 1.0);
    let x2 = x * x;
    x2 * x2 * x
}

/// The same on the thinner side of the boundary to a medium of relative index `eta`, where the curve belongs (1 under
/// total reflection).
#[inline]
pub fn schlick_weight_into(cos: f32, eta: f32) -> f32 {
    if eta > 1.0 {
        return schlick_weight(cos);
    }
    schlick_weight((1.0 - (1.0 - cos) * (1.0 + cos) / (eta * eta)).max(0.0).sqrt())
}

/// Where light is refracted the index differs from 1 at least so much: refraction at matched indices is a needle that
/// `f32` directions do not resolve. (Mitsuba replaces 1 by 1.001.)
const NEAREST_TO_MATCHED: f32 = 1e-3;

/// An index of refraction, kept from 1.
#[inline]
pub fn unmatched(eta: f32) -> f32 {
    if (eta - 1.0).abs() < NEAREST_TO_MATCHED { 1.0 + NEAREST_TO_MATCHED.copysign(eta - 1.0) } else { eta }
}

/// A cosine to the facets that are seen, for an estimate of their mean reflectance: at grazing incidence rough facets
/// turn towards the viewer. The factor is right for width 1, where the mean of Schlick's weight is 1/21.
#[inline]
pub fn facing(cos: f32, roughness: f32) -> f32 {
    cos + 0.455 * roughness * roughness * (1.0 - cos)
}

/// Reflectance at normal incidence.
#[inline]
pub fn normal_reflectance(eta: f32) -> f32 {
    let r = (eta - 1.0) / (eta + 1.0);
    r * r
}

/// The hue of a colour: the colour over its luminance; white for black.
#[inline]
pub fn hue(base: Rgb) -> Rgb {
    let luminance = luminance(base);
    if luminance > 0.0 { base / luminance } else { Rgb::ONE }
}

/// Diffuse reflection with retro-reflection of rough surfaces (2012, section 5.3), flattened towards that of a scattering
/// medium (2015, section 4.4 and appendix), and sheen (2012, section 5.5). Of directions above the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Base {
    /// Albedo at normal incidence, times the share of the diffuse lobe.
    pub color: Rgb,
    /// Of the sheen, f at grazing incidence.
    pub sheen: Rgb,
    /// In [0, 1].
    pub roughness: f32,
    /// From 0, Burley's diffuse reflection, to 1, his approximation of Hanrahan and Krueger's.
    pub flatness: f32,
}

impl Base {
    /// The sheen's colour at grazing incidence: white, tinted towards the base.
    #[inline]
    pub fn sheen(base: Rgb, sheen: f32, tint: f32) -> Rgb {
        sheen * if tint > 0.0 { Rgb::ONE + (hue(base) - Rgb::ONE) * tint } else { Rgb::ONE }
    }

    /// Whether nothing is scattered.
    #[inline]
    pub fn is_black(&self) -> bool {
        self.color == Rgb::ZERO && self.sheen == Rgb::ZERO
    }

    /// Estimate of the albedo, for the choice between lobes.
    #[inline]
    pub fn estimate(&self, schlick_o: f32) -> f32 {
        mean(self.color) + (0.01 + 0.3 * schlick_o) * mean(self.sheen)
    }

    /// `f · cos θi`; `schlick_o` is the [`schlick_weight`] of wo.z.
    ///
    /// ```text
    /// F_x = (1 − cos θx)⁵     R = 2 roughness cos² θd     with θd between half vector and either direction
    /// f_d  = (1 − F_o/2) (1 − F_i/2) + R (F_o + F_i + F_o F_i (R − 1))
    /// f_ss = 1.25 (S_o S_i (1 / (cos θo + cos θi) − ½) + ½)     with S_x = 1 + F_x (R/2 − 1)
    /// f    = color / π · (f_d + flatness (f_ss − f_d)) + sheen (1 − cos θd)⁵
    /// ```
    #[inline]
    pub fn f_cos(&self, wo: Vec3, wi: Vec3, schlick_o: f32) -> Rgb {
        let (fo, fi) = (schlick_o, schlick_weight(wi.z));
        let cos2_d = (0.5 + 0.5 * wo.dot(wi)).max(0.0);
        let r = 2.0 * self.roughness * cos2_d;
        let mut f_cos = ((1.0 - 0.5 * fo) * (1.0 - 0.5 * fi) + r * (fo + fi + fo * fi * (r - 1.0))) * wi.z;
        if self.flatness > 0.0 {
            let s = (1.0 + fo * (0.5 * r - 1.0)) * (1.0 + fi * (0.5 * r - 1.0));
            // The cosine is taken into the quotient, which has no limit where both cosines are small.
            let half = 0.5 * wi.z;
            let subsurface = 1.25 * (s * (wi.z / (wo.z + wi.z) - half) + half);
            f_cos += self.flatness * (subsurface - f_cos);
        }
        let mut sum = self.color * (FRAC_1_PI * f_cos);
        if self.sheen != Rgb::ZERO {
            sum += self.sheen * (schlick_weight(cos2_d.sqrt()) * wi.z);
        }
        sum
    }

    /// Directional albedo from the cosine `cos` > 0 of `wo`.
    pub fn albedo(&self, cos: f32) -> Rgb {
        if self.is_black() {
            return Rgb::ZERO;
        }
        let schlick_o = schlick_weight(cos);
        hemisphere(cos, |wo, wi| self.f_cos(wo, wi, schlick_o))
    }
}

/// ∫ f(wo, wi) dωi over the hemisphere for an f that is smooth, the same under a turn about the normal, and falls with
/// cos θi to 0: by Gauss's rule over cos θi and the midpoint rule over the azimuth. `cos` is that of `wo`.
pub fn hemisphere(cos: f32, f: impl Fn(Vec3, Vec3) -> Rgb) -> Rgb {
    /// Nodes in [0, 1] and their weights.
    const COSINES: [(f32, f32); 6] = [
        (0.033_765_24, 0.085_662_25),
        (0.169_395_31, 0.180_380_79),
        (0.380_690_4, 0.233_956_97),
        (0.619_309_6, 0.233_956_97),
        (0.830_604_7, 0.180_380_79),
        (0.966_234_76, 0.085_662_25),
    ];
    /// Cosine and sine of π/8, 3π/8, …: half the circle, as the other half is its mirror image.
    const AZIMUTHS: [(f32, f32); 4] = {
        const C: f32 = 0.923_879_5;
        const S: f32 = 0.382_683_43;
        [(C, S), (S, C), (-S, C), (-C, S)]
    };
    let sin = |cos: f32| ((1.0 - cos) * (1.0 + cos)).max(0.0).sqrt();
    let wo = Vec3::new(sin(cos), 0.0, cos);
    let ring = |&(z, weight): &(f32, f32)| {
        let towards = |&(x, y): &(f32, f32)| Vec3::new(sin(z) * x, sin(z) * y, z);
        AZIMUTHS.iter().map(|a| f(wo, towards(a))).sum::<Rgb>() * weight
    };
    COSINES.iter().map(ring).sum::<Rgb>() * (2.0 * PI / AZIMUTHS.len() as f32)
}
