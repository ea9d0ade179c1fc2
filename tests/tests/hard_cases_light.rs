//! Hard cases of light transport and of the film: rows of one table, each named after its number.

use std::f64::consts::{FRAC_1_PI, PI};
use std::sync::Arc;

use glam::{DMat3, DMat4, DVec3};
use limpid_scenes::*;
use limpid_tests::scene::{add, camera, diffuse, glow, scene, sky};
use limpid_tests::{mean, radiance, rendered, within};

/// A floor of albedo ½ in z = 0; what leaves the origin upwards is measured from `height`.
fn foot() -> Scene {
    let mut scene = scene(camera(DVec3::Z, DVec3::ZERO, 1, 1), vec![diffuse(0.5), diffuse(0.0)]);
    add(&mut scene, ShapeKind::Rectangle, DMat4::from_scale(DVec3::splat(64.0)), 0);
    scene
}

fn light_sphere(scene: &mut Scene, center: DVec3, radius: f64, radiance: f64) {
    add(scene, ShapeKind::Sphere { center, radius }, DMat4::IDENTITY, 1).emission = glow(radiance as f32);
}

/// A square light of half-side `half` at `height`, facing down.
fn light_square(scene: &mut Scene, half: f64, height: f64, radiance: f64) {
    let down = DMat4::from_translation(DVec3::Z * height)
        * DMat4::from_rotation_x(PI)
        * DMat4::from_scale(DVec3::new(half, half, 1.0));
    add(scene, ShapeKind::Rectangle, down, 1).emission = glow(radiance as f32);
}

#[test]
fn hc10_sphere_light_near_inside() {
    for gap in [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
        let mut scene = foot();
        light_sphere(&mut scene, DVec3::Z * (1.0 + gap), 1.0, 1.0);
        let seen = radiance(scene, DVec3::Z * (0.5 * gap), DVec3::ZERO, 65536, 2);
        within(&format!("gap {gap}"), mean(&seen), 0.5 / ((1.0 + gap) * (1.0 + gap)), 0.01);
    }
    for share in [0.0, 0.5, 0.99, 0.9999] {
        // The floor is a small square inside the lit sphere; E = π L whatever its place.
        let mut scene = scene(camera(DVec3::Z, DVec3::ZERO, 1, 1), vec![diffuse(0.5), diffuse(0.0)]);
        let size = 0.25 * (1.0f64 - share * share).sqrt();
        add(&mut scene, ShapeKind::Rectangle, DMat4::from_scale(DVec3::splat(size)), 0);
        let kind = ShapeKind::Sphere { center: DVec3::Z * -share, radius: 1.0 };
        let light = add(&mut scene, kind, DMat4::IDENTITY, 1);
        (light.emission, light.flip_normals) = (glow(1.0), true);
        let eye = DVec3::Z * (0.25 * (1.0 - share));
        within(&format!("inside at {share}"), mean(&radiance(scene, eye, DVec3::ZERO, 65536, 2)), 0.5, 0.01);
    }
}

#[test]
fn hc11_sphere_light_tiny_cone() {
    for exponent in [-2, -4, -6, -8, -10, -12] {
        let solid_angle = 10f64.powi(exponent);
        let radius = (solid_angle / PI).sqrt();
        let mut scene = foot();
        light_sphere(&mut scene, DVec3::Z, radius, 1.0 / (radius * radius));
        let open = radiance(scene.clone(), DVec3::Z * 0.25, DVec3::ZERO, 4096, 2);
        within(&format!("{solid_angle:e} sr"), mean(&open), 0.5, 0.01);
        // A black half-plane x > 0 at height ½ hides half of the light by symmetry.
        let half = DMat4::from_translation(DVec3::new(8.0, 0.0, 0.5)) * DMat4::from_scale(DVec3::splat(8.0));
        add(&mut scene, ShapeKind::Rectangle, half, 1);
        let hidden = radiance(scene, DVec3::new(-1e-9, 0.0, 0.25), DVec3::new(-1e-9, 0.0, 0.0), 65536, 2);
        within(&format!("{solid_angle:e} sr, half hidden"), mean(&hidden), 0.25, 0.02);
    }
}

#[test]
fn hc24_mis_pdf_overflow() {
    for (half, height) in [(1e-8, 1.0), (1e-8, 1e2), (1e-8, 1e3), (1e-8, 1e4), (1e-10, 1.0)] {
        let mut scene = foot();
        light_square(&mut scene, half, height, height * height / (4.0 * half * half));
        let seen = radiance(scene, DVec3::Z * 0.25, DVec3::ZERO, 4096, 2);
        within(&format!("half-side {half:e} at {height}"), mean(&seen), 0.5 * FRAC_1_PI, 0.01);
    }
}

#[test]
fn hc61_sample_count_extremes() {
    for spp in [1u32, 1 << 10, 1 << 16, 1 << 20, 1 << 22, 1 << 24, 1 << 25] {
        let mut scene = scene(camera(DVec3::Z, DVec3::ZERO, 1, 1), vec![]);
        sky(&mut scene, 0.1);
        let seen = rendered(&scene, |s| {
            s.spp = spp;
            s.layers = s.layers.clone().with(limpid_frame::Layer::Beauty, limpid_frame::Statistic::Variance);
        });
        assert_eq!(seen.frame.channel("G"), Some(&[0.1f32][..]), "{spp} spp");
        let variance = seen.frame.channel("variance.G").expect("asked for")[0];
        assert_eq!(variance, if spp == 1 { -1.0 } else { 0.0 }, "{spp} spp");
    }
}

/// A lamp of 64×64 texels seen one to one, its texel (20, 30) as given.
fn lamp(texel: f32, filter: PixelFilter) -> limpid_renderer::Rendered {
    let mut view = camera(DVec3::Z, DVec3::ZERO, 64, 64);
    view.projection =
        Projection::Perspective { fov_deg: 90.0, fov_axis: FovAxis::X, principal_point_offset: [0.0; 2] };
    view.film.filter = filter;
    let mut scene = scene(view, vec![diffuse(0.0)]);
    let mut texels = vec![1.0; 64 * 64 * 3];
    texels[3 * (30 * 64 + 20)..][..3].fill(texel);
    let image = Arc::new(Image { width: 64, height: 64, texels: Texels::Linear32(texels) });
    scene.textures.push(Texture {
        name: "lamp".into(),
        kind: TextureKind::Bitmap { image, filter: TexelFilter::Nearest, wrap: WrapMode::Clamp },
        uv_from_surface: DMat3::IDENTITY,
        place: Place::default(),
    });
    let shape = add(&mut scene, ShapeKind::Rectangle, DMat4::IDENTITY, 0);
    let radiance = Color::Texture(TextureId(0));
    shape.emission = Some(Emission { name: None, radiance, place: Place::default() });
    rendered(&scene, |s| s.spp = 16)
}

#[test]
fn hc62_nan_sample_handling() {
    for filter in [PixelFilter::Box, PixelFilter::Gaussian { stddev: 0.5 }] {
        let (bad, zero) = (lamp(f32::NAN, filter), lamp(0.0, filter));
        assert_eq!(bad.frame.channel("G"), zero.frame.channel("G"), "{filter:?}");
        assert!(bad.rejected >= 1 && bad.first_rejected.is_some(), "{} rejected", bad.rejected);
        assert_eq!(zero.rejected, 0);
        if filter == PixelFilter::Box {
            assert_eq!(bad.rejected, 16, "one pixel sees the texel with all its samples");
        }
    }
}
