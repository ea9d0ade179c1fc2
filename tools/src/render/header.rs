//! What the header says beside what the renderer wrote there: enough to make the frame again, and nothing that
//! differs from run to run.

use std::collections::BTreeMap;

use limpid_renderer::{Sampler, Settings};
use limpid_scenes::Scene;
use serde::Serialize;

use crate::cli::Render;
use crate::layers;

/// Version of the layout of frames: of the names and meanings of layers and attributes.
const FORMAT: &str = "1";

/// Everything but the scene's files that the picture depends on.
#[derive(Serialize)]
struct Recorded<'a> {
    camera: &'a str,
    width: u32,
    height: u32,
    crop: Option<[u32; 4]>,
    spp: u32,
    seed: u64,
    frame: u32,
    sampler: &'a str,
    max_depth: Option<u32>,
    rr_depth: u32,
    clamp: Option<f32>,
    hide_emitters: bool,
    as_mitsuba: bool,
    layers: Vec<String>,
    defines: &'a [(String, String)],
}

/// The attributes of a frame of this scene.
pub fn of(scene: &Scene, camera: usize, settings: &Settings, options: &Render) -> BTreeMap<String, String> {
    let recorded = Recorded {
        camera: &scene.cameras[camera].name,
        width: settings.width,
        height: settings.height,
        crop: settings.crop.map(|c| [c.x, c.y, c.width, c.height]),
        spp: settings.spp,
        seed: settings.seed,
        frame: settings.frame,
        sampler: match settings.sampler {
            Sampler::Sobol => "sobol",
            Sampler::Independent => "independent",
        },
        max_depth: settings.max_depth,
        rr_depth: settings.rr_depth,
        clamp: settings.clamp,
        hide_emitters: settings.hide_emitters,
        as_mitsuba: options.as_mitsuba,
        layers: layers::names(&settings.layers),
        defines: &options.reading.defines,
    };
    let name = scene.file.file_name().unwrap_or_default().to_string_lossy();
    let attributes = [
        ("format", FORMAT.to_owned()),
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ("scene", name.into_owned()),
        ("scene_hash", scene.content_hash.clone()),
        ("settings", serde_json::to_string(&recorded).expect("strings and finite numbers are JSON")),
    ];
    attributes.map(|(key, value)| (format!("limpid:{key}"), value)).into()
}
