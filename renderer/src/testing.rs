//! Rendering of small scenes in unit tests.

use limpid_scenes::Scene;
pub use limpid_testkit::scene::*;

use crate::settings::Settings;
use crate::{Prepared, Progress, Rendered};

/// Prepares and renders a scene with its own settings, changed by `change`.
pub fn render(scene: &Scene, change: impl Fn(&mut Settings)) -> Rendered {
    let prepared = Prepared::new(scene, 0).expect("test scenes can be rendered");
    let mut settings = Settings::for_camera(scene, 0);
    change(&mut settings);
    crate::render(&prepared, &settings, &Progress::default(), None)
}

/// Mean of a channel of the beauty.
pub fn mean(rendered: &Rendered, channel: &str) -> f64 {
    let plane = rendered.frame.channel(channel).expect("every frame has its beauty");
    plane.iter().map(|&x| f64::from(x)).sum::<f64>() / plane.len() as f64
}
