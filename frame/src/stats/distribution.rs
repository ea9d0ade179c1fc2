//! The normal distribution and Student's t: tails and quantiles, accurate to 1e-12 of the tail.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// Chance of a standard normal value below `z`.
pub fn normal_cdf(z: f64) -> f64 {
    cdf_of_tail(z, normal_two_sided(z))
}

/// Chance of a standard normal value as far from 0 as `z`, or farther; small values keep their digits.
pub fn normal_two_sided(z: f64) -> f64 {
    erfc(z.abs() * FRAC_1_SQRT_2)
}

/// The z with [`normal_cdf`]`(z) = p`; ∓∞ at 0 and 1 and beyond.
pub fn normal_quantile(p: f64) -> f64 {
    quantile(p, normal_two_sided)
}

/// Chance of a value below `t` of Student's t with `dof` degrees of freedom (any positive number, ∞ for
/// the normal distribution).
pub fn student_t_cdf(t: f64, dof: f64) -> f64 {
    cdf_of_tail(t, student_t_two_sided(t, dof))
}

/// Chance of a value of Student's t as far from 0 as `t`, or farther: the p of a t test. Small values
/// keep their digits.
///
/// ```text
/// I_x(dof/2, 1/2),  x = dof / (dof + t²)      (regularised incomplete beta, DLMF 8.17)
/// ```
pub fn student_t_two_sided(t: f64, dof: f64) -> f64 {
    if t.is_nan() || dof.is_nan() || dof <= 0.0 {
        return f64::NAN;
    }
    if t.is_infinite() {
        return 0.0;
    }
    if dof.is_infinite() {
        return normal_two_sided(t);
    }
    if dof > 1e4 {
        // The continued fraction would take √dof steps; Hill's expansion is exact to 1e-14 here.
        return normal_two_sided(normal_of_student_t(t, dof));
    }
    // x, 1 − x and ln x, none by a subtraction; u² may overflow or vanish.
    let u = t.abs() / dof.sqrt();
    let (x, y, ln_x) = if u < 1.0 {
        let square = u * u;
        (1.0 / (1.0 + square), square / (1.0 + square), -square.ln_1p())
    } else {
        let square = (1.0 / u) * (1.0 / u);
        (square / (1.0 + square), 1.0 / (1.0 + square), -2.0 * u.ln() - square.ln_1p())
    };
    incomplete_beta_half(0.5 * dof, x, y, ln_x)
}

/// The t with [`student_t_cdf`]`(t, dof) = p`; ∓∞ at 0 and 1 and beyond.
pub fn student_t_quantile(p: f64, dof: f64) -> f64 {
    if dof.is_nan() || dof <= 0.0 {
        return f64::NAN;
    }
    quantile(p, |t| student_t_two_sided(t, dof))
}

fn cdf_of_tail(x: f64, two_sided: f64) -> f64 {
    if x < 0.0 { 0.5 * two_sided } else { 1.0 - 0.5 * two_sided }
}

/// Quantile of a distribution that is symmetric about 0, from its two-sided tail, by bisection down to
/// neighbouring numbers: some seventy evaluations, which nothing here is in a hurry for.
fn quantile(p: f64, two_sided: impl Fn(f64) -> f64) -> f64 {
    if p.is_nan() {
        return f64::NAN;
    }
    let sign = if p < 0.5 { -1.0 } else { 1.0 };
    let target = 2.0 * p.min(1.0 - p);
    if target <= 0.0 {
        return sign * f64::INFINITY;
    }
    let (mut low, mut high) = (0.0, 1.0);
    while high < f64::MAX && two_sided(high) > target {
        low = high;
        high = (2.0 * high).min(f64::MAX);
    }
    loop {
        let middle = low + 0.5 * (high - low);
        if middle <= low || middle >= high {
            return sign * middle;
        }
        if two_sided(middle) > target {
            low = middle;
        } else {
            high = middle;
        }
    }
}

/// The complementary error function for x ≥ 0, to a few units in the last place of itself.
fn erfc(x: f64) -> f64 {
    if x.is_nan() {
        return f64::NAN;
    }
    if x < 2.0 {
        // erf x = 2/√π e^(−x²) Σ 2ⁿ x^(2n+1) / (2n+1)!!   (DLMF 7.6.2): all terms positive.
        let (mut term, mut sum, mut n) = (x, x, 0.0);
        while term > sum * f64::EPSILON * 0.1 {
            n += 1.0;
            term *= 2.0 * x * x / (2.0 * n + 1.0);
            sum += term;
        }
        return 1.0 - 2.0 / PI.sqrt() * (-x * x).exp() * sum;
    }
    if x > 28.0 {
        return 0.0; // below the smallest number
    }
    // erfc x = e^(−x²)/√π · 1/(x + (1/2)/(x + 1/(x + (3/2)/(x + …))))   (DLMF 7.9.1), from the far end.
    let mut fraction = x;
    for n in (1..=200).rev() {
        fraction = x + 0.5 * f64::from(n) / fraction;
    }
    (-x * x).exp() / (PI.sqrt() * fraction)
}

/// The normal deviate with the tail of `t` (Hill 1970, CACM 13:617, after Cornish and Fisher).
fn normal_of_student_t(t: f64, dof: f64) -> f64 {
    let a = dof - 0.5;
    let b = 48.0 * a * a;
    let u = t / dof.sqrt();
    let square = a * (u * u).ln_1p();
    let z = square.sqrt();
    let correction =
        (((-0.4 * square - 3.3) * square - 24.0) * square - 85.5) / (0.8 * square * square + 100.0 + b);
    z + (correction + square + 3.0) / b * z
}

/// The regularised incomplete beta function I_x(a, 1/2) for a ≤ 5000 and y = 1 − x.
fn incomplete_beta_half(a: f64, x: f64, y: f64, ln_x: f64) -> f64 {
    if y <= 0.0 {
        return 1.0;
    }
    // x^a y^(1/2) / B(a, 1/2), where B(a, 1/2) = √π Γ(a)/Γ(a + 1/2).
    let front = (a * ln_x + ln_gamma(a + 0.5) - ln_gamma(a)).exp() * (y / PI).sqrt();
    if x * (a + 2.5) < a + 1.0 {
        front * beta_fraction(a, 0.5, x) / a
    } else {
        1.0 - front * beta_fraction(0.5, a, y) / 0.5
    }
}

/// The continued fraction of the incomplete beta function (DLMF 8.17.22) by Lentz's method; within
/// x < (a + 1)/(a + b + 2) it takes O(√max(a, b)) steps.
fn beta_fraction(a: f64, b: f64, x: f64) -> f64 {
    let tiny = f64::MIN_POSITIVE; // stands in for a zero denominator
    let nonzero = |v: f64| if v == 0.0 { tiny } else { v };
    let mut c = 1.0;
    let mut d = 1.0 / nonzero(1.0 - (a + b) * x / (a + 1.0));
    let mut fraction = d;
    for step in 1..2000 {
        let m = f64::from(step);
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        d = 1.0 / nonzero(1.0 + even * d);
        c = nonzero(1.0 + even / c);
        fraction *= c * d;
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        d = 1.0 / nonzero(1.0 + odd * d);
        c = nonzero(1.0 + odd / c);
        fraction *= c * d;
        if (c * d - 1.0).abs() < 1e-15 {
            break;
        }
    }
    fraction
}

/// ln Γ(x) for x > 0 by Stirling's series (DLMF 5.11.1), after the recurrence has moved x to 10 or more.
fn ln_gamma(x: f64) -> f64 {
    let (mut x, mut product) = (x, 1.0);
    while x < 10.0 {
        product *= x;
        x += 1.0;
    }
    let r = 1.0 / (x * x);
    let series = (1.0 / 12.0
        - r * (1.0 / 360.0
            - r * (1.0 / 1260.0
                - r * (1.0 / 1680.0 - r * (1.0 / 1188.0 - r * (691.0 / 360_360.0 - r / 156.0))))))
        / x;
    (x - 0.5) * x.ln() - x + 0.5 * (2.0 * PI).ln() + series - product.ln()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

    fn close(ours: f64, theirs: f64, relative: f64) -> bool {
        ours == theirs || (ours - theirs).abs() <= relative * theirs.abs()
    }

    #[test]
    fn known_values_are_met() {
        // Abramowitz and Stegun, tables 26.1 and 26.10, and closed forms for 1 and 2 degrees of freedom.
        assert!((normal_quantile(0.975) - 1.959_963_984_540_054).abs() < 1e-14);
        assert!((student_t_quantile(0.975, 1.0) - (0.475 * PI).tan()).abs() < 1e-11);
        assert!((student_t_quantile(0.975, 2.0) - 0.95 / (2.0 * 0.975_f64 * 0.025).sqrt()).abs() < 1e-12);
        assert!((student_t_quantile(0.975, 10.0) - 2.228_138_851_986_27).abs() < 1e-11);
        assert!((student_t_cdf(1.0, 1.0) - 0.75).abs() < 1e-15);
        assert!(close(normal_two_sided(10.0), 1.523_970_604_832_094e-23, 1e-12));
    }

    #[test]
    fn far_tails_keep_their_digits() {
        // One degree of freedom: two-sided tail 2/π atan(1/t).
        for t in [1e3, 1e8, 1e100, 1e200] {
            let tail = student_t_two_sided(t, 1.0);
            assert!(close(tail, 2.0 / PI * (1.0 / t).atan(), 1e-12), "{t}: {tail}");
        }
    }

    #[test]
    fn the_switch_to_hills_expansion_has_no_step() {
        for t in [1e-3, 0.5, 1.0, 2.0, 4.0, 8.0, 20.0] {
            let (below, above) = (student_t_two_sided(t, 1e4), student_t_two_sided(t, 1e4_f64.next_up()));
            assert!(close(below, above, 1e-11), "{t}: {below} {above}");
        }
        assert!(close(student_t_two_sided(3.0, 1e12), normal_two_sided(3.0), 1e-9));
        assert_eq!(student_t_two_sided(3.0, f64::INFINITY), normal_two_sided(3.0));
    }

    #[test]
    fn the_ends_of_the_range_are_what_they_must_be() {
        assert_eq!(
            (normal_cdf(f64::NEG_INFINITY), normal_cdf(0.0), normal_cdf(f64::INFINITY)),
            (0.0, 0.5, 1.0)
        );
        assert_eq!(
            (normal_quantile(0.0), normal_quantile(0.5), normal_quantile(1.0)),
            (-f64::INFINITY, 0.0, f64::INFINITY)
        );
        assert_eq!((student_t_cdf(0.0, 3.0), student_t_two_sided(f64::INFINITY, 3.0)), (0.5, 0.0));
        for bad in [student_t_cdf(1.0, 0.0), student_t_cdf(f64::NAN, 1.0), student_t_quantile(0.9, -1.0)] {
            assert!(bad.is_nan());
        }
        assert!(student_t_quantile(1e-300, 0.01).is_finite()); // the true value is beyond all numbers
    }

    proptest! {
        #[test]
        fn normal_agrees_with_statrs(z in -8.0_f64..8.0) {
            let theirs = Normal::standard().cdf(z);
            prop_assert!(close(normal_cdf(z), theirs, 1e-9), "{} {}", normal_cdf(z), theirs);
        }

        #[test]
        fn student_t_agrees_with_statrs(t in -30.0_f64..30.0, log_dof in -1.0_f64..6.0) {
            let dof = 10_f64.powf(log_dof);
            let theirs = StudentsT::new(0.0, 1.0, dof).expect("valid").cdf(t);
            let ours = student_t_cdf(t, dof);
            prop_assert!((ours - theirs).abs() < 1e-9, "{} {}", ours, theirs);
        }

        #[test]
        fn quantiles_invert_the_cdf(p in 1e-9_f64..1.0, log_dof in -0.5_f64..7.0) {
            let dof = 10_f64.powf(log_dof);
            prop_assert!((student_t_cdf(student_t_quantile(p, dof), dof) - p).abs() < 1e-12);
            prop_assert!((normal_cdf(normal_quantile(p)) - p).abs() < 1e-14);
        }
    }
}
