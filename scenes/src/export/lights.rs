//! `<emitter>`s that are not the surface of a shape.

use super::{ExportError, Writer};
use crate::{Color, Light, LightKind};

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
            LightKind::Point { position, intensity } => {
                self.xml.open("emitter", &[("type", "point"), ("id", &id)]);
                self.xml.point("position", *position);
                self.xml.rgb("intensity", *intensity);
            }
            LightKind::Spot { world_from_light, intensity, cutoff_deg, beam_deg, texture } => {
                self.xml.open("emitter", &[("type", "spot"), ("id", &id)]);
                // Mitsuba takes a picture there, and no colour.
                let factor = if let Color::Constant(color) = texture { *color } else { [1.0; 3] };
                self.xml.rgb("intensity", std::array::from_fn(|c| intensity[c] * factor[c]));
                if let Color::Texture(texture) = texture {
                    self.texture("texture", *texture)?;
                }
                self.xml.float("cutoff_angle", *cutoff_deg);
                self.xml.float("beam_width", *beam_deg);
                self.xml.transform("to_world", *world_from_light);
            }
            LightKind::Directional { direction, irradiance } => {
                self.xml.open("emitter", &[("type", "directional"), ("id", &id)]);
                self.xml.vector("direction", *direction);
                self.xml.rgb("irradiance", *irradiance);
            }
            LightKind::Sun { direction, half_deg, radiance } => {
                self.notes.push(format!(
                    "emitter \"{}\": Mitsuba has no disk of light alone; a directional emitter stands in, whose shadows are \
                     sharp",
                    light.name
                ));
                let projected = std::f64::consts::PI * half_deg.to_radians().sin().powi(2);
                self.xml.open("emitter", &[("type", "directional"), ("id", &id)]);
                self.xml.vector("direction", -*direction);
                self.xml.rgb("irradiance", radiance.map(|l| (f64::from(l) * projected) as f32));
            }
            LightKind::Projector { world_from_light, irradiance, scale, half_size } => {
                self.xml.open("emitter", &[("type", "projector"), ("id", &id)]);
                self.color("irradiance", *irradiance)?;
                self.xml.float("scale", *scale);
                // The height follows from the picture's.
                self.xml.float("fov", 2.0 * half_size[0].atan().to_degrees());
                self.xml.transform("to_world", *world_from_light);
            }
        }
        self.xml.close("emitter");
        Ok(())
    }
}
