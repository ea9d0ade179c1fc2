//! Finds the lights of a scene, and answers for the surfaces that rays hit.

use glam::{DVec3, Vec3};
use limpid_scenes::{Scene, ShapeKind};

use super::{LightAnalytic, LightForm, LightHit, LightId, LightRectangle, LightShape, LightTriangle, Lights};
use crate::color::Rgb;
use crate::geometry::{Geometry, Surface};
use crate::texture::Textures;

impl Lights {
    /// The lights of a scene whose shapes are `geometry`; `origin` is that of render space, in world space; `scene_radius`
    /// is that of a sphere around the scene.
    pub fn new(
        scene: &Scene,
        geometry: &Geometry,
        textures: &Textures,
        origin: DVec3,
        scene_radius: f64,
    ) -> Self {
        let shapes = scene.shapes.iter().enumerate().filter_map(|(index, shape)| {
            let emission = shape.emission.as_ref()?.radiance;
            let form = form(&shape.kind, shape.flip_normals, geometry, index);
            Some(LightShape { shape: index as u32, form, emission })
        });
        Self::from_shapes(shapes.collect(), &scene.lights, textures, origin, scene_radius)
    }

    /// See [`radiance_at`](Self::radiance_at).
    #[inline]
    pub fn radiance(&self, light: LightId, surface: &Surface, wo: Vec3, textures: &Textures) -> Rgb {
        self.radiance_at(light, &surface.into(), wo, textures)
    }

    /// See [`hit_at`](Self::hit_at).
    #[inline]
    pub fn hit(
        &self,
        light: LightId,
        from: Vec3,
        surface: &Surface,
        wi: Vec3,
        textures: &Textures,
    ) -> (Rgb, f32) {
        self.hit_at(light, from, &surface.into(), wi, textures)
    }
}

impl From<&Surface> for LightHit {
    #[inline]
    fn from(surface: &Surface) -> Self {
        Self { p: surface.p, ng: surface.ng, uv: surface.into(), prim: surface.prim }
    }
}

fn form(kind: &ShapeKind, turned: bool, geometry: &Geometry, index: usize) -> LightForm {
    let shape = &geometry.shapes[index];
    let analytic = || LightAnalytic {
        render_from_unit: geometry.analytics[shape.first_prim as usize - geometry.triangles.len()]
            .frame
            .render_from_object,
        turned,
        prim: shape.first_prim,
    };
    match kind {
        ShapeKind::Sphere { .. } => LightForm::Sphere(analytic()),
        ShapeKind::Cylinder { .. } => LightForm::Cylinder(analytic()),
        ShapeKind::Disk => LightForm::Disk(analytic()),
        ShapeKind::Rectangle => {
            // Its triangles are (0, 0), (1, 0), (1, 1) and (1, 1), (0, 1), (0, 0) in uv.
            let prims = [shape.first_prim, shape.first_prim + 1];
            let [corner, u_end, _] = geometry.corners(prims[0]);
            let [_, v_end, _] = geometry.corners(prims[1]);
            LightForm::Rectangle(LightRectangle {
                corner,
                edge_u: u_end - corner,
                edge_v: v_end - corner,
                turned: geometry.is_turned(prims[0]),
                prims,
            })
        }
        // An instance emits nothing: it has no primitives.
        ShapeKind::Mesh(_) | ShapeKind::Cube | ShapeKind::Instance { .. } => {
            let prims = shape.first_prim..shape.first_prim + shape.prims;
            LightForm::Triangles(prims.map(|prim| triangle(geometry, prim)).collect())
        }
    }
}

fn triangle(geometry: &Geometry, prim: u32) -> LightTriangle {
    let (mut corners, mut uvs) = (geometry.corners(prim), geometry.corner_uvs(prim));
    let turned = geometry.is_turned(prim);
    if turned {
        corners.swap(1, 2);
        uvs.swap(1, 2);
    }
    LightTriangle { corners, uvs, prim, turned }
}
