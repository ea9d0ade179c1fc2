//! From a scene's materials, with their textures and nesting, to the numbers of a [`Bsdf`] at a hit.

use glam::Vec2;
use limpid_scenes::{Color, ConductorIor, Distribution, Material, MaterialId, MaterialKind, Scalar, Scene};

use crate::bsdf::{
    Bsdf, Coating, Conductor, Dielectric, Diffuse, Ior, Microfacet, Plastic, RoughConductor, RoughPlastic,
};
use crate::prepare::PrepareError;
use crate::texture::Textures;

/// The materials of a scene.
pub struct Materials {
    materials: Vec<Sides>,
    /// Tables of the rough plastics, which share one where their coatings are alike.
    coatings: Vec<Coating>,
}

/// What a surface is made of.
struct Sides {
    front: Model,
    /// Of a two-sided material.
    back: Option<Model>,
}

/// A model with what is constant over the surface worked out.
#[derive(Clone, Copy)]
enum Model {
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
}

impl Materials {
    /// Makes the tables.
    ///
    /// # Errors
    ///
    /// An index of refraction that is not a positive number, and a two-sided material around one that has two sides
    /// already.
    pub fn prepare(scene: &Scene) -> Result<Self, PrepareError> {
        let mut coatings = Coatings::default();
        let mut materials = Vec::with_capacity(scene.materials.len());
        for material in &scene.materials {
            let mut model = |id: MaterialId| {
                let inner = &scene.materials[id.0 as usize];
                match inner.kind {
                    MaterialKind::TwoSided { .. } | MaterialKind::Dielectric { .. } => Err(error(
                        material,
                        format!("\"{}\" inside it has two sides already", inner.name),
                        "use the inner bsdf without `twosided`",
                    )),
                    _ => prepare(inner, &mut coatings),
                }
            };
            materials.push(match material.kind {
                MaterialKind::TwoSided { front, back } => {
                    Sides { front: model(front)?, back: Some(model(back)?) }
                }
                _ => Sides { front: prepare(material, &mut coatings)?, back: None },
            });
        }
        Ok(Self { materials, coatings: coatings.tables })
    }

    /// Whether the direction of the surface's u counts.
    #[inline]
    pub fn is_anisotropic(&self, material: MaterialId) -> bool {
        let anisotropic = |model: &Model| matches!(model, Model::RoughConductor { alpha_u, alpha_v, .. } if alpha_u != alpha_v);
        let Sides { front, back } = &self.materials[material.0 as usize];
        anisotropic(front) || back.as_ref().is_some_and(anisotropic)
    }

    /// The BSDF at a hit, and whether it refers to the other side: the caller then turns the normal over.
    /// `behind`: the surface is seen from the side away from its shading normal.
    #[inline]
    pub fn bsdf(
        &self,
        material: MaterialId,
        uv: Vec2,
        textures: &Textures,
        behind: bool,
    ) -> (Bsdf<'_>, bool) {
        let sides = &self.materials[material.0 as usize];
        match &sides.back {
            Some(back) if behind => (self.at(back, uv, textures), true),
            _ => (self.at(&sides.front, uv, textures), false),
        }
    }

    #[inline]
    fn at(&self, model: &Model, uv: Vec2, textures: &Textures) -> Bsdf<'_> {
        let color = |c: Color| textures.color(c, uv);
        let complex = |ior: Option<ConductorIor>| ior.map(|ior| Ior { eta: color(ior.eta), k: color(ior.k) });
        match *model {
            Model::Diffuse { albedo } => Bsdf::Diffuse(Diffuse { albedo: color(albedo) }),
            Model::Conductor { ior, specular } => {
                Bsdf::Conductor(Conductor { ior: complex(ior), specular: color(specular) })
            }
            Model::RoughConductor { distribution, alpha_u, alpha_v, ior, specular } => {
                let (u, v) = (textures.scalar(alpha_u, uv), textures.scalar(alpha_v, uv));
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
        }
    }
}

/// Coatings with what each was made from.
#[derive(Default)]
struct Coatings {
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

fn prepare(material: &Material, coatings: &mut Coatings) -> Result<Model, PrepareError> {
    let relative = |int_ior: f32, ext_ior: f32| {
        let eta = int_ior / ext_ior;
        if int_ior > 0.0 && ext_ior > 0.0 && eta.is_normal() {
            Ok(eta)
        } else {
            let problem =
                format!("the indices of refraction {int_ior} (inside) and {ext_ior} (outside) have no ratio");
            Err(error(material, problem, "give two positive numbers, such as 1.5 and 1"))
        }
    };
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
        MaterialKind::TwoSided { .. } => unreachable!("`Materials::prepare` takes two-sided materials apart"),
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
