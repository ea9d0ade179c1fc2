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
/// the same fraction everywhere; being independent of what they weight, they leave every mean where it is.
///
/// `None` where one of the pictures has no halves.
pub(super) fn test(a: &Halves, b: &Halves, sides: [usize; 2]) -> Option<Weighted> {
    let (Halves::Two(a), Halves::Two(b)) = (a, b) else { return None };
    let size = a[0].size;
    let halves: Vec<Units> = (0..2)
        .map(|h| {
            let views = [View::Half(&a[h]), View::Half(&b[h])];
            let outer = Units::of(Grid::of_blocks(size, sides[0]), views, None);
            Units::of(Grid::of_blocks(size, sides[1]), views, Some(&outer))
        })
        .collect();
    let means = std::array::from_fn(|channel| {
        let mut sums = [Sums::default(); 2];
        let mut weights = 0.0;
        for (h, other) in [(0, 1), (1, 0)] {
            for (tested, known) in halves[h].means.iter().zip(&halves[other].means) {
                let light = known[channel][0].mean.max(known[channel][1].mean);
                let var = known[channel][0].var + known[channel][1].var;
                let weight = light / (var + (KNOWN * light).powi(2));
                if !(weight.is_finite() && weight > 0.0) {
                    continue;
                }
                weights += weight * light;
                sums.iter_mut().zip(&tested[channel]).for_each(|(sums, mean)| sums.push(mean, weight));
            }
        }
        sums.map(|sums| sums.mean(weights))
    });
    Some(Weighted { means })
}

impl Weighted {
    pub fn findings(&self, level: f64, [width, height]: [usize; 2]) -> Vec<Finding> {
        let mut quantiles = Quantiles::new(level);
        let area = Area { x: 0, y: 0, width, height };
        let channels = self.means.iter().enumerate();
        channels.map(|(channel, [a, b])| test::test(a, b, area, channel, &mut quantiles)).collect()
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
