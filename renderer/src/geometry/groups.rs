//! Groups of shapes in spaces of their own, and the instances that show them.

use std::ops::Range;

use glam::{DAffine3, DMat4, DVec3, Vec3};
use limpid_scenes::{Scene, Shape as SceneShape, ShapeKind};

use super::surface::{ROUND, SLACK, Surface};
use super::{ABSENT, Geometry, Shape, normal_matrix};
use crate::accel::{Bounds, Frame64, Hit, Ray, image};

/// The shapes of a group. Its space is that of the scene's file, with its origin near the group.
pub struct Group {
    /// Ids of its triangles.
    pub triangles: Range<u32>,
    /// Indices into [`Geometry::analytics`].
    pub analytics: Range<u32>,
    bounds: Bounds,
}

/// An instance in render space.
pub struct Placed {
    /// What it shows.
    pub group: u32,
    /// Index of the instance among the scene's shapes.
    pub shape: u32,
    /// Triangles of the scene's shapes before it.
    pub after: u32,
    /// The group's space in render space.
    pub frame: Frame64,
    /// How much the map there and back enlarges a rounding.
    condition: f32,
}

/// Beyond this condition a map has few digits, whatever is done.
const WORST: f64 = (1u64 << 40) as f64;

impl Geometry {
    /// Takes note of an instance of a group that will be added.
    pub(super) fn add_instance(&mut self, shape: &SceneShape, group: u32, render_from_object: DMat4) {
        let index = self.shapes.len() as u32;
        self.shapes.push(Shape {
            material: shape.material,
            first_prim: self.triangles.len() as u32,
            prims: 0,
            orientation: 1.0,
            first_vertex: 0,
            first_normal: ABSENT,
            first_uv: ABSENT,
        });
        let map = DAffine3::from_mat4(render_from_object);
        let frame = Frame64 { render_from_object: map, object_from_render: map };
        let after = self.triangles.len() as u32;
        self.instances.push(Placed { group, shape: index, after, frame, condition: 1.0 });
    }

    /// Adds the groups of a scene, behind all its other shapes, and moves the instances to where they are.
    pub(super) fn add_groups(&mut self, scene: &Scene) {
        let mut centers = Vec::with_capacity(scene.groups.len());
        for group in &scene.groups {
            let center = center(&group.shapes);
            let (triangles, analytics) = (self.triangles.len() as u32, self.analytics.len() as u32);
            for shape in &group.shapes {
                self.add(shape, DMat4::from_translation(-center) * shape.world_from_object);
            }
            let triangles = triangles..self.triangles.len() as u32;
            let analytics = analytics..self.analytics.len() as u32;
            let mut bounds = Bounds::EMPTY;
            for prim in triangles.clone() {
                bounds = bounds.union(&Bounds::of_points(&self.corners(prim)));
            }
            for analytic in &self.analytics[analytics.start as usize..] {
                bounds = bounds.union(&analytic.bounds());
            }
            self.groups.push(Group { triangles, analytics, bounds });
            centers.push(center);
        }
        for placed in &mut self.instances {
            let center = centers[placed.group as usize];
            let map = placed.frame.render_from_object * DAffine3::from_translation(center);
            let inverse = map.inverse();
            placed.frame = Frame64 { render_from_object: map, object_from_render: inverse };
            let size = |m: DAffine3| m.matrix3.to_cols_array().iter().fold(0.0f64, |m, x| m.max(x.abs()));
            placed.condition = (9.0 * size(map) * size(inverse)).min(WORST) as f32;
        }
    }

    /// A box around an instance; finite where it shows nothing.
    pub(super) fn image(&self, placed: &Placed) -> Bounds {
        let group = &self.groups[placed.group as usize];
        if group.triangles.is_empty() && group.analytics.is_empty() {
            return Bounds { min: Vec3::ZERO, max: Vec3::ZERO };
        }
        image(&group.bounds, &placed.frame.render_from_object)
    }

    /// The surface that `ray` hit through an instance: found in the group's space without rounding, and moved.
    pub(super) fn instance_surface(&self, ray: &Ray, hit: &Hit) -> Surface {
        let placed = &self.instances[hit.instance as usize];
        let Frame64 { render_from_object: map, object_from_render: inverse } = placed.frame;
        let o = inverse.transform_point3(ray.o.as_dvec3());
        let d = inverse.transform_vector3(ray.d.as_dvec3());
        let (inner, q) = self.local_surface(o, d, hit);
        let p = map.transform_point3(q).as_vec3();
        let cofactor = normal_matrix(map.matrix3);
        let turn = |n: Vec3| (cofactor * n.as_dvec3()).normalize_or(n.as_dvec3()).as_vec3();
        let (ng, ns) = (turn(inner.ng), turn(inner.ns));
        let largest = (map.translation.abs() + map.matrix3.abs() * q.abs()).max_element() as f32;
        let largest = largest.max(ray.o.abs().max_element());
        let bound = ROUND * ng.abs().dot(p.abs()) + SLACK * placed.condition * largest;
        Surface { p, ng, ns, bound, object: placed.shape, instance: hit.instance, ..inner }
    }
}

/// Where the origin of a group's space lies best: where the file has it, unless the group is far from there.
fn center(shapes: &[SceneShape]) -> DVec3 {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for shape in shapes {
        let (min, max) = match &shape.kind {
            ShapeKind::Mesh(mesh) => {
                let points = mesh.positions.iter().map(|p| Vec3::from(*p).as_dvec3());
                points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(a, b), p| (a.min(p), b.max(p)))
            }
            ShapeKind::Sphere { center, radius } => (*center - *radius, *center + *radius),
            ShapeKind::Cylinder { p0, p1, radius } => (p0.min(*p1) - *radius, p0.max(*p1) + *radius),
            ShapeKind::Disk | ShapeKind::Rectangle | ShapeKind::Cube => (-DVec3::ONE, DVec3::ONE),
            ShapeKind::Instance { .. } => continue, // groups hold none
        };
        for i in 0..8 {
            let pick = |axis: usize| if i >> axis & 1 == 0 { min[axis] } else { max[axis] };
            let p = shape.world_from_object.transform_point3(DVec3::new(pick(0), pick(1), pick(2)));
            (low, high) = (low.min(p), high.max(p));
        }
    }
    let far = low.abs().max(high.abs()).max_element();
    // As for meshes: below a factor of 8 it would save less than three bits.
    let is_far = far.is_finite() && far > 8.0 * (high - low).max_element();
    if is_far { 0.5 * low + 0.5 * high } else { DVec3::ZERO }
}

/// The shape of a scene that has this index in [`Geometry::shapes`].
pub fn shape_of(scene: &Scene, index: usize) -> Option<&SceneShape> {
    scene.shapes.iter().chain(scene.groups.iter().flat_map(|group| &group.shapes)).nth(index)
}
