//! Files that appear whole or not at all.

use std::fs::{self, File};
use std::io::{self, BufWriter, ErrorKind, Seek, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::FrameError;

/// Writes a file that appears under its name only when it is whole.
///
/// `write` fills a temporary file in the target's folder, which is then renamed; when anything fails
/// nothing is left, and what stood under the name before is untouched. A symbolic link is followed. A
/// device or pipe (`/dev/null`) is never replaced: it gets the bytes once all are made.
///
/// The file is not forced to the disk: a power cut may lose it, a crash of the program may not.
///
/// # Errors
///
/// [`FrameError::OutputPath`] if no file can be made at `path`, [`FrameError::WriteFailed`] if making
/// or filling it fails otherwise, whatever the error that `write` returns.
pub fn write_whole(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>,
) -> Result<(), FrameError> {
    let path_fault = |source: io::Error| output_error(path, source);
    let target = target_of(path).map_err(path_fault)?;
    let existing = fs::metadata(&target).ok();
    if existing.as_ref().is_some_and(|m| m.is_dir()) {
        return Err(path_fault(io::Error::from(ErrorKind::IsADirectory)));
    }
    if existing.is_some_and(|m| !m.is_file()) {
        return write_through(path, &target, write);
    }

    let folder = target.parent().filter(|f| !f.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut temporary = {
        let mut unfinished = unfinished();
        let temporary = builder().tempfile_in(folder).map_err(|e| path_fault(without_name(e)))?;
        unfinished.push(temporary.path().to_owned());
        temporary
    };
    let filled = fill(temporary.as_file_mut(), write);
    let mut unfinished = unfinished();
    unfinished.retain(|other| other != temporary.path());
    filled.map_err(|source| write_failed(path, source))?;
    temporary.persist(&target).map_err(|e| path_fault(e.error))?;
    Ok(())
}

/// Temporary files that are being filled.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Deletes what [`write_whole`] has begun and not finished, for a program that is about to end. Until what it gives back is
/// dropped no file is begun or finished.
pub fn discard_unfinished() -> impl Sized {
    let mut unfinished = unfinished();
    discard(&mut unfinished);
    unfinished
}

fn discard(temporaries: &mut Vec<PathBuf>) {
    for temporary in temporaries.drain(..) {
        let _ = fs::remove_file(temporary); // gone already, or it stays: nothing more can be done
    }
}

/// Opens a regular file for reading and gives its length. Anything else is refused before it is opened,
/// since opening a pipe waits until somebody writes.
pub(crate) fn open_regular(path: &Path) -> Result<(File, u64), FrameError> {
    let cannot_read = |source| FrameError::CannotRead { path: path.to_owned(), source };
    let metadata = fs::metadata(path).map_err(cannot_read)?;
    if !metadata.is_file() {
        return Err(cannot_read(io::Error::other("it is not a regular file")));
    }
    if metadata.len() == 0 {
        return Err(FrameError::malformed(path, "the file is empty"));
    }
    Ok((File::open(path).map_err(cannot_read)?, metadata.len()))
}

/// The file that `path` means: the end of its symbolic links where it has any.
fn target_of(path: &Path) -> io::Result<PathBuf> {
    if path.file_name().is_none() || path.as_os_str().as_encoded_bytes().ends_with(b"/") {
        // Empty, `..`, a root, or a folder's name.
        return Err(io::Error::from(ErrorKind::InvalidFilename));
    }
    match fs::canonicalize(path) {
        Ok(target) => Ok(target),
        Err(e) if e.kind() == ErrorKind::NotFound => Ok(path.to_owned()),
        Err(e) => Err(e),
    }
}

fn builder() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".limpid-").suffix(".part");
    #[cfg(unix)]
    {
        // Temporary files are private by default; an output gets what the user's umask allows.
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder
}

/// What went wrong, without the temporary file's name, which says nothing to anybody.
pub fn without_name(error: io::Error) -> io::Error {
    match error.raw_os_error().or_else(|| inner_code(&error)) {
        Some(code) => io::Error::from_raw_os_error(code),
        None => error,
    }
}

fn inner_code(error: &io::Error) -> Option<i32> {
    let mut source = error.get_ref().and_then(|e| e.source());
    while let Some(inner) = source {
        if let Some(code) = inner.downcast_ref::<io::Error>().and_then(io::Error::raw_os_error) {
            return Some(code);
        }
        source = inner.source();
    }
    None
}

fn fill(file: &mut File, write: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>) -> io::Result<()> {
    let mut buffered = BufWriter::with_capacity(1 << 18, file);
    write(&mut buffered)?;
    buffered.flush()
}

/// For what is not a regular file: makes all bytes elsewhere first, since writers seek and pipes cannot.
fn write_through(
    path: &Path,
    target: &Path,
    write: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>,
) -> Result<(), FrameError> {
    let failed = |source| write_failed(path, source);
    let mut device = File::options().write(true).open(target).map_err(|e| output_error(path, e))?;
    let mut bytes = tempfile::tempfile().map_err(failed)?;
    fill(&mut bytes, write).map_err(failed)?;
    bytes.rewind().map_err(failed)?;
    io::copy(&mut bytes, &mut device).and_then(|_| device.flush()).map_err(failed)
}

fn write_failed(path: &Path, source: io::Error) -> FrameError {
    FrameError::WriteFailed { path: path.to_owned(), source }
}

/// Sorts an error of making the file by whose fault it is: the path's or the machine's.
pub(crate) fn output_error(path: &Path, source: io::Error) -> FrameError {
    match source.kind() {
        ErrorKind::NotFound
        | ErrorKind::NotADirectory
        | ErrorKind::IsADirectory
        | ErrorKind::PermissionDenied
        | ErrorKind::ReadOnlyFilesystem
        | ErrorKind::InvalidFilename
        | ErrorKind::InvalidInput => FrameError::OutputPath { path: path.to_owned(), source },
        _ => write_failed(path, source),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Fault;

    fn names_in(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).expect("the folder is there");
        entries.map(|e| e.expect("readable").file_name().to_string_lossy().into_owned()).collect()
    }

    #[test]
    fn a_written_file_holds_the_bytes_and_nothing_stands_beside_it() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a.bin");
        write_whole(&path, |f| f.write_all(b"old")).expect("writes");
        write_whole(&path, |f| f.write_all(b"new")).expect("overwrites");
        assert_eq!(fs::read(&path).expect("reads"), b"new");
        assert_eq!(names_in(folder.path()), ["a.bin"]);
    }

    #[test]
    fn a_failed_write_keeps_the_old_file_leaves_nothing_and_blames_the_machine() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a.bin");
        write_whole(&path, |f| f.write_all(b"old")).expect("writes");
        let full = |f: &mut BufWriter<&mut File>| {
            f.write_all(&[1; 1 << 20])?;
            Err(io::Error::from(ErrorKind::StorageFull))
        };
        let error = write_whole(&path, full).expect_err("the disk is full");
        assert_eq!(error.fault(), Fault::Machine);
        assert!(error.to_string().contains("a.bin"), "{error}");
        assert_eq!(fs::read(&path).expect("reads"), b"old");
        assert_eq!(names_in(folder.path()), ["a.bin"]);
    }

    #[test]
    fn what_is_unfinished_when_the_program_ends_is_deleted_and_what_stood_there_kept() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a.bin");
        write_whole(&path, |f| f.write_all(b"old")).expect("writes");
        let result = write_whole(&path, |f| {
            f.write_all(b"new")?;
            f.flush()?;
            assert_eq!(names_in(folder.path()).len(), 2);
            // Other tests write at the same time: theirs are left alone.
            let mut all = unfinished();
            let mine = all.iter().position(|p| p.parent() == Some(folder.path())).expect("is listed");
            discard(&mut vec![all.swap_remove(mine)]);
            drop(all);
            assert_eq!(names_in(folder.path()), ["a.bin"]);
            Ok(())
        });
        assert!(result.is_err());
        assert_eq!(fs::read(&path).expect("reads"), b"old");
    }

    #[test]
    fn paths_that_cannot_be_files_are_the_calls_fault() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = folder.path().join("file");
        fs::write(&file, b"x").expect("writes");
        let wrong = [
            file.join("below.exr"),
            folder.path().join("no/such/folder.exr"),
            folder.path().to_owned(),
            PathBuf::new(),
            folder.path().join("n".repeat(5000)),
            folder.path().join("nul\0.exr"),
        ];
        for path in wrong {
            let error = write_whole(&path, |_| panic!("must not get as far as writing")).expect_err("fails");
            assert!(matches!(error, FrameError::OutputPath { .. }), "{path:?}: {error:?}");
            assert_eq!(error.fault(), Fault::Input);
        }
        assert_eq!(names_in(folder.path()), ["file"]);
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed_and_files_get_the_usual_permissions() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().expect("a temporary folder");
        let (real, link) = (folder.path().join("real"), folder.path().join("link"));
        fs::write(&real, b"old").expect("writes");
        std::os::unix::fs::symlink(&real, &link).expect("links");
        write_whole(&link, |f| f.write_all(b"new")).expect("writes");
        assert_eq!(fs::read(&real).expect("reads"), b"new");
        assert!(fs::symlink_metadata(&link).expect("is there").is_symlink());

        let plain = folder.path().join("plain");
        fs::write(&plain, b"").expect("writes");
        let mode = |p: &Path| fs::metadata(p).expect("is there").permissions().mode();
        assert_eq!(mode(&real), mode(&plain));
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn devices_are_written_to_and_a_full_one_is_the_machines_fault() {
        use std::os::unix::fs::FileTypeExt;
        write_whole(Path::new("/dev/null"), |f| f.write_all(b"gone")).expect("null takes all");
        assert!(fs::metadata("/dev/null").expect("is there").file_type().is_char_device());
        let error = write_whole(Path::new("/dev/full"), |f| f.write_all(b"no room")).expect_err("is full");
        assert_eq!(error.fault(), Fault::Machine);
    }
}
