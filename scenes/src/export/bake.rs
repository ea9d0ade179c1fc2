//! Channels and products of textures, worked out into one picture: Mitsuba has neither.

use std::sync::Arc;

use glam::DMat3;

use super::Writer;
use crate::spectrum::linear_from_srgb;
use crate::{Color, Image, Rgb, TexelFilter, Texels, TextureId, TextureKind, WrapMode};

/// Products of products of products: a limit that no reader reaches.
pub(super) const DEEPEST: u32 = 16;

/// A picture in linear numbers with how it is looked up.
#[derive(Clone)]
pub(super) struct Baked {
    pub image: Arc<Image>,
    pub filter: TexelFilter,
    pub wrap: WrapMode,
    pub uv_from_surface: DMat3,
}

impl Writer<'_> {
    /// The picture of a texture; `None` where it is made of what has no texels, or of pictures that do not fit on each other.
    pub(super) fn bake(&self, id: TextureId) -> Option<Baked> {
        self.baked(id, DEEPEST)
    }

    fn baked(&self, TextureId(id): TextureId, depth: u32) -> Option<Baked> {
        let texture = self.scene.textures.get(id as usize).filter(|_| depth > 0)?;
        match texture.kind {
            TextureKind::Bitmap { ref image, filter, wrap } => Some(Baked {
                image: Arc::new(linear(image)),
                filter,
                wrap,
                uv_from_surface: texture.uv_from_surface,
            }),
            TextureKind::Checkerboard { .. } | TextureKind::MeshAttribute { .. } => None,
            TextureKind::Scaled { color: Color::Texture(of), factor } => {
                Some(self.baked(of, depth - 1)?.map(|texel| std::array::from_fn(|c| texel[c] * factor[c])))
            }
            TextureKind::Scaled { color: Color::Constant(_), .. } => None,
            TextureKind::Channel { of, channel } => {
                Some(self.baked(of, depth - 1)?.map(|texel| [texel[usize::from(channel.min(2))]; 3]))
            }
            TextureKind::Product { a, b } => match (a, b) {
                (Color::Constant(factor), Color::Texture(of))
                | (Color::Texture(of), Color::Constant(factor)) => Some(
                    self.baked(of, depth - 1)?.map(|texel| std::array::from_fn(|c| texel[c] * factor[c])),
                ),
                (Color::Texture(a), Color::Texture(b)) => {
                    let (a, b) = (self.baked(a, depth - 1)?, self.baked(b, depth - 1)?);
                    let size = |baked: &Baked| (baked.image.width, baked.image.height, baked.wrap);
                    if size(&a) != size(&b) || a.uv_from_surface != b.uv_from_surface {
                        return None;
                    }
                    let factors = values(&b.image).to_vec();
                    let mut factors = factors.chunks_exact(3);
                    Some(a.map(|texel| {
                        let factor = factors.next().unwrap_or(&[1.0; 3]);
                        std::array::from_fn(|c| texel[c] * factor[c])
                    }))
                }
                (Color::Constant(_), Color::Constant(_)) => None,
            },
        }
    }
}

impl Baked {
    /// The same with other values.
    pub fn map(self, mut change: impl FnMut(Rgb) -> Rgb) -> Self {
        let texels = values(&self.image).chunks_exact(3).flat_map(|t| change([t[0], t[1], t[2]])).collect();
        let (width, height) = (self.image.width, self.image.height);
        Self { image: Arc::new(Image { width, height, texels: Texels::Linear32(texels) }), ..self }
    }
}

pub(super) fn values(image: &Image) -> &[f32] {
    match &image.texels {
        Texels::Linear32(values) => values,
        Texels::Srgb8(_) | Texels::Linear8(_) => &[],
    }
}

pub(super) fn linear(image: &Image) -> Image {
    let values = match &image.texels {
        Texels::Srgb8(bytes) => bytes.iter().map(|&b| linear_from_srgb(f32::from(b) / 255.0)).collect(),
        Texels::Linear8(bytes) => bytes.iter().map(|&b| f32::from(b) / 255.0).collect(),
        Texels::Linear32(values) => values.clone(),
    };
    Image { width: image.width, height: image.height, texels: Texels::Linear32(values) }
}
