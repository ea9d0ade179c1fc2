//! Texture look-ups.

mod attribute;
mod bitmap;
mod checkerboard;

use glam::{DMat3, DVec2, Vec2};
use limpid_scenes::{Color, Scalar, Scene, TextureId, TextureKind};

use crate::accel::NONE;
use crate::color::{Rgb, luminance};
use crate::geometry::Surface;
use attribute::Attribute;
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
    Attribute(Attribute),
    Scaled(Color, Rgb),
    Channel { of: TextureId, channel: usize },
    Product([Color; 2]),
}

/// Where a texture is looked up.
#[derive(Clone, Copy, Debug)]
pub struct TexturePoint {
    /// Texture coordinates of the surface.
    pub uv: Vec2,
    /// The primitive, or [`NONE`]: attributes of meshes are black there.
    pub prim: u32,
    /// Barycentric coordinates of the second and third vertex of a triangle.
    pub bary: Vec2,
}

impl From<Vec2> for TexturePoint {
    /// A point of no surface.
    #[inline]
    fn from(uv: Vec2) -> Self {
        Self { uv, prim: NONE, bary: Vec2::ZERO }
    }
}

impl From<&Surface> for TexturePoint {
    #[inline]
    fn from(surface: &Surface) -> Self {
        Self { uv: surface.uv, prim: surface.prim, bary: surface.bary }
    }
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
                TextureKind::MeshAttribute { name, scale } => {
                    Kind::Attribute(Attribute::new(scene, name, *scale))
                }
                TextureKind::Scaled { color, factor } => Kind::Scaled(*color, (*factor).into()),
                TextureKind::Checkerboard { color0, color1 } => {
                    Kind::Checkerboard(Checkerboard { colors: [*color0, *color1] })
                }
                TextureKind::Channel { of, channel } => {
                    Kind::Channel { of: *of, channel: usize::from((*channel).min(2)) }
                }
                TextureKind::Product { a, b } => Kind::Product([*a, *b]),
            },
            uv_from_surface: texture.uv_from_surface,
        });
        Self { textures: textures.collect() }
    }

    /// The colour at a point. Non-finite texels come through as they are; a non-finite `uv` counts as 0.
    #[inline]
    pub fn color(&self, color: Color, at: impl Into<TexturePoint>) -> Rgb {
        self.color_at(color, &at.into(), DEEPEST)
    }

    /// The number at a point: the luminance of a colour texture.
    #[inline]
    pub fn scalar(&self, scalar: Scalar, at: impl Into<TexturePoint>) -> f32 {
        match scalar {
            Scalar::Constant(x) => x,
            Scalar::Texture(id) => luminance(self.look_up(id, &at.into(), DEEPEST)),
        }
    }

    /// ∂/∂(u, v) of the number at a surface's `uv`: of what is interpolated between texels; else 0.
    pub fn gradient(&self, scalar: Scalar, uv: Vec2) -> Vec2 {
        let Scalar::Texture(mut id) = scalar else { return Vec2::ZERO };
        let mut scale = Rgb::ONE;
        for _ in 0..DEEPEST {
            match self.textures.get(id.0 as usize).map(|texture| &texture.kind) {
                Some(Kind::Scaled(Color::Texture(inner), factor)) => (id, scale) = (*inner, scale * *factor),
                _ => break,
            }
        }
        let Some(texture) = self.textures.get(id.0 as usize) else { return Vec2::ZERO };
        let m = texture.uv_from_surface;
        let Kind::Bitmap(bitmap) = &texture.kind else { return Vec2::ZERO };
        let [ds, dt] = bitmap
            .gradient((m * uv.as_dvec2().extend(1.0)).truncate())
            .map(|slope| f64::from(luminance(slope * scale)));
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
            Kind::Attribute(_) => return DVec2::ZERO,
            Kind::Scaled(color, _) => return self.detail_at(*color, depth - 1),
            Kind::Channel { of, .. } => return self.detail_at(Color::Texture(*of), depth - 1),
            Kind::Product([a, b]) => {
                return self.detail_at(*a, depth - 1).max(self.detail_at(*b, depth - 1));
            }
        };
        let m = texture.uv_from_surface;
        let along = |axis: DVec2| (axis.abs() * size).max_element();
        DVec2::new(along(m.x_axis.truncate()), along(m.y_axis.truncate())).max(inner)
    }

    #[inline]
    fn color_at(&self, color: Color, at: &TexturePoint, depth: u32) -> Rgb {
        match color {
            Color::Constant(c) => c.into(),
            Color::Texture(id) => self.look_up(id, at, depth),
        }
    }

    fn look_up(&self, id: TextureId, at: &TexturePoint, depth: u32) -> Rgb {
        let Some(texture) = self.textures.get(id.0 as usize).filter(|_| depth > 0) else {
            return Rgb::ZERO;
        };
        let uv_texture = (texture.uv_from_surface * at.uv.as_dvec2().extend(1.0)).truncate();
        match &texture.kind {
            Kind::Bitmap(bitmap) => bitmap.color(uv_texture),
            // The colours have mappings of their own, from the surface's uv.
            Kind::Checkerboard(checkerboard) => self.color_at(checkerboard.color(uv_texture), at, depth - 1),
            Kind::Attribute(attribute) => attribute.color(at),
            Kind::Scaled(color, factor) => self.color_at(*color, at, depth - 1) * *factor,
            Kind::Channel { of, channel } => Rgb::splat(self.look_up(*of, at, depth - 1)[*channel]),
            Kind::Product([a, b]) => self.color_at(*a, at, depth - 1) * self.color_at(*b, at, depth - 1),
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
