//! Mitsuba XML: the language of versions 0.x and 2 to 3, and the plugins that limpid renders.
//!
//! Reading goes in two steps. `document` makes a flat list of elements of the text: includes are spliced in,
//! `$parameters` expanded, old names turned into new ones, every element with its place. Then each object is read
//! through [`Object`], which remembers what was asked for, so that the rest can be warned of.

mod bsdfs;
mod camera;
mod coats;
mod daylight;
mod document;
mod emitters;
mod groups;
mod guard;
mod integrator;
mod meshes;
mod nesting;
mod object;
mod parameters;
mod principled;
mod refused;
mod shapes;
mod survey;
mod text;
mod textures;
mod value;

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use self::document::{Document, Element, ElementId};
use self::object::Object;
use crate::files::{Files, Found};
use crate::mesh::{LoadedMesh, MeshOptions};
use crate::nearest::suggest;
use crate::spectrum::Quantity;
use crate::{
    Color, GroupId, Image, LoadOptions, MaterialId, Medium, MediumId, Place, Rgb, Scene, SceneError,
    ShapeKind, TextureKind, Warning,
};

/// Objects inside one another through references. Real files have about 4.
const MAX_NESTING: usize = 32;

/// Reads a scene from the bytes of an XML file. The bytes must have entered the hash of `files` already.
pub(crate) fn read(
    bytes: Vec<u8>,
    file: &Path,
    mut files: Files,
    options: &LoadOptions,
) -> Result<Scene, SceneError> {
    let xml = text::decode(bytes, file)?;
    let document = Document::parse(&xml, file, &mut files, options)?;
    let mut reader = Reader::new(file, &document, files);
    reader.scene()?;
    let Reader { mut scene, mut warnings, files, .. } = reader;
    scene.file = file.into();
    scene.content_hash = files.hash();
    warnings.extend(document.warnings.iter().cloned());
    warnings.sort_by_key(|(id, _)| *id); // in the order of the file, whatever order references made
    scene.warnings = warnings.into_iter().map(|(_, warning)| warning).collect();
    Ok(scene)
}

/// The scene so far, and what its objects share.
struct Reader<'d> {
    /// The scene file.
    file: Arc<PathBuf>,
    document: &'d Document,
    files: Files,
    scene: Scene,
    warnings: Vec<(ElementId, Warning)>,
    materials: HashMap<ElementId, MaterialId>,
    /// Materials that stand in for a BSDF that is not given: grey, and black for emitters.
    default_materials: [Option<MaterialId>; 2],
    textures: HashMap<ElementId, Color>,
    media: HashMap<ElementId, MediumId>,
    meshes: HashMap<(PathBuf, MeshOptions, u32), LoadedMesh>,
    /// Files of several meshes, each of which is read from the same bytes.
    mesh_files: HashMap<PathBuf, Arc<[u8]>>,
    groups: HashMap<ElementId, GroupId>,
    /// Attributes of meshes that some texture looks up.
    looked_up: HashSet<&'d str>,
    images: HashMap<(PathBuf, bool), Arc<Image>>,
    spectra: HashMap<(PathBuf, Quantity), Rgb>,
    /// Objects that are being read: one that comes up again contains itself.
    open: HashSet<ElementId>,
    /// Objects that something refers to, so that a light that belongs to a shape is not missed at the top.
    referenced: HashSet<ElementId>,
}

impl<'d> Reader<'d> {
    fn new(file: &Path, document: &'d Document, files: Files) -> Self {
        let references = document.elements.iter().filter(|element| element.tag == "ref");
        let targets = references.filter_map(|element| document.by_id(element.attribute("id")?));
        Self {
            file: Arc::new(file.into()),
            document,
            files,
            scene: Scene::default(),
            warnings: Vec::new(),
            materials: HashMap::new(),
            default_materials: [None; 2],
            textures: HashMap::new(),
            media: HashMap::new(),
            meshes: HashMap::new(),
            mesh_files: HashMap::new(),
            groups: HashMap::new(),
            looked_up: looked_up(document),
            images: HashMap::new(),
            spectra: HashMap::new(),
            open: HashSet::new(),
            referenced: targets.collect(),
        }
    }

    fn scene(&mut self) -> Result<(), SceneError> {
        let mut integrators = 0;
        for &id in &self.document.top {
            let element = self.document.element(id);
            match element.tag.as_str() {
                "integrator" => {
                    integrators += 1;
                    if integrators > 1 {
                        self.warn(id, "a second integrator is left out: a scene has one");
                        continue;
                    }
                    self.integrator(id)?;
                }
                "sensor" => self.camera(id)?,
                "shape" => self.shape(id)?,
                "bsdf" => _ = self.material(id)?,
                "texture" => _ = self.texture(id)?,
                "medium" => _ = self.medium(id)?,
                "emitter" if self.referenced.contains(&id) => {} // read with its shape
                "emitter" => self.emitter(id)?,
                // these may stand apart, to be referred to
                "film" | "sampler" | "rfilter" | "phase" | "volume" | "spectrum" => {}
                "ref" => self.warn(id, "a reference at the top of a scene means nothing and is passed over"),
                tag => {
                    let help = suggest(tag, "elements", survey::TOP.iter().copied());
                    return Err(SceneError::at(
                        &element.place,
                        tag,
                        format!("unknown element <{}>", value::shorten(tag)),
                        help,
                    ));
                }
            }
        }
        self.check_attributes();
        self.note_what_mitsuba_refuses();
        self.note_axes();
        if self.scene.cameras.is_empty() {
            self.default_camera();
        }
        Ok(())
    }

    /// Warns of textures that name an attribute which no mesh has.
    fn check_attributes(&mut self) {
        let in_groups = self.scene.groups.iter().flat_map(|group| &group.shapes);
        let names: HashSet<&str> = (self.scene.shapes.iter().chain(in_groups))
            .filter_map(|shape| match &shape.kind {
                ShapeKind::Mesh(mesh) => Some(&mesh.attributes),
                _ => None,
            })
            .flat_map(|attributes| attributes.iter().map(|attribute| attribute.name.as_str()))
            .collect();
        for texture in &self.scene.textures {
            if let TextureKind::MeshAttribute { name, .. } = &texture.kind
                && !names.contains(name.as_str())
            {
                let (place, element) = (texture.place.clone(), format!("texture \"{}\"", texture.name));
                let message = format!("no mesh of the scene has an attribute \"{name}\"; it is black");
                self.warnings.push((
                    ElementId(usize::MAX),
                    Warning { place, element, message, unused_parameter: false },
                ));
            }
        }
    }

    /// Adds a warning about an element.
    fn warn(&mut self, id: ElementId, message: impl Into<String>) {
        self.warn_as(id, &self.document.element(id).label(), message);
    }

    /// Adds a warning about an element under another name than its own.
    fn warn_as(&mut self, id: ElementId, label: &str, message: impl Into<String>) {
        let place = self.document.element(id).place.clone();
        let warning =
            Warning { place, element: label.into(), message: message.into(), unused_parameter: false };
        self.warnings.push((id, warning));
    }

    /// Runs `read` on an object that may contain others, which must not contain it in turn.
    fn nested<T>(
        &mut self,
        id: ElementId,
        read: impl FnOnce(&mut Self) -> Result<T, SceneError>,
    ) -> Result<T, SceneError> {
        let element = self.document.element(id);
        if !self.open.insert(id) {
            let problem = "the object contains itself, in the end";
            return Err(SceneError::at(
                &element.place,
                &element.label(),
                problem,
                "cut the circle of references",
            ));
        }
        if self.open.len() > MAX_NESTING {
            let problem = format!("objects nested more than {MAX_NESTING} deep");
            return Err(SceneError::at(&element.place, &element.label(), problem, "nest less"));
        }
        let result = read(self);
        self.open.remove(&id);
        result
    }

    /// A medium, which is known by name only.
    fn medium(&mut self, id: ElementId) -> Result<MediumId, SceneError> {
        if let Some(&known) = self.media.get(&id) {
            return Ok(known);
        }
        let object = Object::new(self.document, id);
        let kind = object.kind()?.to_string();
        let name = self.name(&object, &kind, self.scene.media.len());
        let medium = MediumId(self.scene.media.len() as u32);
        self.scene.media.push(Medium { name, kind, place: object.place() });
        self.media.insert(id, medium);
        Ok(medium)
    }

    /// The id of an object, or its kind and its number in a list of `count` so far.
    fn name(&self, object: &Object<'_>, kind: &str, count: usize) -> String {
        object.element.attribute("id").map_or_else(|| format!("{kind} {}", count + 1), String::from)
    }

    /// The file that the parameter `filename` names.
    fn file(&mut self, object: &Object<'_>) -> Result<PathBuf, SceneError> {
        let Some((name, parameter)) = object.string("filename")? else {
            return Err(
                object.error("no \"filename\"", "name the file: <string name=\"filename\" value=\"…\"/>")
            );
        };
        self.find(name, parameter, &object.element.label())
    }

    /// Looks for a file that the element `naming` names, for the object called `label`.
    fn find(&mut self, name: &str, naming: &Element, label: &str) -> Result<PathBuf, SceneError> {
        let attribute = if naming.attribute("value").is_some() { "value" } else { "filename" };
        let place = naming.place_of(attribute);
        match self.files.find(name, &place.file) {
            Some(Found { path, respelt }) => {
                if respelt {
                    let message =
                        format!("the file \"{}\" was found as {}", value::shorten(name), path.display());
                    let warning = Warning { place, element: label.into(), message, unused_parameter: false };
                    self.warnings.push((naming.id, warning));
                }
                Ok(path)
            }
            None => {
                let problem = format!("the file \"{}\" is not there", value::shorten(name));
                let mut help = String::from("names are looked for beside the scene");
                let mut folders: Vec<_> =
                    self.files.folders.iter().map(|f| f.display().to_string()).collect();
                folders.retain(|folder| !folder.is_empty()); // that of a scene that was named without one
                folders.dedup();
                if !folders.is_empty() {
                    help += &format!(" and in {}", folders.join(", "));
                }
                Err(SceneError::at(&place, label, problem, help))
            }
        }
    }

    /// The whole of a file that an object names.
    fn bytes(&mut self, path: &Path, place: &Place, label: &str) -> Result<Vec<u8>, SceneError> {
        self.files.read(path).map_err(|error| {
            let problem = format!("{}: {error}", path.display());
            SceneError::at(place, label, problem, "name a file that can be read")
        })
    }
}

/// The names in all textures of attributes.
fn looked_up(document: &Document) -> HashSet<&str> {
    let textures = document.elements.iter().filter(|e| e.attribute("type") == Some("mesh_attribute"));
    let named = textures.flat_map(|texture| &texture.children).map(|&id| document.element(id));
    named.filter(|child| child.key == "name").filter_map(|child| child.attribute("value")).collect()
}

#[cfg(test)]
mod tests;
