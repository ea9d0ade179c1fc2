use limpid_testkit::{Random, assert_chi2, furnace};

use super::*;
use crate::bsdf::{Conductor, Dielectric, Diffuse, Microfacet, RoughConductor};

const WHITE: Rgb = Rgb::ONE;

fn diffuse(albedo: f32) -> Bsdf<'static> {
    Bsdf::Diffuse(Diffuse { albedo: Rgb::splat(albedo) })
}

fn metal(alpha: f32) -> Bsdf<'static> {
    let facets = Microfacet::new(limpid_scenes::Distribution::Ggx, alpha, alpha);
    Bsdf::RoughConductor(RoughConductor { facets, ior: None, specular: WHITE })
}

fn mirror() -> Bsdf<'static> {
    Bsdf::Conductor(Conductor { ior: None, specular: WHITE })
}

fn glass() -> Bsdf<'static> {
    Bsdf::Dielectric(Dielectric { eta: 1.5, reflectance: WHITE, transmittance: WHITE })
}

fn tilted(shadowing: bool) -> Turn {
    Turn { map: Some(Perturbation::new(Vec3::new(0.3, -0.2, 1.0), shadowing)), ..Turn::default() }
}

const OVER: Turn = Turn { before: true, map: None, after: false };

fn lobes(list: &[(f32, Turn, Bsdf<'static>)]) -> Lobes<'static> {
    let mut lobes = Lobes::default();
    list.iter().for_each(|&(weight, turn, bsdf)| lobes.push(weight, turn, Layer::Bare, bsdf));
    lobes
}

/// The mixtures that the tests below run over, and the sides they scatter from.
fn cases() -> Vec<(&'static str, Lobes<'static>, f32)> {
    let none = Turn::default();
    let under_map = Turn { after: true, ..tilted(false) };
    let around_map = Turn { before: true, ..tilted(true) };
    vec![
        ("one", lobes(&[(0.4, none, diffuse(0.8))]), 1.0),
        ("blend", lobes(&[(0.3, none, diffuse(0.5)), (0.7, none, metal(0.3))]), 1.0),
        (
            "with a mirror",
            lobes(&[(0.5, none, mirror()), (0.25, none, metal(0.2)), (0.25, none, diffuse(1.0))]),
            1.0,
        ),
        ("turned over", lobes(&[(0.6, OVER, metal(0.3)), (0.4, OVER, diffuse(1.0))]), -1.0),
        ("tilted", lobes(&[(1.0, tilted(false), metal(0.3))]), 1.0),
        ("tilted and shadowed", lobes(&[(0.5, tilted(true), diffuse(1.0)), (0.5, none, diffuse(0.3))]), 1.0),
        ("two-sided in a map", lobes(&[(1.0, under_map, diffuse(0.9))]), -1.0),
        ("map in two-sided", lobes(&[(0.9, around_map, metal(0.4))]), -1.0),
        ("glass and more", lobes(&[(0.5, none, glass()), (0.5, none, diffuse(0.5))]), 1.0),
    ]
}

fn direction(cos: f32) -> Vec3 {
    let sin = (1.0 - cos * cos).sqrt();
    Vec3::new(0.8 * sin, -0.6 * sin, cos)
}

#[test]
fn draws_follow_their_density() {
    for (name, lobes, side) in cases() {
        println!("{name}");
        for cos in [0.9, 0.4] {
            let wo = direction(cos * side);
            let draw = |u_lobe, u| lobes.sample(wo, u_lobe, u).filter(|s| !s.delta).map(|s| s.wi);
            assert_chi2(draw, |wi| lobes.eval(wo, wi).pdf);
        }
    }
}

#[test]
fn sample_agrees_with_eval() {
    let mut random = Random::new(1);
    for (name, lobes, side) in cases() {
        let mut seen = 0;
        for cos in [1.0, 0.7, 0.2] {
            let wo = direction(cos * side);
            for _ in 0..2000 {
                let Some(s) = lobes.sample(wo, random.uniform(), random.uniform2()).filter(|s| !s.delta)
                else {
                    continue;
                };
                seen += 1;
                let value = lobes.eval(wo, s.wi);
                assert!((s.pdf / value.pdf - 1.0).abs() < 1e-4, "{name}: {s:?} {value:?}");
                let (a, b) = ((s.weight * s.pdf).total().x, value.f_cos.total().x);
                assert!((a - b).abs() <= 1e-4 * b, "{name}: {s:?} {value:?}");
            }
        }
        assert!(seen > 1000, "{name}: {seen} draws");
    }
}

/// The mean weight is the albedo, which adds up over the lobes, delta ones included.
#[test]
fn albedos_add_up_by_weight() {
    let wo = direction(0.6);
    let none = Turn::default();
    let mixed = lobes(&[(0.25, none, mirror()), (0.5, none, diffuse(0.5)), (0.125, none, glass())]);
    let energy = furnace(1 << 16, |u_lobe, u| {
        mixed.sample(wo, u_lobe, u).map_or(Vec3::ZERO, |s| {
            // glass scales radiance by 1/eta² on its way in
            s.weight.total() * s.eta * s.eta
        })
    });
    assert!((energy.x - (0.25 + 0.25 + 0.125)).abs() < 2e-3, "{energy}");
    assert!((mixed.features(wo).albedo.x - 0.625).abs() < 0.03);
}

#[test]
fn a_lobe_of_no_weight_is_left_out() {
    let mut lobes = lobes(&[(0.0, Turn::default(), diffuse(0.5))]);
    assert!(lobes.sample(Vec3::Z, 0.5, Vec2::splat(0.5)).is_none() && !lobes.has_non_delta());
    lobes.push(1.0, Turn::default(), Layer::Bare, mirror());
    assert!(lobes.near_delta());
}

#[test]
fn the_normal_of_the_weightiest_lobe_counts() {
    let up = lobes(&[(0.4, OVER, diffuse(0.5)), (0.6, Turn::default(), diffuse(0.5))]);
    assert_eq!(up.normal(), Vec3::Z);
    let n = Vec3::new(0.3, -0.2, 1.0).normalize();
    assert!((lobes(&[(1.0, tilted(true), diffuse(0.5))]).normal() - n).length() < 1e-6);
    let after = Turn { after: true, ..tilted(true) };
    assert!((lobes(&[(1.0, after, diffuse(0.5))]).normal() + n).length() < 1e-6);
    let before = Turn { before: true, ..tilted(true) };
    let mirrored = Vec3::new(n.x, n.y, -n.z);
    assert!((lobes(&[(1.0, before, diffuse(0.5))]).normal() - mirrored).length() < 1e-6);
}

#[test]
fn degenerate_normals_and_horizons_are_finite() {
    for n in [Vec3::ZERO, Vec3::NAN, Vec3::X, Vec3::NEG_Z, Vec3::splat(1e-30), Vec3::splat(1e30)] {
        let turn = Turn { map: Some(Perturbation::new(n, true)), ..Turn::default() };
        let lobes = lobes(&[(0.5, turn, metal(0.2)), (0.5, turn, diffuse(0.5))]);
        for wo in [1.0, 1e-3, 1e-20, 0.0, -0.5].map(direction) {
            for u in [0.0, 0.3, 0.7, 1.0f32.next_down()] {
                if let Some(s) = lobes.sample(wo, u, Vec2::new(u, 0.4)) {
                    assert!(
                        s.wi.is_finite() && s.weight.total().is_finite() && s.pdf.is_finite(),
                        "{n} {wo} {s:?}"
                    );
                }
                let value = lobes.eval(wo, direction(u));
                assert!(value.f_cos.total().is_finite() && value.pdf.is_finite(), "{n} {wo} {value:?}");
            }
        }
    }
}
