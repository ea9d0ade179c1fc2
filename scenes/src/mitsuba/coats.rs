//! `coating` and `roughcoating` of Mitsuba 0.x.

use super::Reader;
use super::bsdfs::{ior, width};
use super::object::Object;
use crate::spectrum::Quantity;
use crate::{Coat, MaterialId, MaterialKind, SceneError};

impl Reader<'_> {
    /// The material with its coat, or the material that stands in.
    pub(super) fn coated(
        &mut self,
        object: &Object<'_>,
        kind: &str,
    ) -> Result<Result<MaterialId, MaterialKind>, SceneError> {
        let inner = self.only_bsdf(object)?;
        object.without_effect(&["sample_visible"]);
        let default = Coat::default();
        let facets = if kind == "roughcoating" {
            Some((self.distribution(object)?, width(object, "alpha")?))
        } else {
            None
        };
        let coat = Coat {
            facets,
            int_ior: ior(object, "int_ior", 1.5046)?,
            ext_ior: ior(object, "ext_ior", 1.000277)?,
            thickness: object
                .float_where("thickness", 1.0, "at least 0", |t| t >= 0.0 && (t as f32).is_finite())?
                as f32,
            sigma_a: self.color(object, "sigma_a", Quantity::Ratio, default.sigma_a)?,
            specular_reflectance: self.color(
                object,
                "specular_reflectance",
                Quantity::Reflectance,
                default.specular_reflectance,
            )?,
        };
        let message = if self.scene.any_material(inner, MaterialKind::lets_through) {
            "a coat over what lets light through is left out"
        } else if self.scene.any_material(inner, |kind| matches!(kind, MaterialKind::Coated { .. })) {
            "a coat over another coat is left out"
        } else {
            return Ok(Err(MaterialKind::Coated { coat, inner }));
        };
        self.warn(object.id, message);
        Ok(Ok(inner))
    }
}
