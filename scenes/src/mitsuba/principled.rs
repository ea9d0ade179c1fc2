//! `principled` and `principledthin`.

use super::Reader;
use super::object::Object;
use crate::spectrum::Quantity;
use crate::{Color, Principled, PrincipledThin, Scalar, SceneError};

/// How Mitsuba shares out its samples: no matter of the picture.
const SAMPLING_RATES: [&str; 6] = [
    "main_specular_sampling_rate",
    "clearcoat_sampling_rate",
    "diffuse_reflectance_sampling_rate",
    "specular_reflectance_sampling_rate",
    "specular_transmittance_sampling_rate",
    "diffuse_transmittance_sampling_rate",
];

const INDEX: &str = "above 0 and at most 1000";
fn is_index(eta: f64) -> bool {
    eta > 1e-3 && eta <= 1e3
}

impl Reader<'_> {
    pub(super) fn principled(&mut self, object: &Object<'_>) -> Result<Box<Principled>, SceneError> {
        object.without_effect(&SAMPLING_RATES);
        let spec_trans = self.dial(object, "spec_trans")?;
        let eta = principled_eta(object, spec_trans != Scalar::Constant(0.0))?;
        Ok(Box::new(Principled {
            base_color: self.base_color(object)?,
            roughness: self.dial_from(object, "roughness", 0.5)?,
            anisotropic: self.dial(object, "anisotropic")?,
            metallic: self.dial(object, "metallic")?,
            spec_trans,
            eta,
            spec_tint: self.dial(object, "spec_tint")?,
            sheen: self.dial(object, "sheen")?,
            sheen_tint: self.dial(object, "sheen_tint")?,
            flatness: self.dial(object, "flatness")?,
            clearcoat: self.dial(object, "clearcoat")?,
            clearcoat_gloss: self.dial(object, "clearcoat_gloss")?,
        }))
    }

    pub(super) fn principled_thin(&mut self, object: &Object<'_>) -> Result<Box<PrincipledThin>, SceneError> {
        object.without_effect(&SAMPLING_RATES);
        Ok(Box::new(PrincipledThin {
            base_color: self.base_color(object)?,
            roughness: self.dial_from(object, "roughness", 0.5)?,
            anisotropic: self.dial(object, "anisotropic")?,
            spec_trans: self.dial(object, "spec_trans")?,
            eta: self.scalar(object, "eta", 1.5, INDEX, is_index)?,
            spec_tint: self.dial(object, "spec_tint")?,
            sheen: self.dial(object, "sheen")?,
            sheen_tint: self.dial(object, "sheen_tint")?,
            flatness: self.dial(object, "flatness")?,
            diff_trans: self.scalar(object, "diff_trans", 0.0, "at least 0 and at most 2", |x| {
                (0.0..=2.0).contains(&x)
            })?,
        }))
    }

    fn base_color(&mut self, object: &Object<'_>) -> Result<Color, SceneError> {
        self.color(object, "base_color", Quantity::Reflectance, Color::Constant([0.5; 3]))
    }

    /// A number in [0, 1] or a texture; 0 where the file says nothing.
    fn dial(&mut self, object: &Object<'_>, key: &'static str) -> Result<Scalar, SceneError> {
        self.dial_from(object, key, 0.0)
    }

    fn dial_from(
        &mut self,
        object: &Object<'_>,
        key: &'static str,
        default: f64,
    ) -> Result<Scalar, SceneError> {
        self.scalar(object, key, default, "at least 0 and at most 1", |x| (0.0..=1.0).contains(&x))
    }
}

/// `eta`, or what `specular` makes of it. Where light goes through, matched indices are set apart as in Mitsuba.
fn principled_eta(object: &Object<'_>, transmits: bool) -> Result<f32, SceneError> {
    let (eta, specular) = (object.find("eta"), object.find("specular"));
    if let (Some(_), Some((_, specular))) = (eta, specular) {
        let problem = "\"eta\" and \"specular\" are both given";
        return Err(SceneError::at(
            &specular.place,
            &object.label_of(specular),
            problem,
            "keep one: each says what the index of refraction is",
        ));
    }
    if eta.is_some() {
        let eta = object.float_where("eta", 1.5, INDEX, is_index)? as f32;
        return Ok(if transmits && eta == 1.0 { 1.001 } else { eta });
    }
    let within = |x: f64| (0.0..=1.0).contains(&x);
    let specular = object.float_where("specular", 0.5, "at least 0 and at most 1", within)? as f32;
    Ok(Principled::eta_of_specular(if transmits && specular == 0.0 { 1e-3 } else { specular }))
}
