//! `<shape>`s.

use std::sync::Arc;

use glam::{DMat3, DMat4, DVec3};

use super::{ExportError, Writer};
use crate::{Group, Mesh, Shape, ShapeKind};

/// Cells around and from pole to pole of an ellipsoid that Mitsuba has no shape for: its silhouette is off by less
/// than 2e-5 of its radius.
const ELLIPSOID: [u32; 2] = [512, 256];

impl Writer<'_> {
    pub(super) fn shape(&mut self, shape: &Shape) -> Result<(), ExportError> {
        let to_world = shape.world_from_object;
        match &shape.kind {
            ShapeKind::Mesh(mesh) => self.mesh_shape(shape, mesh, to_world),
            ShapeKind::Rectangle => self.plain(shape, "rectangle", to_world, |_| {}),
            ShapeKind::Cube => self.plain(shape, "cube", to_world, |_| {}),
            ShapeKind::Disk => self.plain(shape, "disk", to_world, |_| {}),
            ShapeKind::Cylinder { p0, p1, radius } => {
                if !keeps_round(to_world, *p1 - *p0) {
                    self.notes.push(format!(
                        "shape \"{}\": a cylinder that is not round, which Mitsuba distorts",
                        shape.name
                    ));
                }
                self.plain(shape, "cylinder", to_world, |xml| {
                    xml.point("p0", *p0);
                    xml.point("p1", *p1);
                    xml.float("radius", *radius);
                })
            }
            ShapeKind::Instance { group } => {
                let id = self.id(&shape.name);
                self.xml.open("shape", &[("type", "instance"), ("id", &id)]);
                let group = self.groups[group.0 as usize].clone();
                self.xml.leaf("ref", &[("id", &group)]);
                self.xml.transform("to_world", to_world);
                self.xml.close("shape");
                Ok(())
            }
            ShapeKind::Sphere { center, radius } => match scale_of(to_world) {
                Some(scale) => {
                    let rotation = DMat3::from_mat4(to_world) * (1.0 / scale);
                    let center = to_world.transform_point3(*center);
                    let turn = DMat4::from_mat3(rotation);
                    let local = turn.inverse().transform_point3(center);
                    let radius = radius * scale;
                    self.plain(shape, "sphere", turn, |xml| {
                        xml.point("center", local);
                        xml.float("radius", radius);
                    })
                }
                None => {
                    self.notes.push(format!(
                        "shape \"{}\": an ellipsoid, which Mitsuba lacks, is written as {} triangles",
                        shape.name,
                        2 * ELLIPSOID[0] * (ELLIPSOID[1] - 1)
                    ));
                    let ball = DMat4::from_translation(*center) * DMat4::from_scale(DVec3::splat(*radius));
                    self.mesh_shape(shape, &Arc::new(unit_sphere()), to_world * ball)
                }
            },
        }
    }

    /// A group with its shapes, for the instances that follow.
    pub(super) fn group(&mut self, group: &Group) -> Result<(), ExportError> {
        let id = self.id(&group.name);
        self.xml.open("shape", &[("type", "shapegroup"), ("id", &id)]);
        for shape in &group.shapes {
            self.shape(shape)?;
        }
        self.xml.close("shape");
        self.groups.push(id);
        Ok(())
    }

    fn plain(
        &mut self,
        shape: &Shape,
        kind: &str,
        to_world: DMat4,
        parameters: impl FnOnce(&mut super::Xml),
    ) -> Result<(), ExportError> {
        let id = self.id(&shape.name);
        self.xml.open("shape", &[("type", kind), ("id", &id)]);
        parameters(&mut self.xml);
        self.rest(shape, to_world)
    }

    fn mesh_shape(&mut self, shape: &Shape, mesh: &Arc<Mesh>, to_world: DMat4) -> Result<(), ExportError> {
        // A mirrored mesh of flat faces shows Mitsuba its other side: the winding alone says which is which.
        let turned = mesh.normals.is_empty() && to_world.determinant() < 0.0;
        let file = self.mesh(mesh, turned)?;
        let id = self.id(&shape.name);
        self.xml.open("shape", &[("type", "ply"), ("id", &id)]);
        self.xml.value("string", "filename", &file);
        if mesh.normals.is_empty() {
            self.xml.value("boolean", "face_normals", "true");
        }
        self.rest(shape, to_world)
    }

    /// What all shapes have in common, and the end of the element.
    fn rest(&mut self, shape: &Shape, to_world: DMat4) -> Result<(), ExportError> {
        if shape.flip_normals {
            self.xml.value("boolean", "flip_normals", "true");
        }
        self.xml.transform("to_world", to_world);
        self.material_ref(shape.material);
        if let Some(emission) = &shape.emission {
            match &emission.name {
                Some(name) => {
                    let id = self.id(name);
                    self.xml.open("emitter", &[("type", "area"), ("id", &id)]);
                }
                None => self.xml.open("emitter", &[("type", "area")]),
            }
            self.color("radiance", emission.radiance)?;
            self.xml.close("emitter");
        }
        self.xml.close("shape");
        Ok(())
    }
}

/// The scale of a rotation with one scale; `None` where there is more than that (also a mirror).
fn scale_of(m: DMat4) -> Option<f64> {
    let m = DMat3::from_mat4(m);
    let scale = m.determinant().cbrt();
    let rotation = m * (1.0 / scale);
    let off = rotation * rotation.transpose() - DMat3::IDENTITY;
    let largest = off.to_cols_array().iter().fold(0.0f64, |l, x| l.max(x.abs()));
    (scale > 0.0 && largest < 1e-6).then_some(scale)
}

/// Whether a map leaves a cylinder around `axis` round and its ends square.
fn keeps_round(m: DMat4, axis: DVec3) -> bool {
    let n = axis.normalize_or(DVec3::Z);
    let (x, y) = n.any_orthonormal_pair();
    let [x, y, n] = [x, y, n].map(|v| m.transform_vector3(v));
    let off = |a: DVec3, b: DVec3| (a.dot(b) / (a.length() * b.length())).abs();
    off(x, y).max(off(x, n)).max(off(y, n)).max((x.length() / y.length() - 1.0).abs()) < 1e-6
}

/// The unit sphere in triangles, with the normals and texture coordinates of the analytic one.
fn unit_sphere() -> Mesh {
    let [around, down] = ELLIPSOID;
    let mut mesh = Mesh::default();
    for j in 0..=down {
        for i in 0..=around {
            let (u, v) = (f64::from(i) / f64::from(around), f64::from(j) / f64::from(down));
            let (phi, theta) = (u * std::f64::consts::TAU, v * std::f64::consts::PI);
            let p = DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos());
            mesh.positions.push(p.as_vec3().to_array());
            mesh.normals.push(p.as_vec3().to_array());
            mesh.uvs.push([u as f32, v as f32]);
        }
    }
    let at = |i: u32, j: u32| j * (around + 1) + i;
    for j in 0..down {
        for i in 0..around {
            let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
            if j + 1 < down {
                mesh.triangles.push([a, b, c]);
            }
            if j > 0 {
                mesh.triangles.push([a, c, d]);
            }
        }
    }
    mesh
}
