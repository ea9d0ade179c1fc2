//! Hard cases of geometry: rows of one table, each named after its number. The truths are analytic.

use glam::{DMat4, DVec3};
use limpid_renderer::{Prepared, WorldRay};
use limpid_scenes::{Scene, ShapeKind};
use limpid_tests::scene::{add, camera, diffuse, mesh, scene, sky};
use limpid_tests::{mean, radiance, rendered, within};

/// ½ (1 − F(2, 2)): a floor of albedo ½ under a sky of 1, half hidden by a plate of half-side s at height s/2.
const PLATE_TRUTH: f64 = 0.0844857;

/// An axis-aligned square with half-side `half` around `center`, facing up, its corners exact in `f32`.
fn square(half: f64, center: DVec3) -> ShapeKind {
    let corner = |x: f64, y: f64| (center + DVec3::new(x * half, y * half, 0.0)).as_vec3().to_array();
    mesh(
        vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)],
        vec![[0, 1, 2], [0, 2, 3]],
    )
}

/// Floor of half-side 4s and albedo ½ at `t`, black plate of half-side s at height s/2, sky 1, seen from between.
fn plate(s: f64, t: DVec3) -> limpid_renderer::Rendered {
    let mut scene = scene(camera(DVec3::Z, DVec3::ZERO, 1, 1), vec![diffuse(0.5), two_sided_black()]);
    add(&mut scene, square(4.0 * s, t), DMat4::IDENTITY, 0);
    add(&mut scene, square(s, t + DVec3::Z * (0.5 * s)), DMat4::IDENTITY, 1);
    sky(&mut scene, 1.0);
    radiance(scene, t + DVec3::Z * (0.25 * s), t, 65536, 2)
}

/// A one-sided material of albedo 0 is black from both sides.
fn two_sided_black() -> limpid_scenes::MaterialKind {
    diffuse(0.0)
}

/// A cube of half-side s and albedo ½ at `t` under a sky of 1: its front fills the pixels 16..48 squared of 64×64.
fn cube(s: f64, t: DVec3) -> Scene {
    let corner = |i: usize| {
        let sign = |bit: usize| if i >> bit & 1 == 1 { s } else { -s };
        (t + DVec3::new(sign(0), sign(1), sign(2))).as_vec3().to_array()
    };
    #[rustfmt::skip]
    let faces = [
        [0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
        [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5],
    ];
    let mut view = camera(t + DVec3::Z * (5.0 * s), t, 64, 64);
    limpid_tests::scene::set_fov(&mut view, 2.0 * 0.5f64.atan().to_degrees());
    view.world_from_camera = DMat4::from_cols(
        DVec3::NEG_X.extend(0.0),
        DVec3::Y.extend(0.0),
        DVec3::NEG_Z.extend(0.0),
        (t + DVec3::Z * (5.0 * s)).extend(1.0),
    );
    let mut scene = scene(view, vec![diffuse(0.5)]);
    add(&mut scene, mesh((0..8).map(corner).collect(), faces.to_vec()), DMat4::IDENTITY, 0);
    sky(&mut scene, 1.0);
    scene
}

/// Pixels of the cube's picture that are not exactly ½ inside and 1 outside.
fn wrong_pixels(scene: &Scene) -> usize {
    let rendered = rendered(scene, |s| (s.spp, s.max_depth) = (16, Some(2)));
    let plane = rendered.frame.channel("G").expect("beauty");
    let inside = |x: usize| (16..48).contains(&x);
    (0..64 * 64).filter(|i| plane[*i] != if inside(i % 64) && inside(i / 64) { 0.5 } else { 1.0 }).count()
}

#[test]
fn hc01_scene_translated_far() {
    let here = plate(1.0, DVec3::ZERO);
    within("plate at the origin", mean(&here), PLATE_TRUTH, 0.02);
    for t in [1e3, 1e4, 1e5, 1e6] {
        assert_eq!(here.frame.channel("G"), plate(1.0, DVec3::splat(t)).frame.channel("G"), "moved by {t}");
    }
    for t in [0.0, 1e3, 1e4, 1e5, 1e6] {
        assert_eq!(wrong_pixels(&cube(1.0, DVec3::splat(t))), 0, "cube moved by {t}");
    }
}

#[test]
fn hc02_scene_uniform_scale() {
    for s in [1e-6, 1e-4, 1e-3, 1.0, 1e3, 1e6] {
        within(&format!("plate scaled by {s}"), mean(&plate(s, DVec3::ZERO)), PLATE_TRUTH, 0.02);
        assert_eq!(wrong_pixels(&cube(s, DVec3::ZERO)), 0, "cube scaled by {s}");
    }
    let one = plate(1.0, DVec3::ZERO);
    for k in [-20, 20] {
        let scaled = plate(2f64.powi(k), DVec3::ZERO);
        assert_eq!(one.frame.channel("G"), scaled.frame.channel("G"), "scaled by 2^{k}");
    }
}

/// An icosphere of 2562 vertices, jittered radially by 5 %.
fn jittered_icosphere() -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let phi = (1.0 + 5f64.sqrt()) / 2.0;
    let mut vertices: Vec<DVec3> = Vec::new();
    for (a, b) in [(1.0, phi), (-1.0, phi), (1.0, -phi), (-1.0, -phi)] {
        vertices.extend([DVec3::new(0.0, a, b), DVec3::new(a, b, 0.0), DVec3::new(b, 0.0, a)]);
    }
    vertices.iter_mut().for_each(|v| *v = v.normalize());
    // Faces: all triples at the edge length of the icosahedron.
    let edge = 2.0 / (phi * 5f64.sqrt()).sqrt();
    let near = |i: usize, j: usize| (vertices[i].distance(vertices[j]) - edge).abs() < 1e-6;
    let mut faces = Vec::new();
    for i in 0..12 {
        for j in i + 1..12 {
            for k in j + 1..12 {
                if near(i, j) && near(j, k) && near(i, k) {
                    let outwards =
                        (vertices[j] - vertices[i]).cross(vertices[k] - vertices[i]).dot(vertices[i]) > 0.0;
                    faces.push(if outwards { [i, j, k] } else { [i, k, j] }.map(|v| v as u32));
                }
            }
        }
    }
    assert_eq!(faces.len(), 20);
    for _ in 0..4 {
        let mut middle = std::collections::HashMap::new();
        let mut split = Vec::new();
        for [a, b, c] in faces {
            let mut mid = |i: u32, j: u32| {
                *middle.entry((i.min(j), i.max(j))).or_insert_with(|| {
                    vertices.push(((vertices[i as usize] + vertices[j as usize]) * 0.5).normalize());
                    vertices.len() as u32 - 1
                })
            };
            let (ab, bc, ca) = (mid(a, b), mid(b, c), mid(c, a));
            split.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        faces = split;
    }
    assert_eq!(vertices.len(), 2562);
    let mut state = 1u64;
    for v in &mut vertices {
        *v *= 1.0 + 0.05 * (2.0 * uniform(&mut state) - 1.0);
    }
    (vertices, faces)
}

fn uniform(state: &mut u64) -> f64 {
    *state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
    (*state >> 11) as f64 / (1u64 << 53) as f64
}

#[test]
fn hc03_watertight_edges_vertices() {
    const RAYS: usize = 400_000;
    let (vertices, faces) = jittered_icosphere();
    for offset in [0.0, 1e3, 1e5] {
        let rounded: Vec<[f32; 3]> = vertices.iter().map(|v| (*v + offset).as_vec3().to_array()).collect();
        let at = |i: u32| glam::Vec3::from(rounded[i as usize]).as_dvec3();
        let eye = DVec3::splat(offset);
        let mut scene = scene(camera(eye, eye + DVec3::Z, 1, 1), vec![diffuse(0.5)]);
        add(&mut scene, mesh(rounded.clone(), faces.clone()), DMat4::IDENTITY, 0);
        let prepared = Prepared::new(&scene, 0).expect("a mesh");
        let mut state = 2u64;
        let rays: Vec<WorldRay> = (0..RAYS)
            .map(|k| {
                let mut u = || uniform(&mut state);
                let o = eye
                    + loop {
                        let p = DVec3::new(u(), u(), u()) * 2.0 - 1.0;
                        if p.length_squared() < 1.0 {
                            break 0.3 * p;
                        }
                    };
                let face = faces[(u() * faces.len() as f64) as usize];
                let (a, b) = (at(face[0]), at(face[1]));
                let target = match k % 4 {
                    0 => a,
                    1 => 0.5 * (a + b),
                    _ => a + u() * (b - a),
                };
                WorldRay { o, d: target - o }
            })
            .collect();
        let misses = prepared.cast(&rays).iter().filter(|hit| hit.is_none()).count();
        println!("offset {offset}: {misses} of {RAYS} rays leak");
        assert_eq!(misses, 0, "offset {offset}");
    }
}

#[test]
fn hc04_self_hit_huge_tiny_triangle() {
    let tilt = DMat4::from_rotation_x(0.4) * DMat4::from_rotation_y(-0.3);
    for (half, height, from_center) in
        [(1e6, 1.0, 0.3), (1e6, 1.0, 1e3), (1e6, 1.0, 1e5), (1e-6, 1e-5, 0.0), (1e-4, 1e-3, 0.0)]
    {
        let mut scene = scene(camera(DVec3::Z, DVec3::ZERO, 1, 1), vec![diffuse(0.5)]);
        add(&mut scene, square(half, DVec3::ZERO), tilt, 0);
        sky(&mut scene, 1.0);
        let foot = tilt.transform_point3(DVec3::new(from_center, 0.7 * from_center, 0.0));
        let eye = foot + height * tilt.transform_vector3(DVec3::Z);
        within(&format!("square {half} from {height}"), mean(&radiance(scene, eye, foot, 64, 2)), 0.5, 1e-4);
    }
    for at in [0.0, 1e3, 1e5] {
        let foot = DVec3::new(at, at, 0.0);
        let mut scene = scene(camera(DVec3::Z, DVec3::ZERO, 1, 1), vec![diffuse(0.5), two_sided_black()]);
        add(&mut scene, square(1e6, DVec3::ZERO), DMat4::IDENTITY, 0);
        add(&mut scene, square(1.0, foot + DVec3::Z * 0.5), DMat4::IDENTITY, 1);
        sky(&mut scene, 1.0);
        let seen = radiance(scene, foot + DVec3::Z * 0.25, foot, 65536, 2);
        within(&format!("plate over a huge floor at {at}"), mean(&seen), PLATE_TRUTH, 0.02);
    }
}

#[test]
fn hc09_giant_ground_sphere() {
    for radius in [1e3f64, 1e5, 1e7] {
        let ground = |eye: DVec3, target: DVec3| {
            let mut scene = scene(camera(eye, target, 1, 1), vec![diffuse(0.5), two_sided_black()]);
            let kind = ShapeKind::Sphere { center: DVec3::new(0.0, 0.0, -radius), radius };
            add(&mut scene, kind, DMat4::IDENTITY, 0);
            sky(&mut scene, 1.0);
            scene
        };
        let prepared = Prepared::new(&ground(DVec3::Z * 20.0, DVec3::ZERO), 0).expect("a sphere");
        for x in [0.0, 0.5, 2.0, 5.0, 10.0] {
            let ray = WorldRay { o: DVec3::new(x, 0.0, 20.0), d: DVec3::NEG_Z };
            let z = prepared.cast(&[ray])[0].expect("the ground").p.z;
            let truth = -x * x / (radius + (radius * radius - x * x).sqrt());
            assert!((z - truth).abs() < 1e-5, "R {radius}, x {x}: {z}, truth {truth}");
        }
        let foot = DVec3::new(3.5, 2.0, 0.0);
        let open = radiance(ground(foot + DVec3::Z, foot), foot + DVec3::Z, foot, 4096, 2);
        within(&format!("open ground, R {radius}"), mean(&open), 0.5, 1e-3);
        let mut hidden = ground(DVec3::Z, DVec3::ZERO);
        add(&mut hidden, square(0.1, DVec3::Z * 0.05), DMat4::IDENTITY, 1);
        let seen = radiance(hidden, DVec3::Z * 0.025, DVec3::ZERO, 65536, 2);
        within(&format!("plate over the ground, R {radius}"), mean(&seen), PLATE_TRUTH, 0.02);
    }
}
