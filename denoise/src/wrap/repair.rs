//! Numbers that would spoil others: values that are not finite, and extreme exposures.

use crate::plane::{Plane, Size};

/// What variances are limited to after scaling: sums of them over a patch must not overflow.
const MAX_VARIANCE: f32 = 1e34;

/// Fills the pixels at which any plane is not finite, in all the planes, from the mean of the nearest ones
/// that are, ring by ring; zero if there are none. Returns how many there were.
///
/// The planes belong together (a mean, its halves and its variance), so that a pixel is whole or filled.
pub(crate) fn fill_non_finite(size: Size, planes: &mut [&mut Plane]) -> usize {
    let mut known: Vec<bool> =
        (0..size.len()).map(|p| planes.iter().all(|plane| plane[p].is_finite())).collect();
    let mut open: Vec<usize> = (0..size.len()).filter(|&p| !known[p]).collect();
    let filled = open.len();
    while !open.is_empty() {
        // A ring at a time: what this round fills becomes a source only in the next.
        let ready: Vec<usize> =
            open.iter().copied().filter(|&p| neighbours(size, p).any(|q| known[q])).collect();
        if ready.is_empty() {
            for plane in planes.iter_mut() {
                open.iter().for_each(|&p| plane[p] = 0.0);
            }
            break;
        }
        for plane in planes.iter_mut() {
            for &p in &ready {
                let (sum, count) = neighbours(size, p)
                    .filter(|&q| known[q])
                    .fold((0.0, 0), |(sum, count), q| (sum + f64::from(plane[q]), count + 1));
                plane[p] = (sum / f64::from(count)) as f32;
            }
        }
        ready.iter().for_each(|&p| known[p] = true);
        open.retain(|&p| !known[p]);
    }
    filled
}

/// The pixels of the 3 x 3 square around p that are inside the image.
fn neighbours(size: Size, p: usize) -> impl Iterator<Item = usize> {
    let (x, y) = (p % size.width, p / size.width);
    let rows = y.saturating_sub(1)..(y + 2).min(size.height);
    rows.flat_map(move |y| (x.saturating_sub(1)..(x + 2).min(size.width)).map(move |x| y * size.width + x))
}

/// The exponent e such that 2^−e brings the planes to an ordinary exposure: that of the median of their
/// values that are not zero, so that one huge value moves nothing; 0 if all are zero.
pub(crate) fn exposure_exponent(planes: &[Plane]) -> i32 {
    const LEAST: i32 = -149; // of the smallest f32
    let mut counts = [0_usize; 278];
    for value in planes.iter().flatten().filter(|value| value.is_finite() && **value != 0.0) {
        // Exact for any finite f32 once it is an f64, which has no denormals in that range.
        let exponent = ((f64::from(*value).to_bits() >> 52) & 0x7ff) as i32 - 1023;
        counts[(exponent - LEAST) as usize] += 1;
    }
    let half = counts.iter().sum::<usize>().div_ceil(2);
    let mut below = 0;
    for (e, count) in (LEAST..).zip(counts) {
        below += count;
        if half > 0 && below >= half {
            return e;
        }
    }
    0
}

/// Multiplies by 2^e, exactly but for what leaves the range of f32: that is kept just inside of it.
pub(crate) fn scale(plane: &mut [f32], e: i32) {
    let factor = 2.0_f64.powi(e);
    let limit = f64::from(f32::MAX) / 4096.0; // a window of them can still be summed
    for value in plane {
        *value = (f64::from(*value) * factor).clamp(-limit, limit) as f32;
    }
}

/// Multiplies a variance by 2^2e, limited to what the filters' sums can hold.
pub(crate) fn scale_variance(plane: &mut [f32], e: i32) {
    let factor = 2.0_f64.powi(2 * e);
    for value in plane {
        *value = (f64::from(*value) * factor).min(f64::from(MAX_VARIANCE)) as f32;
    }
}

/// Squares of differences, as variances are limited.
pub(crate) fn squared(difference: f32) -> f32 {
    (difference * difference).min(MAX_VARIANCE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hole_is_filled_from_its_border_inwards() {
        let size = Size { width: 5, height: 1 };
        let mut a = vec![1.0, f32::NAN, f32::INFINITY, 3.0, 3.0];
        let mut b = vec![2.0, 2.0, 2.0, 6.0, 6.0];
        assert_eq!(fill_non_finite(size, &mut [&mut a, &mut b]), 2);
        assert_eq!(a, [1.0, 1.0, 3.0, 3.0, 3.0]);
        assert_eq!(b, [2.0, 2.0, 6.0, 6.0, 6.0]);
    }

    #[test]
    fn an_image_without_a_finite_pixel_becomes_zero() {
        let mut plane = vec![f32::NAN; 4];
        assert_eq!(fill_non_finite(Size { width: 2, height: 2 }, &mut [&mut plane]), 4);
        assert_eq!(plane, [0.0; 4]);
    }

    #[test]
    fn the_exposure_is_that_of_the_median() {
        assert_eq!(exposure_exponent(&[vec![0.0, 1.5, 1.0, 1e30]]), 0);
        assert_eq!(exposure_exponent(&[vec![4.0; 3], vec![-5.0; 3]]), 2);
        assert_eq!(exposure_exponent(&[vec![f32::from_bits(1)]]), -149);
        assert_eq!(exposure_exponent(&[vec![f32::MAX]]), 127);
        assert_eq!(exposure_exponent(&[vec![0.0; 3]]), 0);
    }

    #[test]
    fn scaling_there_and_back_changes_no_bit() {
        for value in [1e-44_f32, 1e-39, 0.3, -7.25, 1e30] {
            let e = exposure_exponent(&[vec![value]]);
            let mut plane = vec![value];
            scale(&mut plane, -e);
            assert!((1.0..2.0).contains(&plane[0].abs()));
            scale(&mut plane, e);
            assert_eq!(plane[0], value);
        }
    }
}
