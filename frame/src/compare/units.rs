//! The picture in parts: their means and noise, and the tests on them.

use super::View;
use super::test::{Finding, Mean, Quantiles, test};

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Area {
    /// First column.
    pub x: usize,
    /// First row.
    pub y: usize,
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
}

/// A division of the picture into nearly equal rectangles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    size: [usize; 2],
    parts: [usize; 2],
}

impl Grid {
    pub fn new(size: [usize; 2], parts: [usize; 2]) -> Self {
        Self { size, parts: parts.map(|n| n.max(1)) }
    }

    /// Blocks of about `side` pixels: none is a sliver, whatever the picture's size.
    pub fn of_blocks(size: [usize; 2], side: usize) -> Self {
        Self::new(size, size.map(|length| (length + side / 2) / side))
    }

    pub fn len(&self) -> usize {
        self.parts[0] * self.parts[1]
    }

    pub fn of_pixel(&self, p: usize) -> usize {
        let [x, y] = [p % self.size[0], p / self.size[0]];
        y * self.parts[1] / self.size[1] * self.parts[0] + x * self.parts[0] / self.size[0]
    }

    pub fn area(&self, unit: usize) -> Area {
        let place = [unit % self.parts[0], unit / self.parts[0]];
        // The first pixel that `of_pixel` puts here.
        let begin = |axis: usize, i: usize| (i * self.size[axis]).div_ceil(self.parts[axis]);
        let [x, y] = [begin(0, place[0]), begin(1, place[1])];
        let [right, below] = [begin(0, place[0] + 1), begin(1, place[1] + 1)];
        Area { x, y, width: right - x, height: below - y }
    }

    /// The unit of this division in which the middle of a unit of a finer one lies.
    fn around(&self, finer: &Grid, unit: usize) -> usize {
        let Area { x, y, width, height } = finer.area(unit);
        self.of_pixel(
            (y + height / 2).min(self.size[1] - 1) * self.size[0] + (x + width / 2).min(self.size[0] - 1),
        )
    }
}

/// Sums over the pixels of a unit, of one picture and channel.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    mean: f64,
    var: f64,
    var_squared: f64,
    third: f64,
}

/// All units of a division with both pictures' means.
pub(super) struct Units {
    pub grid: Grid,
    /// `[unit][channel]`, the first and the second picture's.
    pub means: Vec<[[Mean; 2]; 3]>,
    /// Pixels of each that are finite in both.
    pixels: Vec<usize>,
}

impl Units {
    /// `around` is the next coarser division, from which noise is borrowed.
    pub fn of(grid: Grid, [a, b]: [View; 2], around: Option<&Units>) -> Self {
        let mut sums = vec![[[Sums::default(); 2]; 3]; grid.len()];
        let mut pixels = vec![0; grid.len()];
        for p in 0..grid.size[0] * grid.size[1] {
            if !(a.is_finite(p) && b.is_finite(p)) {
                continue;
            }
            let unit = grid.of_pixel(p);
            pixels[unit] += 1;
            for (channel, sums) in sums[unit].iter_mut().enumerate() {
                for (sums, picture) in sums.iter_mut().zip([a, b]) {
                    let [mean, var, third] = picture.pixel(channel, p);
                    sums.mean += mean;
                    sums.var += var;
                    sums.var_squared += var * var;
                    sums.third += third;
                }
            }
        }
        let knows_third = [a, b].map(|picture| picture.knows_third());
        let mut means: Vec<[[Mean; 2]; 3]> = sums
            .iter()
            .zip(&pixels)
            .map(|(unit, &n)| unit.map(|channel| channel.map(|sums| mean_of(&sums, n))))
            .collect();
        for pair in means.iter_mut().flatten() {
            let unknown = pair.iter_mut().zip(knows_third).filter(|(_, known)| !known);
            unknown.for_each(|(mean, _)| mean.third = f64::NAN);
        }
        if let Some(around) = around {
            for (unit, means) in means.iter_mut().enumerate() {
                let outer = around.grid.around(&grid, unit);
                let pixels = [pixels[unit], around.pixels[outer]].map(|n| n as f64);
                for (inner, outer) in means.iter_mut().zip(&around.means[outer]) {
                    borrow(inner, outer, pixels[1] / pixels[0]);
                }
            }
        }
        Self { grid, means, pixels }
    }

    /// The test of every unit and channel at a level.
    pub fn findings(&self, level: f64, rounding: f64) -> Vec<Finding> {
        let mut quantiles = Quantiles::new(level);
        let mut findings = Vec::with_capacity(3 * self.means.len());
        for (unit, means) in self.means.iter().enumerate() {
            for (channel, [a, b]) in means.iter().enumerate() {
                findings.push(test(a, b, self.grid.area(unit), channel, rounding, &mut quantiles));
            }
        }
        findings
    }
}

/// The mean over `n` pixels. Its degrees of freedom follow from how the variance is shared out: a pixel that has all
/// of it counts as two, which is right for a single firefly and cautious for anything else.
fn mean_of(sums: &Sums, n: usize) -> Mean {
    if n == 0 {
        return Mean { dof: f64::INFINITY, ..Mean::default() };
    }
    let n = n as f64;
    let share = sums.var / sums.var_squared.sqrt(); // squares of shares, so that nothing underflows
    let dof = if sums.var > 0.0 && share.is_finite() { 2.0 * share * share } else { f64::INFINITY };
    Mean { mean: sums.mean / n, var: sums.var / (n * n), third: sums.third / (n * n * n), dof }
}

/// Rare bright events that a unit should have met for its own noise to be believed.
const EVENTS: f64 = 16.0;

/// A unit in which too few rare events are to be expected is taken to be at least as noisy, for its brightness, as the
/// larger one around it: they may have missed it by chance, and a mean that lacks them would look certain.
///
/// Events of one size that come at random make a mean whose skewness γ is one over the root of their number. The larger
/// unit's γ, carried over to the pixels of the smaller, therefore tells how many are to be expected there: `1/γ²`. Noise
/// without a tail, such as that of a lamp's edge, expects thousands and is not borrowed.
///
/// `more` is how many times as many pixels the larger one has. A unit in which neither picture has any noise keeps
/// that: there, equality is exact.
fn borrow(inner: &mut [Mean; 2], outer: &[Mean; 2], more: f64) {
    if inner.iter().all(|mean| mean.var == 0.0) {
        return;
    }
    let light = |means: &[Mean; 2]| means[0].mean.max(means[1].mean);
    let scale = light(inner) / light(outer);
    if !(scale.is_finite() && scale > 0.0 && more.is_finite()) {
        return;
    }
    let skewness = |mean: &Mean| mean.third / (mean.var * mean.var.sqrt());
    let others = skewness(&outer[0]);
    for (i, (inner, outer)) in inner.iter_mut().zip(outer).enumerate() {
        // One that does not know its own is taken to be as skewed as the other.
        let known = if i == 1 && outer.third.is_nan() { others } else { skewness(outer) };
        let rare = known * known * more > 1.0 / EVENTS;
        let var = outer.var * more * scale * scale;
        if rare && var > inner.var {
            inner.var = var;
            inner.third = outer.third * more * more * scale.powi(3);
            inner.dof = outer.dof;
        }
    }
}
