//! Coats at a hit.

use glam::Vec3;
use limpid_scenes::{Color, Material};

use super::{Coatings, Model, relative};
use crate::bsdf::{self, Coating, Plastic};
use crate::prepare::PrepareError;
use crate::texture::{TexturePoint, Textures};

/// A coat with what is constant over the surface worked out.
#[derive(Clone, Copy)]
pub struct CoatModel {
    eta: f32,
    thickness: f32,
    sigma_a: Color,
    specular: Color,
    /// Index into the tables of coatings.
    rough: Option<usize>,
    in_map: bool,
}

impl CoatModel {
    /// The coat, and the model of its own reflection: a plastic without a base. `in_map`: a normal map lies around it.
    pub fn prepare(
        material: &Material,
        coat: &limpid_scenes::Coat,
        in_map: bool,
        coatings: &mut Coatings,
    ) -> Result<(Self, Model), PrepareError> {
        let eta = relative(material, coat.int_ior, coat.ext_ior)?;
        let rough = coat.facets.map(|(distribution, alpha)| coatings.get(distribution, alpha, eta));
        let (diffuse, specular, nonlinear) = (Color::Constant([0.0; 3]), coat.specular_reflectance, false);
        let model = match rough {
            Some(coating) => Model::RoughPlastic { coating, diffuse, specular, nonlinear },
            None => {
                let internal = Plastic::internal_reflectance(eta);
                Model::Plastic { eta, internal, diffuse, specular, nonlinear }
            }
        };
        let (thickness, sigma_a) = (coat.thickness, coat.sigma_a);
        Ok((Self { eta, thickness, sigma_a, specular, rough, in_map }, model))
    }

    /// What it does at a hit that is seen from `wo`.
    pub fn at<'a>(
        &self,
        wo: Vec3,
        coatings: &'a [Coating],
        uv: TexturePoint,
        textures: &Textures,
    ) -> bsdf::Coat<'a> {
        let depth = (textures.color(self.sigma_a, uv) * self.thickness).max(Vec3::ZERO);
        let rough = self.rough.map(|i| &coatings[i]);
        let coat = bsdf::Coat { eta: self.eta, depth, rough, in_map: self.in_map, share: 0.5 };
        coat.shared(wo.z, textures.color(self.specular, uv))
    }
}

#[cfg(test)]
mod tests;
