//! Pearson's χ² test of draws against their density.

use std::f64::consts::{PI, TAU};

use glam::{Vec2, Vec3};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::cells::{Cells, Rect};
use crate::{FALSE_ALARM, Rng};

/// Draws of a test. A density that is wrong by 2 % here and −2 % there is found (see the tests below).
const DRAWS: u64 = 1_000_000;
/// Cells that expect fewer draws are counted together, since χ² is a limit for large counts.
const SMALLEST_EXPECTED: f64 = 20.0;

/// A density that integrates to more than this is wrong; the cells tell what lacks to 1.
const LARGEST_INTEGRAL: f64 = 1.0 + 2e-4;

/// What a test found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chi2 {
    /// Σ (observed − expected)² / expected.
    pub statistic: f64,
    /// Degrees of freedom.
    pub degrees: u32,
    /// Probability of a statistic as large as this if the draws follow the density; 0 if that integrates to more than 1.
    pub p: f64,
}

/// Panics unless directions follow their density per steradian over the whole sphere.
#[track_caller]
pub fn assert_chi2(sample: impl Fn(Vec2) -> Vec3, pdf: impl Fn(Vec3) -> f32) {
    assert_chi2_lobes(|_, u| Some(sample(u)), pdf);
}

/// As [`assert_chi2`] for routines that take a third number to choose a lobe with, or give no direction at times; the
/// density then integrates to the share of draws that give one.
#[track_caller]
pub fn assert_chi2_lobes(sample: impl Fn(f32, Vec2) -> Option<Vec3>, pdf: impl Fn(Vec3) -> f32) {
    check(sphere(sample, pdf));
}

/// Panics unless points of [0, 1]² follow their density.
#[track_caller]
pub fn assert_chi2_square(sample: impl Fn(Vec2) -> Vec2, pdf: impl Fn(Vec2) -> f32) {
    check(square(sample, pdf));
}

/// Panics unless the index drawn follows `pmf`, which adds up to 1.
#[track_caller]
pub fn assert_chi2_discrete(sample: impl Fn(f32) -> usize, pmf: &[f64]) {
    check(discrete(sample, pmf));
}

#[track_caller]
fn check(result: Chi2) {
    assert!(result.p >= FALSE_ALARM, "draws do not follow their density: {result:?}");
}

/// The test of [`assert_chi2_lobes`].
pub fn sphere(sample: impl Fn(f32, Vec2) -> Option<Vec3>, pdf: impl Fn(Vec3) -> f32) -> Chi2 {
    // Area in (cos θ, φ) is solid angle.
    let rect = Rect { min: [-1.0, 0.0], size: [2.0, TAU] };
    let density = |z: f64, phi: f64| {
        let r = ((1.0 - z) * (1.0 + z)).sqrt();
        f64::from(pdf(Vec3::new((r * phi.cos()) as f32, (r * phi.sin()) as f32, z as f32)))
    };
    let draw = |rng: &mut Rng| {
        let w = sample(rng.uniform(), rng.uniform2())?;
        let phi = f64::from(w.y).atan2(f64::from(w.x));
        Some([f64::from(w.z), if phi < 0.0 { phi + 2.0 * PI } else { phi }])
    };
    continuous(rect, density, draw)
}

/// The test of [`assert_chi2_square`].
pub fn square(sample: impl Fn(Vec2) -> Vec2, pdf: impl Fn(Vec2) -> f32) -> Chi2 {
    let rect = Rect { min: [0.0, 0.0], size: [1.0, 1.0] };
    let density = |x: f64, y: f64| f64::from(pdf(Vec2::new(x as f32, y as f32)));
    continuous(rect, density, |rng| Some(sample(rng.uniform2()).to_array().map(f64::from)))
}

/// The test of [`assert_chi2_discrete`].
pub fn discrete(sample: impl Fn(f32) -> usize, pmf: &[f64]) -> Chi2 {
    let mut counts = vec![0; pmf.len()];
    let mut rng = Rng::new(1);
    for _ in 0..DRAWS {
        counts[sample(rng.uniform())] += 1;
    }
    pearson(&counts, pmf)
}

fn continuous(
    rect: Rect,
    density: impl Fn(f64, f64) -> f64,
    mut draw: impl FnMut(&mut Rng) -> Option<[f64; 2]>,
) -> Chi2 {
    let cells = Cells::new(rect, &density);
    let mut probabilities = cells.masses.clone();
    // Draws that give nothing are a cell of their own: what the density lacks to 1.
    probabilities.push((1.0 - cells.total()).max(0.0));
    let mut counts = vec![0; probabilities.len()];
    let mut rng = Rng::new(1);
    for _ in 0..DRAWS {
        let cell = draw(&mut rng).map_or(cells.masses.len(), |[x, y]| cells.find(x, y));
        counts[cell] += 1;
    }
    let result = pearson(&counts, &probabilities);
    if cells.total() > LARGEST_INTEGRAL { Chi2 { p: 0.0, ..result } } else { result }
}

fn pearson(counts: &[u64], probabilities: &[f64]) -> Chi2 {
    let draws = counts.iter().sum::<u64>() as f64;
    let (mut statistic, mut cells) = (0.0, 0);
    let mut add = |observed: f64, expected: f64| {
        statistic += (observed - expected).powi(2) / expected;
        cells += 1;
    };
    let (mut pooled_observed, mut pooled_expected) = (0.0, 0.0);
    for (&count, &probability) in counts.iter().zip(probabilities) {
        let (observed, expected) = (count as f64, draws * probability);
        if expected >= SMALLEST_EXPECTED {
            add(observed, expected);
        } else {
            pooled_observed += observed;
            pooled_expected += expected;
        }
    }
    // Draws where the density says that there are none are found even in a pool that is too small for χ².
    if pooled_observed > 0.0 || pooled_expected >= SMALLEST_EXPECTED {
        add(pooled_observed, pooled_expected.max(1.0));
    }
    let degrees = cells - 1;
    // With one cell, all draws agree with it or χ² is not for this density.
    let p = match ChiSquared::new(f64::from(degrees)) {
        Ok(distribution) => distribution.sf(statistic),
        Err(_) => f64::from(u8::from(statistic < 1e-6 * draws)),
    };
    Chi2 { statistic, degrees, p }
}

#[cfg(test)]
mod tests;
