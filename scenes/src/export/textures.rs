//! Colours and numbers, constant or from a `<texture>`.

use glam::{DMat3, DMat4};

use super::{ExportError, Writer};
use crate::{Color, Scalar, TexelFilter, TextureId, TextureKind, WrapMode};

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

    /// A texture, written in full wherever it is used: Mitsuba shares nothing between two uses but the file.
    pub(super) fn texture(&mut self, name: &str, id: TextureId) -> Result<(), ExportError> {
        let texture = &self.scene.textures[id.0 as usize];
        match &texture.kind {
            TextureKind::Bitmap { image, filter, wrap } => {
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
            }
            TextureKind::Checkerboard { color0, color1 } => {
                self.xml.open("texture", &[("type", "checkerboard"), ("name", name)]);
                self.color("color0", *color0)?;
                self.color("color1", *color1)?;
            }
        }
        self.xml.transform("to_uv", matrix4(texture.uv_from_surface));
        self.xml.close("texture");
        Ok(())
    }
}

/// The 4×4 matrix whose x, y and translation are those of a map of the plane.
fn matrix4(m: DMat3) -> DMat4 {
    let column = |c: glam::DVec3, w: f64| glam::DVec4::new(c.x, c.y, 0.0, w);
    DMat4::from_cols(column(m.x_axis, 0.0), column(m.y_axis, 0.0), glam::DVec4::Z, column(m.z_axis, 1.0))
}
