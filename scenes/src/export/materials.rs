//! `<bsdf>`s.

use super::{ExportError, Writer};
use crate::{
    Color, ConductorIor, Distribution, Material, MaterialId, MaterialKind, NormalMap, Scalar, SceneError,
    TextureId, TextureKind,
};

impl Writer<'_> {
    /// All materials that shapes need, each before those that refer to it.
    pub(super) fn materials(&mut self) -> Result<(), ExportError> {
        let mut written = vec![false; self.scene.materials.len()];
        for shape in &self.scene.shapes {
            self.material(shape.material, &mut written)?;
        }
        Ok(())
    }

    fn material(&mut self, id: MaterialId, written: &mut [bool]) -> Result<(), ExportError> {
        let id = self.seen(id);
        if std::mem::replace(&mut written[id.0 as usize], true) {
            return Ok(());
        }
        let material = &self.scene.materials[id.0 as usize];
        let kind = &material.kind;
        for inner in kind.inner() {
            self.material(inner, written)?;
        }
        let name = material_id(id);
        self.xml.open("bsdf", &[("type", plugin(kind)), ("id", &name)]);
        self.parameters(material)?;
        self.xml.close("bsdf");
        Ok(())
    }

    /// A reference to a material.
    pub(super) fn material_ref(&mut self, id: MaterialId) {
        let id = material_id(self.seen(id));
        self.xml.leaf("ref", &[("id", &id)]);
    }

    /// What a material shows: that inside a bump map without slopes, which Mitsuba refuses, else itself.
    fn seen(&self, mut id: MaterialId) -> MaterialId {
        while let MaterialKind::Perturbed { map: NormalMap::Bump { height, .. }, inner, .. } =
            &self.scene.materials[id.0 as usize].kind
        {
            match height {
                Scalar::Texture(TextureId(texture))
                    if matches!(self.scene.textures[*texture as usize].kind, TextureKind::Bitmap { .. }) =>
                {
                    break;
                }
                _ => id = *inner,
            }
        }
        id
    }

    /// A weighted sum, which Mitsuba 3 has for two only, as blends in one another; what the weights lack to 1 is black.
    fn mixture(&mut self, parts: &[(f32, MaterialId)], whole: f32) -> Result<(), ExportError> {
        let Some((&(weight, inner), others)) = parts.split_last() else {
            return self.color("reflectance", Color::Constant([0.0; 3]));
        };
        let share = if whole > 0.0 { (weight / whole).clamp(0.0, 1.0) } else { 1.0 };
        self.xml.float("weight", share);
        let kind = if others.is_empty() { "diffuse" } else { "blendbsdf" };
        self.xml.open("bsdf", &[("type", kind)]);
        self.mixture(others, whole - weight)?;
        self.xml.close("bsdf");
        self.material_ref(inner);
        Ok(())
    }

    fn parameters(&mut self, material: &Material) -> Result<(), ExportError> {
        match &material.kind {
            MaterialKind::Diffuse { reflectance } => self.color("reflectance", *reflectance),
            MaterialKind::Conductor { ior, specular_reflectance } => {
                self.conductor(ior)?;
                self.color("specular_reflectance", *specular_reflectance)
            }
            MaterialKind::RoughConductor { distribution, alpha_u, alpha_v, ior, specular_reflectance } => {
                self.facets(*distribution, *alpha_u, *alpha_v)?;
                self.conductor(ior)?;
                self.color("specular_reflectance", *specular_reflectance)
            }
            MaterialKind::Dielectric { int_ior, ext_ior, specular_reflectance, specular_transmittance }
            | MaterialKind::ThinDielectric {
                int_ior,
                ext_ior,
                specular_reflectance,
                specular_transmittance,
            } => self.glass([*int_ior, *ext_ior], *specular_reflectance, *specular_transmittance),
            MaterialKind::Plastic {
                int_ior,
                ext_ior,
                diffuse_reflectance,
                specular_reflectance,
                nonlinear,
            } => self.coated([*int_ior, *ext_ior], *diffuse_reflectance, *specular_reflectance, *nonlinear),
            MaterialKind::RoughPlastic {
                distribution,
                alpha,
                int_ior,
                ext_ior,
                diffuse_reflectance,
                specular_reflectance,
                nonlinear,
            } => {
                self.distribution(*distribution);
                self.xml.float("alpha", *alpha);
                self.coated([*int_ior, *ext_ior], *diffuse_reflectance, *specular_reflectance, *nonlinear)
            }
            MaterialKind::RoughDielectric {
                distribution,
                alpha_u,
                alpha_v,
                int_ior,
                ext_ior,
                specular_reflectance,
                specular_transmittance,
            } => {
                if int_ior != ext_ior {
                    self.facets(*distribution, *alpha_u, *alpha_v)?;
                }
                self.glass([*int_ior, *ext_ior], *specular_reflectance, *specular_transmittance)
            }
            MaterialKind::RoughDiffuse { .. } => Err(no_counterpart(material, "make it diffuse")),
            MaterialKind::Phong { .. } | MaterialKind::Ward { .. } => {
                Err(no_counterpart(material, "make it roughplastic"))
            }
            MaterialKind::Coated { .. } => {
                Err(no_counterpart(material, "use the bsdf inside, or make it principled with a clearcoat"))
            }
            MaterialKind::Principled(p) => self.principled(p),
            MaterialKind::PrincipledThin(p) => self.principled_thin(p),
            MaterialKind::Gltf(_) => unreachable!("others are in their place"),
            MaterialKind::TwoSided { front, back } => {
                self.material_ref(*front);
                if back != front {
                    self.material_ref(*back);
                }
                Ok(())
            }
            MaterialKind::Null => Ok(()),
            MaterialKind::Mask { opacity, inner } => {
                self.scalar("opacity", *opacity)?;
                self.material_ref(*inner);
                Ok(())
            }
            MaterialKind::Blend { weight, first, second } => {
                self.scalar("weight", *weight)?;
                self.material_ref(*first);
                self.material_ref(*second);
                Ok(())
            }
            MaterialKind::Mixture { parts } => self.mixture(parts, 1.0),
            MaterialKind::Perturbed { map, flip_invalid, shadowing, inner } => {
                match map {
                    NormalMap::Normal(color) => self.color("normalmap", *color)?,
                    NormalMap::Tangent { normal, scale } => self.tangent_map(*normal, *scale)?,
                    NormalMap::Bump { height, scale } => {
                        self.scalar("height", *height)?;
                        self.xml.float("scale", *scale);
                    }
                }
                self.xml.value("boolean", "flip_invalid_normals", &flip_invalid.to_string());
                self.xml.value("boolean", "use_shadowing_function", &shadowing.to_string());
                self.material_ref(*inner);
                Ok(())
            }
        }
    }

    fn distribution(&mut self, distribution: Distribution) {
        let word = match distribution {
            Distribution::Beckmann => "beckmann",
            Distribution::Ggx => "ggx",
        };
        self.xml.value("string", "distribution", word);
    }

    fn facets(
        &mut self,
        distribution: Distribution,
        alpha_u: Scalar,
        alpha_v: Scalar,
    ) -> Result<(), ExportError> {
        self.distribution(distribution);
        self.scalar("alpha_u", alpha_u)?;
        self.scalar("alpha_v", alpha_v)
    }

    fn iors(&mut self, [int_ior, ext_ior]: [f32; 2]) {
        self.xml.float("int_ior", int_ior);
        self.xml.float("ext_ior", ext_ior);
    }

    /// `iors`: inside and outside.
    fn glass(&mut self, iors: [f32; 2], reflected: Color, transmitted: Color) -> Result<(), ExportError> {
        self.iors(iors);
        self.color("specular_reflectance", reflected)?;
        self.color("specular_transmittance", transmitted)
    }

    fn conductor(&mut self, ior: &Option<ConductorIor>) -> Result<(), ExportError> {
        match ior {
            Some(ConductorIor { eta, k }) => {
                self.color("eta", *eta)?;
                self.color("k", *k)
            }
            None => {
                self.xml.value("string", "material", "none");
                Ok(())
            }
        }
    }

    fn coated(
        &mut self,
        iors: [f32; 2],
        diffuse: Color,
        specular: Color,
        nonlinear: bool,
    ) -> Result<(), ExportError> {
        self.iors(iors);
        self.color("diffuse_reflectance", diffuse)?;
        self.color("specular_reflectance", specular)?;
        self.xml.value("boolean", "nonlinear", &nonlinear.to_string());
        Ok(())
    }
}

fn material_id(MaterialId(id): MaterialId) -> String {
    format!("material_{id}")
}

/// A model that only Mitsuba 0.x has.
fn no_counterpart(material: &Material, help: &str) -> ExportError {
    let (element, kind) = (format!("bsdf \"{}\"", material.name), plugin(&material.kind));
    SceneError::at(&material.place, &element, format!("Mitsuba 3 has no {kind}"), help).into()
}

fn plugin(kind: &MaterialKind) -> &'static str {
    match kind {
        MaterialKind::Diffuse { .. } => "diffuse",
        MaterialKind::Conductor { .. } => "conductor",
        MaterialKind::RoughConductor { .. } => "roughconductor",
        MaterialKind::Dielectric { .. } => "dielectric",
        MaterialKind::Plastic { .. } => "plastic",
        MaterialKind::RoughPlastic { .. } => "roughplastic",
        // Mitsuba refuses a rough boundary between equal indices, which does what this does.
        MaterialKind::RoughDielectric { int_ior, ext_ior, .. } if int_ior == ext_ior => "thindielectric",
        MaterialKind::RoughDielectric { .. } => "roughdielectric",
        MaterialKind::ThinDielectric { .. } => "thindielectric",
        MaterialKind::RoughDiffuse { .. } => "roughdiffuse",
        MaterialKind::Phong { .. } => "phong",
        MaterialKind::Ward { .. } => "ward",
        MaterialKind::Coated { coat, .. } if coat.facets.is_some() => "roughcoating",
        MaterialKind::Coated { .. } => "coating",
        MaterialKind::Principled(_) => "principled",
        MaterialKind::PrincipledThin(_) => "principledthin",
        MaterialKind::Gltf(_) => unreachable!("others are in their place"),
        MaterialKind::TwoSided { .. } => "twosided",
        MaterialKind::Null => "null",
        MaterialKind::Mask { .. } => "mask",
        MaterialKind::Blend { .. } => "blendbsdf",
        MaterialKind::Mixture { parts } if parts.is_empty() => "diffuse",
        MaterialKind::Mixture { .. } => "blendbsdf",
        MaterialKind::Perturbed { map: NormalMap::Normal(_) | NormalMap::Tangent { .. }, .. } => "normalmap",
        MaterialKind::Perturbed { map: NormalMap::Bump { .. }, .. } => "bumpmap",
    }
}
