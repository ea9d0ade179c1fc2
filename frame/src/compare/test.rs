//! One test: two means, how well each is known, and how small a difference would show.

use super::units::Area;
use crate::stats::{normal_quantile, skew_corrected_p, student_t_quantile};

/// The chance with which a detectable bias is found.
pub const POWER: f64 = 0.9;
/// Relative differences up to here are taken for rounding: renderers add up in 32 bits, and their tables of spectra,
/// metals and textures differ in the fifth digit. A picture may be rounded more: [`Estimate::set_rounding`](super::Estimate::set_rounding).
pub const ROUNDING: f64 = 1e-4;

/// A mean with its noise.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Mean {
    pub mean: f64,
    /// Of the mean.
    pub var: f64,
    /// Third cumulant of the mean; NaN where it is not known.
    pub third: f64,
    /// How well `var` is known.
    pub dof: f64,
}

/// What one test found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finding {
    /// Where.
    pub area: Area,
    /// 0 to 2: R, G, B.
    pub channel: usize,
    /// Of the first and the second picture.
    pub means: [f64; 2],
    /// Standard errors of both.
    pub errors: [f64; 2],
    /// Degrees of freedom.
    pub dof: f64,
    /// Chance of a difference as large where both means are equal; of this test alone.
    pub p: f64,
    /// The smallest relative difference that is found with chance [`POWER`]; 0 where there is no noise, ∞ where there
    /// is noise but no light.
    pub detectable: f64,
}

impl Finding {
    /// The mean of both pictures.
    pub fn brightness(&self) -> f64 {
        0.5 * (self.means[0] + self.means[1])
    }

    /// Standard error of the difference.
    pub fn error(&self) -> f64 {
        self.errors[0].hypot(self.errors[1])
    }

    /// How much brighter the first picture is, as a fraction of the second; 0 where both are equal.
    pub fn bias(&self) -> f64 {
        let [a, b] = self.means;
        if a == b { 0.0 } else { (a - b) / b.abs() }
    }
}

/// Welch's test of two means with corrections for skewness and rounding; an alarm is a p below `level`.
pub(super) fn test(
    a: &Mean,
    b: &Mean,
    area: Area,
    channel: usize,
    rounding: f64,
    quantiles: &mut Quantiles,
) -> Finding {
    let var = a.var + b.var;
    let difference = a.mean - b.mean;
    let beyond = (difference.abs() - rounding * a.mean.abs().max(b.mean.abs())).max(0.0).copysign(difference);
    let mut finding = Finding {
        area,
        channel,
        means: [a.mean, b.mean],
        errors: [a.var.sqrt(), b.var.sqrt()],
        dof: f64::INFINITY,
        p: 1.0,
        detectable: 0.0,
    };
    let light = finding.brightness();
    if var <= 0.0 {
        finding.p = if beyond == 0.0 { 1.0 } else { 0.0 };
        finding.detectable = if light > 0.0 { rounding } else { f64::INFINITY };
        return finding;
    }
    // Welch and Satterthwaite, in shares of the variance, whose squares cannot underflow.
    let (wa, wb) = (a.var / var, b.var / var);
    finding.dof = 1.0 / (wa * wa / a.dof + wb * wb / b.dof);
    let error = var.sqrt();
    if beyond != 0.0 {
        let p = |third: f64| {
            let skewness = third / (var * error);
            let skewness = if skewness.is_finite() { skewness } else { 0.0 };
            skew_corrected_p(beyond / error, skewness, finding.dof)
        };
        finding.p = match (a.third.is_nan(), b.third.is_nan()) {
            (false, false) => p(a.third - b.third),
            // The other's may be nothing, or cancel the known one: the more cautious of both.
            (false, true) => p(a.third).max(p(0.0)),
            (true, false) => p(-b.third).max(p(0.0)),
            (true, true) => p(0.0),
        };
    }
    let reach = (quantiles.two_sided(finding.dof) + normal_quantile(POWER)) * error;
    finding.detectable = if light > 0.0 { rounding + reach / light } else { f64::INFINITY };
    finding
}

/// Student's quantiles at one two-sided level. A picture has thousands of tests, and a quantile is a search: degrees
/// of freedom are rounded down to steps of 2 %, and each step is looked up once.
pub(super) struct Quantiles {
    level: f64,
    known: std::collections::BTreeMap<i32, f64>,
}

impl Quantiles {
    pub fn new(level: f64) -> Self {
        Self { level, known: std::collections::BTreeMap::new() }
    }

    fn two_sided(&mut self, dof: f64) -> f64 {
        let step = (dof.ln() / 1.02_f64.ln()).floor().clamp(-1000.0, 2000.0) as i32;
        let level = self.level;
        *self.known.entry(step).or_insert_with(|| student_t_quantile(1.0 - 0.5 * level, 1.02_f64.powi(step)))
    }
}
