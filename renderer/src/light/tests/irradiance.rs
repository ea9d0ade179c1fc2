//! Irradiance by light samples against known values: rows of the table of hard cases, without visibility.

use super::*;

/// Mean and standard deviation of one sample of ∫ L cos θ dω at the origin for a floor with normal +z, and the
/// share of samples that are not finite.
fn irradiance(lights: &Lights, from: Vec3, normal: Vec3, samples: u32) -> (f64, f64) {
    let textures = NO_TEXTURES();
    let (mut sum, mut squares) = (0.0, 0.0);
    for i in 0..samples {
        let (choice, u) = numbers(Sampler::Sobol, i);
        let Some(s) = lights.sample(from, choice, u, &textures) else { continue };
        let x = f64::from(s.radiance.x) * f64::from(s.wi.dot(normal).max(0.0)) / f64::from(s.pdf);
        assert!(x.is_finite(), "{s:?}");
        sum += x;
        squares += x * x;
    }
    let mean = sum / f64::from(samples);
    (mean, (squares / f64::from(samples) - mean * mean).max(0.0).sqrt())
}

fn lit(form: LightForm, radiance: f64) -> Lights {
    with_emission(form, Color::Constant([radiance as f32; 3]), &NO_TEXTURES())
}

fn assert_irradiance(lights: &Lights, truth: f64, tolerance: f64, what: &str) {
    let (mean, _) = irradiance(lights, Vec3::ZERO, Vec3::Z, 1 << 14);
    assert!((mean / truth - 1.0).abs() < tolerance, "{what}: {mean}, not {truth}");
}

/// Row 10.
#[test]
fn sphere_just_above_a_floor() {
    for gap in [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
        let truth = PI / (1.0f64 + gap).powi(2);
        assert_irradiance(
            &only(sphere([0.0, 0.0, 1.0 + gap], [1.0; 3], false)),
            truth,
            1e-3,
            &format!("{gap}"),
        );
    }
}

/// Row 10, inside.
#[test]
fn floor_inside_a_sphere() {
    for place in [0.0, 0.5, 0.99, 0.9999, 1.0 - 1e-7] {
        let lights = only(sphere([0.0, 0.0, place], [1.0; 3], true));
        assert_irradiance(&lights, PI, 3e-3, &format!("at {place} r"));
        // Looking up from the bottom, sideways and down all see the same.
        let (mean, _) = irradiance(&lights, Vec3::ZERO, Vec3::X, 1 << 14);
        assert!((mean / PI - 1.0).abs() < 3e-3, "sideways at {place} r: {mean}");
    }
}

/// Row 11.
#[test]
fn sphere_of_tiny_solid_angle() {
    for solid in [1e-2f64, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12] {
        let r = (solid / PI).sqrt();
        let lights = lit(sphere([0.0, 0.0, 1.0], [r; 3], false), 1.0 / (r * r));
        assert_irradiance(&lights, PI, 1e-4, &format!("{solid} sr"));
    }
}

/// Point-to-parallel-rectangle factor over the centre, half-side over height `a`.
fn factor(a: f64) -> f64 {
    let r = (1.0 + a * a).sqrt();
    4.0 / PI * (a / r) * (a / r).atan()
}

/// Row 12.
#[test]
fn square_light_tiny_and_huge() {
    assert!((factor(1.0) - 0.554126).abs() < 1e-6);
    for a in [1e-7, 1e-6, 1e-4, 1e-2] {
        let truth = PI * factor(a) / (4.0 * a * a);
        assert_irradiance(&lit(square(1.0, a as f32), 1.0 / (4.0 * a * a)), truth, 1e-4, &format!("{a}"));
    }
    for a in [1.0f64, 1e2, 1e4, 1e6] {
        assert_irradiance(&only(square(1.0, a as f32)), PI * factor(a), 2e-3, &format!("{a}"));
    }
}

/// Row 24: densities up to 2.5e25.
#[test]
fn square_light_of_enormous_density() {
    for (half, distance) in [(1e-8, 1.0), (1e-8, 1e2), (1e-8, 1e3), (1e-8, 1e4), (1e-10, 1.0), (1e-10, 1e4)] {
        let radiance = distance * distance / (4.0 * half * half);
        let lights = lit(square(distance as f32, half as f32), radiance);
        assert_irradiance(&lights, 1.0, 1e-4, &format!("{half} at {distance}"));
    }
}

/// Lambert's vector formula for a polygon above the horizon, counter-clockwise seen from the origin.
fn polygon(corners: &[[f64; 3]]) -> f64 {
    let corners: Vec<DVec3> = corners.iter().map(|&c| c.into()).collect();
    let n = corners.len();
    let edges = (0..n).map(|i| {
        let (a, b) = (corners[i], corners[(i + 1) % n]);
        let cross = a.cross(b);
        cross.length().atan2(a.dot(b)) * cross.normalize_or_zero().z
    });
    0.5 * edges.sum::<f64>().abs()
}

/// Row 68. The formula in `f64` is right to 1e-4 here down to legs of 1e-3; below it, E is area / π of what is
/// overhead to 1e-6.
#[test]
fn triangle_lights() {
    let right = |leg: f64| [[0.0, 0.0, 1.0], [0.0, leg, 1.0], [leg, 0.0, 1.0]];
    let check = |name: &str, mut corners: [[f64; 3]; 3], truth: f64, tolerance: f64| {
        let [a, b, c] = corners.map(DVec3::from);
        if a.dot(b.cross(c)) > 0.0 {
            corners.swap(1, 2); // it is to face the origin
        }
        let lights = lit(triangles(&[corners.map(|c| c.map(|x| x as f32))]), 1.0 / truth);
        assert_irradiance(&lights, 1.0, tolerance, name);
    };
    for leg in [1e-1, 1e-2, 1e-3] {
        check("right", right(leg), polygon(&right(leg)), 1e-3);
    }
    for leg in [1e-3, 1e-4, 1e-5] {
        check("small right", right(leg), 0.5 * leg * leg, 1e-3);
    }
    let sliver = [[-0.5, 0.0, 1.0], [-0.5, 1e-6, 1.0], [0.5, 0.0, 1.0]];
    // ∫ over the strip of width 1e-6 (½ − x), in which only the even part counts.
    let arc = |x: f64| 0.5 * (x / (1.0 + x * x) + x.atan());
    check("sliver", sliver, 1e-6 * 0.5 * 2.0 * arc(0.5), 2e-3);
    let vertex = [[1.0, 0.0, 0.0], [0.0, 0.0, 2.0], [0.0, 1.0, 1.0]];
    check("vertex on the horizon", vertex, polygon(&vertex), 5e-3);
    let edge = [[1.0, -1.0, 0.0], [0.5, 0.0, 1.0], [1.0, 1.0, 0.0]];
    check("edge on the horizon", edge, polygon(&edge), 5e-3);
    let edge_on = [[0.5, -0.5, 0.5], [0.5, 0.5, 0.5], [1.5, 0.0, 1.5 + 5e-4]];
    check("nearly edge-on", edge_on, polygon(&edge_on), 5e-3);
    let two = [right(1.0).map(|c| c.map(|x| x as f32)), [[-1.0, 0.0, 1.0], [0.0, 1.0, 1.0], [0.0, 0.0, 1.0]]];
    let truth = polygon(&[[0.0, 1.0, 1.0], [1.0, 0.0, 1.0], [-1.0, 0.0, 1.0]]);
    assert_irradiance(&only(triangles(&two)), truth, 2e-3, "two triangles");
}

/// Row 68: nothing is seen of what lies in the receiver's own plane.
#[test]
fn triangle_in_the_plane_of_its_receiver_gives_nothing() {
    let lights = only(triangles(&[[[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 1.0, 0.0]]]));
    assert_eq!(irradiance(&lights, Vec3::ZERO, Vec3::Z, 1 << 10), (0.0, 0.0));
}

#[test]
fn disk_overhead() {
    for r in [1e-6, 1e-3, 1.0, 10.0] {
        let truth = PI * r * r / (1.0 + r * r);
        let lights = lit(disk([0.0, 0.0, 1.0], [r, 0.0, 0.0], [0.0, -r, 0.0], false), 1.0 / truth);
        assert_irradiance(&lights, 1.0, 5e-3, &format!("{r}"));
    }
}

/// Half of a cylinder of radius 1 and length `2 l` whose axis runs across the normal at the distance `h` (Howell, "A
/// catalog of radiation heat transfer configuration factors", B-31).
fn half_cylinder(h: f64, l: f64) -> f64 {
    let (x, y) = ((1.0 + h).powi(2) + l * l, (1.0 - h).powi(2) + l * l);
    let ends = (x - 2.0 * h) / (h * (x * y).sqrt()) * (x * (h - 1.0) / (y * (h + 1.0))).sqrt().atan()
        - ((h - 1.0) / (h + 1.0)).sqrt().atan() / h;
    ((l / (h * h - 1.0).sqrt()).atan() / h + l * ends) / PI
}

#[test]
fn cylinder_overhead() {
    // A very long one fills the share 1 / h.
    assert!((2.0 * half_cylinder(2.0, 1e4) - 0.5).abs() < 1e-6);
    for (h, half_length) in [(2.0, 1.0), (1.1, 1.0), (1.5, 3.0), (30.0, 0.5)] {
        let place = DAffine3::from_cols(DVec3::Z, DVec3::X, 2.0 * half_length * DVec3::Y, DVec3::ZERO);
        let center = DAffine3::from_translation(DVec3::new(0.0, -half_length, h));
        let map = LightAnalytic { render_from_unit: center * place, turned: false, prim: 9 };
        let truth = PI * 2.0 * half_cylinder(h, half_length);
        let lights = lit(LightForm::Cylinder(map), 1.0 / truth);
        assert_irradiance(&lights, 1.0, 2e-2, &format!("length {half_length} at {h}"));
    }
}

/// The drawing by solid angle has no variance but that of the cosine, however near and wide the light.
#[test]
fn near_and_wide_lights_have_little_variance() {
    for (name, form) in [
        ("square", square(1e-3, 1.0)),
        ("triangle", triangles(&[[[-1.0, -1.0, 1e-3], [0.0, 2.0, 1e-3], [1.0, -1.0, 1e-3]]])),
    ] {
        let (mean, sigma) = irradiance(&only(form), Vec3::ZERO, Vec3::Z, 1 << 14);
        // Uniform over the hemisphere: E = π, and 1/√3 of it.
        assert!((mean / PI - 1.0).abs() < 0.01 && sigma < 0.6 * PI, "{name}: {mean} ± {sigma}");
    }
}

#[test]
fn several_lights_add_up() {
    let textures = NO_TEXTURES();
    let bright = Color::Constant([2.0; 3]);
    let shapes = vec![
        LightShape { shape: 0, form: square(1.0, 1.0), emission: WHITE },
        LightShape { shape: 1, form: sphere([0.0, 0.0, 3.0], [1.0; 3], false), emission: bright },
    ];
    let texels = limpid_scenes::Texels::Linear32(vec![0.5; 12]);
    let image = std::sync::Arc::new(limpid_scenes::Image { width: 2, height: 2, texels });
    let kinds = [
        LightKind::EnvMap { image, scale: 1.0, world_from_light: glam::DMat4::IDENTITY },
        LightKind::Constant { radiance: [7.0; 3] },
    ];
    let skies = kinds.map(|kind| SceneLight { name: "sky".into(), kind, place: Place::default() });
    let lights = Lights::from_shapes(shapes, &skies, &textures, DVec3::ZERO, 3.0);
    let truth = PI * (factor(1.0) + 2.0 / 9.0 + 0.5);
    assert_irradiance(&lights, truth, 1e-2, "square, sphere and map");
    // The choice is part of the density; the constant light is never drawn.
    let [map, constant] = lights.miss(Vec3::Z).collect::<Vec<_>>().try_into().unwrap();
    assert!(map.0.x == 0.5 && map.1 > 0.0 && map.1 < 1.0 / (4.0 * PI as f32), "{map:?}");
    assert_eq!(constant, (Rgb::splat(7.0), 0.0));
}
