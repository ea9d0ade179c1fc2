//! A point that shines into a cone.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec3, Vec2};
use limpid_scenes::{Color, SpotFalloff};

use super::delta::{Arriving, Place, scaled};
use super::mean_luminance;
use crate::color::{Rgb, luminance};
use crate::texture::Textures;

/// A spot light: intensity · falloff · texture.
///
/// The texture is that of the plane z = 1, where it spans the square around the cone.
pub struct Spot {
    pub place: Place,
    /// Along the axis, in W·sr⁻¹.
    pub intensity: Rgb,
    /// Half angle, in radians.
    pub cutoff: f64,
    /// Half angle, at most `cutoff`.
    pub beam: f64,
    pub falloff: SpotFalloff,
    pub texture: Color,
}

impl Spot {
    pub fn at(&self, p: DVec3, textures: &Textures) -> Option<Arriving> {
        let local = self.place.local(p);
        let theta = local.x.hypot(local.y).atan2(local.z);
        let falloff = self.falloff.at(theta, self.beam, self.cutoff);
        if falloff <= 0.0 {
            return None;
        }
        let texture = match self.texture {
            Color::Constant(color) => color.into(),
            texture => textures.color(texture, self.uv(local)),
        };
        let to = self.place.position - p;
        let distance2 = to.length_squared();
        Some(Arriving {
            wi: to.try_normalize()?,
            distance: distance2.sqrt(),
            irradiance: scaled(self.intensity * texture, falloff / distance2),
        })
    }

    /// Solid angle · intensity · mean texture, right for a texture that is much alike all over.
    pub fn power(&self, textures: &Textures) -> f64 {
        let solid = self.falloff.integral(self.beam, self.cutoff);
        solid * f64::from(luminance(self.intensity)) * mean_luminance(self.texture, textures)
    }

    /// The centre where the cone has no square around it.
    fn uv(&self, local: DVec3) -> Vec2 {
        if self.cutoff >= FRAC_PI_2 || local.z <= 0.0 {
            return Vec2::splat(0.5);
        }
        let half = local.z * self.cutoff.tan();
        (0.5 + 0.5 * local.truncate() / half).as_vec2()
    }
}
