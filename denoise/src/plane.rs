//! Planes of `f32` and the small filters on them.

use rayon::prelude::*;

/// One channel of an image: row-major from the top left.
pub(crate) type Plane = Vec<f32>;

/// Width and height in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size {
    pub width: usize,
    pub height: usize,
}

impl Size {
    pub fn len(self) -> usize {
        self.width * self.height
    }

    /// Computes a plane row by row on all cores; `row(y, out)`.
    pub fn rows(self, row: impl Fn(usize, &mut [f32]) + Sync) -> Plane {
        let mut out = vec![0.0; self.len()];
        out.par_chunks_mut(self.width.max(1)).enumerate().for_each(|(y, out)| row(y, out));
        out
    }
}

/// A new plane, pixel by pixel.
pub(crate) fn map2(a: &[f32], b: &[f32], f: impl Fn(f32, f32) -> f32) -> Plane {
    a.iter().zip(b).map(|(&a, &b)| f(a, b)).collect()
}

/// Mean over the square of side `2 radius + 1`, of its part inside the image.
///
/// Summed afresh at each pixel, not by a running sum: one huge value must not leave its rounding error
/// behind in the pixels that it is not part of.
pub(crate) fn box_mean(size: Size, plane: &[f32], radius: usize) -> Plane {
    weighted_mean(size, plane, &vec![1.0; 2 * radius + 1])
}

/// The smoothing of variances in Rousselle et al. 2013: three taps each way, weighted e⁻² : 1 : e⁻².
pub(crate) fn three_tap_mean(size: Size, plane: &[f32]) -> Plane {
    let side = (-2.0_f32).exp();
    weighted_mean(size, plane, &[side, 1.0, side])
}

/// Separable weighted mean over the part of the kernel that is inside the image.
fn weighted_mean(size: Size, plane: &[f32], kernel: &[f32]) -> Plane {
    let radius = kernel.len() / 2;
    // The taps that stay inside, as (tap, position).
    let taps = |at: usize, end: usize| {
        let first = at.saturating_sub(radius);
        let last = (at + radius).min(end - 1);
        (first..=last).map(move |q| (q + radius - at, q))
    };
    let across = size.rows(|y, out| {
        let row = &plane[y * size.width..][..size.width];
        for (x, out) in out.iter_mut().enumerate() {
            let (mut sum, mut weights) = (0.0, 0.0);
            for (tap, q) in taps(x, size.width) {
                sum += kernel[tap] * row[q];
                weights += kernel[tap];
            }
            *out = sum / weights;
        }
    });
    size.rows(|y, out| {
        let mut weights = 0.0;
        for (tap, q) in taps(y, size.height) {
            weights += kernel[tap];
            for (out, value) in out.iter_mut().zip(&across[q * size.width..]) {
                *out += kernel[tap] * value;
            }
        }
        out.iter_mut().for_each(|out| *out /= weights);
    })
}

/// Squared gradient as Rousselle et al. 2013 take it: of the half differences to both neighbours the
/// smaller one counts, so that it is zero beside a step and full on a ramp.
pub(crate) fn squared_gradient(size: Size, plane: &[f32]) -> Plane {
    let Size { width, height } = size;
    size.rows(|y, out| {
        for (x, out) in out.iter_mut().enumerate() {
            let p = y * width + x;
            let half = |q: usize| (0.5 * (plane[q] - plane[p])).powi(2);
            let mut sum = 0.0;
            if x > 0 && x + 1 < width {
                sum += half(p - 1).min(half(p + 1));
            }
            if y > 0 && y + 1 < height {
                sum += half(p - width).min(half(p + width));
            }
            *out = sum;
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_at_a_border_is_of_what_is_inside() {
        let size = Size { width: 3, height: 2 };
        let mean = box_mean(size, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0], 1);
        assert_eq!(mean, [3.0, 3.5, 4.0, 3.0, 3.5, 4.0]);
        assert_eq!(box_mean(size, &[7.0; 6], 10), [7.0; 6]);
    }

    #[test]
    fn one_huge_value_leaves_no_trace_outside_its_box() {
        let size = Size { width: 9, height: 1 };
        let mut plane = vec![0.1; 9];
        let without = box_mean(size, &plane, 1);
        plane[1] = 1e30;
        assert_eq!(box_mean(size, &plane, 1)[3..], without[3..]);
    }

    #[test]
    fn a_step_has_no_gradient_and_a_ramp_has_its_own() {
        let size = Size { width: 6, height: 1 };
        assert_eq!(squared_gradient(size, &[0.0, 0.0, 0.0, 1.0, 1.0, 1.0]), [0.0; 6]);
        let ramp = squared_gradient(size, &[0.0, 2.0, 4.0, 6.0, 8.0, 10.0]);
        assert_eq!(ramp, [0.0, 1.0, 1.0, 1.0, 1.0, 0.0]);
    }
}
