//! Materials made of others.

use super::{loaded, try_load};
use crate::{Color, MaterialKind, NormalMap, Scalar, Scene};

fn of(bsdf: &str) -> (MaterialKind, Scene) {
    let scene = loaded(&format!(r#"<shape type="sphere">{bsdf}</shape>"#));
    let kind = scene.materials[scene.shapes[0].material.0 as usize].kind.clone();
    (kind, scene)
}

const RED: &str = r#"<bsdf type="diffuse"><rgb name="reflectance" value="1 0 0"/></bsdf>"#;
const HALF: Scalar = Scalar::Constant(0.5);

#[test]
fn masks_and_blends_have_the_defaults_of_mitsuba() {
    assert!(matches!(of(r#"<bsdf type="null"/>"#).0, MaterialKind::Null));
    let (mask, scene) = of(&format!(r#"<bsdf type="mask">{RED}</bsdf>"#));
    let MaterialKind::Mask { opacity: HALF, inner } = mask else { panic!("{mask:?}") };
    let red = Color::Constant([1.0, 0.0, 0.0]);
    assert_eq!(scene.materials[inner.0 as usize].kind, MaterialKind::Diffuse { reflectance: red });

    let (blend, scene) = of(&format!(
        r#"<bsdf type="blendbsdf"><float name="weight" value="0.25"/>{RED}<bsdf type="plastic"/></bsdf>"#
    ));
    let MaterialKind::Blend { weight: Scalar::Constant(0.25), first, second } = blend else {
        panic!("{blend:?}")
    };
    assert!(matches!(scene.materials[first.0 as usize].kind, MaterialKind::Diffuse { .. }));
    assert!(matches!(scene.materials[second.0 as usize].kind, MaterialKind::Plastic { .. }));
}

#[test]
fn the_opacity_of_a_colour_is_its_luminance() {
    let (mask, _) = of(&format!(r#"<bsdf type="mask"><rgb name="opacity" value="0 1 0"/>{RED}</bsdf>"#));
    let MaterialKind::Mask { opacity: Scalar::Constant(opacity), .. } = mask else { panic!("{mask:?}") };
    assert!((opacity - 0.715_169).abs() < 1e-6, "{opacity}");
}

#[test]
fn maps_take_a_texture_of_any_name() {
    for name in ["", r#" name="bumps""#] {
        let (bump, _) = of(&format!(
            r#"<bsdf type="bumpmap"><texture type="checkerboard"{name}/><float name="scale" value="3"/>{RED}</bsdf>"#
        ));
        let MaterialKind::Perturbed {
            map: NormalMap::Bump { height: Scalar::Texture(_), scale: 3.0 },
            flip_invalid: true,
            shadowing: true,
            ..
        } = bump
        else {
            panic!("{bump:?}")
        };
    }
    let (normal, _) = of(&format!(
        r#"<bsdf type="normalmap"><texture name="normalmap" type="checkerboard"/>
           <boolean name="use_shadowing_function" value="false"/>{RED}</bsdf>"#
    ));
    assert!(
        matches!(
            normal,
            MaterialKind::Perturbed { map: NormalMap::Normal(Color::Texture(_)), shadowing: false, .. }
        ),
        "{normal:?}"
    );
}

#[test]
fn weights_beyond_one_are_divided_by_their_sum() {
    let mixture = |weights: &str| {
        of(&format!(
            r#"<bsdf type="mixturebsdf"><string name="weights" value="{weights}"/>{RED}<bsdf type="plastic"/></bsdf>"#
        ))
    };
    let weights = |kind: &MaterialKind| match kind {
        MaterialKind::Mixture { parts } => [parts[0].0, parts[1].0],
        other => panic!("{other:?}"),
    };
    let notes = |scene: &Scene| scene.warnings.iter().filter(|w| w.element != "scene").count();
    let (kind, scene) = mixture("0.2, 0.3");
    assert_eq!((weights(&kind), notes(&scene)), ([0.2, 0.3], 0), "{:?}", scene.warnings);
    let (kind, scene) = mixture("1 3");
    assert_eq!((weights(&kind), notes(&scene)), ([0.25, 0.75], 1), "{:?}", scene.warnings);
}

#[test]
fn what_is_missing_inside_is_named() {
    let cases = [
        (r#"<bsdf type="mask"/>"#, "0 bsdfs inside"),
        (r#"<bsdf type="blendbsdf"><bsdf type="plastic"/></bsdf>"#, "1 bsdfs inside"),
        (r#"<bsdf type="bumpmap"><bsdf type="plastic"/></bsdf>"#, "0 textures inside"),
        (r#"<bsdf type="mixturebsdf"><bsdf type="plastic"/></bsdf>"#, "no \"weights\""),
        (
            r#"<bsdf type="mixturebsdf"><string name="weights" value="1 2"/><bsdf type="plastic"/></bsdf>"#,
            "2 weights for 1 bsdfs",
        ),
        (
            r#"<bsdf type="mixturebsdf"><string name="weights" value="-1"/><bsdf type="plastic"/></bsdf>"#,
            "the weight -1 is negative",
        ),
        (r#"<bsdf type="mask"><float name="opacity" value="1.5"/><bsdf type="plastic"/></bsdf>"#, "1.5"),
    ];
    for (bsdf, problem) in cases {
        let error = try_load(bsdf).expect_err(bsdf).to_string();
        assert!(error.contains(problem), "{bsdf}: {error}");
    }
}
