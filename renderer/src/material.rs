//! From a scene's materials, with their textures and nesting, to the numbers of a [`Bsdf`] at a hit.

mod absorption;
mod coat;
mod flatten;
mod perturb;
mod principled;

use limpid_scenes::{
    Color, ConductorIor, Distribution, Material, MaterialId, MaterialKind, Scalar, Scene, WardVariant,
};

use glam::Vec3;

use crate::bsdf::{
    Bsdf, Coating, Conductor, Dielectric, Diffuse, Ior, Lobes, Microfacet, Perturbation, Phong, Plastic,
    RoughConductor, RoughDielectric, RoughDiffuse, RoughPlastic, ThinDielectric, Turn, Ward,
};
use crate::color::Rgb;
use crate::prepare::PrepareError;
use crate::texture::{TexturePoint, Textures};
pub use absorption::Absorption;
pub use flatten::Map;
use flatten::{Flatten, Piece, Share, Side};
pub use perturb::Perturbed;

/// The materials of a scene.
pub struct Materials {
    materials: Vec<Sides>,
    /// Tables of the rough plastics, which share one where their coatings are alike.
    coatings: Vec<Coating>,
}

/// Where and from which side a material is looked at.
#[derive(Clone, Copy)]
pub struct At {
    pub material: MaterialId,
    /// Texture coordinates.
    pub uv: TexturePoint,
    /// Seen from the side away from the shading normal.
    pub behind: bool,
}

/// What a surface is made of.
struct Sides {
    front: Side,
    back: Side,
    needs_tangent: bool,
    /// Of the inside; `None` where there is none.
    absorption: Option<Absorption>,
}

/// A model with what is constant over the surface worked out.
#[derive(Clone, Copy)]
pub enum Model {
    Diffuse {
        albedo: Color,
    },
    Conductor {
        ior: Option<ConductorIor>,
        specular: Color,
    },
    RoughConductor {
        distribution: Distribution,
        alpha_u: Scalar,
        alpha_v: Scalar,
        ior: Option<ConductorIor>,
        specular: Color,
    },
    Dielectric {
        eta: f32,
        reflectance: Color,
        transmittance: Color,
    },
    Plastic {
        eta: f32,
        internal: f32,
        diffuse: Color,
        specular: Color,
        nonlinear: bool,
    },
    RoughPlastic {
        /// Index into `coatings`.
        coating: usize,
        diffuse: Color,
        specular: Color,
        nonlinear: bool,
    },
    RoughDielectric {
        distribution: Distribution,
        alpha_u: Scalar,
        alpha_v: Scalar,
        eta: f32,
        reflectance: Color,
        transmittance: Color,
    },
    ThinDielectric {
        eta: f32,
        reflectance: Color,
        transmittance: Color,
    },
    RoughDiffuse {
        albedo: Color,
        alpha: Scalar,
        fast: bool,
    },
    Phong {
        exponent: Scalar,
        diffuse: Color,
        specular: Color,
    },
    Ward {
        variant: WardVariant,
        alpha_u: Scalar,
        alpha_v: Scalar,
        diffuse: Color,
        specular: Color,
    },
    Principled(limpid_scenes::Principled),
    PrincipledThin(limpid_scenes::PrincipledThin),
    Gltf(limpid_scenes::GltfMaterial),
}

impl Materials {
    /// Makes the lists and the tables.
    ///
    /// # Errors
    ///
    /// An index of refraction that is not a positive number, a two-sided material around one that has two sides
    /// already, a normal map in a normal map, a coat over another or over what lets light through, and a blend of too many
    /// BSDFs.
    pub fn prepare(scene: &Scene) -> Result<Self, PrepareError> {
        let mut coatings = Coatings::default();
        let mut materials = Vec::with_capacity(scene.materials.len());
        for outer in (0..scene.materials.len() as u32).map(MaterialId) {
            let [front, back] = Flatten { scene, coatings: &mut coatings, outer }.sides()?;
            let mut pieces = front.pieces.iter().chain(&back.pieces);
            let absorption = pieces.clone().find_map(|piece| piece.model.absorption());
            let needs_tangent = pieces.any(|piece| piece.map.is_some() || piece.model.is_anisotropic());
            materials.push(Sides { front, back, needs_tangent, absorption });
        }
        Ok(Self { materials, coatings: coatings.tables })
    }

    /// Whether the direction of the surface's u counts.
    #[inline]
    pub fn needs_tangent(&self, material: MaterialId) -> bool {
        self.materials[material.0 as usize].needs_tangent
    }

    /// Whether some of the material lets light straight through.
    #[inline]
    pub fn has_holes(&self, material: MaterialId) -> bool {
        let Sides { front, back, .. } = &self.materials[material.0 as usize];
        !front.holes.is_empty() || !back.holes.is_empty()
    }

    /// What the inside of the material absorbs; `None` where it has none.
    #[inline]
    pub fn absorption(&self, material: MaterialId) -> Option<&Absorption> {
        self.materials[material.0 as usize].absorption.as_ref()
    }

    /// Whether the inside of any material absorbs.
    pub fn absorb(&self) -> bool {
        self.materials.iter().any(|sides| sides.absorption.is_some_and(|inside| inside.color != Rgb::ONE))
    }

    /// Share of the light that goes straight through, in [0, 1].
    #[inline]
    pub fn hole(&self, at: At, textures: &Textures) -> f32 {
        let holes = &self.side(at).holes;
        if holes.is_empty() {
            return 0.0;
        }
        holes.iter().map(|hole| share(hole, at.uv, textures)).sum::<f32>().min(1.0)
    }

    /// Adds what scatters at a hit, seen from `wo`, where the share `hole` is not there; the weights refer to the rest.
    /// `perturbed` makes of a normal map and the question whether the surface is turned over before it what the map does at
    /// the hit.
    #[inline]
    pub fn add_lobes<'a>(
        &'a self,
        at: At,
        wo: Vec3,
        hole: f32,
        textures: &Textures,
        mut perturbed: impl FnMut(&Map, bool) -> Perturbation,
        lobes: &mut Lobes<'a>,
    ) {
        let there = 1.0 - hole;
        let side = self.side(at);
        for coat in &side.coats {
            lobes.push_coat(coat.at(wo, &self.coatings, at.uv, textures));
        }
        for Piece { share: of_piece, before, map, after, layer, model } in &side.pieces {
            let weight =
                if of_piece.factors.is_empty() { 1.0 } else { share(of_piece, at.uv, textures) / there };
            if weight <= 0.0 {
                continue; // before its normal map and textures are looked up
            }
            let map = map.as_ref().map(|map| perturbed(map, *before));
            let turn = Turn { before: *before, map, after: *after };
            lobes.push(weight.min(1.0), turn, *layer, self.at(model, at.uv, textures));
        }
    }

    #[inline]
    fn side(&self, at: At) -> &Side {
        let Sides { front, back, .. } = &self.materials[at.material.0 as usize];
        if at.behind { back } else { front }
    }

    #[inline(always)]
    fn at(&self, model: &Model, uv: TexturePoint, textures: &Textures) -> Bsdf<'_> {
        let color = |c: Color| textures.color(c, uv);
        let scalar = |x: Scalar| textures.scalar(x, uv);
        let complex = |ior: Option<ConductorIor>| ior.map(|ior| Ior { eta: color(ior.eta), k: color(ior.k) });
        match *model {
            Model::Diffuse { albedo } => Bsdf::Diffuse(Diffuse { albedo: color(albedo) }),
            Model::Conductor { ior, specular } => {
                Bsdf::Conductor(Conductor { ior: complex(ior), specular: color(specular) })
            }
            Model::RoughConductor { distribution, alpha_u, alpha_v, ior, specular } => {
                let (u, v) = (scalar(alpha_u), scalar(alpha_v));
                let facets = Microfacet::new(distribution, u, v);
                Bsdf::RoughConductor(RoughConductor { facets, ior: complex(ior), specular: color(specular) })
            }
            Model::Dielectric { eta, reflectance, transmittance } => Bsdf::Dielectric(Dielectric {
                eta,
                reflectance: color(reflectance),
                transmittance: color(transmittance),
            }),
            Model::Plastic { eta, internal, diffuse, specular, nonlinear } => {
                Bsdf::Plastic(Plastic::new(eta, internal, color(diffuse), color(specular), nonlinear))
            }
            Model::RoughPlastic { coating, diffuse, specular, nonlinear } => {
                let coating = &self.coatings[coating];
                Bsdf::RoughPlastic(RoughPlastic::new(coating, color(diffuse), color(specular), nonlinear))
            }
            Model::RoughDielectric { distribution, alpha_u, alpha_v, eta, reflectance, transmittance } => {
                let (reflectance, transmittance) = (color(reflectance), color(transmittance));
                Bsdf::RoughDielectric(RoughDielectric {
                    facets: Microfacet::new(distribution, scalar(alpha_u), scalar(alpha_v)),
                    boundary: Dielectric { eta, reflectance, transmittance },
                })
            }
            Model::ThinDielectric { eta, reflectance, transmittance } => {
                Bsdf::ThinDielectric(ThinDielectric {
                    eta,
                    reflectance: color(reflectance),
                    transmittance: color(transmittance),
                })
            }
            Model::RoughDiffuse { albedo, alpha, fast } => {
                Bsdf::RoughDiffuse(RoughDiffuse::new(color(albedo), scalar(alpha), fast))
            }
            Model::Phong { exponent, diffuse, specular } => {
                Bsdf::Phong(Phong::new(scalar(exponent), color(diffuse), color(specular)))
            }
            Model::Ward { variant, alpha_u, alpha_v, diffuse, specular } => {
                let (u, v) = (scalar(alpha_u), scalar(alpha_v));
                Bsdf::Ward(Ward::new(variant, u, v, color(diffuse), color(specular)))
            }
            Model::Principled(ref p) => principled::principled(p, uv, textures),
            Model::PrincipledThin(ref p) => principled::principled_thin(p, uv, textures),
            Model::Gltf(ref p) => principled::gltf(p, uv, textures),
        }
    }
}

impl Model {
    /// What its inside absorbs; `None` where it has no inside.
    fn absorption(&self) -> Option<Absorption> {
        const CLEAR: Absorption = Absorption { color: Rgb::ONE, distance: 1.0 };
        match self {
            Self::Gltf(p) if !p.thin && p.transmits() => {
                Some(p.attenuation.map_or(CLEAR, |(distance, color)| Absorption {
                    color: Rgb::from_array(color),
                    distance,
                }))
            }
            Self::Dielectric { .. } | Self::RoughDielectric { .. } => Some(CLEAR),
            Self::Principled(p) if p.spec_trans != Scalar::Constant(0.0) => Some(CLEAR),
            _ => None,
        }
    }

    fn is_anisotropic(&self) -> bool {
        let is_stretched = |anisotropic: Scalar| anisotropic != Scalar::Constant(0.0);
        match self {
            Self::RoughConductor { alpha_u, alpha_v, .. }
            | Self::RoughDielectric { alpha_u, alpha_v, .. }
            | Self::Ward { alpha_u, alpha_v, .. } => alpha_u != alpha_v,
            Self::Principled(p) => is_stretched(p.anisotropic),
            Self::PrincipledThin(p) => is_stretched(p.anisotropic),
            Self::Diffuse { .. }
            | Self::Conductor { .. }
            | Self::Dielectric { .. }
            | Self::ThinDielectric { .. }
            | Self::RoughDiffuse { .. }
            | Self::Phong { .. }
            | Self::Plastic { .. }
            | Self::RoughPlastic { .. }
            | Self::Gltf(_) => false,
        }
    }
}

/// The product, each factor brought into [0, 1]; NaN counts as 0.
#[inline]
fn share(share: &Share, uv: impl Into<TexturePoint>, textures: &Textures) -> f32 {
    let uv = uv.into();
    let factor = |&(scalar, complement): &(Scalar, bool)| {
        let x = textures.scalar(scalar, uv);
        let x = if x.is_nan() { 0.0 } else { x.clamp(0.0, 1.0) };
        if complement { 1.0 - x } else { x }
    };
    share.factors.iter().map(factor).product()
}

/// Coatings with what each was made from.
#[derive(Default)]
pub struct Coatings {
    tables: Vec<Coating>,
    keys: Vec<(Distribution, f32, f32)>,
}

impl Coatings {
    /// Index of the table; few scenes have more than a dozen, so that a search is quick.
    fn get(&mut self, distribution: Distribution, alpha: f32, eta: f32) -> usize {
        let key = (distribution, alpha, eta);
        self.keys.iter().position(|&k| k == key).unwrap_or_else(|| {
            self.keys.push(key);
            self.tables.push(Coating::new(distribution, alpha, eta));
            self.keys.len() - 1
        })
    }
}

/// Index inside over that outside.
fn relative(material: &Material, int_ior: f32, ext_ior: f32) -> Result<f32, PrepareError> {
    let eta = int_ior / ext_ior;
    if int_ior > 0.0 && ext_ior > 0.0 && eta.is_normal() {
        return Ok(eta);
    }
    let problem =
        format!("the indices of refraction {int_ior} (inside) and {ext_ior} (outside) have no ratio");
    Err(error(material, problem, "give two positive numbers, such as 1.5 and 1"))
}

fn prepare(material: &Material, coatings: &mut Coatings) -> Result<Model, PrepareError> {
    let relative = |int_ior: f32, ext_ior: f32| relative(material, int_ior, ext_ior);
    Ok(match material.kind {
        MaterialKind::Diffuse { reflectance } => Model::Diffuse { albedo: reflectance },
        MaterialKind::Conductor { ior, specular_reflectance: specular } => Model::Conductor { ior, specular },
        MaterialKind::RoughConductor {
            distribution,
            alpha_u,
            alpha_v,
            ior,
            specular_reflectance: specular,
        } => Model::RoughConductor { distribution, alpha_u, alpha_v, ior, specular },
        MaterialKind::Dielectric { int_ior, ext_ior, specular_reflectance, specular_transmittance } => {
            Model::Dielectric {
                eta: relative(int_ior, ext_ior)?,
                reflectance: specular_reflectance,
                transmittance: specular_transmittance,
            }
        }
        MaterialKind::Plastic { int_ior, ext_ior, diffuse_reflectance, specular_reflectance, nonlinear } => {
            let eta = relative(int_ior, ext_ior)?;
            Model::Plastic {
                eta,
                internal: Plastic::internal_reflectance(eta),
                diffuse: diffuse_reflectance,
                specular: specular_reflectance,
                nonlinear,
            }
        }
        MaterialKind::RoughPlastic {
            distribution,
            alpha,
            int_ior,
            ext_ior,
            diffuse_reflectance,
            specular_reflectance,
            nonlinear,
        } => Model::RoughPlastic {
            coating: coatings.get(distribution, alpha, relative(int_ior, ext_ior)?),
            diffuse: diffuse_reflectance,
            specular: specular_reflectance,
            nonlinear,
        },
        MaterialKind::RoughDielectric {
            distribution,
            alpha_u,
            alpha_v,
            int_ior,
            ext_ior,
            specular_reflectance,
            specular_transmittance,
        } => Model::RoughDielectric {
            distribution,
            alpha_u,
            alpha_v,
            eta: relative(int_ior, ext_ior)?,
            reflectance: specular_reflectance,
            transmittance: specular_transmittance,
        },
        MaterialKind::ThinDielectric { int_ior, ext_ior, specular_reflectance, specular_transmittance } => {
            Model::ThinDielectric {
                eta: relative(int_ior, ext_ior)?,
                reflectance: specular_reflectance,
                transmittance: specular_transmittance,
            }
        }
        MaterialKind::RoughDiffuse { reflectance, alpha, fast_approx } => {
            Model::RoughDiffuse { albedo: reflectance, alpha, fast: fast_approx }
        }
        MaterialKind::Phong { exponent, diffuse_reflectance, specular_reflectance } => {
            Model::Phong { exponent, diffuse: diffuse_reflectance, specular: specular_reflectance }
        }
        MaterialKind::Ward { variant, alpha_u, alpha_v, diffuse_reflectance, specular_reflectance } => {
            Model::Ward {
                variant,
                alpha_u,
                alpha_v,
                diffuse: diffuse_reflectance,
                specular: specular_reflectance,
            }
        }
        MaterialKind::Principled(ref p) => {
            Model::Principled(limpid_scenes::Principled { eta: relative(p.eta, 1.0)?, ..**p })
        }
        MaterialKind::PrincipledThin(ref p) => Model::PrincipledThin(**p),
        MaterialKind::Gltf(ref p) => {
            Model::Gltf(limpid_scenes::GltfMaterial { ior: relative(p.ior, 1.0)?, ..**p })
        }
        MaterialKind::TwoSided { .. }
        | MaterialKind::Coated { .. }
        | MaterialKind::Null
        | MaterialKind::Mask { .. }
        | MaterialKind::Blend { .. }
        | MaterialKind::Mixture { .. }
        | MaterialKind::Perturbed { .. } => unreachable!("`Flatten` takes what is made of others apart"),
    })
}

fn error(material: &Material, problem: String, help: &str) -> PrepareError {
    PrepareError {
        place: material.place.clone(),
        element: format!("bsdf \"{}\"", material.name),
        problem,
        help: help.into(),
    }
}

#[cfg(test)]
mod tests;
