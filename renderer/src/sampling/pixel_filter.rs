//! Importance sampling of the pixel filter.
//!
//! A sample belongs to one pixel: its place is drawn from |f|, and its weight is the sign of f times a constant, so that
//! the mean of weight · radiance is the filtered pixel. Filters are separable.

use glam::Vec2;
use limpid_scenes::{Film, PixelFilter};

/// Draws places in a pixel filter.
#[derive(Clone, Debug)]
pub struct PixelFilterSampler {
    profile: Profile,
}

/// One axis.
#[derive(Clone, Debug)]
enum Profile {
    Box,
    Tent { radius: f32 },
    Table(Table),
}

/// |f| as steps of equal width.
#[derive(Clone, Debug)]
struct Table {
    radius: f64,
    /// Sums of |∫ f| over the bins up to and including each, over the sum of all.
    sums: Box<[f64]>,
    /// Sign of ∫ f over each bin, times ∫|f| / ∫f.
    weights: Box<[f32]>,
}

/// Bins of a table: a power of two, so that their borders are exact.
const BINS: usize = 2048;
/// The most steps of a stepped filter.
const MOST_STEPS: u32 = 1 << 12;

impl PixelFilterSampler {
    /// The filter of a film.
    pub fn of(film: &Film) -> Self {
        match film.filter_steps.filter(|&steps| (1..=MOST_STEPS).contains(&steps)) {
            Some(steps) => Self::stepped(film.filter, steps),
            None => Self::new(film.filter),
        }
    }

    /// A filter with a parameter that makes no filter (a radius that is not positive, say) becomes a box.
    pub fn new(filter: PixelFilter) -> Self {
        let profile = match filter {
            PixelFilter::Tent { radius } if radius > 0.0 && radius.is_finite() => Profile::Tent { radius },
            PixelFilter::Box | PixelFilter::Tent { .. } => Profile::Box,
            _ => {
                let (radius, f) = formula(filter);
                let width = 2.0 * radius / BINS as f64;
                // Gauss's rule with two points: exact for the cubic pieces of Mitchell's filter.
                let (near, far) = (0.5 - 0.5 / 3f64.sqrt(), 0.5 + 0.5 / 3f64.sqrt());
                let integral = |i: usize| {
                    let at = |x: f64| f(-radius + (i as f64 + x) * width);
                    0.5 * (at(near) + at(far))
                };
                table(radius, (0..BINS).map(integral).collect())
            }
        };
        Self { profile }
    }

    /// See [`Film::filter_steps`].
    fn stepped(filter: PixelFilter, steps: u32) -> Self {
        if filter == PixelFilter::Box {
            return Self::new(filter);
        }
        let (radius, f) = formula(filter);
        let inner_ends = (0..steps).map(|i| radius * f64::from(i) / f64::from(steps));
        let half: Vec<f64> = inner_ends.map(f).collect();
        Self { profile: table(radius, half.iter().rev().chain(&half).copied().collect()) }
    }

    /// An offset from the pixel's centre in pixels, and the sample's weight, whose mean is 1; for filters without
    /// negative lobes it is 1. `u` is uniform in [0, 1)².
    #[inline]
    pub fn sample(&self, u: Vec2) -> (Vec2, f32) {
        match &self.profile {
            Profile::Box => (u - 0.5, 1.0),
            Profile::Tent { radius } => (*radius * Vec2::new(tent(u.x), tent(u.y)), 1.0),
            Profile::Table(table) => {
                let (x, weight_x) = table.sample(u.x);
                let (y, weight_y) = table.sample(u.y);
                (Vec2::new(x, y), weight_x * weight_y)
            }
        }
    }
}

/// What a pixel filter does to the pixels of a renderer that adds each sample to all pixels in its reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Splat {
    /// The filter's reach along each axis, in pixels.
    pub radius: f64,
    /// How much more the mean of many pixels varies than the mean of independent ones would. With ∫f = 1 along each
    /// axis:
    ///
    /// ```text
    /// 1 / (∫ f(x)² dx)²
    /// ```
    ///
    /// A pixel's variance has the factor ∫f² for each axis; the mean of many has none, since their filters add up to 1
    /// wherever a sample lies. 1 for a box, 3.1 for Mitsuba's Gaussian.
    pub correlation: f64,
}

impl Splat {
    /// Of a filter.
    pub fn of(filter: PixelFilter) -> Self {
        let (radius, squared) = match &PixelFilterSampler::new(filter).profile {
            Profile::Box => (0.5, 1.0),
            Profile::Tent { radius } => (f64::from(*radius), 2.0 / (3.0 * f64::from(*radius))),
            Profile::Table(table) => {
                let width = 2.0 * table.radius / table.sums.len() as f64;
                let mut below = 0.0;
                let shares = table.sums.iter().zip(&table.weights).map(|(sum, weight)| {
                    let share = (sum - below) * f64::from(*weight);
                    below = *sum;
                    share * share
                });
                (table.radius, shares.sum::<f64>() / width)
            }
        };
        Self { radius, correlation: (1.0 / squared).powi(2).max(1.0) }
    }
}

/// Inversion of 1 − |x| on [−1, 1].
#[inline]
fn tent(u: f32) -> f32 {
    if u < 0.5 { (2.0 * u).sqrt() - 1.0 } else { 1.0 - (2.0 - 2.0 * u).sqrt() }
}

/// Where a filter ends, in pixels, and its values, not normalised.
fn formula(filter: PixelFilter) -> (f64, Box<dyn Fn(f64) -> f64>) {
    match filter {
        PixelFilter::Box => (0.5, Box::new(|_| 1.0)),
        PixelFilter::Tent { radius } => {
            let radius = f64::from(radius);
            (radius, Box::new(move |x| (1.0 - x.abs() / radius).max(0.0)))
        }
        PixelFilter::Gaussian { stddev } => {
            let alpha = -0.5 / f64::from(stddev).powi(2);
            let radius = 4.0 * f64::from(stddev);
            (radius, Box::new(move |x| (alpha * x * x).exp() - (alpha * radius * radius).exp()))
        }
        PixelFilter::Mitchell { b, c } => (2.0, Box::new(move |x| mitchell(x, b.into(), c.into()))),
        PixelFilter::CatmullRom => (2.0, Box::new(|x| mitchell(x, 0.0, 0.5))),
        PixelFilter::Lanczos { lobes } => {
            let lobes = f64::from(lobes);
            (lobes, Box::new(move |x| sinc(x) * sinc(x / lobes)))
        }
    }
}

/// A filter by its integrals over bins of equal width on [−radius, radius].
fn table(radius: f64, integrals: Vec<f64>) -> Profile {
    let (signed, absolute) = integrals.iter().fold((0.0, 0.0), |(s, a), x| (s + x, a + x.abs()));
    let ratio = absolute / signed;
    // Not so for a radius of 0, NaN, infinity, and the like.
    let is_filter = radius > 0.0 && radius.is_finite() && ratio >= 1.0 - 1e-9 && ratio.is_finite();
    if !is_filter {
        return Profile::Box;
    }
    let mut sum = 0.0;
    let sums = integrals
        .iter()
        .map(|x| {
            sum += x.abs();
            sum / absolute
        })
        .collect();
    // Exactly 1 without negative lobes.
    let ratio = ratio as f32;
    let weights = integrals.iter().map(|x| if *x < 0.0 { -ratio } else { ratio }).collect();
    Profile::Table(Table { radius, sums, weights })
}

impl Table {
    #[inline]
    fn sample(&self, u: f32) -> (f32, f32) {
        let u = f64::from(u);
        // The last sum is 1 and more than u, but for rounding.
        let bins = self.sums.len();
        let bin = self.sums.partition_point(|&sum| sum <= u).min(bins - 1);
        let before = if bin == 0 { 0.0 } else { self.sums[bin - 1] };
        let within = ((u - before) / (self.sums[bin] - before)).clamp(0.0, 1.0);
        let x = (2.0 * (bin as f64 + within) / bins as f64 - 1.0) * self.radius;
        (x as f32, self.weights[bin])
    }
}

/// Mitchell and Netravali 1988, equation 8.
fn mitchell(x: f64, b: f64, c: f64) -> f64 {
    let x = x.abs();
    let cubic = if x < 1.0 {
        (12.0 - 9.0 * b - 6.0 * c) * x.powi(3) + (-18.0 + 12.0 * b + 6.0 * c) * x.powi(2) + (6.0 - 2.0 * b)
    } else if x < 2.0 {
        (-b - 6.0 * c) * x.powi(3)
            + (6.0 * b + 30.0 * c) * x.powi(2)
            + (-12.0 * b - 48.0 * c) * x
            + (8.0 * b + 24.0 * c)
    } else {
        0.0
    };
    cubic / 6.0
}

fn sinc(x: f64) -> f64 {
    let x = std::f64::consts::PI * x;
    if x == 0.0 { 1.0 } else { x.sin() / x }
}

#[cfg(test)]
mod tests;
