//! The `<integrator>`: its depth, whatever it is.

use super::Reader;
use super::document::ElementId;
use super::object::Object;
use crate::{Integrator, SceneError};

/// Integrators that hold another one, which is what counts.
const WRAPPERS: &[&str] = &["aov", "moment", "adaptive"];

/// Parameters that choose how to sample, not what: paths have the same expectation.
const WITHOUT_EFFECT: &[&str] = &[
    "emitter_samples",
    "bsdf_samples",
    "samples_per_pass",
    "block_size",
    "timeout",
    "aovs",
    "sampling_budget",
    "russian_roulette",
];

impl Reader<'_> {
    /// Reads the integrator. One that limpid lacks is replaced by paths, with a note.
    pub(super) fn integrator(&mut self, id: ElementId) -> Result<(), SceneError> {
        let object = Object::new(self.document, id);
        let kind = object.kind()?;
        let nested = object.nested("integrator")?;
        object.without_effect(WITHOUT_EFFECT);
        if let (true, Some(&(inner, _))) = (WRAPPERS.contains(&kind), nested.first()) {
            self.warn(
                id,
                format!("{kind}: rendered with the integrator inside; layers are chosen with --layers"),
            );
            object.finish(&mut self.warnings);
            return self.nested(id, |reader| reader.integrator(inner));
        }
        let bounds = [-1, i64::from(u32::MAX)];
        let max_depth = object.integer("max_depth", bounds)?.filter(|depth| *depth >= 0);
        let rr_depth = object.integer("rr_depth", bounds)?;
        let mut integrator = Integrator {
            kind: kind.into(),
            max_depth: max_depth.map(|depth| depth as u32),
            hide_emitters: object.boolean("hide_emitters", false)?,
            ..Integrator::default()
        };
        if let Some(depth) = rr_depth {
            // −1 is "never" in old files
            integrator.rr_depth = u32::try_from(depth).unwrap_or(u32::MAX);
        }
        if object.boolean("strict_normals", false)? {
            self.warn(
                id,
                "strict_normals is not honoured: shading normals are not checked against the surface",
            );
        }
        match kind {
            "path" => object.finish(&mut self.warnings),
            "direct" => {
                integrator.max_depth = Some(2);
                object.finish(&mut self.warnings);
            }
            _ => {
                // what its parameters mean is not known, so that none is "unused"
                object.all_without_effect();
                self.warn(id, format!("{}: rendered with path", super::value::shorten(kind)));
            }
        }
        self.scene.integrator = integrator;
        Ok(())
    }
}
