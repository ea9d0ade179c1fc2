//! Materials: metallic-roughness with its extensions, alpha modes, two sides, normal maps, emission.

use glam::DMat3;

use super::Reader;
use super::images::Use;
use super::json::Item;
use crate::{
    Color, GltfMaterial, Material, MaterialId, MaterialKind, NormalMap, Rgb, Scalar, SceneError, TextureKind,
};

/// What a primitive shows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Surface {
    pub material: MaterialId,
    /// Radiance, on the front.
    pub emission: Option<Color>,
    /// The set of texture coordinates that its textures ask for.
    pub uv_set: u32,
}

/// What the colours of vertices are called among the attributes of a mesh.
pub(super) const VERTEX_COLOR: &str = "vertex_color";

/// How alpha counts.
#[derive(Clone, Copy, PartialEq)]
enum Alpha {
    Opaque,
    Mask { cutoff: f32 },
    Blend,
}

/// A material so far, and what is met on the way.
struct Draft<'a> {
    item: Item<'a>,
    /// Metallic-roughness parameters, where there are any.
    pbr: Option<Item<'a>>,
    name: String,
    /// Sets of texture coordinates that textures ask for, the most important first.
    sets: Vec<u32>,
}

impl Reader<'_> {
    /// The material with this number, or what stands in for none, on vertices with colours or without.
    pub(super) fn surface(&mut self, index: Option<usize>, has_color: bool) -> Result<Surface, SceneError> {
        if let Some(known) = self.surfaces.get(&(index, has_color)) {
            return Ok(*known);
        }
        let surface = match index {
            Some(index) => self.new_surface(index, has_color)?,
            None => {
                let base_color = self.colored(Color::Constant([1.0; 3]), has_color);
                let kind =
                    MaterialKind::Gltf(Box::new(GltfMaterial { base_color, ..GltfMaterial::default() }));
                Surface { material: self.material("default", kind), emission: None, uv_set: 0 }
            }
        };
        self.surfaces.insert((index, has_color), surface);
        Ok(surface)
    }

    /// A colour times that of the vertices.
    fn colored(&mut self, color: Color, has_color: bool) -> Color {
        if !has_color {
            return color;
        }
        let kind = TextureKind::MeshAttribute { name: VERTEX_COLOR.into(), scale: 1.0 };
        let b = Color::Texture(self.add("vertex colour".into(), kind, DMat3::IDENTITY));
        match color {
            Color::Constant([1.0, 1.0, 1.0]) => b,
            a => {
                let product = TextureKind::Product { a, b };
                Color::Texture(self.add("product".into(), product, DMat3::IDENTITY))
            }
        }
    }

    fn material(&mut self, name: &str, kind: MaterialKind) -> MaterialId {
        let id = MaterialId(self.scene.materials.len() as u32);
        self.scene.materials.push(Material { name: name.into(), kind, place: self.place() });
        id
    }

    fn new_surface(&mut self, index: usize, has_color: bool) -> Result<Surface, SceneError> {
        let item = self.document.entry("materials", index)?;
        let mut draft = Draft {
            pbr: item.object("pbrMetallicRoughness")?,
            name: item.name_or("material", index),
            item,
            sets: Vec::new(),
        };
        let alpha = alpha_mode(&draft.item)?;
        let unlit = draft.item.extension("KHR_materials_unlit")?.is_some();
        let (base_color, base_alpha) = self.base_color(&mut draft, alpha)?;
        let base_color = self.colored(base_color, has_color);
        if has_color && alpha != Alpha::Opaque {
            self.warn(
                &draft.item.path,
                "the alpha of vertex colours is not read; that of the material counts",
            );
        }
        let emission = if unlit { Some(base_color) } else { self.emission(&mut draft)? };
        let kind = if unlit {
            MaterialKind::Diffuse { reflectance: Color::Constant([0.0; 3]) }
        } else {
            MaterialKind::Gltf(Box::new(self.layers(&mut draft, base_color)?))
        };
        let transmits = kind.transmits();
        let mut material = self.material(&draft.name, kind);
        if draft.item.boolean("doubleSided")? {
            if !transmits {
                let kind = MaterialKind::TwoSided { front: material, back: material };
                material = self.material(&draft.name, kind);
            }
            if emission.is_some() {
                self.warn(&draft.item.path, "emission of both sides is shown on the front only");
            }
        }
        if !unlit {
            material = self.normal_map(&mut draft, material)?;
        }
        if let Some(opacity) = base_alpha {
            material = self.material(&draft.name, MaterialKind::Mask { opacity, inner: material });
        }
        let uv_set = draft.sets.first().copied().unwrap_or(0);
        if let Some(other) = draft.sets.iter().find(|&&set| set != uv_set) {
            let message =
                format!("textures ask for TEXCOORD_{uv_set} and TEXCOORD_{other}; all get TEXCOORD_{uv_set}");
            self.warn(&draft.item.path, message);
        }
        Ok(Surface { material, emission, uv_set })
    }

    /// Colour, and opacity where it counts.
    fn base_color(
        &mut self,
        draft: &mut Draft<'_>,
        alpha: Alpha,
    ) -> Result<(Color, Option<Scalar>), SceneError> {
        // The older extension has a diffuse colour in its place.
        let old = draft.item.extension("KHR_materials_pbrSpecularGlossiness")?;
        let (owner, keys) = match (&old, &draft.pbr) {
            (Some(old), _) => (Some(old), ["diffuseFactor", "diffuseTexture"]),
            (None, pbr) => (pbr.as_ref(), ["baseColorFactor", "baseColorTexture"]),
        };
        let Some(owner) = owner.cloned() else { return Ok((Color::Constant([1.0; 3]), None)) };
        let [r, g, b, a] = owner.numbers(keys[0])?.unwrap_or([1.0; 4]).map(|x| x as f32);
        let texture = self.texture(&owner, keys[1], Use::Color, &mut draft.sets)?;
        let color = self.tinted([r, g, b].map(reflectance), texture);
        let opacity = match alpha {
            Alpha::Opaque => None,
            Alpha::Blend => {
                let texture = self.texture(&owner, keys[1], Use::Alpha, &mut draft.sets)?;
                Some(self.alpha(a, texture))
            }
            Alpha::Mask { cutoff } => {
                let usage = Use::Cutout { factor: a.to_bits(), cutoff: cutoff.to_bits() };
                let constant = if a >= cutoff { 1.0 } else { 0.0 };
                let texture = self.texture(&owner, keys[1], usage, &mut draft.sets)?;
                Some(texture.map_or(Scalar::Constant(constant), Scalar::Texture))
            }
        };
        Ok((color, opacity.filter(|opacity| *opacity != Scalar::Constant(1.0))))
    }

    fn emission(&mut self, draft: &mut Draft<'_>) -> Result<Option<Color>, SceneError> {
        let strength = match draft.item.extension("KHR_materials_emissive_strength")? {
            Some(extension) => extension.number_in("emissiveStrength", 1.0, 0.0..=f32::MAX)?,
            None => 1.0,
        };
        let factor = draft.item.numbers("emissiveFactor")?.unwrap_or([0.0; 3]);
        let factor = factor.map(|x| (x as f32 * strength).clamp(0.0, f32::MAX));
        if factor == [0.0; 3] {
            return Ok(None);
        }
        self.has_lamp |= factor.iter().any(|&x| x > 1.0);
        let texture = self.texture(&draft.item, "emissiveTexture", Use::Color, &mut draft.sets)?;
        Ok(Some(self.tinted(factor, texture)))
    }

    /// The material with its coats.
    fn layers(&mut self, draft: &mut Draft<'_>, base_color: Color) -> Result<GltfMaterial, SceneError> {
        let mut material = GltfMaterial { base_color, ..GltfMaterial::default() };
        let item = draft.item.clone();
        if let Some(old) = item.extension("KHR_materials_pbrSpecularGlossiness")? {
            self.specular_glossiness(&old, &mut material)?;
        } else {
            let pbr = draft.pbr.clone();
            let texture = match &pbr {
                Some(pbr) => self.texture(pbr, "metallicRoughnessTexture", Use::Data, &mut draft.sets)?,
                None => None,
            };
            let factor = |key| pbr.as_ref().map_or(Ok(1.0), |pbr| pbr.number_in(key, 1.0, 0.0..=1.0));
            material.metallic = self.channel(factor("metallicFactor")?, texture, 2);
            material.roughness = self.channel(factor("roughnessFactor")?, texture, 1);
        }
        let extension = |name: &str| item.extension(name);
        if let Some(ior) = extension("KHR_materials_ior")? {
            material.ior = ior.number_in("ior", 1.5, 0.0..=f32::MAX)?;
            if material.ior < 1.0 {
                self.warn(&ior.path, format!("an index of refraction of {}; 1.5 stands in", material.ior));
                material.ior = 1.5;
            }
        }
        if let Some(specular) = extension("KHR_materials_specular")? {
            let texture = self.texture(&specular, "specularTexture", Use::Alpha, &mut draft.sets)?;
            let factor = specular.number_in("specularFactor", 1.0, 0.0..=1.0)?;
            material.specular = self.alpha(factor, texture);
            let texture = self.texture(&specular, "specularColorTexture", Use::Color, &mut draft.sets)?;
            let factor = specular.numbers("specularColorFactor")?.unwrap_or([1.0; 3]);
            material.specular_color = self.tinted(factor.map(positive), texture);
        }
        if let Some(coat) = extension("KHR_materials_clearcoat")? {
            let texture = self.texture(&coat, "clearcoatTexture", Use::Data, &mut draft.sets)?;
            let factor = coat.number_in("clearcoatFactor", 0.0, 0.0..=1.0)?;
            material.clearcoat = self.channel(factor, texture, 0);
            let texture = self.texture(&coat, "clearcoatRoughnessTexture", Use::Data, &mut draft.sets)?;
            let factor = coat.number_in("clearcoatRoughnessFactor", 0.0, 0.0..=1.0)?;
            material.clearcoat_roughness = self.channel(factor, texture, 1);
            if coat.get("clearcoatNormalTexture").is_some() {
                self.warn(
                    &coat.at("clearcoatNormalTexture"),
                    "not read; the coat has the normals of the base",
                );
            }
        }
        if let Some(sheen) = extension("KHR_materials_sheen")? {
            let texture = self.texture(&sheen, "sheenColorTexture", Use::Color, &mut draft.sets)?;
            let factor = sheen.numbers("sheenColorFactor")?.unwrap_or([0.0; 3]);
            material.sheen_color = self.tinted(factor.map(reflectance), texture);
            let texture = self.texture(&sheen, "sheenRoughnessTexture", Use::Alpha, &mut draft.sets)?;
            let factor = sheen.number_in("sheenRoughnessFactor", 0.0, 0.0..=1.0)?;
            material.sheen_roughness = self.alpha(factor, texture);
        }
        if let Some(transmission) = extension("KHR_materials_transmission")? {
            let texture = self.texture(&transmission, "transmissionTexture", Use::Data, &mut draft.sets)?;
            let factor = transmission.number_in("transmissionFactor", 0.0, 0.0..=1.0)?;
            material.transmission = self.channel(factor, texture, 0);
        }
        if let Some(volume) = extension("KHR_materials_volume")? {
            material.thin = volume.number_in("thicknessFactor", 0.0, 0.0..=f32::MAX)? == 0.0;
            let distance = volume.number_in("attenuationDistance", f32::INFINITY, 0.0..=f32::INFINITY)?;
            let color = volume.numbers("attenuationColor")?.unwrap_or([1.0; 3]).map(reflectance);
            if !material.thin
                && material.transmits()
                && distance.is_finite()
                && distance > 0.0
                && color != [1.0; 3]
            {
                material.attenuation = Some((distance, color));
            }
        }
        Ok(material)
    }

    /// The older model: a diffuse colour, and the reflectance at normal incidence.
    fn specular_glossiness(&mut self, old: &Item<'_>, material: &mut GltfMaterial) -> Result<(), SceneError> {
        let specular: Rgb = old.numbers("specularFactor")?.unwrap_or([1.0; 3]).map(reflectance);
        let glossiness = old.number_in("glossinessFactor", 1.0, 0.0..=1.0)?;
        material.metallic = Scalar::Constant(0.0);
        material.roughness = Scalar::Constant(1.0 - glossiness);
        // of the index of refraction 1.5
        material.specular_color = Color::Constant(specular.map(|f0| f0 / 0.04));
        if old.get("specularGlossinessTexture").is_some() {
            self.warn(&old.at("specularGlossinessTexture"), "not read; the factors count");
        }
        Ok(())
    }

    /// `material` under the normal map, where there is one.
    fn normal_map(&mut self, draft: &mut Draft<'_>, material: MaterialId) -> Result<MaterialId, SceneError> {
        let Some(info) = draft.item.object("normalTexture")? else { return Ok(material) };
        let texture = self.texture(&draft.item, "normalTexture", Use::Data, &mut draft.sets)?;
        let Some(texture) = texture else { return Ok(material) };
        let scale = info.number_in("scale", 1.0, f32::MIN..=f32::MAX)?;
        let map = NormalMap::Tangent { normal: Color::Texture(texture), scale };
        let kind = MaterialKind::Perturbed { map, flip_invalid: true, shadowing: true, inner: material };
        Ok(self.material(&draft.name, kind))
    }
}

fn alpha_mode(item: &Item<'_>) -> Result<Alpha, SceneError> {
    Ok(match item.string("alphaMode")? {
        None | Some("OPAQUE") => Alpha::Opaque,
        Some("MASK") => Alpha::Mask { cutoff: item.number_in("alphaCutoff", 0.5, 0.0..=f32::MAX)? },
        Some("BLEND") => Alpha::Blend,
        Some(other) => {
            let problem = format!("unknown mode \"{}\"", other.chars().take(40).collect::<String>());
            return Err(item.error("alphaMode", problem, "OPAQUE, MASK and BLEND are known"));
        }
    })
}

/// Into \[0, 1\].
fn reflectance<T: Into<f64>>(x: T) -> f32 {
    (x.into() as f32).clamp(0.0, 1.0)
}

fn positive(x: f64) -> f32 {
    (x as f32).clamp(0.0, f32::MAX)
}
