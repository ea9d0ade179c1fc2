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
