//! Texture look-ups.

mod bitmap;
mod checkerboard;

use glam::{DMat3, DVec2, Vec2};
use limpid_scenes::{Color, Scalar, Scene, TextureId, TextureKind};

use crate::color::{Rgb, luminance};
use bitmap::Bitmap;
pub use bitmap::texel;
use checkerboard::Checkerboard;

/// All textures of a scene, ready for look-ups.
pub struct Textures {
    textures: Box<[Texture]>,
}

/// One of them.
struct Texture {
    kind: Kind,
    uv_from_surface: DMat3,
}

enum Kind {
    Bitmap(Bitmap),
    Checkerboard(Checkerboard),
}

/// Textures in textures in textures: deeper ones are black. No sane scene gets there, a cyclic one would not end.
const DEEPEST: u32 = 16;

impl Textures {
    /// Takes the scene's textures; images are shared, not copied.
    pub fn prepare(scene: &Scene) -> Self {
        let textures = scene.textures.iter().map(|texture| Texture {
            kind: match &texture.kind {
                TextureKind::Bitmap { image, filter, wrap } => {
                    Kind::Bitmap(Bitmap { image: image.clone(), filter: *filter, wrap: *wrap })
                }
                TextureKind::MeshAttribute { .. } | TextureKind::Scaled { .. } => todo!(),
                TextureKind::Checkerboard { color0, color1 } => {
                    Kind::Checkerboard(Checkerboard { colors: [*color0, *color1] })
                }
            },
            uv_from_surface: texture.uv_from_surface,
        });
        Self { textures: textures.collect() }
    }

    /// The colour at a surface's `uv`. Non-finite texels come through as they are; a non-finite `uv` counts as 0.
    #[inline]
    pub fn color(&self, color: Color, uv: Vec2) -> Rgb {
        self.color_at(color, uv.as_dvec2(), DEEPEST)
    }

    /// The number at a surface's `uv`: the luminance of a colour texture.
    #[inline]
    pub fn scalar(&self, scalar: Scalar, uv: Vec2) -> f32 {
        match scalar {
            Scalar::Constant(x) => x,
            Scalar::Texture(id) => luminance(self.look_up(id, uv.as_dvec2(), DEEPEST)),
        }
    }

    /// ∂/∂(u, v) of the number at a surface's `uv`: of what is interpolated between texels; else 0.
    pub fn gradient(&self, scalar: Scalar, uv: Vec2) -> Vec2 {
        let Scalar::Texture(id) = scalar else { return Vec2::ZERO };
        let Some(texture) = self.textures.get(id.0 as usize) else { return Vec2::ZERO };
        let m = texture.uv_from_surface;
        let Kind::Bitmap(bitmap) = &texture.kind else { return Vec2::ZERO };
        let [ds, dt] =
            bitmap.gradient((m * uv.as_dvec2().extend(1.0)).truncate()).map(luminance).map(f64::from);
        let gradient =
            DVec2::new(ds * m.x_axis.x + dt * m.x_axis.y, ds * m.y_axis.x + dt * m.y_axis.y).as_vec2();
        if gradient.is_finite() { gradient } else { Vec2::ZERO }
    }

    /// How finely a colour may vary: in texels per unit of u and of v; 0 for a constant.
    pub fn detail(&self, color: Color) -> DVec2 {
        self.detail_at(color, DEEPEST)
    }

    fn detail_at(&self, color: Color, depth: u32) -> DVec2 {
        let Color::Texture(id) = color else { return DVec2::ZERO };
        let Some(texture) = self.textures.get(id.0 as usize).filter(|_| depth > 0) else {
            return DVec2::ZERO;
        };
        let (size, inner) = match &texture.kind {
            Kind::Bitmap(bitmap) => {
                (DVec2::new(bitmap.image.width.into(), bitmap.image.height.into()), DVec2::ZERO)
            }
            Kind::Checkerboard(checkerboard) => {
                let [a, b] = checkerboard.colors.map(|color| self.detail_at(color, depth - 1));
                (DVec2::splat(2.0), a.max(b))
            }
        };
        let m = texture.uv_from_surface;
        let along = |axis: DVec2| (axis.abs() * size).max_element();
        DVec2::new(along(m.x_axis.truncate()), along(m.y_axis.truncate())).max(inner)
    }

    #[inline]
    fn color_at(&self, color: Color, uv: DVec2, depth: u32) -> Rgb {
        match color {
            Color::Constant(c) => c.into(),
            Color::Texture(id) => self.look_up(id, uv, depth),
        }
    }

    fn look_up(&self, id: TextureId, uv: DVec2, depth: u32) -> Rgb {
        let Some(texture) = self.textures.get(id.0 as usize).filter(|_| depth > 0) else {
            return Rgb::ZERO;
        };
        let uv_texture = (texture.uv_from_surface * uv.extend(1.0)).truncate();
        match &texture.kind {
            Kind::Bitmap(bitmap) => bitmap.color(uv_texture),
            // The colours have mappings of their own, from the surface's uv.
            Kind::Checkerboard(checkerboard) => self.color_at(checkerboard.color(uv_texture), uv, depth - 1),
        }
    }
}

/// x less the next lower integer, in [0, 1); 0 where x is not finite. Without `floor`, which is a call into the
/// mathematics library on plain x86-64.
#[inline]
fn fract(x: f64) -> f64 {
    // From 2^52 on all numbers are integers, and the cast below would leave its range.
    if x.abs() < (1u64 << 52) as f64 {
        let rest = x - (x as i64) as f64;
        let rest = if rest < 0.0 { rest + 1.0 } else { rest };
        // −1e−20 + 1 is 1.
        if rest < 1.0 { rest } else { 0.0 }
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests;
