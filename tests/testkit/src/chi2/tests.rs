use std::f32::consts::FRAC_1_PI;

use super::*;

fn cosine(u: Vec2) -> Vec3 {
    let (r, phi) = (u.x.sqrt(), std::f32::consts::TAU * u.y);
    Vec3::new(r * phi.cos(), r * phi.sin(), (1.0 - u.x).sqrt())
}

fn cosine_pdf(w: Vec3) -> f32 {
    w.z.max(0.0) * FRAC_1_PI
}

#[test]
fn right_density_passes() {
    let result = sphere(|_, u| Some(cosine(u)), cosine_pdf);
    assert!(result.p > 0.01 && result.degrees > 30, "{result:?}");
}

#[test]
fn density_that_is_wrong_by_two_per_cent_is_found() {
    // All integrate to 1, so that only the shape can tell.
    for (name, factor) in [
        ("height", (|w: Vec3| 1.0 + 0.06 * (w.z - 2.0 / 3.0)) as fn(Vec3) -> f32), // -4 % to 2 %
        ("side", |w| 1.0 + 0.02 * w.x),
        ("halves", |w| if w.y > 0.0 { 1.01 } else { 0.99 }),
    ] {
        let result = sphere(|_, u| Some(cosine(u)), |w| cosine_pdf(w) * factor(w));
        assert!(result.p < FALSE_ALARM, "{name}: {result:?}");
    }
}

#[test]
fn density_that_integrates_to_too_little_or_too_much_is_found() {
    for factor in [0.99, 1.01] {
        let result = sphere(|_, u| Some(cosine(u)), |w| factor * cosine_pdf(w));
        assert!(result.p < FALSE_ALARM, "{factor}: {result:?}");
    }
}

#[test]
fn missing_draws_count() {
    let result = sphere(|lobe, u| (lobe < 0.75).then(|| cosine(u)), |w| 0.75 * cosine_pdf(w));
    assert!(result.p > 0.01, "{result:?}");
    let result = sphere(|lobe, u| (lobe < 0.75).then(|| cosine(u)), |w| 0.76 * cosine_pdf(w));
    assert!(result.p < FALSE_ALARM, "{result:?}");
}

#[test]
fn draws_outside_the_support_are_found() {
    let sunk = |lobe: f32, u| Some(if lobe < 1e-4 { -cosine(u) } else { cosine(u) });
    let result = sphere(sunk, cosine_pdf);
    assert!(result.p < FALSE_ALARM, "{result:?}");
}

#[test]
fn narrow_lobe_spreads_over_many_cells() {
    // Around +x, with 1 − cos θ exponential: 2° wide.
    const WIDTH: f32 = 1e-3;
    let draw = |u: Vec2| {
        let (height, phi) = (-WIDTH * (1.0 - u.x).ln(), std::f32::consts::TAU * u.y);
        let r = (height * (2.0 - height)).sqrt();
        Vec3::new(1.0 - height, r * phi.cos(), r * phi.sin())
    };
    let pdf = |w: Vec3| {
        let height = (w.y * w.y + w.z * w.z) / (1.0 + w.x.abs());
        if w.x > 0.0 { (-height / WIDTH).exp() / (std::f32::consts::TAU * WIDTH) } else { 0.0 }
    };
    let result = sphere(|_, u| Some(draw(u)), pdf);
    assert!(result.p > 0.01 && result.degrees > 30, "{result:?}");
    let result = sphere(|_, u| Some(draw(u)), |w| pdf(w) * (1.0 + 0.6 * w.y)); // 0.03 wide: ±2 %
    assert!(result.p < FALSE_ALARM, "{result:?}");
}

#[test]
fn square_and_discrete_tests_tell_right_from_wrong() {
    let draw = |u: Vec2| Vec2::new(u.x.sqrt(), u.y);
    assert!(square(draw, |p| 2.0 * p.x).p > 0.01);
    assert!(square(draw, |p| 2.0 * p.x * (1.0 + 0.04 * (p.y - 0.5))).p < FALSE_ALARM);
    let index = |u: f32| usize::from(u >= 0.25) + usize::from(u >= 0.75);
    assert!(discrete(index, &[0.25, 0.5, 0.25]).p > 0.01);
    assert!(discrete(index, &[0.253, 0.497, 0.25]).p < FALSE_ALARM);
    assert!(discrete(index, &[0.25, 0.75, 0.0]).p < FALSE_ALARM);
}

#[test]
fn false_alarms_are_as_rare_as_stated() {
    // p-values of right densities are uniform: of 200 tests (each of another routine, since the draws are the same)
    // between 0 and 8 fall below 1 % but with probability 2e-4.
    let low = (0..200)
        .filter(|&i| {
            let turn = i as f32 / 200.0;
            discrete(|u| ((u + turn).fract() * 37.0 * (1.0 + turn)) as usize % 37, &exact(37, turn)).p < 0.01
        })
        .count();
    assert!(low <= 8, "{low} of 200");
}

/// Probabilities of the index drawn above: of [0, 37 (1 + turn)) folded into 37 cells.
fn exact(cells: usize, turn: f32) -> Vec<f64> {
    let length = cells as f64 * (1.0 + f64::from(turn));
    let covered = |i: usize| {
        (0..2).map(|fold| (length - (i + fold * cells) as f64).clamp(0.0, 1.0)).sum::<f64>() / length
    };
    (0..cells).map(covered).collect()
}
