//! How noisy each pixel is.

use crate::plane::{Plane, Size, box_mean, map2};
use crate::wrap::repair::squared;

/// Radius of the box over which both estimates of the level are compared: 21 x 21 pixels, as in
/// Rousselle et al. 2013 and Kalantari et al. 2015.
const LEVEL_RADIUS: usize = 10;
/// Radius of the box that smooths what has one degree of freedom a pixel.
const LOCAL_RADIUS: usize = 3;

/// Variance of one channel's mean, from what is known of it:
///
/// - sample variance and halves: the first, rescaled where samples are stratified to the level of the
///   second, `V · box((a − b)²/4) / box(V)` (Rousselle et al. 2013, section 4.1);
/// - one of both: that one, the halves' smoothed;
/// - neither (or −1, "unknown", in the variance): [`spatial`].
///
/// Smoothed over 3 x 3 pixels at the end. At few samples a pixel's own variance is skewed and goes along
/// with its mean: a dark pixel that no sample of a lamp reached would count as certain.
pub(crate) fn variance(
    size: Size,
    mean: &[f32],
    variance: Option<&Plane>,
    halves: Option<[&Plane; 2]>,
) -> Plane {
    let known = variance.filter(|plane| plane.iter().all(|v| *v >= 0.0));
    let estimate = match (known, halves) {
        (Some(variance), Some([a, b])) => rescaled(size, variance, &of_halves(a, b)),
        (Some(variance), None) => variance.clone(),
        (None, Some([a, b])) => box_mean(size, &of_halves(a, b), LOCAL_RADIUS),
        (None, None) => return spatial(size, mean),
    };
    box_mean(size, &estimate, 1)
}

/// (a − b)²/4: an unbiased variance of the mean with one degree of freedom.
fn of_halves(a: &[f32], b: &[f32]) -> Plane {
    map2(a, b, |a, b| squared(0.5 * (a - b)))
}

fn rescaled(size: Size, variance: &[f32], halves: &[f32]) -> Plane {
    let level = box_mean(size, variance, LEVEL_RADIUS);
    let wanted = box_mean(size, halves, LEVEL_RADIUS);
    let local = box_mean(size, halves, LOCAL_RADIUS);
    let mut out = variance.to_vec();
    for (p, out) in out.iter_mut().enumerate() {
        // A variance plane of a picture at an extreme exposure has underflowed to zero; its halves have not.
        let ratio = wanted[p] / level[p];
        *out = if ratio.is_finite() { *out * ratio } else { local[p] };
    }
    out
}

/// Variance estimated from the picture alone: mean square of the second difference, which is six times the
/// variance where the picture is straight, over 7 x 7 pixels; of both directions the smaller one, so that an
/// edge along one of them does not count as noise. Where a direction has less than three pixels, the
/// other; where both have, zero: nothing is known and nothing is filtered.
fn spatial(size: Size, mean: &[f32]) -> Plane {
    let Size { width, height } = size;
    let along = |step: usize, at: fn(usize, usize) -> usize, end: usize| {
        (end > 2).then(|| {
            let square = size.rows(|y, out| {
                for (x, out) in out.iter_mut().enumerate() {
                    // At the border the second difference of the pixel next to it.
                    let q = at(x, y).clamp(1, end - 2);
                    let p = y * width + x + q * step - at(x, y) * step;
                    let second = mean[p - step] - 2.0 * mean[p] + mean[p + step];
                    *out = squared(second) / 6.0;
                }
            });
            box_mean(size, &square, LOCAL_RADIUS)
        })
    };
    match (along(1, |x, _| x, width), along(width, |_, y| y, height)) {
        (Some(across), Some(down)) => map2(&across, &down, f32::min),
        (Some(one), None) | (None, Some(one)) => one,
        (None, None) => vec![0.0; size.len()],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Uniform on ±√3: variance 1.
    fn white(n: usize, seed: u64) -> Plane {
        let mut state = seed;
        let mut next = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 40) as f32 / 16_777_216.0
        };
        (0..n).map(|_| (next() - 0.5) * 12.0_f32.sqrt()).collect()
    }

    fn average(plane: &[f32]) -> f32 {
        plane.iter().sum::<f32>() / plane.len() as f32
    }

    #[test]
    fn stratified_halves_correct_the_level_of_the_sample_variance() {
        let size = Size { width: 64, height: 64 };
        let (a, b) = (white(size.len(), 1), white(size.len(), 2));
        let mean = map2(&a, &b, |a, b| 0.5 * (a + b));
        // Halves of variance 1 have a mean of variance ½; the plane claims four times that.
        let v = variance(size, &mean, Some(&vec![2.0; size.len()]), Some([&a, &b]));
        // 4096 pixels of relative variance 0.8 each: five standard deviations are 0.07.
        assert!((average(&v) - 0.5).abs() < 0.035, "{}", average(&v));
    }

    #[test]
    fn without_any_statistics_the_level_comes_from_the_picture() {
        let size = Size { width: 64, height: 64 };
        let mut mean = white(size.len(), 3);
        for (p, value) in mean.iter_mut().enumerate() {
            *value += 50.0 * (p % 64) as f32 + if p / 64 > 30 { 1000.0 } else { 0.0 };
        }
        for unknown in [None, Some(&vec![-1.0; size.len()])] {
            let v = variance(size, &mean, unknown, None);
            // The smaller of two estimates over 7 x 7 pixels lies some 15 % low; the ramp and the step do not count.
            assert!((0.6..1.1).contains(&average(&v)), "{}", average(&v));
        }
    }

    #[test]
    fn small_pictures_have_a_finite_level() {
        for (width, height) in [(1, 1), (2, 1), (1, 5), (2, 2), (3, 3)] {
            let size = Size { width, height };
            let v = variance(size, &white(size.len(), 4), None, None);
            assert!(v.iter().all(|v| v.is_finite() && *v >= 0.0), "{width}x{height}: {v:?}");
        }
    }

    #[test]
    fn a_variance_that_has_underflowed_comes_from_the_halves() {
        let size = Size { width: 16, height: 16 };
        let (a, b) = (white(size.len(), 5), white(size.len(), 6));
        let mean = map2(&a, &b, |a, b| 0.5 * (a + b));
        let v = variance(size, &mean, Some(&vec![0.0; size.len()]), Some([&a, &b]));
        assert!((0.3..0.7).contains(&average(&v)), "{}", average(&v));
    }
}
