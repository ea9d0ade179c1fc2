//! `<bsdf>`: what surfaces are made of.

use super::Reader;
use super::document::ElementId;
use super::nesting::NESTING;
use super::object::Object;
use super::survey::{BSDFS, NAMED_IORS};
use super::value::shorten;
use crate::nearest::suggest;
use crate::spectrum::{self, Quantity};
use crate::{
    Color, ConductorIor, Distribution, Material, MaterialId, MaterialKind, Place, Rgb, Scalar, SceneError,
    WardVariant,
};

const WHITE: Color = Color::Constant([1.0; 3]);
const GREY: Color = Color::Constant([0.5; 3]);

impl Reader<'_> {
    /// A material, read once however often it is referred to.
    pub(super) fn material(&mut self, id: ElementId) -> Result<MaterialId, SceneError> {
        if let Some(&known) = self.materials.get(&id) {
            return Ok(known);
        }
        let material = self.nested(id, |reader| reader.new_material(id))?;
        self.materials.insert(id, material);
        Ok(material)
    }

    fn new_material(&mut self, id: ElementId) -> Result<MaterialId, SceneError> {
        let object = Object::new(self.document, id);
        let kind = object.kind()?;
        BSDFS.standing(kind, object.element)?; // none is for later
        let parameters = match kind {
            "twosided" => self.two_sided(&object)?,
            "coating" | "roughcoating" => self.coated(&object, kind)?,
            _ if NESTING.contains(&kind) => Err(self.nesting(&object, kind)?),
            _ => Err(self.model(&object, kind)?),
        };
        let parameters = match parameters {
            Ok(inner) => return Ok(inner), // which stands in
            Err(parameters) => parameters,
        };
        let name = self.name(&object, kind, self.scene.materials.len());
        let place = object.place();
        object.finish(&mut self.warnings);
        Ok(self.add_material(name, parameters, place))
    }

    fn add_material(&mut self, name: String, kind: MaterialKind, place: Place) -> MaterialId {
        let id = MaterialId(self.scene.materials.len() as u32);
        self.scene.materials.push(Material { name, kind, place });
        id
    }

    /// The material of a shape that names none: grey, or black if it emits.
    pub(super) fn default_material(&mut self, emits: bool, place: &Place) -> MaterialId {
        if let Some(known) = self.default_materials[usize::from(emits)] {
            return known;
        }
        let (name, reflectance) = if emits { ("black", Color::Constant([0.0; 3])) } else { ("grey", GREY) };
        let material = self.add_material(name.into(), MaterialKind::Diffuse { reflectance }, place.clone());
        self.default_materials[usize::from(emits)] = Some(material);
        material
    }

    fn two_sided(&mut self, object: &Object<'_>) -> Result<Result<MaterialId, MaterialKind>, SceneError> {
        let (front, back) = match object.nested("bsdf")?[..] {
            [(both, _)] => {
                let both = self.material(both)?;
                (both, both)
            }
            [(front, _), (back, _)] => (self.material(front)?, self.material(back)?),
            ref sides => {
                let problem = format!("{} bsdfs inside", sides.len());
                return Err(object.error(problem, "nest one bsdf for both sides, or one for each"));
            }
        };
        if let Some(glass) =
            [front, back].into_iter().find(|&id| self.scene.any_material(id, MaterialKind::transmits))
        {
            self.warn(
                object.id,
                "a bsdf that lets light through has two sides by itself: twosided is left out",
            );
            return Ok(Ok(glass));
        }
        let side = |id: MaterialId, behind: bool| match self.scene.materials[id.0 as usize].kind {
            MaterialKind::TwoSided { back, .. } if behind => back,
            MaterialKind::TwoSided { front, .. } => front,
            _ => id,
        };
        Ok(Err(MaterialKind::TwoSided { front: side(front, false), back: side(back, front == back) }))
    }

    fn model(&mut self, object: &Object<'_>, kind: &str) -> Result<MaterialKind, SceneError> {
        // how to draw directions, or how Mitsuba weighs lobes: no matter of the picture
        object.without_effect(&["sample_visible", "specular_sampling_weight", "fast_float"]);
        Ok(match kind {
            "diffuse" => {
                let mut reflectance = self.color(object, "reflectance", Quantity::Reflectance, GREY)?;
                if object.element.is_old {
                    reflectance =
                        self.color(object, "diffuse_reflectance", Quantity::Reflectance, reflectance)?;
                }
                MaterialKind::Diffuse { reflectance }
            }
            "conductor" => MaterialKind::Conductor {
                ior: self.conductor_ior(object)?,
                specular_reflectance: self.tint(object, "specular_reflectance")?,
            },
            "roughconductor" => {
                let distribution = self.distribution(object)?;
                let alpha = self.alpha(object, "alpha", Scalar::Constant(0.1))?;
                MaterialKind::RoughConductor {
                    distribution,
                    alpha_u: self.alpha(object, "alpha_u", alpha)?,
                    alpha_v: self.alpha(object, "alpha_v", alpha)?,
                    ior: self.conductor_ior(object)?,
                    specular_reflectance: self.tint(object, "specular_reflectance")?,
                }
            }
            "dielectric" => MaterialKind::Dielectric {
                int_ior: ior(object, "int_ior", 1.5046)?,
                ext_ior: ior(object, "ext_ior", 1.000277)?,
                specular_reflectance: self.tint(object, "specular_reflectance")?,
                specular_transmittance: self.tint(object, "specular_transmittance")?,
            },
            "plastic" => MaterialKind::Plastic {
                int_ior: ior(object, "int_ior", 1.49)?,
                ext_ior: ior(object, "ext_ior", 1.000277)?,
                diffuse_reflectance: self.color(
                    object,
                    "diffuse_reflectance",
                    Quantity::Reflectance,
                    GREY,
                )?,
                specular_reflectance: self.tint(object, "specular_reflectance")?,
                nonlinear: object.boolean("nonlinear", false)?,
            },
            "roughdielectric" => {
                let distribution = self.distribution(object)?;
                let alpha = self.alpha(object, "alpha", Scalar::Constant(0.1))?;
                MaterialKind::RoughDielectric {
                    distribution,
                    alpha_u: self.alpha(object, "alpha_u", alpha)?,
                    alpha_v: self.alpha(object, "alpha_v", alpha)?,
                    int_ior: ior(object, "int_ior", 1.5046)?,
                    ext_ior: ior(object, "ext_ior", 1.000277)?,
                    specular_reflectance: self.tint(object, "specular_reflectance")?,
                    specular_transmittance: self.tint(object, "specular_transmittance")?,
                }
            }
            "thindielectric" => MaterialKind::ThinDielectric {
                int_ior: ior(object, "int_ior", 1.5046)?,
                ext_ior: ior(object, "ext_ior", 1.000277)?,
                specular_reflectance: self.tint(object, "specular_reflectance")?,
                specular_transmittance: self.tint(object, "specular_transmittance")?,
            },
            "roughdiffuse" | "phong" | "ward" => self.old_model(object, kind)?,
            "principled" => MaterialKind::Principled(self.principled(object)?),
            "principledthin" => MaterialKind::PrincipledThin(self.principled_thin(object)?),
            _ => MaterialKind::RoughPlastic {
                distribution: self.distribution(object)?,
                alpha: width(object, "alpha")?,
                int_ior: ior(object, "int_ior", 1.49)?,
                ext_ior: ior(object, "ext_ior", 1.000277)?,
                diffuse_reflectance: self.color(
                    object,
                    "diffuse_reflectance",
                    Quantity::Reflectance,
                    GREY,
                )?,
                specular_reflectance: self.tint(object, "specular_reflectance")?,
                nonlinear: object.boolean("nonlinear", false)?,
            },
        })
    }

    /// Models that only Mitsuba 0.x has, with its defaults.
    fn old_model(&mut self, object: &Object<'_>, kind: &str) -> Result<MaterialKind, SceneError> {
        if kind == "roughdiffuse" {
            let reflectance = self.color(object, "diffuse_reflectance", Quantity::Reflectance, GREY)?;
            return Ok(MaterialKind::RoughDiffuse {
                reflectance: self.color(object, "reflectance", Quantity::Reflectance, reflectance)?,
                alpha: self.alpha(object, "alpha", Scalar::Constant(0.2))?,
                fast_approx: object.boolean("use_fast_approx", false)?,
            });
        }
        let diffuse_reflectance = self.color(object, "diffuse_reflectance", Quantity::Reflectance, GREY)?;
        let dim = Color::Constant([0.2; 3]);
        let specular_reflectance = self.color(object, "specular_reflectance", Quantity::Reflectance, dim)?;
        if let (Color::Constant(diffuse), Color::Constant(specular)) =
            (diffuse_reflectance, specular_reflectance)
        {
            let most = (0..3).map(|i| diffuse[i] + specular[i]).fold(0.0, f32::max);
            if most > 1.0 {
                let message = format!(
                    "diffuse_reflectance and specular_reflectance add up to {most}, and are scaled together to 1"
                );
                self.warn(object.id, message);
            }
        }
        if kind == "phong" {
            let (wanted, accept) = ("at least 0 and at most 1e8", |n| (0.0..=1e8).contains(&n));
            let exponent = self.scalar(object, "exponent", 30.0, wanted, accept)?;
            return Ok(MaterialKind::Phong { exponent, diffuse_reflectance, specular_reflectance });
        }
        let variants = [
            ("balanced", WardVariant::Balanced),
            ("ward-duer", WardVariant::WardDuer),
            ("ward", WardVariant::Ward),
        ];
        let alpha = self.alpha(object, "alpha", Scalar::Constant(0.1))?;
        Ok(MaterialKind::Ward {
            variant: object.choice("variant", &variants)?,
            alpha_u: self.alpha(object, "alpha_u", alpha)?,
            alpha_v: self.alpha(object, "alpha_v", alpha)?,
            diffuse_reflectance,
            specular_reflectance,
        })
    }

    /// A factor on a reflection or transmission, 1 where the file says nothing.
    fn tint(&mut self, object: &Object<'_>, key: &'static str) -> Result<Color, SceneError> {
        self.color(object, key, Quantity::Reflectance, WHITE)
    }

    /// A microfacet width.
    fn alpha(
        &mut self,
        object: &Object<'_>,
        key: &'static str,
        default: Scalar,
    ) -> Result<Scalar, SceneError> {
        if object.find(key).is_none() {
            return Ok(default);
        }
        self.scalar(object, key, 0.0, WIDTH, is_width)
    }

    pub(super) fn distribution(&mut self, object: &Object<'_>) -> Result<Distribution, SceneError> {
        let words = [
            ("beckmann", Some(Distribution::Beckmann)),
            ("ggx", Some(Distribution::Ggx)),
            ("phong", None),
            ("as", None),
        ];
        Ok(object.choice("distribution", &words)?.unwrap_or_else(|| {
            self.warn(object.id, "distributions of 0.x are not read; beckmann of the same alpha stands in");
            Distribution::Beckmann
        }))
    }

    /// `material`, or `eta` and `k`; `None` for the perfect mirror.
    fn conductor_ior(&mut self, object: &Object<'_>) -> Result<Option<ConductorIor>, SceneError> {
        let constant = |[eta, k]: [Rgb; 2]| ConductorIor { eta: Color::Constant(eta), k: Color::Constant(k) };
        let named = object.string("material")?;
        let mut ior = match named {
            Some((name, parameter)) => match name.trim() {
                none if none.eq_ignore_ascii_case("none") => None,
                name => {
                    let metal = spectrum::metal(name).ok_or_else(|| {
                        let known = spectrum::metal_names().chain(["none"]);
                        let help = suggest(name, "metals", known);
                        object.value_error(parameter, format!("unknown metal \"{}\"", shorten(name)), help)
                    })?;
                    Some(constant(metal))
                }
            },
            None => {
                let given = object.find("eta").is_some() || object.find("k").is_some();
                if given {
                    let eta = self.color(object, "eta", Quantity::Ratio, Color::Constant([0.0; 3]))?;
                    let k = self.color(object, "k", Quantity::Ratio, WHITE)?;
                    Some(ConductorIor { eta, k })
                } else if object.element.is_old {
                    spectrum::metal("Cu").map(constant) // 0.x had no perfect mirror but "none"
                } else {
                    None
                }
            }
        };
        if object.find("ext_eta").is_some() {
            let outside = super::bsdfs::ior(object, "ext_eta", 1.0)?;
            if let Some(ior) = &mut ior {
                for part in [&mut ior.eta, &mut ior.k] {
                    match part {
                        Color::Constant(value) => *value = value.map(|v| v / outside),
                        Color::Texture(_) => {
                            self.warn(object.id, "ext_eta does not count for textured eta and k")
                        }
                    }
                }
            }
        }
        Ok(ior)
    }
}

/// What a microfacet width must be, in words and as a test. Zero is a smooth surface, which renderers may treat as such.
const WIDTH: &str = "at least 0 and at most 10";
fn is_width(alpha: f64) -> bool {
    (0.0..=10.0).contains(&alpha)
}

pub(super) fn width(object: &Object<'_>, key: &'static str) -> Result<f32, SceneError> {
    Ok(object.float_where(key, 0.1, WIDTH, is_width)? as f32)
}

/// An index of refraction: a number, or the name of a substance.
pub(super) fn ior(object: &Object<'_>, key: &'static str, default: f64) -> Result<f32, SceneError> {
    let value = match object.find(key) {
        Some((_, parameter)) if parameter.tag == "string" => {
            let name = parameter.attribute("value").unwrap_or_default().trim();
            let known = NAMED_IORS.iter().find(|(known, _)| known.eq_ignore_ascii_case(name));
            known.map(|(_, ior)| *ior).ok_or_else(|| {
                let help = suggest(name, "substances", NAMED_IORS.iter().map(|(name, _)| *name));
                object.value_error(parameter, format!("unknown substance \"{}\"", shorten(name)), help)
            })?
        }
        _ => object.float_where(key, default, "above 0 and at most 1000", |v| v > 1e-3 && v <= 1e3)?,
    };
    Ok(value as f32)
}
