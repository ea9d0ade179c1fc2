//! From a scene's materials, with their textures and nesting, to the numbers of a [`Bsdf`] at a hit.

use std::collections::HashMap;
use std::sync::Arc;

use glam::Vec2;
use limpid_scenes::{Color, ConductorIor, Distribution, MaterialId, MaterialKind, Scene};

use crate::bsdf::microfacet::Microfacet;
use crate::bsdf::{Bsdf, Coating, Conductor, Dielectric, Diffuse, Metal, Plastic, RoughConductor};
use crate::prepare::PrepareError;
use crate::texture::Textures;

/// The materials of a scene.
pub struct Materials {
    materials: Vec<Prepared>,
}

struct Prepared {
    front: Side,
    /// Of a two-sided material.
    back: Option<Side>,
    anisotropic: bool,
}

/// One side, and the table that its coating needs.
struct Side {
    kind: MaterialKind,
    coating: Option<Arc<Coating>>,
}

impl Materials {
    /// Makes the tables; materials with the same coating share one.
    ///
    /// # Errors
    ///
    /// A two-sided material inside another.
    pub fn prepare(scene: &Scene) -> Result<Self, PrepareError> {
        let mut coatings = HashMap::new();
        let mut materials = Vec::new();
        for material in &scene.materials {
            let mut side = |id: MaterialId| {
                let inner = &scene.materials[id.0 as usize];
                if let MaterialKind::TwoSided { .. } = inner.kind {
                    return Err(PrepareError {
                        place: material.place.clone(),
                        element: format!("bsdf \"{}\"", material.name),
                        problem: "a two-sided material holds another".into(),
                        help: "remove one of the two".into(),
                    });
                }
                Ok(Side { kind: inner.kind.clone(), coating: coating(&inner.kind, &mut coatings) })
            };
            let (front, back) = match material.kind {
                MaterialKind::TwoSided { front, back } => (side(front)?, Some(side(back)?)),
                _ => {
                    let coating = coating(&material.kind, &mut coatings);
                    (Side { kind: material.kind.clone(), coating }, None)
                }
            };
            let anisotropic =
                [Some(&front), back.as_ref()].into_iter().flatten().any(|s| is_anisotropic(&s.kind));
            materials.push(Prepared { front, back, anisotropic });
        }
        Ok(Self { materials })
    }

    /// Whether the direction of the surface's u counts.
    #[inline]
    pub fn is_anisotropic(&self, material: MaterialId) -> bool {
        self.materials[material.0 as usize].anisotropic
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
        let material = &self.materials[material.0 as usize];
        match &material.back {
            Some(back) if behind => (back.bsdf(uv, textures), true),
            _ => (material.front.bsdf(uv, textures), false),
        }
    }
}

fn is_anisotropic(kind: &MaterialKind) -> bool {
    match kind {
        MaterialKind::RoughConductor { alpha_u, alpha_v, .. } => alpha_u != alpha_v,
        _ => false,
    }
}

/// Coatings by what they depend on, as bits.
type Coatings = HashMap<(u32, Option<(bool, u32)>), Arc<Coating>>;

fn coating(kind: &MaterialKind, coatings: &mut Coatings) -> Option<Arc<Coating>> {
    let (eta, rough) = match *kind {
        MaterialKind::Plastic { int_ior, ext_ior, .. } => (int_ior / ext_ior, None),
        MaterialKind::RoughPlastic { int_ior, ext_ior, distribution, alpha, .. } => {
            (int_ior / ext_ior, Some((distribution, alpha)))
        }
        _ => return None,
    };
    let key = (eta.to_bits(), rough.map(|(d, alpha)| (d == Distribution::Ggx, alpha.to_bits())));
    let make = || {
        Arc::new(match rough {
            None => Coating::smooth(eta),
            Some((distribution, alpha)) => Coating::rough(eta, distribution, alpha),
        })
    };
    Some(coatings.entry(key).or_insert_with(make).clone())
}

impl Side {
    #[inline]
    fn bsdf(&self, uv: Vec2, textures: &Textures) -> Bsdf<'_> {
        let color = |c: Color| textures.color(c, uv);
        let metal = |ior: Option<ConductorIor>, tint: Color| Metal {
            ior: ior.map(|ior| (color(ior.eta), color(ior.k))),
            tint: color(tint),
        };
        match self.kind {
            MaterialKind::Diffuse { reflectance } => Bsdf::Diffuse(Diffuse { albedo: color(reflectance) }),
            MaterialKind::Conductor { ior, specular_reflectance } => {
                Bsdf::Conductor(Conductor { metal: metal(ior, specular_reflectance) })
            }
            MaterialKind::RoughConductor { distribution, alpha_u, alpha_v, ior, specular_reflectance } => {
                let (x, y) = (textures.scalar(alpha_u, uv), textures.scalar(alpha_v, uv));
                Bsdf::RoughConductor(RoughConductor {
                    metal: metal(ior, specular_reflectance),
                    microfacet: Microfacet::new(distribution, x, y),
                })
            }
            MaterialKind::Dielectric { int_ior, ext_ior, specular_reflectance, specular_transmittance } => {
                Bsdf::Dielectric(Dielectric {
                    eta: int_ior / ext_ior,
                    reflectance: color(specular_reflectance),
                    transmittance: color(specular_transmittance),
                })
            }
            MaterialKind::Plastic { diffuse_reflectance, specular_reflectance, nonlinear, .. }
            | MaterialKind::RoughPlastic { diffuse_reflectance, specular_reflectance, nonlinear, .. } => {
                Bsdf::Plastic(Plastic {
                    coating: self.coating.as_ref().expect("made in `prepare` for every plastic"),
                    diffuse: color(diffuse_reflectance),
                    tint: color(specular_reflectance),
                    nonlinear,
                })
            }
            MaterialKind::TwoSided { .. } => unreachable!("`prepare` takes two-sided materials apart"),
        }
    }
}
