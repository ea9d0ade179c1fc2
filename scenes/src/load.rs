//! The one way in: a path or a text becomes a [`Scene`].

use std::path::Path;

use crate::files::Files;
use crate::{Scene, SceneError, mitsuba};

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
    let mut files = Files::default();
    let bytes = files.read(path).map_err(|error| {
        let inside = path.join("scene.xml");
        match path.is_dir() && inside.is_file() {
            true => {
                file_error(path, error.to_string(), &format!("name the file in it: {}", inside.display()))
            }
            false => file_error(path, error.to_string(), "name a scene file that can be read"),
        }
    })?;
    if let Some(picture) = picture_format(&bytes) {
        let help =
            "name a scene (.xml); to clean an EXR frame use `limpid denoise`, to look into it `limpid info`";
        return Err(file_error(path, format!("{picture}, not a scene"), help));
    }
    if let Some(format) = other_format(&bytes, path) {
        let help = "render a Mitsuba scene (.xml) that holds the model, or wait for this reader";
        return Err(file_error(path, format!("{format} is not read yet"), help));
    }
    files.folders.push(path.parent().unwrap_or(Path::new("")).to_path_buf());
    strictly(mitsuba::read(bytes, path, files, options)?, options)
}

/// Reads a scene from the text of a Mitsuba XML file; files that it names are looked for in `base_dir`.
///
/// Errors and warnings call the text `(text)`, in that folder.
///
/// # Errors
///
/// As [`load`].
pub fn load_str(text: &str, base_dir: &Path, options: &LoadOptions) -> Result<Scene, SceneError> {
    let mut files = Files::default();
    files.count(text.as_bytes());
    files.folders.push(base_dir.to_path_buf());
    strictly(mitsuba::read(text.into(), &base_dir.join("(text)"), files, options)?, options)
}

/// Turns the first unused parameter into an error, if that is asked for.
fn strictly(scene: Scene, options: &LoadOptions) -> Result<Scene, SceneError> {
    let unused = scene.warnings.iter().find(|warning| options.strict && warning.unused_parameter);
    match unused {
        Some(warning) => {
            let help = "correct its name, remove it, or read the file without --strict";
            Err(SceneError::at(&warning.place, &warning.element, warning.message.as_str(), help))
        }
        None => Ok(scene),
    }
}

fn file_error(file: &Path, problem: String, help: &str) -> SceneError {
    SceneError { file: file.into(), line: 0, column: 0, element: "scene".into(), problem, help: help.into() }
}

/// What kind of picture this is, if it is one.
fn picture_format(bytes: &[u8]) -> Option<&'static str> {
    let formats: [(&[u8], &str); 4] = [
        (b"\x76\x2f\x31\x01", "an EXR frame"),
        (b"\x89PNG", "a PNG picture"),
        (b"\xff\xd8\xff", "a JPEG picture"),
        (b"#?RADIANCE", "a Radiance HDR picture"),
    ];
    formats.iter().find(|(magic, _)| bytes.starts_with(magic)).map(|(_, name)| *name)
}

/// The name of a known format that is not Mitsuba's.
fn other_format(bytes: &[u8], path: &Path) -> Option<&'static str> {
    let text = bytes.trim_ascii_start();
    let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
    if bytes.starts_with(b"glTF") {
        return Some("binary glTF");
    }
    if text.starts_with(b"<") {
        return None;
    }
    match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
        "gltf" | "glb" => Some("glTF"),
        "obj" => Some("OBJ as a scene"),
        "ply" => Some("PLY as a scene"),
        _ if text.starts_with(b"{") => Some("glTF"),
        _ => None,
    }
}

#[cfg(test)]
mod tests;
