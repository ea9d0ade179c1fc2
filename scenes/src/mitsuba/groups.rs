//! `<shape>`s that hold others: `shapegroup`, `instance` and `merge`.

use super::Reader;
use super::camera::is_invertible;
use super::document::ElementId;
use super::object::Object;
use super::shapes::Owner;
use crate::{Group, GroupId, SceneError, Shape, ShapeKind};

impl Reader<'_> {
    /// A group, read once however many instances show it.
    pub(super) fn group(&mut self, id: ElementId) -> Result<GroupId, SceneError> {
        if let Some(&known) = self.groups.get(&id) {
            return Ok(known);
        }
        let object = Object::new(self.document, id);
        let mut shapes = Vec::new();
        self.nested(id, |reader| {
            for (part, _) in object.nested("shape")? {
                reader.shape_into(part, &mut shapes, Owner::Group)?;
            }
            Ok(())
        })?;
        let name = self.name(&object, "shapegroup", self.scene.groups.len());
        let group = GroupId(self.scene.groups.len() as u32);
        self.scene.groups.push(Group { name, shapes, place: object.place() });
        self.groups.insert(id, group);
        object.finish(&mut self.warnings);
        Ok(group)
    }

    pub(super) fn instance(&mut self, object: Object<'_>, shapes: &mut Vec<Shape>) -> Result<(), SceneError> {
        let of = "write <ref id=\"…\"/> with the id of a shape of the type \"shapegroup\"";
        let group = match object.nested("shape")?[..] {
            [(group, _)] => group,
            [] => return Err(object.error("an instance of nothing", of)),
            _ => return Err(object.error("an instance of more than one shape", of)),
        };
        let target = Object::new(self.document, group);
        if target.kind()? != "shapegroup" {
            let problem = format!("an instance of {}, which is no shapegroup", target.element.label());
            return Err(object.error(problem, of));
        }
        let world_from_object = object.transform("to_world")?;
        let group = self.group(group)?;
        // An instance has no material of its own: it carries the first that it shows.
        let first = self.scene.groups[group.0 as usize].shapes.first().map(|shape| shape.material);
        if !is_invertible(world_from_object) {
            self.warn(object.id, "to_world flattens the instance; it is left out");
        } else if let Some(material) = first {
            let name = self.name(&object, "instance", shapes.len());
            shapes.push(Shape {
                name,
                kind: ShapeKind::Instance { group },
                world_from_object,
                flip_normals: false,
                material,
                emission: None,
                interior: None,
                exterior: None,
                place: object.place(),
            });
        } else {
            self.warn(object.id, "the shapegroup is empty; the instance is left out");
        }
        object.finish(&mut self.warnings);
        Ok(())
    }

    /// The parts of a `merge` stay apart, each with its own id: Mitsuba joins them for the sake of its speed alone.
    pub(super) fn merge(
        &mut self,
        object: Object<'_>,
        shapes: &mut Vec<Shape>,
        owner: Owner,
    ) -> Result<(), SceneError> {
        let parts = object.nested("shape")?;
        self.nested(object.id, |reader| {
            parts.into_iter().try_for_each(|(part, _)| reader.shape_into(part, shapes, owner))
        })?;
        object.finish(&mut self.warnings);
        Ok(())
    }
}
