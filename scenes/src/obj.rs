//! OBJ files as scenes, with the materials of their MTL files.
//!
//! Each object's faces of one material are a shape. What is missing, a library, a material, a picture, is a warning:
//! OBJ files travel alone all too often.

mod materials;
mod mtl;

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DMat4;

use self::materials::{Surface, Use};
use self::mtl::Mtl;
use crate::files::{Files, identity};
use crate::mesh::obj::{ObjPart, read_parts};
use crate::{Emission, Image, Place, Scene, SceneError, Shape, ShapeKind, Warning, standins};

/// Reads the bytes of an OBJ file.
///
/// # Errors
///
/// A line that is no number, vertex or face, and an index that the file does not hold, with their line.
pub(crate) fn read(bytes: &[u8], file: &Path, files: Files) -> Result<Scene, SceneError> {
    let (parts, libraries, notes) = read_parts(bytes, file)?;
    let mut reader = Reader {
        file: Arc::new(file.into()),
        files,
        scene: Scene { file: file.into(), ..Scene::default() },
        library: HashMap::new(),
        surfaces: HashMap::new(),
        default: None,
        images: HashMap::new(),
        has_lamp: false,
        warned: HashSet::new(),
    };
    for note in notes {
        let place = reader.place(note.line);
        reader.warn(&place, "mesh", note.message);
    }
    for (line, names) in libraries {
        reader.libraries(line, &names);
    }
    for part in parts {
        reader.shape(part);
    }
    let place = reader.place(0);
    standins::complete(&mut reader.scene, reader.has_lamp, &place);
    reader.scene.content_hash = reader.files.hash();
    Ok(reader.scene)
}

/// The scene so far.
struct Reader {
    file: Arc<PathBuf>,
    files: Files,
    scene: Scene,
    /// Materials of the libraries with their places, by name; the first of a name counts.
    library: HashMap<String, (Mtl, Place)>,
    surfaces: HashMap<String, Surface>,
    default: Option<Surface>,
    images: HashMap<(PathBuf, Use), Arc<Image>>,
    /// Some material shines.
    has_lamp: bool,
    /// What has been warned of.
    warned: HashSet<(Place, String)>,
}

impl Reader {
    /// A line of the OBJ file; 0 for the file as a whole.
    fn place(&self, line: u32) -> Place {
        Place { file: Arc::clone(&self.file), line, column: line.min(1) }
    }

    fn warn(&mut self, place: &Place, element: &str, message: impl Into<String>) {
        let message = message.into();
        if self.warned.insert((place.clone(), message.clone())) {
            let (place, element) = (place.clone(), element.into());
            self.scene.warnings.push(Warning { place, element, message, unused_parameter: false });
        }
    }

    /// Reads what `mtllib` names: one file whose name may hold blanks, or several.
    fn libraries(&mut self, line: u32, names: &str) {
        let file = Arc::clone(&self.file);
        let mut find = |name: &str| self.files.find(name, &file).map(|found| found.path);
        let whole = find(names);
        let paths: Vec<(String, Option<PathBuf>)> = match whole {
            Some(path) => vec![(names.into(), Some(path))],
            None => names.split_whitespace().map(|name| (name.into(), find(name))).collect(),
        };
        let place = self.place(line);
        if paths.iter().all(|(_, path)| path.is_none()) {
            self.warn(&place, "mtllib", format!("\"{}\" is not there; grey stands in", shorten(names)));
            return;
        }
        for (name, path) in paths {
            match path {
                Some(path) => self.library(&path, &place),
                None => self.warn(&place, "mtllib", format!("\"{}\" is not there", shorten(&name))),
            }
        }
    }

    fn library(&mut self, path: &Path, place: &Place) {
        let known = identity(path);
        if !self.warned.insert((Place { file: Arc::new(known), line: 0, column: 0 }, "read".into())) {
            return; // read already
        }
        let bytes = match self.files.read(path) {
            Ok(bytes) => bytes,
            Err(error) => {
                self.warn(place, "mtllib", format!("{}: {error}; grey stands in", path.display()));
                return;
            }
        };
        let file = Arc::new(path.to_path_buf());
        let at = |line: u32| Place { file: Arc::clone(&file), line, column: 1 };
        let (materials, remarks) = mtl::parse(&bytes);
        for (line, remark) in remarks {
            self.warn(&at(line), "material", remark);
        }
        for material in materials {
            let place = at(material.line);
            self.library.entry(material.name.clone()).or_insert((material, place));
        }
    }

    fn shape(&mut self, part: ObjPart) {
        let ObjPart { object, material, line, mesh } = part;
        let name = match (&object, &material) {
            (Some(object), Some(material)) => format!("{object} {material}"),
            (Some(name), None) | (None, Some(name)) => name.clone(),
            (None, None) => format!("mesh {}", self.scene.shapes.len() + 1),
        };
        for note in &mesh.notes {
            let place = self.place(note.line);
            self.warn(&place, &name, note.message.clone());
        }
        if mesh.mesh.triangles.is_empty() {
            return;
        }
        let surface = match &material {
            Some(material) => self.named(material, line),
            None => self.default_surface(),
        };
        let place = self.place(line);
        self.scene.shapes.push(Shape {
            name,
            kind: ShapeKind::Mesh(mesh.mesh),
            world_from_object: DMat4::from_translation(mesh.offset),
            flip_normals: false,
            material: surface.material,
            emission: surface.emission.map(|radiance| Emission {
                name: None,
                radiance,
                place: place.clone(),
            }),
            interior: None,
            exterior: None,
            place,
        });
    }

    /// What a name of `usemtl` shows.
    fn named(&mut self, name: &str, line: u32) -> Surface {
        if let Some(&known) = self.surfaces.get(name) {
            return known;
        }
        let surface = match self.library.get(name).cloned() {
            Some((mtl, place)) => self.surface(&mtl, &place),
            None => {
                let place = self.place(line);
                let message = format!("no library has the material \"{}\"; grey stands in", shorten(name));
                self.warn(&place, "usemtl", message);
                self.default_surface()
            }
        };
        self.surfaces.insert(name.into(), surface);
        surface
    }
}

fn shorten(text: &str) -> String {
    text.chars().take(80).collect()
}

#[cfg(test)]
mod tests;
