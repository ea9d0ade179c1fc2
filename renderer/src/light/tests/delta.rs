//! Lights that no ray finds, against Mitsuba 3.9.1 and against formulas. The truths are what its `sample_direction` prints.

use glam::DMat4;

use super::*;
use crate::color::luminance;
use crate::testing::{add, camera, diffuse, scene};

/// Red, white, white, green over blue and three white ones.
fn flag() -> Textures {
    let (r, g, b, w) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0; 3]);
    picture(4, 2, |i| [r, w, w, g, b, w, w, w][i])
}

fn light(kind: LightKind, textures: &Textures, origin: DVec3) -> Lights {
    let light = SceneLight { name: "lamp".into(), kind, place: Place::default() };
    Lights::from_shapes(Vec::new(), &[light], textures, origin, 1.0)
}

/// Direction and irradiance across it at `p`.
fn at(lights: &Lights, p: [f64; 3], textures: &Textures) -> Option<(Vec3, Rgb)> {
    let sample = lights.sample(DVec3::from(p).as_vec3(), 0.3, Vec2::splat(0.7), textures)?;
    assert!(sample.delta && sample.pdf == 1.0 && sample.skip == NONE, "{sample:?}");
    Some((sample.wi, sample.radiance))
}

/// Within 1e-5: Mitsuba's own numbers are in single precision.
fn assert_near(value: Rgb, truth: [f32; 3]) {
    assert!(
        value.abs_diff_eq(truth.into(), 1e-5 * Vec3::from(truth).max_element().max(1.0)),
        "{value} {truth:?}"
    );
}

fn spot(cutoff_deg: f64, beam_deg: f64, texture: Color) -> LightKind {
    LightKind::Spot {
        world_from_light: DMat4::IDENTITY,
        intensity: [1.0, 2.0, 3.0],
        cutoff_deg,
        beam_deg,
        falloff: limpid_scenes::SpotFalloff::Angle,
        texture,
    }
}

#[test]
fn point_light_falls_with_the_square_of_the_distance() {
    let textures = NO_TEXTURES();
    let kind = LightKind::Point { position: DVec3::new(0.0, 0.0, 1e6 + 2.0), intensity: [1.0, 2.0, 4.0] };
    // Far from the origin of the world, near to that of render space.
    let lights = light(kind, &textures, DVec3::Z * 1e6);
    let (wi, irradiance) = at(&lights, [0.0; 3], &textures).unwrap();
    assert_eq!((wi, irradiance), (Vec3::Z, Rgb::new(0.25, 0.5, 1.0)));
    assert_eq!(at(&lights, [0.0, 0.0, 2.0], &textures), None);
    let sample = lights.sample(Vec3::ZERO, 0.5, Vec2::ZERO, &textures).unwrap();
    assert!(sample.t_max < 2.0 && sample.t_max > 1.9999);
}

/// A lamp of cos² of the angle to its axis, on one side twice as bright: what its samples give over a sphere around it is the
/// integral of the profile, ∫ I dω = 2π/3 · (1 + 2)/2.
#[test]
fn photometric_light_sends_its_profile() {
    let textures = NO_TEXTURES();
    let vertical_deg: Vec<f32> = (0..=90).map(|i| i as f32).collect();
    let horizontal_deg = vec![0.0, 90.0, 180.0, 270.0, 360.0];
    let plane = |factor: f32| vertical_deg.iter().map(move |v| factor * v.to_radians().cos().powi(2));
    let candelas = [1.5, 2.0, 1.5, 1.0, 1.5].into_iter().flat_map(plane).collect();
    let profile = limpid_scenes::IesProfile { vertical_deg: vertical_deg.clone(), horizontal_deg, candelas };
    let kind = LightKind::Ies {
        world_from_light: DMat4::from_translation(DVec3::new(1.0, 2.0, 3.0)) * DMat4::from_rotation_y(PI),
        intensity: [1.0, 2.0, 4.0],
        profile: std::sync::Arc::new(profile),
    };
    let lights = light(kind, &textures, DVec3::ZERO);
    // along the axis, turned to −z; at its side, towards +y, and behind
    let (wi, along) = at(&lights, [1.0, 2.0, 1.0], &textures).unwrap();
    assert_eq!(wi, Vec3::Z);
    assert_near(along, [0.375, 0.75, 1.5]);
    assert_near(at(&lights, [1.0, 3.0, 2.0], &textures).unwrap().1, [0.5, 1.0, 2.0]);
    assert!(at(&lights, [1.0, 3.0, 3.1], &textures).is_none());
    let (mut flux, n, radius) = (0.0, 1 << 14, 2.0);
    for i in 0..n {
        let (_, u) = numbers(Sampler::Sobol, i);
        let (z, phi) = (1.0 - 2.0 * f64::from(u.x), std::f64::consts::TAU * f64::from(u.y));
        let r = (1.0 - z * z).sqrt();
        let p = DVec3::new(1.0, 2.0, 3.0) + radius * DVec3::new(r * phi.cos(), r * phi.sin(), z);
        let arriving = at(&lights, p.to_array(), &textures);
        flux += arriving.map_or(0.0, |(_, irradiance)| f64::from(irradiance.x));
    }
    flux *= 4.0 * PI * radius * radius / f64::from(n);
    assert!((flux / PI - 1.0).abs() < 1e-3, "{flux}");
}

/// A lamp whose power, estimated on a grid or not, comes out as 0 or next to it shines all the same.
#[test]
fn what_shines_in_few_directions_is_drawn() {
    // white in the four texels around its middle, which the grid of 32 × 32 passes by
    let is_white = |i: usize| [i % 1024, i / 1024].iter().all(|at| (511..=512).contains(at));
    let textures = picture(1024, 1024, |i| [f32::from(u8::from(is_white(i))); 3]);
    let slide = Color::Texture(TextureId(0));
    let laser = limpid_scenes::IesProfile {
        vertical_deg: vec![0.0, 0.2, 0.21, 90.0],
        horizontal_deg: vec![0.0, 360.0],
        candelas: [1e6, 1e6, 0.0, 0.0].repeat(2),
    };
    let profile = std::sync::Arc::new(laser);
    let (world_from_light, white, half_size) = (DMat4::IDENTITY, [1.0; 3], [1.0; 2]);
    for kind in [
        LightKind::Ies { world_from_light, intensity: white, profile },
        spot(20.0, 15.0, slide),
        LightKind::Projector { world_from_light, irradiance: slide, scale: 1.0, half_size },
    ] {
        let shown = format!("{kind:?}");
        let lights = light(kind, &textures, DVec3::ZERO);
        let (_, irradiance) =
            at(&lights, [-1e-4, -1e-4, 1.0], &textures).unwrap_or_else(|| panic!("{shown:.20}"));
        assert!(irradiance.x > 0.5, "{shown:.20}: {irradiance}");
    }
}

#[test]
fn lamps_that_are_black_are_not_drawn() {
    let textures = NO_TEXTURES();
    let (world_from_light, half_size) = (DMat4::IDENTITY, [1.0; 2]);
    let profile = |candelas: f32| {
        let candelas = vec![candelas; 4];
        let [vertical_deg, horizontal_deg] = [[0.0, 90.0], [0.0, 360.0]].map(Vec::from);
        std::sync::Arc::new(limpid_scenes::IesProfile { vertical_deg, horizontal_deg, candelas })
    };
    let black = [0.0; 3];
    for kind in [
        LightKind::Point { position: DVec3::ZERO, intensity: black },
        LightKind::Ies { world_from_light, intensity: [1.0; 3], profile: profile(0.0) },
        LightKind::Ies { world_from_light, intensity: black, profile: profile(1.0) },
        spot(20.0, 15.0, Color::Constant(black)),
        LightKind::Directional { direction: DVec3::Z, irradiance: black },
        LightKind::Projector { world_from_light, irradiance: Color::Constant(black), scale: 1.0, half_size },
        LightKind::Projector { world_from_light, irradiance: WHITE, scale: 0.0, half_size },
    ] {
        let shown = format!("{kind:?}");
        let lights = light(kind, &textures, DVec3::ZERO);
        assert!(lights.choice.is_none(), "{shown}");
    }
}

#[test]
fn spot_fades_linearly_in_the_angle_as_mitsubas_does() {
    let textures = NO_TEXTURES();
    let lights = light(spot(20.0, 15.0, WHITE), &textures, DVec3::ZERO);
    let tan = |degrees: f64| degrees.to_radians().tan();
    for (angle, truth) in [
        (0.0, [1.0, 2.0, 3.0]),
        (15.0, [0.93301266, 1.8660253, 2.799038]),
        (17.0, [0.5487124, 1.0974247, 1.6461371]),
        (19.9, [0.01768449, 0.03536898, 0.05305348]),
    ] {
        assert_near(at(&lights, [tan(angle), 0.0, 1.0], &textures).unwrap().1, truth);
    }
    for dark in [[tan(20.1), 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.0, -1.0]] {
        assert_eq!(at(&lights, dark, &textures), None);
    }
    // A beam that ends sharply, and one that shines everywhere.
    let sharp = light(spot(60.0, 60.0, WHITE), &textures, DVec3::ZERO);
    assert!(at(&sharp, [tan(59.9), 0.0, 1.0], &textures).is_some());
    assert!(at(&sharp, [tan(60.1), 0.0, 1.0], &textures).is_none());
    let full = light(spot(180.0, 180.0, WHITE), &textures, DVec3::ZERO);
    assert_near(at(&full, [0.0, 0.0, -1.0], &textures).unwrap().1, [1.0, 2.0, 3.0]);
}

#[test]
fn spot_throws_its_texture() {
    let textures = flag();
    let lights = light(spot(20.0, 15.0, Color::Texture(TextureId(0))), &textures, DVec3::ZERO);
    for ((x, y), truth) in [
        ((0.1, 0.1), [0.98039216, 1.9607843, 2.9411765]),
        ((-0.2, -0.2), [0.7790437, 0.0, 0.0]),
        ((-0.2, 0.2), [0.0, 0.0, 3.0 * 0.7790437]),
    ] {
        assert_near(at(&lights, [x, y, 1.0], &textures).unwrap().1, truth);
    }
}

#[test]
fn spot_power_is_the_integral_of_its_intensity() {
    for (cutoff, beam) in [(20.0, 19.0), (60.0, 60.0), (180.0, 180.0)] {
        let textures = NO_TEXTURES();
        let Some(Delta::Spot(spot)) = Delta::new(&spot(cutoff, beam, WHITE), DVec3::ZERO) else { panic!() };
        let steps = 20_000;
        let ring = |i: u32| {
            let theta = PI * (f64::from(i) + 0.5) / f64::from(steps);
            let p = DVec3::new(theta.sin(), 0.0, theta.cos());
            let seen = spot.at(p, &textures).map_or(0.0, |a| f64::from(luminance(a.irradiance)));
            seen * 2.0 * PI * theta.sin() * PI / f64::from(steps)
        };
        let flux: f64 = (0..steps).map(ring).sum();
        assert!((spot.power(&textures) / flux - 1.0).abs() < 0.01, "{} {flux}", spot.power(&textures));
    }
}

#[test]
fn directional_light_is_the_same_everywhere() {
    let textures = NO_TEXTURES();
    let direction = DVec3::new(0.6, 0.0, -0.8);
    let lights = light(LightKind::Directional { direction, irradiance: [3.0; 3] }, &textures, DVec3::X);
    for p in [[0.0; 3], [1e9, -3.0, 7.0]] {
        assert_eq!(at(&lights, p, &textures), Some((Vec3::new(-0.6, 0.0, 0.8), Rgb::splat(3.0))));
    }
    assert_eq!(lights.sample(Vec3::ZERO, 0.5, Vec2::ZERO, &textures).unwrap().t_max, f32::INFINITY);
    assert!(!lights.has_infinite());
}

fn projector(half_size: [f64; 2], world_from_light: DMat4) -> LightKind {
    let irradiance = Color::Texture(TextureId(0));
    LightKind::Projector { world_from_light, irradiance, scale: 2.0, half_size }
}

#[test]
fn projector_lights_a_screen_evenly_as_mitsubas_does() {
    let textures = flag();
    let x_axis = light(projector([1.0, 0.5], DMat4::IDENTITY), &textures, DVec3::ZERO);
    for (p, truth) in [
        ([0.4, 0.2, 1.0], [6.8828845; 3]),
        ([-0.9, 0.4, 1.0], [0.0, 8.818871, 0.0]),
        ([0.9, 0.4, 1.0], [8.818871, 0.0, 0.0]),
        ([0.9, -0.4, 1.0], [0.0, 0.0, 8.818871]),
        ([0.1, 0.1, 2.0], [1.5747186; 3]),
    ] {
        let (wi, irradiance) = at(&x_axis, p, &textures).unwrap();
        assert_near(irradiance, truth);
        // On a screen across the axis it is π · scale · texture / z².
        let on_screen = irradiance.max_element() * -wi.z * (p[2] * p[2]) as f32;
        assert!((on_screen - 2.0 * std::f32::consts::PI).abs() < 1e-5, "{on_screen}");
    }
    for dark in [[0.9, 0.6, 1.0], [0.0, 0.0, -1.0], [0.0; 3]] {
        assert_eq!(at(&x_axis, dark, &textures), None);
    }
    // `fov_axis` y, and a scale.
    let y_axis = light(projector([2.0, 1.0], DMat4::IDENTITY), &textures, DVec3::ZERO);
    assert_near(at(&y_axis, [0.9, 0.6, 1.0], &textures).unwrap().1, [9.25571; 3]);
    let scaled = light(projector([1.0, 0.5], DMat4::from_scale(DVec3::splat(3.0))), &textures, DVec3::ZERO);
    assert_near(at(&scaled, [0.9, 0.4, 1.0], &textures).unwrap().1, [2.0 * 13.228305, 0.0, 0.0]);
}

#[test]
fn delta_lights_share_the_choice_and_add_up() {
    let textures = NO_TEXTURES();
    let kinds = [
        LightKind::Point { position: DVec3::Z, intensity: [1.0; 3] },
        LightKind::Directional { direction: DVec3::NEG_Z, irradiance: [2.0; 3] },
        LightKind::Directional { direction: DVec3::NEG_Z, irradiance: [0.0; 3] },
        LightKind::Point { position: DVec3::Z * 2.0, intensity: [12.0; 3] },
    ];
    let others = kinds.map(|kind| SceneLight { name: "l".into(), kind, place: Place::default() });
    let shapes = vec![LightShape { shape: 0, form: square(1.0, 0.1), emission: WHITE }];
    let lights = Lights::from_shapes(shapes, &others, &textures, DVec3::ZERO, 1.0);
    let samples = 1 << 14;
    let (mut sum, mut surfaces) = (0.0, 0.0);
    for i in 0..samples {
        let (choice, u) = numbers(Sampler::Sobol, i);
        let s = lights.sample(Vec3::ZERO, choice, u, &textures).unwrap();
        *if s.delta { &mut sum } else { &mut surfaces } += f64::from(s.radiance.x * s.wi.z / s.pdf);
    }
    let mean = sum / f64::from(samples);
    assert!((mean - 6.0).abs() < 0.02 && surfaces > 0.0, "{mean}");
}

/// One vertex, one light: no noise at all, whatever the BSDF's own density is.
#[test]
fn a_floor_under_a_point_light_has_the_radiance_of_the_formula() {
    let mut scene = scene(camera(DVec3::new(0.0, 0.0, 9.0), DVec3::ZERO, 1, 1), vec![diffuse(0.5)]);
    limpid_testkit::scene::set_fov(&mut scene.cameras[0], 1e-3);
    add(&mut scene, limpid_scenes::ShapeKind::Rectangle, DMat4::from_scale(DVec3::splat(50.0)), 0);
    let kind = LightKind::Point { position: DVec3::new(3.0, 0.0, 4.0), intensity: [10.0; 3] };
    scene.lights.push(SceneLight { name: "p".into(), kind, place: Place::default() });
    let seen = crate::testing::mean(&crate::testing::render(&scene, |s| s.spp = 4), "G");
    let truth = 0.5 / PI * 10.0 / 25.0 * 0.8;
    assert!((seen / truth - 1.0).abs() < 1e-4, "{seen} {truth}");
}
