//! A picture thrown through a pinhole.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};
use limpid_scenes::Color;

use super::delta::{Arriving, Place, scaled};
use super::mean_luminance;
use crate::color::Rgb;
use crate::texture::Textures;

/// The reverse of a perspective camera, with the units of Mitsuba 3.9: a plane across the axis at the distance z has the
/// irradiance
///
/// ```text
/// E = π · scale · texture(u, v) / z²        u = ½ − x / (2 z half.x),  v = ½ − y / (2 z half.y)
/// ```
///
/// whatever the angle θ to the axis, so that a white picture is evenly bright on a screen: the intensity has the factor
/// cos⁻³ θ.
pub struct Projector {
    pub place: Place,
    pub irradiance: Color,
    pub scale: f32,
    /// Half of the picture's width and height at z = 1.
    pub half_size: DVec2,
}

impl Projector {
    pub fn at(&self, p: DVec3, textures: &Textures) -> Option<Arriving> {
        let local = self.place.local(p);
        let uv = 0.5 - 0.5 * local.truncate() / (local.z * self.half_size);
        let inside = (0.0..=1.0).contains(&uv.x) && (0.0..=1.0).contains(&uv.y);
        if !inside || local.z <= 0.0 {
            return None;
        }
        let to = self.place.position - p;
        let wi = to.try_normalize()?;
        let texture: Rgb = textures.color(self.irradiance, uv.as_vec2());
        let cos = -self.place.axis.dot(wi);
        Some(Arriving {
            wi,
            distance: to.length(),
            irradiance: scaled(texture, PI * f64::from(self.scale) / (local.z * local.z * cos)),
        })
    }

    /// The irradiance of the picture at z = 1, times its area.
    pub fn power(&self, textures: &Textures) -> f64 {
        let area = 4.0 * self.half_size.x * self.half_size.y;
        PI * f64::from(self.scale) * mean_luminance(self.irradiance, textures) * area
    }
}
