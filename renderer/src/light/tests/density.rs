//! What is drawn follows the density that is given for it.

use super::*;

/// Sum of the densities and radiance of what is seen in a direction.
fn seen(lights: &Lights, textures: &Textures, form: Option<&LightForm>, p: Vec3, wi: Vec3) -> f64 {
    let Some(form) = form else { return lights.miss(wi).map(|(_, pdf)| f64::from(pdf)).sum() };
    let densities = intersect(form, p, wi).into_iter().map(|at| {
        let (radiance, pdf) = lights.hit_at(LightId(0), p, &at, wi, textures);
        if radiance == Rgb::ZERO { 0.0 } else { f64::from(pdf) }
    });
    densities.sum()
}

/// Directions on a grid of cells of equal solid angle over a cone.
struct Cone {
    frame: [DVec3; 3],
    one_minus_cos: f64,
}

const CELLS: usize = 16;
const FINE: usize = 24;
const SAMPLES: u32 = 100_000;

impl Cone {
    /// Around all directions that are drawn from `p`.
    fn around(lights: &Lights, textures: &Textures, p: Vec3) -> Self {
        let samples = (0..2000).filter_map(|i| {
            let (choice, u) = numbers(Sampler::Independent, i + 500_000);
            lights.sample(p, choice, u, textures).map(|s| s.wi.as_dvec3())
        });
        let directions: Vec<_> = samples.collect();
        let z = directions.iter().sum::<DVec3>().normalize_or(DVec3::Z);
        let widest = directions.iter().map(|d| 1.0 - d.dot(z)).fold(0.0, f64::max);
        let (x, y) = z.any_orthonormal_pair();
        Self { frame: [x, y, z], one_minus_cos: (1.5 * widest).min(2.0) }
    }

    fn direction(&self, u: f64, v: f64) -> Vec3 {
        let z = self.one_minus_cos * u;
        let (r, phi) = ((z * (2.0 - z)).sqrt(), 2.0 * PI * v);
        let [x, y, axis] = self.frame;
        (r * phi.cos() * x + r * phi.sin() * y + (1.0 - z) * axis).as_vec3()
    }

    fn cell(&self, d: DVec3) -> usize {
        let [x, y, z] = self.frame.map(|axis| axis.dot(d));
        // From the sine for narrow cones.
        let one_minus_cos = if z > 0.0 { (x * x + y * y) / (1.0 + z) } else { 1.0 - z };
        let u = (one_minus_cos / self.one_minus_cos * CELLS as f64) as usize;
        let v = ((y.atan2(x) / (2.0 * PI)).rem_euclid(1.0) * CELLS as f64) as usize;
        u.min(CELLS - 1) * CELLS + v.min(CELLS - 1)
    }

    /// Probability of each cell by quadrature of the density.
    fn expected(&self, pdf: impl Fn(Vec3) -> f64) -> Vec<f64> {
        let at = |cell: usize, k: usize| (cell as f64 + (k as f64 + 0.5) / FINE as f64) / CELLS as f64;
        let solid = 2.0 * PI * self.one_minus_cos / (CELLS * CELLS * FINE * FINE) as f64;
        (0..CELLS * CELLS)
            .map(|cell| {
                let points = (0..FINE * FINE)
                    .map(|k| self.direction(at(cell / CELLS, k / FINE), at(cell % CELLS, k % FINE)));
                points.map(&pdf).sum::<f64>() * solid
            })
            .collect()
    }
}

/// χ² of the samples against the density; what is drawn in vain is the rest of 1. The bound is 5 standard
/// deviations of a χ² with this many degrees of freedom: a right density would fail for one seed in about 1e5.
fn assert_chi2(name: &str, lights: &Lights, textures: &Textures, form: Option<&LightForm>, p: Vec3) {
    let cone = Cone::around(lights, textures, p);
    let expected = cone.expected(|wi| seen(lights, textures, form, p, wi));
    let mut counts = vec![0.0; expected.len() + 1];
    for i in 0..SAMPLES {
        let (choice, u) = numbers(Sampler::Independent, i);
        let drawn = lights.sample(p, choice, u, textures);
        counts[drawn.map_or(expected.len(), |s| cone.cell(s.wi.as_dvec3()))] += 1.0;
    }
    let vain = 1.0 - expected.iter().sum::<f64>();
    assert!(vain > -0.005, "{name} from {p}: the density integrates to {}", 1.0 - vain);
    let share = counts[expected.len()] / f64::from(SAMPLES);
    assert!((vain - share).abs() < 0.01, "{name} from {p}: {share} are drawn in vain, not {vain}");

    // The quadrature is off by one or two per cent of a full cell where an edge runs through it.
    let slack = 0.015 * f64::from(SAMPLES) * expected.iter().copied().fold(0.0, f64::max);
    let term = |count: f64, e: f64| (count - e).powi(2) / (e + slack * slack);
    let (mut chi2, mut cells, mut rest) = (0.0, 0.0, [0.0; 2]);
    for (count, e) in counts.into_iter().zip(expected.into_iter().map(|e| e * f64::from(SAMPLES))) {
        if e < 50.0 {
            rest = [rest[0] + count, rest[1] + e];
        } else {
            (chi2, cells) = (chi2 + term(count, e), cells + 1.0);
        }
    }
    if rest[1] > 50.0 {
        (chi2, cells) = (chi2 + term(rest[0], rest[1]), cells + 1.0);
    }
    let dof: f64 = cells - 1.0;
    assert!(dof > 5.0, "{name} from {p}: nothing is drawn");
    assert!(chi2 < dof + 5.0 * (2.0 * dof).sqrt() + 10.0, "{name} from {p}: χ² = {chi2} of {dof}");
}

#[test]
fn samples_of_surfaces_follow_their_density() {
    for (name, form, points) in cases() {
        let lights = only(form.clone());
        for p in points {
            assert_chi2(name, &lights, &NO_TEXTURES(), Some(&form), p);
        }
    }
}

#[test]
fn samples_of_textured_surfaces_follow_their_density() {
    // No texel is black: where nothing is emitted, `seen` cannot tell the front from the back.
    let textures = picture(4, 3, |i| [1.0 + ((i * 7919) % 13) as f32; 3]);
    for (name, form, points) in cases() {
        let lights = with_emission(form.clone(), Color::Texture(TextureId(0)), &textures);
        for p in points {
            assert_chi2(&format!("textured {name}"), &lights, &textures, Some(&form), p);
        }
    }
}

#[test]
fn bright_triangles_are_drawn_in_proportion() {
    // The two halves of the unit square in uv: one sees the bright column of the picture, the other the dark one.
    let mut pair = [triangle([[0.0; 3], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]], 20); 2];
    pair[1].prim = 21;
    pair[0].uvs = [Vec2::new(0.05, 0.0), Vec2::new(0.45, 0.0), Vec2::new(0.25, 1.0)];
    pair[1].uvs = [Vec2::new(0.55, 0.0), Vec2::new(0.95, 0.0), Vec2::new(0.75, 1.0)];
    let textures = picture(2, 1, |i| [[3.0, 1.0][i]; 3]);
    let lights = with_emission(LightForm::Triangles(pair.to_vec()), Color::Texture(TextureId(0)), &textures);
    let bright = (0..10_000u32).filter(|&i| {
        let (choice, u) = numbers(Sampler::Sobol, i);
        lights.sample(Vec3::NEG_Z, choice, u, &textures).unwrap().skip == 20
    });
    let share = bright.count() as f64 / 1e4;
    // 3 : 1, and a twentieth of the mean 2 for each.
    assert!((share - 3.1 / 4.2).abs() < 0.01, "{share}");
}

#[test]
fn samples_of_infinite_lights_follow_their_density() {
    for (width, height) in [(8, 5), (5, 1), (1, 7)] {
        let values = (0..width * height * 3).map(|i| ((i * 7919) % 13) as f32).collect();
        let image = limpid_scenes::Image { width, height, texels: limpid_scenes::Texels::Linear32(values) };
        // Scaled unevenly, mirrored and turned.
        let linear = DMat3::from_axis_angle(DVec3::X, 1.0) * DMat3::from_diagonal(DVec3::new(1.0, -2.0, 1.5));
        let kind = LightKind::EnvMap {
            image: std::sync::Arc::new(image),
            scale: 2.0,
            world_from_light: glam::DMat4::from_mat3(linear),
        };
        assert_chi2(&format!("{width}x{height} map"), &infinite(kind), &NO_TEXTURES(), None, Vec3::ZERO);
    }
}

/// A day of which light space is turned, mirrored and scaled.
fn day(elevation_deg: f64) -> limpid_scenes::Daylight {
    let (sin, cos) = elevation_deg.to_radians().sin_cos();
    let turn = DMat3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 1.0) * 2.0;
    limpid_scenes::Daylight {
        sun: DVec3::new(0.6 * cos, sin, -0.8 * cos),
        turbidity: 3.0,
        albedo: [0.3; 3],
        world_from_light: glam::DMat4::from_mat3(turn * DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0))),
    }
}

#[test]
fn samples_of_the_sky_follow_their_density() {
    for elevation in [2.0, 30.0, 90.0] {
        let lights = infinite(LightKind::Sky { daylight: day(elevation), scale: 2.0 });
        assert_chi2(&format!("sky at {elevation}"), &lights, &NO_TEXTURES(), None, Vec3::ZERO);
    }
}

#[test]
fn samples_of_the_sky_weigh_much_alike() {
    for elevation in [1.0, 10.0, 45.0] {
        let lights = infinite(LightKind::Sky { daylight: day(elevation), scale: 1.0 });
        let (mut sum, mut squares, mut largest, n) = (0.0, 0.0, 0.0f64, 1 << 14);
        for i in 0..n {
            let (choice, u) = numbers(Sampler::Sobol, i);
            let Some(s) = lights.sample(Vec3::ZERO, choice, u, &NO_TEXTURES()) else { continue };
            let weight = f64::from(crate::color::luminance(s.radiance) / s.pdf);
            (sum, squares, largest) = (sum + weight, squares + weight * weight, largest.max(weight));
        }
        let mean = sum / f64::from(n);
        let deviation = (squares / f64::from(n) / (mean * mean) - 1.0).sqrt();
        println!("sun at {elevation}: deviation {deviation:.3}, largest {:.2} of the mean", largest / mean);
        assert!(deviation < 0.2 && largest < 3.0 * mean, "{elevation}: {deviation} {largest} {mean}");
    }
}

#[test]
fn samples_of_the_sun_follow_their_density() {
    let day = day(60.0);
    let direction = day.world_from_light.transform_vector3(day.sun).normalize();
    for half_deg in [0.05, 0.27, 20.0, 90.0] {
        let lights = infinite(LightKind::Sun { daylight: day, half_deg, scale: 1e-3 });
        assert_chi2(&format!("sun of {half_deg}"), &lights, &NO_TEXTURES(), None, Vec3::ZERO);
        if half_deg > 60.0 {
            continue; // the horizon takes a part of its light
        }
        // Across the sun: E = π sin² L.
        let truth = PI * half_deg.to_radians().sin().powi(2) * 1e-3 * f64::from(day.sun(half_deg)[0]);
        let irradiance = irradiance_across(&lights, direction);
        assert!((irradiance / truth - 1.0).abs() < 1e-3, "{half_deg}: {irradiance} {truth}");
    }
}

#[test]
fn the_horizon_cuts_the_sun() {
    let day = day(0.0);
    let direction = day.world_from_light.transform_vector3(day.sun).normalize();
    for half_deg in [0.3f64, 10.0] {
        let lights = infinite(LightKind::Sun { daylight: day, half_deg, scale: 1.0 });
        let whole = PI * half_deg.to_radians().sin().powi(2) * f64::from(day.sun(half_deg)[0]);
        let share = irradiance_across(&lights, direction) / whole;
        assert!((share - 0.5).abs() < 1e-3, "{half_deg}: {share}");
        let up = day.world_from_light.transform_vector3(DVec3::Y).normalize();
        let lower = (direction - 0.5 * half_deg.to_radians() * up).normalize().as_vec3();
        assert!(lights.miss(lower).all(|(radiance, pdf)| radiance == crate::color::Rgb::ZERO && pdf > 0.0));
    }
}

/// Irradiance in red on a surface across `normal`.
fn irradiance_across(lights: &Lights, normal: DVec3) -> f64 {
    let samples = 1 << 12;
    let share = |i| {
        let (choice, u) = numbers(Sampler::Sobol, i);
        let s = lights.sample(Vec3::ZERO, choice, u, &NO_TEXTURES()).unwrap();
        f64::from(s.radiance.x / s.pdf) * s.wi.as_dvec3().dot(normal) / f64::from(samples)
    };
    (0..samples).map(share).sum()
}

#[test]
fn samples_and_hits_agree() {
    let textures = NO_TEXTURES();
    for (name, form, points) in cases() {
        let lights = only(form.clone());
        for p in points {
            let (mut drawn, mut found) = (0, 0);
            for i in 0..2000 {
                let (choice, u) = numbers(Sampler::Sobol, i);
                let Some(s) = lights.sample(p, choice, u, &textures) else { continue };
                drawn += 1;
                assert!((s.wi.length() - 1.0).abs() < 1e-6, "{name}");
                let hits = intersect(&form, p, s.wi);
                // None at the rim, by rounding.
                let nearest = hits
                    .iter()
                    .filter(|at| at.ng.dot(s.wi) < 0.0)
                    .min_by(|a, b| a.p.distance_squared(p).total_cmp(&b.p.distance_squared(p)));
                let Some(at) = nearest else { continue };
                let (radiance, pdf) = lights.hit_at(LightId(0), p, at, s.wi, &textures);
                // Grazing, the rounding of the direction moves the hit, and along a curved wall turns the normal.
                let cos = at.ng.dot(s.wi).abs();
                let slack = 3e-5 + 2e-6 / cos + 2e-7 * at.p.distance(p) / (cos * cos);
                if (pdf / s.pdf - 1.0).abs() > slack
                    || (at.p.distance(p) / s.t_max - 1.0).abs() > 1e-5 + slack
                {
                    assert!(at.prim != s.skip, "{name} from {p}: pdf {pdf}, not {}; {s:?}", s.pdf);
                    continue;
                }
                assert_eq!(radiance, s.radiance, "{name}");
                found += 1;
            }
            assert!(
                drawn > 100 && f64::from(found) > 0.98 * f64::from(drawn),
                "{name} from {p}: {found} of {drawn}"
            );
        }
    }
}
