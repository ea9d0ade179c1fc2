//! What the tests that cross crates share: small scenes, rendered.

pub mod start;
pub mod survey;
pub mod table;

use glam::DVec3;
use limpid_renderer::{Prepared, Progress, Rendered, Settings, render};
use limpid_scenes::Scene;
pub use limpid_testkit::scene;

/// Prepares and renders a scene with its own settings, changed by `change`.
pub fn rendered(scene: &Scene, change: impl Fn(&mut Settings)) -> Rendered {
    let prepared = Prepared::new(scene, 0).expect("test scenes can be rendered");
    let mut settings = Settings::for_camera(scene, 0);
    change(&mut settings);
    render(&prepared, &settings, &Progress::default(), None)
}

/// Mean of the green channel, which is that of all in grey scenes.
pub fn mean(rendered: &Rendered) -> f64 {
    let plane = rendered.frame.channel("G").expect("every frame has its beauty");
    plane.iter().map(|&x| f64::from(x)).sum::<f64>() / plane.len() as f64
}

/// Radiance that arrives at `eye` from the direction of `target`: a picture of one pixel, 1e-3 degrees wide.
pub fn radiance(mut scene: Scene, eye: DVec3, target: DVec3, spp: u32, depth: u32) -> Rendered {
    let mut camera = scene::camera(eye, target, 1, 1);
    scene::set_fov(&mut camera, 1e-3);
    scene.cameras = vec![camera];
    rendered(&scene, |s| (s.spp, s.max_depth) = (spp, Some(depth)))
}

/// Whether `value` lies within a share `tolerance` of `truth`; prints both.
pub fn within(what: &str, value: f64, truth: f64, tolerance: f64) {
    let off = if truth == 0.0 { value.abs() } else { (value / truth - 1.0).abs() };
    println!("{what}: {value:.7}, truth {truth:.7}, off by {off:.2e} of {tolerance:.0e}");
    assert!(off <= tolerance, "{what}: {value}, truth {truth}, off by {off:.2e}, more than {tolerance:.0e}");
}
