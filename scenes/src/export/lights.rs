//! `<emitter>`s that are not the surface of a shape.

use super::{ExportError, Writer};
use crate::{Light, LightKind};

impl Writer<'_> {
    pub(super) fn light(&mut self, light: &Light) -> Result<(), ExportError> {
        let id = self.id(&light.name);
        match &light.kind {
            LightKind::Constant { radiance } => {
                self.xml.open("emitter", &[("type", "constant"), ("id", &id)]);
                self.xml.rgb("radiance", *radiance);
            }
            LightKind::EnvMap { image, scale, world_from_light } => {
                let (file, _) = self.image(image)?;
                self.xml.open("emitter", &[("type", "envmap"), ("id", &id)]);
                self.xml.value("string", "filename", &file);
                self.xml.float("scale", *scale);
                self.xml.transform("to_world", *world_from_light);
            }
        }
        self.xml.close("emitter");
        Ok(())
    }
}
