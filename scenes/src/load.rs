//! The one way in: a path or a text becomes a [`Scene`].

use std::path::Path;

use crate::{Scene, SceneError};

/// How a scene file is to be read.
#[derive(Clone, Debug, Default)]
pub struct LoadOptions {
    /// Parameters of the file and their values (`-D name=value`), which override its `<default>`s.
    pub defines: Vec<(String, String)>,
    /// Whether an unused parameter is an error.
    pub strict: bool,
}

/// Reads a scene; the format is told by the content, or else by the extension.
///
/// # Errors
///
/// The first thing in the file, or in a file that it names, that makes no scene. Whatever can be
/// left out or replaced is a [`Warning`](crate::Warning) of the scene instead.
pub fn load(path: &Path, options: &LoadOptions) -> Result<Scene, SceneError> {
    let _ = options;
    Err(SceneError {
        file: path.into(),
        line: 0,
        column: 0,
        element: "scene".into(),
        problem: "no format is read yet".into(),
        help: "wait for the readers".into(),
    })
}

/// Reads a scene from the text of a Mitsuba XML file; files that it names are looked for in `base_dir`.
///
/// # Errors
///
/// As [`load`].
pub fn load_str(text: &str, base_dir: &Path, options: &LoadOptions) -> Result<Scene, SceneError> {
    let _ = text;
    load(base_dir, options)
}
