use std::sync::Arc;

use glam::{DMat4, DQuat, DVec3};
use limpid_scenes::{Group, GroupId, Mesh, Scene, Shape, ShapeKind};
use limpid_testkit::scene::{add, camera, diffuse, scene};

use super::*;
use crate::accel::{Accel, kernel};
use crate::prepare::{Prepared, WorldHit, WorldRay};

/// A small deterministic generator: tests need nothing better.
struct Lcg(u64);

impl Lcg {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 33) as f64 / (1u64 << 31) as f64
    }

    fn vec(&mut self) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next()) * 2.0 - 1.0
    }
}

/// A bumpy ball with vertex normals and `2 · n²` triangles or so.
fn ball(n: u32) -> ShapeKind {
    let mut mesh = Mesh::default();
    for i in 0..=n {
        for j in 0..2 * n {
            let (theta, phi) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(n));
            let (theta, phi) = (theta * std::f64::consts::PI, phi * std::f64::consts::PI);
            let p = DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos());
            mesh.positions.push((p * (1.0 + 0.1 * (5.0 * p.x).sin())).as_vec3().to_array());
            mesh.normals.push(p.as_vec3().to_array());
            let at = |i: u32, j: u32| i * 2 * n + j % (2 * n);
            if i < n {
                mesh.triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
                mesh.triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
    }
    ShapeKind::Mesh(Arc::new(mesh))
}

/// Shapes of every kind, `at` a place of their group's space.
fn parts(at: DVec3) -> Vec<(ShapeKind, DMat4)> {
    let to = |p: [f64; 3]| DMat4::from_translation(at + DVec3::from(p));
    vec![
        (ball(8), to([0.0; 3])),
        (ShapeKind::Sphere { center: DVec3::ZERO, radius: 0.5 }, to([1.5, 0.5, 0.0])),
        (ShapeKind::Cylinder { p0: DVec3::ZERO, p1: DVec3::Z, radius: 0.3 }, to([0.0, 1.5, 0.0])),
        (ShapeKind::Rectangle, to([0.0, 0.0, -1.5]) * DMat4::from_rotation_x(0.3)),
        (ShapeKind::Cube, to([-1.5, -1.0, 0.5]) * DMat4::from_scale(DVec3::new(0.3, -0.2, 0.5))),
        (ShapeKind::Disk, to([1.0, -1.5, 0.0]) * DMat4::from_rotation_y(1.0)),
    ]
}

fn empty() -> Scene {
    scene(camera(DVec3::ZERO, DVec3::X, 1, 1), vec![diffuse(0.5)])
}

fn shape(kind: ShapeKind, map: DMat4) -> Shape {
    add(&mut empty(), kind, map, 0).clone()
}

/// A scene of instances of one group, and one in which the same shapes stand by themselves.
fn twins(parts: &[(ShapeKind, DMat4)], places: &[DMat4]) -> [Scene; 2] {
    let (mut instanced, mut flat) = (empty(), empty());
    let shapes = parts.iter().map(|(kind, map)| shape(kind.clone(), *map)).collect();
    instanced.groups.push(Group { name: "g".into(), shapes, place: Default::default() });
    for place in places {
        add(&mut instanced, ShapeKind::Instance { group: GroupId(0) }, *place, 0);
        for (kind, map) in parts {
            add(&mut flat, kind.clone(), *place * *map, 0);
        }
    }
    [instanced, flat]
}

fn cast(scene: &Scene, rays: &[WorldRay]) -> Vec<Option<WorldHit>> {
    Prepared::new(scene, 0).expect("test scenes can be rendered").cast(rays)
}

/// Rays from around `center` into the neighbourhood of it.
fn rays(count: usize, center: DVec3, size: f64) -> Vec<WorldRay> {
    let mut rng = Lcg(5);
    (0..count)
        .map(|_| {
            let o = center + 5.0 * size * rng.vec();
            WorldRay { o, d: center + 2.0 * size * rng.vec() - o }
        })
        .collect()
}

fn places() -> Vec<DMat4> {
    let turn = DQuat::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 1.1);
    vec![
        DMat4::IDENTITY,
        DMat4::from_rotation_translation(turn, DVec3::new(4.0, 1.0, -2.0)),
        DMat4::from_scale_rotation_translation(DVec3::new(0.5, 2.0, 1.5), turn, DVec3::new(-4.0, 0.0, 1.0)),
        DMat4::from_scale_rotation_translation(DVec3::new(1.0, -1.0, 1.0), turn, DVec3::new(0.0, 4.0, 3.0)),
        DMat4::from_scale_rotation_translation(DVec3::splat(1e-3), turn, DVec3::new(0.0, -3.0, 0.0)),
    ]
}

#[test]
fn instances_are_hit_like_copies_of_their_shapes() {
    // Also where the group lies far from the origin of its space, and the instances bring it back.
    for at in [DVec3::ZERO, DVec3::new(1e6, -3e5, 2e4)] {
        let parts = parts(at);
        let places: Vec<_> = places().into_iter().map(|m| m * DMat4::from_translation(-at)).collect();
        let [instanced, flat] = twins(&parts, &places);
        let rays = rays(20_000, DVec3::ZERO, 4.0);
        let (mut hits, mut other) = (0, 0);
        for (a, b) in cast(&instanced, &rays).into_iter().zip(cast(&flat, &rays)) {
            let same = match (a, b) {
                (Some(a), Some(b)) => {
                    hits += 1;
                    // A unit of scale 1e-3 is seen from 5 units away.
                    a.shape == b.shape / parts.len() as u32
                        && (a.t / b.t - 1.0).abs() < 2e-6
                        && a.ng.distance(b.ng) < 1e-3
                        && a.p.distance(b.p) < 1e-5
                }
                (a, b) => a.is_none() && b.is_none(),
            };
            other += usize::from(!same);
        }
        // At edges the rounding decides, and where it is grazed the distance is less certain.
        assert!(hits > 2500 && other < 20, "{at}: {other} of {hits} hits differ");
    }
}

#[test]
fn upright_instances_at_whole_numbers_have_the_bits_of_copies() {
    let places: Vec<_> =
        [[0.0; 3], [4.0, 0.0, 2.0], [-4.0, 8.0, 1.0]].map(|p| DMat4::from_translation(DVec3::from(p))).into();
    let cube = ShapeKind::Cube;
    let [instanced, flat] = twins(&[(cube, DMat4::from_translation(DVec3::new(0.25, 0.0, -0.5)))], &places);
    let rays = rays(5000, DVec3::ZERO, 4.0);
    let (a, b) = (cast(&instanced, &rays), cast(&flat, &rays));
    assert!(a.iter().flatten().count() > 100);
    let differ = a.iter().zip(&b).filter(|(a, b)| a != b).count();
    // Where a ray goes through an edge.
    assert!(differ <= 2, "{differ} differ");
}

#[test]
fn shape_declared_first_is_seen_where_an_instance_coincides_with_it() {
    let square = [(ShapeKind::Rectangle, DMat4::IDENTITY)];
    let rays: Vec<_> = rays(500, DVec3::ZERO, 0.5).into_iter().filter(|ray| ray.o.z.abs() > 0.5).collect();
    for first in ["square", "instance", "instances"] {
        let [mut scene, _] = twins(&square, &[]);
        let instance = ShapeKind::Instance { group: GroupId(0) };
        let kinds = match first {
            "square" => [ShapeKind::Rectangle, instance],
            "instance" => [instance, ShapeKind::Rectangle],
            _ => [instance.clone(), instance],
        };
        kinds.into_iter().for_each(|kind| _ = add(&mut scene, kind, DMat4::IDENTITY, 0));
        let hits = cast(&scene, &rays);
        let shapes: Vec<_> = hits.iter().flatten().map(|hit| hit.shape).collect();
        assert!(shapes.len() > 100 && shapes.iter().all(|&s| s == 0), "{first} first: {shapes:?}");
    }
}

#[test]
fn meshes_stay_watertight_through_instances_small_and_far() {
    for (scale, distance) in [(1.0, 10.0), (1.0, 1e5), (1e-6, 1.0), (1e6, 1e7), (1e-20, 1e-19), (1e20, 1e21)]
    {
        let center = DVec3::new(0.6, 0.64, 0.48) * distance;
        let place = DMat4::from_scale_rotation_translation(
            DVec3::new(1.0, 0.7, -1.3) * scale,
            DQuat::from_axis_angle(DVec3::Y, 0.7),
            center,
        );
        let [instanced, _] = twins(&[(ball(16), DMat4::IDENTITY)], &[place]);
        let prepared = Prepared::new(&instanced, 0).unwrap();
        let mut rng = Lcg(3);
        // Towards the inner half of the ball, from the camera and from beside it. What rounding does to such a
        // direction at 1e5 radii is no more than 1e-2 of them.
        let towards = |rng: &mut Lcg| (center + 0.3 * scale * rng.vec()).as_vec3();
        let rays: Vec<Ray> = (0..4000)
            .map(|i| {
                let o = if i % 2 == 0 { DVec3::ZERO } else { center + 3.0 * scale * rng.vec().normalize() };
                let o = o.as_vec3();
                Ray::new(o, (towards(&mut rng).as_dvec3() - o.as_dvec3()).normalize().as_vec3())
            })
            .collect();
        let (mut hits, mut blocked) = (vec![Hit::MISS; rays.len()], vec![false; rays.len()]);
        prepared.accel.closest(&rays, &mut hits);
        prepared.accel.occluded(&rays, &mut blocked);
        for ((ray, hit), blocked) in rays.iter().zip(&hits).zip(&blocked) {
            assert!(hit.prim != NONE && *blocked, "{scale} at {distance}: {ray:?} slips through");
            // Leaving it, a ray does not meet it again; going on, it meets the other side and no more.
            let surface = prepared.geometry.surface(ray, hit);
            let mut on = [Hit::MISS; 2];
            let out = surface.ng;
            prepared.accel.closest(&[surface.spawn(out), surface.spawn(ray.d)], &mut on);
            assert!(on[0].prim == NONE || on[0].t > 0.05 * scale as f32, "{scale} at {distance}: {on:?}");
            assert!(on[1].prim != NONE && on[1].t > 0.05 * scale as f32, "{scale} at {distance}: {on:?}");
        }
    }
}

#[test]
fn every_instruction_set_gives_the_same_bits_inside_instances() {
    let [instanced, _] = twins(&parts(DVec3::ZERO), &places());
    let prepared = Prepared::new(&instanced, 0).unwrap();
    let rays: Vec<Ray> = rays(3000, DVec3::ZERO, 4.0)
        .into_iter()
        .map(|ray| Ray::new(ray.o.as_vec3(), ray.d.normalize().as_vec3().normalize()))
        .collect();
    let mut best: Vec<Hit> = vec![Hit::MISS; rays.len()];
    let mut scalar: Vec<Hit> = rays.iter().map(|r| Hit { t: r.t_max, ..Hit::MISS }).collect();
    prepared.accel.closest(&rays, &mut best);
    kernel::reference(&prepared.accel.instances, &rays, kernel::Query::Closest(&mut scalar));
    assert_eq!(best, scalar);
    assert!(best.iter().filter(|hit| hit.instance != NONE).count() > 100);
}

#[test]
fn ten_thousand_instances_of_ten_thousand_triangles_cost_their_transforms() {
    let places: Vec<_> = (0..10_000)
        .map(|i| DMat4::from_translation(DVec3::new(f64::from(i % 100), f64::from(i / 100), 5.0) * 3.0))
        .collect();
    let [instanced, _] = twins(&[(ball(50), DMat4::IDENTITY)], &places);
    let prepared = Prepared::new(&instanced, 0).unwrap();
    assert_eq!(prepared.triangles(), 10_000);
    assert_eq!(prepared.geometry.positions.len(), 51 * 100);
    let Accel { top, instances, .. } = &prepared.accel;
    assert!(top.is_empty() && instances.blocks.len() == 10_000);
    let bytes = instances.nodes.len() * size_of::<kernel::Node>()
        + instances.blocks.len() * size_of::<Placed>()
        + prepared.geometry.instances.len() * size_of::<crate::geometry::Placed>();
    assert!(bytes < 512 * 10_000, "{bytes} bytes");
    let down = WorldRay { o: DVec3::new(30.0, 60.0, 0.0), d: DVec3::Z };
    assert_eq!(prepared.cast(&[down])[0].map(|hit| hit.shape), Some(2010));
}
