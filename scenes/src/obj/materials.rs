//! Materials of MTL files: a diffuse base with a highlight, metal and glass where `illum` or the extension for
//! physically based materials say so.

use std::sync::Arc;

use glam::{DMat3, DVec3};

use super::Reader;
use super::mtl::{MapStatement, Mtl};
use crate::files::identity;
use crate::{
    Color, GltfMaterial, Image, Material, MaterialId, MaterialKind, NormalMap, Place, Rgb, Scalar,
    TexelFilter, Texels, Texture, TextureId, TextureKind, WrapMode,
};

/// What a part of an OBJ file shows.
#[derive(Clone, Copy)]
pub(super) struct Surface {
    pub material: MaterialId,
    pub emission: Option<Color>,
}

/// What the numbers of a picture mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Use {
    /// sRGB-encoded colours.
    Color,
    /// Numbers as they are.
    Data,
    /// Alpha where the picture has it, else the numbers.
    Opacity,
}

impl Reader {
    /// Grey, seen from both sides: what stands in for a material that is not there.
    pub(super) fn default_surface(&mut self) -> Surface {
        if let Some(known) = self.default {
            return known;
        }
        let kind = MaterialKind::Diffuse { reflectance: Color::Constant([0.5; 3]) };
        let place = self.place(0);
        let material = self.add("default", kind, &place);
        let surface = Surface { material: self.two_sided("default", material, &place), emission: None };
        self.default = Some(surface);
        surface
    }

    fn add(&mut self, name: &str, kind: MaterialKind, place: &Place) -> MaterialId {
        let id = MaterialId(self.scene.materials.len() as u32);
        self.scene.materials.push(Material { name: name.into(), kind, place: place.clone() });
        id
    }

    fn two_sided(&mut self, name: &str, material: MaterialId, place: &Place) -> MaterialId {
        self.add(name, MaterialKind::TwoSided { front: material, back: material }, place)
    }

    /// The material of a library; `place` is that of its `newmtl`.
    pub(super) fn surface(&mut self, mtl: &Mtl, place: &Place) -> Surface {
        let base = self.diffuse(mtl, place);
        let kind = if mtl.is_physical() {
            MaterialKind::Gltf(Box::new(self.physical(mtl, base, place)))
        } else {
            self.classic(mtl, base, place)
        };
        let transmits = kind.transmits();
        let mut material = self.add(&mtl.name, kind, place);
        if !transmits {
            material = self.two_sided(&mtl.name, material, place);
        }
        material = self.relief(mtl, material, place);
        if let Some(opacity) = self.opacity(mtl, transmits, place) {
            material = self.add(&mtl.name, MaterialKind::Mask { opacity, inner: material }, place);
        }
        let emission = self.emission(mtl, place);
        Surface { material, emission }
    }

    fn diffuse(&mut self, mtl: &Mtl, place: &Place) -> Color {
        let texture = self.texture(mtl.map("Kd"), Use::Color, mtl, place);
        match (mtl.diffuse, texture) {
            // some writers leave the factor at black where there is a map
            (None | Some([0.0, 0.0, 0.0]), Some(texture)) => Color::Texture(texture),
            (factor, texture) => self.tinted(factor.unwrap_or([0.5; 3]).map(reflectance), texture, place),
        }
    }

    fn emission(&mut self, mtl: &Mtl, place: &Place) -> Option<Color> {
        let texture = self.texture(mtl.map("Ke"), Use::Color, mtl, place);
        let factor = mtl.emission.map(|ke| ke.map(|x| x.max(0.0)));
        match (factor, texture) {
            (None | Some([0.0, 0.0, 0.0]), None) => None,
            (None | Some([0.0, 0.0, 0.0]), Some(texture)) => Some(Color::Texture(texture)),
            (Some(factor), texture) => {
                // less is a glow, as that of a screen
                self.has_lamp |= factor.iter().any(|&x| x >= 1.0);
                Some(self.tinted(factor, texture, place))
            }
        }
    }

    /// Kd, Ks, Ns, Ni and `illum`.
    fn classic(&mut self, mtl: &Mtl, base: Color, place: &Place) -> MaterialKind {
        let illum = mtl.number("illum").unwrap_or(2.0) as i32;
        let specular = mtl.specular.unwrap_or([0.0; 3]).map(reflectance);
        // reflections that are traced, in the words of the format, are sharp
        let is_sharp = matches!(illum, 3 | 5 | 6 | 7 | 8);
        let exponent = mtl.number("Ns").unwrap_or(0.0).max(0.0);
        let roughness = if is_sharp { 0.0 } else { roughness_of(exponent) };
        let roughness = match self.texture(mtl.map("Ns"), Use::Data, mtl, place) {
            Some(_) => {
                self.warn(place, &mtl.name, "map_Ns is not read; Ns counts");
                Scalar::Constant(roughness)
            }
            None => Scalar::Constant(roughness),
        };
        let ior = mtl.number("Ni").filter(|&ior| ior > 1.0).unwrap_or(1.5).min(1e3);
        let metallic = Scalar::Constant(0.0);
        let gltf = GltfMaterial { metallic, roughness, ior, ..GltfMaterial::default() };
        if matches!(illum, 6 | 7) {
            let base_color = Color::Constant(mtl.filter.unwrap_or([1.0; 3]).map(reflectance));
            let transmission = Scalar::Constant(1.0);
            return MaterialKind::Gltf(Box::new(GltfMaterial {
                base_color,
                transmission,
                thin: false,
                ..gltf
            }));
        }
        let grey = |rgb: Rgb| rgb.iter().sum::<f32>();
        if is_sharp && grey(specular) > grey(mtl.diffuse.unwrap_or_default()) {
            let (base_color, metallic) = (Color::Constant(specular), Scalar::Constant(1.0));
            return MaterialKind::Gltf(Box::new(GltfMaterial { base_color, metallic, ..gltf }));
        }
        let texture = self.texture(mtl.map("Ks"), Use::Color, mtl, place);
        if illum < 2 || specular == [0.0; 3] {
            return MaterialKind::Diffuse { reflectance: base };
        }
        let specular_color = self.tinted(specular, texture, place);
        MaterialKind::Gltf(Box::new(GltfMaterial { base_color: base, specular_color, ..gltf }))
    }

    /// Pr, Pm, Ps, Pc with their maps.
    fn physical(&mut self, mtl: &Mtl, base_color: Color, place: &Place) -> GltfMaterial {
        let scalar = |reader: &mut Self, word: &str, default: f32| {
            let texture = reader.texture(mtl.map(word), Use::Data, mtl, place);
            match (mtl.number(word), texture) {
                (None, Some(texture)) => Scalar::Texture(texture),
                (factor, texture) => {
                    let factor = reflectance(factor.unwrap_or(default));
                    match reader.tinted([factor; 3], texture, place) {
                        Color::Texture(id) => Scalar::Texture(id),
                        Color::Constant([x, ..]) => Scalar::Constant(x),
                    }
                }
            }
        };
        let old = mtl.number("Ns").map_or(0.5, |exponent| roughness_of(exponent.max(0.0)));
        let roughness = scalar(self, "Pr", old);
        let metallic = scalar(self, "Pm", 0.0);
        let clearcoat = scalar(self, "Pc", 0.0);
        let sheen = scalar(self, "Ps", 0.0);
        if mtl.number("aniso").is_some_and(|aniso| aniso != 0.0) {
            self.warn(place, &mtl.name, "aniso is not read; the highlight is round");
        }
        let sheen_color = match sheen {
            Scalar::Constant(x) => Color::Constant([x; 3]),
            Scalar::Texture(texture) => Color::Texture(texture),
        };
        GltfMaterial {
            base_color,
            metallic,
            roughness,
            ior: mtl.number("Ni").filter(|&ior| ior >= 1.0).unwrap_or(1.5).min(1e3),
            clearcoat,
            clearcoat_roughness: Scalar::Constant(reflectance(mtl.number("Pcr").unwrap_or(0.0))),
            sheen_color,
            sheen_roughness: Scalar::Constant(0.5),
            ..GltfMaterial::default()
        }
    }

    /// `d`, or 1 − `Tr`, times its map; `None` where all is there.
    fn opacity(&mut self, mtl: &Mtl, transmits: bool, place: &Place) -> Option<Scalar> {
        let texture = self.texture(mtl.map("d"), Use::Opacity, mtl, place);
        let whole = match (mtl.number("d"), mtl.number("Tr")) {
            (Some(d), _) => d,
            (None, Some(1.0)) => {
                self.warn(
                    place,
                    &mtl.name,
                    "Tr 1 without d would leave nothing to be seen; it is read as opaque",
                );
                1.0
            }
            (None, Some(tr)) => 1.0 - tr,
            (None, None) => 1.0,
        };
        // glass says by its filter what goes through
        let whole = if transmits { 1.0 } else { reflectance(whole) };
        match self.tinted([whole; 3], texture, place) {
            Color::Texture(id) => Some(Scalar::Texture(id)),
            Color::Constant([x, ..]) => (x != 1.0).then_some(Scalar::Constant(x)),
        }
    }

    /// `material` under `norm` or `bump`.
    fn relief(&mut self, mtl: &Mtl, material: MaterialId, place: &Place) -> MaterialId {
        let normal = self.texture(mtl.map("norm"), Use::Data, mtl, place).zip(mtl.map("norm"));
        let bump = self.texture(mtl.map("bump"), Use::Data, mtl, place).zip(mtl.map("bump"));
        let map = match (normal, bump) {
            (Some((texture, map)), _) => {
                NormalMap::Tangent { normal: Color::Texture(texture), scale: map.multiplier }
            }
            (None, Some((texture, map))) if self.shows_normals(texture) => {
                self.warn(place, &mtl.name, "the picture of bump shows normals; it is read as norm");
                NormalMap::Tangent { normal: Color::Texture(texture), scale: map.multiplier }
            }
            (None, Some((texture, map))) => {
                NormalMap::Bump { height: Scalar::Texture(texture), scale: map.multiplier }
            }
            (None, None) => return material,
        };
        let kind = MaterialKind::Perturbed { map, flip_invalid: true, shadowing: true, inner: material };
        self.add(&mtl.name, kind, place)
    }

    /// Whether a picture is bluish as pictures of normals are, and those of heights are not.
    fn shows_normals(&self, TextureId(id): TextureId) -> bool {
        let TextureKind::Bitmap { image, .. } = &self.scene.textures[id as usize].kind else { return false };
        let Texels::Linear8(bytes) = &image.texels else { return false };
        let texels = bytes.chunks_exact(3);
        let bluish = texels.clone().filter(|t| t[2] > 128 && t[2] > t[0].max(t[1])).count();
        10 * bluish > 9 * texels.len()
    }

    fn tinted(&mut self, factor: Rgb, texture: Option<TextureId>, place: &Place) -> Color {
        match texture {
            None => Color::Constant(factor),
            Some(texture) if factor == [1.0; 3] => Color::Texture(texture),
            Some(_) if factor == [0.0; 3] => Color::Constant(factor),
            Some(texture) => {
                let kind = TextureKind::Scaled { color: Color::Texture(texture), factor };
                Color::Texture(self.add_texture("scaled".into(), kind, DMat3::IDENTITY, place))
            }
        }
    }

    fn add_texture(&mut self, name: String, kind: TextureKind, uv: DMat3, place: &Place) -> TextureId {
        let id = TextureId(self.scene.textures.len() as u32);
        self.scene.textures.push(Texture { name, kind, uv_from_surface: uv, place: place.clone() });
        id
    }

    /// The texture of a map; a picture that is not there or cannot be read is a warning.
    fn texture(
        &mut self,
        map: Option<&MapStatement>,
        usage: Use,
        mtl: &Mtl,
        place: &Place,
    ) -> Option<TextureId> {
        let map = map?;
        let place = Place { line: map.line, column: 1, file: Arc::clone(&place.file) };
        let image = match self.image(map, usage, &place) {
            Ok(image) => image,
            Err(problem) => {
                self.warn(&place, &mtl.name, format!("{problem}; the map is left out"));
                return None;
            }
        };
        let wrap = if map.clamp { WrapMode::Clamp } else { WrapMode::Repeat };
        let kind = TextureKind::Bitmap { image, filter: TexelFilter::Bilinear, wrap };
        let ([sx, sy], [ox, oy]) = (map.scale, map.offset);
        // v of the file runs upwards: 1 − (s (1 − v) + o)
        let uv = DMat3::from_cols(
            DVec3::new(sx, 0.0, 0.0),
            DVec3::new(0.0, sy, 0.0),
            DVec3::new(ox, 1.0 - sy - oy, 1.0),
        );
        let id = self.add_texture(map.file.clone(), kind, uv, &place);
        Some(match map.channel {
            Some(channel) if usage != Use::Color => {
                let kind = TextureKind::Channel { of: id, channel };
                self.add_texture("channel".into(), kind, DMat3::IDENTITY, &place)
            }
            _ => id,
        })
    }

    /// A picture, decoded once for each use.
    fn image(&mut self, map: &MapStatement, usage: Use, place: &Place) -> Result<Arc<Image>, String> {
        let name: String = map.file.chars().take(80).collect();
        let found = self.files.find(&map.file, &place.file);
        let path = found.ok_or_else(|| format!("the file \"{name}\" is not there"))?.path;
        let key = (identity(&path), usage);
        if let Some(known) = self.images.get(&key) {
            return Ok(Arc::clone(known));
        }
        let named = |problem: String| format!("{}: {problem}", path.display());
        let bytes = self.files.read(&path).map_err(|e| named(e.to_string()))?;
        let image = match usage {
            Use::Color => crate::image::decode(&bytes, false),
            Use::Data => crate::image::decode(&bytes, true),
            Use::Opacity => match crate::image::decode_alpha(&bytes) {
                Ok(Some(alpha)) => Ok(alpha),
                Ok(None) => crate::image::decode(&bytes, true),
                Err(problem) => Err(problem),
            },
        };
        let image = Arc::new(image.map_err(named)?);
        self.images.insert(key, Arc::clone(&image));
        Ok(image)
    }
}

/// The roughness whose GGX lobe is about as wide as a Phong lobe: α = √(2 / (n + 2)) (Walter et al. 2007), and α is
/// its square.
fn roughness_of(exponent: f32) -> f32 {
    (2.0 / (exponent + 2.0)).powf(0.25)
}

fn reflectance(x: f32) -> f32 {
    x.clamp(0.0, 1.0)
}
