//! The material of glTF 2.0.

use std::f32::consts::FRAC_1_PI;

use glam::{Vec2, Vec3};
use limpid_scenes::Distribution;

use super::burley::{
    dial, facing, hemisphere, mean, normal_reflectance, schlick_weight, schlick_weight_into, unmatched,
};
use super::microfacet::Microfacet;
use super::{BsdfEval, BsdfFeatures, BsdfSample, NEAR_DELTA_ALPHA, albedo, fresnel, sheen};
use crate::color::{Rgb, Split};
use crate::sampling::warp::{cosine_hemisphere, cosine_hemisphere_pdf};

/// The parameters of [`Gltf`], in [0, 1] (what is beyond is brought there) where nothing else is said. See
/// [`GltfMaterial`](limpid_scenes::GltfMaterial).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GltfDials {
    /// Colour of the diffuse base, of metal and of what goes through.
    pub base_color: Rgb,
    /// From dielectric to metal.
    pub metallic: f32,
    /// Square root of the width of the facets.
    pub roughness: f32,
    /// Index below the surface over that above, positive.
    pub ior: f32,
    /// Weight of the dielectric's reflection.
    pub specular: f32,
    /// Its colour, not negative.
    pub specular_color: Rgb,
    /// Weight of the coat.
    pub clearcoat: f32,
    /// Square root of the width of the coat's facets.
    pub clearcoat_roughness: f32,
    /// Colour of the sheen.
    pub sheen_color: Rgb,
    /// Square root of its width.
    pub sheen_roughness: f32,
    /// From the diffuse base to transmission.
    pub transmission: f32,
    /// Whether light goes through without bending, and the surface looks alike from both sides.
    pub thin: bool,
}

/// The layers of the specification's appendix B and of the extensions, from below:
///
/// ```text
/// F_d(c) = f0 + (specular − f0) (1 − c)⁵       f0 = specular · min(specular_color (η − 1)² / (η + 1)², 1)
/// F_m(c) = base_color + (1 − base_color) (1 − c)⁵                              with c = wo·m
/// base   = (1 − metallic) (1 − max F_d) base_color ((1 − transmission) / π + transmission · through)
///        + ((1 − metallic) F_d + metallic F_m) D G / (4 cos θo cos θi)
/// sheen  = sheen_color f_s + base · min over both cosines of (1 − max sheen_color · E_s(cos θ))
/// f      = (1 − k) sheen + k D_c G_c / (4 cos θo cos θi)     k = clearcoat (0.04 + 0.96 (1 − cos θo)⁵)
/// ```
///
/// with GGX of width roughness² and separable masking throughout. A thin surface lets through the reflected lobe, mirrored
/// to the other side; others refract (Walter et al. 2007), and show from behind refraction and its reflection alone. The
/// coat is not reciprocal: its specification has the viewer's cosine only.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gltf {
    base_color: Rgb,
    metallic: f32,
    roughness: f32,
    facets: Microfacet,
    eta: f32,
    f0: Rgb,
    f90: f32,
    /// Albedo of the diffuse base, its weight included.
    diffuse: Rgb,
    /// Weight of the transmission.
    transmission: f32,
    thin: bool,
    sheen_color: Rgb,
    sheen_alpha: f32,
    clearcoat: f32,
    coat: Microfacet,
}

/// What a facet does.
struct Facet {
    reflectance: Rgb,
    transmittance: Rgb,
    /// What the dielectric's reflection leaves to the base.
    left: f32,
    /// Probability of reflection in the choice between the two.
    share: f32,
}

/// Probabilities of the lobes.
struct Shares {
    /// Diffuse base and sheen.
    base: f32,
    coat: f32,
    facets: f32,
}

impl Gltf {
    /// Works out what does not depend on directions.
    #[inline]
    pub fn new(dials: &GltfDials) -> Self {
        let [metallic, roughness, transmission, specular] =
            [dials.metallic, dials.roughness, dials.transmission, dials.specular].map(dial);
        let facets =
            |roughness: f32| Microfacet::new(Distribution::Ggx, roughness * roughness, roughness * roughness);
        let bends = transmission > 0.0 && !dials.thin;
        let eta = if bends { unmatched(dials.ior) } else { dials.ior };
        let sheen_roughness = dial(dials.sheen_roughness);
        Self {
            base_color: dials.base_color,
            metallic,
            roughness,
            facets: facets(roughness),
            eta,
            f0: (dials.specular_color * normal_reflectance(eta)).min(Rgb::ONE) * specular,
            f90: specular,
            diffuse: dials.base_color * ((1.0 - metallic) * (1.0 - transmission)),
            transmission: (1.0 - metallic) * transmission,
            thin: dials.thin,
            sheen_color: dials.sheen_color,
            sheen_alpha: sheen_roughness * sheen_roughness,
            clearcoat: dial(dials.clearcoat),
            coat: facets(dial(dials.clearcoat_roughness)),
        }
    }

    /// At the cosine `cos` to the facet; `eta` is the index of the far side over that of the near one. `front`: all of the
    /// base, else refraction and its reflection.
    #[inline]
    fn facet(&self, front: bool, cos: f32, eta: f32) -> Facet {
        let weight = if self.thin { schlick_weight(cos) } else { schlick_weight_into(cos, eta) };
        let dielectric = self.f0 + (Rgb::splat(self.f90) - self.f0) * weight;
        let left = (1.0 - dielectric.max_element()).max(0.0);
        let reflectance = if front {
            let metal = self.base_color + (Rgb::ONE - self.base_color) * weight;
            dielectric + (metal - dielectric) * self.metallic
        } else {
            dielectric * self.transmission
        };
        let turned_back = !self.thin && 1.0 - (1.0 - cos) * (1.0 + cos) / (eta * eta) <= 0.0;
        let transmittance =
            if turned_back { Rgb::ZERO } else { self.base_color * (self.transmission * left) };
        let (r, t) = (mean(reflectance), mean(transmittance));
        Facet { reflectance, transmittance, left, share: if t > 0.0 { r / (r + t) } else { 1.0 } }
    }

    /// Weight of the coat.
    #[inline]
    fn coated(&self, cos: f32) -> f32 {
        if self.clearcoat > 0.0 { self.clearcoat * (0.04 + 0.96 * schlick_weight(cos)) } else { 0.0 }
    }

    /// What the sheen leaves to the base.
    #[inline]
    fn under_sheen(&self, cos_o: f32, cos_i: f32) -> f32 {
        if self.sheen_color == Rgb::ZERO {
            return 1.0;
        }
        let most = sheen::albedo(cos_o, self.sheen_alpha).max(sheen::albedo(cos_i, self.sheen_alpha));
        (1.0 - self.sheen_color.max_element() * most).max(0.0)
    }

    /// By estimates of the albedos, for a `wo` above the surface; `None` where nothing is scattered.
    #[inline]
    fn shares(&self, cos: f32) -> Option<Shares> {
        let f = schlick_weight(facing(cos, self.roughness));
        let towards_one = |f0: Rgb, f90: f32| mean(f0) + (f90 - mean(f0)).max(0.0) * f.max(0.02);
        let dielectric = towards_one(self.f0, self.f90);
        let coat = self.coated(cos);
        let mut base = mean(self.diffuse) * (1.0 - dielectric);
        if self.sheen_color != Rgb::ZERO {
            base += mean(self.sheen_color) * sheen::albedo(cos, self.sheen_alpha).max(0.01);
        }
        let facets = self.metallic * towards_one(self.base_color, 1.0)
            + (1.0 - self.metallic) * dielectric
            + self.transmission * mean(self.base_color) * (1.0 - dielectric);
        let (base, facets) = ((1.0 - coat) * base, (1.0 - coat) * facets);
        let scale = 1.0 / (base + coat + facets);
        let shares = Shares { base: base * scale, coat: coat * scale, facets: facets * scale };
        scale.is_finite().then_some(shares)
    }

    /// Whether it scatters at all from the side of `wo`, and whether as from the front.
    #[inline]
    fn side(&self, wo: Vec3) -> Option<bool> {
        let behind = wo.z < 0.0 && self.transmission > 0.0;
        (wo.z > 0.0 || behind).then_some(wo.z > 0.0 || self.thin)
    }

    /// Draws from one lobe: base and sheen by the cosine, coat and facets by what is seen of them; a facet reflects or
    /// lets through in proportion to both.
    #[inline]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample> {
        let front = self.side(wo)?;
        let (above, eta) = self.turned(wo);
        let mut rest = u_lobe;
        let mut relative = 1.0;
        let wi = 'drawn: {
            if front {
                let shares = self.shares(above.z)?;
                rest -= shares.base;
                if rest < 0.0 {
                    break 'drawn cosine_hemisphere(u);
                }
                rest -= shares.coat;
                if rest < 0.0 {
                    break 'drawn self.coat.sample(above, u)?;
                }
                rest = (rest / shares.facets).min(1.0f32.next_down());
            }
            let m = self.facets.visible_normal(above, u);
            let cos_m = above.dot(m).clamp(0.0, 1.0);
            let reflects = rest < self.facet(front, cos_m, eta).share;
            let mirrored = 2.0 * cos_m * m - above;
            let wi = if reflects {
                mirrored
            } else if self.thin {
                Vec3::new(mirrored.x, mirrored.y, -mirrored.z)
            } else {
                relative = eta;
                let cos_t = fresnel::dielectric(cos_m, eta).cos_t;
                ((cos_m / eta - cos_t) * m - above / eta).normalize()
            };
            // What falls on the wrong side would go on to other facets.
            if wi.z == 0.0 || (wi.z > 0.0) != reflects {
                return None;
            }
            wi
        };
        let wi = if wo.z < 0.0 { -wi } else { wi };
        self.eval(wo, wi).drawn(wi, relative)
    }

    /// `wo` turned above the surface through the origin, and the relative index there.
    #[inline]
    fn turned(&self, wo: Vec3) -> (Vec3, f32) {
        if wo.z < 0.0 { (-wo, if self.thin { self.eta } else { 1.0 / self.eta }) } else { (wo, self.eta) }
    }

    /// Value and density of all lobes.
    #[inline]
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> BsdfEval {
        let Some(front) = self.side(wo) else { return BsdfEval::ZERO };
        let wi = if wo.z < 0.0 { -wi } else { wi };
        let (wo, eta) = self.turned(wo);
        if !front {
            return self.facets_alone(wo, wi, eta, false);
        }
        let Some(shares) = self.shares(wo.z) else { return BsdfEval::ZERO };
        let under = (1.0 - self.coated(wo.z)) * self.under_sheen(wo.z, wi.z.abs());
        if wi.z <= 0.0 {
            let value = self.facets_alone(wo, wi, eta, true);
            return BsdfEval { f_cos: value.f_cos * under, pdf: shares.facets * value.pdf };
        }
        let Some(lobe) = self.facets.reflection(wo, wi) else { return BsdfEval::ZERO };
        let facet = self.facet(true, lobe.cos_m, eta);
        let mut specular = facet.reflectance * (under * lobe.weight * lobe.pdf);
        let mut pdf = shares.facets * facet.share * lobe.pdf;
        let cosine = cosine_hemisphere_pdf(wi);
        let mut diffuse = self.diffuse * (under * facet.left * FRAC_1_PI * wi.z);
        pdf += shares.base * cosine;
        if self.sheen_color != Rgb::ZERO {
            let sheen = (1.0 - self.coated(wo.z)) * sheen::f_cos(wo, wi, self.sheen_alpha);
            diffuse += self.sheen_color * sheen;
        }
        if let Some(lobe) = self.coat.reflection(wo, wi).filter(|_| self.clearcoat > 0.0) {
            specular += self.coated(wo.z) * lobe.weight * lobe.pdf;
            pdf += shares.coat * lobe.pdf;
        }
        BsdfEval { f_cos: Split { diffuse, specular }, pdf }
    }

    /// The facets for a `wo` above them, as if nothing lay over them.
    #[inline]
    fn facets_alone(&self, wo: Vec3, wi: Vec3, eta: f32, front: bool) -> BsdfEval {
        let through = wi.z < 0.0;
        if through && self.transmission <= 0.0 {
            return BsdfEval::ZERO;
        }
        let lobe = if !through {
            self.facets.reflection(wo, wi)
        } else if self.thin {
            self.facets.reflection(wo, Vec3::new(wi.x, wi.y, -wi.z))
        } else {
            self.facets.refraction(wo, wi, eta)
        };
        let Some(lobe) = lobe else { return BsdfEval::ZERO };
        let facet = self.facet(front, lobe.cos_m, eta);
        // Radiance is spread over another solid angle on the other side.
        let spread = if through && !self.thin { 1.0 / (eta * eta) } else { 1.0 };
        let (colour, share) =
            if through { (facet.transmittance, 1.0 - facet.share) } else { (facet.reflectance, facet.share) };
        let f_cos = colour * (lobe.weight * lobe.pdf * spread);
        BsdfEval { f_cos: Split::specular(f_cos), pdf: share * lobe.pdf }
    }

    /// For the feature layers: what is reflected and what goes through, without the change of solid angle.
    pub fn features(&self, wo: Vec3) -> BsdfFeatures {
        let has_base = self.has_base();
        let roughness = if has_base { 1.0 } else { self.alpha().sqrt() };
        let Some(front) = self.side(wo) else {
            return BsdfFeatures { albedo: Rgb::ZERO, diffuse_albedo: Rgb::ZERO, roughness };
        };
        let (wo, eta) = self.turned(wo);
        let weight = |u: Vec2| {
            let m = self.facets.visible_normal(wo, u);
            let cos_m = wo.dot(m).clamp(0.0, 1.0);
            let facet = self.facet(front, cos_m, eta);
            let mirrored = 2.0 * cos_m * m - wo;
            let mut sum = Rgb::ZERO;
            if mirrored.z > 0.0 {
                let through = if self.thin { facet.transmittance } else { Rgb::ZERO };
                let under = if front { self.under_sheen(wo.z, mirrored.z) } else { 1.0 };
                sum += (facet.reflectance + through) * (under * self.facets.g1(mirrored));
            }
            if !self.thin && self.transmission > 0.0 {
                let cos_t = fresnel::dielectric(cos_m, eta).cos_t;
                let refracted = ((cos_m / eta - cos_t) * m - wo / eta).normalize();
                if refracted.z < 0.0 {
                    let under = if front { self.under_sheen(wo.z, -refracted.z) } else { 1.0 };
                    sum += facet.transmittance * (under * self.facets.g1(refracted));
                }
            }
            sum
        };
        let mut albedo = if self.transmission > 0.0 || self.sheen_color != Rgb::ZERO {
            albedo::lattice::<55, 34>().map(weight).sum::<Rgb>() / 55.0
        } else {
            let reflectance = |cos| self.facet(true, cos, eta).reflectance;
            albedo::albedo(Distribution::Ggx, self.facets.widest(), wo.z, reflectance)
        };
        let mut diffuse_albedo = Rgb::ZERO;
        if front {
            let coat = self.coated(wo.z);
            if has_base {
                diffuse_albedo = (1.0 - coat) * self.base_albedo(wo.z, eta);
            }
            albedo = albedo * (1.0 - coat) + diffuse_albedo;
            if coat > 0.0 {
                albedo += coat * albedo::albedo(Distribution::Ggx, self.coat.widest(), wo.z, |_| Rgb::ONE);
            }
        }
        BsdfFeatures { albedo, diffuse_albedo, roughness }
    }

    /// Of the diffuse base and the sheen.
    fn base_albedo(&self, cos: f32, eta: f32) -> Rgb {
        let base = hemisphere(cos, |wo, wi| {
            let cos_m = (0.5 + 0.5 * wo.dot(wi)).max(0.0).sqrt();
            let left = self.facet(true, cos_m, eta).left * self.under_sheen(wo.z, wi.z);
            self.diffuse * (left * FRAC_1_PI * wi.z)
        });
        if self.sheen_color == Rgb::ZERO {
            return base;
        }
        base + self.sheen_color * sheen::albedo(cos, self.sheen_alpha)
    }

    /// Whether there is a diffuse part.
    fn has_base(&self) -> bool {
        self.diffuse != Rgb::ZERO || self.sheen_color != Rgb::ZERO
    }

    /// The widest specular lobe.
    fn alpha(&self) -> f32 {
        self.facets.widest().max(if self.clearcoat > 0.0 { self.coat.widest() } else { 0.0 })
    }

    /// See [`Bsdf::near_delta`](super::Bsdf::near_delta).
    #[inline]
    pub fn near_delta(&self) -> bool {
        !self.has_base() && self.alpha() < NEAR_DELTA_ALPHA
    }
}
