//! Rough glass.

use glam::{Vec2, Vec3};

use super::dielectric::Dielectric;
use super::microfacet::Microfacet;
use super::{BsdfEval, BsdfFeatures, BsdfSample, albedo, fresnel};
use crate::color::{Rgb, Split};

/// Smooth boundaries in all directions of a microfacet distribution (Walter et al. 2007), with single scattering; scatters
/// on both sides:
///
/// ```text
/// f_r = F D G1(wo) G1(wi) / (4 cos θo cos θi)
/// f_t = (1 − F) D G1(wo) G1(wi) |wo·m| |wi·m| / (cos θo cos θi |wo + η wi|²)
/// ```
///
/// with f_t for radiance, Walter's over η². Light that would go on to a second facet is lost: of white glass of index 1.5
/// with GGX's facets, seen from straight above, 0.1 % at alpha 0.1 and 4 % at alpha 0.6, and there 37 % at cos θ = 0.1.
///
/// As the indices match, refraction becomes a needle of width alpha · |η − 1|, while f32 directions are 1e-7 apart.
/// Narrower than [`NEEDLE`] it is left to `sample` as a delta lobe, in its own directions and with its own weight: no
/// light sample would have hit it. At η = 1 there is no boundary, and light passes in full, where the formula would go on
/// masking it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughDielectric {
    /// Distribution of the facets.
    pub facets: Microfacet,
    /// Indices and colours of each facet.
    pub boundary: Dielectric,
}

/// At this width of the refracted lobe, f32 directions resolve 1 % of it.
const NEEDLE: f32 = 1e-5;

impl RoughDielectric {
    /// Draws a visible facet, then reflects with its Fresnel reflectance as probability, else refracts: D and F cancel,
    /// and the weight is G1(wi) times the colour.
    #[inline]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample> {
        if wo.z == 0.0 || wo.z.is_nan() {
            return None;
        }
        if self.is_matched() {
            return self.boundary.sample(wo, u_lobe);
        }
        let (side, eta) = (wo.z, self.boundary.relative_eta(wo));
        let wo = turned(wo, side);
        let m = self.facets.visible_normal(wo, u);
        let facet = at_facet(wo, m, eta);
        let reflects = u_lobe < facet.reflectance;
        let wi = if reflects { facet.mirrored } else { facet.refracted };
        if reflects != (wi.z > 0.0) || wi.z == 0.0 {
            return None;
        }
        let sample = if !reflects && self.refracts_in_a_needle() {
            let weight = self.through(eta) * self.facets.masked(wo, wi, m).1;
            BsdfSample { wi, weight: Split::specular(weight), pdf: 1.0, delta: true, eta }
        } else {
            let (weight, pdf) = self.lobe(wo, wi, eta)?;
            // In the far tail of a lobe, where what is left of the density has lost its digits.
            if pdf < f32::MIN_POSITIVE {
                return None;
            }
            let eta = if reflects { 1.0 } else { eta };
            BsdfSample { wi, weight: Split::specular(weight), pdf, delta: false, eta }
        };
        Some(BsdfSample { wi: turned(wi, side), ..sample })
    }

    /// Value and density.
    #[inline]
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> BsdfEval {
        let lobe = self.lobe(turned(wo, wo.z), turned(wi, wo.z), self.boundary.relative_eta(wo));
        let Some((weight, pdf)) = lobe.filter(|_| !self.is_matched()) else { return BsdfEval::ZERO };
        BsdfEval { f_cos: Split::specular(weight * pdf), pdf }
    }

    /// Weight and density for a `wo` above the surface.
    #[inline]
    fn lobe(&self, wo: Vec3, wi: Vec3, eta: f32) -> Option<(Rgb, f32)> {
        if wi.z > 0.0 {
            let lobe = self.facets.reflection(wo, wi)?;
            let reflectance = fresnel::dielectric(lobe.cos_m, eta).reflectance;
            return Some((self.boundary.reflectance * lobe.weight, reflectance * lobe.pdf));
        }
        if self.refracts_in_a_needle() {
            return None;
        }
        let lobe = self.facets.refraction(wo, wi, eta)?;
        let transmittance = 1.0 - fresnel::dielectric(lobe.cos_m, eta).reflectance;
        Some((self.through(eta) * lobe.weight, transmittance * lobe.pdf))
    }

    /// Factor on radiance that goes through, as in [`Dielectric`].
    #[inline]
    fn through(&self, eta: f32) -> Rgb {
        self.boundary.transmittance / (eta * eta)
    }

    /// Whether there is no boundary: light passes, and `eval` sees nothing of it.
    #[inline]
    pub fn is_matched(&self) -> bool {
        self.boundary.eta == 1.0
    }

    /// Whether refraction is left to `sample`.
    #[inline]
    fn refracts_in_a_needle(&self) -> bool {
        let eta = self.boundary.eta;
        self.facets.narrowest() * (eta - 1.0).abs() < NEEDLE * eta.max(1.0)
    }

    /// For the feature layers: what is reflected and what goes through, without the change of solid angle. Within 5 %, but
    /// for a facet whose colours differ nine times and whose index differs by 1 %: up to 15 % at grazing incidence.
    pub fn features(&self, wo: Vec3) -> BsdfFeatures {
        if self.is_matched() {
            return self.boundary.features(wo);
        }
        let (wo, eta) = (turned(wo, wo.z), self.boundary.relative_eta(wo));
        // Facets of GGX, weighted: those of Beckmann's take four times as long to draw.
        let ggx = self.facets.as_ggx();
        let (mut sum, mut total) = (Rgb::ZERO, 0.0);
        for u in albedo::lattice::<144, 89>() {
            let m = ggx.visible_normal(wo, u);
            let weight = self.facets.d(m) / ggx.d(m);
            let facet = at_facet(wo, m, eta);
            let reflected = if facet.mirrored.z > 0.0 { self.facets.g1(facet.mirrored) } else { 0.0 };
            let refracted = if facet.refracted.z < 0.0 { self.facets.g1(facet.refracted) } else { 0.0 };
            let reflected = self.boundary.reflectance * (facet.reflectance * reflected);
            let refracted = self.boundary.transmittance * ((1.0 - facet.reflectance) * refracted);
            sum += (reflected + refracted) * weight;
            total += weight;
        }
        BsdfFeatures {
            albedo: sum / total,
            diffuse_albedo: Rgb::ZERO,
            roughness: self.facets.widest().sqrt(),
        }
    }
}

/// Turns a direction through the origin where `side` is below the surface: facets look the same from there.
#[inline]
fn turned(v: Vec3, side: f32) -> Vec3 {
    if side < 0.0 { -v } else { v }
}

/// What a facet does to light.
struct Facet {
    mirrored: Vec3,
    refracted: Vec3,
    reflectance: f32,
}

#[inline]
fn at_facet(wo: Vec3, m: Vec3, eta: f32) -> Facet {
    let cos_m = wo.dot(m).clamp(0.0, 1.0);
    let boundary = fresnel::dielectric(cos_m, eta);
    Facet {
        mirrored: 2.0 * cos_m * m - wo,
        refracted: ((cos_m / eta - boundary.cos_t) * m - wo / eta).normalize(),
        reflectance: boundary.reflectance,
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use limpid_scenes::Distribution::{self, Beckmann, Ggx};
    use limpid_testkit::furnace;

    use super::*;

    fn glass(distribution: Distribution, alpha: [f32; 2], eta: f32) -> RoughDielectric {
        let boundary = Dielectric { eta, reflectance: Rgb::splat(0.9), transmittance: Rgb::splat(0.8) };
        RoughDielectric { facets: Microfacet::new(distribution, alpha[0], alpha[1]), boundary }
    }

    /// f · cos θi and density as Mitsuba 3.9.1 (`scalar_rgb`) has them. Its densities of Beckmann's facets have the fit
    /// of the masking in them that f has too, and are 0.3 % off. The last digits of its fifth row are noise of f32.
    #[test]
    fn values_are_those_of_mitsuba() {
        let rows = [
            (Ggx, [0.3, 0.3], 1.5, [0.3, 0.2, 0.8], [-0.1, -0.3, 0.9], 0.024923, 0.027769),
            (Ggx, [0.3, 0.3], 1.5, [0.3, 0.2, 0.8], [-0.1, -0.2, -0.9], 1.2384, 3.4878),
            (Ggx, [0.3, 0.3], 1.5, [-0.2, 0.1, -0.9], [0.5, -0.1, 0.8], 1.8637, 1.0448),
            (Ggx, [0.1, 0.4], 1.33, [0.3, 0.2, 0.8], [-0.25, -0.1, -0.9], 19.738, 43.673),
            (Ggx, [0.02, 0.02], 1.05, [0.3, 0.2, 0.8], [-0.3, -0.2, -0.85], 73277.0, 1.0099e5),
            (Beckmann, [0.2, 0.2], 1.5, [0.3, 0.2, 0.8], [-0.2, -0.3, 0.9], 0.067005, 0.07445),
            (Beckmann, [0.2, 0.2], 1.5, [0.3, 0.2, 0.8], [-0.2, -0.2, -0.9], 10.194, 28.669),
            (Beckmann, [0.4, 0.1], 0.75, [0.1, 0.05, 0.8], [-0.1, -0.1, -0.9], 43.677, 30.711),
            (Beckmann, [0.3, 0.3], 1.5, [0.9, 0.2, 0.3], [-0.5, -0.1, -0.7], 1.3479, 3.7909),
        ];
        for (distribution, alpha, eta, wo, wi, f_cos, pdf) in rows {
            let (wo, wi) = (Vec3::from(wo).normalize(), Vec3::from(wi).normalize());
            let value = glass(distribution, alpha, eta).eval(wo, wi);
            let tolerance = if distribution == Ggx { 2e-4 } else { 4e-3 };
            assert!((value.f_cos.specular.x / f_cos - 1.0).abs() < 2e-4, "{wo} {wi}: {value:?}, not {f_cos}");
            assert!((value.pdf / pdf - 1.0).abs() < tolerance, "{wo} {wi}: {value:?}, not {pdf}");
        }
    }

    #[test]
    fn at_equal_indices_light_goes_straight_on_and_loses_nothing() {
        for wo in [Vec3::Z, Vec3::new(0.6, 0.0, -0.8), Vec3::new(0.0, 0.999_999, 1e-3).normalize()] {
            let bsdf = glass(Ggx, [0.5, 0.1], 1.0);
            let s = bsdf.sample(wo, 0.0, Vec2::splat(0.9)).expect("nothing is in the way");
            assert!((s.wi + wo).length() < 1e-6 && s.delta && s.eta == 1.0, "{s:?}");
            assert_eq!(s.weight.specular, bsdf.boundary.transmittance);
            assert_eq!(bsdf.eval(wo, -wo), BsdfEval::ZERO);
        }
    }

    /// In each of these the smooth boundary is the limit; the first two are evaluated, the others left to `sample`.
    #[test]
    fn narrow_facets_scatter_like_the_smooth_boundary() {
        for (alpha, eta) in [(1e-4, 1.5), (1e-3, 1.02), (1e-3, 1.000_277), (0.2, 1.0f32.next_up())] {
            for distribution in [Ggx, Beckmann] {
                let bsdf = glass(distribution, [alpha; 2], eta);
                for wo in [Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.3, 0.4, -0.75).normalize()] {
                    let off = Cell::new(0f32);
                    let mean = furnace(1 << 14, |lobe, u| {
                        let Some(s) = bsdf.sample(wo, lobe, u) else { return Rgb::ZERO };
                        let Some(smooth) = bsdf.boundary.sample(wo, lobe) else { return Rgb::ZERO };
                        if s.wi.z * wo.z < 0.0 && smooth.wi.z * wo.z < 0.0 {
                            off.set(off.get() + (s.wi - smooth.wi).length() / (1 << 14) as f32);
                        }
                        s.weight.specular
                    });
                    let smooth = furnace(1 << 14, |lobe, _| {
                        bsdf.boundary.sample(wo, lobe).map_or(Rgb::ZERO, |s| s.weight.specular)
                    });
                    // The mean tilt of a facet, to a few widths for GGX's long tail, less what its refraction takes off.
                    let tilt = 8.0 * alpha * (eta - 1.0) + 1e-6;
                    let off = off.get();
                    assert!(off < tilt, "{distribution:?} {alpha} {eta} {wo}: {off} off");
                    assert!(
                        (mean / smooth - 1.0).abs().x < 0.02,
                        "{distribution:?} {alpha} {eta} {wo}: {mean} {smooth}"
                    );
                }
            }
        }
    }
}
