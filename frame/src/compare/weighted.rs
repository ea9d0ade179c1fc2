//! The whole picture with every block weighted by how well it is known, so that the noise of one part does not hide a
//! difference in the others.

use super::test::{self, Finding, Mean, Quantiles};
use super::units::{Area, Grid, Units};
use super::{Halves, View};

/// No block weighs more than one whose brightness is known to this fraction: without noise a weight would be infinite.
const KNOWN: f64 = 1e-3;

/// Weighted relative means of both pictures, a channel at a time.
pub(super) struct Weighted {
    means: [[Mean; 2]; 3],
}

/// Weights for a half's blocks come from the other half, `w = light / (var_a + var_b)`, which is best for a bias that is
/// the same fraction everywhere; being independent of what they weight, they leave every mean where it is. Where the
/// second picture comes in one piece, only the first one's halves make weights, and both weigh the piece.
///
/// `None` where the first picture has no halves.
pub(super) fn test(a: &Halves, b: &Halves, sides: [usize; 2]) -> Option<Weighted> {
    let Halves::Two(first) = a else { return None };
    let size = a.size();
    let second = |h: usize| match b {
        Halves::Two(halves) => View::Half(&halves[h]),
        Halves::One(_) => View::All(b),
    };
    let in_one_piece = matches!(b, Halves::One(_));
    let halves: [Units; 2] = [0, 1].map(|h| {
        let views = [View::Half(&first[h]), second(h)];
        let outer = Units::of(Grid::of_blocks(size, sides[0]), views, None);
        Units::of(Grid::of_blocks(size, sides[1]), views, Some(&outer))
    });
    let weight = |[a, b]: &[Mean; 2]| {
        let (light, var) = if in_one_piece { (a.mean, a.var) } else { (a.mean.max(b.mean), a.var + b.var) };
        let weight = light / (var + (KNOWN * light).powi(2));
        if weight.is_finite() { [weight.max(0.0), light] } else { [0.0, 0.0] }
    };
    let means = std::array::from_fn(|channel| {
        let (mut ours, mut theirs, mut total) = (Sums::default(), Sums::default(), 0.0);
        for (one, other) in halves[0].means.iter().zip(&halves[1].means) {
            let [[w0, light0], [w1, light1]] = [weight(&other[channel]), weight(&one[channel])];
            total += w0 * light0 + w1 * light1;
            ours.push(&one[channel][0], w0);
            ours.push(&other[channel][0], w1);
            if in_one_piece {
                theirs.push(&one[channel][1], w0 + w1);
            } else {
                theirs.push(&one[channel][1], w0);
                theirs.push(&other[channel][1], w1);
            }
        }
        [ours.mean(total), theirs.mean(total)]
    });
    Some(Weighted { means })
}

impl Weighted {
    pub fn findings(&self, level: f64, [width, height]: [usize; 2], rounding: f64) -> Vec<Finding> {
        let mut quantiles = Quantiles::new(level);
        let area = Area { x: 0, y: 0, width, height };
        let channels = self.means.iter().enumerate();
        channels.map(|(channel, [a, b])| test::test(a, b, area, channel, rounding, &mut quantiles)).collect()
    }
}

#[derive(Clone, Copy, Default)]
struct Sums {
    mean: f64,
    var: f64,
    third: f64,
    /// Σ var² / dof
    spread: f64,
}

impl Sums {
    fn push(&mut self, mean: &Mean, weight: f64) {
        let var = weight * weight * mean.var;
        self.mean += weight * mean.mean;
        self.var += var;
        self.third += weight.powi(3) * mean.third;
        self.spread += var * var / mean.dof;
    }

    fn mean(&self, weights: f64) -> Mean {
        if weights <= 0.0 {
            return Mean { dof: f64::INFINITY, ..Mean::default() };
        }
        let dof = if self.spread > 0.0 { self.var * self.var / self.spread } else { f64::INFINITY };
        Mean {
            mean: self.mean / weights,
            var: self.var / (weights * weights),
            third: self.third / weights.powi(3),
            dof,
        }
    }
}
