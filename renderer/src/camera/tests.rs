use std::sync::Arc;

use glam::DMat4;
use limpid_scenes::{
    Color, Emission, Film, FovAxis, Image, PixelFilter, Place, Sampler, Scene, ShapeKind, TexelFilter,
    Texels, Texture, TextureId, TextureKind, WrapMode,
};

use super::*;
use crate::effects::Effect;
use crate::testing::{add, diffuse, render, scene};

fn camera(fov_axis: FovAxis, offset: [f64; 2]) -> SceneCamera {
    SceneCamera {
        name: "camera".into(),
        world_from_camera: DMat4::IDENTITY,
        projection: Projection::Perspective { fov_deg: 90.0, fov_axis, principal_point_offset: offset },
        lens: None,
        near_clip: None,
        far_clip: None,
        film: Film {
            width: 100,
            height: 50,
            crop: None,
            filter: PixelFilter::Box,
            filter_steps: None,
            alpha: false,
        },
        sampler: Sampler { kind: "independent".into(), sample_count: 1 },
        place: Place::default(),
    }
}

fn slopes(c: &SceneCamera, x: f64, y: f64) -> (f32, f32) {
    let d = Camera::new(c, 100, 50).ray(DVec2::new(x, y), Vec2::ZERO).d;
    (d.x / d.z, d.y / d.z)
}

fn assert_near((x, y): (f32, f32), truth: (f32, f32)) {
    assert!((x - truth.0).abs() < 1e-6 && (y - truth.1).abs() < 1e-6, "({x}, {y}), not {truth:?}");
}

// The truths are what Mitsuba 3.9.1 gives for the same camera.
#[test]
fn field_of_view_belongs_to_its_axis() {
    assert_near(slopes(&camera(FovAxis::X, [0.0; 2]), 25.0, 12.5), (0.5, 0.25));
    assert_near(slopes(&camera(FovAxis::Y, [0.0; 2]), 20.0, 10.0), (1.2, 0.6));
    assert_near(slopes(&camera(FovAxis::Smaller, [0.0; 2]), 20.0, 10.0), (1.2, 0.6));
    assert_near(slopes(&camera(FovAxis::Larger, [0.0; 2]), 25.0, 12.5), (0.5, 0.25));
}

#[test]
fn principal_point_shifts_the_picture() {
    assert_near(slopes(&camera(FovAxis::X, [0.1, 0.1]), 25.0, 12.5), (0.3, 0.15));
}

#[test]
fn clip_distances_lie_along_the_view_axis() {
    let mut c = camera(FovAxis::X, [0.0; 2]);
    (c.near_clip, c.far_clip) = (Some(0.01), Some(10.01));
    let ray = Camera::new(&c, 100, 50).ray(DVec2::new(25.0, 12.5), Vec2::ZERO);
    assert!((ray.o.z - 0.01).abs() < 1e-8 && (ray.o.x - 0.005).abs() < 1e-8, "{}", ray.o);
    assert!((ray.t_max * ray.d.z - 10.0).abs() < 1e-5);
}

// The truths are what Mitsuba 3.9.1 prints for the same camera and the same point of the lens.
#[test]
fn rays_through_a_lens_meet_in_the_focal_plane() {
    let mut c = camera(FovAxis::X, [0.0; 2]);
    (c.lens, c.near_clip) = (Some(Lens { aperture_radius: 0.5, focus_distance: 4.0 }), Some(1.0));
    c.far_clip = Some(9.0);
    let camera = Camera::new(&c, 100, 50);
    for (lens, o, d, t_max) in [
        ([0.5, 0.5], [0.5, 0.25, 1.0], [0.436436, 0.218218, 0.872872], 9.165152),
        ([0.9, 0.5], [0.8, 0.25, 1.0], [0.361773, 0.226108, 0.904431], 8.845338),
        ([0.5, 0.9], [0.5, 0.55, 1.0], [0.443242, 0.132973, 0.886484], 9.024412),
        ([0.9, 0.8], [0.749441, 0.416671, 1.0], [0.378711, 0.176652, 0.9085], 8.805724),
    ] {
        let ray = camera.ray(DVec2::new(25.0, 12.5), Vec2::from(lens));
        assert!(ray.o.abs_diff_eq(o.into(), 2e-6) && ray.d.abs_diff_eq(d.into(), 2e-6), "{ray:?}");
        assert!((ray.t_max - t_max).abs() < 1e-5, "{ray:?}");
        let focus = ray.o + ray.d * ((4.0 - ray.o.z) / ray.d.z);
        assert!(focus.abs_diff_eq(Vec3::new(2.0, 1.0, 4.0), 1e-5), "{focus}");
    }
}

#[test]
fn parallel_rays_start_on_the_film() {
    let mut c = camera(FovAxis::X, [0.0; 2]);
    c.projection = Projection::Orthographic;
    // The place of the camera is the origin of render space.
    c.world_from_camera =
        DMat4::from_translation(DVec3::new(7.0, 8.0, 9.0)) * DMat4::from_scale(DVec3::new(10.0, 5.0, 2.0));
    (c.near_clip, c.far_clip) = (Some(1.0), Some(5.0));
    let camera = Camera::new(&c, 100, 50);
    for (film, o) in [
        ([0.0, 0.0], [10.0, 2.5, 2.0]),
        ([100.0, 50.0], [-10.0, -2.5, 2.0]),
        ([25.0, 37.5], [5.0, -1.25, 2.0]),
    ] {
        let ray = camera.ray(DVec2::from(film), Vec2::ZERO);
        assert_eq!((ray.o, ray.d, ray.t_max), (o.into(), Vec3::Z, 4.0));
        assert_eq!(camera.distance(ray.o), 2.0);
    }
}

/// A lamp of 8 × 8 texels that fills the picture of 8 × 8 pixels at the distance 4.
fn lamp(lens: Option<Lens>) -> Scene {
    let mut view = camera(FovAxis::X, [0.0; 2]);
    (view.film.width, view.film.height, view.lens) = (8, 8, lens);
    let mut scene = scene(view, vec![diffuse(0.0)]);
    let texels = Texels::Linear32((0..8 * 8 * 3).map(|i| (i * 7919 % 13) as f32).collect());
    let image = Arc::new(Image { width: 8, height: 8, texels });
    scene.textures.push(Texture {
        name: "lamp".into(),
        kind: TextureKind::Bitmap { image, filter: TexelFilter::Nearest, wrap: WrapMode::Clamp },
        uv_from_surface: DMat3::IDENTITY,
        place: Place::default(),
    });
    let far = DMat4::from_translation(DVec3::Z * 4.0)
        * DMat4::from_rotation_y(std::f64::consts::PI)
        * DMat4::from_scale(DVec3::splat(4.0));
    let radiance = Color::Texture(TextureId(0));
    add(&mut scene, ShapeKind::Rectangle, far, 0).emission =
        Some(Emission { name: None, radiance, place: Place::default() });
    scene
}

#[test]
fn what_is_in_focus_is_as_sharp_as_through_a_pinhole() {
    let seen = |lens| {
        let frame = render(&lamp(lens), |s| s.spp = 64).frame;
        frame.channel("G").unwrap().to_vec()
    };
    let lens = |focus_distance| Some(Lens { aperture_radius: 0.5, focus_distance });
    let (sharp, focused, blurred) = (seen(None), seen(lens(4.0)), seen(lens(2.0)));
    let largest = |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    // A sample on the edge between two pixels may fall to either side.
    assert!(largest(&sharp, &focused) < 0.3, "{}", largest(&sharp, &focused));
    assert!(largest(&sharp, &blurred) > 2.0, "{}", largest(&sharp, &blurred));
}

#[test]
fn depth_of_field_is_counted_where_there_is_a_lens() {
    let lens = Lens { aperture_radius: 0.5, focus_distance: 4.0 };
    for (lens, paths) in [(None, 0), (Some(lens), 8 * 8 * 3)] {
        let scene = lamp(lens);
        let called = crate::effects(&scene).iter().any(|c| c.effect == Effect::DepthOfField);
        let counters = render(&scene, |s| s.spp = 3).counters;
        assert_eq!((called, counters.of(Effect::DepthOfField)), (lens.is_some(), paths));
    }
}
