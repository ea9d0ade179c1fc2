//! What stands in where a model file has no camera and no light.

use std::collections::HashMap;
use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DMat4, DVec3};

use crate::{
    Camera, Film, FovAxis, Image, Light, LightKind, Mesh, PixelFilter, Place, Projection, Sampler, Scene,
    Shape, ShapeKind, Texels, Warning,
};

/// Width and height of a picture where nothing says another.
pub(crate) const SIZE: [u32; 2] = [960, 720];
/// Samples per pixel, likewise.
const SAMPLES: u32 = 64;
/// Full angle of view of the camera that stands in, along the height, in degrees.
const FOV_DEG: f64 = 45.0;
/// The way to that camera, seen from the model: somewhat to the right of its front and above. Models face +z (glTF 2.0,
/// section 3.4), and rooms that are models are open there.
const FROM: DVec3 = DVec3::new(0.45, 0.3, 1.0);
/// Radiance of the sky that stands in at its zenith: it sends π onto what is level.
const ZENITH: f64 = 9.0 / 7.0;
/// Radiance of the ground below it.
const GROUND: f64 = 0.2;
/// Its picture; the rows are odd, for the horizon.
const SKY_COLUMNS: u32 = 4;
const SKY_ROWS: u32 = 65;
/// Room around the model.
const MARGIN: f64 = 1.05;

/// Adds a camera that sees everything where there is none, and a sky where nothing shines: no light, and no surface
/// that was made to (`has_lamp`).
pub(crate) fn complete(scene: &mut Scene, has_lamp: bool, place: &Place) {
    let warning = |message: &str| Warning {
        place: place.clone(),
        element: "scene".into(),
        message: message.into(),
        unused_parameter: false,
    };
    if scene.cameras.is_empty() {
        let message = "no camera; one with a view of 45 degrees that sees everything stands in";
        scene.warnings.push(warning(message));
        let bounds = bounds(&scene.shapes);
        let world_from_camera = framing(bounds, f64::from(SIZE[0]) / f64::from(SIZE[1]));
        let projection = Projection::Perspective {
            fov_deg: FOV_DEG,
            fov_axis: FovAxis::Y,
            principal_point_offset: [0.0; 2],
        };
        let mut camera = camera("camera 1".into(), world_from_camera, projection, SIZE, place.clone());
        // For renderers whose cameras see less: everything lies well within.
        let distance = world_from_camera.w_axis.truncate().distance(0.5 * bounds[0] + 0.5 * bounds[1]);
        if distance > 0.0 && distance.is_finite() {
            (camera.near_clip, camera.far_clip) = (Some(1e-3 * distance), Some(1e3 * distance));
        }
        scene.cameras.push(camera);
    }
    if scene.lights.is_empty() && !has_lamp {
        scene.warnings.push(warning("no light; an overcast sky stands in"));
        scene.lights.push(Light { name: "sky".into(), kind: overcast(), place: place.clone() });
    }
}

/// An overcast sky over grey ground: radiance in proportion to 1 + 2 sin of the height (Moon and Spencer 1942), such that
/// what is level and white has radiance 1. Against a sky that is the same all around nothing white could be told from it.
fn overcast() -> LightKind {
    // From the zenith to the nadir; the picture is bilinear between rows, and the horizon is the middle one.
    let radiance = |row: u32| {
        let height = (0.5 - f64::from(row) / f64::from(SKY_ROWS - 1)) * PI;
        if height >= 0.0 { ZENITH * (1.0 + 2.0 * height.sin()) / 3.0 } else { GROUND }
    };
    let row = |row: u32| [radiance(row) as f32; 3 * SKY_COLUMNS as usize];
    let texels = Texels::Linear32((0..SKY_ROWS).flat_map(row).collect());
    let image = Arc::new(Image { width: SKY_COLUMNS, height: SKY_ROWS, texels });
    LightKind::EnvMap { image, scale: 1.0, world_from_light: DMat4::IDENTITY }
}

/// A camera with what model files do not say.
pub(crate) fn camera(
    name: String,
    world_from_camera: DMat4,
    projection: Projection,
    [width, height]: [u32; 2],
    place: Place,
) -> Camera {
    Camera {
        name,
        world_from_camera,
        projection,
        lens: None,
        near_clip: None,
        far_clip: None,
        film: Film {
            width,
            height,
            crop: None,
            filter: PixelFilter::Gaussian { stddev: 0.5 },
            filter_steps: None,
            alpha: false,
        },
        sampler: Sampler { kind: "sobol".into(), sample_count: SAMPLES },
        place,
    }
}

/// Where a camera stands that sees all of a box, whose aspect ratio (width over height) is at least 1.
fn framing([low, high]: [DVec3; 2], aspect: f64) -> DMat4 {
    let centre = 0.5 * low + 0.5 * high;
    let half = 0.5 * (high - low);
    let back = FROM.normalize();
    let x = back.cross(DVec3::Y).normalize(); // to the left of the picture
    let y = (-back).cross(x);
    let tan = (0.5 * FOV_DEG.to_radians()).tan();
    // Each corner must lie within the four planes of the view.
    let mut distance = 0.0f64;
    for corner in 0..8 {
        let sign = |bit: u32| if corner >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let corner = half * DVec3::new(sign(0), sign(1), sign(2));
        let beside = (corner.dot(x).abs() / (tan * aspect)).max(corner.dot(y).abs() / tan);
        distance = distance.max(MARGIN * beside + corner.dot(back));
    }
    let eye = centre + distance * back;
    if !(distance > 0.0 && eye.is_finite()) {
        // Nothing is there, or a single point: any view will do.
        return DMat4::from_cols(x.extend(0.0), y.extend(0.0), (-back).extend(0.0), back.extend(1.0));
    }
    DMat4::from_cols(x.extend(0.0), y.extend(0.0), (-back).extend(0.0), eye.extend(1.0))
}

/// Low and high corner of a box around all meshes; not finite where there are none.
fn bounds(shapes: &[Shape]) -> [DVec3; 2] {
    let mut of_meshes: HashMap<*const Mesh, [DVec3; 2]> = HashMap::new();
    let (mut low, mut high) = (DVec3::MAX, DVec3::MIN);
    for shape in shapes {
        let ShapeKind::Mesh(mesh) = &shape.kind else { continue };
        let corners = *of_meshes.entry(Arc::as_ptr(mesh)).or_insert_with(|| {
            let points = mesh.positions.iter().map(|p| DVec3::from(p.map(f64::from)));
            points.fold([DVec3::MAX, DVec3::MIN], |[low, high], p| [low.min(p), high.max(p)])
        });
        for corner in 0..8 {
            let pick = |bit: usize| corners[corner >> bit & 1][bit];
            let p = shape.world_from_object.transform_point3(DVec3::new(pick(0), pick(1), pick(2)));
            (low, high) = (low.min(p), high.max(p));
        }
    }
    [low, high]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_of_any_size_and_place_is_seen_whole_and_fills_the_picture() {
        for (low, high) in [
            (DVec3::splat(-1.0), DVec3::ONE),
            (DVec3::new(1e6, 0.0, -3.0), DVec3::new(1e6 + 2.0, 9.0, -3.0)),
            (DVec3::splat(-1e-20), DVec3::new(1e-20, 3e-20, 0.0)),
        ] {
            let camera_from_world = framing([low, high], 4.0 / 3.0).inverse();
            let tan = (0.5 * FOV_DEG.to_radians()).tan();
            let mut fill = 0.0f64;
            for corner in 0..8 {
                let pick = |bit: usize| [low, high][corner >> bit & 1][bit];
                let p = camera_from_world.transform_point3(DVec3::new(pick(0), pick(1), pick(2)));
                assert!(p.z > 0.0, "{p} of {low} {high}");
                let beside = (p.x / p.z / tan * 0.75).abs().max((p.y / p.z / tan).abs());
                fill = fill.max(beside);
            }
            assert!((0.8..1.0).contains(&fill), "{fill} of the picture for {low} {high}");
        }
    }

    #[test]
    fn the_camera_is_upright_and_sees_the_front_with_x_to_the_right() {
        let camera_from_world = framing([DVec3::splat(-1.0), DVec3::ONE], 1.0).inverse();
        let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(|v| camera_from_world.transform_vector3(v));
        assert!(x.x < 0.0 && y.y > 0.0 && y.x.abs() < 1e-12 && z.z < 0.0, "{x} {y} {z}");
    }

    #[test]
    fn what_is_level_and_white_has_radiance_1_under_the_sky() {
        let LightKind::EnvMap { image, .. } = overcast() else { panic!("a picture") };
        let Texels::Linear32(values) = &image.texels else { panic!("of floats") };
        // E = 2π ∫ L cos θ sin θ dθ by the trapezoidal rule over the rows of the upper half, which are linear between.
        let step = PI / f64::from(SKY_ROWS - 1);
        let at = |row: u32| {
            let theta = f64::from(row) * step;
            f64::from(values[(row * 3 * SKY_COLUMNS) as usize]) * theta.cos() * theta.sin()
        };
        let irradiance = 2.0 * PI * step * (0..=SKY_ROWS / 2).map(at).sum::<f64>();
        assert!((irradiance / PI - 1.0).abs() < 1e-3, "{irradiance}");
    }

    #[test]
    fn nothing_to_see_makes_a_finite_camera_all_the_same() {
        for bounds in [[DVec3::MAX, DVec3::MIN], [DVec3::ONE; 2]] {
            assert!(framing(bounds, 1.0).is_finite());
        }
    }
}
