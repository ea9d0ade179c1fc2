//! The seeds are fixed: a test that passes once always passes. The chance that a right sampler would have failed with
//! a random seed is stated at each.

use super::*;

const BOTH: [Sampler; 2] = [Sampler::Independent, Sampler::Sobol];
const DIMS: [Dim; 6] =
    [Dim::Pixel, Dim::Light(0), Dim::Bsdf(0), Dim::Light(1), Dim::Bsdf(1), Dim::Roulette(3)];

fn of(sampler: Sampler, pixel: [u32; 2], sample: u32) -> PixelSampler {
    PixelSampler::new(sampler, 7, 0, pixel, sample)
}

/// Correlation of numbers with mean ½ and variance 1/12: standard normal for independent ones.
fn z_of(pairs: impl Iterator<Item = (f32, f32)>) -> f64 {
    let (mut sum, mut n) = (0.0, 0.0);
    for (x, y) in pairs {
        sum += (f64::from(x) - 0.5) * (f64::from(y) - 0.5);
        n += 1.0;
    }
    12.0 * sum / f64::sqrt(n)
}

#[test]
fn state_is_small() {
    assert!(size_of::<PixelSampler>() <= 16);
}

#[test]
fn numbers_are_below_one() {
    assert!(unit(u32::MAX) < 1.0);
    assert_eq!(unit(0), 0.0);
}

/// The first 2^k points have one point in each of the 2^k elementary intervals of every shape.
fn assert_net(points: &[Vec2], what: &str) {
    let k = points.len().trailing_zeros();
    for a in 0..=k {
        let (columns, rows) = (1u32 << a, 1u32 << (k - a));
        let mut seen = vec![false; points.len()];
        for p in points {
            let cell = (p.x * columns as f32) as u32 + columns * (p.y * rows as f32) as u32;
            assert!(!std::mem::replace(&mut seen[cell as usize], true), "{what}: {columns}x{rows}");
        }
    }
}

#[test]
fn pairs_of_a_half_are_nets() {
    for pixel in [[0, 0], [1, 0], [0, 1], [1_000_000, 70_000]] {
        for dim in DIMS {
            for half in 0..2 {
                let samplers: Vec<_> = (0..256).map(|i| of(Sampler::Sobol, pixel, 2 * i + half)).collect();
                let points: Vec<_> = samplers.iter().map(|s| s.draw2(dim)).collect();
                for k in 0..=8 {
                    assert_net(&points[..1 << k], &format!("{pixel:?} {dim:?} half {half}"));
                }
                let triples = samplers.iter().map(|s| s.draw3(dim));
                assert!(triples.zip(&points).all(|([_, u, v], p)| [u, v] == p.to_array()));
            }
        }
    }
}

#[test]
fn single_numbers_of_a_half_are_stratified() {
    for (dim, third) in DIMS.iter().flat_map(|d| [(*d, false), (*d, true)]) {
        let mut seen = [false; 128];
        for i in 0..128 {
            let s = of(Sampler::Sobol, [5, 6], 2 * i);
            let u = if third { s.draw3(dim)[0] } else { s.draw1(dim) };
            assert!(!std::mem::replace(&mut seen[(u * 128.0) as usize], true), "{dim:?}");
        }
    }
}

#[test]
fn long_sequences_do_not_repeat() {
    // Distinct points of the net of 2^24, as 24 bits of each coordinate tell.
    for base in [0, 1 << 20, (1 << 24) - 1024] {
        let points: std::collections::HashSet<_> = (base..base + 1024)
            .map(|i| of(Sampler::Sobol, [3, 4], 2 * i).draw2(Dim::Pixel).to_array().map(f32::to_bits))
            .collect();
        assert_eq!(points.len(), 1024);
    }
}

/// Each of 6 × 3 × 2 statistics is standard normal; the chance that any of them passes 4.5 is 2.5e-4.
#[test]
fn numbers_are_uniform() {
    let n = 1 << 16;
    for sampler in BOTH {
        for dim in DIMS {
            let mut sums = [[0.0; 2]; 3];
            for i in 0..n {
                for (sum, u) in sums.iter_mut().zip(of(sampler, [i % 256, i / 256], 5).draw3(dim)) {
                    let x = f64::from(u) - 0.5;
                    sum[0] += x;
                    sum[1] += x * x - 1.0 / 12.0;
                }
            }
            for [mean, square] in sums {
                let z = [mean * f64::sqrt(12.0 / n as f64), square * f64::sqrt(180.0 / n as f64)];
                assert!(z.iter().all(|z| z.abs() < 4.5), "{sampler:?} {dim:?}: {z:?}");
            }
        }
    }
}

/// χ² over 16³ cells of 2^18 independent triples: 4095 degrees of freedom, the bound is 5 standard deviations away
/// (chance 3e-7 for each of two).
#[test]
fn independent_triples_fill_the_cube_evenly() {
    for over_pixels in [false, true] {
        let mut counts = vec![0.0f64; 4096];
        for i in 0..1u32 << 18 {
            let (pixel, sample) = if over_pixels { ([i % 512, i / 512], 0) } else { ([0, 0], 2 * i) };
            let u = of(Sampler::Independent, pixel, sample).draw3(Dim::Light(0));
            counts[u.iter().fold(0, |cell, x| 16 * cell + (16.0 * x) as usize)] += 1.0;
        }
        let chi2: f64 = counts.iter().map(|c| (c - 64.0).powi(2) / 64.0).sum();
        assert!((chi2 - 4095.0).abs() < 5.0 * f64::sqrt(2.0 * 4095.0), "{chi2}");
    }
}

/// Neighbours of six kinds for two samplers, each with two statistics: the chance that any passes 4.5 is 1.7e-4.
#[test]
fn pixels_samples_halves_frames_seeds_and_decisions_are_uncorrelated() {
    let base = |sampler, x, y, sample| PixelSampler::new(sampler, 7, 3, [x, y], sample);
    type Draw = fn(Sampler, u32, u32) -> PixelSampler;
    let others: [(&str, Draw); 6] = [
        ("pixel to the right", |s, x, y| PixelSampler::new(s, 7, 3, [x + 1, y], 0)),
        ("pixel below", |s, x, y| PixelSampler::new(s, 7, 3, [x, y + 1], 0)),
        ("other half", |s, x, y| PixelSampler::new(s, 7, 3, [x, y], 1)),
        ("next frame", |s, x, y| PixelSampler::new(s, 7, 4, [x, y], 0)),
        ("next seed", |s, x, y| PixelSampler::new(s, 8, 3, [x, y], 0)),
        ("pixel turned over", |s, x, y| PixelSampler::new(s, 7, 3, [y, x + 1000], 0)),
    ];
    let pixels = || (0..256u32).flat_map(|y| (0..256u32).map(move |x| (x, y)));
    for sampler in BOTH {
        for (name, other) in others {
            let draws = |f: fn(glam::Vec2) -> f32| {
                pixels().map(move |(x, y)| {
                    let (a, b) = (base(sampler, x, y, 0), other(sampler, x, y));
                    (a.draw2(Dim::Light(2)).x, f(b.draw2(Dim::Light(2))))
                })
            };
            let z = [z_of(draws(|u| u.x)), z_of(draws(|u| u.y))];
            assert!(z.iter().all(|z| z.abs() < 4.5), "{sampler:?}, {name}: {z:?}");
        }
    }
}

/// Mean of the correlation within a pixel's 64 samples (32 a half), and its variance, over 4096 pixels; 15 pairs of
/// decisions × 2 samplers. Independent numbers have variance 1. Of Sobol numbers each aligned pair of samples lies in
/// opposite halves of both decisions, on one diagonal or the other, so that the variance may reach 2; aligned sets
/// without padding would have up to 64. The chance that any mean or any independent variance passes 5 is 3e-5.
#[test]
fn decisions_of_a_pixel_are_uncorrelated_sample_by_sample() {
    for sampler in BOTH {
        for (i, &a) in DIMS.iter().enumerate() {
            for &b in &DIMS[..i] {
                let n = 4096.0;
                let (mut sum, mut squares) = (0.0, 0.0);
                for pixel in 0..n as u32 {
                    let z = z_of((0..64).map(|s| {
                        let s = of(sampler, [pixel % 64, pixel / 64], s);
                        (s.draw2(a).x, s.draw2(b).y)
                    }));
                    sum += z;
                    squares += z * z;
                }
                let (mean, variance) = (sum / f64::sqrt(n), squares / n);
                let bound = match sampler {
                    Sampler::Independent => 1.0 + 5.0 * f64::sqrt(2.0 / n),
                    Sampler::Sobol => 2.0,
                };
                assert!(mean.abs() < 5.0 * bound.sqrt(), "{sampler:?} {a:?} {b:?}: mean {mean}");
                assert!(variance < bound, "{sampler:?} {a:?} {b:?}: variance {variance}");
            }
        }
    }
}

/// Root mean square error over 256 pixels of a smooth integrand; the error of plain averages falls as n^−0.5.
#[test]
fn error_of_a_smooth_integrand_falls_faster_than_the_root_of_the_samples() {
    let truth = (1.0 - (-1.0f64).exp()) * 1.0f64.sin();
    let rms = |n: u32| {
        let square = |pixel: u32| {
            let value = |i| {
                let u = of(Sampler::Sobol, [pixel, 0], i).draw2(Dim::Light(0)).as_dvec2();
                (-u.x).exp() * u.y.cos()
            };
            ((0..n).map(value).sum::<f64>() / f64::from(n) - truth).powi(2)
        };
        ((0..256).map(square).sum::<f64>() / 256.0).sqrt()
    };
    let (few, many) = (rms(16), rms(1024));
    let slope = (many / few).ln() / 64f64.ln();
    // −1.5 in the limit for Owen-scrambled nets of smooth integrands.
    assert!(slope < -1.2, "slope {slope}: {few} {many}");
}
