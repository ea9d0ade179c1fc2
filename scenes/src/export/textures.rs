//! Colours and numbers, constant or from a `<texture>`.

use std::sync::Arc;

use glam::{DMat3, DMat4};

use super::bake::Baked;
use super::{ExportError, Writer};
use crate::spectrum::linear_from_srgb;
use crate::{Color, Image, Rgb, Scalar, TexelFilter, Texels, TextureId, TextureKind, WrapMode};

impl Writer<'_> {
    /// A colour as the parameter `name`.
    pub(super) fn color(&mut self, name: &str, color: Color) -> Result<(), ExportError> {
        match color {
            Color::Constant(rgb) => {
                self.xml.rgb(name, rgb);
                Ok(())
            }
            Color::Texture(texture) => self.texture(name, texture),
        }
    }

    /// A number as the parameter `name`.
    pub(super) fn scalar(&mut self, name: &str, scalar: Scalar) -> Result<(), ExportError> {
        match scalar {
            Scalar::Constant(x) => {
                self.xml.float(name, x);
                Ok(())
            }
            Scalar::Texture(texture) => self.texture(name, texture),
        }
    }

    /// A normal map of glTF. Mitsuba's has the same axes but where texture coordinates are mirrored.
    pub(super) fn tangent_map(&mut self, normal: Color, scale: f32) -> Result<(), ExportError> {
        let Color::Texture(id) = normal else { return self.color("normalmap", normal) };
        if scale == 1.0 {
            return self.texture("normalmap", id);
        }
        let flatter = |texel: [f32; 3]| {
            let [x, y, z] = texel.map(|c| 2.0 * c - 1.0);
            let n = glam::Vec3::new(scale * x, scale * y, z).normalize_or(glam::Vec3::Z);
            n.to_array().map(|c| 0.5 * (c + 1.0))
        };
        match self.bake(id) {
            Some(baked) => self.baked_texture("normalmap", baked.map(flatter)),
            None => self.texture("normalmap", id),
        }
    }

    /// A picture that was made here.
    pub(super) fn baked_texture(&mut self, name: &str, baked: Baked) -> Result<(), ExportError> {
        self.bitmap(name, &baked.image, baked.filter, baked.wrap)?;
        self.xml.transform("to_uv", matrix4(baked.uv_from_surface));
        self.xml.close("texture");
        self.scaled.push(baked.image);
        Ok(())
    }

    /// The beginning of a `bitmap` texture.
    fn bitmap(
        &mut self,
        name: &str,
        image: &Arc<Image>,
        filter: TexelFilter,
        wrap: WrapMode,
    ) -> Result<(), ExportError> {
        let (file, raw) = self.image(image)?;
        self.xml.open("texture", &[("type", "bitmap"), ("name", name)]);
        self.xml.value("string", "filename", &file);
        if raw {
            self.xml.value("boolean", "raw", "true");
        }
        let filter = match filter {
            TexelFilter::Nearest => "nearest",
            TexelFilter::Bilinear => "bilinear",
        };
        self.xml.value("string", "filter_type", filter);
        let wrap = match wrap {
            WrapMode::Repeat => "repeat",
            WrapMode::Mirror => "mirror",
            WrapMode::Clamp => "clamp",
        };
        self.xml.value("string", "wrap_mode", wrap);
        Ok(())
    }

    /// A texture, written in full wherever it is used: Mitsuba shares nothing between two uses but the file.
    pub(super) fn texture(&mut self, name: &str, id: TextureId) -> Result<(), ExportError> {
        self.scaled_texture(name, id, [1.0; 3])
    }

    /// A colour times a factor, which Mitsuba has no texture for: the factor goes into what is scaled.
    pub(super) fn scaled_color(&mut self, name: &str, color: Color, factor: Rgb) -> Result<(), ExportError> {
        match color {
            Color::Constant(rgb) => self.color(name, Color::Constant(times(rgb, factor))),
            Color::Texture(texture) => self.scaled_texture(name, texture, factor),
        }
    }

    fn scaled_texture(&mut self, name: &str, id: TextureId, factor: Rgb) -> Result<(), ExportError> {
        let texture = &self.scene.textures[id.0 as usize];
        match &texture.kind {
            TextureKind::Bitmap { image, filter, wrap } => {
                let image = match factor {
                    [1.0, 1.0, 1.0] => Arc::clone(image),
                    _ => Arc::new(scaled_image(image, factor)),
                };
                self.bitmap(name, &image, *filter, *wrap)?;
                self.scaled.push(image);
            }
            TextureKind::Checkerboard { color0, color1 } => {
                self.xml.open("texture", &[("type", "checkerboard"), ("name", name)]);
                self.scaled_color("color0", *color0, factor)?;
                self.scaled_color("color1", *color1, factor)?;
            }
            TextureKind::Scaled { color, factor: inner } => {
                return self.scaled_color(name, *color, times(factor, *inner));
            }
            TextureKind::MeshAttribute { name: attribute, scale } => {
                if factor != [factor[0]; 3] {
                    self.notes.push(format!(
                        "texture \"{}\": the tint of a mesh attribute is left out but for its mean: Mitsuba scales one by a number",
                        texture.name
                    ));
                }
                self.xml.open("texture", &[("type", "mesh_attribute"), ("name", name)]);
                self.xml.value("string", "name", attribute);
                let grey =
                    if factor == [factor[0]; 3] { factor[0] } else { factor.iter().sum::<f32>() / 3.0 };
                self.xml.float("scale", scale * grey);
                self.xml.close("texture");
                return Ok(());
            }
            TextureKind::Channel { .. } => return self.channel(name, id, factor),
            TextureKind::Product { a, b } => return self.product(name, id, [*a, *b], factor),
        }
        self.xml.transform("to_uv", matrix4(texture.uv_from_surface));
        self.xml.close("texture");
        Ok(())
    }
}

pub(super) fn times(a: Rgb, b: Rgb) -> Rgb {
    [a[0] * b[0], a[1] * b[1], a[2] * b[2]]
}

/// A picture with every texel times a factor, in linear values.
fn scaled_image(image: &Image, factor: Rgb) -> Image {
    let byte = |v: u8| f32::from(v) / 255.0;
    let linear: Vec<f32> = match &image.texels {
        Texels::Srgb8(bytes) => bytes.iter().map(|&v| linear_from_srgb(byte(v))).collect(),
        Texels::Linear8(bytes) => bytes.iter().map(|&v| byte(v)).collect(),
        Texels::Linear32(values) => values.clone(),
    };
    let scaled = linear.iter().zip(factor.iter().cycle()).map(|(v, f)| v * f).collect();
    Image { texels: Texels::Linear32(scaled), ..*image }
}

/// The 4×4 matrix whose x, y and translation are those of a map of the plane.
fn matrix4(m: DMat3) -> DMat4 {
    let column = |c: glam::DVec3, w: f64| glam::DVec4::new(c.x, c.y, 0.0, w);
    DMat4::from_cols(column(m.x_axis, 0.0), column(m.y_axis, 0.0), glam::DVec4::Z, column(m.z_axis, 1.0))
}
