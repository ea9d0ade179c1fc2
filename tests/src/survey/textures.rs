//! Textures.

use super::Names::{New, Old};
use super::{Means, Plugin, idle, is, sets};

/// A tilted plate that shows the texture.
const FRAME: &str = r#"@eye@light<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="50"/></transform><bsdf type="twosided"><bsdf type="diffuse">{}</bsdf></bsdf></shape>"#;
const COLORED: &str = r#"@eye@light<shape type="ply"><string name="filename" value="colored.ply"/><bsdf type="twosided"><bsdf type="diffuse">{}</bsdf></bsdf></shape>"#;
const PNG: &str = r#"<string name="filename" value="p.png"/>"#;

/// All of them.
pub const TEXTURES: &[Plugin] = &[
    Plugin::new(
        FRAME,
        "texture",
        "bitmap",
        // the first row of the file is the first in memory, at v = 0
        Means::Shows("Bitmap { image: Image { width: 4, height: 2, texels: Srgb8([20, 60, 90, 80, 60, 90, "),
        &[
            sets(r#"<string name="filter_type" value="nearest"/>"#, "filter: Nearest"),
            idle(r#"<string name="filter_type" value="bilinear"/>"#),
            idle(r#"<string name="filter_type" value="trilinear"/>"#),
            sets(r#"<boolean name="raw" value="true"/>"#, "texels: Linear8([20, 60, 90, "),
            idle(r#"<boolean name="raw" value="false"/>"#),
            idle(r#"<string name="wrap_mode" value="repeat"/>"#),
            is(r#"<float name="gamma" value="1"/>"#, r#"<boolean name="raw" value="true"/>"#).warned("Mitsuba 3 refuses"),
            sets(
                r#"<transform name="to_uv"><scale x="3" y="2"/></transform>"#,
                "uv_from_surface: DMat3 { x_axis: DVec3(3.0, 0.0, 0.0), y_axis: DVec3(0.0, 2.0, 0.0)",
            ),
            is(r#"<float name="uscale" value="3"/><float name="vscale" value="2"/>"#, r#"<transform name="to_uv"><scale x="3" y="2"/></transform>"#).only(Old),
            is(r#"<float name="uoffset" value="0.25"/>"#, r#"<transform name="to_uv"><translate x="0.25"/></transform>"#).only(Old),
            idle(r#"<string name="format" value="variant"/>"#),
        ],
    )
    .given(PNG),
    Plugin::new(
        FRAME,
        "texture",
        "bitmap",
        Means::Shows("wrap: Repeat"),
        &[
            sets(r#"<string name="wrap_mode" value="mirror"/>"#, "wrap: Mirror"),
            sets(r#"<string name="wrap_mode" value="clamp"/>"#, "wrap: Clamp"),
        ],
    )
    .given(r#"<string name="filename" value="p.png"/><transform name="to_uv"><scale value="2"/></transform>"#),
    Plugin::new(FRAME, "texture", "bitmap", Means::Shows("width: 4, height: 2, texels: Srgb8"), &[])
        .given(r#"<string name="filename" value="p.jpg"/>"#),
    Plugin::new(FRAME, "texture", "bitmap", Means::Shows("width: 4, height: 2, texels: Srgb8([20, 60, 90, "), &[])
        .given(r#"<string name="filename" value="p.bmp"/>"#),
    Plugin::new(FRAME, "texture", "bitmap", Means::Shows("width: 24, height: 16, texels: Srgb8"), &[])
        .given(r#"<string name="filename" value="color.png"/>"#),
    // never decoded
    Plugin::new(FRAME, "texture", "bitmap", Means::Shows("width: 32, height: 32, texels: Linear32"), &[])
        .given(r#"<string name="filename" value="share.exr"/>"#),
    Plugin::new(FRAME, "texture", "bitmap", Means::Refused("the file \"gone.png\" is not there"), &[])
        .given(r#"<string name="filename" value="gone.png"/>"#),
    Plugin::new(FRAME, "texture", "bitmap", Means::Refused("no \"filename\""), &[]),
    Plugin::new(
        FRAME,
        "texture",
        "checkerboard",
        Means::Shows("Checkerboard { color0: Constant([0.4, 0.4, 0.4]), color1: Constant([0.2, 0.2, 0.2]) }"),
        &[
            sets(r#"<rgb name="color0" value="0.8 0.2 0.1"/>"#, "color0: Constant([0.8, 0.2, 0.1])"),
            sets(r#"<rgb name="color1" value="0.1 0.2 0.8"/>"#, "color1: Constant([0.1, 0.2, 0.8])"),
            sets(r#"<texture name="color0" type="bitmap"><string name="filename" value="p.png"/></texture>"#, "color0: Texture(TextureId(0))"),
            sets(r#"<transform name="to_uv"><scale x="3" y="2"/></transform>"#, "x_axis: DVec3(3.0, 0.0, 0.0), y_axis: DVec3(0.0, 2.0, 0.0)"),
            is(
                r#"<float name="uscale" value="3"/><float name="vscale" value="2"/><float name="uoffset" value="0.1"/><float name="voffset" value="0.2"/>"#,
                r#"<transform name="to_uv"><scale x="3" y="2"/><translate x="0.1" y="0.2"/></transform>"#,
            )
            .only(Old),
        ],
    ),
    Plugin::new(COLORED, "texture", "mesh_attribute", Means::Shows("MeshAttribute { name: \"vertex_color\", scale: 1.0 }"), &[])
        .given(r#"<string name="name" value="vertex_color"/>"#)
        .only(New),
    Plugin::new(
        COLORED,
        "texture",
        "mesh_attribute",
        Means::Shows("MeshAttribute { name: \"face_tone\", scale: 1.0 }"),
        &[sets(r#"<float name="scale" value="0.5"/>"#, "scale: 0.5")],
    )
    .given(r#"<string name="name" value="face_tone"/>"#)
    .only(New),
    Plugin::new(
        FRAME,
        "texture",
        "scale",
        Means::Shows("Scaled { color: Texture(TextureId(0)), factor: [1.0, 1.0, 1.0] }"),
        &[
            sets(r#"<float name="scale" value="0.5"/>"#, "factor: [0.5, 0.5, 0.5]"),
            sets(r#"<rgb name="scale" value="0.5 1 0.25"/>"#, "factor: [0.5, 1.0, 0.25]"),
        ],
    )
    .given(r#"<texture type="checkerboard"/>"#)
    .warned("Mitsuba 3 refuses"),
    Plugin::new(FRAME, "texture", "rawconstant", Means::Shows("reflectance: Constant([0.8, 0.2, 0.1])"), &[])
        .given(r#"<vector name="value" value="0.8, 0.2, 0.1"/>"#)
        .only(New),
    Plugin::new(FRAME, "texture", "rawconstant", Means::Shows("reflectance: Constant([0.3, 0.3, 0.3])"), &[])
        .given(r#"<float name="value" value="0.3"/>"#)
        .only(New),
    Plugin::new(FRAME, "texture", "uniform", Means::Shows("reflectance: Constant([0.3, 0.3, 0.3])"), &[])
        .given(r#"<float name="value" value="0.3"/>"#)
        .only(New),
    Plugin::new(FRAME, "texture", "srgb", Means::Shows("reflectance: Constant([0.8, 0.2, 0.1])"), &[])
        .given(r#"<rgb name="color" value="0.8 0.2 0.1"/>"#)
        .only(New),
    // over a volume, which is for media
    Plugin::new(FRAME, "texture", "volume", Means::Nothing, &[]).warned("volume is not read yet; grey 0.5 stands in"),
    Plugin::new(FRAME, "texture", "bitmp", Means::Refused("did you mean \"bitmap\""), &[]),
];
