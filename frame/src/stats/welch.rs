//! Do two means differ? Welch's t test, and Šidák's correction for many such questions at once.

use super::{Welford, student_t_two_sided};

/// The outcome of [`welch_test`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Welch {
    /// (mean of a − mean of b) / its standard error; ±∞ without spread where the means differ.
    pub t: f64,
    /// Degrees of freedom after Welch and Satterthwaite; ∞ without spread.
    pub dof: f64,
    /// Chance of a |t| as large or larger if the true means are equal.
    pub p: f64,
    /// Neither set has any spread, so that the test rests on nothing but equality: `p` is 1 where the
    /// means are equal and 0 where not.
    pub no_spread: bool,
}

/// Welch's two-sided t test (Welch 1947) of whether two sets with their own variances have the same mean.
/// `None` if a set has fewer than two values, or its moments are not finite.
///
/// ```text
/// t = (ā − b̄) / √(s_a²/n_a + s_b²/n_b)
/// dof = (v_a + v_b)² / (v_a²/(n_a − 1) + v_b²/(n_b − 1)),   v = s²/n
/// ```
pub fn welch_test(a: &Welford, b: &Welford) -> Option<Welch> {
    let (va, vb) = (a.variance_of_mean()?, b.variance_of_mean()?);
    let difference = a.mean() - b.mean();
    let variance = va + vb;
    if !(difference.is_finite() && variance.is_finite()) {
        return None;
    }
    if variance == 0.0 {
        let (t, p) = if difference == 0.0 { (0.0, 1.0) } else { (difference * f64::INFINITY, 0.0) };
        return Some(Welch { t, dof: f64::INFINITY, p, no_spread: true });
    }
    // Shares of the variance instead of squares of it, which could underflow.
    let (wa, wb) = (va / variance, vb / variance);
    let dof = 1.0 / (wa * wa / (a.count() - 1) as f64 + wb * wb / (b.count() - 1) as f64);
    let t = difference / variance.sqrt();
    Some(Welch { t, dof, p: student_t_two_sided(t, dof), no_spread: false })
}

/// The level at which each of `tests` independent tests must be made so that all together raise a false
/// alarm with chance `level` (Šidák 1967): `1 − (1 − level)^(1/tests)`.
pub fn sidak_level(level: f64, tests: usize) -> f64 {
    -((-level).ln_1p() / tests.max(1) as f64).exp_m1()
}

/// The chance that the smallest p of `tests` independent tests is `p` or less: `1 − (1 − p)^tests`.
pub fn sidak_p(p: f64, tests: usize) -> f64 {
    if p >= 1.0 { 1.0 } else { -((-p).ln_1p() * tests.max(1) as f64).exp_m1() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(values: &[f64]) -> Welford {
        values.iter().copied().collect()
    }

    #[test]
    fn hc47_sets_without_spread_are_told_apart_and_flagged() {
        let ones = set(&[1.0; 4]);
        let same = welch_test(&ones, &ones).expect("enough values");
        assert_eq!((same.t, same.p, same.no_spread), (0.0, 1.0, true));
        let other = welch_test(&ones, &set(&[1.0 + 1e-6; 4])).expect("enough values");
        assert_eq!((other.t, other.p, other.no_spread), (f64::NEG_INFINITY, 0.0, true));
    }

    #[test]
    fn hc47_one_set_without_spread_is_tested_by_the_other() {
        let w = welch_test(&set(&[1.0; 4]), &set(&[1.0, 2.0, 3.0, 4.0])).expect("enough values");
        assert!((w.t + 2.323_79).abs() < 1e-5);
        assert!((w.dof - 3.0).abs() < 1e-12);
        assert!((w.p - 0.102_728).abs() < 1e-6);
        assert!(!w.no_spread);
    }

    #[test]
    fn unequal_variances_give_satterthwaites_degrees_of_freedom() {
        // a: n 3, mean 2, s² 1; b: n 5, mean 10, s² 50. va = 1/3, vb = 10.
        let w = welch_test(&set(&[1.0, 2.0, 3.0]), &set(&[0.0, 5.0, 15.0, 15.0, 15.0]));
        let w = w.expect("enough values");
        assert!((w.t + 8.0 / (31.0_f64 / 3.0).sqrt()).abs() < 1e-12);
        let expected = (31.0_f64 / 3.0).powi(2) / (1.0 / 9.0 / 2.0 + 100.0 / 4.0);
        assert!((w.dof - expected).abs() < 1e-12);
    }

    #[test]
    fn tiny_values_do_not_underflow() {
        let scaled =
            |k: f64| welch_test(&set(&[k, 2.0 * k, 3.0 * k]), &set(&[2.0 * k, 5.0 * k])).expect("enough");
        let (unit, tiny) = (scaled(1.0), scaled(2.0_f64.powi(-500)));
        assert_eq!((unit.dof, unit.p), (tiny.dof, tiny.p));
    }

    #[test]
    fn too_few_or_infinite_values_give_no_answer() {
        assert_eq!(welch_test(&set(&[1.0]), &set(&[1.0, 2.0])), None);
        assert_eq!(welch_test(&set(&[1.0, f64::INFINITY]), &set(&[1.0, 2.0])), None);
        assert_eq!(welch_test(&set(&[1.0, f64::NAN]), &set(&[1.0, 2.0])), None);
    }

    #[test]
    fn sidak_level_and_p_invert_each_other_down_to_tiny_levels() {
        assert!((sidak_level(0.05, 10) - 0.005_116_196_891_823_743).abs() < 1e-15);
        for (level, tests) in [(0.05, 1), (0.01, 1_000_000), (1e-12, 50)] {
            let each = sidak_level(level, tests);
            assert!(each > 0.0 && (sidak_p(each, tests) / level - 1.0).abs() < 1e-9, "{level} {tests}");
        }
        assert_eq!((sidak_p(1.0, 5), sidak_p(0.0, 5)), (1.0, 0.0));
    }
}
