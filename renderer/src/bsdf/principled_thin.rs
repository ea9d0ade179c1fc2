//! Burley's principled model of a thin sheet.

use glam::{Vec2, Vec3};

use super::burley::{
    Base, dial, facets, facing, hue, mean, normal_reflectance, schlick_weight, schlick_weight_into,
};
use super::microfacet::Microfacet;
use super::{BsdfEval, BsdfFeatures, BsdfSample, NEAR_DELTA_ALPHA, albedo, fresnel};
use crate::color::{Rgb, Split};
use crate::sampling::warp::{cosine_hemisphere, cosine_hemisphere_pdf};

/// The dials of [`PrincipledThin`], each in [0, 1] (what is beyond is brought there) where nothing else is said.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrincipledThinDials {
    /// Colour of the diffuse lobes and of what goes through.
    pub base_color: Rgb,
    /// Square root of the width of the facets.
    pub roughness: f32,
    /// Stretches the facets along u.
    pub anisotropic: f32,
    /// From diffuse to specular.
    pub spec_trans: f32,
    /// Index inside over that outside, positive.
    pub eta: f32,
    /// Tints the reflection.
    pub spec_tint: f32,
    /// Light at grazing angles, as of cloth.
    pub sheen: f32,
    /// Tints the sheen.
    pub sheen_tint: f32,
    /// From diffuse towards subsurface.
    pub flatness: f32,
    /// From 0, diffuse reflection alone, to 2, diffuse transmission alone.
    pub diff_trans: f32,
}

/// A sheet without inside, the same from both sides (Burley 2015, section 5), as Mitsuba 3.9.1 has it:
///
/// ```text
/// reflected    (1 − spec_trans) (1 − diff_trans/2) diffuse + spec_trans ((1 − spec_tint) F_d + spec_tint S(hue r0)) D G / 4 cos cos
/// transmitted  (1 − spec_trans) diff_trans/2 base_color / π + spec_trans base_color (1 − F_d) D' G' / 4 cos cos
/// ```
///
/// What goes through is the reflected lobe mirrored to the other side, without bending, of a roughness changed by the
/// factor 0.65 η − 0.35. As in Mitsuba, masking sees the unmirrored direction: light that would leave on the facet's own
/// side is lost, which darkens grazing angles of rough sheets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrincipledThin {
    base: Base,
    /// Albedo of the diffuse transmission.
    diffuse_through: Rgb,
    reflecting: Microfacet,
    transmitting: Microfacet,
    eta: f32,
    /// Weight of the specular lobes.
    specular: f32,
    spec_tint: f32,
    /// Colour of the tinted reflection at normal incidence.
    f0: Rgb,
    /// Colour of what goes through, times `specular`.
    through: Rgb,
}

/// Probabilities of the lobes.
struct Shares {
    base: f32,
    diffuse_through: f32,
    reflection: f32,
    transmission: f32,
}

impl PrincipledThin {
    /// Works out what does not depend on directions.
    #[inline]
    pub fn new(dials: &PrincipledThinDials) -> Self {
        let base_color = dials.base_color;
        let (roughness, anisotropic) = (dial(dials.roughness), dial(dials.anisotropic));
        let (specular, spec_tint) = (dial(dials.spec_trans), dial(dials.spec_tint));
        let (diffuse, transmitted) = (1.0 - specular, dial(0.5 * dials.diff_trans));
        let reflected = diffuse * (1.0 - transmitted);
        let eta = if dials.eta > 1e-3 { dials.eta.min(1e3) } else { 1e-3 };
        Self {
            base: Base {
                color: base_color * reflected,
                sheen: Base::sheen(base_color, reflected * dial(dials.sheen), dial(dials.sheen_tint)),
                roughness,
                flatness: dial(dials.flatness),
            },
            diffuse_through: base_color * (diffuse * transmitted),
            reflecting: facets(roughness, anisotropic),
            transmitting: facets((0.65 * eta - 0.35) * roughness, anisotropic),
            eta,
            specular,
            spec_tint,
            f0: if spec_tint > 0.0 { hue(base_color) * normal_reflectance(eta) } else { Rgb::ZERO },
            through: base_color * specular,
        }
    }

    /// Reflectance of a facet, with its weight.
    #[inline]
    fn reflectance(&self, cos: f32) -> Rgb {
        let dielectric = Rgb::splat(fresnel::dielectric(cos, self.eta).reflectance);
        if self.spec_tint <= 0.0 {
            return self.specular * dielectric;
        }
        let tinted = self.f0 + (Rgb::ONE - self.f0) * schlick_weight_into(cos, self.eta);
        self.specular * (dielectric + self.spec_tint * (tinted - dielectric))
    }

    /// Transmittance of a facet, with its weight.
    #[inline]
    fn transmittance(&self, cos: f32) -> Rgb {
        self.through * (1.0 - fresnel::dielectric(cos, self.eta).reflectance)
    }

    /// By estimates of the albedos; `None` where nothing is scattered.
    #[inline]
    fn shares(&self, cos: f32, schlick_o: f32) -> Option<Shares> {
        let r0 = normal_reflectance(self.eta);
        let f = schlick_weight_into(facing(cos, self.base.roughness), self.eta);
        let dielectric = if self.eta == 1.0 { 0.0 } else { r0 + (1.0 - r0) * f };
        let tinted = mean(self.f0) + (1.0 - mean(self.f0)) * f;
        let base = self.base.estimate(schlick_o);
        let diffuse_through = mean(self.diffuse_through);
        let reflection = self.specular * (dielectric + self.spec_tint * (tinted - dielectric));
        // Not all facets turn the same cosine to `wo`, and so not all reflect totally.
        let transmission = mean(self.through) * (1.0 - dielectric).max(0.05);
        let scale = 1.0 / (base + diffuse_through + reflection + transmission);
        scale.is_finite().then_some(Shares {
            base: base * scale,
            diffuse_through: diffuse_through * scale,
            reflection: reflection * scale,
            transmission: transmission * scale,
        })
    }

    /// Draws from one lobe.
    #[inline]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample> {
        let above = turned(wo, wo.z);
        let shares = self.shares(above.z, schlick_weight(above.z))?;
        let mut rest = u_lobe - shares.base;
        let wi = if rest < 0.0 {
            cosine_hemisphere(u)
        } else {
            rest -= shares.diffuse_through;
            if rest < 0.0 {
                mirrored(cosine_hemisphere(u))
            } else if rest < shares.reflection {
                self.reflecting.sample(above, u)?
            } else {
                mirrored(self.transmitting.sample(above, u).filter(|&wi| leaves_behind(above, wi))?)
            }
        };
        let wi = turned(wi, wo.z);
        self.eval(wo, wi).drawn(wi, 1.0)
    }

    /// Value and density of all lobes.
    #[inline]
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> BsdfEval {
        let (wo, wi) = (turned(wo, wo.z), turned(wi, wo.z));
        let schlick_o = schlick_weight(wo.z);
        if wi.z == 0.0 || wo.z.is_nan() || wo.z <= 0.0 {
            return BsdfEval::ZERO;
        }
        let Some(shares) = self.shares(wo.z, schlick_o) else { return BsdfEval::ZERO };
        let reflects = wi.z > 0.0;
        let wi = if reflects { wi } else { mirrored(wi) };
        let (mut specular, mut pdf) = (Rgb::ZERO, 0.0);
        if self.specular > 0.0 {
            let facets = if reflects { &self.reflecting } else { &self.transmitting };
            let lobe = facets.reflection(wo, wi).filter(|_| reflects || leaves_behind(wo, wi));
            if let Some(lobe) = lobe {
                let colour =
                    if reflects { self.reflectance(lobe.cos_m) } else { self.transmittance(lobe.cos_m) };
                // Nothing goes through a facet that reflects totally, and no such direction is drawn.
                if colour != Rgb::ZERO {
                    specular = colour * (lobe.weight * lobe.pdf);
                    pdf = lobe.pdf * if reflects { shares.reflection } else { shares.transmission };
                }
            }
        }
        let cosine = cosine_hemisphere_pdf(wi);
        let (diffuse, share) = if reflects {
            (self.base.f_cos(wo, wi, schlick_o), shares.base)
        } else {
            (self.diffuse_through * cosine, shares.diffuse_through)
        };
        BsdfEval { f_cos: Split { diffuse, specular }, pdf: pdf + share * cosine }
    }

    /// For the feature layers: what is reflected and what goes through.
    pub fn features(&self, wo: Vec3) -> BsdfFeatures {
        let wo = turned(wo, wo.z);
        let diffuse_albedo = self.base.albedo(wo.z) + self.diffuse_through;
        let mut albedo = diffuse_albedo;
        if self.specular > 0.0 {
            let facets_albedo = |u: Vec2| {
                let reflected =
                    self.reflecting.sample(wo, u).and_then(|wi| self.reflecting.reflection(wo, wi));
                let through = self.transmitting.sample(wo, u).filter(|&wi| leaves_behind(wo, wi));
                let through = through.and_then(|wi| self.transmitting.reflection(wo, wi));
                reflected.map_or(Rgb::ZERO, |lobe| self.reflectance(lobe.cos_m) * lobe.weight)
                    + through.map_or(Rgb::ZERO, |lobe| self.transmittance(lobe.cos_m) * lobe.weight)
            };
            albedo += albedo::lattice::<55, 34>().map(facets_albedo).sum::<Rgb>() / 55.0;
        }
        let roughness = if self.is_specular() { self.alpha().sqrt() } else { 1.0 };
        BsdfFeatures { albedo, diffuse_albedo, roughness }
    }

    /// Whether there is no diffuse lobe.
    fn is_specular(&self) -> bool {
        self.base.is_black() && self.diffuse_through == Rgb::ZERO
    }

    /// The widest specular lobe.
    fn alpha(&self) -> f32 {
        self.reflecting.widest().max(self.transmitting.widest())
    }

    /// See [`Bsdf::near_delta`](super::Bsdf::near_delta).
    #[inline]
    pub fn near_delta(&self) -> bool {
        self.is_specular() && self.alpha() < NEAR_DELTA_ALPHA
    }
}

/// Turned over where `side` is below the surface; the sheet looks the same from there.
#[inline]
fn turned(v: Vec3, side: f32) -> Vec3 {
    if side < 0.0 { -v } else { v }
}

/// On the other side of the sheet.
#[inline]
fn mirrored(v: Vec3) -> Vec3 {
    Vec3::new(v.x, v.y, -v.z)
}

/// Whether light mirrored from `wo` to `wi`, both above, and turned to the other side of the sheet, is also on the other
/// side of the facet between the two.
#[inline]
fn leaves_behind(wo: Vec3, wi: Vec3) -> bool {
    mirrored(wi).dot(wo + wi) < 0.0
}
