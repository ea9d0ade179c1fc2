//! A scene from its file, with its warnings said.

use std::path::Path;

use limpid_scenes::{LoadOptions, Scene};

use crate::cli::{Common, Reading};
use crate::error::CliError;
use crate::progress::with_spinner;
use crate::words;

/// Reads a scene and says what in it could not be honoured.
pub fn load(path: &Path, reading: &Reading, common: &Common) -> Result<Scene, CliError> {
    let options = LoadOptions { defines: reading.defines.clone(), strict: reading.strict };
    let scene = with_spinner(common, "reading the scene", || limpid_scenes::load(path, &options))?;
    words::warnings(common, &scene.warnings);
    Ok(scene)
}

/// The index of the camera with this name, or of the first where none is named.
///
/// # Errors
///
/// Where the scene has no such camera.
pub fn camera(scene: &Scene, name: Option<&str>, path: &Path) -> Result<usize, CliError> {
    let Some(name) = name else {
        if scene.cameras.is_empty() {
            let problem = "the scene has no camera; add a sensor".into();
            return Err(CliError::File { path: path.to_owned(), problem });
        }
        return Ok(0);
    };
    scene.cameras.iter().position(|camera| camera.name == name).ok_or_else(|| {
        let known: Vec<&str> = scene.cameras.iter().map(|camera| camera.name.as_str()).collect();
        let problem = format!("the scene has no such camera; it has {}", known.join(", "));
        CliError::option("--camera", name, problem)
    })
}
