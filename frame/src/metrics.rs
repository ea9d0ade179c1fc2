//! Pointwise errors of a picture against a reference.

use serde::{Deserialize, Serialize};

use crate::{Frame, FrameError, display_transform};

/// What keeps relative errors finite where the reference is black: radiance² in [`Metrics::relmse`],
/// radiance in [`Metrics::smape`]. Below it errors count as absolute; it belongs to the definition.
pub(crate) const EPSILON: f64 = 0.01;
/// The share of the pixels that [`Metrics::relmse_trimmed`] drops.
const TRIMMED_SHARE: f64 = 0.001;

/// How far a picture x is from its reference r: means over pixels and the channels R, G and B, of linear
/// radiance at the scene's own exposure where nothing else is said. Sums are in double precision.
///
/// A pixel with a value that is not finite in either picture is left out of all of them and counted.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Metrics {
    /// Mean of (x − r)².
    pub mse: f64,
    /// Mean of (x − r)² / (r² + 0.01).
    pub relmse: f64,
    /// The same without the worst 0.1 % of the pixels by their mean over channels (rounded down: of
    /// fewer than 1000 pixels none is dropped), as Rousselle et al. 2012 report it.
    pub relmse_trimmed: f64,
    /// Mean of |x − r| / (|x| + |r| + 0.01), in `[0, 1)`.
    pub smape: f64,
    /// Peak signal to noise ratio in dB of the pictures as [`display_transform`] shows them (clamped to
    /// `[0, 1]`, sRGB, not rounded to 8 bits): −10 log₁₀ of their MSE. `None` (JSON null) stands for +∞:
    /// they look exactly the same.
    pub psnr: Option<f64>,
    /// Pixels left out, for not being finite in one of the pictures.
    pub left_out: usize,
}

/// Compares the R, G and B of two frames.
///
/// # Errors
///
/// [`FrameError::SizesDiffer`], [`FrameError::MissingChannel`], and [`FrameError::NothingToCompare`] if
/// no pixel is finite in both.
pub fn metrics(picture: &Frame, reference: &Frame) -> Result<Metrics, FrameError> {
    let (size, reference_size) =
        ((picture.width(), picture.height()), (reference.width(), reference.height()));
    if size != reference_size {
        return Err(FrameError::SizesDiffer { picture: size, reference: reference_size });
    }
    let (x, r) = (picture.rgb()?, reference.rgb()?);
    let mut relative = Vec::with_capacity(picture.len()); // of each pixel, mean over channels
    let (mut mse, mut smape, mut display_mse) = (0.0, 0.0, 0.0);
    for p in 0..picture.len() {
        let pairs: [(f32, f32); 3] = std::array::from_fn(|c| (x[c][p], r[c][p]));
        if !pairs.iter().all(|(x, r)| x.is_finite() && r.is_finite()) {
            continue;
        }
        let mut pixel = 0.0;
        for (x, r) in pairs {
            let shown = f64::from(display_transform(x)) - f64::from(display_transform(r));
            let (x, r) = (f64::from(x), f64::from(r));
            let squared = (x - r).powi(2);
            mse += squared;
            pixel += squared / (r * r + EPSILON);
            smape += (x - r).abs() / (x.abs() + r.abs() + EPSILON);
            display_mse += shown * shown;
        }
        relative.push(pixel / 3.0);
    }
    if relative.is_empty() {
        return Err(FrameError::NothingToCompare { pixels: picture.len() });
    }
    let values = 3.0 * relative.len() as f64;
    let display_mse = display_mse / values;
    let left_out = picture.len() - relative.len();
    Ok(Metrics {
        mse: mse / values,
        relmse: mean(&relative),
        relmse_trimmed: trimmed_mean(&mut relative),
        smape: smape / values,
        psnr: (display_mse > 0.0).then(|| -10.0 * display_mse.log10()),
        left_out,
    })
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Mean without the largest 0.1 %; reorders the values.
fn trimmed_mean(values: &mut [f64]) -> f64 {
    let dropped = (values.len() as f64 * TRIMMED_SHARE) as usize;
    let kept = values.len() - dropped;
    // Sorted, not selected: the order of the sum must not depend on how a selection partitions.
    values.sort_unstable_by(f64::total_cmp);
    mean(&values[..kept])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(width: usize, height: usize, plane: &[f32]) -> Frame {
        let mut frame = Frame::new(width, height);
        for c in ["R", "G", "B"] {
            frame.insert(c, plane.to_vec());
        }
        frame
    }

    #[test]
    fn hc53_identical_pictures_differ_by_nothing() {
        for plane in [vec![0.0; 6], vec![0.5; 6], vec![3e38, -3e38, 1e-45, 0.0, -0.0, 7.0]] {
            let picture = grey(3, 2, &plane);
            let m = metrics(&picture, &picture).expect("comparable");
            assert_eq!((m.mse, m.relmse, m.relmse_trimmed, m.smape, m.psnr), (0.0, 0.0, 0.0, 0.0, None));
            assert_eq!(m.left_out, 0);
        }
    }

    #[test]
    fn hc53_a_black_reference_gives_finite_errors() {
        let m = metrics(&grey(1, 1, &[0.5]), &grey(1, 1, &[0.0])).expect("comparable");
        assert_eq!(m.mse, 0.25);
        assert!((m.relmse - 25.0).abs() < 1e-12);
        assert_eq!(m.relmse_trimmed, m.relmse);
        assert!((m.smape - 0.5 / 0.51).abs() < 1e-12);
        // sRGB of 0.5 is 0.735357, so 20 log10 of its inverse.
        assert!((m.psnr.expect("finite") - 2.670_036).abs() < 1e-5, "{:?}", m.psnr);
    }

    #[test]
    fn hc53_a_pixel_that_is_not_finite_is_left_out_and_counted() {
        let reference = grey(2, 2, &[0.0, 1.0, 1.0, 1.0]);
        for bad in [f32::NAN, f32::INFINITY] {
            let mut picture = grey(2, 2, &[0.5, 1.0, 1.0, 1.0]);
            picture.insert("G", vec![0.5, 1.0, bad, 1.0]);
            for m in [metrics(&picture, &reference), metrics(&reference, &picture)] {
                let m = m.expect("comparable");
                assert_eq!(m.left_out, 1);
                assert!((m.mse - 0.25 / 3.0).abs() < 1e-12);
            }
        }
        let all_bad = grey(2, 2, &[f32::NAN; 4]);
        let error = metrics(&all_bad, &reference).expect_err("nothing is left");
        assert!(matches!(error, FrameError::NothingToCompare { pixels: 4 }), "{error:?}");
    }

    #[test]
    fn hc53_sizes_that_differ_are_an_error_that_names_both() {
        let error = metrics(&grey(3, 2, &[0.0; 6]), &grey(2, 3, &[0.0; 6])).expect_err("must not compare");
        assert_eq!(error.to_string(), "the pictures differ in size: 3x2, the reference 2x3");
    }

    #[test]
    fn trimming_drops_the_worst_pixel_of_a_thousand() {
        let mut plane = vec![1.1; 1000];
        plane[371] = 1e4; // a firefly
        let m = metrics(&grey(50, 20, &plane), &grey(50, 20, &[1.0; 1000])).expect("comparable");
        let usual = (f64::from(1.1_f32) - 1.0).powi(2) / 1.01;
        assert!((m.relmse_trimmed - usual).abs() < 1e-12);
        assert!(m.relmse > 9e4);
    }

    #[test]
    fn channels_count_each_by_itself() {
        let mut picture = grey(1, 1, &[1.0]);
        picture.insert("B", vec![0.0]);
        let m = metrics(&picture, &grey(1, 1, &[1.0])).expect("comparable");
        assert!((m.mse - 1.0 / 3.0).abs() < 1e-12);
        assert!((m.relmse - 1.0 / 1.01 / 3.0).abs() < 1e-12);
        assert!((m.smape - 1.0 / 1.01 / 3.0).abs() < 1e-12);
        assert!((m.psnr.expect("finite") - 10.0 * 3.0_f64.log10()).abs() < 1e-5);
    }
}
