//! `principled` and `principledthin`.

use super::{ExportError, Writer};
use crate::{Principled, PrincipledThin};

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
}
