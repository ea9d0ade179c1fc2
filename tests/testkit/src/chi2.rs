//! χ² tests: do draws follow the density that is claimed for them?
//!
//! The cells are made for the density at hand. Directions are counted in the frame of their own mean, in rows and
//! columns that hold equal shares of a pilot run, so that a lobe a hundredth of a radian wide and a whole sphere are
//! both resolved.
//! What the draws refuse is a cell too, and expects 1 − ∫ pdf: a density of wrong scale is found as well as one of
//! wrong shape. Cells that expect few draws are pooled.
//!
//! Each call is one test with a false-alarm rate of 1e-4. A density that is off by ±3 % on halves of its domain is
//! found with near certainty, as a test here shows; ∓1 % is not.

use std::f64::consts::TAU;
use std::iter;

use glam::{DVec3, Vec2, Vec3};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::Random;

/// Chance that a right density fails one test.
const FALSE_ALARM: f64 = 1e-4;

const DRAWS: usize = 400_000;
const ROWS: usize = 12;
const COLUMNS: usize = 24;

/// Cells that expect fewer draws are pooled: the usual bound for the χ² approximation.
const SMALLEST_CELL: f64 = 10.0;

/// The outcome of a test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chi2 {
    /// Σ (observed − expected)² / expected.
    pub statistic: f64,
    /// Degrees of freedom.
    pub degrees: usize,
    /// Chance of a statistic at least as large if the density is right.
    pub p: f64,
    /// ∫ pdf over the whole domain.
    pub mass: f64,
}

/// Fails unless the directions drawn by `draw(u_lobe, u)` follow `pdf`, a density per steradian; `None` is for draws
/// that scatter nothing. False-alarm rate 1e-4.
#[track_caller]
pub fn assert_chi2(draw: impl Fn(f32, Vec2) -> Option<Vec3>, pdf: impl Fn(Vec3) -> f32) {
    let test = chi2(draw, pdf);
    assert!(test.p > FALSE_ALARM, "draws do not follow their density: {test:?}");
}

/// Fails unless the points drawn by `draw(u)` follow `pdf` in the rectangle from `min` to `max`, outside of which a
/// point counts as refused. False-alarm rate 1e-4.
#[track_caller]
pub fn assert_chi2_2d(draw: impl Fn(Vec2) -> Option<Vec2>, pdf: impl Fn(Vec2) -> f64, min: Vec2, max: Vec2) {
    let test = chi2_2d(draw, pdf, min, max);
    assert!(test.p > FALSE_ALARM, "draws do not follow their density: {test:?}");
}

/// Fails unless the numbers drawn by `draw(u)` follow `pdf` from `min` to `max`. False-alarm rate 1e-4.
#[track_caller]
pub fn assert_chi2_1d(draw: impl Fn(f32) -> f32, pdf: impl Fn(f32) -> f64, min: f32, max: f32) {
    let test =
        chi2_2d(|u| Some(Vec2::new(draw(u.x), u.y)), |p| pdf(p.x), Vec2::new(min, 0.0), Vec2::new(max, 1.0));
    assert!(test.p > FALSE_ALARM, "draws do not follow their density: {test:?}");
}

/// The test of [`assert_chi2`].
pub fn chi2(draw: impl Fn(f32, Vec2) -> Option<Vec3>, pdf: impl Fn(Vec3) -> f32) -> Chi2 {
    let mut random = Random::new(1);
    let pilot: Vec<DVec3> =
        (0..16_384).filter_map(|_| draw(random.uniform(), random.uniform2())).map(Vec3::as_dvec3).collect();
    let axis = pilot.iter().sum::<DVec3>().try_normalize().unwrap_or(DVec3::Z);
    let (x, y) = axis.any_orthonormal_pair();

    // Polar coordinates: the sine of half the angle to the axis, whose square is uniform for uniform directions and
    // which keeps its digits near the axis; and the azimuth.
    let half_sine = |w: DVec3| (0.5 * (w - axis).length()).min(1.0);
    let azimuth = |w: DVec3| w.dot(y).atan2(w.dot(x)).rem_euclid(TAU);
    let edges = |coordinate: &dyn Fn(DVec3) -> f64, shares: &[f64], end: f64| {
        let mut sorted: Vec<f64> = pilot.iter().map(|&w| coordinate(w)).collect();
        sorted.sort_by(f64::total_cmp);
        let place = |share: f64| (share * (sorted.len() as f64 - 1.0)) as usize;
        let inner = shares.iter().filter_map(|&share| sorted.get(place(share)));
        let mut edges: Vec<f64> = iter::once(0.0).chain(inner.copied()).chain([end]).collect();
        edges.dedup();
        edges
    };
    let equal = |n: usize| (1..n).map(move |i| i as f64 / n as f64);
    // Rows of equal shares, and finer ones for the tail, which can be much longer than the rest.
    let rows: Vec<f64> = equal(ROWS).chain([0.97, 0.99, 0.999, 1.0]).collect();
    let mut rows = edges(&half_sine, &rows, 1.0);
    // And a thin one behind the farthest: where that is at the horizon, what is left above is a sliver.
    if let [.., farthest, end] = rows[..] {
        rows.insert(rows.len() - 1, farthest + 0.01 * (end - farthest));
    }
    // A lobe at grazing incidence is a narrow cross seen from its mean: equal angles would miss its arms.
    let columns = edges(&azimuth, &equal(COLUMNS).collect::<Vec<f64>>(), TAU);

    let density = |t: f64, phi: f64| {
        let (cos, sin) = (1.0 - 2.0 * t * t, 2.0 * t * ((1.0 - t) * (1.0 + t)).max(0.0).sqrt());
        let w = cos * axis + sin * (phi.cos() * x + phi.sin() * y);
        f64::from(pdf(w.as_vec3())) * 4.0 * t // dω = 4 t dt dφ
    };
    let place = |random: &mut Random| {
        // What is drawn where nothing may be drawn counts with what is refused, or a large cell could hide it.
        let w = draw(random.uniform(), random.uniform2()).filter(|&w| pdf(w) > 0.0)?.as_dvec3();
        Some((half_sine(w), azimuth(w)))
    };
    test_cells(&rows, &columns, density, place)
}

/// The test of [`assert_chi2_2d`].
pub fn chi2_2d(draw: impl Fn(Vec2) -> Option<Vec2>, pdf: impl Fn(Vec2) -> f64, min: Vec2, max: Vec2) -> Chi2 {
    let edges = |n: usize, a: f32, b: f32| -> Vec<f64> {
        (0..=n).map(|i| f64::from(a) + f64::from(b - a) * i as f64 / n as f64).collect()
    };
    let density = |x: f64, y: f64| pdf(Vec2::new(x as f32, y as f32));
    let place = |random: &mut Random| {
        let p = draw(random.uniform2()).filter(|&p| pdf(p) > 0.0)?;
        (p.cmpge(min).all() && p.cmple(max).all()).then_some((f64::from(p.x), f64::from(p.y)))
    };
    test_cells(&edges(ROWS, min.x, max.x), &edges(COLUMNS, min.y, max.y), density, place)
}

fn test_cells(
    rows: &[f64],
    columns: &[f64],
    density: impl Fn(f64, f64) -> f64,
    place: impl Fn(&mut Random) -> Option<(f64, f64)>,
) -> Chi2 {
    let mut cells = Vec::new();
    for row in rows.windows(2) {
        for column in columns.windows(2) {
            cells.push((0.0, integrate(&density, [row[0], column[0]], [row[1], column[1]], 0)));
        }
    }
    let mass: f64 = cells.iter().map(|c| c.1).sum();
    // The last cell is for what is refused.
    cells.push((0.0, (1.0 - mass).max(0.0)));
    let mut random = Random::new(2);
    for _ in 0..DRAWS {
        let cell = match place(&mut random) {
            Some((a, b)) => index(rows, a) * (columns.len() - 1) + index(columns, b),
            None => cells.len() - 1,
        };
        cells[cell].0 += 1.0;
    }
    let cells: Vec<(f64, f64)> = cells.into_iter().map(|(n, share)| (n, share * DRAWS as f64)).collect();
    let (statistic, degrees) = statistic(cells);
    let p = match ChiSquared::new(degrees.max(1) as f64) {
        Ok(distribution) if statistic.is_finite() => distribution.sf(statistic),
        _ => 0.0,
    };
    Chi2 { statistic, degrees, p, mass }
}

/// The cell between sorted `edges` that holds `x`.
fn index(edges: &[f64], x: f64) -> usize {
    edges.partition_point(|&e| e <= x).clamp(1, edges.len() - 1) - 1
}

/// Of (observed, expected), with small cells pooled.
fn statistic(cells: Vec<(f64, f64)>) -> (f64, usize) {
    let (mut large, small): (Vec<_>, Vec<_>) = cells.into_iter().partition(|c| c.1 >= SMALLEST_CELL);
    let pool = small.iter().fold((0.0, 0.0), |sum, c| (sum.0 + c.0, sum.1 + c.1));
    match large.last_mut() {
        // Too few to stand alone, but a draw where none can be is still one too many.
        Some(last) if pool.1 < SMALLEST_CELL => *last = (last.0 + pool.0, last.1 + pool.1),
        _ => large.push(pool),
    }
    let statistic = large.iter().map(|(observed, expected)| (observed - expected).powi(2) / expected).sum();
    (statistic, large.len() - 1)
}

/// ∫ f over a rectangle: Gauss's rule of 2 × 2 points, halved both ways where that changes the result.
fn integrate(f: &impl Fn(f64, f64) -> f64, min: [f64; 2], max: [f64; 2], depth: u32) -> f64 {
    // The horizon can cut off all but a corner of a cell, which 4 × 4 parts still missed. 2⁻⁸ of a cell resolves an edge.
    const LEAST: u32 = 4;
    const MOST: u32 = 8;
    let mid = [0.5 * (min[0] + max[0]), 0.5 * (min[1] + max[1])];
    let quarters =
        [(min, mid), ([mid[0], min[1]], [max[0], mid[1]]), ([min[0], mid[1]], [mid[0], max[1]]), (mid, max)];
    if depth >= LEAST {
        let whole = gauss(f, min, max);
        let parts: f64 = quarters.iter().map(|&(a, b)| gauss(f, a, b)).sum();
        if depth == MOST || (whole - parts).abs() <= 1e-3 * parts.abs() + 1e-9 {
            return parts;
        }
    }
    quarters.iter().map(|&(a, b)| integrate(f, a, b, depth + 1)).sum()
}

fn gauss(f: &impl Fn(f64, f64) -> f64, min: [f64; 2], max: [f64; 2]) -> f64 {
    const NODES: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];
    let size = [max[0] - min[0], max[1] - min[1]];
    let row = |x: f64| NODES.iter().map(|y| f(min[0] + x * size[0], min[1] + y * size[1])).sum::<f64>();
    0.25 * size[0] * size[1] * NODES.iter().map(|&x| row(x)).sum::<f64>()
}

#[cfg(test)]
mod tests;
