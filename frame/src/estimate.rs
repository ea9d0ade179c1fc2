//! The error of a picture, estimated from its own two halves.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::metrics::EPSILON;
use crate::stats::student_t_quantile;
use crate::{Frame, Layer, Statistic};

/// Neighbours up to this many rows and columns away tell what a pixel's true value may be.
const RADIUS: usize = 3;
/// Side of the blocks whose scatter gives the interval.
const BLOCK: usize = 8;
/// Share of a true value's standard deviation by which all of them may be off together.
const COMMON_OFFSET: f64 = 0.5;
/// No interval is wider than e^30 to either side, a factor of 10^13: nothing is known, in finite numbers.
const WIDEST: f64 = 30.0;

/// An estimated relMSE (see [`Metrics::relmse`](crate::Metrics::relmse)) and how well it is known.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorEstimate {
    /// Estimated relMSE of the frame's `R`, `G` and `B`.
    pub relmse: f64,
    /// Lower end of the 95 % interval for what a comparison with the true picture would give.
    pub low: f64,
    /// Its upper end.
    pub high: f64,
}

/// Estimates the relMSE of a noisy frame's beauty from the means `a` and `b` of its two halves. `None`
/// if they are not in the frame, or no pixel is finite and has two samples.
///
/// ```text
/// relMSE = mean of v / (r̂² + 0.01),   v = (a − b)² n_a n_b / n²
/// ```
///
/// v is an unbiased estimate of the squared error of the mean with one degree of freedom a pixel (n from
/// `samples.N`; without it the halves count as equal, v = (a − b)²/4). The true value r is not known, and
/// the pixel's own mean will not do for it: a firefly in v² is the same firefly in r², and the estimate
/// came out 100 times too small (measured on synthetic pictures, with 30 % of the light in one sample of
/// 3000, at 64 samples). So r̂ is the pixel's mean drawn towards that of its 7x7 neighbours, without
/// itself, by the share of noise in their difference (the linear filter of Wiener and of Lee 1980), where
/// the noise is the larger of v and its neighbours' mean. This errs on the high side: by up to 15 % on
/// edges and gradients, up to 1.7 times on strong texture under fireflies, and 3 times where every pixel
/// has a brightness of its own and the picture is mostly noise.
///
/// The interval joins three uncertainties: of the estimate, from the differences between the two colours
/// of a checkerboard in blocks of 8x8 pixels, with Student's t at the degrees of freedom that the
/// differences' fourth moment shows (few, where a few fireflies are most of the error); of the actual
/// error, which scatters about its expectation just as much; and of r̂. What no sample has
/// found is not in it.
pub fn estimate_relmse(frame: &Frame) -> Option<ErrorEstimate> {
    let mean = frame.rgb().ok()?;
    let a = frame.layer(Layer::Beauty, Statistic::A)?;
    let b = frame.layer(Layer::Beauty, Statistic::B)?;
    let size = (frame.width(), frame.height());
    let counts = frame.layer(Layer::Samples, Statistic::Mean).map(|planes| planes[0]);
    let factor: Vec<f64> = (0..frame.len())
        .map(|p| {
            let finite = (0..3).all(|c| mean[c][p].is_finite() && a[c][p].is_finite() && b[c][p].is_finite());
            if finite { half_factor(counts.map(|n| n[p])) } else { 0.0 }
        })
        .collect();
    let used: Vec<f64> = factor.iter().map(|f| f64::from(*f > 0.0)).collect();
    let pixels: f64 = used.iter().sum();
    if pixels == 0.0 {
        return None;
    }

    let neighbours = neighbour_sums(&used, size);
    let (mut error, mut low, mut high) = (vec![0.0; frame.len()], 0.0, 0.0);
    for c in 0..3 {
        let value: Vec<f64> =
            mean[c].iter().zip(&used).map(|(x, u)| if *u > 0.0 { f64::from(*x) } else { 0.0 }).collect();
        let noise: Vec<f64> = (0..frame.len())
            .map(|p| {
                if used[p] > 0.0 {
                    (f64::from(a[c][p]) - f64::from(b[c][p])).powi(2) * factor[p]
                } else {
                    0.0
                }
            })
            .collect();
        for (p, truth) in true_values(&value, &noise, &used, &neighbours, size).into_iter().enumerate() {
            let offset = COMMON_OFFSET * truth.deviation;
            error[p] += noise[p] / (truth.mean.powi(2) + EPSILON);
            low += noise[p] / ((truth.mean.abs() + offset).powi(2) + EPSILON);
            high += noise[p] / ((truth.mean.abs() - offset).max(0.0).powi(2) + EPSILON);
        }
    }

    let sum: f64 = error.iter().sum();
    if sum == 0.0 {
        return Some(ErrorEstimate { relmse: 0.0, low: 0.0, high: 0.0 });
    }
    let scatter = 2.0_f64.sqrt() * relative_half_width(&error, size, sum); // estimate and actual error
    let width = |systematic: f64| scatter.hypot(systematic).min(WIDEST);
    let relmse = sum / (3.0 * pixels);
    Some(ErrorEstimate {
        relmse,
        low: relmse * (-width((sum / low).ln())).exp(),
        high: relmse * width((high / sum).ln()).exp(),
    })
}

/// What (a − b)² is multiplied by for the variance of the mean of n samples, of which the even ones are
/// in half a: n_a n_b / n²; 0 where there are no two halves.
fn half_factor(samples: Option<f32>) -> f64 {
    match samples.map(f64::from) {
        None => 0.25,
        Some(n) if n >= 2.0 && n.is_finite() => {
            let of_b = (n / 2.0).floor();
            (n - of_b) / n * (of_b / n)
        }
        Some(_) => 0.0,
    }
}

/// What is known of a pixel's true value.
struct Truth {
    mean: f64,
    deviation: f64,
}

/// Each pixel's true value from its mean, its noise (a variance), and its neighbours'.
fn true_values(
    value: &[f64],
    noise: &[f64],
    used: &[f64],
    neighbours: &[f64],
    size: (usize, usize),
) -> Vec<Truth> {
    let mean_of = |plane: &[f64]| -> Vec<f64> {
        neighbour_sums(plane, size).iter().zip(neighbours).map(|(s, n)| s / n.max(1.0)).collect()
    };
    let around = mean_of(value);
    let deviation: Vec<f64> = (0..value.len()).map(|p| (value[p] - around[p]).powi(2) * used[p]).collect();
    let (noise_around, spread) = (mean_of(noise), mean_of(&deviation));
    (0..value.len())
        .map(|p| {
            if neighbours[p] == 0.0 {
                return Truth { mean: value[p], deviation: noise[p].sqrt() };
            }
            let signal = (spread[p] - noise_around[p]).max(0.0); // variance of the truth about its surroundings
            let own_noise = noise_around[p].max(noise[p]);
            let weight = if signal > 0.0 { signal / (signal + own_noise) } else { 0.0 };
            let variance = weight * own_noise + (1.0 - weight).powi(2) * noise_around[p] / neighbours[p];
            Truth { mean: around[p] + weight * (value[p] - around[p]), deviation: variance.sqrt() }
        })
        .collect()
}

/// The sum over the window about each pixel, clipped at the borders, without the pixel itself. Summed
/// apart, not subtracted: next to a firefly's square nothing would be left of its neighbours.
fn neighbour_sums(plane: &[f64], (width, height): (usize, usize)) -> Vec<f64> {
    let window = |i: usize, length: usize| i.saturating_sub(RADIUS)..(i + RADIUS + 1).min(length);
    let mut rows = vec![0.0; plane.len()];
    rows.par_chunks_mut(width).zip(plane.par_chunks(width)).for_each(|(sums, row)| {
        for (x, sum) in sums.iter_mut().enumerate() {
            *sum = row[window(x, width)].iter().sum();
        }
    });
    let mut sums = vec![0.0; plane.len()];
    sums.par_chunks_mut(width).enumerate().for_each(|(y, sums)| {
        for (x, sum) in sums.iter_mut().enumerate() {
            let others = window(y, height).filter(|other| *other != y);
            let above_and_below: f64 = others.map(|other| rows[other * width + x]).sum();
            let row = &plane[y * width..(y + 1) * width];
            let in_row: f64 = window(x, width).filter(|other| *other != x).map(|other| row[other]).sum();
            *sum = above_and_below + in_row;
        }
    });
    sums
}

/// Half the width of the 95 % interval of `sum`, the sum of `error`, relative to it.
fn relative_half_width(error: &[f64], (width, height): (usize, usize), sum: f64) -> f64 {
    // Within a block, black minus white squares: what varies across the picture drops out of the
    // difference, and its variance is that of the block's sum.
    let (mut squares, mut fourths) = (0.0, 0.0);
    for top in (0..height).step_by(BLOCK) {
        for left in (0..width).step_by(BLOCK) {
            let mut difference = 0.0;
            for y in top..(top + BLOCK).min(height) {
                for x in left..(left + BLOCK).min(width) {
                    let sign = if (x + y) % 2 == 0 { 1.0 } else { -1.0 };
                    difference += sign * error[y * width + x];
                }
            }
            let square = (difference / sum).powi(2);
            squares += square;
            fourths += square * square;
        }
    }
    if squares == 0.0 {
        return 0.0;
    }
    // 3 (Σd²)²/Σd⁴ is the number of blocks for normal d, and about 3 if one block dominates.
    let blocks = width.div_ceil(BLOCK) as f64 * height.div_ceil(BLOCK) as f64;
    let dof = (3.0 * squares * squares / fourths).min(blocks).max(1.0);
    student_t_quantile(0.975, dof) * squares.sqrt()
}

#[cfg(test)]
mod tests;
