//! Materials of the table: each with its `<bsdf>`.

use super::Named;

/// All of them.
pub const MATERIALS: &[Named] = &[
    ("diffuse", true, r#"<bsdf type="diffuse"><rgb name="reflectance" value="0.7 0.4 0.2"/></bsdf>"#),
    (
        "diffuse, bitmap",
        false,
        r#"<bsdf type="diffuse"><texture name="reflectance" type="bitmap"><string name="filename" value="color.png"/></texture></bsdf>"#,
    ),
    (
        "diffuse, bitmap nearest, mirrored",
        false,
        r#"<bsdf type="diffuse"><texture name="reflectance" type="bitmap"><string name="filename" value="color.png"/><string name="filter_type" value="nearest"/><string name="wrap_mode" value="mirror"/><transform name="to_uv"><scale value="2.5"/></transform></texture></bsdf>"#,
    ),
    (
        "diffuse, checkerboard",
        false,
        r#"<bsdf type="diffuse"><texture name="reflectance" type="checkerboard"><transform name="to_uv"><scale x="6" y="4"/></transform></texture></bsdf>"#,
    ),
    (
        "twosided of two",
        false,
        r#"<bsdf type="twosided"><bsdf type="diffuse"/><bsdf type="roughconductor"><float name="alpha" value="0.4"/></bsdf></bsdf>"#,
    ),
    ("conductor, none", false, r#"<bsdf type="conductor"/>"#),
    ("conductor, Au", false, r#"<bsdf type="conductor"><string name="material" value="Au"/></bsdf>"#),
    (
        "conductor, eta and k",
        false,
        r#"<bsdf type="conductor"><rgb name="eta" value="0.2 0.9 1.1"/><rgb name="k" value="3.9 2.4 2.2"/></bsdf>"#,
    ),
    (
        "roughconductor, ggx 0.001",
        false,
        r#"<bsdf type="roughconductor"><string name="distribution" value="ggx"/><float name="alpha" value="0.001"/></bsdf>"#,
    ),
    (
        "roughconductor, ggx 0.05",
        false,
        r#"<bsdf type="roughconductor"><string name="distribution" value="ggx"/><string name="material" value="Cu"/><float name="alpha" value="0.05"/></bsdf>"#,
    ),
    (
        "roughconductor, ggx 0.3",
        true,
        r#"<bsdf type="roughconductor"><string name="distribution" value="ggx"/><string name="material" value="Au"/><float name="alpha" value="0.3"/></bsdf>"#,
    ),
    (
        "roughconductor, ggx 1",
        false,
        r#"<bsdf type="roughconductor"><string name="distribution" value="ggx"/><float name="alpha" value="1"/></bsdf>"#,
    ),
    (
        "roughconductor, beckmann 0.01",
        false,
        r#"<bsdf type="roughconductor"><float name="alpha" value="0.01"/></bsdf>"#,
    ),
    (
        "roughconductor, beckmann 0.5",
        false,
        r#"<bsdf type="roughconductor"><string name="material" value="Al"/><float name="alpha" value="0.5"/></bsdf>"#,
    ),
    (
        "roughconductor, anisotropic",
        false,
        r#"<bsdf type="roughconductor"><string name="distribution" value="ggx"/><float name="alpha_u" value="0.4"/><float name="alpha_v" value="0.05"/></bsdf>"#,
    ),
    (
        "roughconductor, textured",
        false,
        r#"<bsdf type="roughconductor"><texture name="alpha" type="bitmap"><string name="filename" value="share.exr"/></texture><texture name="specular_reflectance" type="bitmap"><string name="filename" value="color.png"/></texture></bsdf>"#,
    ),
    ("dielectric", true, r#"<bsdf type="dielectric"/>"#),
    (
        "dielectric, tinted, 1.8",
        false,
        r#"<bsdf type="dielectric"><float name="int_ior" value="1.8"/><float name="ext_ior" value="1"/><rgb name="specular_transmittance" value="0.5 0.9 0.7"/></bsdf>"#,
    ),
    (
        "plastic",
        false,
        r#"<bsdf type="plastic"><rgb name="diffuse_reflectance" value="0.6 0.2 0.1"/></bsdf>"#,
    ),
    (
        "plastic, nonlinear",
        false,
        r#"<bsdf type="plastic"><rgb name="diffuse_reflectance" value="0.8 0.4 0.1"/><boolean name="nonlinear" value="true"/><float name="int_ior" value="1.9"/></bsdf>"#,
    ),
    (
        "roughplastic, beckmann 0.1",
        true,
        r#"<bsdf type="roughplastic"><rgb name="diffuse_reflectance" value="0.1 0.3 0.6"/></bsdf>"#,
    ),
    (
        "roughplastic, ggx 0.3, nonlinear",
        false,
        r#"<bsdf type="roughplastic"><string name="distribution" value="ggx"/><float name="alpha" value="0.3"/><boolean name="nonlinear" value="true"/><texture name="diffuse_reflectance" type="bitmap"><string name="filename" value="color.png"/></texture></bsdf>"#,
    ),
    (
        "roughplastic, ggx 0.02",
        false,
        r#"<bsdf type="roughplastic"><string name="distribution" value="ggx"/><float name="alpha" value="0.02"/></bsdf>"#,
    ),
    (
        "mask",
        true,
        r#"<bsdf type="mask"><texture name="opacity" type="bitmap"><string name="filename" value="share.exr"/></texture><bsdf type="twosided"><bsdf type="diffuse"/></bsdf></bsdf>"#,
    ),
    (
        "mask 0.3 around metal",
        false,
        r#"<bsdf type="mask"><float name="opacity" value="0.3"/><bsdf type="roughconductor"><float name="alpha" value="0.2"/></bsdf></bsdf>"#,
    ),
    ("null", false, r#"<bsdf type="null"/>"#),
    (
        "blendbsdf",
        false,
        r#"<bsdf type="blendbsdf"><texture name="weight" type="bitmap"><string name="filename" value="share.exr"/></texture><bsdf type="diffuse"><rgb name="reflectance" value="0.7 0.2 0.1"/></bsdf><bsdf type="roughconductor"><float name="alpha" value="0.2"/></bsdf></bsdf>"#,
    ),
    (
        "blendbsdf of mirror and glass",
        false,
        r#"<bsdf type="blendbsdf"><float name="weight" value="0.4"/><bsdf type="conductor"><rgb name="specular_reflectance" value="0.9 0.6 0.3"/></bsdf><bsdf type="dielectric"/></bsdf>"#,
    ),
    (
        "blendbsdf, nested",
        false,
        r#"<bsdf type="blendbsdf"><float name="weight" value="0.4"/><bsdf type="mask"><float name="opacity" value="0.5"/><bsdf type="diffuse"/></bsdf><bsdf type="twosided"><bsdf type="blendbsdf"><float name="weight" value="0.7"/><bsdf type="roughplastic"/><bsdf type="roughconductor"/></bsdf></bsdf></bsdf>"#,
    ),
    (
        "normalmap",
        true,
        r#"<bsdf type="twosided"><bsdf type="normalmap"><texture name="normalmap" type="bitmap"><string name="filename" value="normal.exr"/><boolean name="raw" value="true"/></texture><bsdf type="roughplastic"/></bsdf></bsdf>"#,
    ),
    (
        "normalmap without shadowing",
        false,
        r#"<bsdf type="normalmap"><texture name="normalmap" type="bitmap"><string name="filename" value="normal.exr"/><boolean name="raw" value="true"/></texture><boolean name="use_shadowing_function" value="false"/><bsdf type="roughconductor"><float name="alpha_u" value="0.3"/><float name="alpha_v" value="0.1"/></bsdf></bsdf>"#,
    ),
    (
        "bumpmap",
        false,
        r#"<bsdf type="bumpmap"><texture type="bitmap"><string name="filename" value="height.exr"/><boolean name="raw" value="true"/></texture><float name="scale" value="0.3"/><bsdf type="twosided"><bsdf type="roughplastic"/></bsdf></bsdf>"#,
    ),
    (
        "bumpmap around glass",
        false,
        r#"<bsdf type="bumpmap"><texture type="bitmap"><string name="filename" value="height.exr"/><boolean name="raw" value="true"/></texture><float name="scale" value="0.1"/><bsdf type="dielectric"/></bsdf>"#,
    ),
];
