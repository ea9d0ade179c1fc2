use std::f32::consts::{FRAC_1_PI, PI, TAU};

use super::*;

/// Uniform over the upper hemisphere.
fn hemisphere(u: Vec2) -> Vec3 {
    let sin = ((1.0 - u.x) * (1.0 + u.x)).sqrt();
    Vec3::new(sin * (TAU * u.y).cos(), sin * (TAU * u.y).sin(), u.x)
}

/// cosⁿ⁺¹ is uniform: a lobe around +z, narrow for a large n; density (n + 1) cosⁿ / 2π.
fn lobe(u: Vec2, n: f32) -> Vec3 {
    let one_minus_cos = -((1.0 - u.x).ln() / (n + 1.0)).exp_m1();
    let sin = (one_minus_cos * (2.0 - one_minus_cos)).sqrt();
    Vec3::new(sin * (TAU * u.y).cos(), sin * (TAU * u.y).sin(), 1.0 - one_minus_cos)
}

#[test]
fn right_densities_pass() {
    assert_chi2(|_, u| Some(hemisphere(u)), |w| if w.z > 0.0 { 0.5 * FRAC_1_PI } else { 0.0 });
    assert_chi2(
        |_, u| Some(lobe(u, 1e4)),
        |w| {
            let one_minus_cos = 0.5 * (w.x * w.x + w.y * w.y + (1.0 - w.z) * (1.0 - w.z));
            (1e4 + 1.0) * (1e4 * (-one_minus_cos.min(1.0)).ln_1p()).exp() / TAU
        },
    );
    assert_chi2_1d(|u| u.sqrt(), |x| 2.0 * f64::from(x), 0.0, 1.0);
    assert_chi2_2d(|u| Some(Vec2::new(u.x.sqrt(), u.y)), |p| 2.0 * f64::from(p.x), Vec2::ZERO, Vec2::ONE);
}

#[test]
fn draws_may_be_refused() {
    let half = |_: f32, u: Vec2| Some(hemisphere(u)).filter(|w| w.x > 0.0);
    assert_chi2(half, |w| if w.z > 0.0 && w.x > 0.0 { 0.5 * FRAC_1_PI } else { 0.0 });
    assert!(chi2(half, |w| if w.z > 0.0 { 0.5 * FRAC_1_PI } else { 0.0 }).p < 1e-9);
}

#[test]
fn a_density_off_by_three_per_cent_is_found() {
    let right = |w: Vec3| if w.z > 0.0 { 0.5 * FRAC_1_PI } else { 0.0 };
    let draw = |_: f32, u: Vec2| Some(hemisphere(u));
    // In scale, from half to half across and along the azimuth, and in the middle of the cosine.
    for (what, wrong) in [
        ("scale up", (|_| 1.03) as fn(Vec3) -> f32),
        ("scale down", |_| 0.97),
        ("left and right", |w| 1.0 + 0.03 * w.x.signum()),
        ("waves of the azimuth", |w| 1.0 + 0.03 * (3.0 * w.y.atan2(w.x)).cos().signum()),
        ("high and low", |w| 1.0 + 0.03 * (w.z - 0.5).signum()),
    ] {
        let test = chi2(draw, |w| right(w) * wrong(w));
        assert!(test.p < FALSE_ALARM, "{what}: {test:?}");
    }
    let line = chi2_2d(Some, |p| 1.0 + 0.03 * f64::from((p.x - 0.5).signum()), Vec2::ZERO, Vec2::ONE);
    assert!(line.p < FALSE_ALARM, "{line:?}");
}

#[test]
fn a_horizon_across_the_cells_is_no_difference() {
    // A lobe leaning to the horizon, which cuts it, so that some cells have no more than a corner above.
    for tilt in [0.9f32, 1.2, 1.4] {
        let (sin, cos) = tilt.sin_cos();
        let turn = |w: Vec3| Vec3::new(cos * w.x + sin * w.z, w.y, cos * w.z - sin * w.x);
        let back = |w: Vec3| cos * w.z + sin * w.x;
        assert_chi2(
            |_, u| Some(turn(lobe(u, 8.0))).filter(|w| w.z > 0.0),
            |w| if w.z > 0.0 { 9.0 / TAU * back(w).max(0.0).powf(8.0) } else { 0.0 },
        );
    }
}

#[test]
fn draws_where_the_density_is_zero_are_found() {
    // One draw in a thousand goes below the horizon.
    let draw = |lobe: f32, u: Vec2| Some(if lobe < 1e-3 { -hemisphere(u) } else { hemisphere(u) });
    let test = chi2(draw, |w| if w.z > 0.0 { 0.5 * FRAC_1_PI } else { 0.0 });
    assert!(test.p < FALSE_ALARM, "{test:?}");
}

#[test]
fn p_values_of_right_densities_are_uniform() {
    // 60 lobes of their own widths and draws. Counts below 0.1, 0.5 and 0.9 stay within 4.5 standard deviations: false alarm
    // 2e-5. Too small a p too often is a false alarm, too seldom a loss of power.
    let p: Vec<f64> = (0..60)
        .map(|i| {
            let mut random = Random::new(i);
            let n = 1.0 + 9.0 * random.uniform();
            let shift = random.uniform2();
            let draw = |_: f32, u: Vec2| Some(lobe((u + shift).fract_gl(), n));
            chi2(draw, |w| if w.z > 0.0 { (n + 1.0) * w.z.powf(n) * 0.5 / PI } else { 0.0 }).p
        })
        .collect();
    for level in [0.1, 0.5, 0.9] {
        let count = p.iter().filter(|&&p| p < level).count() as f64;
        let sigma = (60.0 * level * (1.0 - level)).sqrt();
        assert!((count - 60.0 * level).abs() < 4.5 * sigma, "{count} of 60 below {level}");
    }
}
