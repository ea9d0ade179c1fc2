use limpid_scenes::Texels;

use super::*;
use crate::sampling::{Dim, PixelSampler};
use crate::settings::Sampler;

fn map(width: u32, height: u32, texel: impl Fn(u32, u32) -> [f32; 3]) -> Arc<Image> {
    let values =
        (0..height).flat_map(|j| (0..width).map(move |i| (i, j))).flat_map(|(i, j)| texel(i, j)).collect();
    Arc::new(Image { width, height, texels: Texels::Linear32(values) })
}

fn plain(image: Arc<Image>) -> EnvMap {
    EnvMap::new(image, 1.0, DMat4::IDENTITY)
}

// What Mitsuba 3.9.1 gives for an 8×4 picture of (column, row, 1).
#[test]
#[allow(clippy::approx_constant)]
fn directions_are_looked_up_as_in_mitsuba() {
    let image = map(8, 4, |i, j| [i as f32, j as f32, 1.0]);
    let light = plain(image.clone());
    #[rustfmt::skip]
    let polar = [(0.001, 9.325743e-4), (0.3, 0.28647882), (1.0, 0.9549296), (2.0, 1.9098592), (3.14, 2.9984891)];
    for (theta, row) in polar {
        let (radiance, _) = light.eval(Vec3::new(0.0, f32::cos(theta), f32::sin(theta)));
        assert!((radiance - Rgb::new(3.5, row, 1.0)).abs().max_element() < 1e-4, "{theta}: {radiance}");
    }
    for (phi, column) in
        [(-2.7488935, 7.0), (-1.5707964, 5.5), (0.0, 3.5), (0.7853982, 2.5), (2.3561945, 0.5)]
    {
        let (radiance, _) = light.eval(Vec3::new(f32::sin(phi), 0.0, f32::cos(phi)));
        assert!((radiance - Rgb::new(column, 1.5, 1.0)).abs().max_element() < 1e-4, "{phi}: {radiance}");
    }
    // Across the seam between the last column and the first.
    assert!((light.eval(Vec3::NEG_Z).0.x - 3.5).abs() < 1e-4);
    // Turned about x by 90°, doubled.
    let turned = EnvMap::new(image, 2.0, DMat4::from_rotation_x(PI / 2.0));
    for (d, truth) in [
        ([0.36, 0.48, 0.8], [0.638661, 1.228997, 2.0]),
        ([-0.36, 0.48, -0.8], [13.361341, 4.771004, 2.0]),
        ([0.8, -0.36, 0.48], [4.076788, 2.04382, 2.0]),
        ([-0.48, -0.8, -0.36], [8.376167, 3.70334, 2.0]),
    ] {
        let (radiance, _) = turned.eval(Vec3::from(d));
        assert!((radiance - Rgb::from(truth)).abs().max_element() < 1e-4, "{d:?}: {radiance}");
    }
}

/// Mean and standard deviation of one sample of the irradiance of a floor with this normal.
fn irradiance(light: &EnvMap, normal: Vec3) -> (f64, f64) {
    let n = 1 << 14;
    let (mut sum, mut squares) = (0.0, 0.0);
    for i in 0..n {
        let u = PixelSampler::new(Sampler::Sobol, 1, 0, [0, 0], i).draw2(Dim::Light(0));
        let wi = light.sample(u.as_dvec2()).expect("not black").as_vec3();
        let (radiance, pdf) = light.eval(wi);
        assert!(pdf > 0.0 && pdf.is_finite(), "{wi} {radiance} {pdf}");
        let x = f64::from(radiance.x) * f64::from(wi.dot(normal).max(0.0)) / pdf;
        sum += x;
        squares += x * x;
    }
    let mean = sum / f64::from(n);
    (mean, (squares / f64::from(n) - mean * mean).max(0.0).sqrt())
}

/// The same by quadrature of the map's own look-up.
fn quadrature(light: &EnvMap, normal: Vec3, steps: u32) -> f64 {
    let mut sum = 0.0;
    for k in 0..2 * steps * steps {
        let (z, phi) = (
            1.0 - (f64::from(k / (2 * steps)) + 0.5) * 2.0 / f64::from(steps),
            PI * f64::from(k % (2 * steps)) / f64::from(steps),
        );
        let r = (1.0 - z * z).sqrt();
        let wi = DVec3::new(r * phi.sin(), z, r * phi.cos()).as_vec3();
        sum += f64::from(light.eval(wi).0.x) * f64::from(wi.dot(normal).max(0.0));
    }
    sum * 4.0 * PI / f64::from(2 * steps * steps)
}

/// Row 15 of the hard cases.
#[test]
fn sun_of_one_texel_is_found_with_little_variance() {
    for sun in [1e2f32, 1e4, 1e6] {
        let light = plain(map(64, 32, |i, j| match (i, j) {
            (20, 5) => [sun; 3],
            (_, 10 | 11) => [0.0; 3],
            _ => [0.01; 3],
        }));
        let truth = quadrature(&light, Vec3::Y, 1024);
        let (mean, sigma) = irradiance(&light, Vec3::Y);
        assert!((mean / truth - 1.0).abs() < 5e-3, "{sun}: {mean}, not {truth}");
        assert!(sun < 1e6 || sigma < 0.1 * mean, "{sun}: {mean} ± {sigma}");
    }
}

#[test]
fn suns_anywhere_are_found() {
    for row in 0..9 {
        let light = plain(map(6, 9, |i, j| [if (i, j) == (0, row) { 1e3 } else { 0.0 }; 3]));
        for normal in [Vec3::Y, Vec3::NEG_Y, Vec3::X] {
            let (truth, (mean, sigma)) = (quadrature(&light, normal, 256), irradiance(&light, normal));
            assert!((mean - truth).abs() < 0.01 * truth.max(1.0), "row {row} {normal}: {mean}, not {truth}");
            assert!(sigma < 2.0 * mean.max(1.0) + 100.0, "row {row} {normal}: {mean} ± {sigma}");
        }
    }
}

#[test]
fn whatever_shines_is_drawn() {
    // Densities follow the radiance within a factor, even around the poles, where a cell is a triangle.
    for bright in [[0, 0], [2, 0], [1, 1], [3, 4], [0, 7]] {
        let light = plain(map(4, 8, |i, j| [if [i, j] == bright { 1.0 } else { 0.0 }; 3]));
        let total = quadrature(&light, Vec3::Y, 64) + quadrature(&light, Vec3::NEG_Y, 64);
        assert!(total > 0.0);
        for k in 0..20_000 {
            let u = PixelSampler::new(Sampler::Sobol, 2, 0, [0, 0], k).draw2(Dim::Light(0)).as_dvec2();
            let (z, phi) = (1.0 - 2.0 * u.x, TAU * u.y);
            let r = (1.0 - z * z).sqrt();
            let wi = DVec3::new(r * phi.cos(), r * phi.sin(), z).as_vec3();
            let (radiance, pdf) = light.eval(wi);
            assert_eq!(radiance.x > 0.0, pdf > 0.0, "{bright:?} {wi}: {radiance} {pdf}");
        }
    }
}

/// Row 16 of the hard cases.
#[test]
fn bad_texels_count_as_black_and_are_counted() {
    let with =
        |bad: f32| plain(map(32, 16, |i, j| if (i, j) == (7, 3) { [bad, 0.5, 0.5] } else { [0.5; 3] }));
    let black = plain(map(32, 16, |i, j| if (i, j) == (7, 3) { [0.0; 3] } else { [0.5; 3] }));
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        assert_eq!(with(bad).bad_texels(), 1);
        for normal in [Vec3::Y, Vec3::X] {
            assert_eq!(irradiance(&with(bad), normal), irradiance(&black, normal));
        }
    }
    // Of a negative texel its own channel alone.
    assert_eq!(with(-5.0).bad_texels(), 1);
    assert_eq!(quadrature(&with(-5.0), Vec3::Y, 256), quadrature(&black, Vec3::Y, 256));
    assert_eq!(black.bad_texels(), 0);
}

#[test]
fn black_maps_are_never_drawn() {
    for image in [map(4, 4, |_, _| [0.0; 3]), map(1, 1, |_, _| [f32::NAN; 3])] {
        let light = plain(image);
        assert_eq!(light.integral(), (0.0, true));
        assert!(light.sample(DVec2::splat(0.3)).is_none());
        assert_eq!(light.eval(Vec3::X), (Rgb::ZERO, 0.0));
    }
}

#[test]
fn maps_of_one_texel_are_constant() {
    let light = plain(map(1, 1, |_, _| [2.0; 3]));
    for d in [Vec3::Y, Vec3::NEG_Y, Vec3::NEG_Z, Vec3::new(-1e-20, 0.0, -1.0)] {
        let (radiance, pdf) = light.eval(d);
        assert!(
            (radiance.x - 2.0).abs() < 1e-6 && (pdf * 4.0 * PI - 1.0).abs() < 1e-9,
            "{d}: {radiance} {pdf}"
        );
    }
    assert!((light.integral().0 / (8.0 * PI) - 1.0).abs() < 1e-6);
}

#[test]
fn odd_maps_and_directions_do_no_harm() {
    let huge = map(3, 3, |i, j| [if i == j { f32::MAX } else { 1e-40 }; 3]);
    for matrix in [DMat4::IDENTITY, DMat4::ZERO, DMat4::from_scale(DVec3::new(1.0, 0.0, 1.0)), DMat4::NAN] {
        let light = EnvMap::new(huge.clone(), 1.0, matrix);
        for d in [Vec3::ZERO, Vec3::NAN, Vec3::INFINITY, Vec3::Y, Vec3::NEG_Y, Vec3::new(0.0, 1.0, -0.0)] {
            let (radiance, pdf) = light.eval(d);
            assert!(!radiance.is_nan() && !pdf.is_nan() && pdf >= 0.0, "{d}: {radiance} {pdf}");
        }
        for u in [DVec2::ZERO, DVec2::splat(1.0 - 1e-16), DVec2::new(0.0, 1.0 - 1e-16)] {
            assert!(light.sample(u).is_none_or(|d| d.is_finite()));
        }
    }
}
