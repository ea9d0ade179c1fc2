//! `principled` and `principledthin`.

use super::Names::New;
use super::bsdfs::FRAME;
use super::{Means, Parameter, Plugin, sets};

const COLOR: Parameter =
    sets(r#"<rgb name="base_color" value="0.8 0.2 0.1"/>"#, "base_color: Constant([0.8, 0.2, 0.1])");
const COLOR_TEXTURE: Parameter =
    sets(r#"<texture name="base_color" type="checkerboard"/>"#, "base_color: Texture(TextureId(0))");
const ROUGHNESS: Parameter = sets(r#"<float name="roughness" value="0.2"/>"#, "roughness: Constant(0.2)");
const SHARE: &str = "TextureId(0))";

/// Both.
pub const MODELS: &[Plugin] = &[
    Plugin::new(
        FRAME,
        "bsdf",
        "principled",
        Means::Shows(
            "Principled { base_color: Constant([0.5, 0.5, 0.5]), roughness: Constant(0.5), anisotropic: Constant(0.0), metallic: Constant(0.0), spec_trans: Constant(0.0), eta: 1.5",
        ),
        &[
            COLOR,
            COLOR_TEXTURE,
            ROUGHNESS,
            sets(r#"<texture name="roughness" type="bitmap"><string name="filename" value="share.exr"/></texture>"#, "roughness: Texture(TextureId(0))"),
            sets(r#"<float name="metallic" value="0.7"/>"#, "metallic: Constant(0.7)"),
            sets(r#"<texture name="metallic" type="bitmap"><string name="filename" value="share.exr"/></texture>"#, "metallic: Texture(TextureId(0))"),
            // eta = 2 / (1 − √(0.08 · 1)) − 1
            sets(r#"<float name="specular" value="1"/>"#, "eta: 1.788"),
            sets(r#"<float name="eta" value="1.8"/>"#, "eta: 1.8,"),
            sets(r#"<float name="spec_trans" value="0.8"/>"#, "spec_trans: Constant(0.8)"),
            sets(r#"<texture name="spec_trans" type="bitmap"><string name="filename" value="share.exr"/></texture>"#, "spec_trans: Texture(TextureId(0))"),
            sets(r#"<float name="flatness" value="0.6"/>"#, "flatness: Constant(0.6)"),
            sets(r#"<float name="clearcoat" value="0.9"/>"#, "clearcoat: Constant(0.9)"),
            sets(r#"<texture name="clearcoat" type="bitmap"><string name="filename" value="share.exr"/></texture>"#, SHARE),
            sets(r#"<float name="sheen" value="0.8"/>"#, "sheen: Constant(0.8)"),
            sets(r#"<texture name="sheen" type="bitmap"><string name="filename" value="share.exr"/></texture>"#, SHARE),
            Parameter::new(
                r#"<float name="specular" value="0.4"/><float name="eta" value="1.4"/>"#,
                Means::Refused("\"eta\" and \"specular\" are both given"),
            ),
        ],
    )
    .only(New),
    // what shows only beside others
    Plugin::new(
        FRAME,
        "bsdf",
        "principled",
        Means::Shows("Principled"),
        &[
            sets(r#"<float name="anisotropic" value="0.8"/>"#, "anisotropic: Constant(0.8)"),
            sets(r#"<texture name="anisotropic" type="bitmap"><string name="filename" value="share.exr"/></texture>"#, SHARE),
            sets(r#"<float name="spec_tint" value="0.9"/>"#, "spec_tint: Constant(0.9)"),
            sets(r#"<float name="sheen_tint" value="0.7"/>"#, "sheen_tint: Constant(0.7)"),
            sets(r#"<float name="clearcoat_gloss" value="0.9"/>"#, "clearcoat_gloss: Constant(0.9)"),
        ],
    )
    .given(r#"<rgb name="base_color" value="0.8 0.2 0.1"/><float name="roughness" value="0.3"/><float name="sheen" value="0.8"/><float name="clearcoat" value="1"/>"#)
    .only(New),
    Plugin::new(
        FRAME,
        "bsdf",
        "principledthin",
        Means::Shows("PrincipledThin { base_color: Constant([0.5, 0.5, 0.5]), roughness: Constant(0.5)"),
        &[
            COLOR,
            ROUGHNESS,
            sets(r#"<texture name="spec_trans" type="bitmap"><string name="filename" value="share.exr"/></texture>"#, SHARE),
            sets(r#"<texture name="sheen" type="bitmap"><string name="filename" value="share.exr"/></texture>"#, SHARE),
            sets(r#"<texture name="diff_trans" type="bitmap"><string name="filename" value="share.exr"/></texture>"#, SHARE),
            sets(r#"<float name="diff_trans" value="1.2"/>"#, "diff_trans: Constant(1.2)"),
        ],
    )
    .only(New),
    Plugin::new(
        FRAME,
        "bsdf",
        "principledthin",
        Means::Shows("PrincipledThin"),
        &[
            sets(r#"<float name="eta" value="1.8"/>"#, "eta: Constant(1.8)"),
            sets(r#"<texture name="anisotropic" type="bitmap"><string name="filename" value="share.exr"/></texture>"#, SHARE),
            sets(r#"<float name="spec_tint" value="0.9"/>"#, "spec_tint: Constant(0.9)"),
            sets(r#"<float name="sheen_tint" value="0.7"/>"#, "sheen_tint: Constant(0.7)"),
            sets(r#"<float name="flatness" value="0.6"/>"#, "flatness: Constant(0.6)"),
        ],
    )
    .given(r#"<rgb name="base_color" value="0.8 0.2 0.1"/><float name="spec_trans" value="0.6"/><float name="sheen" value="0.8"/>"#)
    .only(New),
];
