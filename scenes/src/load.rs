//! The one way in: a path or a text becomes a [`Scene`].

use std::path::Path;
use std::sync::Arc;

use crate::files::Files;
use crate::{Place, Scene, SceneError, Warning, gltf, mitsuba, obj};

/// How a scene file is to be read.
#[derive(Clone, Debug, Default)]
pub struct LoadOptions {
    /// Parameters of the file and their values (`-D name=value`), which override its `<default>`s.
    pub defines: Vec<(String, String)>,
    /// Whether an unused parameter is an error.
    pub strict: bool,
}

/// Extensions of scene files, each with its reader.
const FORMATS: [(&str, Format); 4] =
    [("xml", Format::Mitsuba), ("gltf", Format::Gltf), ("glb", Format::Gltf), ("obj", Format::Obj)];

#[derive(Clone, Copy, PartialEq)]
enum Format {
    Mitsuba,
    Gltf,
    Obj,
}

/// Reads a scene: Mitsuba XML, glTF or OBJ, as the file's extension says.
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
        let help = "name a scene (.xml, .gltf, .glb, .obj); to clean an EXR frame use `limpid denoise`, to look into it `limpid info`";
        return Err(file_error(path, format!("{picture}, not a scene"), help));
    }
    let format = format(path)?;
    files.folders.push(path.parent().unwrap_or(Path::new("")).to_path_buf());
    let mut scene = match format {
        Format::Mitsuba => return strictly(mitsuba::read(bytes, path, files, options)?, options),
        Format::Gltf => gltf::read(bytes, path, files)?,
        Format::Obj => obj::read(&bytes, path, files)?,
    };
    for (name, _) in &options.defines {
        scene.warnings.push(Warning {
            place: Place { file: Arc::new(path.into()), line: 0, column: 0 },
            element: format!("-D {name}"),
            message: "the format has no parameters; it changes nothing".into(),
            unused_parameter: true,
        });
    }
    strictly(scene, options)
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

/// The format that a file's extension stands for, in capitals or small letters.
fn format(path: &Path) -> Result<Format, SceneError> {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
    let known = FORMATS.iter().find(|(known, _)| known.eq_ignore_ascii_case(extension));
    known.map(|(_, format)| *format).ok_or_else(|| {
        let problem = match extension {
            "" => "a scene file without extension".into(),
            other => format!("unknown extension \".{other}\""),
        };
        let names: Vec<String> = FORMATS.iter().map(|(name, _)| format!(".{name}")).collect();
        file_error(path, problem, &format!("scenes are read from {}", names.join(", ")))
    })
}

#[cfg(test)]
mod tests;
