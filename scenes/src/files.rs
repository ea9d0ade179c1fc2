//! Finding and reading the files that a scene names.

use std::collections::HashMap;
use std::fs;
use std::io;
use std::path::{Component, Path, PathBuf};

use sha2::{Digest, Sha256};

/// The files of one scene: where they are looked for, and the hash over all that was read.
#[derive(Debug, Default)]
pub(crate) struct Files {
    /// Looked into after the folder of the naming file; the latest `<path>` first, the scene's own folder last.
    pub folders: Vec<PathBuf>,
    hasher: Sha256,
    listings: HashMap<PathBuf, Vec<String>>,
}

/// A file that exists.
#[derive(Debug)]
pub(crate) struct Found {
    pub path: PathBuf,
    /// It carries another spelling than was asked for.
    pub respelt: bool,
}

impl Files {
    /// Looks for `name`: in the folder of the file that names it, then in `folders`. Where no folder has it as it is
    /// written, backslashes count as slashes and capitals as small letters.
    pub fn find(&mut self, name: &str, naming_file: &Path) -> Option<Found> {
        let own_folder = naming_file.parent().unwrap_or(Path::new("")).to_path_buf();
        let folders: Vec<_> = std::iter::once(own_folder).chain(self.folders.iter().cloned()).collect();
        let as_written = folders.iter().map(|folder| folder.join(name)).find(|path| path.exists());
        if let Some(path) = as_written {
            return Some(Found { path, respelt: false });
        }
        let slashed = name.replace('\\', "/");
        folders
            .iter()
            .find_map(|folder| self.find_ignoring_case(folder, Path::new(&slashed)))
            .map(|path| Found { path, respelt: true })
    }

    /// Walks down from `folder` and takes at each step the entry that matches apart from capitals.
    fn find_ignoring_case(&mut self, folder: &Path, name: &Path) -> Option<PathBuf> {
        let mut path = folder.to_path_buf();
        for component in name.components() {
            let Component::Normal(wanted) = component else {
                path.push(component);
                continue;
            };
            let exact = path.join(wanted);
            if exact.exists() {
                path = exact;
                continue;
            }
            let wanted = wanted.to_str()?.to_lowercase();
            let entry = self.listing(&path).iter().find(|entry| entry.to_lowercase() == wanted)?.clone();
            path.push(entry);
        }
        path.exists().then_some(path)
    }

    /// The names in a folder, sorted so that the choice does not depend on the file system.
    fn listing(&mut self, folder: &Path) -> &[String] {
        self.listings.entry(folder.to_path_buf()).or_insert_with(|| {
            let readable = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
            let entries = fs::read_dir(readable).into_iter().flatten().flatten();
            let mut names: Vec<_> =
                entries.filter_map(|entry| entry.file_name().into_string().ok()).collect();
            names.sort();
            names
        })
    }

    /// The whole of a file, which enters the hash.
    ///
    /// # Errors
    ///
    /// As the system says; also for what is no regular file, since a pipe or a device may never end.
    pub fn read(&mut self, path: &Path) -> io::Result<Vec<u8>> {
        let about = fs::metadata(path)?;
        if about.is_dir() {
            return Err(io::Error::new(io::ErrorKind::IsADirectory, "not a regular file but a folder"));
        }
        if !about.is_file() {
            return Err(io::Error::new(io::ErrorKind::InvalidInput, "not a regular file"));
        }
        let bytes = fs::read(path)?;
        self.count(&bytes);
        Ok(bytes)
    }

    /// Lets content that was read elsewhere enter the hash.
    pub fn count(&mut self, bytes: &[u8]) {
        self.hasher.update(bytes);
    }

    /// SHA-256 over everything read so far, as hexadecimal digits.
    pub fn hash(&self) -> String {
        self.hasher.clone().finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

/// A key under which a file is known whatever path led to it.
pub(crate) fn identity(path: &Path) -> PathBuf {
    fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_naming_file_comes_before_search_folders_and_the_exact_name_before_others() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path();
        for sub in ["a", "b"] {
            fs::create_dir(root.join(sub)).unwrap();
        }
        for file in ["a/x", "b/x", "b/y", "a/Y", "a/Z"] {
            fs::write(root.join(file), file).unwrap();
        }
        let mut files = Files { folders: vec![root.join("b"), root.to_path_buf()], ..Files::default() };
        let naming = root.join("a/scene.xml");
        let mut find = |name: &str| {
            let found = files.find(name, &naming)?;
            Some((found.path.strip_prefix(root).unwrap().to_path_buf(), found.respelt))
        };
        assert_eq!(find("x"), Some(("a/x".into(), false)));
        assert_eq!(find("y"), Some(("b/y".into(), false)));
        assert_eq!(find("z"), Some(("a/Z".into(), true)));
        assert_eq!(find(r"B\X"), Some(("b/x".into(), true)));
        assert_eq!(find("b/x"), Some(("b/x".into(), false)));
        assert_eq!(find("w"), None);
    }

    #[test]
    fn the_hash_is_over_what_was_read() {
        let mut files = Files::default();
        files.count(b"abc");
        // FIPS 180-2, example B.1
        assert_eq!(files.hash(), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    }
}
