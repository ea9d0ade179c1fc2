//! Textures: a picture with its sampler, transformed; channels and products of them.

use glam::{DMat3, DVec3};

use super::Reader;
use super::images::Use;
use super::json::{EXPORT_AGAIN, Item};
use crate::{Color, Rgb, Scalar, SceneError, TexelFilter, Texture, TextureId, TextureKind, WrapMode};

/// What makes two textures the same: the number in the file, the mapping as bits, and the use of the picture.
pub(super) type TextureKey = (usize, [u64; 5], Use);

/// Sampler constants of OpenGL.
const NEAREST: u64 = 9728;
const CLAMP: u64 = 33071;
const MIRROR: u64 = 33648;

impl Reader<'_> {
    /// The texture that the key `key` of a material (or of an extension of one) refers to. The sets of texture
    /// coordinates that the material asks for are added to `sets`.
    pub(super) fn texture(
        &mut self,
        item: &Item<'_>,
        key: &str,
        usage: Use,
        sets: &mut Vec<u32>,
    ) -> Result<Option<TextureId>, SceneError> {
        let Some(info) = item.object(key)? else { return Ok(None) };
        let Some(index) = info.index("index", "textures")? else {
            return Err(info.error("index", "not there", EXPORT_AGAIN));
        };
        let (mapping, set) = mapping(&info)?;
        sets.push(set);
        let key = (index, mapping.map(f64::to_bits), usage);
        if let Some(&known) = self.textures.get(&key) {
            return Ok(Some(known));
        }
        let texture = self.document.entry("textures", index)?;
        let Some(source) = texture.index("source", "images")? else {
            self.warn(&texture.path, "no picture of a kind that is read; the texture is left out");
            return Ok(None);
        };
        let Some(image) = self.image(source, usage)? else { return Ok(None) };
        let [filter, wrap] = self.sampler(&texture)?;
        let filter = if filter == NEAREST { TexelFilter::Nearest } else { TexelFilter::Bilinear };
        let wrap = match wrap {
            CLAMP => WrapMode::Clamp,
            MIRROR => WrapMode::Mirror,
            _ => WrapMode::Repeat,
        };
        let kind = TextureKind::Bitmap { image, filter, wrap };
        let id = self.add(texture.name_or("texture", index), kind, matrix(mapping));
        self.textures.insert(key, id);
        Ok(Some(id))
    }

    /// Filter and wrap mode of a texture.
    fn sampler(&mut self, texture: &Item<'_>) -> Result<[u64; 2], SceneError> {
        let Some(index) = texture.index("sampler", "samplers")? else { return Ok([0; 2]) };
        let item = self.document.entry("samplers", index)?;
        let [s, t] = ["wrapS", "wrapT"].map(|key| item.unsigned(key));
        let [s, t] = [s?, t?].map(|wrap| wrap.unwrap_or(0));
        let effect = |wrap| if wrap == CLAMP || wrap == MIRROR { wrap } else { 0 };
        if effect(s) != effect(t) {
            self.warn(&item.path, "wrapS and wrapT differ; wrapS counts for both");
        }
        Ok([item.unsigned("magFilter")?.unwrap_or(0), s])
    }

    pub(super) fn add(&mut self, name: String, kind: TextureKind, uv_from_surface: DMat3) -> TextureId {
        let id = TextureId(self.scene.textures.len() as u32);
        self.scene.textures.push(Texture { name, kind, uv_from_surface, place: self.place() });
        id
    }

    /// A colour times a texture, where there is one.
    pub(super) fn tinted(&mut self, factor: Rgb, texture: Option<TextureId>) -> Color {
        match texture {
            None => Color::Constant(factor),
            Some(texture) if factor == [1.0; 3] => Color::Texture(texture),
            Some(_) if factor == [0.0; 3] => Color::Constant(factor),
            Some(texture) => {
                let kind = TextureKind::Scaled { color: Color::Texture(texture), factor };
                Color::Texture(self.add("scaled".into(), kind, DMat3::IDENTITY))
            }
        }
    }

    /// A number times one channel of a texture, where there is one.
    pub(super) fn channel(&mut self, factor: f32, texture: Option<TextureId>, channel: u8) -> Scalar {
        let Some(of) = texture.filter(|_| factor != 0.0) else { return Scalar::Constant(factor) };
        let kind = TextureKind::Channel { of, channel };
        let channel = self.add("channel".into(), kind, DMat3::IDENTITY);
        match self.tinted([factor; 3], Some(channel)) {
            Color::Texture(id) => Scalar::Texture(id),
            Color::Constant([x, ..]) => Scalar::Constant(x),
        }
    }

    /// A number times the alpha of a texture, where there is one.
    pub(super) fn alpha(&mut self, factor: f32, texture: Option<TextureId>) -> Scalar {
        match self.tinted([factor; 3], texture) {
            Color::Texture(id) => Scalar::Texture(id),
            Color::Constant([x, ..]) => Scalar::Constant(x),
        }
    }
}

/// Offset, rotation and scale of KHR_texture_transform, and the set of texture coordinates.
fn mapping(info: &Item<'_>) -> Result<([f64; 5], u32), SceneError> {
    let set = |item: &Item<'_>| -> Result<Option<u32>, SceneError> {
        Ok(item.unsigned("texCoord")?.map(|set| set.min(u64::from(u32::MAX)) as u32))
    };
    let own = set(info)?.unwrap_or(0);
    let Some(transform) = info.extension("KHR_texture_transform")? else {
        return Ok(([0.0, 0.0, 0.0, 1.0, 1.0], own));
    };
    let [x, y] = transform.numbers("offset")?.unwrap_or([0.0; 2]);
    let [scale_x, scale_y] = transform.numbers("scale")?.unwrap_or([1.0; 2]);
    let rotation = transform.number("rotation")?.unwrap_or(0.0);
    Ok(([x, y, rotation, scale_x, scale_y], set(&transform)?.unwrap_or(own)))
}

/// `T · R · S`; the rotation is counter-clockwise as the picture is seen, whose v points down.
fn matrix([x, y, rotation, scale_x, scale_y]: [f64; 5]) -> DMat3 {
    let (sin, cos) = rotation.sin_cos();
    DMat3::from_cols(
        DVec3::new(cos, -sin, 0.0) * scale_x,
        DVec3::new(sin, cos, 0.0) * scale_y,
        DVec3::new(x, y, 1.0),
    )
}
