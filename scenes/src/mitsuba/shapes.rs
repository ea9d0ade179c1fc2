//! `<shape>`: surfaces in the world.

use glam::{DMat4, DVec3};

use super::Reader;
use super::camera::is_invertible;
use super::document::ElementId;
use super::object::Object;
use super::survey::SHAPES;
use crate::mesh::LoadedMesh;
use crate::{MediumId, SceneError, Shape, ShapeKind};

/// What a shape is read for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Owner {
    Scene,
    Group,
}

impl Reader<'_> {
    /// Reads a shape of the scene.
    pub(super) fn shape(&mut self, id: ElementId) -> Result<(), SceneError> {
        let mut shapes = std::mem::take(&mut self.scene.shapes);
        let result = self.shape_into(id, &mut shapes, Owner::Scene);
        self.scene.shapes = shapes;
        result
    }

    /// Reads a shape into a list; a `merge` puts in its parts.
    pub(super) fn shape_into(
        &mut self,
        id: ElementId,
        shapes: &mut Vec<Shape>,
        owner: Owner,
    ) -> Result<(), SceneError> {
        let object = Object::new(self.document, id);
        let kind = object.kind()?;
        SHAPES.standing(kind, object.element)?; // none is left for later
        match (kind, owner) {
            ("shapegroup" | "instance", Owner::Group) => {
                let problem = format!("a shapegroup that holds a shape of the type \"{kind}\"");
                return Err(object.error(problem, "put the shapes themselves into the shapegroup"));
            }
            ("shapegroup", Owner::Scene) => return self.group(id).map(|_| ()),
            ("instance", Owner::Scene) => return self.instance(object, shapes),
            ("merge", _) => return self.merge(object, shapes, owner),
            _ => {}
        }
        let mut world_from_object = object.transform("to_world")?;
        let flip_normals = object.boolean("flip_normals", false)?;
        let form = match kind {
            "obj" | "ply" | "serialized" => {
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

        if owner == Owner::Group && !object.nested("emitter")?.is_empty() {
            let help = "take the shape out of the shapegroup, or its emitter away";
            return Err(object.error("a shape that emits, inside a shapegroup", help));
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
        let name = self.name(&object, kind, shapes.len());
        shapes.push(Shape {
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
