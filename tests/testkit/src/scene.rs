//! Scenes for tests, as plain data.

use std::sync::Arc;

use glam::{DMat4, DVec3};
use limpid_scenes::*;

/// A pinhole at `origin` that looks at `target`, with a field of view of 40° and a box filter.
pub fn camera(origin: DVec3, target: DVec3, width: u32, height: u32) -> Camera {
    let z = (target - origin).normalize();
    let x = z.any_orthonormal_vector();
    Camera {
        name: "camera".into(),
        world_from_camera: DMat4::from_cols(
            x.extend(0.0),
            z.cross(x).extend(0.0),
            z.extend(0.0),
            origin.extend(1.0),
        ),
        projection: Projection::Perspective {
            fov_deg: 40.0,
            fov_axis: FovAxis::X,
            principal_point_offset: [0.0; 2],
        },
        lens: None,
        near_clip: None,
        far_clip: None,
        film: Film { width, height, crop: None, filter: PixelFilter::Box, filter_steps: None, alpha: false },
        sampler: Sampler { kind: "independent".into(), sample_count: 16 },
        place: Place::default(),
    }
}

/// Makes it a pinhole with this field of view along x.
pub fn set_fov(camera: &mut Camera, fov_deg: f64) {
    camera.projection =
        Projection::Perspective { fov_deg, fov_axis: FovAxis::X, principal_point_offset: [0.0; 2] };
}

/// A scene with materials only.
pub fn scene(camera: Camera, materials: Vec<MaterialKind>) -> Scene {
    let name = |i: usize| format!("m{i}");
    Scene {
        cameras: vec![camera],
        materials: materials
            .into_iter()
            .enumerate()
            .map(|(i, kind)| Material { name: name(i), kind, place: Place::default() })
            .collect(),
        ..Scene::default()
    }
}

/// Adds a shape and gives it back, to be changed.
pub fn add(scene: &mut Scene, kind: ShapeKind, world_from_object: DMat4, material: u32) -> &mut Shape {
    scene.shapes.push(Shape {
        name: format!("shape {}", scene.shapes.len()),
        kind,
        world_from_object,
        flip_normals: false,
        material: MaterialId(material),
        emission: None,
        interior: None,
        exterior: None,
        place: Place::default(),
    });
    scene.shapes.last_mut().expect("just pushed")
}

/// Emission of the same radiance in all channels.
pub fn glow(radiance: f32) -> Option<Emission> {
    Some(Emission { name: None, radiance: Color::Constant([radiance; 3]), place: Place::default() })
}

/// A grey Lambert material.
pub fn diffuse(albedo: f32) -> MaterialKind {
    MaterialKind::Diffuse { reflectance: Color::Constant([albedo; 3]) }
}

/// Adds a constant environment.
pub fn sky(scene: &mut Scene, radiance: f32) {
    let kind = LightKind::Constant { radiance: [radiance; 3] };
    scene.lights.push(Light { name: "sky".into(), kind, place: Place::default() });
}

/// A mesh from vertices and triangles.
pub fn mesh(positions: Vec<[f32; 3]>, triangles: Vec<[u32; 3]>) -> ShapeKind {
    ShapeKind::Mesh(Arc::new(Mesh { positions, triangles, ..Mesh::default() }))
}
