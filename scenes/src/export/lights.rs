//! `<emitter>`s that are not the surface of a shape.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DMat3, DMat4, DVec3};

use super::{ExportError, Writer};
use crate::{Color, Daylight, Light, LightKind, SpotFalloff, linear_beam_deg};

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
                let turned = self.turned(light, *world_from_light);
                self.xml.transform("to_world", turned);
            }
            LightKind::Point { position, intensity } => {
                self.xml.open("emitter", &[("type", "point"), ("id", &id)]);
                self.xml.point("position", *position);
                self.xml.rgb("intensity", *intensity);
            }
            LightKind::Spot { world_from_light, intensity, cutoff_deg, beam_deg, falloff, texture } => {
                self.xml.open("emitter", &[("type", "spot"), ("id", &id)]);
                // Mitsuba takes a picture there, and no colour.
                let factor = if let Color::Constant(color) = texture { *color } else { [1.0; 3] };
                self.xml.rgb("intensity", std::array::from_fn(|c| intensity[c] * factor[c]));
                if let Color::Texture(texture) = texture {
                    self.texture("texture", *texture)?;
                }
                self.xml.float("cutoff_angle", *cutoff_deg);
                let beam_deg = match falloff {
                    SpotFalloff::Angle => *beam_deg,
                    SpotFalloff::CosineSquared => {
                        self.notes.push(format!(
                            "emitter \"{}\": Mitsuba's spot fades in proportion to the angle; one of the same power stands in",
                            light.name
                        ));
                        linear_beam_deg(*beam_deg, *cutoff_deg)
                    }
                };
                self.xml.float("beam_width", beam_deg);
                self.xml.transform("to_world", *world_from_light);
            }
            LightKind::Ies { world_from_light, intensity, profile } => {
                self.notes.push(format!(
                    "emitter \"{}\": Mitsuba has no photometric profiles; a point that shines alike into all directions, with \
                     the same power, stands in",
                    light.name
                ));
                self.xml.open("emitter", &[("type", "point"), ("id", &id)]);
                self.xml.point("position", world_from_light.w_axis.truncate());
                self.xml.rgb("intensity", intensity.map(|i| (f64::from(i) * profile.mean()) as f32));
            }
            LightKind::Directional { direction, irradiance } => {
                self.xml.open("emitter", &[("type", "directional"), ("id", &id)]);
                self.xml.vector("direction", *direction);
                self.xml.rgb("irradiance", *irradiance);
            }
            LightKind::Sky { daylight, scale } => {
                self.xml.open("emitter", &[("type", "sunsky"), ("id", &id)]);
                let sun = self.sun_of(daylight).map(|(_, half_deg, scale)| (half_deg, scale));
                self.daylight(light, daylight, *scale, sun);
            }
            LightKind::Sun { daylight, half_deg, scale } => {
                let is_first = self.sun_of(daylight).is_some_and(|(first, ..)| std::ptr::eq(first, light));
                let background = self.scene.lights.iter().find(|light| light.kind.is_background());
                match background.map(|light| &light.kind) {
                    // It is written with its sky.
                    Some(LightKind::Sky { daylight: sky, .. }) if is_first && sky == daylight => {
                        return Ok(());
                    }
                    None if self.first_at_infinity().is_some_and(|first| std::ptr::eq(first, light)) => {
                        self.xml.open("emitter", &[("type", "sunsky"), ("id", &id)]);
                        self.daylight(light, daylight, 0.0, Some((*half_deg, *scale)));
                    }
                    _ => self.directional_sun(light, &id, daylight, *half_deg, *scale),
                }
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

    /// The first light that surrounds the scene or stands at its edge.
    fn first_at_infinity(&self) -> Option<&Light> {
        self.scene.lights.iter().find(|light| light.kind.is_at_infinity())
    }

    /// The first sun of this day, with half its width and its scale.
    fn sun_of(&self, day: &Daylight) -> Option<(&Light, f64, f32)> {
        self.scene.lights.iter().find_map(|light| match light.kind {
            LightKind::Sun { daylight, half_deg, scale } if daylight == *day => {
                Some((light, half_deg, scale))
            }
            _ => None,
        })
    }

    /// The parameters of `sunsky`, whose sky has +z up.
    fn daylight(&mut self, light: &Light, day: &Daylight, sky_scale: f32, sun: Option<(f64, f32)>) {
        self.xml.vector("sun_direction", towards(day));
        self.xml.float("turbidity", day.turbidity);
        self.xml.rgb("albedo", day.albedo);
        self.xml.float("sky_scale", sky_scale);
        self.xml.float("sun_scale", sun.map_or(0.0, |(_, scale)| scale));
        if let Some((half_deg, _)) = sun {
            self.xml.float("sun_aperture", 2.0 * half_deg);
        }
        let world_from_sky = self.turned(light, day.world_from_light) * DMat4::from_rotation_x(-FRAC_PI_2);
        self.xml.transform("to_world", world_from_sky);
    }

    /// How a light that surrounds the scene is turned and mirrored, without its scale: Mitsuba does not make the directions
    /// unit that it looks up. Where the scale differs by direction, what stays is the horizon and the azimuth of +z.
    fn turned(&mut self, light: &Light, world_from_light: DMat4) -> DMat4 {
        let linear = DMat3::from_mat4(world_from_light);
        let determinant = linear.determinant();
        let up = linear.inverse().transpose().y_axis.normalize_or(DVec3::Y);
        let z = linear.z_axis.normalize_or(DVec3::Z);
        let turned = DMat3::from_cols(determinant.signum() * up.cross(z), up, z);
        if !(linear * determinant.abs().cbrt().recip()).abs_diff_eq(turned, 1e-6) {
            self.notes.push(format!(
                "emitter \"{}\": a scale that differs by direction is left out of \"to_world\": its rotation is kept",
                light.name
            ));
        }
        DMat4::from_mat3(turned)
    }

    fn directional_sun(&mut self, light: &Light, id: &str, day: &Daylight, half_deg: f64, scale: f32) {
        self.notes.push(format!(
            "emitter \"{}\": Mitsuba has one light around a scene; for the sun beside it a directional emitter stands in, whose \
             shadows are sharp",
            light.name
        ));
        let projected = PI * half_deg.to_radians().sin().powi(2);
        self.xml.open("emitter", &[("type", "directional"), ("id", id)]);
        self.xml.vector("direction", -towards(day));
        self.xml.rgb("irradiance", day.sun(half_deg).map(|l| (f64::from(l * scale) * projected) as f32));
    }
}

/// The sun's direction in world space.
fn towards(day: &Daylight) -> DVec3 {
    (DMat3::from_mat4(day.world_from_light) * day.sun).normalize_or(DVec3::Z)
}
