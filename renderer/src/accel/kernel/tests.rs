use glam::Vec3;

use super::Query::{Closest, Occluded};
use super::*;
use crate::accel::{Accel, NONE, Prims};

/// A small deterministic generator: tests need nothing better.
struct Lcg(u64);

impl Lcg {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 40) as f32 / (1u64 << 24) as f32
    }

    fn vec(&mut self) -> Vec3 {
        Vec3::new(self.next(), self.next(), self.next()) * 2.0 - 1.0
    }
}

/// A bumpy sheet, a flat one far from the origin, and disjoint triangles.
fn triangles() -> Vec<[Vec3; 3]> {
    let mut rng = Lcg(3);
    let mut triangles = Vec::new();
    let n = 24;
    for height in [0.3f32, 0.0] {
        let corner = |i: usize, j: usize| {
            let (x, y) = (i as f32 / 8.0 - 1.5, j as f32 / 8.0 - 1.5);
            Vec3::new(x, y, height * (3.0 * x).sin() * (4.0 * y).cos() - 1.0)
        };
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            let away = if height == 0.0 { Vec3::new(1000.0, 0.0, 0.0) } else { Vec3::ZERO };
            triangles.extend([[a, b, c], [a, c, d]].map(|t| t.map(|p| p + away)));
        }
    }
    for _ in 0..500 {
        let c = rng.vec();
        triangles.push([0.2, 0.2, 0.2].map(|size| c + size * rng.vec()));
    }
    triangles
}

/// Towards corners, edges and insides, some parallel to an axis with zeros of both signs, some that end early.
fn rays(triangles: &[[Vec3; 3]], count: usize) -> Vec<Ray> {
    let mut rng = Lcg(11);
    let mut rays = Vec::new();
    for i in 0..count {
        let [a, b, c] = triangles[(rng.next() * triangles.len() as f32) as usize % triangles.len()];
        let target = match i % 3 {
            0 => a,
            1 => a.lerp(b, 0.5),
            _ => (a + b + c) / 3.0,
        };
        let zero = if i % 2 == 0 { 0.0 } else { -0.0 };
        let (o, d) = match i / 3 % 3 {
            0 => (target + Vec3::new(0.0, 0.0, 4.0), Vec3::new(zero, zero, -1.0)),
            1 => (target - Vec3::new(4.0, 3.0, 0.0), Vec3::new(0.8, 0.6, zero)),
            _ => {
                let o = target + 3.0 * rng.vec();
                (o, (target - o).normalize())
            }
        };
        let t_max = if i % 5 == 0 { 2.9 } else { f32::INFINITY };
        rays.push(Ray { o, t_max, d, skip: if i % 7 == 0 { 1 } else { NONE } });
    }
    rays
}

fn tree(triangles: &[[Vec3; 3]]) -> Tree<TriangleBlock> {
    let prims = Prims { triangles, first_triangle: 0, analytics: &[], first_analytic: 0 };
    Accel::new(&prims, &[], &[]).top.triangles
}

type Bits = (u32, u32, u32, u32);

/// Hits and whether there are any, as `trace` finds them.
fn found(rays: &[Ray], mut trace: impl FnMut(&[Ray], Query)) -> (Vec<Bits>, Vec<bool>) {
    let mut hits: Vec<Hit> = rays.iter().map(|ray| Hit { t: ray.t_max, ..Hit::MISS }).collect();
    let mut blocked = vec![false; rays.len()];
    trace(rays, Closest(&mut hits));
    trace(rays, Occluded(&mut blocked));
    (hits.iter().map(|h| (h.prim, h.t.to_bits(), h.u.to_bits(), h.v.to_bits())).collect(), blocked)
}

#[test]
fn every_instruction_set_and_any_number_of_rays_at_a_time_give_the_bits_of_the_reference() {
    let triangles = triangles();
    let tree = tree(&triangles);
    let rays = rays(&triangles, 4000);
    let truth = found(&rays, |rays, query| reference(&tree, rays, query));
    let hits = truth.0.iter().filter(|hit| hit.0 != NONE).count();
    assert!(hits > rays.len() / 2 && hits < rays.len(), "{hits} hits");
    assert_eq!(found(&rays, |rays, query| batch::trace(scalar::Scalar, &tree, rays, query)), truth);
    #[cfg(target_arch = "x86_64")]
    for level in x86::Level::all_detected() {
        assert_eq!(
            found(&rays, |rays, query| x86::one_by_one(level, &tree, rays, query)),
            truth,
            "{level:?}"
        );
        assert_eq!(
            found(&rays, |rays, query| x86::interleaved(level, &tree, rays, query)),
            truth,
            "{level:?}"
        );
    }
    for count in [1, 2, 31, 32, 33, 500] {
        let mut parts = (Vec::new(), Vec::new());
        for rays in rays.chunks(count) {
            let (hits, blocked) = found(rays, |rays, query| interleaved(&tree, rays, query));
            parts.0.extend(hits);
            parts.1.extend(blocked);
        }
        assert_eq!(parts, truth, "{count} rays at a time");
    }
}

#[test]
fn no_box_hides_a_triangle_that_is_hit() {
    let triangles = triangles();
    let tree = tree(&triangles);
    let rays = rays(&triangles, 1500);
    let (hits, blocked) = found(&rays, |rays, query| interleaved(&tree, rays, query));
    for ((ray, hit), blocked) in rays.iter().zip(hits).zip(blocked) {
        let sheared = ShearedRay::new(ray);
        let mut truth = Hit { t: ray.t_max, ..Hit::MISS };
        for prim in 0..triangles.len() as u32 {
            let block = TriangleBlock::new(&triangles, 0, &[prim]);
            block.closest(scalar::Scalar, ray, &sheared, &mut Stack::new(0), 0, &mut truth);
        }
        assert_eq!((hit.0, hit.1), (truth.prim, truth.t.to_bits()), "{ray:?}");
        assert_eq!(blocked, truth.prim != NONE, "{ray:?}");
    }
}

#[test]
fn no_ray_slips_through_a_sheet() {
    // Down onto the inner corners and edges of the bumpy sheet.
    let sheet: Vec<[Vec3; 3]> = triangles()[..1152].to_vec();
    let tree = tree(&sheet);
    let mut rng = Lcg(5);
    let mut rays = Vec::new();
    for [a, b, c] in &sheet {
        for target in [*a, a.lerp(*b, 0.5), a.lerp(*c, rng.next())] {
            if target.x.abs().max(target.y.abs()) < 1.4 {
                let o = Vec3::new(0.2 * rng.next(), 0.2 * rng.next(), 20.0);
                rays.push(Ray::new(o, (target - o).normalize()));
            }
        }
    }
    let (_, blocked) = found(&rays, |rays, query| interleaved(&tree, rays, query));
    assert!(rays.len() > 2000);
    assert_eq!(blocked.iter().filter(|&&blocked| !blocked).count(), 0);
}

#[test]
fn tree_is_the_same_for_any_number_of_threads() {
    let triangles = triangles();
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        pool.install(|| tree(&triangles))
    };
    let (one, four) = (with(1), with(4));
    assert_eq!(one.nodes, four.nodes);
    assert_eq!(one.blocks, four.blocks);
}

#[test]
fn hits_scale_with_the_scene_by_any_power_of_two() {
    let triangles = triangles();
    let rays = rays(&triangles, 1000);
    let (hits, blocked) = found(&rays, |rays, query| interleaved(&tree(&triangles), rays, query));
    for exponent in [-100, -30, 30, 100] {
        let scale = 2f32.powi(exponent);
        let scaled: Vec<[Vec3; 3]> = triangles.iter().map(|t| t.map(|p| scale * p)).collect();
        let scaled_rays: Vec<Ray> =
            rays.iter().map(|ray| Ray { o: scale * ray.o, t_max: scale * ray.t_max, ..*ray }).collect();
        let tree = tree(&scaled);
        let (scaled_hits, scaled_blocked) =
            found(&scaled_rays, |rays, query| interleaved(&tree, rays, query));
        let expected: Vec<Bits> =
            hits.iter().map(|h| (h.0, (scale * f32::from_bits(h.1)).to_bits(), h.2, h.3)).collect();
        assert!(tree.nodes.len() > 50, "2^{exponent}: {} nodes", tree.nodes.len());
        assert_eq!(scaled_hits, expected, "2^{exponent}");
        assert_eq!(scaled_blocked, blocked, "2^{exponent}");
    }
}

#[test]
fn already_blocked_rays_stay_blocked() {
    let tree = tree(&triangles());
    let rays = [Ray::new(Vec3::new(0.0, 0.0, 9.0), Vec3::Z); 40];
    let mut blocked: Vec<bool> = (0..40).map(|i| i % 3 == 0).collect();
    let before = blocked.clone();
    interleaved(&tree, &rays, Occluded(&mut blocked));
    assert_eq!(blocked, before);
}
