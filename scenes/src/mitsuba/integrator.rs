//! The `<integrator>`: its depth, whatever it is.

use super::document::ElementId;
use super::object::Object;
use super::{Reader, value};
use crate::{Aov, Integrator, SceneError};

/// What of `aov`'s types there is a layer for.
const AOVS: [(&str, Aov); 5] = [
    ("albedo", Aov::Albedo),
    ("depth", Aov::Depth),
    ("position", Aov::Position),
    ("sh_normal", Aov::ShadingNormal),
    ("shape_index", Aov::ShapeIndex),
];

/// Parameters that choose how to sample, not what: paths have the same expectation.
const WITHOUT_EFFECT: &[&str] = &[
    "emitter_samples",
    "bsdf_samples",
    "shading_samples",
    "samples_per_pass",
    "block_size",
    "timeout",
    "sampling_budget",
    "russian_roulette",
];

impl Reader<'_> {
    /// `name:type` pairs. The layers have names of our own, whatever the file calls them.
    fn aovs(&mut self, object: &Object<'_>) -> Result<Vec<Aov>, SceneError> {
        let Some((list, parameter)) = object.string("aovs")? else { return Ok(Vec::new()) };
        let (mut aovs, mut missing) = (Vec::new(), Vec::new());
        for item in list.split([',', ' ']).map(str::trim).filter(|item| !item.is_empty()) {
            let kind = item.split_once(':').map_or(item, |(_, kind)| kind.trim());
            match AOVS.iter().find(|(name, _)| *name == kind) {
                Some((_, aov)) if aovs.contains(aov) => {}
                Some((_, aov)) => aovs.push(*aov),
                None if missing.len() < 8 => missing.push(value::shorten(kind)),
                None => {}
            }
        }
        if !missing.is_empty() {
            let known: Vec<_> = AOVS.iter().map(|(name, _)| *name).collect();
            let message = format!(
                "no layer is made of {}; there are {}, and more with --layers",
                missing.join(", "),
                known.join(", ")
            );
            self.warn_as(parameter.id, &object.label_of(parameter), message);
        }
        Ok(aovs)
    }

    /// Reads the integrator. One that limpid lacks is replaced by paths, with a note.
    pub(super) fn integrator(&mut self, id: ElementId) -> Result<(), SceneError> {
        let object = Object::new(self.document, id);
        let kind = object.kind()?;
        let nested = object.nested("integrator")?;
        object.without_effect(WITHOUT_EFFECT);
        let aovs = if kind == "aov" { self.aovs(&object)? } else { Vec::new() };
        // aov, moment, stokes, adaptive: what is inside counts
        if let Some(&(inner, _)) = nested.first() {
            if kind != "aov" {
                object.all_without_effect();
                self.warn(id, format!("{kind}: rendered with the integrator inside"));
            }
            object.finish(&mut self.warnings);
            self.nested(id, |reader| reader.integrator(inner))?;
            let all = &mut self.scene.integrator.aovs;
            aovs.into_iter().for_each(|aov| {
                if !all.contains(&aov) {
                    all.push(aov)
                }
            });
            return Ok(());
        }
        let bounds = [-1, i64::from(u32::MAX)];
        let max_depth = object.integer("max_depth", bounds)?.filter(|depth| *depth >= 0);
        let rr_depth = object.integer("rr_depth", bounds)?;
        let mut integrator = Integrator {
            kind: kind.into(),
            max_depth: max_depth.map(|depth| depth as u32),
            aovs,
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
                self.warn(id, format!("{}: rendered with path", value::shorten(kind)));
            }
        }
        self.scene.integrator = integrator;
        Ok(())
    }
}
