//! `principled` and `principledthin`, also as the nearest that Mitsuba has to glTF's material.

use super::{ExportError, Writer};
use crate::{Color, GltfMaterial, Principled, PrincipledThin, Scalar};

impl Writer<'_> {
    pub(super) fn principled(&mut self, p: &Principled) -> Result<(), ExportError> {
        self.color("base_color", p.base_color)?;
        self.xml.float("eta", p.eta);
        for (name, scalar) in [
            ("roughness", p.roughness),
            ("anisotropic", p.anisotropic),
            ("metallic", p.metallic),
            ("spec_trans", p.spec_trans),
            ("spec_tint", p.spec_tint),
            ("sheen", p.sheen),
            ("sheen_tint", p.sheen_tint),
            ("flatness", p.flatness),
            ("clearcoat", p.clearcoat),
            ("clearcoat_gloss", p.clearcoat_gloss),
        ] {
            self.scalar(name, scalar)?;
        }
        Ok(())
    }

    pub(super) fn principled_thin(&mut self, p: &PrincipledThin) -> Result<(), ExportError> {
        self.color("base_color", p.base_color)?;
        for (name, scalar) in [
            ("roughness", p.roughness),
            ("anisotropic", p.anisotropic),
            ("spec_trans", p.spec_trans),
            ("eta", p.eta),
            ("spec_tint", p.spec_tint),
            ("sheen", p.sheen),
            ("sheen_tint", p.sheen_tint),
            ("flatness", p.flatness),
            ("diff_trans", p.diff_trans),
        ] {
            self.scalar(name, scalar)?;
        }
        Ok(())
    }

    /// Base, metal and transmission; a coat of constant roughness; no sheen, and no colour of the reflection. The weight of
    /// the reflection is that at normal incidence, as an index, where that bends no light and is no factor of metal.
    pub(super) fn gltf(&mut self, p: &GltfMaterial) -> Result<(), ExportError> {
        self.note(
            "glTF's material is written as Mitsuba's principled: sheen and the specular colour are left out, and the weight of \
             the reflection where metal or transmission is mixed in; the coat differs; docs/mitsuba.md measures how far they \
             are apart",
        );
        if p.attenuation.is_some() {
            self.note("what the inside of a glTF material absorbs is left out");
        }
        if p.thin && p.transmits() {
            return self.principled_thin(&PrincipledThin {
                base_color: p.base_color,
                roughness: p.roughness,
                spec_trans: p.transmission,
                eta: Scalar::Constant(p.ior),
                ..PrincipledThin::default()
            });
        }
        let eta = match (p.specular, p.metallic, p.transmission) {
            (Scalar::Constant(weight), Scalar::Constant(0.0), Scalar::Constant(0.0)) if weight < 1.0 => {
                let r = weight.max(0.0).sqrt() * (p.ior - 1.0) / (p.ior + 1.0);
                (1.0 + r) / (1.0 - r)
            }
            _ => p.ior,
        };
        // Mitsuba's coat has a width of 0.1 − 0.099 gloss.
        let gloss = match p.clearcoat_roughness {
            Scalar::Constant(roughness) => ((0.1 - roughness * roughness) / 0.099).clamp(0.0, 1.0),
            Scalar::Texture(_) => 0.0,
        };
        // All of it goes through, and there Mitsuba takes the root of the colour.
        let base_color = match (p.base_color, p.metallic, p.transmission) {
            (Color::Constant(color), Scalar::Constant(0.0), Scalar::Constant(1.0)) => {
                Color::Constant(color.map(|c| c * c))
            }
            (color, ..) => color,
        };
        self.principled(&Principled {
            base_color,
            roughness: p.roughness,
            metallic: p.metallic,
            spec_trans: p.transmission,
            eta,
            clearcoat: p.clearcoat,
            clearcoat_gloss: Scalar::Constant(gloss),
            ..Principled::default()
        })
    }
}
