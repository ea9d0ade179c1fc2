//! Scattering models of both generations, and those that change others.

use super::Names::{New, Old};
use super::{Means, Parameter, Plugin, idle, is, sets};

/// A ball seen from outside and a tilted plate seen from behind.
pub const FRAME: &str = r#"@eye@light<shape type="rectangle"><transform name="to_world"><scale value="3"/></transform><bsdf type="twosided"><bsdf type="diffuse"/></bsdf></shape>
<shape type="sphere"><float name="radius" value="0.7"/><point name="center" x="0" y="0" z="0.75"/>{}</shape>
<shape type="rectangle"><transform name="to_world"><scale value="0.7"/><rotate x="1" angle="-120"/><translate x="1.2" z="0.7"/></transform>{}</shape>"#;

const MIRRORED: Parameter = sets(
    r#"<rgb name="specular_reflectance" value="0.9 0.5 0.2"/>"#,
    "specular_reflectance: Constant([0.9, 0.5, 0.2])",
);
const SPECULAR_TEXTURE: Parameter = sets(
    r#"<texture name="specular_reflectance" type="checkerboard"/>"#,
    "specular_reflectance: Texture(TextureId(0))",
);
const THROUGH: Parameter = sets(
    r#"<rgb name="specular_transmittance" value="0.9 0.5 0.2"/>"#,
    "specular_transmittance: Constant([0.9, 0.5, 0.2])",
);
const INSIDE: Parameter = sets(r#"<float name="int_ior" value="1.7"/>"#, "int_ior: 1.7");
const INSIDE_NAMED: Parameter = sets(r#"<string name="int_ior" value="diamond"/>"#, "int_ior: 2.419");
const OUTSIDE: Parameter = sets(r#"<float name="ext_ior" value="1.2"/>"#, "ext_ior: 1.2");
const OUTSIDE_NAMED: Parameter = sets(r#"<string name="ext_ior" value="water"/>"#, "ext_ior: 1.333");
const DIFFUSE: Parameter = sets(
    r#"<rgb name="diffuse_reflectance" value="0.7 0.3 0.1"/>"#,
    "diffuse_reflectance: Constant([0.7, 0.3, 0.1])",
);
const DIFFUSE_TEXTURE: Parameter = sets(
    r#"<texture name="diffuse_reflectance" type="checkerboard"/>"#,
    "diffuse_reflectance: Texture(TextureId(0))",
);
const NONLINEAR: Parameter = sets(r#"<boolean name="nonlinear" value="true"/>"#, "nonlinear: true");
const GGX: Parameter = sets(r#"<string name="distribution" value="ggx"/>"#, "distribution: Ggx");
const BECKMANN: Parameter = idle(r#"<string name="distribution" value="beckmann"/>"#);
const OLD_PHONG: Parameter =
    idle(r#"<string name="distribution" value="phong"/>"#).warned("beckmann of the same alpha");
/// Used as it is, not squared.
const WIDTH: Parameter =
    sets(r#"<float name="alpha" value="0.3"/>"#, "alpha_u: Constant(0.3), alpha_v: Constant(0.3)");
const WIDTH_U: Parameter =
    sets(r#"<float name="alpha_u" value="0.3"/>"#, "alpha_u: Constant(0.3), alpha_v: Constant(0.1)");
const WIDTH_V: Parameter =
    sets(r#"<float name="alpha_v" value="0.4"/>"#, "alpha_u: Constant(0.1), alpha_v: Constant(0.4)");
const WIDTH_TEXTURE: Parameter = sets(
    r#"<texture name="alpha" type="bitmap"><string name="filename" value="share.exr"/></texture>"#,
    "alpha_u: Texture(TextureId(0)), alpha_v: Texture(TextureId(0))",
);
const WIDTH_TEXTURES: Parameter = sets(
    r#"<texture name="alpha_u" type="checkerboard"/><texture name="alpha_v" type="bitmap"><string name="filename" value="share.exr"/></texture>"#,
    "alpha_u: Texture(TextureId(0)), alpha_v: Texture(TextureId(1))",
);
const COPPER: Parameter = sets(
    r#"<string name="material" value="Cu"/>"#,
    "ConductorIor { eta: Constant([0.2010055, 0.9237495, 1.102215]), k: Constant([",
);
const NUMBERS: Parameter = sets(
    r#"<rgb name="eta" value="0.2, 0.9, 1.1"/><rgb name="k" value="3.9, 2.5, 2.1"/>"#,
    "ConductorIor { eta: Constant([0.2, 0.9, 1.1]), k: Constant([3.9, 2.5, 2.1]) }",
);
const OUTSIDE_METAL: Parameter = is(
    r#"<rgb name="eta" value="0.4, 1.8, 2.2"/><rgb name="k" value="4"/><float name="ext_eta" value="2"/>"#,
    r#"<rgb name="eta" value="0.2, 0.9, 1.1"/><rgb name="k" value="2"/>"#,
)
.warned("Mitsuba 3 refuses");

/// All of them.
pub const BSDFS: &[Plugin] = &[
    Plugin::new(
        FRAME,
        "bsdf",
        "diffuse",
        Means::Keeps("material: MaterialId(4)"), // the ball and the plate have one each now, of what was there
        &[
            sets(r#"<rgb name="reflectance" value="0.8 0.2 0.1"/>"#, "reflectance: Constant([0.8, 0.2, 0.1])"),
            sets(r#"<texture name="reflectance" type="checkerboard"/>"#, "reflectance: Texture(TextureId(0))"),
            sets(r#"<rgb name="diffuse_reflectance" value="0.8 0.2 0.1"/>"#, "reflectance: Constant([0.8, 0.2, 0.1])").only(Old),
            sets(r#"<texture name="diffuse_reflectance" type="checkerboard"/>"#, "reflectance: Texture(TextureId(0))").only(Old),
        ],
    ),
    Plugin::new(FRAME, "bsdf", "twosided", Means::Shows("TwoSided { front: MaterialId(3), back: MaterialId(3) }"), &[])
        .given(r#"<bsdf type="plastic"/>"#),
    Plugin::new(FRAME, "bsdf", "twosided", Means::Shows("TwoSided { front: MaterialId(3), back: MaterialId(4) }"), &[])
        .given(r#"<bsdf type="plastic"/><bsdf type="diffuse"/>"#),
    Plugin::new(FRAME, "bsdf", "twosided", Means::Shows("Dielectric"), &[])
        .given(r#"<bsdf type="dielectric"/>"#)
        .warned("twosided is left out"),
    Plugin::new(FRAME, "bsdf", "twosided", Means::Refused("0 bsdfs inside"), &[]),
    Plugin::new(
        FRAME,
        "bsdf",
        "roughconductor",
        Means::Shows("RoughConductor { distribution: Beckmann, alpha_u: Constant(0.1), alpha_v: Constant(0.1), ior: None"),
        &[COPPER, NUMBERS, idle(r#"<string name="material" value="none"/>"#)],
    )
    .only(New),
    Plugin::new(
        FRAME,
        "bsdf",
        "roughconductor",
        Means::Shows("RoughConductor { distribution: Beckmann, alpha_u: Constant(0.1), alpha_v: Constant(0.1), ior: None"),
        &[
            WIDTH,
            WIDTH_U,
            WIDTH_V,
            WIDTH_TEXTURE,
            WIDTH_TEXTURES,
            GGX,
            BECKMANN,
            OLD_PHONG,
            MIRRORED,
            SPECULAR_TEXTURE,
            idle(r#"<boolean name="sample_visible" value="false"/>"#),
        ],
    )
    .given(r#"<string name="material" value="none"/>"#),
    Plugin::new(
        FRAME,
        "bsdf",
        "roughconductor",
        // the default of 0.x
        Means::Shows("ior: Some(ConductorIor { eta: Constant([0.2010055, 0.9237495, 1.102215])"),
        &[NUMBERS, OUTSIDE_METAL, sets(r#"<string name="material" value="none"/>"#, "ior: None, specular")],
    )
    .only(Old),
    Plugin::new(
        FRAME,
        "bsdf",
        "conductor",
        Means::Shows("Conductor { ior: None, specular_reflectance: Constant([1.0, 1.0, 1.0]) }"),
        &[COPPER, NUMBERS, OUTSIDE_METAL, MIRRORED, SPECULAR_TEXTURE],
    )
    .only(New),
    Plugin::new(
        FRAME,
        "bsdf",
        "conductor",
        Means::Shows("Conductor { ior: Some("),
        &[
            // written for a rough one, which this is not
            idle(r#"<float name="alpha" value="0.3"/>"#).warned("unused parameter \"alpha\""),
            idle(r#"<string name="distribution" value="ggx"/>"#).warned("unused parameter \"distribution\""),
        ],
    )
    .given(r#"<string name="material" value="Au"/>"#),
    Plugin::new(FRAME, "bsdf", "conductor", Means::Refused("unknown metal \"Xy\""), &[])
        .given(r#"<string name="material" value="Xy"/>"#),
    Plugin::new(
        FRAME,
        "bsdf",
        "dielectric",
        Means::Shows("Dielectric { int_ior: 1.5046, ext_ior: 1.000277, specular_reflectance: Constant([1.0, 1.0, 1.0]), specular_transmittance: Constant([1.0, 1.0, 1.0]) }"),
        &[
            INSIDE,
            INSIDE_NAMED,
            OUTSIDE,
            OUTSIDE_NAMED,
            MIRRORED,
            THROUGH,
            idle(r#"<float name="alpha" value="0.3"/>"#).warned("unused parameter \"alpha\""),
            idle(r#"<string name="distribution" value="ggx"/>"#).warned("unused parameter \"distribution\""),
        ],
    ),
    Plugin::new(
        FRAME,
        "bsdf",
        "roughdielectric",
        Means::Shows("RoughDielectric { distribution: Beckmann, alpha_u: Constant(0.1), alpha_v: Constant(0.1), int_ior: 1.5046, ext_ior: 1.000277"),
        &[
            WIDTH,
            WIDTH_U,
            WIDTH_TEXTURE,
            GGX,
            INSIDE,
            INSIDE_NAMED,
            OUTSIDE,
            THROUGH,
            MIRRORED,
            SPECULAR_TEXTURE,
        ],
    ),
    Plugin::new(
        FRAME,
        "bsdf",
        "thindielectric",
        Means::Shows("ThinDielectric { int_ior: 1.5046, ext_ior: 1.000277"),
        &[INSIDE, OUTSIDE_NAMED, MIRRORED, THROUGH],
    ),
    Plugin::new(
        FRAME,
        "bsdf",
        "plastic",
        Means::Shows("Plastic { int_ior: 1.49, ext_ior: 1.000277, diffuse_reflectance: Constant([0.5, 0.5, 0.5]), specular_reflectance: Constant([1.0, 1.0, 1.0]), nonlinear: false }"),
        &[DIFFUSE, DIFFUSE_TEXTURE, INSIDE, OUTSIDE, MIRRORED, NONLINEAR],
    ),
    Plugin::new(
        FRAME,
        "bsdf",
        "roughplastic",
        Means::Shows("RoughPlastic { distribution: Beckmann, alpha: 0.1, int_ior: 1.49, ext_ior: 1.000277, diffuse_reflectance: Constant([0.5, 0.5, 0.5])"),
        &[
            sets(r#"<float name="alpha" value="0.3"/>"#, "alpha: 0.3"),
            DIFFUSE,
            DIFFUSE_TEXTURE,
            GGX,
            INSIDE_NAMED,
            OUTSIDE,
            MIRRORED,
            NONLINEAR,
            idle(r#"<rgb name="reflectance" value="0.2"/>"#).warned("unused parameter \"reflectance\""),
        ],
    ),
    Plugin::new(
        FRAME,
        "bsdf",
        "mask",
        Means::Shows("Mask { opacity: Constant(0.5), inner: MaterialId(3) }"),
        &[
            sets(r#"<float name="opacity" value="0.8"/>"#, "opacity: Constant(0.8)"),
            // its luminance
            sets(r#"<rgb name="opacity" value="1 0 0"/>"#, "opacity: Constant(0.212639)"),
            sets(
                r#"<texture name="opacity" type="bitmap"><string name="filename" value="share.exr"/></texture>"#,
                "opacity: Texture(TextureId(0))",
            ),
        ],
    )
    .given(r#"<bsdf type="diffuse"/>"#),
    Plugin::new(FRAME, "bsdf", "mask", Means::Shows("Mask { opacity: Constant(0.5)"), &[])
        .given(r#"<bsdf type="twosided"><bsdf type="plastic"/></bsdf>"#),
    Plugin::new(
        FRAME,
        "bsdf",
        "bumpmap",
        Means::Shows("map: Bump { height: Texture(TextureId(0)), scale: 1.0 }"),
        &[sets(r#"<float name="scale" value="3"/>"#, "scale: 3.0")],
    )
    .given(r#"<texture name="floor_tiles_bumpmap" type="bitmap"><string name="filename" value="height.exr"/></texture><bsdf type="diffuse"/>"#),
    Plugin::new(FRAME, "bsdf", "bumpmap", Means::Shows("map: Bump"), &[])
        .given(r#"<texture name="map" type="bitmap"><string name="filename" value="height.exr"/></texture><bsdf type="twosided"><bsdf type="diffuse"/></bsdf>"#),
    Plugin::new(FRAME, "bsdf", "normalmap", Means::Shows("map: Normal(Texture(TextureId(0)))"), &[])
        .given(r#"<texture name="normalmap" type="bitmap"><string name="filename" value="normal.exr"/><boolean name="raw" value="true"/></texture><bsdf type="diffuse"/>"#),
    Plugin::new(
        FRAME,
        "bsdf",
        "blendbsdf",
        Means::Shows("Blend { weight: Constant(0.5), first: MaterialId(3), second: MaterialId(4) }"),
        &[
            sets(r#"<float name="weight" value="0.2"/>"#, "weight: Constant(0.2)"),
            sets(
                r#"<texture name="weight" type="bitmap"><string name="filename" value="share.exr"/></texture>"#,
                "weight: Texture(TextureId(0))",
            ),
        ],
    )
    .given(r#"<bsdf type="diffuse" name="bsdf_0"/><bsdf type="plastic" name="bsdf_1"/>"#),
    Plugin::new(FRAME, "bsdf", "blendbsdf", Means::Refused("1 bsdfs inside"), &[]).given(r#"<bsdf type="diffuse"/>"#),
    Plugin::new(
        FRAME,
        "bsdf",
        "mixturebsdf",
        Means::Shows("Mixture { parts: [(0.25, MaterialId(3)), (0.5, MaterialId(4))] }"),
        &[idle(r#"<boolean name="ensure_energy_conservation" value="true"/>"#)],
    )
    .given(r#"<string name="weights" value="0.25, 0.5"/><bsdf type="diffuse"/><bsdf type="plastic"/>"#)
    .warned("Mitsuba 3 refuses"),
    Plugin::new(FRAME, "bsdf", "null", Means::Shows("kind: Null"), &[]),
    Plugin::new(
        FRAME,
        "bsdf",
        "phong",
        Means::Shows("Phong { exponent: Constant(30.0), diffuse_reflectance: Constant([0.5, 0.5, 0.5]), specular_reflectance: Constant([0.2, 0.2, 0.2]) }"),
        &[
            sets(r#"<rgb name="specular_reflectance" value="0.3 0.1 0.2"/>"#, "specular_reflectance: Constant([0.3, 0.1, 0.2])"),
            sets(r#"<float name="exponent" value="80"/>"#, "exponent: Constant(80.0)"),
            DIFFUSE,
            DIFFUSE_TEXTURE,
        ],
    )
    .warned("Mitsuba 3 refuses"),
    Plugin::new(
        FRAME,
        "bsdf",
        "ward",
        Means::Shows("Ward { variant: Balanced, alpha_u: Constant(0.1), alpha_v: Constant(0.1), diffuse_reflectance: Constant([0.5, 0.5, 0.5])"),
        &[
            DIFFUSE,
            sets(r#"<rgb name="specular_reflectance" value="0.3 0.1 0.2"/>"#, "specular_reflectance: Constant([0.3, 0.1, 0.2])"),
            WIDTH,
        ],
    )
    .warned("Mitsuba 3 refuses"),
    Plugin::new(
        FRAME,
        "bsdf",
        "roughdiffuse",
        Means::Shows("RoughDiffuse { reflectance: Constant([0.5, 0.5, 0.5]), alpha: Constant(0.2), fast_approx: false }"),
        &[
            sets(r#"<rgb name="reflectance" value="0.8 0.2 0.1"/>"#, "reflectance: Constant([0.8, 0.2, 0.1])"),
            sets(r#"<float name="alpha" value="0.5"/>"#, "alpha: Constant(0.5)"),
        ],
    )
    .warned("Mitsuba 3 refuses"),
    Plugin::new(
        FRAME,
        "bsdf",
        "roughcoating",
        Means::Shows("Coat { facets: Some((Beckmann, 0.1)), int_ior: 1.5046, ext_ior: 1.000277, thickness: 1.0"),
        &[
            sets(r#"<float name="alpha" value="0.4"/>"#, "Some((Beckmann, 0.4))"),
            sets(r#"<string name="distribution" value="ggx"/>"#, "Some((Ggx, 0.1))"),
            INSIDE,
            OUTSIDE,
            sets(r#"<rgb name="sigma_a" value="0.1 0.5 0.9"/>"#, "sigma_a: Constant([0.1, 0.5, 0.9])"),
        ],
    )
    .given(r#"<bsdf type="plastic"/>"#)
    .warned("Mitsuba 3 refuses"),
    // out
    Plugin::new(FRAME, "bsdf", "pplastic", Means::Refused("out of scope (polarised)"), &[]),
    Plugin::new(FRAME, "bsdf", "polarizer", Means::Refused("out of scope (polarised)"), &[]),
    Plugin::new(FRAME, "bsdf", "measured_polarized", Means::Refused("out of scope (polarised)"), &[]),
    Plugin::new(FRAME, "bsdf", "simplemicrofacet", Means::Refused("out of scope"), &[]),
    Plugin::new(FRAME, "bsdf", "approxmicrofacet", Means::Refused("out of scope"), &[]),
    Plugin::new(FRAME, "bsdf", "roughconductorGGX", Means::Refused("out of scope"), &[]),
    Plugin::new(FRAME, "bsdf", "roughdielectricGGX", Means::Refused("out of scope"), &[]),
    Plugin::new(FRAME, "bsdf", "hair", Means::Refused("out of scope"), &[]),
    Plugin::new(FRAME, "bsdf", "disneybsdf", Means::Refused("out of scope"), &[]),
    Plugin::new(FRAME, "bsdf", "disneyclearcoat", Means::Refused("out of scope"), &[]),
    Plugin::new(FRAME, "bsdf", "disneydiffuse", Means::Refused("out of scope"), &[]),
    Plugin::new(FRAME, "bsdf", "disneyglass", Means::Refused("out of scope"), &[]),
    Plugin::new(FRAME, "bsdf", "disneymetal", Means::Refused("out of scope"), &[]),
    Plugin::new(FRAME, "bsdf", "disneysheen", Means::Refused("out of scope"), &[]),
    Plugin::new(FRAME, "bsdf", "glass", Means::Refused("out of scope"), &[]),
];
