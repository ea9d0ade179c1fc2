//! Microfacet distributions with sampling of visible normals.
//!
//! The reflection lobe that all rough models share is f = F D(m) G1(wo) G1(wi) / (4 cos θo cos θi) with m the half
//! vector (Walter et al. 2007), D normalised so that ∫ D(m) cos θm dm = 1, and Smith's masking, separable. Widths
//! `alpha` are used as they are, not squared.

use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};
use limpid_scenes::Distribution;

use super::beckmann;

/// A distribution of facet normals, with its widths along x and y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Microfacet {
    distribution: Distribution,
    alpha: Vec2,
}

/// Narrower lobes are below what `f32` directions resolve; Mitsuba's bound, too.
const SMALLEST_ALPHA: f32 = 1e-4;
/// Beyond any use, but its squares stay in range.
const LARGEST_ALPHA: f32 = 1e3;

/// What the table of albedos reaches to.
pub const LARGEST_TABULATED: f32 = 1.0;

/// A direction mirrored or refracted at a facet, and what the lobe without its reflectance F, or transmittance 1 − F, is
/// there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lobe {
    /// Cosine of `wo` to the half vector, in [0, 1]: the argument of F.
    pub cos_m: f32,
    /// Per steradian, with which mirroring or refracting at [`Microfacet::visible_normal`] draws `wi`.
    pub pdf: f32,
    /// f · cos θi / (F · pdf): does not underflow where both do. Of refraction it is that of energy: radiance has the
    /// factor 1/η² besides.
    pub weight: f32,
}

impl Microfacet {
    /// Widths are kept within [1e-4, 1e3]; a NaN becomes the smallest.
    #[inline]
    pub fn new(distribution: Distribution, alpha_u: f32, alpha_v: f32) -> Self {
        let alpha = Vec2::new(alpha_u.max(SMALLEST_ALPHA), alpha_v.max(SMALLEST_ALPHA));
        Self { distribution, alpha: alpha.min(Vec2::splat(LARGEST_ALPHA)) }
    }

    /// The larger width.
    #[inline]
    pub fn widest(&self) -> f32 {
        self.alpha.max_element()
    }

    /// Family and width, where they are within the table of albedos.
    pub fn isotropic(&self) -> Option<(Distribution, f32)> {
        let alpha = self.alpha.x;
        (alpha == self.alpha.y && alpha <= LARGEST_TABULATED).then_some((self.distribution, alpha))
    }

    /// Draws `wi` by mirroring `wo` at a visible normal; `None` where it falls below the horizon (light that would have
    /// gone on to other facets) or `wo` is.
    #[inline]
    pub fn sample(&self, wo: Vec3, u: Vec2) -> Option<Vec3> {
        if wo.z.is_nan() || wo.z <= 0.0 {
            return None;
        }
        let m = self.visible_normal(wo, u);
        let wi = 2.0 * wo.dot(m) * m - wo;
        (wi.z > 0.0).then_some(wi)
    }

    /// The lobe for a pair of directions; `None` unless both lie above the surface.
    ///
    /// `sample` is followed by this too, so that a direction has one density however it was found.
    #[inline]
    pub fn reflection(&self, wo: Vec3, wi: Vec3) -> Option<Lobe> {
        if !(wo.z > 0.0 && wi.z > 0.0) {
            return None;
        }
        let m = (wo + wi).try_normalize()?;
        let (density, weight) = self.masked(wo, wi, m);
        Some(Lobe { cos_m: wo.dot(m).clamp(0.0, 1.0), pdf: 0.25 * density, weight })
    }

    /// The same for refraction into a medium of relative index `eta`, not 1; `None` unless `wo` lies above the surface,
    /// `wi` below, and each on its own side of the facet between them. The half vector is along wo + η wi (Walter et al.
    /// 2007, eq. 16), and dω_m / dω_i = η² |wi·m| / |wo + η wi|² (eq. 17).
    ///
    /// In f64 and of directions made unit there: that sum is as short as η − 1, and what the rounding of their lengths
    /// to f32 would leave of it is noise. (That of where they point is left: see
    /// [`RoughDielectric`](super::RoughDielectric).)
    #[inline]
    pub fn refraction(&self, wo: Vec3, wi: Vec3, eta: f32) -> Option<Lobe> {
        if !(wo.z > 0.0 && wi.z < 0.0) {
            return None;
        }
        let (o, i, n) = (wo.as_dvec3().normalize(), wi.as_dvec3().normalize(), f64::from(eta));
        let sum = o + n * i;
        let length2 = sum.length_squared();
        let m = sum * (sum.z.signum() / length2.sqrt());
        let (cos_o, cos_i) = (o.dot(m), i.dot(m));
        // Not so for an infinite or undefined half vector, either.
        if !(cos_o > 0.0 && cos_i < 0.0) {
            return None;
        }
        let (density, weight) = self.masked(wo, wi, m.as_vec3());
        let pdf = density * (cos_o * n * n * -cos_i / length2) as f32;
        Some(Lobe { cos_m: (cos_o as f32).min(1.0), pdf, weight })
    }

    /// For a facet `m`: D(m) G1(wo) / cos θo, which is the density with which `visible_normal` draws it over its cosine to
    /// `wo`; and what the masking leaves of the light, G1(wi).
    #[inline]
    pub fn masked(&self, wo: Vec3, wi: Vec3, m: Vec3) -> (f32, f32) {
        let d = self.d(m);
        match self.distribution {
            Distribution::Ggx => (2.0 * d * self.ggx_visible_share(wo), self.g1(wi)),
            Distribution::Beckmann => {
                // f has Mitsuba's masking, a fit within 0.35 %; the density of the samples has the exact one.
                let share = beckmann::visible_share(wo.z, self.slope(wo));
                (d * share, self.g1(wi) * self.g1(wo) / (share * wo.z))
            }
        }
    }

    /// Density of facet normals at `m`, per steradian of normals and unit of projected area.
    #[inline]
    fn d(&self, m: Vec3) -> f32 {
        let (slope, z2) = (Vec2::new(m.x, m.y) / self.alpha, m.z * m.z);
        let area = PI * self.alpha.x * self.alpha.y;
        match self.distribution {
            Distribution::Ggx => {
                let stretched = slope.length_squared() + z2;
                1.0 / (area * stretched * stretched)
            }
            Distribution::Beckmann => {
                let tail = (-slope.length_squared() / z2).exp();
                if tail > 0.0 { tail / (area * z2 * z2) } else { 0.0 } // else 0/0 at the horizon
            }
        }
    }

    /// tan θ · alpha · cos θ: how fast the surface seen along `v` rises and falls, over the cosine.
    #[inline]
    fn slope(&self, v: Vec3) -> f32 {
        (Vec2::new(v.x, v.y) * self.alpha).length()
    }

    /// G1 / (2 cos θ), in a form without quotients of small numbers.
    #[inline]
    fn ggx_visible_share(&self, v: Vec3) -> f32 {
        1.0 / (v.z + (v.z * v.z + (Vec2::new(v.x, v.y) * self.alpha).length_squared()).sqrt())
    }

    /// Share of the facets turned towards `v` that it sees, by Smith; the same above and below the surface.
    #[inline]
    pub fn g1(&self, v: Vec3) -> f32 {
        let v = Vec3::new(v.x, v.y, v.z.abs());
        match self.distribution {
            Distribution::Ggx => 2.0 * v.z * self.ggx_visible_share(v),
            Distribution::Beckmann => beckmann::g1(v.z, self.slope(v)),
        }
    }

    /// A facet normal in proportion to what `wo` sees of it: density D G1 wo·m / cos θo. `wo` lies above the surface.
    #[inline]
    pub fn visible_normal(&self, wo: Vec3, u: Vec2) -> Vec3 {
        // In the space where the surface has width 1; there a normal m becomes alpha · m.
        let stretched = Vec3::new(self.alpha.x * wo.x, self.alpha.y * wo.y, wo.z).normalize();
        let h = match self.distribution {
            Distribution::Ggx => ggx_visible_normal(stretched, u),
            Distribution::Beckmann => beckmann::visible_normal(stretched, u),
        };
        Vec3::new(self.alpha.x * h.x, self.alpha.y * h.y, h.z).normalize()
    }
}

/// A visible normal of the unit hemisphere, not normalised: `wo` plus a point of the spherical cap that it lights
/// (Dupuy and Benyoub 2023).
#[inline]
fn ggx_visible_normal(wo: Vec3, u: Vec2) -> Vec3 {
    // Height of the normal, which is that of the cap's point and `wo` together: summed afterwards, it would cancel.
    let height = (1.0 - u.y) * (1.0 + wo.z);
    let z = height - wo.z;
    let sin = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
    let (sin_phi, cos_phi) = (TAU * u.x).sin_cos();
    Vec3::new(sin * cos_phi + wo.x, sin * sin_phi + wo.y, height)
}
