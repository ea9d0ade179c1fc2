//! Mesh files that shapes name.

use std::path::Path;
use std::sync::Arc;

use super::Reader;
use super::object::Object;
use crate::files::identity;
use crate::mesh::{LoadedMesh, MeshOptions, obj, ply, serialized};
use crate::{Place, SceneError, Warning};

impl Reader<'_> {
    /// The mesh of a file, read once for all shapes that read it the same way.
    pub(super) fn mesh(&mut self, object: &Object<'_>, kind: &str) -> Result<LoadedMesh, SceneError> {
        let path = self.file(object)?;
        let options = MeshOptions {
            flip_tex_coords: object.boolean("flip_tex_coords", kind == "obj")?,
            face_normals: object.boolean("face_normals", false)?,
        };
        if object.maybe_float("max_smooth_angle")?.is_some() {
            self.warn(
                object.id,
                "max_smooth_angle of 0.x is not honoured: the file's normals count, or smooth ones",
            );
        }
        object.without_effect(&["vertex_normals", "collapse"]);
        let number = match kind {
            "serialized" => object.integer("shape_index", [0, u32::MAX.into()])?.unwrap_or(0) as u32,
            _ => 0,
        };
        let key = (identity(&path), options, number);
        if let Some(known) = self.meshes.get(&key) {
            return Ok(known.clone());
        }
        let label = object.element.label();
        let mut loaded = if kind == "serialized" {
            let bytes = self.mesh_file(&path, &object.element.place, &label)?;
            serialized::read(&bytes, &path, options, number)?
        } else {
            let bytes = self.bytes(&path, &object.element.place, &label)?;
            // by content where that tells: extensions are mixed up
            let is_ply = bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r");
            if is_ply || kind == "ply" {
                ply::read(&bytes, &path, options)?
            } else {
                obj::read(&bytes, &path, options)?
            }
        };
        if let Some(mesh) = Arc::get_mut(&mut loaded.mesh) {
            // others would only take memory
            mesh.attributes.retain(|attribute| self.looked_up.contains(attribute.name.as_str()));
        }
        let file = Arc::new(path);
        for note in &loaded.notes {
            let place = Place { file: Arc::clone(&file), line: note.line, column: note.line.min(1) };
            self.warnings.push((
                object.id,
                Warning {
                    place,
                    element: label.clone(),
                    message: note.message.clone(),
                    unused_parameter: false,
                },
            ));
        }
        self.meshes.insert(key, loaded.clone());
        Ok(loaded)
    }

    /// A file of several meshes, read once.
    fn mesh_file(&mut self, path: &Path, place: &Place, label: &str) -> Result<Arc<[u8]>, SceneError> {
        let key = identity(path);
        if let Some(known) = self.mesh_files.get(&key) {
            return Ok(Arc::clone(known));
        }
        let bytes: Arc<[u8]> = self.bytes(path, place, label)?.into();
        self.mesh_files.insert(key, Arc::clone(&bytes));
        Ok(bytes)
    }
}
