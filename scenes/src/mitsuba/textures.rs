//! `<texture>`, and the parameters that are a colour or a texture.

use std::path::Path;
use std::sync::Arc;

use glam::{DMat3, DMat4, DVec3};

use super::document::{Element, ElementId};
use super::object::Object;
use super::survey::{Standing, TEXTURES};
use super::{Reader, value};
use crate::files::identity;
use crate::spectrum::{Quantity, integrate};
use crate::{
    Color, Image, Rgb, Scalar, SceneError, TexelFilter, Texels, Texture, TextureId, TextureKind, WrapMode,
};

/// What stands in for a texture that is not read: a reflectance as good as any.
const GREY: Color = Color::Constant([0.5; 3]);

impl Reader<'_> {
    /// A parameter that is a colour or a texture.
    pub(super) fn color(
        &mut self,
        object: &Object<'_>,
        key: &'static str,
        quantity: Quantity,
        default: Color,
    ) -> Result<Color, SceneError> {
        match object.find(key) {
            Some((id, parameter)) => self.color_of(object, id, parameter, quantity),
            None => Ok(default),
        }
    }

    /// A parameter that is a number or a texture.
    pub(super) fn scalar(
        &mut self,
        object: &Object<'_>,
        key: &'static str,
        default: f64,
        wanted: &str,
        accept: impl Fn(f64) -> bool,
    ) -> Result<Scalar, SceneError> {
        match object.find(key) {
            Some((id, parameter)) if matches!(parameter.tag.as_str(), "texture" | "ref") => {
                Ok(match self.color_of(object, id, parameter, Quantity::Ratio)? {
                    Color::Constant(grey) => Scalar::Constant(grey[0]),
                    Color::Texture(texture) => Scalar::Texture(texture),
                })
            }
            _ => Ok(Scalar::Constant(object.float_where(key, default, wanted, accept)? as f32)),
        }
    }

    pub(super) fn color_of(
        &mut self,
        object: &Object<'_>,
        id: ElementId,
        parameter: &Element,
        quantity: Quantity,
    ) -> Result<Color, SceneError> {
        let target = object.resolve(id)?;
        let element = self.document.element(target);
        if element.tag == "texture" {
            return self.texture(target);
        }
        let label = object.label_of(parameter);
        let spd = |name: &str| self.spd(name, element, &label, quantity);
        let color = match value::color(element, quantity, spd)? {
            Some(color) => color,
            None => match element.attribute("type") {
                Some(kind) if element.tag == "spectrum" => return self.spectrum(target, kind, quantity),
                _ => {
                    let problem = format!("<{}> where a colour or a texture belongs", element.tag);
                    let help = format!("write <rgb name=\"{}\" value=\"…\"/> or a <texture>", parameter.key);
                    return Err(SceneError::at(&parameter.place, &label, problem, help));
                }
            },
        };
        if quantity == Quantity::Reflectance && color.iter().any(|v| !(0.0..=1.0).contains(v)) {
            let message =
                format!("a reflectance beyond 0 to 1, {color:?}, is clamped: it would make light of nothing");
            self.warn_as(id, &label, message);
            return Ok(Color::Constant(color.map(|v| v.clamp(0.0, 1.0))));
        }
        if color.iter().any(|v| *v < 0.0) {
            let problem = format!("negative values, {color:?}");
            return Err(SceneError::at(
                &parameter.place_of("value"),
                &label,
                problem,
                "give values of at least 0",
            ));
        }
        Ok(Color::Constant(color))
    }

    /// `<spectrum type="…">`: the plugins that stand for one colour.
    fn spectrum(&mut self, id: ElementId, kind: &str, quantity: Quantity) -> Result<Color, SceneError> {
        let object = Object::new(self.document, id);
        let color = match kind {
            // D65 is white in linear Rec. 709
            "d65" => [object.float_where("scale", 1.0, "at least 0", |v| v >= 0.0)? as f32; 3],
            "uniform" => {
                let value = object.float_where("value", 1.0, "at least 0", |v| v >= 0.0)?;
                crate::spectrum::constant(value, quantity)
            }
            _ => {
                self.warn(
                    id,
                    format!("{}: a spectrum that is not read; grey 0.5 stands in", value::shorten(kind)),
                );
                return Ok(GREY);
            }
        };
        object.finish(&mut self.warnings);
        Ok(Color::Constant(color))
    }

    /// The colour of a spectrum in a file of its own.
    fn spd(
        &mut self,
        name: &str,
        naming: &Element,
        label: &str,
        quantity: Quantity,
    ) -> Result<Rgb, SceneError> {
        let path = self.find(name, naming, label)?;
        let key = (identity(&path), quantity);
        if let Some(&known) = self.spectra.get(&key) {
            return Ok(known);
        }
        let bytes = self.bytes(&path, &naming.place, label)?;
        let points =
            value::spd_points(&String::from_utf8_lossy(&bytes)).map_err(|(line, problem)| SceneError {
                file: path,
                line,
                column: line.min(1),
                element: "spectrum".into(),
                problem,
                help: "write lines of wavelength in nm and value, from short to long".into(),
            })?;
        let color = integrate(&points, quantity);
        self.spectra.insert(key, color);
        Ok(color)
    }

    /// A texture, read once however often it is referred to. One that is not read becomes a constant.
    pub(super) fn texture(&mut self, id: ElementId) -> Result<Color, SceneError> {
        if let Some(&known) = self.textures.get(&id) {
            return Ok(known);
        }
        let color = self.nested(id, |reader| reader.new_texture(id))?;
        self.textures.insert(id, color);
        Ok(color)
    }

    fn new_texture(&mut self, id: ElementId) -> Result<Color, SceneError> {
        let object = Object::new(self.document, id);
        let kind = object.kind()?;
        if TEXTURES.standing(kind, object.element)? == Standing::Later {
            self.warn(id, format!("{kind} is not read yet; grey 0.5 stands in"));
            return Ok(GREY);
        }
        let texture = match kind {
            "bitmap" => self.bitmap(&object)?,
            "rawconstant" | "uniform" | "srgb" => {
                let color = self.constant(&object, kind)?;
                object.finish(&mut self.warnings);
                return Ok(color);
            }
            "mesh_attribute" => mesh_attribute(&object)?,
            "scale" => {
                let one = Color::Constant([1.0; 3]);
                let Color::Constant(factor) = self.color(&object, "scale", Quantity::Ratio, one)? else {
                    return Err(object.error("a texture as the scale", "give a number or a colour"));
                };
                let color = match object.nested("texture")?[..] {
                    [(inner, _)] => self.texture(inner)?,
                    _ => return Err(object.error("not one texture inside", "give it one texture to scale")),
                };
                TextureKind::Scaled { color, factor }
            }
            _ => {
                // A float may be any number, and beyond 1 where no reflectance is meant: `diff_trans` goes to 2.
                let quantity = |key| match object.find(key) {
                    Some((_, parameter)) if parameter.tag == "float" => Quantity::Ratio,
                    _ => Quantity::Reflectance,
                };
                let mut color =
                    |key, default| self.color(&object, key, quantity(key), Color::Constant([default; 3]));
                let (color0, color1) = (color("color0", 0.4)?, color("color1", 0.2)?);
                TextureKind::Checkerboard { color0, color1 }
            }
        };
        let uv_from_surface = uv_from_surface(&object)?;
        let name = self.name(&object, kind, self.scene.textures.len());
        let texture_id = TextureId(self.scene.textures.len() as u32);
        self.scene.textures.push(Texture { name, kind: texture, uv_from_surface, place: object.place() });
        object.finish(&mut self.warnings);
        Ok(Color::Texture(texture_id))
    }

    /// Textures that are the same everywhere.
    fn constant(&mut self, object: &Object<'_>, kind: &str) -> Result<Color, SceneError> {
        let key = if kind == "srgb" { "color" } else { "value" };
        if object.find(key).is_none() {
            return Err(object.error(format!("no \"{key}\""), "give it a value"));
        }
        // three numbers of a rawconstant may be written as a vector
        match object.find(key) {
            Some((_, found)) if matches!(found.tag.as_str(), "vector" | "point") => {
                Ok(Color::Constant(object.vector(key, DVec3::ZERO)?.as_vec3().to_array()))
            }
            _ => self.color(object, key, Quantity::Ratio, GREY),
        }
    }

    fn bitmap(&mut self, object: &Object<'_>) -> Result<TextureKind, SceneError> {
        let path = self.file(object)?;
        let mut raw = object.boolean("raw", false)?;
        // the 0.x way to say how bytes are encoded
        if let Some(gamma) = object.maybe_float("gamma")? {
            raw |= gamma == 1.0;
            if gamma > 0.0 && gamma != 1.0 {
                self.warn(object.id, format!("gamma {gamma} is read as the sRGB curve"));
            }
        }
        let filters = [
            ("bilinear", TexelFilter::Bilinear),
            ("nearest", TexelFilter::Nearest),
            ("trilinear", TexelFilter::Bilinear), // of 0.x: there is no footprint to choose a level by
            ("ewa", TexelFilter::Bilinear),
        ];
        let filter = object.choice("filter_type", &filters)?;
        let wraps = [("repeat", WrapMode::Repeat), ("mirror", WrapMode::Mirror), ("clamp", WrapMode::Clamp)];
        let wrap = object.choice("wrap_mode", &wraps)?;
        object.without_effect(&["format", "max_anisotropy", "cache", "accel"]);
        let image = self.image(&path, raw, object)?;
        Ok(TextureKind::Bitmap { image, filter, wrap })
    }

    /// A picture, decoded once for all that name it.
    pub(super) fn image(
        &mut self,
        path: &Path,
        raw: bool,
        object: &Object<'_>,
    ) -> Result<Arc<Image>, SceneError> {
        let key = (identity(path), raw);
        if let Some(known) = self.images.get(&key) {
            return Ok(Arc::clone(known));
        }
        let place = object.find("filename").map_or_else(|| object.place(), |(_, e)| e.place_of("value"));
        let label = object.element.label();
        let bytes = self.bytes(path, &place, &label)?;
        let image = crate::image::decode(&bytes, raw).map_err(|problem| {
            let problem = format!("{}: {problem}", path.display());
            SceneError::at(&place, &label, problem, "name a PNG, JPEG, BMP, Radiance HDR or OpenEXR picture")
        })?;
        // linear pictures are the same whether raw or not
        let other = (key.0.clone(), !raw);
        let image = match self.images.get(&other) {
            Some(known) if matches!(known.texels, Texels::Linear32(_)) && **known == image => {
                Arc::clone(known)
            }
            _ => Arc::new(image),
        };
        self.images.insert(key, Arc::clone(&image));
        Ok(image)
    }
}

fn mesh_attribute(object: &Object<'_>) -> Result<TextureKind, SceneError> {
    let help = "name an attribute, such as \"vertex_color\" or \"face_color\"";
    let Some((name, parameter)) = object.string("name")? else {
        return Err(object.error("no \"name\"", help));
    };
    if !["vertex_", "face_"].iter().any(|prefix| name.starts_with(prefix)) {
        let problem = format!("\"{}\" begins with neither vertex_ nor face_", value::shorten(name));
        return Err(object.value_error(parameter, problem, help));
    }
    let scale =
        object.float_where("scale", 1.0, "in the range of 32 bits", |v| (v as f32).is_finite())? as f32;
    Ok(TextureKind::MeshAttribute { name: name.into(), scale })
}

/// `to_uv`, or the four numbers of 0.x; of a 4×4 matrix, rows and columns of x, y and the translation count.
fn uv_from_surface(object: &Object<'_>) -> Result<DMat3, SceneError> {
    let full = object.transform("to_uv")?;
    let flat = |column: glam::DVec4| DVec3::new(column.x, column.y, 0.0);
    let mut matrix = DMat3::from_cols(flat(full.x_axis), flat(full.y_axis), flat(full.w_axis));
    matrix.z_axis.z = 1.0;
    if object.element.is_old {
        let scale = DVec3::new(object.float("uscale", 1.0)?, object.float("vscale", 1.0)?, 1.0);
        let offset = DVec3::new(object.float("uoffset", 0.0)?, object.float("voffset", 0.0)?, 0.0);
        let old = DMat4::from_translation(offset) * DMat4::from_scale(scale);
        matrix *= DMat3::from_cols(flat(old.x_axis), flat(old.y_axis), flat(old.w_axis) + DVec3::Z);
    }
    Ok(matrix)
}
