//! The names of plugins that files in the wild use, and what becomes of each.

use super::document::Element;
use super::value::{shorten, value_error};
use crate::SceneError;
use crate::nearest::suggest;

/// The plugins of one class.
pub(super) struct Class {
    /// The element that holds them.
    pub tag: &'static str,
    /// What is read.
    pub now: &'static [&'static str],
    /// What is replaced by a stand-in, with a warning.
    pub later: &'static [&'static str],
    /// What will not be read, and why.
    pub out: &'static [(&'static str, &'static str)],
}

/// What is to be done with a plugin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Standing {
    Now,
    Later,
}

impl Class {
    /// What is to be done with the plugin of this name; an error if nothing can be.
    pub fn standing(&self, kind: &str, element: &Element) -> Result<Standing, SceneError> {
        if self.now.contains(&kind) {
            return Ok(Standing::Now);
        }
        if self.later.contains(&kind) {
            return Ok(Standing::Later);
        }
        if let Some((_, why)) = self.out.iter().find(|(name, _)| *name == kind) {
            let problem = format!("type \"{kind}\" is out of scope ({why})");
            let help = format!("choose another {}, such as \"{}\"", self.tag, self.now[0]);
            return Err(value_error(element, "type", problem, &help));
        }
        let help = suggest(kind, "types", self.now.iter().chain(self.later).copied());
        Err(value_error(element, "type", format!("unknown type \"{}\"", shorten(kind)), &help))
    }
}

const POLARISED: &str = "polarised";
const PRIVATE: &str = "of a private build";

pub(super) const BSDFS: Class = Class {
    tag: "bsdf",
    now: &[
        "diffuse",
        "conductor",
        "roughconductor",
        "dielectric",
        "roughdielectric",
        "thindielectric",
        "plastic",
        "roughplastic",
        "roughdiffuse",
        "phong",
        "ward",
        "principled",
        "principledthin",
        "twosided",
        "null",
        "mask",
        "blendbsdf",
        "mixturebsdf",
        "normalmap",
        "bumpmap",
        "coating",
        "roughcoating",
    ],
    later: &[],
    out: &[
        ("pplastic", POLARISED),
        ("polarizer", POLARISED),
        ("measured_polarized", POLARISED),
        ("simplemicrofacet", PRIVATE),
        ("approxmicrofacet", PRIVATE),
        ("roughconductorGGX", PRIVATE),
        ("roughdielectricGGX", PRIVATE),
        ("disneybsdf", PRIVATE),
        ("disneyclearcoat", PRIVATE),
        ("disneydiffuse", PRIVATE),
        ("disneyglass", PRIVATE),
        ("disneymetal", PRIVATE),
        ("disneysheen", PRIVATE),
        ("glass", PRIVATE),
        ("hair", "hair"),
    ],
};

pub(super) const TEXTURES: Class = Class {
    tag: "texture",
    now: &["bitmap", "checkerboard", "mesh_attribute", "scale", "rawconstant", "uniform", "srgb"],
    later: &["volume"],
    out: &[],
};

pub(super) const SHAPES: Class = Class {
    tag: "shape",
    now: &[
        "obj",
        "ply",
        "rectangle",
        "cube",
        "sphere",
        "disk",
        "cylinder",
        "serialized",
        "shapegroup",
        "instance",
        "merge",
    ],
    later: &[],
    out: &[
        ("bsplinecurve", "curves"),
        ("linearcurve", "curves"),
        ("sdfgrid", "distance fields"),
        ("Rectangle", "a name in the wrong case: write \"rectangle\""),
        ("Sphere", "a name in the wrong case: write \"sphere\""),
    ],
};

pub(super) const EMITTERS: Class = Class {
    tag: "emitter",
    now: &[
        "area",
        "constant",
        "envmap",
        "point",
        "spot",
        "ies",
        "directional",
        "projector",
        "sunsky",
        "sun",
        "sky",
    ],
    later: &[],
    out: &[],
};

pub(super) const SENSORS: Class =
    Class { tag: "sensor", now: &["perspective", "thinlens", "orthographic"], later: &[], out: &[] };

pub(super) const FILMS: Class = Class { tag: "film", now: &["hdrfilm", "ldrfilm"], later: &[], out: &[] };

pub(super) const FILTERS: Class = Class {
    tag: "rfilter",
    now: &["box", "tent", "gaussian", "mitchell", "catmullrom", "lanczos"],
    later: &[],
    out: &[],
};

pub(super) const SAMPLERS: Class = Class {
    tag: "sampler",
    now: &[
        "independent",
        "ldsampler",
        "orthogonal",
        "sobol",
        "halton",
        "hammersley",
        "multijitter",
        "stratified",
    ],
    later: &["deterministic"],
    out: &[],
};

/// Elements that may stand in a scene.
pub(super) const TOP: &[&str] = &[
    "integrator",
    "sensor",
    "shape",
    "bsdf",
    "texture",
    "emitter",
    "medium",
    "default",
    "include",
    "path",
    "alias",
    "ref",
    "film",
    "sampler",
    "rfilter",
    "phase",
    "volume",
    "spectrum",
];

/// Indices of refraction by name, as Mitsuba 3 knows them (589.3 nm).
pub(super) const NAMED_IORS: &[(&str, f64)] = &[
    ("vacuum", 1.0),
    ("helium", 1.000036),
    ("hydrogen", 1.000132),
    ("air", 1.000277),
    ("carbon dioxide", 1.00045),
    ("water", 1.3330),
    ("acetone", 1.36),
    ("ethanol", 1.361),
    ("carbon tetrachloride", 1.461),
    ("glycerol", 1.4729),
    ("benzene", 1.501),
    ("silicone oil", 1.52045),
    ("bromine", 1.661),
    ("water ice", 1.31),
    ("fused quartz", 1.458),
    ("pyrex", 1.470),
    ("acrylic glass", 1.49),
    ("polypropylene", 1.49),
    ("bk7", 1.5046),
    ("sodium chloride", 1.544),
    ("amber", 1.55),
    ("pet", 1.5750),
    ("diamond", 2.419),
];
