use super::*;
use crate::metrics;
use crate::testing::Random;

const SIDE: usize = 64;

/// A picture with a gradient, hard edges and a bright disk, as any channel of it.
fn truth() -> Vec<f64> {
    let at = |p: usize| {
        let (x, y) = ((p % SIDE) as f64, (p / SIDE) as f64);
        let checker = if (p % SIDE / 16 + p / SIDE / 16).is_multiple_of(2) { 0.3 } else { 1.0 };
        let disk = (x - 40.0).powi(2) + (y - 24.0).powi(2) < 100.0;
        if disk { 2.0 } else { (0.05 + 0.5 * x / SIDE as f64) * checker }
    };
    (0..SIDE * SIDE).map(at).collect()
}

fn grey(plane: &[f64]) -> Frame {
    let mut frame = Frame::new(SIDE, SIDE);
    let plane: Vec<f32> = plane.iter().map(|v| *v as f32).collect();
    frame.insert_layer(Layer::Beauty, Statistic::Mean, vec![plane; 3]);
    frame
}

/// A frame of `n` samples a pixel, each the truth times a draw of mean 1, and all three channels alike.
fn render(truth: &[f64], n: usize, mut draw: impl FnMut() -> f64) -> Frame {
    let (mut a, mut b, mut mean) = (Vec::new(), Vec::new(), Vec::new());
    for r in truth {
        let samples: Vec<f64> = (0..n).map(|_| r * draw()).collect();
        let (even, odd) = (n.div_ceil(2) as f64, (n / 2) as f64);
        a.push((samples.iter().step_by(2).sum::<f64>() / even) as f32);
        b.push((samples.iter().skip(1).step_by(2).sum::<f64>() / odd) as f32);
        mean.push(samples.iter().sum::<f64>() / n as f64);
    }
    let mut frame = grey(&mean);
    frame.insert_layer(Layer::Beauty, Statistic::A, vec![a; 3]);
    frame.insert_layer(Layer::Beauty, Statistic::B, vec![b; 3]);
    frame.insert("samples.N", vec![n as f32; truth.len()]);
    frame
}

/// Of `trials` pictures, how many intervals hold the actual relMSE, and the geometric mean of
/// estimate / actual.
fn coverage(trials: usize, n: usize, mut draw: impl FnMut() -> f64) -> (usize, f64) {
    let (truth, reference) = (truth(), grey(&truth()));
    let (mut held, mut log_ratio) = (0, 0.0);
    for _ in 0..trials {
        let frame = render(&truth, n, &mut draw);
        let actual = metrics(&frame, &reference).expect("comparable").relmse;
        let estimate = estimate_relmse(&frame).expect("has halves");
        assert!(estimate.low <= estimate.relmse && estimate.relmse <= estimate.high);
        held += usize::from((estimate.low..=estimate.high).contains(&actual));
        log_ratio += (estimate.relmse / actual).ln();
    }
    (held, (log_ratio / trials as f64).exp())
}

// All coverage tests: 40 pictures; at the promised 95 %, fewer than 34 have a chance of 1 in 300.

#[test]
fn gaussian_noise_is_covered_and_estimated_within_a_fifth() {
    let mut random = Random::new(11);
    for n in [4, 5, 64] {
        let (held, ratio) = coverage(40, n, || 1.0 + 0.8 * random.normal());
        assert!(held >= 34, "{n} samples: {held} of 40");
        assert!((0.95..1.2).contains(&ratio), "{n} samples: {ratio}");
    }
}

#[test]
fn rare_lights_are_covered_and_estimated_within_a_third() {
    // One sample in ten finds the light.
    let mut random = Random::new(12);
    for n in [4, 16, 64] {
        let (held, ratio) = coverage(40, n, || if random.uniform() < 0.1 { 10.0 } else { 0.0 });
        assert!(held >= 34, "{n} samples: {held} of 40");
        assert!((0.9..1.34).contains(&ratio), "{n} samples: {ratio}");
    }
}

#[test]
fn fireflies_are_covered_and_not_hidden_by_their_own_brightness() {
    let mut random = Random::new(13);
    let mut draw =
        || 0.7 * (0.5 + random.uniform()) + if random.uniform() < 1.0 / 3000.0 { 900.0 } else { 0.0 };
    for n in [16, 64] {
        let (held, ratio) = coverage(40, n, &mut draw);
        assert!(held >= 34, "{n} samples: {held} of 40");
        assert!((0.7..2.0).contains(&ratio), "{n} samples: {ratio}");
    }
}

#[test]
fn on_a_flat_picture_the_estimate_is_unbiased() {
    // 30 pictures of 4096 pixels, one degree of freedom each: estimate and actual error both scatter by
    // √2/√122880 = 0.4 %; four times their difference is 2.3 %.
    let mut random = Random::new(14);
    let (truth, reference) = (vec![1.0; SIDE * SIDE], grey(&[1.0; SIDE * SIDE]));
    let (mut estimated, mut actual) = (0.0, 0.0);
    for _ in 0..30 {
        let frame = render(&truth, 2, || 1.0 + 0.1 * random.normal());
        estimated += estimate_relmse(&frame).expect("has halves").relmse;
        actual += metrics(&frame, &reference).expect("comparable").relmse;
    }
    assert!((estimated / actual - 1.0).abs() < 0.023, "{estimated} {actual}");
}

#[test]
fn halves_of_unequal_size_are_weighted_by_their_samples() {
    assert_eq!(half_factor(Some(3.0)), 2.0 / 9.0);
    assert_eq!(half_factor(Some(64.0)), 0.25);
    assert_eq!(half_factor(None), 0.25);
    for none in [0.0, 1.0, -1.0, f32::NAN, f32::INFINITY] {
        assert_eq!(half_factor(Some(none)), 0.0);
    }
}

#[test]
fn without_halves_there_is_no_estimate() {
    assert_eq!(estimate_relmse(&grey(&truth())), None);
    assert_eq!(estimate_relmse(&Frame::new(0, 0)), None);
    let mut one_sample = render(&truth(), 2, || 1.0);
    one_sample.insert("samples.N", vec![1.0; SIDE * SIDE]);
    assert_eq!(estimate_relmse(&one_sample), None);
}

#[test]
fn equal_halves_mean_no_error() {
    let frame = render(&truth(), 2, || 1.0);
    let expected = ErrorEstimate { relmse: 0.0, low: 0.0, high: 0.0 };
    assert_eq!(estimate_relmse(&frame), Some(expected));
}

#[test]
fn odd_frames_give_finite_numbers() {
    let mut random = Random::new(15);
    for (width, height) in [(1, 1), (1, 9), (9, 1), (3, 2)] {
        let mut frame = Frame::new(width, height);
        for name in ["R", "G", "B", "a.R", "a.G", "a.B", "b.R", "b.G", "b.B"] {
            frame.insert(name, (0..width * height).map(|_| random.normal() as f32 * 1e30).collect());
        }
        let estimate = estimate_relmse(&frame).expect("has halves");
        assert!(estimate.low >= 0.0 && estimate.high.is_finite(), "{width}x{height}: {estimate:?}");
    }
}

#[test]
fn a_pixel_that_is_not_finite_changes_nothing_but_its_neighbours() {
    let mut random = Random::new(16);
    let frame = render(&truth(), 4, || 1.0 + 0.5 * random.normal());
    let whole = estimate_relmse(&frame).expect("has halves");
    let mut broken = frame.clone();
    let mut plane = frame.channel("a.G").expect("is there").to_vec();
    plane[1000] = f32::NAN;
    broken.insert("a.G", plane);
    let without = estimate_relmse(&broken).expect("has halves");
    assert!((without.relmse / whole.relmse - 1.0).abs() < 0.05);
}
