//! `limpid export`: a scene as Mitsuba XML.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use limpid_frame::write_whole;
use limpid_scenes::{ExportError, Exported, Scene, export_mitsuba};
use serde_json::json;

use crate::cli::{Common, Export};
use crate::error::CliError;
use crate::{output, scene, words};

/// Reads a scene and writes it.
pub fn run(options: &Export, common: &Common) -> Result<(), CliError> {
    output::check(&options.output)?;
    output::check_folder(&folder_of(&options.output))?;
    let scene = scene::load(&options.scene, &options.reading, common)?;
    let (files, notes) = write(&scene, &options.output)?;
    for note in &notes {
        words::note(common, format_args!("note: {note}"));
    }
    let xml = options.output.display().to_string();
    if common.json {
        return words::result(json!({ "output": xml, "files": files, "notes": notes }));
    }
    words::note(
        common,
        format_args!("{xml} and {} files in {}", files.len(), folder_of(&options.output).display()),
    );
    Ok(())
}

/// Writes `scene` to `path`, its meshes and pictures to a folder beside it; gives their names and what differs.
pub fn write(scene: &Scene, path: &Path) -> Result<(Vec<String>, Vec<String>), CliError> {
    let folder = folder_of(path);
    let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let beside = path.parent().unwrap_or(Path::new(""));
    let mut files = Vec::new();
    let mut failure = None; // what `export_mitsuba` hands on says less
    let mut write = |name: &str, bytes: &[u8]| {
        let made = fs::create_dir_all(&folder).map_err(|source| output::output_error(&folder, source));
        let written = made.and_then(|()| {
            write_whole(&beside.join(name), |file| file.write_all(bytes)).map_err(CliError::from)
        });
        files.push(name.to_owned());
        written.map_err(|error| io::Error::other(failure.insert(error).to_string()))
    };
    let exported = export_mitsuba(scene, &name, &mut write);
    let Exported { xml, notes } = exported.map_err(|error| match (error, failure) {
        (ExportError::Scene(error), _) => CliError::Scene(error),
        (ExportError::Write { .. }, Some(failure)) => failure,
        (ExportError::Write { name, source }, None) => output::output_error(&beside.join(name), source),
    })?;
    write_whole(path, |file| file.write_all(xml.as_bytes()))?;
    Ok((files, notes))
}

/// Where the files go that `path` refers to.
fn folder_of(path: &Path) -> PathBuf {
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push("_files");
    path.with_file_name(name)
}
