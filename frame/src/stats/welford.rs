//! Running mean and central moments.

/// Count, mean and central moment sums of values that come one by one, without the cancellation that
/// sums of squares suffer (Welford 1962; third moment and merging: Pébay 2008, eqs. 1.1–2.9).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Welford {
    count: u64,
    mean: f64,
    m2: f64,
    m3: f64,
}

impl Welford {
    /// Takes one value in.
    pub fn push(&mut self, x: f64) {
        self.count += 1;
        let n = self.count as f64;
        let delta = x - self.mean;
        let step = delta / n;
        let term = delta * step * (n - 1.0);
        self.mean += step;
        self.m3 += step * (term * (n - 2.0) - 3.0 * self.m2);
        self.m2 += term;
    }

    /// Takes in all values of `other`, as if they had been pushed.
    pub fn merge(&mut self, other: &Welford) {
        if other.count == 0 {
            return;
        }
        if self.count == 0 {
            *self = *other;
            return;
        }
        let (na, nb) = (self.count as f64, other.count as f64);
        let n = na + nb;
        let delta = other.mean - self.mean;
        let step = delta / n;
        self.m3 += other.m3
            + delta * step * step * na * nb * (na - nb)
            + 3.0 * step * (na * other.m2 - nb * self.m2);
        self.m2 += other.m2 + delta * step * na * nb;
        self.mean += step * nb;
        self.count += other.count;
    }

    /// Values taken in.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Their mean; 0 without values.
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// Sum of squared deviations from the mean.
    pub fn m2(&self) -> f64 {
        self.m2
    }

    /// Sum of cubed deviations from the mean.
    pub fn m3(&self) -> f64 {
        self.m3
    }

    /// Unbiased variance of the values, `m2 / (n − 1)`; `None` with fewer than two.
    pub fn variance(&self) -> Option<f64> {
        (self.count >= 2).then(|| self.m2 / (self.count - 1) as f64)
    }

    /// Variance of their mean, `m2 / (n (n − 1))`; `None` with fewer than two values.
    pub fn variance_of_mean(&self) -> Option<f64> {
        self.variance().map(|v| v / self.count as f64)
    }

    /// Skewness `√n m3 / m2^(3/2)`; `None` where there is no spread.
    pub fn skewness(&self) -> Option<f64> {
        (self.m2 > 0.0).then(|| (self.count as f64).sqrt() * (self.m3 / self.m2) / self.m2.sqrt())
    }
}

impl Extend<f64> for Welford {
    fn extend<I: IntoIterator<Item = f64>>(&mut self, values: I) {
        values.into_iter().for_each(|x| self.push(x));
    }
}

impl FromIterator<f64> for Welford {
    fn from_iter<I: IntoIterator<Item = f64>>(values: I) -> Self {
        let mut moments = Welford::default();
        moments.extend(values);
        moments
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn hc49_a_shift_does_not_move_the_variance() {
        for shift in [0.0, 4096.0, 1e5, 1e6, 1e8, 1e9] {
            let moments: Welford = [4.0, 7.0, 13.0, 16.0].iter().map(|x| x + shift).collect();
            let variance = moments.variance().expect("four values");
            assert!((variance - 30.0).abs() < 1e-9, "shift {shift}: {variance}");
            assert!((moments.mean() - 10.0 - shift).abs() < 1e-6);
        }
        for shift in [4096.0_f32, 1e5, 1e6] {
            let moments: Welford = [4.0_f32, 7.0, 13.0, 16.0].iter().map(|x| f64::from(x + shift)).collect();
            assert!((moments.variance().expect("four values") - 30.0).abs() < 1e-5);
        }
    }

    #[test]
    fn skewness_of_a_skewed_set_is_that_of_its_formula() {
        // Deviations −1, −1, 2 from the mean: m2 = 6, m3 = 6, so √3 · 6 / 6^1.5 = 1/√2.
        let moments: Welford = [0.0, 0.0, 3.0].into_iter().collect();
        assert!((moments.skewness().expect("has spread") - 0.5_f64.sqrt()).abs() < 1e-15);
        let flat: Welford = [5.0, 5.0].into_iter().collect();
        assert_eq!(flat.skewness(), None);
    }

    #[test]
    fn one_value_has_no_variance() {
        let one: Welford = [5.0].into_iter().collect();
        assert_eq!((one.mean(), one.variance(), one.variance_of_mean()), (5.0, None, None));
    }

    proptest! {
        #[test]
        fn merging_parts_equals_pushing_all(values in prop::collection::vec(-1e3_f64..1e3, 0..40), cut in 0_usize..40) {
            let cut = cut.min(values.len());
            let all: Welford = values.iter().copied().collect();
            let mut parts: Welford = values[..cut].iter().copied().collect();
            parts.merge(&values[cut..].iter().copied().collect());
            prop_assert_eq!(parts.count(), all.count());
            // Rounding grows with the size of the values: 1e3 to the power of the moment, times their number.
            prop_assert!((parts.mean() - all.mean()).abs() < 1e-11);
            prop_assert!((parts.m2() - all.m2()).abs() < 1e-7);
            prop_assert!((parts.m3() - all.m3()).abs() < 1e-3);
        }
    }
}
