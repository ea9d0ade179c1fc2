//! A scene as Mitsuba XML that renders the same picture there.

mod assets;
mod bake;
mod camera;
mod lights;
mod materials;
mod principled;
mod products;
mod shapes;
mod textures;
mod xml;

use std::collections::{HashMap, HashSet};
use std::io;
use std::sync::Arc;

use crate::gltf_in_mitsuba::replace_gltf_materials;
use crate::{Aov, Image, Mesh, Scene, SceneError};
use xml::Xml;

/// What could not be exported.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// Something in the scene that has no counterpart.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A file could not be written.
    #[error("{name}: {source}")]
    Write {
        /// The file's name, relative to the XML file.
        name: String,
        /// What the system said.
        source: io::Error,
    },
}

/// Text of a scene file, and what is not quite the same in it.
#[derive(Debug)]
pub struct Exported {
    /// The XML file.
    pub xml: String,
    /// A sentence each: what Mitsuba will show otherwise.
    pub notes: Vec<String>,
}

/// Writes `scene` for Mitsuba 3. Meshes and pictures are given to `write`, each with a name that begins with
/// `folder/`; the XML refers to them by that name.
///
/// # Errors
///
/// Where the scene holds what Mitsuba lacks or what is not exported (participating media), and where `write` fails.
pub fn export_mitsuba(
    scene: &Scene,
    folder: &str,
    write: &mut dyn FnMut(&str, &[u8]) -> io::Result<()>,
) -> Result<Exported, ExportError> {
    if let Some(medium) = scene.media.first() {
        let help = "remove the medium and the references to it";
        let element = format!("medium \"{}\"", medium.name);
        return Err(SceneError::at(
            &medium.place,
            &element,
            "participating media are not exported yet",
            help,
        )
        .into());
    }
    let mut scene = scene.clone(); // meshes and pictures are shared
    let differences = replace_gltf_materials(&mut scene);
    let notes = differences.iter().map(|what| format!("glTF's material as the nearest of Mitsuba's: {what}"));
    let mut writer = Writer {
        scene: &scene,
        xml: Xml::new(),
        folder,
        write,
        ids: HashSet::new(),
        meshes: HashMap::new(),
        images: HashMap::new(),
        scaled: Vec::new(),
        groups: Vec::new(),
        notes: notes.collect(),
    };
    writer.xml.open("scene", &[("version", "3.0.0")]);
    writer.integrator();
    for camera in &scene.cameras {
        writer.camera(camera)?;
    }
    writer.materials()?;
    for group in &scene.groups {
        writer.group(group)?;
    }
    for shape in &scene.shapes {
        writer.shape(shape)?;
    }
    for light in &scene.lights {
        writer.light(light)?;
    }
    writer.xml.close("scene");
    Ok(Exported { xml: writer.xml.finish(), notes: writer.notes })
}

/// The text so far, and the files that it refers to.
struct Writer<'a> {
    scene: &'a Scene,
    xml: Xml,
    folder: &'a str,
    write: &'a mut dyn FnMut(&str, &[u8]) -> io::Result<()>,
    /// Ids in use.
    ids: HashSet<String>,
    /// Names of the files of meshes that are written, by address and winding.
    meshes: HashMap<(*const Mesh, bool), String>,
    images: HashMap<*const Image, String>,
    /// Pictures made for the export, which keep their addresses.
    scaled: Vec<Arc<Image>>,
    /// Ids of the groups.
    groups: Vec<String>,
    notes: Vec<String>,
}

impl Writer<'_> {
    /// Says once what differs.
    fn note(&mut self, what: &str) {
        if !self.notes.iter().any(|note| note == what) {
            self.notes.push(what.into());
        }
    }

    fn integrator(&mut self) {
        let integrator = &self.scene.integrator;
        let aovs = integrator.aovs.iter().map(|aov| match aov {
            Aov::Albedo => "albedo:albedo",
            Aov::Depth => "depth:depth",
            Aov::Position => "position:position",
            Aov::ShadingNormal => "normal:sh_normal",
            Aov::ShapeIndex => "id:shape_index",
        });
        let aovs: Vec<&str> = aovs.collect();
        if !aovs.is_empty() {
            self.xml.open("integrator", &[("type", "aov")]);
            self.xml.value("string", "aovs", &aovs.join(","));
        }
        self.xml.open("integrator", &[("type", "path")]);
        let depth = integrator.max_depth.map_or_else(|| "-1".into(), |depth| depth.to_string());
        self.xml.value("integer", "max_depth", &depth);
        self.xml.value("integer", "rr_depth", &integrator.rr_depth.max(1).to_string());
        if integrator.hide_emitters {
            self.xml.value("boolean", "hide_emitters", "true");
        }
        self.xml.close("integrator");
        if !aovs.is_empty() {
            self.xml.close("integrator");
        }
    }

    /// `name`, or `name` with a number where it is taken.
    fn id(&mut self, name: &str) -> String {
        let mut id = name.to_string();
        for number in 2.. {
            if self.ids.insert(id.clone()) {
                break;
            }
            id = format!("{name} {number}");
        }
        id
    }

    /// Writes a file of the scene's and gives its name back.
    fn file(&mut self, name: &str, bytes: &[u8]) -> Result<String, ExportError> {
        let name = format!("{}/{name}", self.folder);
        (self.write)(&name, bytes).map_err(|source| ExportError::Write { name: name.clone(), source })?;
        Ok(name)
    }
}

#[cfg(test)]
mod tests;
