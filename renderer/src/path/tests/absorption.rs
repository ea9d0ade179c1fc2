//! Glass whose inside absorbs.

use limpid_scenes::GltfMaterial;

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
