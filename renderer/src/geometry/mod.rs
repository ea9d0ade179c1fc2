//! Surfaces in render space: what a hit means.
//!
//! Render space is world space with its origin moved to the camera *before* rounding to `f32`.

mod groups;
mod primitives;
mod surface;

use glam::{DMat3, DMat4, DVec3, Vec2, Vec3};
use limpid_scenes::{MaterialId, Scene, Shape as SceneShape, ShapeKind};

use crate::accel::{Analytic, AnalyticKind, Frame64};
pub use groups::{Group, Placed, shape_of};
use primitives::{cube, cylinder, rectangle};
pub use surface::{Frame, Surface};

/// No offset: the mesh lacks that attribute.
const ABSENT: u32 = u32::MAX;

/// All surfaces of a scene.
#[derive(Default)]
pub struct Geometry {
    /// In render space, all meshes one after the other.
    pub positions: Vec<Vec3>,
    /// Unit, in render space, of the meshes that have them.
    normals: Vec<Vec3>,
    /// Of the meshes that have them.
    uvs: Vec<Vec2>,
    /// Indices into `positions`.
    pub triangles: Vec<[u32; 3]>,
    /// The shape of each triangle.
    triangle_shapes: Vec<u32>,
    /// Spheres, cylinders and disks; their primitive ids follow those of the triangles.
    pub analytics: Vec<Analytic>,
    /// The shape of each.
    analytic_shapes: Vec<u32>,
    /// As in the scene; those of its groups follow, group by group, in the groups' own spaces.
    pub shapes: Vec<Shape>,
    /// As in the scene.
    pub groups: Vec<Group>,
    /// In the order of the scene's shapes.
    pub instances: Vec<Placed>,
}

/// What the primitives of one shape have in common.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    /// What it is made of.
    pub material: MaterialId,
    /// Its first primitive; they are consecutive.
    pub first_prim: u32,
    /// How many.
    pub prims: u32,
    /// −1 where the side of the normal is not the one that the winding says (a mirrored or flipped shape).
    orientation: f32,
    first_vertex: u32,
    first_normal: u32,
    first_uv: u32,
}

impl Geometry {
    /// Moves everything into the space whose origin is `origin`.
    pub fn new(scene: &Scene, origin: DVec3) -> Self {
        let mut geometry = Self::default();
        let in_groups = scene.groups.iter().flat_map(|group| &group.shapes);
        let triangles: usize = scene.shapes.iter().chain(in_groups).map(triangle_count).sum();
        geometry.triangles.reserve(triangles);
        geometry.triangle_shapes.reserve(triangles);
        for shape in &scene.shapes {
            geometry.add(shape, DMat4::from_translation(-origin) * shape.world_from_object);
        }
        geometry.add_groups(scene);
        // Analytic primitives are numbered after all triangles.
        for shape in &mut geometry.shapes {
            if shape.first_vertex == ABSENT {
                shape.first_prim += geometry.triangles.len() as u32;
            }
        }
        geometry
    }

    /// Adds a shape under a map into the space that it is to be in.
    fn add(&mut self, shape: &SceneShape, space_from_object: DMat4) {
        match &shape.kind {
            ShapeKind::Mesh(mesh) => self.add_mesh(shape, mesh, space_from_object),
            ShapeKind::Rectangle => self.add_mesh(shape, &rectangle(), space_from_object),
            ShapeKind::Cube => self.add_mesh(shape, &cube(), space_from_object),
            ShapeKind::Sphere { center, radius } => {
                let ball = DMat4::from_translation(*center) * DMat4::from_scale(DVec3::splat(*radius));
                self.add_analytic(shape, AnalyticKind::Sphere, space_from_object * ball);
            }
            ShapeKind::Cylinder { p0, p1, radius } => {
                let unit = space_from_object * cylinder(*p0, *p1, *radius);
                self.add_analytic(shape, AnalyticKind::Cylinder, unit);
            }
            ShapeKind::Disk => self.add_analytic(shape, AnalyticKind::Disk, space_from_object),
            ShapeKind::Instance { group } => self.add_instance(shape, group.0, space_from_object),
        }
    }

    fn add_mesh(&mut self, shape: &SceneShape, mesh: &limpid_scenes::Mesh, render_from_object: DMat4) {
        let linear = DMat3::from_mat4(render_from_object);
        let mirrored = linear.determinant() < 0.0;
        let first_vertex = self.positions.len() as u32;
        self.positions.extend(
            mesh.positions
                .iter()
                .map(|&p| render_from_object.transform_point3(Vec3::from(p).as_dvec3()).as_vec3()),
        );
        let first_normal = if mesh.normals.is_empty() { ABSENT } else { self.normals.len() as u32 };
        let flip = if shape.flip_normals { -1.0 } else { 1.0 };
        let cofactor = normal_matrix(linear) * flip;
        self.normals.extend(
            mesh.normals.iter().map(|&n| (cofactor * Vec3::from(n).as_dvec3()).normalize_or_zero().as_vec3()),
        );
        let first_uv = if mesh.uvs.is_empty() { ABSENT } else { self.uvs.len() as u32 };
        self.uvs.extend(mesh.uvs.iter().map(|&uv| Vec2::from(uv)));
        self.shapes.push(Shape {
            material: shape.material,
            first_prim: self.triangles.len() as u32,
            prims: mesh.triangles.len() as u32,
            orientation: if mirrored != shape.flip_normals { -1.0 } else { 1.0 },
            first_vertex,
            first_normal,
            first_uv,
        });
        let index = self.shapes.len() as u32 - 1;
        self.triangles.extend(mesh.triangles.iter().map(|t| t.map(|i| i + first_vertex)));
        self.triangle_shapes.resize(self.triangles.len(), index);
    }

    fn add_analytic(&mut self, shape: &SceneShape, kind: AnalyticKind, render_from_object: DMat4) {
        let render_from_object = glam::DAffine3::from_mat4(render_from_object);
        self.shapes.push(Shape {
            material: shape.material,
            first_prim: self.analytics.len() as u32,
            prims: 1,
            orientation: if shape.flip_normals { -1.0 } else { 1.0 },
            first_vertex: ABSENT,
            first_normal: ABSENT,
            first_uv: ABSENT,
        });
        self.analytic_shapes.push(self.shapes.len() as u32 - 1);
        let frame = Frame64 { render_from_object, object_from_render: render_from_object.inverse() };
        self.analytics.push(Analytic { kind, frame });
    }

    /// The first of `shapes`, if any, with a coordinate that leaves the range of `f32` in its space.
    pub fn out_of_range(&self) -> Option<usize> {
        let beyond = |placed: &Placed| !self.image(placed).is_finite();
        let placed = self.instances.iter().find(|placed| beyond(placed)).map(|placed| placed.shape as usize);
        let own = self.shapes.iter().position(|shape| {
            let prims = shape.first_prim..shape.first_prim + shape.prims;
            let beyond =
                |prim: u32| match self.analytics.get((prim as usize).wrapping_sub(self.triangles.len())) {
                    Some(analytic) => !analytic.bounds().is_finite(),
                    None => self.corners(prim).iter().any(|p| !p.is_finite()),
                };
            prims.into_iter().any(beyond)
        });
        own.or(placed)
    }

    /// The shape that a primitive belongs to.
    #[inline]
    pub fn shape_of(&self, prim: u32) -> u32 {
        match self.triangle_shapes.get(prim as usize) {
            Some(&shape) => shape,
            None => self.analytic_shapes[prim as usize - self.triangles.len()],
        }
    }

    /// The corners of a triangle.
    #[inline]
    pub fn corners(&self, prim: u32) -> [Vec3; 3] {
        self.triangles[prim as usize].map(|i| self.positions[i as usize])
    }

    /// Texture coordinates of a triangle's corners; its barycentric ones where the mesh has none.
    #[inline]
    pub fn corner_uvs(&self, prim: u32) -> [Vec2; 3] {
        let shape = &self.shapes[self.triangle_shapes[prim as usize] as usize];
        if shape.first_uv == ABSENT {
            return [Vec2::ZERO, Vec2::X, Vec2::Y];
        }
        self.triangles[prim as usize].map(|i| self.uvs[(i - shape.first_vertex + shape.first_uv) as usize])
    }

    /// Vertex normals of a triangle's corners.
    #[inline]
    fn corner_normals(&self, prim: u32, shape: &Shape) -> Option<[Vec3; 3]> {
        (shape.first_normal != ABSENT).then(|| {
            self.triangles[prim as usize]
                .map(|i| self.normals[(i - shape.first_vertex + shape.first_normal) as usize])
        })
    }

    /// Whether the side of a triangle's normal is not the one from which it runs counter-clockwise. Vertex
    /// normals decide where there are any, since files exist whose winding is the wrong way round.
    #[inline]
    pub fn is_turned(&self, prim: u32) -> bool {
        let shape = &self.shapes[self.triangle_shapes[prim as usize] as usize];
        let [p, q, r] = self.corners(prim).map(Vec3::as_dvec3);
        turned((q - p).cross(r - p), self.corner_normals(prim, shape), shape)
    }
}

/// See [`Geometry::is_turned`]; `cross` points to the side from which the triangle runs counter-clockwise.
#[inline]
fn turned(cross: DVec3, normals: Option<[Vec3; 3]>, shape: &Shape) -> bool {
    match normals.map(|[a, b, c]| cross.dot((a + b + c).as_dvec3())) {
        Some(side) if side != 0.0 => side < 0.0,
        _ => shape.orientation < 0.0,
    }
}

/// The triangles that a shape becomes.
pub fn triangle_count(shape: &SceneShape) -> usize {
    match &shape.kind {
        ShapeKind::Mesh(mesh) => mesh.triangles.len(),
        ShapeKind::Rectangle => 2,
        ShapeKind::Cube => 12,
        ShapeKind::Sphere { .. }
        | ShapeKind::Cylinder { .. }
        | ShapeKind::Disk
        | ShapeKind::Instance { .. } => 0,
    }
}

/// The matrix that normals transform by: cofactors, so that a singular one still turns most normals, with the
/// determinant's sign, so that "outwards" stays outwards under a mirror.
fn normal_matrix(m: DMat3) -> DMat3 {
    let cofactor =
        DMat3::from_cols(m.y_axis.cross(m.z_axis), m.z_axis.cross(m.x_axis), m.x_axis.cross(m.y_axis));
    if m.determinant() < 0.0 { cofactor * -1.0 } else { cofactor }
}

#[cfg(test)]
mod tests;
