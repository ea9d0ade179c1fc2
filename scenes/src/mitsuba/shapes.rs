//! `<shape>`: surfaces in the world.

use std::sync::Arc;

use glam::{DMat4, DVec3};

use super::Reader;
use super::camera::is_invertible;
use super::document::ElementId;
use super::object::Object;
use super::survey::{SHAPES, Standing};
use crate::files::identity;
use crate::mesh::{LoadedMesh, MeshOptions, obj, ply};
use crate::{MediumId, Place, SceneError, Shape, ShapeKind, Warning};

impl Reader<'_> {
    pub(super) fn shape(&mut self, id: ElementId) -> Result<(), SceneError> {
        let object = Object::new(self.document, id);
        let kind = object.kind()?;
        if SHAPES.standing(kind, object.element)? == Standing::Later {
            self.warn(id, format!("{kind} is not read yet; the shape is left out"));
            return Ok(());
        }
        let mut world_from_object = object.transform("to_world")?;
        let flip_normals = object.boolean("flip_normals", false)?;
        let form = match kind {
            "obj" | "ply" => {
                let LoadedMesh { mesh, offset, .. } = self.mesh(&object, kind)?;
                world_from_object *= DMat4::from_translation(offset);
                if mesh.triangles.is_empty() {
                    self.warn(id, "the mesh has no faces; the shape is left out");
                    return Ok(());
                }
                ShapeKind::Mesh(mesh)
            }
            "sphere" => {
                object.without_effect(&["subdiv", "face_normals"]);
                let radius = object.float_where("radius", 1.0, "above 0", |r| r > 0.0)?;
                ShapeKind::Sphere { center: object.vector("center", DVec3::ZERO)?, radius }
            }
            "cylinder" => {
                let (p0, p1) = (object.vector("p0", DVec3::ZERO)?, object.vector("p1", DVec3::Z)?);
                if p0 == p1 {
                    return Err(object.error("p0 and p1 are the same point", "give the cylinder a length"));
                }
                let radius = object.float_where("radius", 1.0, "above 0", |r| r > 0.0)?;
                ShapeKind::Cylinder { p0, p1, radius }
            }
            "disk" => ShapeKind::Disk,
            "rectangle" => ShapeKind::Rectangle,
            _ => ShapeKind::Cube,
        };
        if matches!(form, ShapeKind::Disk | ShapeKind::Rectangle) {
            world_from_object = with_thickness(world_from_object);
        }
        if !matches!(form, ShapeKind::Mesh(_)) && !is_invertible(world_from_object) {
            self.warn(id, "to_world flattens the shape; it is left out");
            return Ok(());
        }

        let emission = match object.nested("emitter")?[..] {
            [] => None,
            [(emitter, _)] => self.emission(emitter)?,
            _ => return Err(object.error("more than one emitter inside", "give a shape one emitter")),
        };
        let material = match object.nested("bsdf")?[..] {
            [] => self.default_material(emission.is_some(), &object.place()),
            [(bsdf, _)] => self.material(bsdf)?,
            _ => {
                return Err(
                    object.error("more than one bsdf inside", "give a shape one bsdf, such as a blendbsdf")
                );
            }
        };
        let (interior, exterior) = self.media(&object)?;
        let name = self.name(&object, kind, self.scene.shapes.len());
        self.scene.shapes.push(Shape {
            name,
            kind: form,
            world_from_object,
            flip_normals,
            material,
            emission,
            interior,
            exterior,
            place: object.place(),
        });
        object.finish(&mut self.warnings);
        Ok(())
    }

    /// The media on both sides: `interior` and `exterior`.
    fn media(&mut self, object: &Object<'_>) -> Result<(Option<MediumId>, Option<MediumId>), SceneError> {
        let (mut interior, mut exterior) = (None, None);
        for (medium, element) in object.nested("medium")? {
            match element.key.as_str() {
                "interior" => interior = Some(self.medium(medium)?),
                "exterior" => exterior = Some(self.medium(medium)?),
                other => {
                    let problem = format!("a medium named \"{other}\"");
                    return Err(object.error(problem, "name it \"interior\" or \"exterior\""));
                }
            }
        }
        Ok((interior, exterior))
    }

    /// The mesh of a file, read once for all shapes that read it the same way.
    fn mesh(&mut self, object: &Object<'_>, kind: &str) -> Result<LoadedMesh, SceneError> {
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
        let key = (identity(&path), options);
        if let Some(known) = self.meshes.get(&key) {
            return Ok(known.clone());
        }
        let label = object.element.label();
        let bytes = self.bytes(&path, &object.element.place, &label)?;
        // by content where that tells: extensions are mixed up
        let is_ply = bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r");
        let loaded = if is_ply || kind == "ply" {
            ply::read(&bytes, &path, options)?
        } else {
            obj::read(&bytes, &path, options)?
        };
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
}

/// A flat shape's transform with a z axis across it where the file's scales z away, which changes nothing visible.
fn with_thickness(mut transform: DMat4) -> DMat4 {
    if !is_invertible(transform) {
        let (x, y) = (transform.x_axis.truncate(), transform.y_axis.truncate());
        if let Some(across) = x.cross(y).try_normalize() {
            transform.z_axis = (across * (x.length() * y.length()).sqrt()).extend(0.0);
        }
    }
    transform
}
