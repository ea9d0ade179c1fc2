use glam::{Vec2, Vec3};
use limpid_scenes::Distribution::Ggx;
use limpid_testkit::{Random, assert_chi2, furnace};

use super::*;
use crate::bsdf::{
    Bsdf, Conductor, Diffuse, Lobes, Microfacet, Perturbation, Plastic, RoughConductor, RoughPlastic, Turn,
};
use std::sync::LazyLock;

static ROUGH: LazyLock<Coating> = LazyLock::new(|| Coating::new(Ggx, 0.3, 1.5));

const AMBER: Vec3 = Vec3::new(0.05, 0.3, 1.0);

fn coat(eta: f32, depth: Rgb, rough: bool) -> Coat<'static> {
    Coat { eta, depth, rough: rough.then_some(&ROUGH), in_map: false, share: 0.5 }
}

fn diffuse(albedo: f32) -> Bsdf<'static> {
    Bsdf::Diffuse(Diffuse { albedo: Rgb::splat(albedo) })
}

fn metal(alpha: f32) -> Bsdf<'static> {
    let facets = Microfacet::new(Ggx, alpha, alpha);
    Bsdf::RoughConductor(RoughConductor { facets, ior: None, specular: Rgb::ONE })
}

fn mirror() -> Bsdf<'static> {
    Bsdf::Conductor(Conductor { ior: None, specular: Rgb::ONE })
}

/// `base` under `coat`, with the coat's own reflection, seen from `wo`.
fn coated(coat: Coat<'static>, turn: Turn, base: Bsdf<'static>, wo: Vec3) -> Lobes<'static> {
    let mut lobes = Lobes::default();
    lobes.push_coat(coat.shared(wo.z, Rgb::ONE));
    let top = match coat.rough {
        Some(coating) => Bsdf::RoughPlastic(RoughPlastic::new(coating, Rgb::ZERO, Rgb::ONE, false)),
        None => Bsdf::Plastic(Plastic::new(coat.eta, 0.5, Rgb::ZERO, Rgb::ONE, false)),
    };
    let around = if coat.in_map { turn } else { Turn { map: None, after: false, ..turn } };
    lobes.push(1.0, around, Layer::Top(0), top);
    lobes.push(1.0, turn, Layer::Under(0), base);
    lobes
}

type Case = (&'static str, Coat<'static>, Turn, Bsdf<'static>, f32);

/// Coats with what they cover and the side that is looked at.
fn cases() -> Vec<Case> {
    let (none, clear) = (Turn::default(), Rgb::ZERO);
    let map = Some(Perturbation::new(Vec3::new(0.3, -0.2, 1.0), true));
    let tilted = Turn { map, ..none };
    let over = Turn { before: true, ..none };
    vec![
        ("diffuse", coat(1.5, clear, false), none, diffuse(1.0), 1.0),
        ("absorbing, on metal", coat(1.5, AMBER, false), none, metal(0.3), 1.0),
        ("rough, on metal", coat(1.5, AMBER, true), none, metal(0.2), 1.0),
        ("rough, on diffuse", coat(1.5, clear, true), none, diffuse(0.8), 1.0),
        ("thinner than the outside", coat(0.8, clear, false), none, diffuse(0.8), 1.0),
        ("around a map", coat(1.5, AMBER, false), tilted, metal(0.3), 1.0),
        ("in a map", Coat { in_map: true, ..coat(1.5, AMBER, true) }, tilted, diffuse(0.8), 1.0),
        ("turned over", coat(1.5, AMBER, false), over, metal(0.4), -1.0),
        ("of no index", coat(1.0, AMBER, false), none, diffuse(0.8), 1.0),
    ]
}

fn direction(cos: f32) -> Vec3 {
    let sin = (1.0 - cos * cos).sqrt();
    Vec3::new(0.8 * sin, -0.6 * sin, cos)
}

#[test]
fn draws_follow_their_density() {
    for (name, coat, turn, base, side) in cases() {
        println!("{name}");
        for cos in [0.9, 0.4] {
            let wo = direction(cos * side);
            let lobes = coated(coat, turn, base, wo);
            let draw = |u_lobe, u| lobes.sample(wo, u_lobe, u).filter(|s| !s.delta).map(|s| s.wi);
            assert_chi2(draw, |wi| lobes.eval(wo, wi).pdf);
        }
    }
}

#[test]
fn a_base_alone_is_drawn_as_it_is_evaluated() {
    let mut random = Random::new(1);
    for (name, coat, turn, base, side) in cases() {
        let mut lobes = Lobes::default();
        lobes.push_coat(coat);
        lobes.push(0.7, turn, Layer::Under(0), base);
        let mut seen = 0;
        for cos in [1.0, 0.7, 0.3] {
            let wo = direction(cos * side);
            for _ in 0..1000 {
                let Some(s) = lobes.sample(wo, random.uniform(), random.uniform2()) else { continue };
                let value = lobes.eval(wo, s.wi);
                if s.wi.z.abs() < 0.05 {
                    continue; // where rounding to and fro takes the last digits
                }
                seen += 1;
                assert!((s.pdf / value.pdf - 1.0).abs() < 1e-3, "{name}: {s:?} {value:?}");
                let difference = (s.weight * s.pdf).total() - value.f_cos.total();
                assert!(difference.abs().max_element() <= 1e-3 * value.f_cos.total().max_element(), "{name}");
            }
        }
        assert!(seen > 500, "{name}: {seen} draws");
    }
}

#[test]
fn reflection_is_reciprocal() {
    for (name, coat, turn, base, side) in cases().into_iter().filter(|case| case.2.map.is_none()) {
        let (a, b) = (direction(0.8 * side), Vec3::new(-0.5, 0.3, (0.66f32).sqrt() * side));
        let f = |wo: Vec3, wi: Vec3| coated(coat, turn, base, wo).eval(wo, wi).f_cos.total() / wi.z.abs();
        let (there, back) = (f(a, b), f(b, a));
        assert!(there.min_element() > 0.0, "{name}: {there}");
        assert!(((there - back) / there).abs().max_element() < 1e-4, "{name}: {there} {back}");
    }
}

/// `plastic` is such a coat on a diffuse base, whose internal reflections only lift it as a whole.
#[test]
fn over_a_diffuse_base_it_is_plastic_without_internal_reflection() {
    let (wo, albedo) = (direction(0.7), Rgb::splat(0.6));
    let internal = Plastic::internal_reflectance(1.5);
    let smooth = Bsdf::Plastic(Plastic::new(1.5, internal, albedo, Rgb::ONE, false));
    let rough = Bsdf::RoughPlastic(RoughPlastic::new(&ROUGH, albedo, Rgb::ONE, false));
    for (is_rough, plastic, kept) in [(false, smooth, 1.0 - internal), (true, rough, 1.0 - ROUGH.internal())]
    {
        let lobes = coated(coat(1.5, Rgb::ZERO, is_rough), Turn::default(), diffuse(0.6), wo);
        for cos in [1.0, 0.6, 0.1] {
            let wi = direction(cos) * Vec3::new(-1.0, 0.3, 1.0);
            let wi = wi.normalize();
            let (ours, theirs) = (lobes.eval(wo, wi).f_cos, plastic.eval(wo, wi).f_cos);
            assert!((ours.diffuse.x / (theirs.diffuse.x * kept) - 1.0).abs() < 1e-4, "{ours:?} {theirs:?}");
            let specular = (ours.specular.x, theirs.specular.x);
            assert!((specular.0 - specular.1).abs() <= 1e-4 * specular.1, "{ours:?} {theirs:?}");
        }
    }
}

/// A walk through the layer, in f64 and written for light: reflected or refracted at random at the surface, weakened in
/// the layer, scattered below, and lost where the surface throws it back. Standard error of 2^18 walks: 0.001; the
/// difference must be below five of them (false alarms: 1e-6 a channel).
fn walked(eta: f64, depth: Rgb, base: Bsdf<'static>, wo: Vec3) -> Rgb {
    let fresnel = |cos: f64, eta: f64| {
        let sin2_t = (1.0 - cos * cos) / (eta * eta);
        if sin2_t >= 1.0 {
            return (1.0, 0.0);
        }
        let cos_t = (1.0 - sin2_t).sqrt();
        let s = (cos - eta * cos_t) / (cos + eta * cos_t);
        let p = (eta * cos - cos_t) / (eta * cos + cos_t);
        ((s * s + p * p) / 2.0, cos_t)
    };
    let mut random = Random::new(7);
    let mut sum = Rgb::ZERO;
    const WALKS: u32 = 1 << 18;
    for _ in 0..WALKS {
        let (reflected, cos_t) = fresnel(f64::from(wo.z), eta);
        if f64::from(random.uniform()) < reflected {
            sum += Rgb::ONE;
            continue;
        }
        let inside = Vec3::new(wo.x / eta as f32, wo.y / eta as f32, cos_t as f32);
        let Some(s) = base.sample(inside, random.uniform(), random.uniform2()) else { continue };
        let (lost, _) = fresnel(f64::from(s.wi.z), 1.0 / eta);
        if f64::from(random.uniform()) >= lost {
            let way = 1.0 / inside.z + 1.0 / s.wi.z;
            sum += s.weight.total() * (depth * -way).exp();
        }
    }
    sum / WALKS as f32
}

#[test]
fn albedo_is_that_of_a_walk_through_the_layer() {
    for (eta, depth, base) in [
        (1.5, Rgb::ZERO, diffuse(1.0)),
        (1.5, AMBER, diffuse(0.9)),
        (1.33, AMBER, metal(0.3)),
        (1.7, AMBER, mirror()),
        (0.8, AMBER, metal(0.5)),
    ] {
        for cos in [1.0, 0.7, 0.3] {
            let wo = direction(cos);
            let lobes = coated(coat(eta, depth, false), Turn::default(), base, wo);
            let weight =
                |u_lobe, u: Vec2| lobes.sample(wo, u_lobe, u).map_or(Rgb::ZERO, |s| s.weight.total());
            let ours = furnace(1 << 18, weight).as_vec3();
            let truth = walked(f64::from(eta), depth, base, wo);
            assert!((ours - truth).abs().max_element() < 5e-3, "{eta} {cos}: {ours}, walked {truth}");
            assert!(ours.max_element() < 1.001, "{ours}");
            let features = lobes.features(wo).albedo;
            assert!((features - ours).abs().max_element() < 0.05 * ours.max_element(), "{features} {ours}");
        }
    }
}

#[test]
fn over_white_the_share_that_the_documentation_names_is_lost() {
    assert!((Plastic::internal_reflectance(1.5) - 0.6).abs() < 0.01);
}

#[test]
fn extremes_are_finite() {
    let u = [0.0, 0.3, 0.7, 1.0f32.next_down()];
    for eta in [1e-3, 0.999, 1.0f32.next_up(), 1.5, 1e3] {
        for depth in [0.0, 1e-30, 1.0, 1e30, f32::INFINITY] {
            for base in [diffuse(1.0), metal(1e-4), mirror()] {
                for cos in [1.0, 0.1, 1e-4, 1e-20, 0.0, -1e-3, -1.0] {
                    let wo = direction(cos);
                    let lobes = coated(coat(eta, Rgb::splat(depth), false), Turn::default(), base, wo);
                    for (u_lobe, u) in u.iter().flat_map(|&a| u.map(|b| (a, Vec2::new(b, 0.4)))) {
                        if let Some(s) = lobes.sample(wo, u_lobe, u) {
                            let sound = s.wi.is_finite() && s.weight.total().is_finite() && s.pdf.is_finite();
                            assert!(sound, "{eta} {depth} {wo}: {s:?}");
                            assert!((s.wi.length() - 1.0).abs() < 1e-3, "{eta} {depth} {wo}: {s:?}");
                        }
                        let value = lobes.eval(wo, direction(u_lobe));
                        assert!(value.f_cos.total().is_finite() && value.pdf.is_finite(), "{value:?}");
                    }
                }
            }
        }
    }
}
