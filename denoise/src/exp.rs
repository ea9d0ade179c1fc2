//! The exponential of weights, in a form that the compiler vectorises.

/// `exp(−x)` for `x ≥ 0`, within 3e-7 of it relative; exactly 0 from 87 on, where single precision ends,
/// and for a NaN: a distance that is not known means no weight.
///
/// `2^(−x log₂ e)` with the whole part put into the exponent's bits and a polynomial for the rest.
#[inline(always)]
pub(crate) fn exp_neg(x: f32) -> f32 {
    /// Added and taken away again, it rounds to a whole number, which stands in the sum's low bits meanwhile.
    const ROUND: f32 = 12_582_912.0; // 1.5 · 2²³
    /// ln 2 in two parts, the first of few bits, so that `whole * LN2_HIGH` is exact.
    const LN2_HIGH: f32 = 0.693_359_4;
    const LN2_LOW: f32 = -2.121_944_4e-4;
    let known = x < 87.0;
    let x = if known { -x } else { 0.0 };
    let rounded = x * std::f32::consts::LOG2_E + ROUND;
    let whole = rounded - ROUND;
    let r = (x - whole * LN2_HIGH) - whole * LN2_LOW; // |r| ≤ ln 2 / 2
    // Taylor's series of e^r: its next term, r⁷/5040, is below 1.2e-7 there.
    let p = 1.0 + r * (1.0 + r * (0.5 + r * (1.0 / 6.0 + r * (1.0 / 24.0 + r * (1.0 / 120.0 + r / 720.0)))));
    let power = f32::from_bits(rounded.to_bits().wrapping_shl(23).wrapping_add(0x3f80_0000));
    if known { p * power } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_exponential_of_double_precision() {
        for i in 0..=870_000_u32 {
            let x = i as f32 * 1e-4;
            let exact = (-f64::from(x)).exp();
            if x < 87.0 {
                let error = (f64::from(exp_neg(x)) - exact).abs() / exact;
                assert!(error < 3e-7, "x = {x}: {error}");
            }
        }
        assert_eq!(exp_neg(0.0), 1.0);
    }

    #[test]
    fn what_is_far_or_unknown_has_no_weight() {
        for x in [87.0, 1e6, f32::MAX, f32::INFINITY, f32::NAN] {
            assert_eq!(exp_neg(x), 0.0, "x = {x}");
        }
        assert_eq!(exp_neg(1e-40), 1.0);
    }
}
