//! Do two renderings of one scene show the same picture?
//!
//! Two independent Monte Carlo pictures never agree to the eye, nor do their pixels; their *means* over many pixels
//! do, as far as the noise of those means goes. [`compare`] asks that question of the whole picture and of its parts,
//! channel by channel, and says how small a difference it would have found.
//!
//! The tests are Welch's, on the means of blocks (after Jung, Hanika and Dachsbacher 2020, *Detecting bias in Monte
//! Carlo renderers using Welch's t-test*, JCGT 9(2)). Both pictures come in *passes* with seeds of their own, whose
//! spread says how well each pixel is known ([`Passes`], [`Estimate`]); pixels must be independent, as they are with a
//! box filter and an independent sampler, so that a block's variance is the sum of its pixels'.
//!
//! Rare bright samples ("fireflies") are where such tests go wrong, in both directions. Nothing is clamped or left
//! out, since that would shift the means of two renderers by different amounts. Instead:
//!
//! - *The noise of a block may not have been seen in it.* Where the larger block around it has fireflies, and too few for
//!   this one to have met them for sure, it is not taken to be relatively less noisy than that: a firefly that missed
//!   it by chance still counts (`borrow` in `units.rs`).
//! - *A few fireflies know little about themselves.* The degrees of freedom come from how the variance is shared out
//!   over the pixels: a block whose noise sits in one pixel has two.
//! - *One-sided tails* are corrected to the next order by Hall's transformation
//!   ([`skew_corrected_t`](crate::stats::skew_corrected_t)).
//! - *A firefly must not hide the rest.* Beside the plain mean, the whole picture is tested with every block weighted
//!   by how well it is known; the weights come from the other half of the passes, which are independent of what is
//!   weighted, so that they shift no mean (`weighted.rs`).

mod passes;
mod test;
mod units;
mod weighted;

#[cfg(test)]
mod tests;

use passes::View;
pub use passes::{Estimate, Halves, Passes};
pub use test::{Finding, POWER, ROUNDING};
pub use units::Area;

use crate::stats::{sidak_level, sidak_p};
use units::{Grid, Units};

/// Chance of a false alarm for a scene, over all tests together.
pub const FALSE_ALARMS: f64 = 0.01;
/// A channel takes part in [`Comparison::detectable_bias`] where it has this share of the brightest one's light.
const BRIGHT_CHANNEL: f64 = 0.1;
/// Sides of the blocks, in pixels.
const BLOCKS: [usize; 2] = [32, 8];

/// What was compared: a kind of test with all its places and channels.
#[derive(Clone, Debug)]
pub struct Family {
    /// How the picture is divided.
    pub parts: Parts,
    /// Of each place and channel, places in reading order, three channels each.
    pub findings: Vec<Finding>,
    /// Chance that the least of the p values comes out as small as it did where all means are equal (Šidák).
    pub p: f64,
    /// Below this, a p value of the family is an alarm: all families together raise [`FALSE_ALARMS`] false ones.
    pub level: f64,
}

/// How the picture is divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parts {
    /// One mean over the picture.
    Whole,
    /// One mean over the picture, blocks weighted by how well they are known.
    Weighted,
    /// Four by four parts.
    Sixteenths,
    /// Blocks of about so many pixels a side.
    Blocks(usize),
}

/// The answer of [`compare`].
#[derive(Clone, Debug)]
pub struct Comparison {
    /// Kinds of tests, from the whole picture to the smallest blocks.
    pub families: Vec<Family>,
    /// Chance of a difference as clear as the clearest one, where both renderers compute the same picture; corrected
    /// for the number of tests. An alarm below [`FALSE_ALARMS`].
    pub p: f64,
    /// Mean over pixels and channels of the first picture over that of the second; 1 where both are black.
    pub mean_ratio: f64,
    /// The smallest relative bias of all pixels alike that the plain mean of the whole picture would have shown with
    /// a chance of [`POWER`]: a fraction, the worst of the channels that carry light.
    pub detectable_bias: f64,
    /// Places that were tested.
    pub blocks: usize,
    /// Pixels left out: not finite in one of the pictures.
    pub left_out: usize,
}

impl Comparison {
    /// The family that divides the picture so, where it was tested.
    pub fn family(&self, parts: Parts) -> Option<&Family> {
        self.families.iter().find(|family| family.parts == parts)
    }
}

/// Compares two pictures of the same size.
///
/// With a first picture that comes in one piece (`Halves::One`) the weighted test is left out.
///
/// # Panics
///
/// If the sizes differ.
pub fn compare(a: &Halves, b: &Halves) -> Comparison {
    assert_eq!(a.size(), b.size(), "pictures of different sizes are not compared");
    let [width, height] = a.size();
    let left_out = (0..width * height).filter(|&p| !(a.is_finite(p) && b.is_finite(p))).count();

    let mut kinds = vec![(Parts::Whole, Grid::new([width, height], [1, 1]))];
    kinds.push((Parts::Sixteenths, Grid::new([width, height], [4.min(width), 4.min(height)])));
    kinds.extend(BLOCKS.map(|side| (Parts::Blocks(side), Grid::of_blocks([width, height], side))));
    let mut chain: Vec<Units> = Vec::new();
    for (_, grid) in &kinds {
        let units = Units::of(*grid, [View::All(a), View::All(b)], chain.last());
        chain.push(units);
    }
    let weighted = weighted::test(a, b, BLOCKS);
    // A division that is no finer than the one before asks the same question again.
    let mut tested: Vec<(Parts, &Units)> = Vec::new();
    for ((parts, grid), units) in kinds.iter().zip(&chain) {
        if tested.last().is_none_or(|(_, coarser)| grid.len() > coarser.grid.len()) {
            tested.push((*parts, units));
        }
    }

    let count = tested.len() + usize::from(weighted.is_some());
    let rounding = a.rounding().max(b.rounding());
    let level = |tests: usize| sidak_level(sidak_level(FALSE_ALARMS, count), tests);
    let mut families: Vec<Family> = tested
        .iter()
        .map(|(parts, units)| {
            let level = level(3 * units.grid.len());
            family(*parts, units.findings(level, rounding), level)
        })
        .collect();
    if let Some(weighted) = weighted {
        let level = level(3);
        families
            .insert(1, family(Parts::Weighted, weighted.findings(level, [width, height], rounding), level));
    }

    let least = families.iter().map(|family| family.p).fold(1.0, f64::min);
    let whole = &families[0].findings;
    let sum = |i: usize| whole.iter().map(|finding| finding.means[i]).sum::<f64>();
    let mean_ratio = if sum(0) == sum(1) { 1.0 } else { sum(0) / sum(1) };
    let brightest = whole.iter().map(Finding::brightness).fold(0.0, f64::max);
    let detectable_bias = whole
        .iter()
        .filter(|finding| finding.brightness() >= BRIGHT_CHANNEL * brightest)
        .map(|finding| finding.detectable)
        .fold(0.0, f64::max);
    Comparison {
        p: sidak_p(least, families.len()),
        mean_ratio,
        detectable_bias,
        blocks: tested.iter().map(|(_, units)| units.grid.len()).sum(),
        left_out,
        families,
    }
}

fn family(parts: Parts, findings: Vec<Finding>, level: f64) -> Family {
    let least = findings.iter().map(|finding| finding.p).fold(1.0, f64::min);
    Family { parts, p: sidak_p(least, findings.len()), findings, level }
}
