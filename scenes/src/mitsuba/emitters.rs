//! `<emitter>`: light from surfaces and from far away.

use super::Reader;
use super::camera::is_invertible;
use super::document::ElementId;
use super::object::Object;
use super::survey::{EMITTERS, Standing};
use crate::spectrum::Quantity;
use crate::{Color, Emission, Light, LightKind, SceneError};

impl Reader<'_> {
    /// What an emitter that stands in a shape makes the shape emit; `None` where it is left out.
    pub(super) fn emission(&mut self, id: ElementId) -> Result<Option<Emission>, SceneError> {
        let object = Object::new(self.document, id);
        let kind = object.kind()?;
        if EMITTERS.standing(kind, object.element)? == Standing::Later || kind != "area" {
            self.warn(id, format!("{kind}: not read on a shape; left out"));
            return Ok(None);
        }
        object.without_effect(&["sampling_weight", "samples"]);
        let radiance = self.color(&object, "radiance", Quantity::Radiance, Color::Constant([1.0; 3]))?;
        let name = object.element.attribute("id").map(String::from);
        let place = object.place();
        object.finish(&mut self.warnings);
        Ok(Some(Emission { name, radiance, place }))
    }

    /// Reads an emitter that stands in the scene itself.
    pub(super) fn emitter(&mut self, id: ElementId, has_background: bool) -> Result<(), SceneError> {
        let object = Object::new(self.document, id);
        let kind = object.kind()?;
        if EMITTERS.standing(kind, object.element)? == Standing::Later {
            self.warn(id, format!("{kind} is not read yet; the light is left out"));
            return Ok(());
        }
        object.without_effect(&["sampling_weight", "samples"]);
        let light = match kind {
            "area" => {
                self.warn(id, "area: no shape holds it or refers to it; the light is left out");
                return Ok(());
            }
            _ if has_background => {
                self.warn(id, format!("{kind}: a second background is left out: a scene has one"));
                return Ok(());
            }
            "constant" => {
                let white = Color::Constant([1.0; 3]);
                let radiance = match self.color(&object, "radiance", Quantity::Radiance, white)? {
                    Color::Constant(radiance) => radiance,
                    Color::Texture(_) => {
                        let help = "give a colour; for a picture all around use the emitter \"envmap\"";
                        return Err(object.error("a texture as the radiance of \"constant\"", help));
                    }
                };
                LightKind::Constant { radiance }
            }
            _ => self.envmap(&object)?,
        };
        let name = self.name(&object, kind, self.scene.lights.len());
        self.scene.lights.push(Light { name, kind: light, place: object.place() });
        object.finish(&mut self.warnings);
        Ok(())
    }

    fn envmap(&mut self, object: &Object<'_>) -> Result<LightKind, SceneError> {
        let path = self.file(object)?;
        let scale = object.float_where("scale", 1.0, "at least 0 and in the range of 32 bits", |v| {
            v >= 0.0 && (v as f32).is_finite()
        })? as f32;
        let world_from_light = object.transform("to_world")?;
        if !is_invertible(world_from_light) {
            return Err(object.error("to_world flattens space", "use scales other than 0"));
        }
        object.without_effect(&["mis_compensation", "gamma", "cache"]);
        let image = self.image(&path, false, object)?;
        Ok(LightKind::EnvMap { image, scale, world_from_light })
    }
}
