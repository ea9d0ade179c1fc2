use glam::{DAffine3, DVec3, Vec3};

use super::kernel::Blocks;
use super::*;

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

fn soup(count: usize, size: f32) -> Vec<[Vec3; 3]> {
    let mut rng = Lcg(7);
    (0..count)
        .map(|_| {
            let c = rng.vec();
            [c + size * rng.vec(), c + size * rng.vec(), c + size * rng.vec()]
        })
        .collect()
}

fn rays(count: usize) -> Vec<Ray> {
    let mut rng = Lcg(11);
    let mut rays = Vec::new();
    for i in 0..count {
        let mut d = rng.vec();
        // Every third ray is parallel to a plane or an axis, with zeros of both signs.
        for axis in 0..i % 3 {
            d[(i / 3 + axis) % 3] = if i % 2 == 0 { 0.0 } else { -0.0 };
        }
        rays.push(Ray {
            t_max: if i % 5 == 0 { 0.7 } else { f32::INFINITY },
            ..Ray::new(2.0 * rng.vec(), d.normalize())
        });
    }
    rays
}

fn brute_force(triangles: &[[Vec3; 3]], ray: &Ray) -> Hit {
    let mut hit = Hit { t: ray.t_max, ..Hit::MISS };
    for prim in 0..triangles.len() as u32 {
        TriangleBlock::new(triangles, 0, &[prim]).closest(
            kernel::Scalar,
            ray,
            &kernel::ShearedRay::new(ray),
            &mut kernel::Stack::new(0),
            0,
            &mut hit,
        );
    }
    if hit.prim == NONE { Hit::MISS } else { hit }
}

#[test]
fn tree_finds_what_testing_every_triangle_finds() {
    let triangles = soup(2000, 0.15);
    let accel = Accel::build(&triangles, &[]);
    let rays = rays(3000);
    let mut hits = vec![Hit::MISS; rays.len()];
    let mut blocked = vec![false; rays.len()];
    accel.closest(&rays, &mut hits);
    accel.occluded(&rays, &mut blocked);
    let mut found = 0;
    for ((ray, hit), blocked) in rays.iter().zip(&hits).zip(&blocked) {
        let truth = brute_force(&triangles, ray);
        assert_eq!(*hit, truth, "{ray:?}");
        assert_eq!(*blocked, truth.prim != NONE, "{ray:?}");
        found += usize::from(truth.prim != NONE);
    }
    assert!(found > rays.len() / 8 && found < rays.len(), "{found} hits");
}

#[test]
fn triangles_all_in_one_place_make_a_tree() {
    let triangle = [Vec3::new(-1.0, -1.0, 1.0), Vec3::new(3.0, -1.0, 1.0), Vec3::new(-1.0, 3.0, 1.0)];
    let mut hit = [Hit::MISS];
    Accel::build(&[triangle; 1000], &[]).closest(&[Ray::new(Vec3::ZERO, Vec3::Z)], &mut hit);
    assert_eq!((hit[0].prim, hit[0].t), (0, 1.0));
    Accel::build(&[[Vec3::ONE; 3]; 1000], &[]).closest(&[Ray::new(Vec3::ZERO, Vec3::Z)], &mut hit);
    assert_eq!(hit[0], Hit::MISS);
}

#[test]
fn skipped_primitive_is_not_there() {
    let triangles = [[Vec3::new(-1.0, -1.0, 1.0), Vec3::new(3.0, -1.0, 1.0), Vec3::new(-1.0, 3.0, 1.0)]];
    let accel = Accel::build(&triangles, &[]);
    let mut hit = [Hit::MISS];
    let ray = Ray::new(Vec3::ZERO, Vec3::Z);
    accel.closest(&[ray], &mut hit);
    assert_eq!((hit[0].prim, hit[0].t), (0, 1.0));
    accel.closest(&[Ray { skip: 0, ..ray }], &mut hit);
    assert_eq!(hit[0], Hit::MISS);
}

#[test]
fn huge_tilted_triangle_keeps_its_distance() {
    // A plane through (0, 0, −1) with side 1e6, seen along its normal: the distance is that of the plane.
    let n = DVec3::new(0.3, -0.2, 1.0).normalize();
    let (s, t) = n.any_orthonormal_pair();
    let corner = |a: f64, b: f64| (-n + 1e6 * (a * s + b * t)).as_vec3();
    let triangles = [[corner(-1.0, -1.0), corner(3.0, -1.0), corner(-1.0, 3.0)]];
    let d = (-n).as_vec3();
    let mut hit = [Hit::MISS];
    Accel::build(&triangles, &[]).closest(&[Ray::new(Vec3::ZERO, d)], &mut hit);
    let [a, b, c] = triangles[0].map(|p| p.as_dvec3());
    let normal = (b - a).cross(c - a);
    let truth = normal.dot(a) / normal.dot(d.as_dvec3());
    assert!((f64::from(hit[0].t) / truth - 1.0).abs() < 1e-7, "{} {truth}", hit[0].t);
}

#[test]
fn sphere_distance_keeps_its_digits_near_far_and_inside() {
    let sphere = |c: DVec3, r: f64| {
        let m = DAffine3::from_scale_rotation_translation(DVec3::splat(r), glam::DQuat::IDENTITY, c);
        Analytic {
            kind: AnalyticKind::Sphere,
            frame: Frame64 { render_from_object: m, object_from_render: m.inverse() },
        }
    };
    for (c, r, o, d, truth) in [
        (DVec3::new(0.0, 0.0, -1e7), 1e7, Vec3::new(0.0, 0.0, 1e-3), Vec3::NEG_Z, 1e-3),
        (DVec3::new(0.0, 0.0, 1e7), 1.0, Vec3::ZERO, Vec3::Z, 1e7 - 1.0),
        (DVec3::ZERO, 2.0, Vec3::new(0.0, 0.0, 1.5), Vec3::Z, 0.5),
        (DVec3::ZERO, 2.0, Vec3::new(0.0, 0.0, 1.5), Vec3::NEG_Z, 3.5),
    ] {
        let mut hit = [Hit::MISS];
        Accel::build(&[], &[sphere(c, r)]).closest(&[Ray::new(o, d)], &mut hit);
        assert!((f64::from(hit[0].t) / truth - 1.0).abs() < 1e-7, "{c} {r}: {} {truth}", hit[0].t);
    }
}

#[test]
fn cylinder_is_hit_on_its_wall_alone_whatever_the_scale() {
    for scale in [1e-20f64, 1.0, 1e20] {
        let m = DAffine3::from_scale(DVec3::splat(scale));
        let frame = Frame64 { render_from_object: m, object_from_render: m.inverse() };
        let accel = Accel::build(&[], &[Analytic { kind: AnalyticKind::Cylinder, frame }]);
        let cast = |o: [f32; 3], d: [f32; 3]| {
            let o = Vec3::from(o) * scale as f32;
            let (ray, mut hit) = (Ray::new(o, Vec3::from(d).normalize()), [Hit::MISS]);
            accel.closest(&[ray], &mut hit);
            (hit[0].prim != NONE).then(|| f64::from(hit[0].t) / scale)
        };
        let near = |found: Option<f64>, t: f64| {
            assert!(found.is_some_and(|f| (f / t - 1.0).abs() < 1e-6), "{found:?} {t}")
        };
        near(cast([3.0, 0.0, 0.5], [-1.0, 0.0, 0.0]), 2.0);
        near(cast([0.5, 0.0, 0.5], [-1.0, 0.0, 0.0]), 1.5);
        // Over the near edge onto the far wall, and through both open ends.
        near(cast([3.0, 0.0, 1.6], [-4.0, 0.0, -1.0]), 17.0f64.sqrt());
        assert_eq!(cast([0.5, 0.0, 3.0], [0.0, 0.0, -1.0]), None);
        assert_eq!(cast([3.0, 0.0, 1.001], [-1.0, 0.0, 0.0]), None);
        assert_eq!(cast([3.0, 1.001, 0.5], [-1.0, 0.0, 0.0]), None);
    }
}
