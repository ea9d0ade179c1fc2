//! A point that shines into a cone.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DVec3, Vec2};
use limpid_scenes::Color;

use super::delta::{Arriving, Place, scaled};
use super::mean_luminance;
use crate::color::{Rgb, luminance};
use crate::texture::Textures;

/// A spot light with the falloff of Mitsuba 3, linear in the angle θ to the axis:
///
/// ```text
/// I(θ) = intensity · texture · { 1                                      θ ≤ beam
///                              { (cutoff − θ) / (cutoff − beam)         beam < θ < cutoff
///                              { 0                                      else
/// ```
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
    pub texture: Color,
}

impl Spot {
    pub fn at(&self, p: DVec3, textures: &Textures) -> Option<Arriving> {
        let local = self.place.local(p);
        let falloff = self.falloff(local.x.hypot(local.y).atan2(local.z));
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

    /// π (2 − cos beam − cos cutoff) · intensity · mean texture, right for narrow transitions.
    pub fn power(&self, textures: &Textures) -> f64 {
        let solid = PI * (2.0 - self.beam.cos() - self.cutoff.cos());
        solid * f64::from(luminance(self.intensity)) * mean_luminance(self.texture, textures)
    }

    fn falloff(&self, theta: f64) -> f64 {
        if theta <= self.beam {
            1.0
        } else if theta < self.cutoff {
            (self.cutoff - theta) / (self.cutoff - self.beam)
        } else {
            0.0 // NaN, too
        }
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
