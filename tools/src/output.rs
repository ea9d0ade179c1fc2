//! Where results go: names by default, and whether a file can be made there at all.

use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use limpid_frame::{Frame, FrameError, without_name, write_beauty_png, write_exr};

use crate::error::CliError;

/// The files that show a frame.
pub struct Pictures {
    /// Where all its layers go.
    pub frame: Option<PathBuf>,
    /// Where its picture goes, as a screen shows it.
    pub png: Option<PathBuf>,
    /// Brightness of the PNG, in stops.
    pub exposure: f32,
}

impl Pictures {
    /// Those that are to be written.
    pub fn paths(&self) -> Vec<&Path> {
        self.frame.iter().chain(&self.png).map(PathBuf::as_path).collect()
    }

    /// Whether they can be written, before the work that they are to show.
    ///
    /// # Errors
    ///
    /// As [`write`](Self::write) would end, and where both are the same file.
    pub fn check(&self) -> Result<(), CliError> {
        let paths = self.paths();
        paths.iter().try_for_each(|path| check(path))?;
        check_distinct(&paths)
    }

    /// Their names.
    pub fn names(&self) -> Vec<String> {
        self.paths().iter().map(|path| path.display().to_string()).collect()
    }

    /// Writes them, each whole or not at all.
    pub fn write(&self, frame: &Frame) -> Result<(), CliError> {
        if let Some(path) = &self.frame {
            write_exr(frame, path)?;
        }
        if let Some(path) = &self.png {
            write_beauty_png(frame, self.exposure, path)?;
        }
        Ok(())
    }
}

/// The name that outputs get where none is given, without extension: the scene file's, or its folder's where the file
/// is called `scene.*`.
pub fn default_stem(scene: &Path) -> PathBuf {
    let stem = scene.file_stem().unwrap_or("scene".as_ref()); // `..` has none
    if stem != "scene" {
        return PathBuf::from(stem);
    }
    let folder = || fs::canonicalize(scene).ok()?.parent()?.file_name().map(PathBuf::from);
    folder().unwrap_or_else(|| PathBuf::from(stem))
}

/// `stem.extension`, where the stem may have dots of its own.
pub fn named(stem: &Path, extension: &str) -> PathBuf {
    let mut name = stem.as_os_str().to_owned();
    name.push(".");
    name.push(extension);
    PathBuf::from(name)
}

/// Whether all these are different files, however they are spelt.
///
/// # Errors
///
/// Where two are the same.
pub fn check_distinct(paths: &[&Path]) -> Result<(), CliError> {
    let mut seen: Vec<PathBuf> = Vec::new();
    for path in paths {
        let file = identity(path);
        if seen.contains(&file) {
            let problem = "is to be two files; name another".into();
            return Err(CliError::File { path: (*path).into(), problem });
        }
        seen.push(file);
    }
    Ok(())
}

/// A file's name without `.`, `..` and links, as far as it exists.
fn identity(path: &Path) -> PathBuf {
    if let Ok(whole) = fs::canonicalize(path) {
        return whole;
    }
    let folder = path.parent().filter(|f| !f.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let folder = fs::canonicalize(folder).unwrap_or_else(|_| folder.into());
    path.file_name().map_or_else(|| folder.clone(), |name| folder.join(name))
}

/// Whether `folder` is an empty place for a file a tile, or can be made.
///
/// # Errors
///
/// Where it is a file or below one, or holds records of another render.
pub fn check_records_folder(folder: &Path) -> Result<(), CliError> {
    check_folder(folder)?;
    let Ok(mut entries) = fs::read_dir(folder) else { return Ok(()) };
    let is_record = |e: fs::DirEntry| e.path().extension().is_some_and(|x| x == "safetensors");
    if entries.any(|e| e.is_ok_and(is_record)) {
        let problem = "holds records already, which would mix with the new ones; name an empty folder";
        return Err(CliError::File { path: folder.into(), problem: problem.into() });
    }
    Ok(())
}

/// Whether `folder` is one, or can be made, before the work that it is for.
///
/// # Errors
///
/// Where it is a file or below one.
pub fn check_folder(folder: &Path) -> Result<(), CliError> {
    let there = folder.ancestors().find(|f| f.as_os_str().is_empty() || f.exists());
    if there.is_some_and(|f| !f.as_os_str().is_empty() && !f.is_dir()) {
        return Err(output_error(folder, io::Error::from(ErrorKind::NotADirectory)));
    }
    Ok(())
}

/// Whether a file can be made at `path`, before the work that it is for.
///
/// # Errors
///
/// Where it cannot.
pub fn check(path: &Path) -> Result<(), CliError> {
    check_file(path).map_err(|source| output_error(path, source))
}

fn check_file(path: &Path) -> io::Result<()> {
    if path.file_name().is_none() || path.as_os_str().as_encoded_bytes().ends_with(b"/") {
        return Err(io::Error::from(ErrorKind::InvalidFilename));
    }
    match fs::metadata(path) {
        Ok(existing) if existing.is_dir() => return Err(io::Error::from(ErrorKind::IsADirectory)),
        Ok(existing) if !existing.is_file() => return Ok(()), // a device: no folder needs room beside it
        Err(error) if error.kind() != ErrorKind::NotFound => return Err(error),
        _ => {}
    }
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let folder = target.parent().filter(|f| !f.as_os_str().is_empty()).unwrap_or(Path::new("."));
    tempfile::Builder::new().prefix(".limpid-").tempfile_in(folder).map(drop).map_err(without_name)
}

/// Whose fault it is that no file can be made: a full disk is the machine's, anything else the path's.
pub fn output_error(path: &Path, source: io::Error) -> CliError {
    let path = path.to_owned();
    match source.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => FrameError::WriteFailed { path, source }.into(),
        _ => FrameError::OutputPath { path, source }.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pictures(frame: &Path, png: Option<&Path>) -> Pictures {
        Pictures { frame: Some(frame.into()), png: png.map(Into::into), exposure: 0.0 }
    }

    #[test]
    fn outputs_are_named_after_the_scene_or_the_folder_of_scene_files() {
        assert_eq!(default_stem(Path::new("a/kitchen.xml")), Path::new("kitchen"));
        assert_eq!(named(&default_stem(Path::new("a/b.v2.xml")), "exr"), Path::new("b.v2.exr"));
        let folder = tempfile::tempdir().expect("a temporary folder");
        let bathroom = folder.path().join("bathroom");
        fs::create_dir(&bathroom).expect("makes a folder");
        fs::write(bathroom.join("scene.xml"), "").expect("writes");
        assert_eq!(default_stem(&bathroom.join("scene.xml")), Path::new("bathroom"));
        assert_eq!(default_stem(Path::new("nowhere/scene.xml")), Path::new("scene"));
    }

    #[test]
    fn impossible_outputs_are_the_calls_fault_and_checking_leaves_nothing() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = folder.path().join("a-file");
        fs::write(&file, "x").expect("writes");
        for path in [file.join("p.exr"), folder.path().join("no/p.exr"), folder.path().into(), "".into()] {
            let error = pictures(&path, None).check().expect_err("cannot be made");
            assert_eq!(error.exit_code(), 2, "{error}");
            assert!(error.to_string().contains(&*path.to_string_lossy()), "{error}");
        }
        let good = folder.path().join("p.exr");
        pictures(&good, Some(&file)).check().expect("can be made");
        let (dotted, round) = (folder.path().join("./p.exr"), folder.path().join("no/../p.exr"));
        for same in [&good, &dotted] {
            assert_eq!(pictures(&good, Some(same)).check().expect_err("is twice the same").exit_code(), 2);
        }
        assert_eq!(pictures(&good, Some(&round)).check().expect_err("has no folder").exit_code(), 2);
        assert_eq!(fs::read_dir(folder.path()).expect("reads").count(), 1);
    }

    #[cfg(unix)]
    #[test]
    fn one_file_under_two_names_is_noticed() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let (real, link) = (folder.path().join("p.exr"), folder.path().join("p.png"));
        fs::write(&real, "").expect("writes");
        std::os::unix::fs::symlink(&real, &link).expect("links");
        assert_eq!(pictures(&real, Some(&link)).check().expect_err("is twice the same").exit_code(), 2);
        pictures(&real, Some(&folder.path().join("q.png"))).check().expect("are two");
    }

    #[test]
    fn records_go_to_a_folder_without_records() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        check_records_folder(&folder.path().join("new/deep")).expect("can be made");
        check_records_folder(folder.path()).expect("is empty");
        let tile = folder.path().join("tile_00000_00000.safetensors");
        fs::write(&tile, "").expect("writes");
        for wrong in [folder.path(), &tile, &tile.join("below")] {
            assert_eq!(check_records_folder(wrong).expect_err("is wrong").exit_code(), 2);
        }
    }
}
