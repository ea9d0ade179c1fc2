//! Lights without a surface. Those of a surface are its [`Emission`](crate::Emission).

use std::sync::Arc;

use glam::{DMat4, DVec3};

use crate::{Color, Daylight, Image, Place, Rgb};

/// A light that is not the surface of a shape.
#[derive(Clone, Debug)]
pub struct Light {
    /// The file's id, or its kind and a number.
    pub name: String,
    /// What it sends.
    pub kind: LightKind,
    /// Where it stands.
    pub place: Place,
}

/// Lights without a surface.
#[derive(Clone, Debug)]
pub enum LightKind {
    /// The same radiance from everywhere.
    Constant {
        /// W·sr⁻¹·m⁻² per channel.
        radiance: Rgb,
    },
    /// A lat-long picture at infinity, +y up in light space; its centre column is seen along +z.
    EnvMap {
        /// Row 0 at the zenith.
        image: Arc<Image>,
        /// Factor on the texels.
        scale: f32,
        /// Only its linear part counts.
        world_from_light: DMat4,
    },
    /// A point that shines into all directions alike.
    Point {
        /// In world space.
        position: DVec3,
        /// W·sr⁻¹ per channel.
        intensity: Rgb,
    },
    /// A point that shines into a cone around the +z of light space: fully within the beam, then less in proportion to the
    /// angle, to nothing at the cutoff.
    Spot {
        /// The light stands at its origin.
        world_from_light: DMat4,
        /// Along the axis, in W·sr⁻¹ per channel.
        intensity: Rgb,
        /// Half angle of the cone, in degrees, in (0, 180].
        cutoff_deg: f64,
        /// Half angle of the beam, in degrees, at most the cutoff.
        beam_deg: f64,
        /// A factor: a picture over the square around the cone, u along +x, v along +y.
        texture: Color,
    },
    /// Parallel light from infinity.
    Directional {
        /// The way it travels, unit, in world space.
        direction: DVec3,
        /// W·m⁻² per channel, on a surface across it.
        irradiance: Rgb,
    },
    /// The sky of a clear day, without its sun: black below the horizon.
    Sky {
        /// Which day.
        daylight: Daylight,
        /// Factor on its radiance.
        scale: f32,
    },
    /// The sun of a clear day: a round disk at infinity of the same radiance all over. What is below the horizon is cut off.
    Sun {
        /// Which day.
        daylight: Daylight,
        /// Half of the angle under which it is seen, in degrees, in (0, 90\].
        half_deg: f64,
        /// Factor on its radiance.
        scale: f32,
    },
    /// A picture thrown through a pinhole, as a perspective camera takes one: its upper left corner has +x, +y.
    Projector {
        /// The pinhole stands at its origin, the picture lies towards +z.
        world_from_light: DMat4,
        /// Over the picture, from the upper left corner: 1/π of the irradiance in W·m⁻² of the plane z = 1.
        irradiance: Color,
        /// A factor on it.
        scale: f32,
        /// Half of the picture's width and height at z = 1.
        half_size: [f64; 2],
    },
}

impl LightKind {
    /// Whether rays that leave the scene find it.
    pub fn is_at_infinity(&self) -> bool {
        self.is_background() || matches!(self, Self::Sun { .. })
    }

    /// Whether it surrounds the scene. A file may have one that does.
    pub fn is_background(&self) -> bool {
        match self {
            Self::Constant { .. } | Self::EnvMap { .. } | Self::Sky { .. } => true,
            Self::Sun { .. }
            | Self::Point { .. }
            | Self::Spot { .. }
            | Self::Directional { .. }
            | Self::Projector { .. } => false,
        }
    }
}
