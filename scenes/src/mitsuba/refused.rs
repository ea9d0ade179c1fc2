//! What is read here and makes Mitsuba 3.9.1 refuse a file, or show another picture: words of 0.x that have no version-3
//! name, and axes that are not unit.

use super::Reader;
use super::document::{Document, Element};
use super::value;
use crate::Warning;

/// Plugins, each with its element.
const PLUGINS: [(&str, &[&str]); 4] = [
    ("bsdf", &["phong", "ward", "roughdiffuse", "mixturebsdf", "coating", "roughcoating"]),
    ("texture", &["scale"]),
    ("emitter", &["sun", "sky", "ies"]),
    ("sampler", &["sobol", "halton", "hammersley"]),
];

/// Parameters, each with the element or the type of the plugins that they belong to. (Those that limpid has no use for
/// either are warned of one by one.)
const PARAMETERS: [(&str, &[&str]); 8] = [
    ("integrator", &["strict_normals"]),
    ("hdrfilm", &["high_quality_edges", "attach_log", "gamma", "filename"]),
    ("sampler", &["dimension"]),
    ("sphere", &["subdiv"]),
    ("bsdf", &["ext_eta"]),
    ("bitmap", &["gamma"]),
    ("emitter", &["sun_radius_scale"]),
    ("sunsky", &["scale"]),
];

/// Names that are listed: the rest is much the same.
const MAX_LISTED: usize = 8;

/// By how much the square of an axis's length may be off 1: that of `x="0.577" y="0.577" z="0.577"` is by 0.0012.
const UNIT: f64 = 2e-3;

impl Reader<'_> {
    /// Says in one warning, at the first of them, what Mitsuba 3 will not take.
    pub(super) fn note_what_mitsuba_refuses(&mut self) {
        let mut names: Vec<String> = Vec::new();
        let mut first = None;
        for element in &self.document.elements {
            for name in words(self.document, element) {
                first.get_or_insert(element);
                if names.len() <= MAX_LISTED && !names.contains(&name) {
                    names.push(name);
                }
            }
        }
        let Some(first) = first else { return };
        if names.len() > MAX_LISTED {
            names[MAX_LISTED] = "more".into();
        }
        let warning = Warning {
            place: first.place.clone(),
            element: "scene".into(),
            message: format!("Mitsuba 3 refuses {}, which this file has and limpid reads", names.join(", ")),
            unused_parameter: false,
        };
        self.warnings.push((first.id, warning));
    }

    /// Says in one warning, at the first of them, that Mitsuba 3 scales where it turns about an axis that is not unit.
    pub(super) fn note_axes(&mut self) {
        let is_other = |element: &&Element| {
            element.tag == "rotate"
                && value::vector(element, 0.0).is_ok_and(|axis| (axis.length_squared() - 1.0).abs() > UNIT)
        };
        if let Some(first) = self.document.elements.iter().find(is_other) {
            let message = "the axis is not unit: Mitsuba 3 scales with its length, limpid turns alone";
            self.warn(first.id, message);
        }
    }
}

/// The words of an element that Mitsuba 3 does not know.
fn words(document: &Document, element: &Element) -> Vec<String> {
    let kind = element.attribute("type").unwrap_or_default();
    let listed = |list: &[(&str, &[&str])], word: &str| {
        let of_element = |owner: &str| owner == element.tag || owner == kind;
        list.iter().any(|(owner, words)| of_element(owner) && words.contains(&word))
    };
    let mut found = Vec::new();
    if listed(&PLUGINS, kind) {
        found.push(kind.into());
    }
    let value = element.attribute("value").unwrap_or_default();
    match element.tag.as_str() {
        tag @ ("lookAt" | "srgb" | "blackbody") => found.push(format!("<{tag}>")),
        "rgb" if value.trim_start().starts_with('#') => found.push("#rrggbb".into()),
        "spectrum" if element.attribute("type").is_none() && is_triple(value) => {
            found.push("a <spectrum> of three numbers".into());
        }
        _ => {}
    }
    let keys = element.children.iter().map(|&id| document.element(id).key.as_str());
    found.extend(keys.filter(|key| listed(&PARAMETERS, key)).map(String::from));
    found
}

fn is_triple(value: &str) -> bool {
    !value.contains(':') && value.split([',', ' ']).filter(|word| !word.is_empty()).count() == 3
}
