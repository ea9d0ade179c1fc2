//! Materials of the table: Burley's models, each parameter away from its default.

use super::Named;

/// All of them.
pub const PRINCIPLED: &[Named] = &[
    ("principled, defaults", false, r#"<bsdf type="principled"></bsdf>"#),
    (
        "principled, roughness 0.05",
        false,
        r#"<bsdf type="principled"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="roughness" value="0.05"/></bsdf>"#,
    ),
    (
        "principled, roughness 1, specular 1",
        false,
        r#"<bsdf type="principled"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="roughness" value="1"/><float name="specular" value="1"/></bsdf>"#,
    ),
    (
        "principled, eta 1.8",
        false,
        r#"<bsdf type="principled"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="eta" value="1.8"/><float name="roughness" value="0.3"/></bsdf>"#,
    ),
    (
        "principled, metallic",
        false,
        r#"<bsdf type="principled"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="metallic" value="1"/><float name="roughness" value="0.4"/></bsdf>"#,
    ),
    (
        "principled, metallic 0.5, anisotropic",
        false,
        r#"<bsdf type="principled"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="metallic" value="0.5"/><float name="roughness" value="0.4"/><float name="anisotropic" value="0.9"/></bsdf>"#,
    ),
    (
        "principled, spec_tint",
        false,
        r#"<bsdf type="principled"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="spec_tint" value="1"/><float name="specular" value="1"/><float name="roughness" value="0.3"/></bsdf>"#,
    ),
    (
        "principled, sheen",
        false,
        r#"<bsdf type="principled"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="sheen" value="1"/></bsdf>"#,
    ),
    (
        "principled, sheen_tint",
        false,
        r#"<bsdf type="principled"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="sheen" value="1"/><float name="sheen_tint" value="0.8"/><float name="roughness" value="0.8"/></bsdf>"#,
    ),
    (
        "principled, clearcoat",
        false,
        r#"<bsdf type="principled"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="clearcoat" value="1"/></bsdf>"#,
    ),
    (
        "principled, clearcoat_gloss",
        false,
        r#"<bsdf type="principled"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="clearcoat" value="0.7"/><float name="clearcoat_gloss" value="0.8"/><float name="roughness" value="0.6"/></bsdf>"#,
    ),
    (
        "principled, flatness",
        false,
        r#"<bsdf type="principled"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="flatness" value="0.8"/><float name="roughness" value="0.7"/></bsdf>"#,
    ),
    (
        "principled, spec_trans",
        false,
        r#"<bsdf type="principled"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="spec_trans" value="1"/><float name="roughness" value="0.3"/></bsdf>"#,
    ),
    (
        "principled, spec_trans 0.6, metallic 0.3, eta 1.33",
        false,
        r#"<bsdf type="principled"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="spec_trans" value="0.6"/><float name="metallic" value="0.3"/><float name="eta" value="1.33"/><float name="roughness" value="0.5"/></bsdf>"#,
    ),
    (
        "principled, spec_trans, smooth, anisotropic",
        false,
        r#"<bsdf type="principled"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="spec_trans" value="0.9"/><float name="roughness" value="0.2"/><float name="anisotropic" value="0.5"/><float name="spec_tint" value="0.5"/></bsdf>"#,
    ),
    (
        "principled, textured",
        true,
        r#"<bsdf type="principled"><texture name="base_color" type="bitmap"><string name="filename" value="color.png"/></texture><texture name="roughness" type="bitmap"><string name="filename" value="share.exr"/></texture><texture name="metallic" type="bitmap"><string name="filename" value="share.exr"/></texture><texture name="anisotropic" type="bitmap"><string name="filename" value="share.exr"/></texture><texture name="clearcoat" type="bitmap"><string name="filename" value="share.exr"/></texture><texture name="sheen" type="bitmap"><string name="filename" value="share.exr"/></texture></bsdf>"#,
    ),
    (
        "principled, textured, spec_trans",
        false,
        r#"<bsdf type="principled"><texture name="base_color" type="bitmap"><string name="filename" value="color.png"/></texture><texture name="spec_trans" type="bitmap"><string name="filename" value="share.exr"/></texture><texture name="spec_tint" type="bitmap"><string name="filename" value="share.exr"/></texture><texture name="flatness" type="bitmap"><string name="filename" value="share.exr"/></texture><texture name="sheen_tint" type="bitmap"><string name="filename" value="share.exr"/></texture><float name="sheen" value="0.5"/><texture name="clearcoat_gloss" type="bitmap"><string name="filename" value="share.exr"/></texture><float name="clearcoat" value="0.5"/></bsdf>"#,
    ),
    (
        "principled, all at once",
        false,
        r#"<bsdf type="principled"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="roughness" value="0.4"/><float name="metallic" value="0.2"/><float name="anisotropic" value="0.3"/><float name="eta" value="1.4"/><float name="spec_tint" value="0.4"/><float name="sheen" value="0.5"/><float name="sheen_tint" value="0.5"/><float name="clearcoat" value="0.5"/><float name="clearcoat_gloss" value="0.5"/><float name="flatness" value="0.5"/><float name="spec_trans" value="0.3"/></bsdf>"#,
    ),
    ("principledthin, defaults", false, r#"<bsdf type="principledthin"></bsdf>"#),
    (
        "principledthin, roughness 0.1, eta 1.8",
        false,
        r#"<bsdf type="principledthin"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="roughness" value="0.1"/><float name="eta" value="1.8"/></bsdf>"#,
    ),
    (
        "principledthin, diff_trans",
        false,
        r#"<bsdf type="principledthin"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="diff_trans" value="0.8"/></bsdf>"#,
    ),
    (
        "principledthin, diff_trans 2",
        false,
        r#"<bsdf type="principledthin"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="diff_trans" value="2"/><float name="roughness" value="0.8"/></bsdf>"#,
    ),
    (
        "principledthin, spec_trans",
        true,
        r#"<bsdf type="principledthin"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="spec_trans" value="0.8"/><float name="roughness" value="0.4"/></bsdf>"#,
    ),
    (
        "principledthin, spec_trans 1, spec_tint, anisotropic",
        false,
        r#"<bsdf type="principledthin"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="spec_trans" value="1"/><float name="spec_tint" value="0.7"/><float name="anisotropic" value="0.8"/><float name="roughness" value="0.5"/></bsdf>"#,
    ),
    (
        "principledthin, sheen",
        false,
        r#"<bsdf type="principledthin"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="sheen" value="1"/><float name="sheen_tint" value="0.6"/><float name="diff_trans" value="0.5"/></bsdf>"#,
    ),
    (
        "principledthin, flatness",
        false,
        r#"<bsdf type="principledthin"><rgb name="base_color" value="0.8 0.3 0.1"/><float name="flatness" value="0.8"/><float name="roughness" value="0.8"/><float name="diff_trans" value="1.2"/></bsdf>"#,
    ),
    (
        "principledthin, textured",
        false,
        r#"<bsdf type="principledthin"><texture name="base_color" type="bitmap"><string name="filename" value="color.png"/></texture><texture name="roughness" type="bitmap"><string name="filename" value="share.exr"/></texture><texture name="spec_trans" type="bitmap"><string name="filename" value="share.exr"/></texture><texture name="diff_trans" type="bitmap"><string name="filename" value="share.exr"/></texture><texture name="anisotropic" type="bitmap"><string name="filename" value="share.exr"/></texture><texture name="sheen" type="bitmap"><string name="filename" value="share.exr"/></texture><texture name="flatness" type="bitmap"><string name="filename" value="share.exr"/></texture></bsdf>"#,
    ),
];
