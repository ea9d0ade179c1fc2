//! Burley's principled model, with transmission.

use glam::{Vec2, Vec3};

use super::burley::{
    Base, dial, facets, facing, hue, mean, normal_reflectance, schlick_weight, schlick_weight_into, unmatched,
};
use super::clearcoat::Clearcoat;
use super::microfacet::Microfacet;
use super::{BsdfEval, BsdfFeatures, BsdfSample, NEAR_DELTA_ALPHA, albedo, fresnel};
use crate::color::{Rgb, Split};
use crate::sampling::warp::{cosine_hemisphere, cosine_hemisphere_pdf};

/// The dials of [`Principled`], each in [0, 1] (what is beyond is brought there) but for the index.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrincipledDials {
    /// Colour of the diffuse lobe and of metal; its root is that of the refraction.
    pub base_color: Rgb,
    /// Square root of the width of the facets.
    pub roughness: f32,
    /// Stretches the facets along u.
    pub anisotropic: f32,
    /// From dielectric to metal.
    pub metallic: f32,
    /// From a diffuse base to refraction, of what is not metal.
    pub spec_trans: f32,
    /// Index below the surface over that above, positive.
    pub eta: f32,
    /// Tints the dielectric's reflection.
    pub spec_tint: f32,
    /// Light at grazing angles, as of cloth.
    pub sheen: f32,
    /// Tints the sheen.
    pub sheen_tint: f32,
    /// From diffuse towards subsurface.
    pub flatness: f32,
    /// A second specular lobe over all.
    pub clearcoat: f32,
    /// Sharpness of the second lobe.
    pub clearcoat_gloss: f32,
}

/// A diffuse base with sheen, facets that reflect and refract, and a clear coat (Burley 2012 and 2015), as Mitsuba 3.9.1
/// has it:
///
/// ```text
/// f = (1 − metallic) (1 − spec_trans) diffuse + (1 − metallic) sheen + ¼ clearcoat coat
///   + F D G / (4 cos θo cos θi) + (1 − metallic) spec_trans √base_color (1 − F_d) · refraction / η²
/// F = (1 − metallic) ((1 − spec_tint) F_d + spec_tint S(hue r0)) + metallic S(base_color)
/// ```
///
/// with F_d the dielectric's reflectance, r0 its value at normal incidence, S Schlick's curve from a colour. Behind the
/// surface only refraction and its own reflection, of weight (1 − metallic) spec_trans, are left. Lobes are added, not
/// layered: a white base reflects a little more than it gets.
///
/// As in Mitsuba an index of 1 switches off all reflection, that of metal too. Sheen stays at spec_trans 1, as everywhere
/// below it and in Mitsuba's vectorised variants; the scalar ones drop it at exactly 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Principled {
    base: Base,
    clearcoat: Clearcoat,
    facets: Microfacet,
    eta: f32,
    /// F is `dielectric` · F_d + `f0` at normal incidence, and … + `f90` at grazing.
    dielectric: f32,
    f0: Rgb,
    f90: f32,
    /// Weight of the refracting lobe and of the reflection from behind.
    refracting: f32,
    /// The same times the colour of what goes through.
    through: Rgb,
}

/// What a facet does, the colours of all factors but masking.
struct Facet {
    reflectance: Rgb,
    transmittance: Rgb,
    /// Cosine of the refracted direction.
    cos_t: f32,
    /// Probability of reflection in the choice between the two.
    share: f32,
}

/// Probabilities of the lobes.
struct Shares {
    base: f32,
    clearcoat: f32,
    facets: f32,
}

impl Principled {
    /// Works out what does not depend on directions.
    #[inline]
    pub fn new(dials: &PrincipledDials) -> Self {
        let base_color = dials.base_color;
        let (roughness, metallic, spec_trans) =
            (dial(dials.roughness), dial(dials.metallic), dial(dials.spec_trans));
        let plain = 1.0 - metallic;
        let tinted = plain * dial(dials.spec_tint);
        let refracting = plain * spec_trans;
        let eta = if refracting > 0.0 { unmatched(dials.eta) } else { dials.eta };
        let there = if eta == 1.0 { 0.0 } else { 1.0 };
        let mut f0 = metallic * base_color;
        if tinted > 0.0 {
            f0 += hue(base_color) * (tinted * normal_reflectance(eta));
        }
        Self {
            base: Base {
                color: base_color * (plain * (1.0 - spec_trans)),
                sheen: Base::sheen(base_color, plain * dial(dials.sheen), dial(dials.sheen_tint)),
                roughness,
                flatness: dial(dials.flatness),
            },
            clearcoat: Clearcoat::new(dial(dials.clearcoat), dial(dials.clearcoat_gloss)),
            facets: facets(roughness, dial(dials.anisotropic)),
            eta,
            dielectric: there * (plain - tinted),
            f0: there * f0,
            f90: there * (metallic + tinted),
            refracting,
            through: if refracting > 0.0 {
                refracting * Vec3::from_array(base_color.to_array().map(f32::sqrt))
            } else {
                Rgb::ZERO
            },
        }
    }

    /// At the cosine `cos` to the facet, from the front or from behind; `eta` is that on the far side over the near one.
    #[inline]
    fn facet(&self, front: bool, cos: f32, eta: f32) -> Facet {
        let needed = self.dielectric > 0.0 || self.refracting > 0.0;
        let boundary = if needed {
            fresnel::dielectric(cos, eta)
        } else {
            fresnel::Boundary { reflectance: 0.0, cos_t: 0.0 }
        };
        let reflectance = if !front {
            Rgb::splat(self.refracting * boundary.reflectance)
        } else {
            let mut reflectance = self.f0 + self.dielectric * boundary.reflectance;
            if self.f90 > 0.0 {
                reflectance += (Rgb::splat(self.f90) - self.f0) * schlick_weight_into(cos, eta);
            }
            reflectance
        };
        let transmittance = self.through * (1.0 - boundary.reflectance);
        let (r, t) = (mean(reflectance), mean(transmittance));
        let share = if t > 0.0 { r / (r + t) } else { 1.0 };
        Facet { reflectance, transmittance, cos_t: boundary.cos_t, share }
    }

    /// By estimates of the albedos, for a `wo` above the surface; `None` where nothing is scattered.
    #[inline]
    fn shares(&self, cos: f32, schlick_o: f32) -> Option<Shares> {
        let f = schlick_weight_into(facing(cos, self.base.roughness), self.eta);
        let r0 = normal_reflectance(self.eta);
        let dielectric = r0 + (1.0 - r0) * f;
        let f0 = mean(self.f0);
        let facets = self.dielectric * dielectric
            + f0
            + (self.f90 - f0).max(0.0) * f.max(0.02)
            + mean(self.through) * (1.0 - dielectric);
        let (base, clearcoat) = (self.base.estimate(schlick_o), self.clearcoat.estimate(cos, schlick_o));
        let scale = 1.0 / (base + clearcoat + facets);
        scale.is_finite().then_some(Shares {
            base: base * scale,
            clearcoat: clearcoat * scale,
            facets: facets * scale,
        })
    }

    /// Draws from one lobe: the base by the cosine, the coat by its facets, the facets by what is seen of them, and there
    /// reflects or refracts in proportion to both.
    #[inline]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample> {
        let (wi, eta) = if wo.z > 0.0 {
            let shares = self.shares(wo.z, schlick_weight(wo.z))?;
            let rest = u_lobe - shares.base;
            if rest < 0.0 {
                (cosine_hemisphere(u), 1.0)
            } else if rest < shares.clearcoat {
                (self.clearcoat.sample(wo, u)?, 1.0)
            } else {
                let rest = (rest - shares.clearcoat) / shares.facets;
                self.sample_facets(wo, self.eta, true, rest.min(1.0f32.next_down()), u)?
            }
        } else if wo.z < 0.0 && self.refracting > 0.0 {
            let (wi, eta) = self.sample_facets(-wo, 1.0 / self.eta, false, u_lobe, u)?;
            (-wi, eta)
        } else {
            return None;
        };
        self.eval(wo, wi).drawn(wi, eta)
    }

    /// Direction from a facet for a `wo` above the facets, and the relative index that light then goes through.
    #[inline]
    fn sample_facets(&self, wo: Vec3, eta: f32, front: bool, u_lobe: f32, u: Vec2) -> Option<(Vec3, f32)> {
        let m = self.facets.visible_normal(wo, u);
        let cos_m = wo.dot(m).clamp(0.0, 1.0);
        let facet = self.facet(front, cos_m, eta);
        let (wi, eta, side) = if u_lobe < facet.share {
            (2.0 * cos_m * m - wo, 1.0, 1.0)
        } else {
            (((cos_m / eta - facet.cos_t) * m - wo / eta).normalize(), eta, -1.0)
        };
        // What falls on the wrong side would go on to other facets.
        (wi.z * side > 0.0).then_some((wi, eta))
    }

    /// Value and density of all lobes.
    #[inline]
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> BsdfEval {
        if wo.z > 0.0 && wi.z > 0.0 {
            self.reflection(wo, wi)
        } else if self.refracting <= 0.0 {
            BsdfEval::ZERO
        } else if wo.z > 0.0 {
            let Some(shares) = self.shares(wo.z, schlick_weight(wo.z)) else { return BsdfEval::ZERO };
            let value = self.refraction(wo, wi, self.eta, true);
            BsdfEval { pdf: shares.facets * value.pdf, ..value }
        } else {
            // Facets look the same turned through the origin.
            let (wo, wi, eta) = (-wo, -wi, 1.0 / self.eta);
            let Some(lobe) = self.facets.reflection(wo, wi) else {
                return self.refraction(wo, wi, eta, false);
            };
            let facet = self.facet(false, lobe.cos_m, eta);
            let f_cos = facet.reflectance * (lobe.weight * lobe.pdf);
            BsdfEval { f_cos: Split::specular(f_cos), pdf: facet.share * lobe.pdf }
        }
    }

    /// All lobes that reflect, for directions above the surface.
    #[inline]
    fn reflection(&self, wo: Vec3, wi: Vec3) -> BsdfEval {
        let schlick_o = schlick_weight(wo.z);
        let Some(shares) = self.shares(wo.z, schlick_o) else { return BsdfEval::ZERO };
        let Some(lobe) = self.facets.reflection(wo, wi) else { return BsdfEval::ZERO };
        let facet = self.facet(true, lobe.cos_m, self.eta);
        let mut specular = facet.reflectance * (lobe.weight * lobe.pdf);
        let mut pdf = shares.facets * facet.share * lobe.pdf;
        if self.clearcoat.is_there() {
            let (f_cos, density) = self.clearcoat.eval(wo, wi, self.eta);
            specular += f_cos;
            pdf += shares.clearcoat * density;
        }
        let mut diffuse = Rgb::ZERO;
        if !self.base.is_black() {
            diffuse = self.base.f_cos(wo, wi, schlick_o);
            pdf += shares.base * cosine_hemisphere_pdf(wi);
        }
        BsdfEval { f_cos: Split { diffuse, specular }, pdf }
    }

    /// For a `wo` above the facets and a `wi` below.
    #[inline]
    fn refraction(&self, wo: Vec3, wi: Vec3, eta: f32, front: bool) -> BsdfEval {
        let Some(lobe) = self.facets.refraction(wo, wi, eta) else { return BsdfEval::ZERO };
        let facet = self.facet(front, lobe.cos_m, eta);
        // Radiance is spread over another solid angle on the other side.
        let f_cos = facet.transmittance * (lobe.weight * lobe.pdf / (eta * eta));
        BsdfEval { f_cos: Split::specular(f_cos), pdf: (1.0 - facet.share) * lobe.pdf }
    }

    /// For the feature layers: what is reflected and what goes through, without the change of solid angle.
    pub fn features(&self, wo: Vec3) -> BsdfFeatures {
        let front = wo.z > 0.0;
        let roughness = if self.base.is_black() { self.alpha().sqrt() } else { 1.0 };
        if !front && self.refracting <= 0.0 {
            return BsdfFeatures { albedo: Rgb::ZERO, diffuse_albedo: Rgb::ZERO, roughness };
        }
        let mut albedo = self.facets_albedo(if front { wo } else { -wo }, front);
        let mut diffuse_albedo = Rgb::ZERO;
        if front {
            diffuse_albedo = self.base.albedo(wo.z);
            albedo += diffuse_albedo + self.clearcoat.albedo(wo, self.eta);
        }
        BsdfFeatures { albedo, diffuse_albedo, roughness }
    }

    /// Of the facets alone, from a `wo` above them: from the table where it has it, else over visible normals.
    fn facets_albedo(&self, wo: Vec3, front: bool) -> Rgb {
        // Total reflection has an edge that the table does not resolve.
        let smooth = self.refracting <= 0.0 && (self.eta > 1.0 || self.dielectric <= 0.0);
        if let Some((distribution, alpha)) = self.facets.isotropic().filter(|_| smooth) {
            return albedo::albedo(distribution, alpha, wo.z, |cos| {
                self.facet(true, cos, self.eta).reflectance
            });
        }
        let eta = if front { self.eta } else { 1.0 / self.eta };
        let albedo = albedo::lattice::<55, 34>().map(|u| {
            let m = self.facets.visible_normal(wo, u);
            let cos_m = wo.dot(m).clamp(0.0, 1.0);
            let facet = self.facet(front, cos_m, eta);
            let mirrored = 2.0 * cos_m * m - wo;
            let mut sum = Rgb::ZERO;
            if mirrored.z > 0.0 {
                sum += facet.reflectance * self.facets.g1(mirrored);
            }
            if self.refracting > 0.0 {
                let refracted = (cos_m / eta - facet.cos_t) * m - wo / eta;
                if refracted.z < 0.0 {
                    sum += facet.transmittance * self.facets.g1(refracted.normalize());
                }
            }
            sum
        });
        albedo.sum::<Rgb>() / 55.0
    }

    /// The widest specular lobe.
    fn alpha(&self) -> f32 {
        let clearcoat = if self.clearcoat.is_there() { self.clearcoat.alpha() } else { 0.0 };
        self.facets.widest().max(clearcoat)
    }

    /// See [`Bsdf::near_delta`](super::Bsdf::near_delta).
    #[inline]
    pub fn near_delta(&self) -> bool {
        self.base.is_black() && self.alpha() < NEAR_DELTA_ALPHA
    }
}
