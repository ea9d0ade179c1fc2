//! Alpha and hidden lights. The truths of both are what Mitsuba 3.9.1 renders of the same scenes.

use limpid_frame::Statistic;
use limpid_scenes::{MaterialId, MaterialKind, Scalar};

use super::*;

const LIGHT: f32 = 5.0;

/// Seen along +z: whatever `objects` adds to an empty scene.
fn view(objects: &[fn(&mut Scene)]) -> Scene {
    let materials = vec![
        diffuse(0.0),
        diffuse(0.5),
        MaterialKind::Mask { opacity: Scalar::Constant(0.25), inner: MaterialId(1) },
    ];
    let mut scene = scene(camera(DVec3::ZERO, DVec3::Z, 1, 1), materials);
    limpid_testkit::scene::set_fov(&mut scene.cameras[0], 1.0);
    objects.iter().for_each(|object| object(&mut scene));
    scene
}

fn square(
    scene: &mut Scene,
    z: f64,
    half: f64,
    towards_us: bool,
    material: u32,
) -> &mut limpid_scenes::Shape {
    let turn = DMat4::from_rotation_y(if towards_us { std::f64::consts::PI } else { 0.0 });
    let place = DMat4::from_translation(DVec3::Z * z) * turn * DMat4::from_scale(DVec3::splat(half));
    add(scene, ShapeKind::Rectangle, place, material)
}

fn light(scene: &mut Scene) {
    square(scene, 3.0, 1.0, true, 0).emission = glow(LIGHT);
}

fn backlight(scene: &mut Scene) {
    square(scene, 3.0, 1.0, false, 0).emission = glow(LIGHT);
}

fn wall(scene: &mut Scene) {
    square(scene, 5.0, 10.0, true, 1);
}

fn mask(scene: &mut Scene) {
    square(scene, 2.0, 1.0, true, 2);
}

fn constant(scene: &mut Scene) {
    sky(scene, 1.0);
}

/// Green and alpha.
fn seen(objects: &[fn(&mut Scene)], hide: bool) -> (f64, f64) {
    let rendered = render(&view(objects), |s| {
        (s.spp, s.hide_emitters) = (4096, hide);
        s.layers = s.layers.clone().with(Layer::Alpha, Statistic::Mean);
    });
    (mean(&rendered, "G"), mean(&rendered, "A"))
}

#[test]
fn hidden_lights_are_looked_through_and_hidden_skies_leave_nothing() {
    // Objects; green and alpha; the same with hidden emitters. Mitsuba's values have 512 samples.
    type Row = (&'static [fn(&mut Scene)], (f64, f64), (f64, f64));
    let rows: [Row; 9] = [
        (&[], (0.0, 0.0), (0.0, 0.0)),
        (&[light], (5.0, 1.0), (0.0, 0.0)),
        (&[backlight], (0.0, 1.0), (0.0, 0.0)),
        (&[light, wall], (5.0, 1.0), (0.0, 1.0)),
        (&[backlight, wall], (0.0, 1.0), (0.56, 1.0)),
        (&[constant], (1.0, 1.0), (0.0, 0.0)),
        (&[constant, wall], (0.51, 1.0), (0.51, 1.0)),
        // Light comes through a hole, the sky does not. Of the latter Mitsuba renders 0.064 in place of 0.125: it drops
        // the light samples of a path whose next event is the hole.
        (&[mask, light], (3.72, 1.0), (3.72, 1.0)),
        (&[mask, constant], (0.8725, 1.0), (0.125, 0.25)),
    ];
    for (i, (objects, plain, hidden)) in rows.into_iter().enumerate() {
        for (hide, truth) in [(false, plain), (true, hidden)] {
            let (green, alpha) = seen(objects, hide);
            // Four standard errors of 512 samples.
            assert!((alpha - truth.1).abs() < 0.08, "row {i} {hide}: alpha {alpha}, not {}", truth.1);
            assert!(
                (green - truth.0).abs() < 0.03 + 0.07 * truth.0,
                "row {i} {hide}: {green}, not {}",
                truth.0
            );
        }
    }
}

#[test]
fn many_hidden_lights_in_a_row_come_to_an_end() {
    let mut scene = view(&[wall]);
    for i in 0..3000 {
        let z = 3.0 + if i % 2 == 0 { 0.0 } else { 1e-4 * f64::from(i) };
        square(&mut scene, z, 1.0, i % 3 == 0, 0).emission = glow(1.0);
    }
    let rendered = render(&scene, |s| (s.spp, s.hide_emitters, s.layers) = (2, true, LayerRequest::all()));
    assert_eq!(mean(&rendered, "A"), 1.0);
    assert!((rendered.frame.channel("depth.Z").unwrap()[0] - 5.0).abs() < 1e-3);
}

#[test]
fn files_ask_for_their_layers() {
    let mut scene = view(&[wall]);
    scene.cameras[0].film.alpha = true;
    scene.integrator.aovs = vec![limpid_scenes::Aov::ShadingNormal, limpid_scenes::Aov::Depth];
    let rendered = render(&scene, |s| s.spp = 2);
    let names: Vec<_> = rendered.frame.channels().map(|(name, _)| name.to_owned()).collect();
    for name in ["A", "normal.Z", "depth.Z"] {
        assert!(names.iter().any(|n| n == name), "{name}: {names:?}");
    }
}
