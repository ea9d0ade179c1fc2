//! Which light: half by power, half at random.
//!
//! By power alone, a lamp of 1e8 behind a wall would hide one of 1e-4 in front of the eye; uniformly, a thousand dim
//! lamps would hide a bright one. Half and half costs at most twice the samples of the better one. (A light tree, which
//! knows where the lamps are, will take its place.)

use crate::sampling::Distribution1d;

/// How a light takes part in the choice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Weigh {
    /// It emits nothing.
    Never,
    /// Its estimated power, in any unit that is the same for all.
    Power(f64),
}

/// `None` if all are [`Weigh::Never`].
pub fn choose_from(weights: &[Weigh]) -> Option<Distribution1d> {
    let power = |w: &Weigh| match w {
        Weigh::Power(power) if *power > 0.0 && power.is_finite() => *power,
        Weigh::Power(_) | Weigh::Never => 0.0,
    };
    let total: f64 = weights.iter().map(power).sum();
    let lit = weights.iter().filter(|w| **w != Weigh::Never).count() as f64;
    Distribution1d::new(weights.iter().map(|w| match w {
        Weigh::Never => 0.0,
        Weigh::Power(_) if total > 0.0 && total.is_finite() => 0.5 * power(w) / total + 0.5 / lit,
        Weigh::Power(_) => 1.0,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_light_that_emits_has_its_share() {
        let weights = [Weigh::Power(1e8), Weigh::Never, Weigh::Power(1e-4), Weigh::Power(0.0)];
        let choice = choose_from(&weights).unwrap();
        let pmf = [0, 1, 2, 3].map(|i| choice.pmf(i));
        assert!(pmf[1] == 0.0 && pmf[2] >= 0.16 && pmf[3] >= 0.16 && pmf[0] > 0.66, "{pmf:?}");
        assert!((pmf.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn powers_that_are_no_numbers_do_not_matter() {
        let choice = choose_from(&[Weigh::Power(f64::NAN), Weigh::Power(f64::INFINITY)]).unwrap();
        assert_eq!([0, 1].map(|i| choice.pmf(i)), [0.5, 0.5]);
        assert!(choose_from(&[Weigh::Never]).is_none());
        assert!(choose_from(&[]).is_none());
    }
}
