//! Are two noisy pictures the same picture?

use std::path::{Path, PathBuf};

use statrs::function::erf::erfc;

/// Chance that two pictures with the same expectation are called different.
const FALSE_ALARM: f64 = 1e-4;

/// A channel of a picture with the noise of its pixels, row by row from the top.
#[derive(Clone, Copy, Debug)]
pub struct Estimate<'a> {
    /// Means.
    pub mean: &'a [f32],
    /// Variances of those means: 0 for an exact reference.
    pub variance: &'a [f32],
}

/// The outcome of a comparison.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureTest {
    /// Largest |difference of block means| over its standard deviation.
    pub worst_z: f64,
    /// First pixel, x and y, of that block.
    pub worst_block: [usize; 2],
    /// Chance of a `worst_z` at least as large, over all blocks (Šidák 1967), if the pictures are the same.
    pub p: f64,
    /// Mean of the first picture over that of the second.
    pub mean_ratio: f64,
}

/// Compares the means of blocks of `block` × `block` pixels, which are nearly normal where those of pixels are not, by a
/// Z-test each.
///
/// # Panics
///
/// If a plane does not hold a whole number of rows of `width`, or planes differ in size.
pub fn compare_pictures(a: Estimate, b: Estimate, width: usize, block: usize) -> PictureTest {
    let n = a.mean.len();
    assert!([a.variance, b.mean, b.variance].iter().all(|plane| plane.len() == n), "planes differ in size");
    assert!(width > 0 && block > 0 && n > 0 && n.is_multiple_of(width), "{n} pixels in rows of {width}");
    let across = width.div_ceil(block);
    let mut blocks = vec![(0.0, 0.0); across * (n / width).div_ceil(block)];
    for i in 0..n {
        let (difference, variance) = &mut blocks[i / width / block * across + i % width / block];
        *difference += f64::from(a.mean[i]) - f64::from(b.mean[i]);
        *variance += f64::from(a.variance[i]) + f64::from(b.variance[i]);
    }
    // Equal blocks without noise are equal; NaN is different from everything.
    let z = |(difference, variance): (f64, f64)| match difference.abs() / variance.sqrt() {
        _ if difference == 0.0 => 0.0,
        z if z.is_nan() => f64::INFINITY,
        z => z,
    };
    let (worst, worst_z) = blocks
        .iter()
        .map(|&block| z(block))
        .enumerate()
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .expect("there is a pixel, and so a block");
    let one = erfc(worst_z / std::f64::consts::SQRT_2);
    let p = -(blocks.len() as f64 * (-one).ln_1p()).exp_m1();
    let sum = |plane: &[f32]| plane.iter().map(|&x| f64::from(x)).sum::<f64>();
    PictureTest {
        worst_z,
        worst_block: [worst % across * block, worst / across * block],
        p,
        mean_ratio: sum(a.mean) / sum(b.mean),
    }
}

/// Fails if the pictures differ by more than their noise, and then writes both and their difference (as PFM) into
/// the build folder. False-alarm rate 1e-4.
#[track_caller]
pub fn assert_same_picture(name: &str, a: Estimate, b: Estimate, width: usize, block: usize) {
    let test = compare_pictures(a, b, width, block);
    if test.p > FALSE_ALARM {
        return;
    }
    let difference: Vec<f32> = a.mean.iter().zip(b.mean).map(|(a, b)| a - b).collect();
    let mut paths = String::new();
    for (what, plane) in [("image", a.mean), ("reference", b.mean), ("difference", &difference)] {
        let path = build_folder().join(format!("{name}-{what}.pfm"));
        match write_pfm(&path, plane, width) {
            Ok(()) => paths += &format!("\n  {}", path.display()),
            Err(error) => paths += &format!("\n  {}: {error}", path.display()),
        }
    }
    panic!("{name}: the pictures differ: {test:?}{paths}");
}

/// Where the running test was built, or else the folder for temporary files.
fn build_folder() -> PathBuf {
    let test = std::env::current_exe().ok();
    test.as_deref().and_then(Path::parent).map_or_else(std::env::temp_dir, Path::to_path_buf)
}

/// One channel, rows from the bottom, little-endian.
fn write_pfm(path: &Path, plane: &[f32], width: usize) -> std::io::Result<()> {
    let mut bytes = format!("Pf\n{} {}\n-1.0\n", width, plane.len() / width).into_bytes();
    for row in plane.chunks(width).rev() {
        bytes.extend(row.iter().flat_map(|x| x.to_le_bytes()));
    }
    std::fs::write(path, bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Random;

    const WIDTH: usize = 48;

    /// A ramp with 10 % noise; `planted(x, y)` is a factor on it.
    fn noisy(seed: u64, planted: impl Fn(usize, usize) -> f32) -> (Vec<f32>, Vec<f32>) {
        let mut random = Random::new(seed);
        (0..WIDTH * 36)
            .map(|i| {
                let value = (1 + i % WIDTH) as f32;
                (value * planted(i % WIDTH, i / WIDTH) + 0.1 * value * random.normal(), (0.1 * value).powi(2))
            })
            .unzip()
    }

    fn test(a: &(Vec<f32>, Vec<f32>), b: &(Vec<f32>, Vec<f32>)) -> PictureTest {
        let estimate = |(mean, variance): &(Vec<f32>, Vec<f32>)| {
            let (mean, variance) = (mean.clone().leak(), variance.clone().leak());
            Estimate { mean, variance }
        };
        compare_pictures(estimate(a), estimate(b), WIDTH, 8)
    }

    #[test]
    fn pictures_that_differ_by_noise_pass() {
        // 200 pairs: below p = 0.05 in 10 ± 3.1; 25 has a false-alarm rate of 1e-5.
        let low =
            (0..200).filter(|i| test(&noisy(2 * i, |_, _| 1.0), &noisy(2 * i + 1, |_, _| 1.0)).p < 0.05);
        assert!((1..25).contains(&low.count()));
    }

    #[test]
    fn a_block_that_is_off_by_a_tenth_is_found_and_named() {
        let off = noisy(1, |x, y| if x / 8 == 2 && y / 8 == 3 { 1.1 } else { 1.0 });
        let found = test(&off, &noisy(2, |_, _| 1.0));
        assert!(found.p < FALSE_ALARM && found.worst_block == [16, 24], "{found:?}");
    }

    #[test]
    fn a_nan_is_a_difference_and_two_exact_equal_pictures_are_none() {
        let exact = (vec![1.0; WIDTH * 36], vec![0.0; WIDTH * 36]);
        assert_eq!(test(&exact, &exact).p, 1.0);
        let mut broken = exact.clone();
        broken.0[7] = f32::NAN;
        assert_eq!(test(&broken, &exact).p, 0.0);
    }
}
