//! `<bsdf>`: defaults and parameters.

use super::loaded;
use crate::{Coat, Color, Distribution, MaterialId, MaterialKind, Scalar, TextureId, WardVariant};

fn material(bsdf: &str) -> MaterialKind {
    let scene = loaded(&format!(r#"<shape type="sphere">{bsdf}</shape>"#));
    assert!(scene.warnings.iter().all(|w| w.element == "scene"), "{bsdf}: {:?}", scene.warnings);
    scene.materials[scene.shapes[0].material.0 as usize].kind.clone()
}

const GREY: Color = Color::Constant([0.5; 3]);
const WHITE: Color = Color::Constant([1.0; 3]);

/// The defaults that Mitsuba 3.9.1 prints.
#[test]
fn materials_have_the_defaults_of_mitsuba() {
    let beckmann = Distribution::Beckmann;
    assert_eq!(material(r#"<bsdf type="diffuse"/>"#), MaterialKind::Diffuse { reflectance: GREY });
    assert_eq!(
        material(r#"<bsdf type="conductor"/>"#),
        MaterialKind::Conductor { ior: None, specular_reflectance: WHITE }
    );
    let alpha = Scalar::Constant(0.1);
    assert_eq!(
        material(r#"<bsdf type="roughconductor"/>"#),
        MaterialKind::RoughConductor {
            distribution: beckmann,
            alpha_u: alpha,
            alpha_v: alpha,
            ior: None,
            specular_reflectance: WHITE,
        }
    );
    assert_eq!(
        material(r#"<bsdf type="dielectric"/>"#),
        MaterialKind::Dielectric {
            int_ior: 1.5046,
            ext_ior: 1.000277,
            specular_reflectance: WHITE,
            specular_transmittance: WHITE,
        }
    );
    assert_eq!(
        material(r#"<bsdf type="plastic"/>"#),
        MaterialKind::Plastic {
            int_ior: 1.49,
            ext_ior: 1.000277,
            diffuse_reflectance: GREY,
            specular_reflectance: WHITE,
            nonlinear: false,
        }
    );
    assert_eq!(
        material(r#"<bsdf type="roughplastic"/>"#),
        MaterialKind::RoughPlastic {
            distribution: beckmann,
            alpha: 0.1,
            int_ior: 1.49,
            ext_ior: 1.000277,
            diffuse_reflectance: GREY,
            specular_reflectance: WHITE,
            nonlinear: false,
        }
    );
    assert_eq!(
        material(r#"<bsdf type="roughdielectric"/>"#),
        MaterialKind::RoughDielectric {
            distribution: beckmann,
            alpha_u: alpha,
            alpha_v: alpha,
            int_ior: 1.5046,
            ext_ior: 1.000277,
            specular_reflectance: WHITE,
            specular_transmittance: WHITE,
        }
    );
    assert_eq!(
        material(r#"<bsdf type="thindielectric"/>"#),
        MaterialKind::ThinDielectric {
            int_ior: 1.5046,
            ext_ior: 1.000277,
            specular_reflectance: WHITE,
            specular_transmittance: WHITE,
        }
    );
    assert_eq!(material(""), MaterialKind::Diffuse { reflectance: GREY });
    assert_eq!(
        material(r#"<emitter type="area"/>"#),
        MaterialKind::Diffuse { reflectance: Color::Constant([0.0; 3]) }
    );
}

/// Of 0.6, by its sources: Mitsuba 3 has none of these.
#[test]
fn models_of_0_x_have_its_defaults() {
    let (dim, alpha) = (Color::Constant([0.2; 3]), Scalar::Constant(0.1));
    assert_eq!(
        material(r#"<bsdf type="roughdiffuse"/>"#),
        MaterialKind::RoughDiffuse { reflectance: GREY, alpha: Scalar::Constant(0.2), fast_approx: false }
    );
    assert_eq!(
        material(r#"<bsdf type="phong"/>"#),
        MaterialKind::Phong {
            exponent: Scalar::Constant(30.0),
            diffuse_reflectance: GREY,
            specular_reflectance: dim
        }
    );
    assert_eq!(
        material(r#"<bsdf type="ward"/>"#),
        MaterialKind::Ward {
            variant: WardVariant::Balanced,
            alpha_u: alpha,
            alpha_v: alpha,
            diffuse_reflectance: GREY,
            specular_reflectance: dim,
        }
    );
}

#[test]
fn coats_take_their_parameters() {
    let scene = loaded(r#"<bsdf type="coating"><bsdf type="conductor"/></bsdf>"#);
    let [MaterialKind::Conductor { .. }, MaterialKind::Coated { coat, inner: MaterialId(0) }] =
        [&scene.materials[0].kind, &scene.materials[1].kind]
    else {
        panic!("{:?}", scene.materials)
    };
    assert_eq!(*coat, Coat::default());
    let scene = loaded(
        r#"<bsdf type="roughcoating"><float name="alpha" value="0.3"/><string name="distribution" value="ggx"/>
        <string name="int_ior" value="water"/><float name="ext_ior" value="1"/><float name="thickness" value="2"/>
        <rgb name="sigma_a" value="0.1 2 3"/><texture type="checkerboard" name="specular_reflectance"/>
        <bsdf type="twosided"><bsdf type="diffuse"/></bsdf></bsdf>"#,
    );
    let expected = Coat {
        facets: Some((Distribution::Ggx, 0.3)),
        int_ior: 1.333,
        ext_ior: 1.0,
        thickness: 2.0,
        sigma_a: Color::Constant([0.1, 2.0, 3.0]),
        specular_reflectance: Color::Texture(TextureId(0)),
    };
    let MaterialKind::Coated { coat, .. } = scene.materials[2].kind else { panic!("{:?}", scene.materials) };
    assert_eq!(coat, expected);
    assert_eq!(scene.warnings.len(), 2, "{:?}", scene.warnings); // of the camera, and that Mitsuba 3 has no coats
}

#[test]
fn new_models_take_their_parameters_and_textures() {
    let texture = |name: &str| format!(r#"<texture type="checkerboard" name="{name}"/>"#);
    let of =
        |kind: &str, inside: &[&str]| material(&format!(r#"<bsdf type="{kind}">{}</bsdf>"#, inside.concat()));
    let slots = ["alpha_u", "alpha_v", "specular_reflectance", "specular_transmittance"].map(texture);
    let slots: Vec<&str> = slots.iter().map(String::as_str).collect();
    let MaterialKind::RoughDielectric {
        alpha_u: Scalar::Texture(_),
        alpha_v: Scalar::Texture(_),
        specular_reflectance: Color::Texture(_),
        specular_transmittance: Color::Texture(_),
        ..
    } = of("roughdielectric", &slots)
    else {
        panic!("a slot was not read")
    };
    let both = of(
        "roughdielectric",
        &[r#"<float name="alpha" value="0.3"/><string name="distribution" value="ggx"/>"#],
    );
    let wide = Scalar::Constant(0.3);
    assert!(
        matches!(both, MaterialKind::RoughDielectric { distribution: Distribution::Ggx, alpha_u, alpha_v, .. } if alpha_u == wide && alpha_v == wide)
    );
    let pane = of("thindielectric", &[r#"<string name="int_ior" value="water"/>"#, slots[3]]);
    assert!(matches!(
        pane,
        MaterialKind::ThinDielectric { int_ior: 1.333, specular_transmittance: Color::Texture(_), .. }
    ));
    let plaster =
        of("roughdiffuse", &[&texture("alpha"), r#"<boolean name="use_fast_approx" value="true"/>"#]);
    assert!(matches!(
        plaster,
        MaterialKind::RoughDiffuse { alpha: Scalar::Texture(_), fast_approx: true, .. }
    ));
    let phong = of("phong", &[&texture("exponent"), &texture("diffuse_reflectance"), slots[2]]);
    assert!(matches!(
        phong,
        MaterialKind::Phong {
            exponent: Scalar::Texture(_),
            diffuse_reflectance: Color::Texture(_),
            specular_reflectance: Color::Texture(_)
        }
    ));
    let ward = of(
        "ward",
        &[slots[0], r#"<float name="alpha_v" value="0.3"/><string name="variant" value="ward-duer"/>"#],
    );
    let MaterialKind::Ward { variant: WardVariant::WardDuer, alpha_u: Scalar::Texture(_), alpha_v, .. } =
        ward
    else {
        panic!("{ward:?}")
    };
    assert_eq!(alpha_v, wide);
}

#[test]
fn metals_and_substances_go_by_name_or_number() {
    let ior = |parameters: &str| match material(&format!(r#"<bsdf type="conductor">{parameters}</bsdf>"#)) {
        MaterialKind::Conductor { ior, .. } => ior.map(|ior| (ior.eta, ior.k)),
        other => panic!("{other:?}"),
    };
    assert_eq!(ior(r#"<string name="material" value="none"/>"#), None);
    let copper = ior(r#"<string name="material" value="Cu"/>"#);
    assert_eq!(copper.unwrap().0, Color::Constant([0.2010055, 0.9237495, 1.102215]));
    let given = r#"<rgb name="eta" value="2 4 6"/><rgb name="k" value="1"/>"#;
    assert_eq!(ior(given), Some((Color::Constant([2.0, 4.0, 6.0]), WHITE)));
    let outside = format!(r#"{given}<float name="ext_eta" value="2"/>"#);
    assert_eq!(ior(&outside), Some((Color::Constant([1.0, 2.0, 3.0]), GREY)));

    let glass = r#"<bsdf type="dielectric"><string name="int_ior" value="Diamond"/><float name="ext_ior" value="1"/></bsdf>"#;
    assert!(matches!(material(glass), MaterialKind::Dielectric { int_ior: 2.419, ext_ior: 1.0, .. }));
}

#[test]
fn two_sided_wraps_one_or_two_but_no_glass() {
    let sides = |inside: &str| {
        let scene = loaded(&format!(r#"<shape type="sphere"><bsdf type="twosided">{inside}</bsdf></shape>"#));
        let kind = |i: u32| scene.materials[i as usize].kind.clone();
        match kind(scene.shapes[0].material.0) {
            MaterialKind::TwoSided { front, back } => {
                (kind(front.0), Some(kind(back.0)), scene.warnings.len())
            }
            other => (other, None, scene.warnings.len()),
        }
    };
    let diffuse = MaterialKind::Diffuse { reflectance: GREY };
    assert_eq!(sides(r#"<bsdf type="diffuse"/>"#), (diffuse.clone(), Some(diffuse.clone()), 1));
    let (front, back, _) = sides(r#"<bsdf type="diffuse"/><bsdf type="plastic"/>"#);
    assert_eq!(front, diffuse);
    assert!(matches!(back, Some(MaterialKind::Plastic { .. })));
    let (front, back, _) =
        sides(r#"<bsdf type="twosided"><bsdf type="diffuse"/><bsdf type="plastic"/></bsdf>"#);
    assert_eq!(front, diffuse);
    assert!(matches!(back, Some(MaterialKind::Plastic { .. })));
    let (glass, back, warnings) = sides(r#"<bsdf type="dielectric"/>"#);
    assert!(matches!(glass, MaterialKind::Dielectric { .. }) && back.is_none() && warnings == 2);
    let (glass, back, warnings) = sides(r#"<bsdf type="roughdielectric"/>"#);
    assert!(matches!(glass, MaterialKind::RoughDielectric { .. }) && back.is_none() && warnings == 2);
    let (glass, back, warnings) = sides(r#"<bsdf type="diffuse"/><bsdf type="thindielectric"/>"#);
    assert!(matches!(glass, MaterialKind::ThinDielectric { .. }) && back.is_none() && warnings == 2);
}
