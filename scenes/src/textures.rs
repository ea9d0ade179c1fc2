//! What varies over a surface: colours and numbers, the textures that they come from, and pictures.

use std::sync::Arc;

use glam::DMat3;

use crate::{Place, Rgb, TextureId};

/// A colour, constant or from a texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Color {
    /// The same everywhere.
    Constant(Rgb),
    /// Looked up at the hit.
    Texture(TextureId),
}

/// A number, constant or from a texture (whose luminance counts).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scalar {
    /// The same everywhere.
    Constant(f32),
    /// Looked up at the hit.
    Texture(TextureId),
}

/// A texture with its mapping.
#[derive(Clone, Debug)]
pub struct Texture {
    /// The file's id, or its kind and a number.
    pub name: String,
    /// What is looked up.
    pub kind: TextureKind,
    /// Applied to (u, v, 1) of the surface before the look-up.
    pub uv_from_surface: DMat3,
    /// Where it stands.
    pub place: Place,
}

/// What a texture looks up.
#[derive(Clone, Debug)]
pub enum TextureKind {
    /// Pixels.
    Bitmap {
        /// Several textures may share one image.
        image: Arc<Image>,
        /// Between texels.
        filter: TexelFilter,
        /// Outside \[0, 1\]².
        wrap: WrapMode,
    },
    /// Squares of side ½ in uv.
    Checkerboard {
        /// Where both or neither of frac(u), frac(v) lie above ½.
        color0: Color,
        /// Elsewhere.
        color1: Color,
    },
    /// A [`MeshAttribute`](crate::MeshAttribute) of the mesh that is hit; black on shapes that have none of this name.
    MeshAttribute {
        /// With its prefix.
        name: String,
        /// Factor on the values.
        scale: f32,
    },
    /// Another texture times a factor.
    Scaled {
        /// Looked up with its own mapping.
        color: Color,
        /// Per channel.
        factor: Rgb,
    },
    /// One channel of another texture, as a grey.
    Channel {
        /// Looked up with its own mapping.
        of: TextureId,
        /// 0 to 2: red, green, blue.
        channel: u8,
    },
    /// Two colours multiplied, each looked up with its own mapping.
    Product {
        /// One factor.
        a: Color,
        /// The other.
        b: Color,
    },
}

/// Interpolation between texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TexelFilter {
    /// The nearest texel.
    Nearest,
    /// Of the four around; texel (i, j) has its centre at ((i + ½) / width, (j + ½) / height).
    Bilinear,
}

/// What lies outside \[0, 1\]² of a bitmap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WrapMode {
    /// The picture again.
    Repeat,
    /// The picture mirrored.
    Mirror,
    /// The border texel.
    Clamp,
}

/// A decoded picture, at least 1×1.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// In texels.
    pub width: u32,
    /// In texels.
    pub height: u32,
    /// Row-major from the top, three values a texel (grey is spread, alpha dropped).
    pub texels: Texels,
}

/// The values of an [`Image`], three a texel.
#[derive(Clone, Debug, PartialEq)]
pub enum Texels {
    /// sRGB-encoded bytes.
    Srgb8(Vec<u8>),
    /// Bytes that are linear values × 255 (`raw`).
    Linear8(Vec<u8>),
    /// Linear values; may be non-finite, as the file has them.
    Linear32(Vec<f32>),
}
