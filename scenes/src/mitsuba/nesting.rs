//! `<bsdf>`s that change or mix others.

use super::Reader;
use super::document::ElementId;
use super::object::Object;
use super::value::numbers;
use crate::spectrum::Quantity;
use crate::{Color, MaterialId, MaterialKind, NormalMap, Scalar, SceneError};

/// The plugins that [`Reader::nesting`] reads.
pub(super) const NESTING: [&str; 6] = ["null", "mask", "blendbsdf", "mixturebsdf", "normalmap", "bumpmap"];

impl Reader<'_> {
    /// A material that is made of others.
    pub(super) fn nesting(&mut self, object: &Object<'_>, kind: &str) -> Result<MaterialKind, SceneError> {
        Ok(match kind {
            "null" => MaterialKind::Null,
            "mask" => {
                MaterialKind::Mask { opacity: self.share(object, "opacity")?, inner: self.only_bsdf(object)? }
            }
            "blendbsdf" => {
                let weight = self.share(object, "weight")?;
                match object.nested("bsdf")?[..] {
                    [(first, _), (second, _)] => MaterialKind::Blend {
                        weight,
                        first: self.material(first)?,
                        second: self.material(second)?,
                    },
                    ref found => {
                        let problem = format!("{} bsdfs inside", found.len());
                        return Err(object.error(problem, "nest the two that are to be blended"));
                    }
                }
            }
            "mixturebsdf" => self.mixture(object)?,
            _ => {
                let map = if kind == "normalmap" {
                    NormalMap::Normal(self.only_texture(object, "normalmap")?)
                } else {
                    let height = match self.only_texture(object, "texture")? {
                        Color::Texture(texture) => Scalar::Texture(texture),
                        Color::Constant(grey) => Scalar::Constant(grey[0]),
                    };
                    NormalMap::Bump { height, scale: object.float("scale", 1.0)? as f32 }
                };
                MaterialKind::Perturbed {
                    map,
                    flip_invalid: object.boolean("flip_invalid_normals", true)?,
                    shadowing: object.boolean("use_shadowing_function", true)?,
                    inner: self.only_bsdf(object)?,
                }
            }
        })
    }

    /// A share, which a texture may give; ½ where the file says nothing.
    fn share(&mut self, object: &Object<'_>, key: &'static str) -> Result<Scalar, SceneError> {
        let within = |x: f64| (0.0..=1.0).contains(&x);
        match object.find(key) {
            // opacity may be a colour: its luminance counts
            Some((id, parameter)) if matches!(parameter.tag.as_str(), "rgb" | "spectrum" | "srgb") => {
                match self.color_of(object, id, parameter, Quantity::Reflectance)? {
                    Color::Constant([r, g, b]) => {
                        Ok(Scalar::Constant((0.212_639 * r + 0.715_169 * g + 0.072_192 * b).clamp(0.0, 1.0)))
                    }
                    Color::Texture(texture) => Ok(Scalar::Texture(texture)),
                }
            }
            _ => self.scalar(object, key, 0.5, "from 0 to 1", within),
        }
    }

    pub(super) fn only_bsdf(&mut self, object: &Object<'_>) -> Result<MaterialId, SceneError> {
        match object.nested("bsdf")?[..] {
            [(inner, _)] => self.material(inner),
            ref found => {
                let problem = format!("{} bsdfs inside", found.len());
                Err(object.error(problem, "nest the one that it changes"))
            }
        }
    }

    /// The texture inside, whatever its name; a colour only under the name `key`.
    fn only_texture(&mut self, object: &Object<'_>, key: &'static str) -> Result<Color, SceneError> {
        match object.nested("texture")?[..] {
            [(texture, _)] => self.texture(texture),
            [] if object.find(key).is_some() => {
                self.color(object, key, Quantity::Ratio, Color::Constant([0.5; 3]))
            }
            ref found => {
                let problem = format!("{} textures inside", found.len());
                Err(object.error(problem, "nest one: <texture type=\"bitmap\">…</texture>"))
            }
        }
    }

    fn mixture(&mut self, object: &Object<'_>) -> Result<MaterialKind, SceneError> {
        let inner: Vec<ElementId> = object.nested("bsdf")?.into_iter().map(|(id, _)| id).collect();
        let Some((_, parameter)) = object.string("weights")? else {
            return Err(object
                .error("no \"weights\"", "give one a bsdf: <string name=\"weights\" value=\"0.5, 0.5\"/>"));
        };
        let mut weights = numbers(parameter, "value")?;
        if weights.len() != inner.len() || weights.is_empty() {
            let problem = format!("{} weights for {} bsdfs", weights.len(), inner.len());
            return Err(object.value_error(parameter, problem, "give one weight a bsdf"));
        }
        if let Some(bad) = weights.iter().find(|w| !(0.0..=1e30).contains(*w)) {
            return Err(object.value_error(
                parameter,
                format!("the weight {bad} is negative or not a number"),
                "give weights from 0 to 1",
            ));
        }
        let sum: f64 = weights.iter().sum();
        object.boolean("ensure_energy_conservation", true)?;
        if sum > 1.0 {
            self.warn(object.id, format!("the weights add up to {sum} and are divided by it"));
            weights.iter_mut().for_each(|w| *w /= sum);
        }
        let mut parts = Vec::with_capacity(inner.len());
        for (id, weight) in inner.into_iter().zip(weights) {
            parts.push((weight as f32, self.material(id)?));
        }
        Ok(MaterialKind::Mixture { parts })
    }
}
