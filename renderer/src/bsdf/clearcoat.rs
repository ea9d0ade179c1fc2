//! The clear coat of Burley's model (2012, section 5.6): a lobe with long tails over everything else.

use std::f32::consts::{FRAC_1_PI, TAU};

use glam::{Vec2, Vec3};

use super::albedo::lattice;
use super::burley::schlick_weight_into;

/// Facets distributed by "GTR" of exponent 1 (2012, eq. 4), with the reflectance of index 1.5 and the masking of GGX of
/// width ¼, whatever the gloss:
///
/// ```text
/// f = ¼ clearcoat F D(m) G1(wo) G1(wi)     D(m) = (α² − 1) / (π ln α² (1 + (α² − 1) cos² θm))
/// ```
///
/// Burley's G includes the factor 1 / (4 cos θo cos θi) of microfacet models; as in Mitsuba 3.9.1, whose pictures these
/// shall be, it does not, so that the coat is four times Burley's at normal incidence and fades out at grazing. What the
/// coat reflects is not taken from what lies below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearcoat {
    /// ¼ `clearcoat`.
    weight: f32,
    alpha2: f32,
    /// D sin² θm for large θm.
    scale: f32,
}

/// Reflectance at normal incidence.
const F0: f32 = 0.04;
/// Square of the width in the masking.
const MASKING2: f32 = 0.25 * 0.25;

impl Clearcoat {
    /// Both in [0, 1]; `gloss` goes from a width of 0.1 to one of 0.001.
    #[inline]
    pub fn new(clearcoat: f32, gloss: f32) -> Self {
        if clearcoat <= 0.0 {
            return Self { weight: 0.0, alpha2: 1e-6, scale: 0.0 };
        }
        let alpha = 0.1 + (0.001 - 0.1) * gloss;
        let alpha2 = alpha * alpha;
        let scale = (alpha2 - 1.0) / alpha2.ln() * FRAC_1_PI;
        Self { weight: 0.25 * clearcoat, alpha2, scale }
    }

    /// Whether there is any.
    #[inline]
    pub fn is_there(&self) -> bool {
        self.weight > 0.0
    }

    /// Width of the lobe.
    #[inline]
    pub fn alpha(&self) -> f32 {
        self.alpha2.sqrt()
    }

    /// Estimate of the albedo, for the choice between lobes; `schlick_o` is the Schlick weight of `cos`.
    #[inline]
    pub fn estimate(&self, cos: f32, schlick_o: f32) -> f32 {
        4.0 * self.weight * (F0 + (1.0 - F0) * schlick_o) * cos
    }

    /// Draws `wi` for a `wo` above the surface by mirroring it at a facet of density D(m) cos θm.
    #[inline]
    pub fn sample(&self, wo: Vec3, u: Vec2) -> Option<Vec3> {
        // Of both sine and cosine by itself: near 0 either would lose its digits as 1 less the other.
        let log = self.alpha2.ln();
        let sin2 = self.alpha2 * (-u.y * log).exp_m1() / (1.0 - self.alpha2);
        let cos2 = -((1.0 - u.y) * log).exp_m1() / (1.0 - self.alpha2);
        let (sin, cos) = (sin2.max(0.0).sqrt(), cos2.max(0.0).sqrt());
        let (sin_phi, cos_phi) = (TAU * u.x).sin_cos();
        let m = Vec3::new(sin * cos_phi, sin * sin_phi, cos).normalize();
        let wi = (2.0 * wo.dot(m) * m - wo).normalize();
        (wi.z > 0.0).then_some(wi)
    }

    /// `f · cos θi` and the density of [`sample`](Self::sample), for directions above the surface; `eta` is the index of
    /// what lies below, on whose side of 1 depends where the reflectance's curve belongs.
    #[inline]
    pub fn eval(&self, wo: Vec3, wi: Vec3, eta: f32) -> (f32, f32) {
        let Some(m) = (wo + wi).try_normalize().filter(|_| self.is_there()) else { return (0.0, 0.0) };
        let cos_m = wo.dot(m);
        if cos_m <= 0.0 {
            return (0.0, 0.0);
        }
        let d = self.scale / (m.x * m.x + m.y * m.y + self.alpha2 * m.z * m.z);
        let f = F0 + (1.0 - F0) * schlick_weight_into(cos_m, eta);
        // Beyond all range near the horizon, where nothing is drawn.
        let pdf = (d * m.z / (4.0 * cos_m)).min(1e30);
        (self.weight * f * d * g1(wo.z) * g1(wi.z) * wi.z, pdf)
    }

    /// Directional albedo for a `wo` above the surface; `eta` as in [`eval`](Self::eval).
    pub fn albedo(&self, wo: Vec3, eta: f32) -> f32 {
        if !self.is_there() {
            return 0.0;
        }
        let weight = |u: Vec2| {
            let Some(wi) = self.sample(wo, u) else { return 0.0 };
            let (f_cos, pdf) = self.eval(wo, wi, eta);
            if pdf > 0.0 { f_cos / pdf } else { 0.0 }
        };
        lattice::<55, 34>().map(weight).sum::<f32>() / 55.0
    }
}

/// Smith's masking of isotropic GGX.
#[inline]
fn g1(cos: f32) -> f32 {
    2.0 * cos / (cos + (cos * cos + MASKING2 * (1.0 - cos) * (1.0 + cos)).sqrt())
}
