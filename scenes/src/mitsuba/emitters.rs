//! `<emitter>`: light from surfaces, from points and from far away.

use std::sync::Arc;

use glam::{DMat3, DMat4, DVec3};

use super::Reader;
use super::camera::is_invertible;
use super::document::ElementId;
use super::object::Object;
use super::survey::EMITTERS;
use crate::ies;
use crate::spectrum::Quantity;
use crate::{Color, Emission, Light, LightKind, Rgb, SceneError, SpotFalloff, TextureKind};

const WHITE: Color = Color::Constant([1.0; 3]);

/// Parameters that choose how to sample, not what.
const WITHOUT_EFFECT: [&str; 2] = ["sampling_weight", "samples"];

impl Reader<'_> {
    /// What an emitter that stands in a shape makes the shape emit; `None` where it is left out.
    pub(super) fn emission(&mut self, id: ElementId) -> Result<Option<Emission>, SceneError> {
        let object = Object::new(self.document, id);
        let kind = object.kind()?;
        EMITTERS.standing(kind, object.element)?;
        if kind != "area" {
            self.warn(id, format!("{kind}: not read on a shape; left out"));
            return Ok(None);
        }
        object.without_effect(&WITHOUT_EFFECT);
        let radiance = self.color(&object, "radiance", Quantity::Radiance, WHITE)?;
        let name = object.element.attribute("id").map(String::from);
        let place = object.place();
        object.finish(&mut self.warnings);
        Ok(Some(Emission { name, radiance, place }))
    }

    /// Reads an emitter that stands in the scene itself.
    pub(super) fn emitter(&mut self, id: ElementId) -> Result<(), SceneError> {
        let object = Object::new(self.document, id);
        let kind = object.kind()?;
        EMITTERS.standing(kind, object.element)?;
        object.without_effect(&WITHOUT_EFFECT);
        let light = match kind {
            "area" => {
                self.warn(id, "area: no shape holds it or refers to it; the light is left out");
                return Ok(());
            }
            "constant" | "envmap" | "sky" | "sunsky"
                if self.scene.lights.iter().any(|light| light.kind.is_background()) =>
            {
                self.warn(id, format!("{kind}: a second background is left out: a scene has one"));
                return Ok(());
            }
            "constant" => {
                let help = "give a colour; for a picture all around use the emitter \"envmap\"";
                LightKind::Constant { radiance: self.light_color(&object, "radiance", help)? }
            }
            "envmap" => self.envmap(&object)?,
            "point" => {
                let help = "give a colour; for a picture use the emitter \"projector\"";
                let position = match object.find("position") {
                    Some(_) => object.vector("position", DVec3::ZERO)?,
                    None => object.transform("to_world")?.w_axis.truncate(),
                };
                LightKind::Point { position, intensity: self.light_color(&object, "intensity", help)? }
            }
            "sunsky" | "sun" | "sky" => {
                self.daylight(&object, kind)?;
                object.finish(&mut self.warnings);
                return Ok(());
            }
            "spot" => self.spot(&object)?,
            "ies" => self.ies(&object)?,
            "directional" => {
                let help = "give a colour; for a picture use the emitter \"projector\"";
                LightKind::Directional {
                    direction: direction(&object)?,
                    irradiance: self.light_color(&object, "irradiance", help)?,
                }
            }
            _ => self.projector(&object)?,
        };
        let name = self.name(&object, kind, self.scene.lights.len());
        self.scene.lights.push(Light { name, kind: light, place: object.place() });
        object.finish(&mut self.warnings);
        Ok(())
    }

    /// What a light sends, which must not be a texture.
    fn light_color(&mut self, object: &Object<'_>, key: &'static str, help: &str) -> Result<Rgb, SceneError> {
        match self.color(object, key, Quantity::Radiance, WHITE)? {
            Color::Constant(color) => Ok(color),
            Color::Texture(_) => {
                let kind = object.kind()?;
                Err(object.error(format!("a texture as the {key} of \"{kind}\""), help))
            }
        }
    }

    fn envmap(&mut self, object: &Object<'_>) -> Result<LightKind, SceneError> {
        let path = self.file(object)?;
        let scale = scale(object)?;
        let world_from_light = frame(object)?;
        object.without_effect(&["mis_compensation", "gamma", "cache"]);
        let image = self.image(&path, false, object)?;
        Ok(LightKind::EnvMap { image, scale, world_from_light })
    }

    fn spot(&mut self, object: &Object<'_>) -> Result<LightKind, SceneError> {
        let is_angle = |angle: f64| angle > 0.0 && angle <= 180.0;
        let cutoff_deg =
            object.float_where("cutoff_angle", 20.0, "above 0 and at most 180 degrees", is_angle)?;
        let given = object
            .float_where("beam_width", 0.75 * cutoff_deg, "at least 0 degrees", |angle| angle >= 0.0)?;
        let beam_deg = given.min(cutoff_deg);
        if beam_deg < given {
            self.warn(
                object.id,
                format!("the beam of {given} degrees ends where the light does, at {cutoff_deg}"),
            );
        }
        let help = "give a colour; a picture goes into \"texture\"";
        let intensity = self.light_color(object, "intensity", help)?;
        let texture = self.color(object, "texture", Quantity::Ratio, WHITE)?;
        let world_from_light = frame(object)?;
        let falloff = SpotFalloff::Angle;
        Ok(LightKind::Spot { world_from_light, intensity, cutoff_deg, beam_deg, falloff, texture })
    }

    /// The point light of a photometric file, which old files call its `path`.
    fn ies(&mut self, object: &Object<'_>) -> Result<LightKind, SceneError> {
        let named = match object.string("filename")? {
            Some(named) => Some(named),
            None => object.string("path")?,
        };
        let Some((name, parameter)) = named else {
            let help = "name an IES file: <string name=\"filename\" value=\"…\"/>";
            return Err(object.error("no \"filename\"", help));
        };
        let label = object.element.label();
        let path = self.find(name, parameter, &label)?;
        let bytes = self.bytes(&path, &parameter.place_of("value"), &label)?;
        let profile = ies::parse(&bytes).map_err(|error| SceneError {
            file: path,
            line: error.line,
            column: 1,
            element: label,
            problem: error.problem,
            help: error.help.into(),
        })?;
        let intensity =
            self.light_color(object, "intensity", "give a colour; the profile goes into \"filename\"")?;
        Ok(LightKind::Ies { world_from_light: frame(object)?, intensity, profile: Arc::new(profile) })
    }

    /// Width and height of the picture behind a colour; what has no pixels is square.
    fn pixels(&self, color: Color) -> [u32; 2] {
        let Color::Texture(id) = color else { return [1, 1] };
        match &self.scene.textures[id.0 as usize].kind {
            TextureKind::Bitmap { image, .. } => [image.width, image.height],
            TextureKind::Scaled { color, .. } => self.pixels(*color),
            TextureKind::Checkerboard { .. }
            | TextureKind::MeshAttribute { .. }
            | TextureKind::Channel { .. }
            | TextureKind::Product { .. } => [1, 1],
        }
    }

    fn projector(&mut self, object: &Object<'_>) -> Result<LightKind, SceneError> {
        let (fov_deg, fov_axis) = super::camera::field_of_view(object)?;
        let irradiance = self.color(object, "irradiance", Quantity::Radiance, WHITE)?;
        let [width, height] = self.pixels(irradiance);
        Ok(LightKind::Projector {
            world_from_light: frame(object)?,
            irradiance,
            scale: scale(object)?,
            half_size: fov_axis.half_size(fov_deg, width.into(), height.into()),
        })
    }
}

fn scale(object: &Object<'_>) -> Result<f32, SceneError> {
    let wanted = "at least 0 and in the range of 32 bits";
    Ok(object.float_where("scale", 1.0, wanted, |v| v >= 0.0 && (v as f32).is_finite())? as f32)
}

/// `to_world`, which must keep volumes.
pub(super) fn frame(object: &Object<'_>) -> Result<DMat4, SceneError> {
    let world_from_light = object.transform("to_world")?;
    if is_invertible(world_from_light) {
        Ok(world_from_light)
    } else {
        Err(object.error("to_world flattens space", "use scales other than 0"))
    }
}

/// The way that a directional light travels: `direction`, else the +z of `to_world`.
fn direction(object: &Object<'_>) -> Result<DVec3, SceneError> {
    let given = match object.find("direction") {
        Some(_) => object.vector("direction", DVec3::Z)?,
        None => DMat3::from_mat4(object.transform("to_world")?) * DVec3::Z,
    };
    given.try_normalize().ok_or_else(|| {
        object.error("the light's direction has no length", "name a direction, such as z=\"-1\"")
    })
}
