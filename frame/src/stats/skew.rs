//! Student's t where the values are skewed.

use super::student_t_two_sided;

/// The t of a mean whose own distribution has the skewness `skewness` (that of the values over √n), moved to where
/// Student's distribution tells its tail right to the next order (Hall 1992, J. R. Stat. Soc. B 54:221):
///
/// ```text
/// g(t) = t + γ t²/3 + γ² t³/27 + γ/6
/// ```
///
/// It grows with t for every γ, unlike Johnson's quadratic form, which turns large negative t into positive ones.
pub fn skew_corrected_t(t: f64, skewness: f64) -> f64 {
    // As a cube the terms in t cannot cancel: g = ((1 + γt/3)³ − 1)/γ + γ/6.
    let s = skewness * t / 3.0;
    t * (1.0 + s + s * s / 3.0) + skewness / 6.0
}

/// Chance of a t as far out under Student's distribution, once [`skew_corrected_t`] has moved it: two-sided.
pub fn skew_corrected_p(t: f64, skewness: f64, dof: f64) -> f64 {
    student_t_two_sided(skew_corrected_t(t, skewness), dof)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::Random;

    #[test]
    fn corrected_t_grows_with_t() {
        for skewness in [-2.0, -0.3, 0.0, 0.3, 2.0] {
            let values: Vec<f64> =
                (-400..400).map(|i| skew_corrected_t(f64::from(i) * 0.05, skewness)).collect();
            assert!(values.is_sorted(), "{skewness}");
        }
        assert_eq!(skew_corrected_t(1.7, 0.0), 1.7);
    }

    #[test]
    fn rare_bright_events_raise_no_more_alarms_than_promised() {
        // The mean of Poisson counts with expectation 30, told by its own estimate of the variance, which is the count
        // itself: few events make a low mean that looks certain. 40 000 trials at 1 %: a standard error of 0.05 %.
        let mut random = Random::new(5);
        let (mut plain, mut corrected) = (0, 0);
        let trials = 40_000;
        for _ in 0..trials {
            let (mut count, mut product) = (0.0_f64, random.uniform());
            while product > (-30.0_f64).exp() {
                count += 1.0;
                product *= random.uniform();
            }
            let t = (count - 30.0) / count.sqrt();
            let dof = 2.0 * count;
            plain += usize::from(student_t_two_sided(t, dof) < 0.01);
            corrected += usize::from(skew_corrected_p(t, 1.0 / count.sqrt(), dof) < 0.01);
        }
        let share = |n: usize| n as f64 / f64::from(trials);
        assert!(share(plain) > 0.013, "the trap must be one: {}", share(plain));
        assert!(share(corrected) < 0.010, "{}", share(corrected));
    }
}
