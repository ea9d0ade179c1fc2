//! Materials of the table: rough and thin glass.

use super::Named;

/// All of them.
pub const GLASS: &[Named] = &[
    ("roughdielectric, beckmann 0.1", false, r#"<bsdf type="roughdielectric"></bsdf>"#),
    (
        "roughdielectric, beckmann 0.01, 1.8",
        false,
        r#"<bsdf type="roughdielectric"><float name="alpha" value="0.01"/><float name="int_ior" value="1.8"/></bsdf>"#,
    ),
    (
        "roughdielectric, beckmann 0.5, 1.33",
        false,
        r#"<bsdf type="roughdielectric"><float name="alpha" value="0.5"/><float name="int_ior" value="1.33"/></bsdf>"#,
    ),
    (
        "roughdielectric, ggx 0.001",
        false,
        r#"<bsdf type="roughdielectric"><string name="distribution" value="ggx"/><float name="alpha" value="0.001"/></bsdf>"#,
    ),
    (
        "roughdielectric, ggx 0.05, water in glass",
        false,
        r#"<bsdf type="roughdielectric"><string name="distribution" value="ggx"/><float name="alpha" value="0.05"/><string name="int_ior" value="water"/><string name="ext_ior" value="bk7"/></bsdf>"#,
    ),
    (
        "roughdielectric, ggx 0.3, tinted",
        true,
        r#"<bsdf type="roughdielectric"><string name="distribution" value="ggx"/><float name="alpha" value="0.3"/><rgb name="specular_reflectance" value="0.9 0.7 0.5"/><rgb name="specular_transmittance" value="0.5 0.9 0.7"/></bsdf>"#,
    ),
    (
        "roughdielectric, ggx 1",
        false,
        r#"<bsdf type="roughdielectric"><string name="distribution" value="ggx"/><float name="alpha" value="1"/></bsdf>"#,
    ),
    (
        "roughdielectric, anisotropic",
        false,
        r#"<bsdf type="roughdielectric"><string name="distribution" value="ggx"/><float name="alpha_u" value="0.4"/><float name="alpha_v" value="0.08"/></bsdf>"#,
    ),
    (
        "roughdielectric, textured",
        false,
        r#"<bsdf type="roughdielectric"><texture name="alpha" type="bitmap"><string name="filename" value="share.exr"/></texture><texture name="specular_transmittance" type="bitmap"><string name="filename" value="color.png"/></texture></bsdf>"#,
    ),
    ("thindielectric", false, r#"<bsdf type="thindielectric"></bsdf>"#),
    (
        "thindielectric, tinted, 1.8",
        false,
        r#"<bsdf type="thindielectric"><float name="int_ior" value="1.8"/><rgb name="specular_reflectance" value="0.9 0.7 0.5"/><rgb name="specular_transmittance" value="0.5 0.9 0.7"/></bsdf>"#,
    ),
    (
        "thindielectric, textured",
        false,
        r#"<bsdf type="thindielectric"><string name="int_ior" value="diamond"/><texture name="specular_transmittance" type="bitmap"><string name="filename" value="color.png"/></texture></bsdf>"#,
    ),
];
