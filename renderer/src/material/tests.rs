use glam::{DVec3, Vec2, Vec3};

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

fn seen(id: u32, behind: bool) -> At {
    At { material: MaterialId(id), uv: Vec2::ZERO.into(), behind }
}

#[test]
fn each_side_of_a_two_sided_material_is_lit_from_its_own_side() {
    let (scene, materials) = of(vec![diffuse(0.2), diffuse(0.7), two_sided(0, 1)]);
    let (materials, textures) = (materials.unwrap(), Textures::prepare(&scene));
    let albedo = |id, behind| {
        let mut lobes = Lobes::default();
        let no_map = |_: &Map, _| unreachable!();
        let wo = if behind { Vec3::NEG_Z } else { Vec3::Z };
        materials.add_lobes(seen(id, behind), wo, 0.0, &textures, no_map, &mut lobes);
        (lobes.features(wo).albedo.x, lobes.normal())
    };
    assert_eq!(albedo(2, false), (0.2, Vec3::Z));
    assert_eq!(albedo(2, true), (0.7, Vec3::NEG_Z));
    // One-sided: nobody turns it over, so that it is black from behind.
    assert_eq!(albedo(0, true), (0.0, Vec3::Z));
}

/// Albedos and shares of the BSDFs on one side, and the hole.
fn pieces(scene: &Scene, materials: &Materials, id: u32, behind: bool) -> (Vec<(f32, f32)>, f32) {
    let textures = Textures::prepare(scene);
    let hole = materials.hole(seen(id, behind), &textures);
    let side = materials.side(seen(id, behind));
    let pieces = side.pieces.iter().map(|piece| {
        let Model::Diffuse { albedo } = piece.model else { panic!("only diffuse ones here") };
        (textures.color(albedo, Vec2::ZERO).x, share(&piece.share, Vec2::ZERO, &textures))
    });
    (pieces.collect(), hole)
}

fn blend(weight: f32, first: u32, second: u32) -> MaterialKind {
    MaterialKind::Blend {
        weight: Scalar::Constant(weight),
        first: MaterialId(first),
        second: MaterialId(second),
    }
}

fn mask(opacity: f32, inner: u32) -> MaterialKind {
    MaterialKind::Mask { opacity: Scalar::Constant(opacity), inner: MaterialId(inner) }
}

#[test]
fn nesting_becomes_a_list_of_shares() {
    let (scene, materials) = of(vec![
        diffuse(0.2),
        diffuse(0.6),
        two_sided(0, 1),
        mask(0.25, 2),
        blend(0.5, 3, 1),
        MaterialKind::Null,
        blend(0.75, 4, 5),
        MaterialKind::Mixture { parts: vec![(0.25, MaterialId(0)), (0.5, MaterialId(1))] },
    ]);
    let materials = materials.unwrap();
    let of = |id, behind| pieces(&scene, &materials, id, behind);
    assert_eq!(of(3, false), (vec![(0.2, 0.25)], 0.75));
    assert_eq!(of(3, true), (vec![(0.6, 0.25)], 0.75));
    assert_eq!(of(4, false), (vec![(0.2, 0.125), (0.6, 0.5)], 0.375));
    assert_eq!(of(4, true), (vec![(0.6, 0.125)], 0.375));
    assert_eq!(of(5, false), (vec![], 1.0));
    assert_eq!(of(6, false), (vec![(0.2, 0.03125), (0.6, 0.125)], 0.84375));
    assert_eq!(of(7, false), (vec![(0.2, 0.25), (0.6, 0.5)], 0.0));
    // Out of range shares are brought into it.
    assert_eq!(
        share(&Share::default().times(Scalar::Constant(7.0), false), Vec2::ZERO, &Textures::prepare(&scene)),
        1.0
    );
    let nan = Share::default().times(Scalar::Constant(f32::NAN), false);
    assert_eq!(share(&nan, Vec2::ZERO, &Textures::prepare(&scene)), 0.0);
}

#[test]
fn too_many_bsdfs_are_an_error_and_no_hang() {
    let mut kinds = vec![diffuse(0.2)];
    kinds.extend((0..40).map(|id| blend(0.5, id, id)));
    let error = of(kinds).1.err().expect("2^40 of them");
    assert!(error.to_string().contains("more than 8 bsdfs"), "{error}");
}

#[test]
fn maps_do_not_nest() {
    let bump = |inner| MaterialKind::Perturbed {
        map: limpid_scenes::NormalMap::Bump { height: Scalar::Constant(1.0), scale: 1.0 },
        flip_invalid: true,
        shadowing: true,
        inner: MaterialId(inner),
    };
    let error = of(vec![diffuse(0.2), bump(0), bump(1)]).1.err().expect("nested");
    assert!(error.to_string().contains("inside another"), "{error}");
}

fn rough_glass(alpha_u: f32, alpha_v: f32) -> MaterialKind {
    MaterialKind::RoughDielectric {
        distribution: Distribution::Ggx,
        alpha_u: Scalar::Constant(alpha_u),
        alpha_v: Scalar::Constant(alpha_v),
        int_ior: 1.5,
        ext_ior: 1.0,
        specular_reflectance: GREY,
        specular_transmittance: GREY,
    }
}

fn pane(int_ior: f32) -> MaterialKind {
    MaterialKind::ThinDielectric {
        int_ior,
        ext_ior: 1.0,
        specular_reflectance: GREY,
        specular_transmittance: GREY,
    }
}

#[test]
fn what_has_two_sides_already_is_not_wrapped() {
    for inner in [glass(1.5), rough_glass(0.1, 0.1), pane(1.5), two_sided(0, 0)] {
        let error = of(vec![diffuse(0.5), inner, two_sided(0, 1)]).1.err().expect("no such material");
        assert!(error.to_string().contains("bsdf \"m2\": \"m1\" inside it has two sides"), "{error}");
    }
}

#[test]
fn indices_without_a_ratio_are_errors() {
    for ior in [0.0, -1.5, f32::NAN, f32::INFINITY, 1e-42] {
        let error = of(vec![glass(ior)]).1.err().unwrap_or_else(|| panic!("{ior} was taken"));
        assert!(error.to_string().contains("indices of refraction"), "{error}");
        assert!(of(vec![pane(ior)]).1.is_err());
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
    let ward = MaterialKind::Ward {
        variant: WardVariant::Balanced,
        alpha_u: Scalar::Constant(0.1),
        alpha_v: Scalar::Constant(0.2),
        diffuse_reflectance: GREY,
        specular_reflectance: GREY,
    };
    let kinds = vec![
        rough_conductor(0.1, 0.1),
        rough_conductor(0.1, 0.2),
        diffuse(0.5),
        two_sided(2, 1),
        rough_glass(0.1, 0.1),
        rough_glass(0.1, 0.2),
        ward,
    ];
    let materials = of(kinds).1.unwrap();
    let anisotropic: Vec<bool> = (0..7).map(|i| materials.needs_tangent(MaterialId(i))).collect();
    assert_eq!(anisotropic, [false, true, false, true, false, true, true]);
}

#[test]
fn textures_reach_every_number_of_the_new_models() {
    use limpid_scenes::{Place, Texture, TextureId, TextureKind};
    let kinds = |scalar: Scalar| {
        let MaterialKind::RoughDielectric { distribution, int_ior, ext_ior, .. } = rough_glass(0.1, 0.1)
        else {
            unreachable!("just made")
        };
        let (white, color) = (Color::Constant([0.3; 3]), Color::Texture(TextureId(0)));
        [
            MaterialKind::RoughDielectric {
                distribution,
                alpha_u: scalar,
                alpha_v: scalar,
                int_ior,
                ext_ior,
                specular_reflectance: color,
                specular_transmittance: color,
            },
            MaterialKind::ThinDielectric {
                int_ior,
                ext_ior,
                specular_reflectance: white,
                specular_transmittance: color,
            },
            MaterialKind::RoughDiffuse { reflectance: color, alpha: scalar, fast_approx: false },
            MaterialKind::Phong { exponent: scalar, diffuse_reflectance: color, specular_reflectance: white },
            MaterialKind::Ward {
                variant: WardVariant::Ward,
                alpha_u: scalar,
                alpha_v: scalar,
                diffuse_reflectance: white,
                specular_reflectance: color,
            },
        ]
    };
    let board = |low: f32| Texture {
        name: "t".into(),
        kind: TextureKind::Checkerboard {
            color0: Color::Constant([0.6; 3]),
            color1: Color::Constant([low; 3]),
        },
        uv_from_surface: glam::DMat3::IDENTITY,
        place: Place::default(),
    };
    for (i, kind) in kinds(Scalar::Texture(TextureId(1))).into_iter().enumerate() {
        // Numbers alone, then colours alone, differ between two squares.
        for boards in [[0.6, 0.1], [0.1, 0.6]] {
            let mut scene = of(vec![kind.clone()]).0;
            scene.textures = boards.map(board).to_vec();
            let (materials, textures) = (Materials::prepare(&scene).unwrap(), Textures::prepare(&scene));
            let side = materials.side(seen(0, false));
            let at = |u| materials.at(&side.pieces[0].model, Vec2::new(u, 0.25).into(), &textures);
            let has_numbers = !matches!(kind, MaterialKind::ThinDielectric { .. });
            assert_eq!(at(0.25) != at(0.75), has_numbers || boards[0] == 0.1, "model {i}, {boards:?}");
        }
    }
}
