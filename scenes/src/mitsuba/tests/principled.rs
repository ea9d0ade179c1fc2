//! Burley's models.

use super::{loaded, try_load};
use crate::{Color, MaterialKind, Principled, PrincipledThin, Scalar};

fn of(bsdf: &str) -> MaterialKind {
    let scene = loaded(&format!(r#"<shape type="sphere">{bsdf}</shape>"#));
    assert!(scene.warnings.iter().all(|w| w.element == "scene"), "{bsdf}: {:?}", scene.warnings);
    scene.materials[scene.shapes[0].material.0 as usize].kind.clone()
}

fn principled(parameters: &str) -> Principled {
    match of(&format!(r#"<bsdf type="principled">{parameters}</bsdf>"#)) {
        MaterialKind::Principled(p) => *p,
        other => panic!("{other:?}"),
    }
}

fn float(name: &str, value: f32) -> String {
    format!(r#"<float name="{name}" value="{value}"/>"#)
}

#[test]
fn principled_models_have_the_defaults_of_mitsuba() {
    assert_eq!(principled(""), Principled::default());
    assert!((principled("").eta - 1.5).abs() < 1e-6);
    assert_eq!(of(r#"<bsdf type="principledthin"/>"#), MaterialKind::PrincipledThin(Box::default()));
}

#[test]
fn each_dial_of_principled_is_read() {
    let names = [
        "roughness",
        "anisotropic",
        "metallic",
        "spec_trans",
        "eta",
        "spec_tint",
        "sheen",
        "sheen_tint",
        "flatness",
        "clearcoat",
        "clearcoat_gloss",
    ];
    let value = |i: usize| (i + 1) as f32 / 16.0;
    let parameters: String = names.iter().enumerate().map(|(i, name)| float(name, value(i))).collect();
    let dial = |name: &str| value(names.iter().position(|n| *n == name).expect("a name"));
    let scalar = |name: &str| Scalar::Constant(dial(name));
    let color = r#"<rgb name="base_color" value="0.1 0.2 0.3"/>"#;
    assert_eq!(
        principled(&format!("{color}{parameters}<float name=\"clearcoat_sampling_rate\" value=\"2\"/>")),
        Principled {
            base_color: Color::Constant([0.1, 0.2, 0.3]),
            roughness: scalar("roughness"),
            anisotropic: scalar("anisotropic"),
            metallic: scalar("metallic"),
            spec_trans: scalar("spec_trans"),
            eta: dial("eta"),
            spec_tint: scalar("spec_tint"),
            sheen: scalar("sheen"),
            sheen_tint: scalar("sheen_tint"),
            flatness: scalar("flatness"),
            clearcoat: scalar("clearcoat"),
            clearcoat_gloss: scalar("clearcoat_gloss"),
        }
    );
}

#[test]
fn each_dial_of_principledthin_is_read() {
    let names = [
        "roughness",
        "anisotropic",
        "spec_trans",
        "eta",
        "spec_tint",
        "sheen",
        "sheen_tint",
        "flatness",
        "diff_trans",
    ];
    let parameters: String =
        names.iter().enumerate().map(|(i, name)| float(name, (i + 1) as f32 / 16.0)).collect();
    let [roughness, anisotropic, spec_trans, eta, spec_tint, sheen, sheen_tint, flatness, diff_trans] =
        std::array::from_fn(|i| Scalar::Constant((i + 1) as f32 / 16.0));
    assert_eq!(
        of(&format!(r#"<bsdf type="principledthin">{parameters}</bsdf>"#)),
        MaterialKind::PrincipledThin(Box::new(PrincipledThin {
            base_color: Color::Constant([0.5; 3]),
            roughness,
            anisotropic,
            spec_trans,
            eta,
            spec_tint,
            sheen,
            sheen_tint,
            flatness,
            diff_trans,
        }))
    );
}

#[test]
fn every_dial_takes_a_texture() {
    let texture = |name: &str| format!(r#"<texture type="checkerboard" name="{name}"/>"#);
    for name in [
        "roughness",
        "anisotropic",
        "spec_trans",
        "spec_tint",
        "sheen",
        "sheen_tint",
        "flatness",
        "base_color",
        "metallic",
        "clearcoat",
        "clearcoat_gloss",
    ] {
        assert!(format!("{:?}", principled(&texture(name))).contains("TextureId"), "{name}");
    }
    for name in ["eta", "diff_trans", "sheen"] {
        let thin = of(&format!(r#"<bsdf type="principledthin">{}</bsdf>"#, texture(name)));
        assert!(format!("{thin:?}").contains("TextureId"), "{name}");
    }
}

/// By Mitsuba's formula, 2 / (1 − √(0.08 specular)) − 1.
#[test]
fn specular_stands_for_an_index() {
    for (parameters, eta) in [
        (float("specular", 0.0), 1.0),
        (float("specular", 1.0), 1.788_788_6),
        (float("specular", 0.0) + &float("spec_trans", 0.5), 1.018_050_2),
        (float("eta", 1.0), 1.0),
        (float("eta", 1.0) + &float("spec_trans", 0.5), 1.001),
    ] {
        let read = principled(&parameters).eta;
        assert!((read - eta).abs() < 1e-6, "{parameters}: {read}");
    }
}

#[test]
fn only_what_refracts_transmits() {
    for (bsdf, transmits) in [
        (r#"<bsdf type="principled"/>"#.into(), false),
        (format!(r#"<bsdf type="principled">{}</bsdf>"#, float("spec_trans", 0.1)), true),
        (r#"<bsdf type="principled"><texture name="spec_trans" type="checkerboard"/></bsdf>"#.into(), true),
        (r#"<bsdf type="principledthin"/>"#.into(), true),
    ] {
        assert_eq!(of(&bsdf).transmits(), transmits, "{bsdf}");
    }
}

#[test]
fn what_no_dial_takes_is_named() {
    let cases = [
        (
            "principled",
            float("eta", 1.5) + &float("specular", 0.5),
            "\"eta\" and \"specular\" are both given",
        ),
        ("principled", float("roughness", 1.5), "1.5 is not at least 0 and at most 1"),
        ("principled", float("metallic", -0.1), "-0.1 is not at least 0 and at most 1"),
        ("principled", float("specular", 2.0), "2 is not at least 0 and at most 1"),
        ("principled", float("eta", 0.0), "0 is not above 0 and at most 1000"),
        ("principledthin", float("diff_trans", 2.5), "2.5 is not at least 0 and at most 2"),
        ("principledthin", float("eta", -1.0), "-1 is not above 0 and at most 1000"),
    ];
    for (kind, parameters, problem) in cases {
        let bsdf = format!(r#"<bsdf type="{kind}">{parameters}</bsdf>"#);
        let error = try_load(&bsdf).expect_err(&bsdf).to_string();
        assert!(error.contains(problem), "{bsdf}: {error}");
    }
}
