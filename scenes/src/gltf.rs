//! glTF 2.0: text files with buffers beside them or inside, and binary ones.
//!
//! The JSON text is walked as it is, through `json::Item`, which knows its way from the root: an error says
//! `materials[3].alphaCutoff`. What limpid does not read is passed over, whatever it holds; indices are checked where
//! they are followed. Nodes are read at rest: animations do not count, skins and morph targets do.

mod accessors;
mod buffers;
mod cameras;
mod container;
mod deform;
mod images;
mod json;
mod lights;
mod materials;
mod meshes;
mod nodes;
mod primitives;
mod textures;

use std::collections::{HashMap, HashSet};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use self::accessors::Floats;
use self::buffers::Bytes;
use self::images::ImageKey;
use self::json::{Document, Item};
use self::materials::Surface;
use self::meshes::MeshKey;
use self::textures::TextureKey;
use crate::files::Files;
use crate::mesh::LoadedMesh;
use crate::{Image, Place, Scene, SceneError, TextureId, Warning, standins};

/// Bytes that may be made of a file of `len` bytes besides its pictures, which have a limit of their own.
fn allowance(len: usize) -> u64 {
    (len as u64).saturating_mul(64).saturating_add(1 << 20)
}

/// Reads the bytes of a glTF file, text or binary.
///
/// # Errors
///
/// What makes no glTF 2.0 file, an index that leads nowhere, a file that is not there, a required extension that is not read.
pub(crate) fn read(bytes: Vec<u8>, file: &Path, files: Files) -> Result<Scene, SceneError> {
    let (document, binary) = container::open(&bytes, file)?;
    let mut reader = Reader {
        document: &document,
        file: Arc::new(file.into()),
        allowance: allowance(bytes.len()),
        file_bytes: Arc::new(bytes),
        binary,
        files,
        scene: Scene { file: file.into(), ..Scene::default() },
        buffers: HashMap::new(),
        uris: HashMap::new(),
        accessors: HashMap::new(),
        meshes: HashMap::new(),
        surfaces: HashMap::new(),
        image_bytes: HashMap::new(),
        images: HashMap::new(),
        textures: HashMap::new(),
        camera_names: HashMap::new(),
        has_lamp: false,
        warned: HashSet::new(),
    };
    reader.scene()?;
    let Reader { mut scene, files, .. } = reader;
    scene.content_hash = files.hash();
    Ok(scene)
}

/// The scene so far, and what has been read of the file, each by its index there.
struct Reader<'d> {
    document: &'d Document,
    file: Arc<PathBuf>,
    /// Bytes that may still be taken.
    allowance: u64,
    file_bytes: Arc<Vec<u8>>,
    /// The binary chunk within `file_bytes`.
    binary: Option<Range<usize>>,
    files: Files,
    scene: Scene,
    buffers: HashMap<usize, Bytes>,
    uris: HashMap<String, Bytes>,
    accessors: HashMap<usize, Arc<Floats>>,
    meshes: HashMap<MeshKey, LoadedMesh>,
    /// By the number of the material (`None` for primitives without one), and whether vertices have colours.
    surfaces: HashMap<(Option<usize>, bool), Surface>,
    /// Kept, since their addresses are in the keys of `images`.
    image_bytes: HashMap<usize, Bytes>,
    /// `None` for the alpha of opaque pictures.
    images: HashMap<ImageKey, Option<Arc<Image>>>,
    textures: HashMap<TextureKey, TextureId>,
    /// Names of cameras, with how many have each.
    camera_names: HashMap<String, usize>,
    /// Some surface was made to shine.
    has_lamp: bool,
    /// Elements and messages of the warnings so far.
    warned: HashSet<(String, String)>,
}

impl Reader<'_> {
    fn scene(&mut self) -> Result<(), SceneError> {
        for name in container::unknown_extensions(self.document)? {
            self.warn("extensionsUsed", format!("{name} is not read; the model is shown without it"));
        }
        if self.document.count("animations") > 0 {
            self.warn("animations", "animations are not read; the model is shown at rest");
        }
        self.nodes()?;
        let place = self.place();
        standins::complete(&mut self.scene, self.has_lamp, &place);
        Ok(())
    }

    /// JSON has lines, but nobody reads them.
    fn place(&self) -> Place {
        Place { file: Arc::clone(&self.file), line: 0, column: 0 }
    }

    fn warn(&mut self, element: &str, message: impl Into<String>) {
        let (place, message) = (self.place(), message.into());
        // one for all that ask for the same
        if self.warned.insert((element.into(), message.clone())) {
            let warning = Warning { place, element: element.into(), message, unused_parameter: false };
            self.scene.warnings.push(warning);
        }
    }

    /// Counts memory that is about to be taken for `item`.
    fn take(&mut self, bytes: u64, item: &Item<'_>) -> Result<(), SceneError> {
        match self.allowance.checked_sub(bytes) {
            Some(rest) => {
                self.allowance = rest;
                Ok(())
            }
            None => {
                let problem = "more is made of the file than it can mean: 64 times its size";
                Err(item.error("", problem, "split the model, or remove what repeats the same data"))
            }
        }
    }
}

#[cfg(test)]
mod tests;
