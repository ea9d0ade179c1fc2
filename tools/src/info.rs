//! `limpid info`: what a scene calls for, or what a frame holds.

use std::collections::{BTreeMap, HashSet};
use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::sync::Arc;

use limpid_frame::{Frame, Layer, Statistic, read_exr};
use limpid_renderer::Called;
use limpid_scenes::{Scene, ShapeKind};
use serde_json::{Value, json};

use crate::cli::{Common, Info, Reading};
use crate::error::CliError;
use crate::{layers, scene, words};

/// The first bytes of every EXR file.
const EXR_MAGIC: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];

/// What people see of a scene or a frame, in this order; warnings go to standard error.
const SHOWN: [&str; 15] = [
    "size",
    "spp",
    "cameras",
    "triangles",
    "shapes",
    "instances",
    "lights",
    "materials",
    "textures",
    "effects",
    "layers",
    "other",
    "non_finite",
    "metadata",
    "content_hash",
];

/// Shows each file.
pub fn run(options: &Info, common: &Common) -> Result<(), CliError> {
    let mut all = Vec::new();
    for path in &options.files {
        let about = if is_frame(path) { of_frame(path)? } else { of_scene(path, &options.reading, common)? };
        if common.json {
            all.push(about);
        } else {
            words::result(table(path, &about))?;
        }
    }
    match all.as_slice() {
        [] => Ok(()),
        [one] => words::result(one),
        _ => words::result(json!({ "files": all })),
    }
}

/// Effects as JSON: `[{name, because}]`.
pub fn effects(called: &[Called]) -> Value {
    called.iter().map(|c| json!({ "name": c.effect.name(), "because": c.because })).collect()
}

fn is_frame(path: &Path) -> bool {
    let mut magic = [0; 4];
    let regular = path.is_file(); // opening a pipe would wait for somebody to write
    let read = regular && File::open(path).and_then(|mut file| file.read_exact(&mut magic)).is_ok();
    read && magic == EXR_MAGIC || path.extension().is_some_and(|e| e.eq_ignore_ascii_case("exr"))
}

fn of_frame(path: &Path) -> Result<Value, CliError> {
    let frame = read_exr(path)?;
    let channels: Vec<&str> = frame.channels().map(|(name, _)| name).collect();
    let non_finite: BTreeMap<&str, usize> = frame.non_finite().into_iter().collect();
    Ok(json!({
        "file": path,
        "width": frame.width(),
        "height": frame.height(),
        "size": [frame.width(), frame.height()],
        "layers": layers::names(&frame.layers_present()),
        "other": others(&frame),
        "channels": channels,
        "non_finite": non_finite,
        "metadata": frame.metadata,
    }))
}

/// Channels that belong to no layer: the `noisy.R` that a denoiser keeps, and other programs' words.
fn others(frame: &Frame) -> Vec<&str> {
    let known = |name: &str| {
        Layer::ALL.into_iter().any(|layer| {
            Statistic::ALL.into_iter().any(|s| layer.channel_names(s).iter().any(|known| known == name))
        })
    };
    frame.channels().map(|(name, _)| name).filter(|name| !known(name)).collect()
}

fn of_scene(path: &Path, reading: &Reading, common: &Common) -> Result<Value, CliError> {
    let scene = scene::load(path, reading, common)?;
    let (triangles, instances) = geometry(&scene);
    let camera = |c: &limpid_scenes::Camera| {
        json!({
            "name": c.name,
            "width": c.film.width,
            "height": c.film.height,
            "spp": c.sampler.sample_count,
        })
    };
    let first = scene.cameras.first();
    Ok(json!({
        "file": path,
        "triangles": triangles,
        "shapes": scene.shapes.len(),
        "instances": instances,
        "lights": scene.lights.len() + scene.shapes.iter().filter(|s| s.emission.is_some()).count(),
        "materials": scene.materials.len(),
        "textures": scene.textures.len(),
        "effects": effects(&limpid_renderer::effects(&scene)),
        "cameras": scene.cameras.iter().map(camera).collect::<Vec<_>>(),
        "size": first.map(|c| [c.film.width, c.film.height]),
        "spp": first.map(|c| c.sampler.sample_count),
        "content_hash": scene.content_hash,
        "warnings": scene.warnings.iter().map(words::describe).collect::<Vec<_>>(),
    }))
}

/// Triangles, those of a group once, and shapes that show a group, or a mesh again which an earlier one has.
fn geometry(scene: &Scene) -> (usize, usize) {
    let (mut triangles, mut instances, mut meshes) = (0, 0, HashSet::new());
    let in_groups = scene.groups.iter().flat_map(|group| &group.shapes);
    for shape in scene.shapes.iter().chain(in_groups) {
        triangles += match &shape.kind {
            ShapeKind::Mesh(mesh) => {
                instances += usize::from(!meshes.insert(Arc::as_ptr(mesh)));
                mesh.triangles.len()
            }
            ShapeKind::Instance { .. } => {
                instances += 1;
                0
            }
            ShapeKind::Rectangle => 2,
            ShapeKind::Cube => 12,
            ShapeKind::Sphere { .. } | ShapeKind::Cylinder { .. } | ShapeKind::Disk => 0,
        };
    }
    (triangles, instances)
}

/// The same for people: a line a key, lists in words.
fn table(path: &Path, about: &Value) -> String {
    let mut lines = vec![path.display().to_string()];
    for key in SHOWN {
        match &about[key] {
            Value::Null => {}
            Value::Array(items) if items.is_empty() => {}
            Value::Array(items) => {
                let between = if key == "size" { "x" } else { ", " };
                lines.push(line(key, &items.iter().map(in_words).collect::<Vec<_>>().join(between)));
            }
            Value::Object(entries) => {
                lines.extend(entries.iter().map(|(name, value)| line(name, &in_words(value))));
            }
            value => lines.push(line(key, &in_words(value))),
        }
    }
    lines.join("\n")
}

fn line(key: &str, value: &str) -> String {
    format!("  {key:<18} {value}")
}

fn in_words(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Object(entry) => match (&entry["name"], entry.get("because"), entry.get("width")) {
            (Value::String(name), Some(Value::String(because)), _) => format!("{name} ({because})"),
            (Value::String(name), _, Some(width)) => format!("{name} ({width}x{})", entry["height"]),
            _ => value.to_string(),
        },
        other => other.to_string(),
    }
}
