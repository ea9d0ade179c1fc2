use glam::{DVec3, Vec2, Vec3};
use limpid_scenes::{Coat, Distribution, MaterialId, MaterialKind, NormalMap, Scalar, Scene};

use super::*;
use crate::bsdf::{Lobes, Perturbation};
use crate::color::Rgb;
use crate::material::{At, Map, Materials};
use crate::testing::{camera, diffuse, scene};

fn of(kinds: Vec<MaterialKind>) -> (Scene, Result<Materials, PrepareError>) {
    let scene = scene(camera(DVec3::ZERO, DVec3::X, 1, 1), kinds);
    let materials = Materials::prepare(&scene);
    (scene, materials)
}

fn coated(inner: u32) -> MaterialKind {
    MaterialKind::Coated { coat: Coat::default(), inner: MaterialId(inner) }
}

fn two_sided(inner: u32) -> MaterialKind {
    MaterialKind::TwoSided { front: MaterialId(inner), back: MaterialId(inner) }
}

fn bumped(inner: u32) -> MaterialKind {
    MaterialKind::Perturbed {
        map: NormalMap::Normal(Color::Constant([0.6, 0.4, 0.9])),
        flip_invalid: true,
        shadowing: false,
        inner: MaterialId(inner),
    }
}

/// What `look` makes of the lobes of the last material, seen from `wo`.
fn with<T>(kinds: Vec<MaterialKind>, wo: Vec3, look: impl FnOnce(&Lobes) -> T) -> T {
    let id = MaterialId(kinds.len() as u32 - 1);
    let (scene, materials) = of(kinds);
    let (materials, textures) = (materials.unwrap(), Textures::prepare(&scene));
    let map = |_: &Map, _| Perturbation::new(Vec3::new(0.1, 0.2, 1.0), false);
    let at = At { material: id, uv: Vec2::ZERO.into(), behind: wo.z < 0.0 };
    let mut lobes = Lobes::default();
    materials.add_lobes(at, wo, 0.0, &textures, map, &mut lobes);
    look(&lobes)
}

/// `f · cos θi` at a slant, and whether there is a mirror direction, seen from the front or from behind.
fn seen(kinds: Vec<MaterialKind>, behind: bool) -> (Rgb, bool) {
    let side = if behind { Vec3::new(1.0, 1.0, -1.0) } else { Vec3::ONE };
    let (wo, wi) = (Vec3::new(0.6, 0.0, 0.8) * side, Vec3::new(-0.48, 0.6, 0.64) * side);
    with(kinds, wo, |lobes| {
        let shines = lobes.sample(wo, 0.0, Vec2::ZERO).is_some_and(|s| s.delta && s.wi.z * wo.z > 0.0);
        (lobes.eval(wo, wi).f_cos.total(), shines)
    })
}

#[test]
fn a_coat_shines_on_both_sides_and_its_base_on_its_own() {
    let (front, shines) = seen(vec![diffuse(0.5), coated(0)], false);
    assert!(front.x > 0.0 && shines);
    assert_eq!(seen(vec![diffuse(0.5), coated(0)], true), (Rgb::ZERO, true));
    for kinds in [vec![diffuse(0.5), two_sided(0), coated(1)], vec![diffuse(0.5), coated(0), two_sided(1)]] {
        assert_eq!(seen(kinds.clone(), false), (front, true));
        assert_eq!(seen(kinds, true), (front, true));
    }
}

/// A map below the coat leaves its reflection where it was.
#[test]
fn a_coat_lies_over_the_map_inside_it_and_in_the_map_around_it() {
    let mirrored = |kinds| {
        with(kinds, Vec3::Z, |lobes| lobes.sample(Vec3::Z, 0.0, Vec2::ZERO).expect("the coat reflects").wi)
    };
    assert_eq!(mirrored(vec![diffuse(0.5), bumped(0), coated(1)]), Vec3::Z);
    assert!(mirrored(vec![diffuse(0.5), coated(0), bumped(1)]).z < 0.95);
    let below = seen(vec![diffuse(0.5), bumped(0), coated(1)], false).0;
    let around = seen(vec![diffuse(0.5), coated(0), bumped(1)], false).0;
    assert!(below.x > 0.0 && around.x > 0.0 && below != around, "{below} {around}");
}

#[test]
fn what_a_coat_cannot_cover_is_refused() {
    let refused = |kinds: Vec<MaterialKind>| of(kinds).1.err().expect("is refused").problem;
    assert_eq!(refused(vec![diffuse(0.5), coated(0), coated(1)]), "a coat inside another");
    let mask = MaterialKind::Mask { opacity: Scalar::Constant(0.5), inner: MaterialId(0) };
    for inner in [MaterialKind::Null, mask] {
        let problem = refused(vec![diffuse(0.5), inner, coated(1)]);
        assert!(
            problem.starts_with("its coat covers ") && problem.ends_with("lets light through"),
            "{problem}"
        );
    }
    let coat = Coat { int_ior: 0.0, ..Coat::default() };
    let problem = refused(vec![diffuse(0.5), MaterialKind::Coated { coat, inner: MaterialId(0) }]);
    assert!(problem.contains("have no ratio"), "{problem}");
    let parts = |n: u32| MaterialKind::Mixture { parts: vec![(0.1, MaterialId(1)); n as usize] };
    assert!(of(vec![diffuse(0.5), coated(0), parts(4)]).1.is_ok());
    let problem = refused(vec![diffuse(0.5), coated(0), parts(5)]);
    assert!(problem.contains("more than"), "{problem}");
}

#[test]
fn rough_coats_share_tables_and_absorb() {
    let rough = |sigma: f32| {
        let facets = Some((Distribution::Ggx, 0.3));
        let coat =
            Coat { facets, sigma_a: Color::Constant([sigma, 0.0, 0.0]), thickness: 2.0, ..Coat::default() };
        MaterialKind::Coated { coat, inner: MaterialId(0) }
    };
    assert_eq!(of(vec![diffuse(0.5), rough(1.0), rough(0.0)]).1.unwrap().coatings.len(), 1);
    let (clear, tinted) =
        (seen(vec![diffuse(0.5), rough(0.0)], false).0, seen(vec![diffuse(0.5), rough(1.0)], false).0);
    assert!(tinted.x < 0.2 * clear.x && tinted.y == clear.y, "{tinted} {clear}");
}
