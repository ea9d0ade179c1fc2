mod absorption;
mod alpha;

use glam::{DMat4, DVec3};
use limpid_frame::{Layer, LayerRequest};
use limpid_scenes::{MaterialId, MaterialKind, Scalar, Scene, ShapeKind};

use super::*;
use crate::camera::Camera;
use crate::film::Sample;
use crate::testing::{add, camera, diffuse, glow, mean, render, scene, sky};
use crate::{Progress, Sampler, TileSamples};

fn unit_sphere() -> ShapeKind {
    ShapeKind::Sphere { center: DVec3::ZERO, radius: 1.0 }
}

/// A small room with everything that the integrator has: an area light, a sky, two shapes.
fn room() -> Scene {
    let mut scene =
        scene(camera(DVec3::new(0.0, -4.0, 1.5), DVec3::ZERO, 40, 24), vec![diffuse(0.7), diffuse(0.2)]);
    add(&mut scene, ShapeKind::Rectangle, DMat4::from_scale(DVec3::splat(3.0)), 0);
    add(&mut scene, unit_sphere(), DMat4::from_translation(DVec3::new(0.6, 0.0, 1.0)), 1);
    let up =
        DMat4::from_translation(DVec3::new(-1.0, 0.0, 2.5)) * DMat4::from_rotation_x(std::f64::consts::PI);
    add(&mut scene, ShapeKind::Rectangle, up * DMat4::from_scale(DVec3::splat(0.4)), 1).emission = glow(9.0);
    sky(&mut scene, 0.2);
    scene
}

/// A material that lets the share `hole` of the light through; number `inner` is what the rest is made of.
fn mask(hole: f32, inner: u32) -> MaterialKind {
    MaterialKind::Mask { opacity: Scalar::Constant(1.0 - hole), inner: MaterialId(inner) }
}

/// The room with a half-open plate under its lamp.
fn room_with_holes() -> Scene {
    let mut scene = room();
    scene.materials.push(limpid_scenes::Material {
        name: "mask".into(),
        kind: mask(0.5, 0),
        place: limpid_scenes::Place::default(),
    });
    let plate = DMat4::from_translation(DVec3::new(-0.5, 0.0, 1.2));
    add(&mut scene, ShapeKind::Rectangle, plate, 2);
    scene
}

#[test]
fn closed_sphere_of_albedo_half_that_emits_half_has_radiance_one() {
    let mut scene = scene(camera(DVec3::ZERO, DVec3::X, 8, 8), vec![diffuse(0.5)]);
    let shape = add(&mut scene, unit_sphere(), DMat4::IDENTITY, 0);
    shape.flip_normals = true;
    shape.emission = glow(0.5);
    let rendered = render(&scene, |s| (s.spp, s.rr_depth) = (256, 8));
    // Sampling the sphere's inside by area or cosine alike leaves little variance; 1 % is five standard errors.
    assert!((mean(&rendered, "R") - 1.0).abs() < 0.01, "{}", mean(&rendered, "R"));
}

#[test]
fn batch_and_depth_first_driver_agree_to_the_bit() {
    for scene in [room(), room_with_holes()] {
        batch_and_depth_first_driver_agree(scene);
    }
}

fn batch_and_depth_first_driver_agree(scene: Scene) {
    let prepared = crate::Prepared::new(&scene, 0).unwrap();
    let mut settings = crate::Settings::for_camera(&scene, 0);
    (settings.spp, settings.layers) = (6, LayerRequest::all());
    let cx = Context {
        scene: &prepared,
        camera: Camera::new(&prepared.camera, settings.width, settings.height),
        filter: PixelFilterSampler::of(&prepared.camera.film),
        settings: &settings,
        features: true,
    };
    let compared = std::sync::atomic::AtomicU32::new(0);
    let recorder = |tile: TileSamples| {
        for (k, sample) in tile.samples.iter().enumerate() {
            let (pixel, index) = (k as u32 / tile.spp, k as u32 % tile.spp);
            let pixel = [tile.x + pixel % tile.width, tile.y + pixel / tile.width];
            let alone: Sample = depth_first(&cx, pixel, index);
            assert_eq!(sample.values.map(f32::to_bits), alone.values.map(f32::to_bits), "{pixel:?} {index}");
            compared.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        }
    };
    crate::render(&prepared, &settings, &Progress::default(), Some(&recorder));
    assert_eq!(compared.into_inner(), 40 * 24 * 6);
}

#[test]
fn what_lies_behind_masks_is_seen_by_the_product_of_their_holes() {
    let view = camera(DVec3::new(0.0, 0.0, 9.0), DVec3::ZERO, 1, 1);
    let mut scene = scene(view, vec![diffuse(0.0), mask(0.75, 0), mask(0.5, 0), MaterialKind::Null]);
    for (z, material) in [(1.0, 1), (2.0, 2), (3.0, 3)] {
        let plate = DMat4::from_translation(DVec3::Z * z) * DMat4::from_scale(DVec3::splat(9.0));
        add(&mut scene, ShapeKind::Rectangle, plate, material);
    }
    sky(&mut scene, 1.0);
    let seen = |depth| mean(&render(&scene, |s| (s.spp, s.max_depth) = (4096, depth)), "G");
    // Stratified draws: the standard error is far below that of 4096 independent ones, 0.0075.
    assert!((seen(None) - 0.375).abs() < 0.005, "{}", seen(None));
    assert!((seen(Some(4)) - 0.375).abs() < 0.005, "a hole is an edge");
    assert_eq!(seen(Some(3)), 0.0, "a hole is an edge");
}

/// A lamp's light through a mask, by light samples alone (a small lamp) and by scattering too (a large one).
#[test]
fn light_through_a_mask_is_multiplied_by_its_hole() {
    for half_side in [0.05, 3.0] {
        let lit = |masked: bool, depth| {
            let view = camera(DVec3::new(0.0, 0.0, 0.5), DVec3::ZERO, 1, 1);
            let mut scene = scene(view, vec![diffuse(0.5), diffuse(0.0), mask(0.25, 1)]);
            add(&mut scene, ShapeKind::Rectangle, DMat4::IDENTITY, 0);
            let turned =
                DMat4::from_rotation_x(std::f64::consts::PI) * DMat4::from_scale(DVec3::splat(half_side));
            let lamp = DMat4::from_translation(DVec3::Z * 2.0) * turned;
            add(&mut scene, ShapeKind::Rectangle, lamp, 1).emission = glow(1.0);
            if masked {
                let plate = DMat4::from_translation(DVec3::Z) * DMat4::from_scale(DVec3::splat(90.0));
                add(&mut scene, ShapeKind::Rectangle, plate, 2);
            }
            mean(&render(&scene, |s| (s.spp, s.max_depth) = (4096, Some(depth))), "G")
        };
        let ratio = lit(true, 3) / lit(false, 2);
        assert!((ratio / 0.25 - 1.0).abs() < 0.01, "{half_side}: {ratio}"); // the draws of scattering: 0.3 %
        assert_eq!(lit(true, 2), 0.0, "a hole is an edge, for light samples as for scattering");
    }
}

#[test]
fn features_are_those_of_the_first_surface_that_is_there() {
    let view = camera(DVec3::new(0.0, 0.0, 9.0), DVec3::ZERO, 1, 1);
    let mut scene = scene(view, vec![diffuse(0.25), MaterialKind::Null]);
    for (z, material) in [(1.0, 0), (2.0, 1)] {
        let plate = DMat4::from_translation(DVec3::Z * z) * DMat4::from_scale(DVec3::splat(9.0));
        add(&mut scene, ShapeKind::Rectangle, plate, material);
    }
    let frame = render(&scene, |s| (s.spp, s.layers) = (4, LayerRequest::all())).frame;
    let value = |name| frame.channel(name).unwrap()[0];
    assert_eq!(value("albedo.G"), 0.25);
    assert!((8.0..12.0).contains(&value("depth.Z")) && value("id.object") == 0.0, "{}", value("depth.Z"));
}

#[test]
fn tiles_and_threads_change_no_bit() {
    let frame =
        |tile, threads| render(&room(), |s| (s.spp, s.tile, s.threads) = (20, tile, Some(threads))).frame;
    let one = frame(32, 1);
    assert_eq!(one, frame(7, 2));
    assert_eq!(one, frame(16, 5));
}

#[test]
fn more_layers_change_no_bit_of_the_others() {
    let few = render(&room(), |s| s.spp = 9).frame;
    let all = render(&room(), |s| (s.spp, s.layers) = (9, LayerRequest::all())).frame;
    for (name, plane) in few.channels() {
        assert_eq!(Some(plane), all.channel(name), "{name}");
    }
}

#[test]
fn one_pixel_alone_has_the_bits_it_has_in_the_picture() {
    let whole = render(&room(), |s| s.spp = 9).frame;
    let crop = limpid_scenes::Crop { x: 17, y: 11, width: 1, height: 1 };
    let alone = render(&room(), |s| (s.spp, s.crop) = (9, Some(crop))).frame;
    for (name, plane) in alone.channels() {
        assert_eq!(plane[0].to_bits(), whole.channel(name).unwrap()[11 * 40 + 17].to_bits(), "{name}");
    }
}

#[test]
fn components_add_up_to_the_beauty() {
    let frame = render(&room(), |s| (s.spp, s.layers) = (33, LayerRequest::all())).frame;
    for channel in ["R", "G", "B"] {
        let part = |layer: Layer| frame.channel(&format!("{}.{channel}", layer.name())).unwrap();
        let (d, s, e) = (part(Layer::Diffuse), part(Layer::Specular), part(Layer::Emission));
        for (i, &beauty) in frame.channel(channel).unwrap().iter().enumerate() {
            let largest = beauty.abs().max(d[i].abs()).max(s[i].abs()).max(e[i].abs());
            let ulp = f64::from(largest.next_up()) - f64::from(largest);
            let sum = f64::from(d[i]) + f64::from(s[i]) + f64::from(e[i]);
            assert!((sum - f64::from(beauty)).abs() <= 2.0 * ulp, "pixel {i}: {sum} {beauty}");
        }
    }
}

#[test]
fn samplers_and_depths_agree_on_direct_light() {
    let value = |sampler, spp| {
        mean(&render(&room(), |s| (s.sampler, s.spp, s.max_depth) = (sampler, spp, Some(2))), "G")
    };
    let (sobol, independent) = (value(Sampler::Sobol, 256), value(Sampler::Independent, 256));
    // Both means have a standard error below 0.05 %.
    assert!((sobol / independent - 1.0).abs() < 0.003, "{sobol} {independent}");
}

#[test]
fn mis_weights_add_up_to_one_whatever_the_densities() {
    for (a, b) in [(1.0, 1.0), (0.3, 7.0), (2.5e25, 0.3), (1e38, 1e-38), (1e-38, 1e38)] {
        let sum = mis_weight(a, b) + mis_weight(b, a);
        assert!((sum - 1.0f32).abs() < 1e-6, "{a} {b}: {sum}");
    }
}

#[test]
fn paths_end_in_a_closed_box_of_perfect_mirrors_and_of_perfect_white() {
    let mirror =
        MaterialKind::Conductor { ior: None, specular_reflectance: limpid_scenes::Color::Constant([1.0; 3]) };
    for material in [mirror, diffuse(1.0)] {
        let mut scene = scene(camera(DVec3::ZERO, DVec3::X, 2, 2), vec![material]);
        add(&mut scene, ShapeKind::Cube, DMat4::IDENTITY, 0).flip_normals = true;
        let rendered = render(&scene, |s| (s.spp, s.max_depth) = (4, None));
        assert!(rendered.counters.rays > 16 * 1000, "{} rays", rendered.counters.rays);
        assert_eq!(mean(&rendered, "G"), 0.0);
    }
}

#[test]
fn paths_of_no_depth_are_black() {
    let rendered = render(&room(), |s| (s.spp, s.max_depth) = (2, Some(0)));
    assert_eq!(mean(&rendered, "G"), 0.0);
}

#[test]
fn shape_beyond_the_range_of_f32_is_an_error_that_names_it() {
    for kind in [ShapeKind::Cube, unit_sphere()] {
        let mut scene = room();
        add(&mut scene, kind, DMat4::from_translation(DVec3::new(1e39, 0.0, 0.0)), 0).name = "afar".into();
        let error = crate::Prepared::new(&scene, 0).err().expect("out of range");
        assert!(error.element.contains("afar"), "{error}");
    }
}
