use limpid_testkit::scene::{add, camera, diffuse, scene};

use super::*;
use crate::Prepared;
use crate::accel::{Hit, Ray};

/// What a ray from `o` along `d` in the world hits.
fn hit(kind: ShapeKind, world_from_object: DMat4, flip: bool, o: DVec3, d: DVec3) -> Surface {
    let mut scene = scene(camera(DVec3::ZERO, DVec3::X, 1, 1), vec![diffuse(0.5)]);
    add(&mut scene, kind, world_from_object, 0).flip_normals = flip;
    let prepared = Prepared::new(&scene, 0).expect("test scenes can be rendered");
    let (ray, mut hits) = (Ray::new(o.as_vec3(), d.as_vec3().normalize()), [Hit::MISS]);
    prepared.accel.closest(&[ray], &mut hits);
    prepared.geometry.surface(&ray, &hits[0])
}

#[test]
fn cylinders_have_points_normals_and_coordinates_of_mitsuba() {
    let upright = ShapeKind::Cylinder { p0: DVec3::ZERO, p1: DVec3::Z, radius: 1.0 };
    let tilted = |z: f64| ShapeKind::Cylinder {
        p0: DVec3::new(1.0, 2.0, 3.0 * z),
        p1: DVec3::new(2.0, 4.0, 4.5 * z),
        radius: 0.5,
    };
    let scaled = |x: f64, y: f64, z: f64| DMat4::from_scale(DVec3::new(x, y, z));
    // What Mitsuba 3.9.1 (scalar_rgb) gives for the same rays against −x: p.x, normal, uv.
    let cases = [
        (upright.clone(), DMat4::IDENTITY, [5.0, 1e-3, 0.3], 1.0, [1.0, 0.001, 0.0], [0.000159155, 0.3]),
        (
            tilted(1.0),
            DMat4::IDENTITY,
            [8.0, 3.0, 3.7],
            2.02479,
            [0.925501, -0.24816, -0.286121],
            [0.98219, 0.56204],
        ),
        (
            tilted(-1.0),
            DMat4::IDENTITY,
            [8.0, 3.0, -3.7],
            2.02479,
            [0.925501, -0.24816, 0.286121],
            [0.0178101, 0.56204],
        ),
        (upright.clone(), scaled(-1.0, 1.0, 1.0), [5.0, 1e-3, 0.3], 1.0, [1.0, 0.001, 0.0], [0.499841, 0.3]),
        (
            upright.clone(),
            scaled(2.0, 2.0, 5.0),
            [5.0, 1e-3, 1.5],
            2.0,
            [1.0, 0.0005, 0.0],
            [7.95774e-05, 0.3],
        ),
        (upright, scaled(1.0, 1.0, -1.0), [5.0, 1e-3, -0.3], 1.0, [1.0, 0.001, 0.0], [0.000159155, 0.3]),
    ];
    for (kind, map, o, x, n, uv) in cases {
        for flip in [false, true] {
            let surface = hit(kind.clone(), map, flip, o.into(), DVec3::NEG_X);
            let side = if flip { -1.0 } else { 1.0 };
            assert!((surface.p.x - x).abs() < 1e-5, "{kind:?}: {surface:?}");
            assert!(surface.ng.abs_diff_eq(side * Vec3::from(n), 1e-5), "{kind:?}: {surface:?}");
            assert!(surface.uv.abs_diff_eq(Vec2::from(uv), 1e-5), "{kind:?}: {surface:?}");
        }
    }
}
