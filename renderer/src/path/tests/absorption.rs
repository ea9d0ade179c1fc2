//! Glass whose inside absorbs.

use limpid_scenes::{GltfMaterial, Light, LightKind};

use super::*;
use crate::testing::set_fov;

/// Clear of surface: no reflection, hardly any bending; half of the green is lost in 2 units, all of the blue at once.
fn glass() -> MaterialKind {
    MaterialKind::Gltf(Box::new(GltfMaterial {
        metallic: Scalar::Constant(0.0),
        roughness: Scalar::Constant(0.0),
        ior: 1.0,
        specular: Scalar::Constant(0.0),
        transmission: Scalar::Constant(1.0),
        thin: false,
        attenuation: Some((2.0, [1.0, 0.5, 0.0])),
        ..GltfMaterial::default()
    }))
}

/// Colour of one pixel that looks along −z from `z`, past a glass cube from −1 to 1.
fn seen_from(z: f64, add_more: impl Fn(&mut Scene), spp: u32) -> [f64; 3] {
    let mut view = camera(DVec3::new(0.0, 0.0, z), DVec3::new(0.0, 0.0, -9.0), 1, 1);
    set_fov(&mut view, 0.1);
    let mut scene = scene(view, vec![glass(), diffuse(1.0)]);
    add(&mut scene, ShapeKind::Cube, DMat4::IDENTITY, 0);
    add_more(&mut scene);
    let rendered = render(&scene, |s| s.spp = spp);
    ["R", "G", "B"].map(|channel| mean(&rendered, channel))
}

#[track_caller]
fn near(found: [f64; 3], wanted: [f64; 3], tolerance: f64) {
    let off = found.iter().zip(wanted).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(off < tolerance, "{found:?} and not {wanted:?}");
}

#[test]
fn light_is_absorbed_along_its_way_inside() {
    near(seen_from(5.0, |scene| sky(scene, 1.0), 16), [1.0, 0.5, 0.0], 1e-3);
    // The camera is inside. The index is kept off 1 by 0.001, and light inside is brighter by its square.
    near(seen_from(0.0, |scene| sky(scene, 1.0), 16), [1.0, 0.5f64.sqrt(), 0.0], 3e-3);
    near(seen_from(-5.0, |scene| sky(scene, 1.0), 16), [1.0, 1.0, 1.0], 1e-3);
}

#[test]
fn what_is_in_the_glass_is_seen_and_lit_through_it() {
    // A white plate in the middle that faces the camera, and a lamp in the glass: light samples go through glass too.
    let lit = |absorbing: bool| {
        seen_from(
            5.0,
            |scene| {
                if !absorbing {
                    let MaterialKind::Gltf(p) = &mut scene.materials[0].kind else { unreachable!() };
                    p.attenuation = None;
                }
                add(scene, ShapeKind::Rectangle, DMat4::from_scale(DVec3::splat(0.5)), 1);
                let up = DMat4::from_rotation_x(std::f64::consts::PI) * DMat4::from_scale(DVec3::splat(0.01));
                let lamp = DMat4::from_translation(DVec3::new(0.3, 0.0, 0.4)) * up;
                add(scene, ShapeKind::Rectangle, lamp, 1).emission = glow(100.0);
            },
            256,
        )
    };
    let (through, clear) = (lit(true), lit(false));
    // 0.5 from the lamp to the plate, and 1 from there to the front.
    let green = 0.5f64.powf((0.5 + 1.0) / 2.0);
    assert!(clear[1] > 0.0);
    near([0, 1, 2].map(|c| through[c] / clear[c]), [1.0, green, 0.0], 2e-3);
}

/// The cube's material with holes over half of it, or all.
fn perforate(scene: &mut Scene, opacity: f32) {
    let inner = MaterialId(scene.materials.len() as u32);
    scene.materials.push(scene.materials[0].clone());
    scene.materials[0].kind = MaterialKind::Mask { opacity: Scalar::Constant(opacity), inner };
}

#[test]
fn holes_lead_out_of_an_inside_and_not_into_it() {
    let through = |opacity: f32| {
        let holes = |scene: &mut Scene| {
            sky(scene, 1.0);
            perforate(scene, opacity);
        };
        seen_from(5.0, holes, 4096)
    };
    near(through(0.0), [1.0; 3], 1e-6);
    // Half of the rays get in and are absorbed along the whole way, by whatever they get out. 4 standard errors.
    near(through(0.5), [1.0, 0.75, 0.5], 4.0 * 0.5 / 64.0);
}

#[test]
fn light_samples_are_absorbed_as_far_as_the_hole_by_which_they_come_in() {
    let lit = |absorbing: bool| {
        let plate = |scene: &mut Scene| {
            if !absorbing {
                let MaterialKind::Gltf(p) = &mut scene.materials[0].kind else { unreachable!() };
                p.attenuation = None;
            }
            perforate(scene, 0.5);
            add(scene, ShapeKind::Rectangle, DMat4::from_scale(DVec3::splat(0.5)), 1);
            let kind = LightKind::Point { position: DVec3::new(0.0, 0.0, 3.0), intensity: [1.0; 3] };
            scene.lights.push(Light { name: "lamp".into(), kind, place: Default::default() });
        };
        seen_from(5.0, plate, 8192)
    };
    let (through, clear) = (lit(true), lit(false));
    // Those that got in by a hole see the plate by light that did; the others lose 1 unit's worth on either way.
    let ratio = [0, 1, 2].map(|c| through[c] / clear[c]);
    near(ratio, [1.0, 0.75, 0.5], 4.0 * 0.5 / 64.0);
}

#[test]
fn clear_glass_in_glass_that_absorbs_leads_back_into_that() {
    let seen = |from: f64| {
        let nested = |scene: &mut Scene| {
            sky(scene, 1.0);
            let mut clear = glass();
            let MaterialKind::Gltf(p) = &mut clear else { unreachable!() };
            p.attenuation = None;
            let id = scene.materials.len() as u32;
            scene.materials.push(scene.materials[0].clone());
            scene.materials[id as usize].kind = clear;
            add(scene, ShapeKind::Cube, DMat4::from_scale(DVec3::splat(0.25)), id);
        };
        seen_from(from, nested, 16)
    };
    near(seen(5.0), [1.0, 0.5f64.powf(1.5 / 2.0), 0.0], 1e-3);
}
