use glam::{DVec3, Vec3};

use super::*;
use crate::testing::{camera, diffuse, scene};

const GREY: Color = Color::Constant([0.5; 3]);

fn glass(int_ior: f32) -> MaterialKind {
    MaterialKind::Dielectric {
        int_ior,
        ext_ior: 1.0,
        specular_reflectance: GREY,
        specular_transmittance: GREY,
    }
}

fn rough_plastic(alpha: f32) -> MaterialKind {
    MaterialKind::RoughPlastic {
        distribution: Distribution::Ggx,
        alpha,
        int_ior: 1.5,
        ext_ior: 1.0,
        diffuse_reflectance: GREY,
        specular_reflectance: GREY,
        nonlinear: false,
    }
}

fn rough_conductor(alpha_u: f32, alpha_v: f32) -> MaterialKind {
    MaterialKind::RoughConductor {
        distribution: Distribution::Ggx,
        alpha_u: Scalar::Constant(alpha_u),
        alpha_v: Scalar::Constant(alpha_v),
        ior: None,
        specular_reflectance: GREY,
    }
}

fn two_sided(front: u32, back: u32) -> MaterialKind {
    MaterialKind::TwoSided { front: MaterialId(front), back: MaterialId(back) }
}

fn of(kinds: Vec<MaterialKind>) -> (Scene, Result<Materials, PrepareError>) {
    let scene = scene(camera(DVec3::ZERO, DVec3::X, 1, 1), kinds);
    let materials = Materials::prepare(&scene);
    (scene, materials)
}

#[test]
fn each_side_of_a_two_sided_material_is_lit_from_its_own_side() {
    let (scene, materials) = of(vec![diffuse(0.2), diffuse(0.7), two_sided(0, 1)]);
    let (materials, textures) = (materials.unwrap(), Textures::prepare(&scene));
    let at = |id, behind| materials.bsdf(MaterialId(id), Vec2::ZERO, &textures, behind);
    let albedo = |bsdf: Bsdf| bsdf.features(Vec3::Z).albedo.x;
    let (front, turned) = at(2, false);
    assert_eq!((albedo(front), turned), (0.2, false));
    let (back, turned) = at(2, true);
    assert_eq!((albedo(back), turned), (0.7, true));
    // One-sided: nobody turns it over, so that it is black from behind.
    assert!(!at(0, true).1);
}

#[test]
fn what_has_two_sides_already_is_not_wrapped() {
    for inner in [glass(1.5), two_sided(0, 0)] {
        let error = of(vec![diffuse(0.5), inner, two_sided(0, 1)]).1.err().expect("no such material");
        assert!(error.to_string().contains("bsdf \"m2\": \"m1\" inside it has two sides"), "{error}");
    }
}

#[test]
fn indices_without_a_ratio_are_errors() {
    for ior in [0.0, -1.5, f32::NAN, f32::INFINITY, 1e-42] {
        let error = of(vec![glass(ior)]).1.err().unwrap_or_else(|| panic!("{ior} was taken"));
        assert!(error.to_string().contains("indices of refraction"), "{error}");
    }
    assert!(of(vec![glass(1.0)]).1.is_ok());
}

#[test]
fn like_coatings_share_a_table() {
    let materials = of(vec![rough_plastic(0.1), rough_plastic(0.2), rough_plastic(0.1)]).1.unwrap();
    assert_eq!(materials.coatings.len(), 2);
}

#[test]
fn only_unequal_widths_need_the_direction_of_u() {
    let kinds = vec![rough_conductor(0.1, 0.1), rough_conductor(0.1, 0.2), diffuse(0.5), two_sided(2, 1)];
    let materials = of(kinds).1.unwrap();
    let anisotropic: Vec<bool> = (0..4).map(|i| materials.is_anisotropic(MaterialId(i))).collect();
    assert_eq!(anisotropic, [false, true, false, true]);
}
