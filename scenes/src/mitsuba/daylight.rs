//! `sunsky`, `sky` and `sun`: the light of a clear day.

use glam::{DMat3, DMat4, DVec3};

use super::Reader;
use super::object::Object;
use crate::daylight::{APERTURE_DEG, Moment, sun_position};
use crate::spectrum::Quantity;
use crate::{Color, Daylight, Light, LightKind, SceneError};

/// Half an angle in degrees that the sun has at least: a ray's own rounding is a hundredth of it.
const SMALLEST_SUN_DEG: f64 = 1e-3;

impl Reader<'_> {
    /// Adds the lights.
    pub(super) fn daylight(&mut self, object: &Object<'_>, kind: &str) -> Result<(), SceneError> {
        let turbidity =
            object.float_where("turbidity", 3.0, "between 1 and 10", |t| (1.0..=10.0).contains(&t))?;
        let all = scale(object, "scale")?;
        let (sun_scale, sky_scale) = (all * scale(object, "sun_scale")?, all * scale(object, "sky_scale")?);
        let half_deg = half_angle(object)?;
        let Color::Constant(albedo) =
            self.color(object, "albedo", Quantity::Reflectance, Color::Constant([0.3; 3]))?
        else {
            return Err(object.error("a texture as the albedo of the ground", "give a colour"));
        };
        // a picture of the sky is not made
        object.without_effect(&["resolution"]);
        if object.boolean("complex_sun", false)? {
            let message = format!("{kind}: a complex sun, darker at its rim, is not read; it shines evenly");
            self.warn(object.id, message);
        }

        let world_from_sky = world_from_sky(object)?;
        let linear = DMat3::from_mat4(world_from_sky);
        let sun = sun_direction(object, linear)?;
        if sun.y < 0.0 {
            self.warn(object.id, format!("{kind}: the sun is below the horizon; the light is left out"));
            return Ok(());
        }
        let name = self.name(object, kind, self.scene.lights.len());
        let daylight = Daylight { sun, turbidity, albedo, world_from_light: world_from_sky };
        let is_whole = kind == "sunsky";
        if kind != "sun" && sky_scale > 0.0 {
            let kind = LightKind::Sky { daylight, scale: sky_scale as f32 };
            self.scene.lights.push(Light { name: name.clone(), kind, place: object.place() });
        }
        if kind != "sky" && sun_scale > 0.0 {
            let half_deg = half_deg.clamp(SMALLEST_SUN_DEG, 90.0);
            let kind = LightKind::Sun { daylight, half_deg, scale: sun_scale as f32 };
            let name = if is_whole { format!("{name}.sun") } else { name };
            self.scene.lights.push(Light { name, kind, place: object.place() });
        }
        Ok(())
    }
}

fn scale(object: &Object<'_>, key: &'static str) -> Result<f64, SceneError> {
    object.float_where(key, 1.0, "at least 0 and at most 1e9", |v| (0.0..=1e9).contains(&v))
}

/// Half of the angle under which the sun is seen, in degrees: `sun_aperture`, or the `sun_radius_scale` of 0.x.
fn half_angle(object: &Object<'_>) -> Result<f64, SceneError> {
    let wanted = "at least 0 and below 180 degrees";
    let aperture = object.float_where("sun_aperture", APERTURE_DEG, wanted, |v| (0.0..180.0).contains(&v))?;
    let factor = object
        .float_where("sun_radius_scale", 1.0, "at least 0 and at most 300", |v| (0.0..=300.0).contains(&v))?;
    Ok(0.5 * aperture * factor)
}

/// From a sky with +y up: files of version 0.x have that, others +z.
fn world_from_sky(object: &Object<'_>) -> Result<DMat4, SceneError> {
    let to_world = super::emitters::frame(object)?;
    let local = if object.element.is_old {
        DMat4::IDENTITY
    } else {
        DMat4::from_rotation_x(std::f64::consts::FRAC_PI_2)
    };
    Ok(to_world * local)
}

/// Towards the sun, in a sky with +y up: the `sun_direction` of the world, or what place and time say.
fn sun_direction(object: &Object<'_>, world_from_sky: DMat3) -> Result<DVec3, SceneError> {
    if object.find("sun_direction").is_some() {
        let given = world_from_sky.inverse() * object.vector("sun_direction", DVec3::ZERO)?;
        return given.try_normalize().ok_or_else(|| {
            object.error("the sun's direction has no length", "name a direction, such as z=\"1\"")
        });
    }
    let default = Moment::default();
    let whole = |key, default: i64, low: f64, high: f64| {
        let wanted = format!("between {low} and {high}");
        object.float_where(key, default as f64, &wanted, |v| (low..=high).contains(&v)).map(|v| v as i64)
    };
    let part =
        |key, default: f64| object.float_where(key, default, "between -1000 and 1000", |v| v.abs() <= 1000.0);
    let moment = Moment {
        latitude_deg: part("latitude", default.latitude_deg)?,
        longitude_deg: part("longitude", default.longitude_deg)?,
        timezone: part("timezone", default.timezone)?,
        date: [
            whole("year", default.date[0], 1.0, 9999.0)?,
            whole("month", default.date[1], 1.0, 12.0)?,
            whole("day", default.date[2], 1.0, 31.0)?,
        ],
        hours: part("hour", default.hours)? + (part("minute", 0.0)? + part("second", 0.0)? / 60.0) / 60.0,
    };
    let [zenith, azimuth] = sun_position(&moment);
    let (north, east) = (azimuth.cos() * zenith.sin(), azimuth.sin() * zenith.sin());
    // with +z up, +x is south and +y west, so that +z of a sky with +y up is east; in 0.x +x is east and +z south
    Ok(if object.element.is_old {
        DVec3::new(east, zenith.cos(), -north)
    } else {
        DVec3::new(-north, zenith.cos(), east)
    })
}
