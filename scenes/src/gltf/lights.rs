//! Lights of KHR_lights_punctual. Their candelas and luxes, and the nits of emissive surfaces, are read as they are, as
//! watts: among each other they agree.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use glam::DMat4;

use super::Reader;
use super::cameras::upright;
use super::json::{EXPORT_AGAIN, Item};
use crate::{Color, Light, LightKind, SceneError, SpotFalloff};

impl Reader<'_> {
    /// The light that a node's `reference` names.
    pub(super) fn light(
        &mut self,
        node: &Item<'_>,
        reference: &Item<'_>,
        world: DMat4,
    ) -> Result<(), SceneError> {
        let Some(lights) = self.document.root().extension("KHR_lights_punctual")? else {
            return Err(reference.error("light", "the file lists no lights", EXPORT_AGAIN));
        };
        let index = reference.unsigned("light")?.unwrap_or(0);
        let item = lights.nth("lights", usize::try_from(index).unwrap_or(usize::MAX))?;
        let intensity = f64::from(item.number_in("intensity", 1.0, 0.0..=f32::MAX)?);
        let color = item.numbers("color")?.unwrap_or([1.0; 3]);
        let strength = color.map(|channel| ((channel * intensity) as f32).clamp(0.0, f32::MAX));
        // Theirs shine along −z, as their cameras look.
        let Some(world_from_light) = upright(world) else {
            self.warn(&node.path, "its transform leaves the light no direction; the light is left out");
            return Ok(());
        };
        let kind = match item.string("type")? {
            Some("point") => LightKind::Point { position: world.w_axis.truncate(), intensity: strength },
            Some("directional") => {
                LightKind::Directional { direction: world_from_light.z_axis.truncate(), irradiance: strength }
            }
            Some("spot") => {
                let cone = item.object("spot")?;
                let angle = |key, default: f64| match &cone {
                    Some(cone) => Ok(cone.number(key)?.unwrap_or(default)),
                    None => Ok(default),
                };
                let outer = angle("outerConeAngle", FRAC_PI_4)?;
                if !(outer > 0.0 && outer <= FRAC_PI_2 + 1e-6) {
                    let problem = format!("an outer cone of {outer} radians");
                    return Err(item.error("spot", problem, "give an angle above 0 and at most 1.571"));
                }
                let inner = angle("innerConeAngle", 0.0)?.clamp(0.0, outer);
                LightKind::Spot {
                    world_from_light,
                    intensity: strength,
                    cutoff_deg: outer.to_degrees(),
                    beam_deg: inner.to_degrees(),
                    falloff: SpotFalloff::CosineSquared,
                    texture: Color::Constant([1.0; 3]),
                }
            }
            other => {
                let problem = format!("unknown type \"{}\"", other.unwrap_or_default());
                return Err(item.error("type", problem, "point, spot and directional are known"));
            }
        };
        let name = match item.get("name") {
            Some(_) => item.name_or("light", 0),
            None => node.name_or("light", self.scene.lights.len()),
        };
        self.scene.lights.push(Light { name, kind, place: self.place() });
        Ok(())
    }
}
