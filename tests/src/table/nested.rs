//! Materials of the table that are made of others, and textures of all kinds.

use super::Named;

/// All of them.
pub const NESTED: &[Named] = &[
    (
        "twosided conductor",
        false,
        r#"<bsdf type="twosided"><bsdf type="conductor"><string name="material" value="Cu"/></bsdf></bsdf>"#,
    ),
    (
        "twosided roughconductor",
        false,
        r#"<bsdf type="twosided"><bsdf type="roughconductor"><float name="alpha_u" value="0.3"/><float name="alpha_v" value="0.1"/></bsdf></bsdf>"#,
    ),
    (
        "twosided plastic, textured",
        false,
        r#"<bsdf type="twosided"><bsdf type="plastic"><texture name="diffuse_reflectance" type="bitmap"><string name="filename" value="color.png"/></texture></bsdf></bsdf>"#,
    ),
    (
        "twosided roughplastic, textured",
        false,
        r#"<bsdf type="twosided"><bsdf type="roughplastic"><texture name="specular_reflectance" type="bitmap"><string name="filename" value="color.png"/></texture><float name="alpha" value="0.2"/></bsdf></bsdf>"#,
    ),
    (
        "twosided principled",
        false,
        r#"<bsdf type="twosided"><bsdf type="principled"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="anisotropic" value="0.7"/><float name="metallic" value="0.6"/><float name="clearcoat" value="1"/></bsdf></bsdf>"#,
    ),
    (
        "twosided blendbsdf of principled and roughplastic",
        false,
        r#"<bsdf type="twosided"><bsdf type="blendbsdf"><texture name="weight" type="bitmap"><string name="filename" value="share.exr"/></texture><bsdf type="principled"><float name="sheen" value="1"/></bsdf><bsdf type="roughplastic"></bsdf></bsdf></bsdf>"#,
    ),
    (
        "twosided of principled and bumpmap",
        false,
        r#"<bsdf type="twosided"><bsdf type="principled"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="roughness" value="0.3"/></bsdf><bsdf type="bumpmap"><texture type="bitmap"><string name="filename" value="height.exr"/><boolean name="raw" value="true"/></texture><float name="scale" value="0.3"/><bsdf type="diffuse"></bsdf></bsdf></bsdf>"#,
    ),
    (
        "mask around normalmap around principled",
        false,
        r#"<bsdf type="mask"><float name="opacity" value="0.7"/><bsdf type="normalmap"><texture name="normalmap" type="bitmap"><string name="filename" value="normal.exr"/><boolean name="raw" value="true"/></texture><bsdf type="principled"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="roughness" value="0.3"/><float name="metallic" value="0.5"/></bsdf></bsdf></bsdf>"#,
    ),
    (
        "mask around twosided normalmap around principled",
        false,
        r#"<bsdf type="mask"><texture name="opacity" type="bitmap"><string name="filename" value="share.exr"/></texture><bsdf type="twosided"><bsdf type="normalmap"><texture name="normalmap" type="bitmap"><string name="filename" value="normal.exr"/><boolean name="raw" value="true"/></texture><bsdf type="principled"><texture name="base_color" type="bitmap"><string name="filename" value="color.png"/></texture><float name="clearcoat" value="1"/></bsdf></bsdf></bsdf></bsdf>"#,
    ),
    (
        "normalmap around roughdielectric",
        false,
        r#"<bsdf type="normalmap"><texture name="normalmap" type="bitmap"><string name="filename" value="normal.exr"/><boolean name="raw" value="true"/></texture><bsdf type="roughdielectric"><string name="distribution" value="ggx"/><float name="alpha" value="0.2"/></bsdf></bsdf>"#,
    ),
    (
        "normalmap around principled glass",
        false,
        r#"<bsdf type="normalmap"><texture name="normalmap" type="bitmap"><string name="filename" value="normal.exr"/><boolean name="raw" value="true"/></texture><bsdf type="principled"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="spec_trans" value="0.8"/><float name="roughness" value="0.4"/></bsdf></bsdf>"#,
    ),
    (
        "normalmap around principledthin",
        false,
        r#"<bsdf type="normalmap"><texture name="normalmap" type="bitmap"><string name="filename" value="normal.exr"/><boolean name="raw" value="true"/></texture><bsdf type="principledthin"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="spec_trans" value="0.4"/><float name="diff_trans" value="0.6"/><float name="roughness" value="0.5"/></bsdf></bsdf>"#,
    ),
    (
        "normalmap around blendbsdf",
        false,
        r#"<bsdf type="normalmap"><texture name="normalmap" type="bitmap"><string name="filename" value="normal.exr"/><boolean name="raw" value="true"/></texture><bsdf type="blendbsdf"><float name="weight" value="0.5"/><bsdf type="diffuse"></bsdf><bsdf type="roughconductor"><float name="alpha" value="0.3"/></bsdf></bsdf></bsdf>"#,
    ),
    (
        "blendbsdf of metal and rough glass, textured",
        false,
        r#"<bsdf type="blendbsdf"><texture name="weight" type="bitmap"><string name="filename" value="share.exr"/></texture><bsdf type="roughconductor"><string name="distribution" value="ggx"/><float name="alpha" value="0.25"/><texture name="specular_reflectance" type="bitmap"><string name="filename" value="color.png"/></texture></bsdf><bsdf type="roughdielectric"><float name="alpha" value="0.2"/></bsdf></bsdf>"#,
    ),
    (
        "blendbsdf of principled and principledthin",
        false,
        r#"<bsdf type="blendbsdf"><texture name="weight" type="bitmap"><string name="filename" value="share.exr"/></texture><bsdf type="principled"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="roughness" value="0.3"/></bsdf><bsdf type="principledthin"><float name="diff_trans" value="1"/><float name="spec_trans" value="0.3"/></bsdf></bsdf>"#,
    ),
    (
        "blendbsdf with null",
        false,
        r#"<bsdf type="blendbsdf"><texture name="weight" type="bitmap"><string name="filename" value="share.exr"/></texture><bsdf type="null"></bsdf><bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="0.7 0.4 0.2"/></bsdf></bsdf></bsdf>"#,
    ),
    (
        "blendbsdf with mask around rough glass",
        false,
        r#"<bsdf type="blendbsdf"><float name="weight" value="0.5"/><bsdf type="mask"><float name="opacity" value="0.6"/><bsdf type="roughdielectric"></bsdf></bsdf><bsdf type="diffuse"></bsdf></bsdf>"#,
    ),
    (
        "uniform and srgb",
        false,
        r#"<bsdf type="roughplastic"><spectrum name="diffuse_reflectance" type="uniform"><float name="value" value="0.4"/></spectrum><texture name="specular_reflectance" type="srgb"><rgb name="color" value="0.9 0.5 0.7"/></texture></bsdf>"#,
    ),
    (
        "rawconstant",
        false,
        r#"<bsdf type="principled"><texture name="base_color" type="rawconstant"><vector name="value" x="0.3" y="0.5" z="0.7"/></texture><texture name="roughness" type="rawconstant"><float name="value" value="0.35"/></texture></bsdf>"#,
    ),
    (
        "checkerboard of bitmaps",
        false,
        r#"<bsdf type="diffuse"><texture name="reflectance" type="checkerboard"><texture name="color0" type="bitmap"><string name="filename" value="color.png"/></texture><rgb name="color1" value="0.1 0.2 0.7"/><transform name="to_uv"><scale x="6" y="4"/></transform></texture></bsdf>"#,
    ),
];

/// Those that Mitsuba gets wrong on closed shapes (`docs/mitsuba.md`), for the plate alone.
pub const SHEETS: &[Named] = &[(
    "blendbsdf of principled and rough glass",
    false,
    r#"<bsdf type="blendbsdf"><float name="weight" value="0.4"/><bsdf type="principled"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="roughness" value="0.3"/><float name="metallic" value="0.5"/></bsdf><bsdf type="roughdielectric"><float name="alpha" value="0.2"/></bsdf></bsdf>"#,
)];
