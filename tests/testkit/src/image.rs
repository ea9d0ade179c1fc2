//! Do two noisy pictures show the same?

use statrs::distribution::{ContinuousCDF, Normal};

use crate::FALSE_ALARM;

/// A picture of one channel with the variance of its pixel means, row by row.
#[derive(Clone, Copy, Debug)]
pub struct NoisyImage<'a> {
    /// In pixels.
    pub width: usize,
    /// One a pixel.
    pub mean: &'a [f32],
    /// Of the mean, not of a sample; 0 for what is known exactly.
    pub variance: &'a [f32],
}

/// What [`compare_images`] found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImageDifference {
    /// Probability that equal pictures differ in any block as much as these in their worst (Šidák over the blocks).
    pub p: f64,
    /// Column and row of the worst block, in blocks.
    pub worst: [usize; 2],
    /// Difference of its means over its standard error.
    pub z: f64,
    /// Largest relative bias that could hide: 4 standard errors of the whole mean over that mean.
    pub detectable_bias: f64,
}

/// Z-test of the means of blocks of `block`² pixels. Blocks make the means normal, which single pixels of a path
/// tracer are not.
///
/// # Panics
///
/// If the two are not of the same size, or not finite.
pub fn compare_images(a: NoisyImage, b: NoisyImage, block: usize) -> ImageDifference {
    assert_eq!((a.width, a.mean.len()), (b.width, b.mean.len()), "sizes differ");
    assert!(
        a.mean.len() == a.variance.len() && b.mean.len() == b.variance.len(),
        "a variance for every pixel"
    );
    let columns = a.width.div_ceil(block);
    let rows = (a.mean.len() / a.width).div_ceil(block);
    // Difference, variance of it, and the larger of the sums: what rounding is measured by.
    let mut blocks = vec![[0.0f64; 3]; columns * rows];
    let mut whole = [0.0f64; 2];
    for i in 0..a.mean.len() {
        let (x, y) = (f64::from(a.mean[i]), f64::from(b.mean[i]));
        let variance = f64::from(a.variance[i]) + f64::from(b.variance[i]);
        assert!((x - y).is_finite() && variance >= 0.0, "pixel {i}: {x}, {y}, variance {variance}");
        let sums = &mut blocks[i / a.width / block * columns + i % a.width / block];
        *sums = [sums[0] + x - y, sums[1] + variance, sums[2] + x.abs().max(y.abs())];
        whole = [whole[0] + y, whole[1] + variance];
    }
    let z = |&[difference, variance, scale]: &[f64; 3]| {
        // Without noise, f32 means of the same thing still differ in their last bits.
        let rounding = f64::from(f32::EPSILON) * scale;
        if difference.abs() <= rounding { 0.0 } else { difference / variance.sqrt().max(rounding / 4.0) }
    };
    let worst =
        (0..blocks.len()).max_by(|&i, &j| z(&blocks[i]).abs().total_cmp(&z(&blocks[j]).abs())).unwrap_or(0);
    let z = blocks.get(worst).map_or(0.0, z);
    let p_block = 2.0 * Normal::standard().sf(z.abs());
    // 1 − (1 − p)^n without losing a small p.
    let p = -(blocks.len() as f64 * (-p_block).ln_1p()).exp_m1();
    let detectable_bias = 4.0 * whole[1].sqrt() / whole[0].abs();
    ImageDifference { p, worst: [worst % columns.max(1), worst / columns.max(1)], z, detectable_bias }
}

/// Panics if the pictures differ.
#[track_caller]
pub fn assert_same_image(a: NoisyImage, b: NoisyImage, block: usize) {
    let difference = compare_images(a, b, block);
    assert!(difference.p >= FALSE_ALARM, "pictures differ: {difference:?}");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rng;

    const SIZE: usize = 64;

    /// 16 uniform samples a pixel around `level`, with their own estimate of the variance.
    fn noisy(seed: u64, level: impl Fn(usize) -> f32) -> (Vec<f32>, Vec<f32>) {
        let mut rng = Rng::new(seed);
        let pixel = |i: usize| {
            let samples: [f32; 16] = std::array::from_fn(|_| 2.0 * rng.uniform() * level(i));
            let mean = samples.iter().sum::<f32>() / 16.0;
            (mean, samples.iter().map(|x| (x - mean).powi(2)).sum::<f32>() / (15.0 * 16.0))
        };
        (0..SIZE * SIZE).map(pixel).unzip()
    }

    fn compare(a: impl Fn(usize) -> f32, b: impl Fn(usize) -> f32) -> ImageDifference {
        let (a, b) = (noisy(1, a), noisy(2, b));
        let picture = |(mean, variance)| NoisyImage { width: SIZE, mean, variance };
        compare_images(picture((&a.0, &a.1)), picture((&b.0, &b.1)), 8)
    }

    #[test]
    fn equal_pictures_agree_whatever_their_noise() {
        let difference = compare(|i| 1.0 + i as f32, |i| 1.0 + i as f32);
        assert!(difference.p > 0.01, "{difference:?}");
    }

    #[test]
    fn block_that_is_off_is_found() {
        let dent = |i: usize| if i % SIZE / 8 == 3 && i / SIZE / 8 == 5 { 1.25 } else { 1.0 };
        let difference = compare(|_| 1.0, dent);
        assert!(difference.p < FALSE_ALARM && difference.worst == [3, 5], "{difference:?}");
    }

    #[test]
    fn pictures_without_noise_must_be_equal_but_for_rounding() {
        let exact = |mean: &[f32]| {
            let variance = vec![0.0; mean.len()];
            compare_images(
                NoisyImage { width: 8, mean: &[0.5; 64], variance: &variance },
                NoisyImage { width: 8, mean, variance: &variance },
                4,
            )
        };
        assert_eq!(exact(&[0.5f32.next_up(); 64]).p, 1.0);
        assert!(exact(&[0.500_01; 64]).p < FALSE_ALARM);
    }
}
