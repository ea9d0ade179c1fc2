//! Scenes of a few lines, and what comes of them.

mod cameras;
mod emitters;
mod errors;
mod hostile;
mod language;
mod materials;
mod nesting;
mod objects;
mod principled;
mod shapes;
mod warnings;

use std::path::Path;

use crate::{LoadOptions, Scene, SceneError, load_str};

/// A version-3 scene with these elements.
fn scene(elements: &str) -> String {
    format!("<scene version=\"3.0.0\">{elements}</scene>")
}

fn try_load(elements: &str) -> Result<Scene, SceneError> {
    load_str(&scene(elements), Path::new(""), &LoadOptions::default())
}

/// The scene of these elements, which must load.
fn loaded(elements: &str) -> Scene {
    try_load(elements).unwrap_or_else(|error| panic!("{elements}: {error}"))
}

/// Takes the `¦` out of a text, and says where it stood as `line:column`.
fn unmark(marked: &str) -> (String, String) {
    let (before, after) = marked.split_once('¦').unwrap_or_else(|| panic!("no mark in {marked}"));
    let line = before.lines().count() + usize::from(before.is_empty() || before.ends_with('\n'));
    let column = before.rsplit('\n').next().unwrap_or(before).chars().count() + 1;
    (format!("{before}{after}"), format!("{line}:{column}"))
}
