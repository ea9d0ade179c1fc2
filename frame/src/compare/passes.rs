//! Pictures from independent passes, and how well each pixel is known.

use super::ROUNDING;
use crate::{Frame, FrameError};

/// Running moments of passes with the same number of samples each, a pixel and channel at a time.
#[derive(Clone, Debug)]
pub struct Passes {
    size: [usize; 2],
    count: f64,
    /// Samples of all passes together.
    spp: f64,
    /// Mean, and sums of squared and cubed deviations from it, as in [`Welford`](crate::stats::Welford), which
    /// would keep a count for every pixel.
    mean: [Vec<f64>; 3],
    m2: [Vec<f64>; 3],
    m3: [Vec<f64>; 3],
}

impl Passes {
    /// None yet, of a picture of `[width, height]` pixels.
    pub fn new(size: [usize; 2]) -> Self {
        let planes = || std::array::from_fn(|_| vec![0.0; size[0] * size[1]]);
        Self { size, count: 0.0, spp: 0.0, mean: planes(), m2: planes(), m3: planes() }
    }

    /// Takes in one pass of `spp` samples.
    ///
    /// # Panics
    ///
    /// If a plane has another number of pixels.
    pub fn push(&mut self, rgb: [&[f32]; 3], spp: u32) {
        self.count += 1.0;
        self.spp += f64::from(spp);
        let n = self.count;
        for (channel, plane) in rgb.into_iter().enumerate() {
            assert_eq!(plane.len(), self.size[0] * self.size[1], "a pass of another size");
            let moments = self.mean[channel].iter_mut().zip(&mut self.m2[channel]).zip(&mut self.m3[channel]);
            for (((mean, m2), m3), &value) in moments.zip(plane) {
                let delta = f64::from(value) - *mean;
                let step = delta / n;
                let term = delta * step * (n - 1.0);
                *mean += step;
                *m3 += step * (term * (n - 2.0) - 3.0 * *m2);
                *m2 += term;
            }
        }
    }

    /// Passes taken in.
    pub fn count(&self) -> usize {
        self.count as usize
    }

    /// The picture that they make; `None` of fewer than three.
    pub fn estimate(self) -> Option<Estimate> {
        let n = self.count;
        if n < 3.0 {
            return None;
        }
        let scale =
            |planes: [Vec<f64>; 3], by: f64| planes.map(|plane| plane.iter().map(|v| v * by).collect());
        Some(Estimate {
            size: self.size,
            spp: self.spp,
            rounding: ROUNDING,
            var: scale(self.m2, 1.0 / (n * (n - 1.0))),
            third: scale(self.m3, 1.0 / (n * (n - 1.0) * (n - 2.0))),
            mean: self.mean,
        })
    }
}

/// A picture with what is known of its noise, a pixel and channel at a time.
#[derive(Clone, Debug)]
pub struct Estimate {
    pub(super) size: [usize; 2],
    pub(super) spp: f64,
    /// Of the samples.
    pub(super) mean: [Vec<f64>; 3],
    /// How far it may be off by rounding, as a fraction.
    pub(super) rounding: f64,
    /// Variance of that mean.
    pub(super) var: [Vec<f64>; 3],
    /// Third cumulant of that mean, unbiased: its third central moment. Empty where it is not known.
    pub(super) third: [Vec<f64>; 3],
}

impl Estimate {
    /// A picture of another renderer, and the variance of its pixels' means per channel.
    ///
    /// # Errors
    ///
    /// Where a channel is missing or the sizes differ.
    pub fn of_frames(mean: &Frame, variance: &Frame) -> Result<Self, FrameError> {
        let size = [mean.width(), mean.height()];
        let other = [variance.width(), variance.height()];
        if size != other {
            return Err(FrameError::SizesDiffer { picture: other.into(), reference: size.into() });
        }
        let wide = |plane: &[f32]| plane.iter().map(|&v| f64::from(v)).collect();
        // A negative variance is a mark for "unknown": the pixel is left out.
        let known =
            |plane: &[f32]| plane.iter().map(|&v| if v < 0.0 { f64::NAN } else { f64::from(v) }).collect();
        let (mean, var) = (mean.rgb()?.map(wide), variance.rgb()?.map(known));
        Ok(Self { size, spp: 1.0, rounding: ROUNDING, mean, var, third: std::array::from_fn(|_| Vec::new()) })
    }

    /// Says how far the picture may be off by rounding, as a fraction of its brightness, where that is more than
    /// [`ROUNDING`]. The sum of n like samples in 32 bits is off by up to n / 2²⁵.
    pub fn set_rounding(&mut self, rounding: f64) {
        self.rounding = rounding.max(ROUNDING);
    }

    /// Scales every variance: for pixels that share samples, so that sums over them vary by more than independent
    /// ones would.
    pub fn scale_variance(&mut self, factor: f64) {
        self.var.iter_mut().flatten().for_each(|v| *v *= factor);
    }

    /// Leaves a frame of so many pixels out, where the filters of two renderers end differently.
    pub fn leave_out_border(&mut self, pixels: usize) {
        let [width, height] = self.size;
        for p in 0..width * height {
            let (x, y) = (p % width, p / width);
            if x.min(y).min(width - 1 - x).min(height - 1 - y) < pixels {
                self.mean.iter_mut().for_each(|plane| plane[p] = f64::NAN);
            }
        }
    }

    /// Takes in another picture of the same scene with independent noise, weighted by its samples.
    ///
    /// # Panics
    ///
    /// If the sizes differ.
    pub fn merge(&mut self, other: &Estimate) {
        assert_eq!(self.size, other.size, "pictures of different sizes are not merged");
        let spp = self.spp + other.spp;
        let (ours, theirs) = (self.spp / spp, other.spp / spp);
        let merge = |a: &mut [Vec<f64>; 3], b: &[Vec<f64>; 3], power: i32| {
            let (wa, wb) = (ours.powi(power), theirs.powi(power));
            a.iter_mut().flatten().zip(b.iter().flatten()).for_each(|(a, b)| *a = wa * *a + wb * b);
        };
        self.rounding = self.rounding.max(other.rounding);
        merge(&mut self.mean, &other.mean, 1);
        merge(&mut self.var, &other.var, 2);
        merge(&mut self.third, &other.third, 3);
        self.spp = spp;
    }

    fn pixel(&self, channel: usize, p: usize) -> [f64; 3] {
        [self.mean[channel][p], self.var[channel][p], self.third[channel].get(p).copied().unwrap_or(0.0)]
    }

    fn knows_third(&self) -> bool {
        !self.third[0].is_empty()
    }

    fn is_finite(&self, p: usize) -> bool {
        (0..3).all(|channel| self.pixel(channel, p).iter().all(|v| v.is_finite()))
    }
}

/// A picture in two halves of its passes, or in one piece.
#[derive(Clone, Debug)]
pub enum Halves {
    /// Independent halves.
    Two(Box<[Estimate; 2]>),
    /// One piece.
    One(Box<Estimate>),
}

impl Halves {
    /// `[width, height]` in pixels.
    pub fn size(&self) -> [usize; 2] {
        match self {
            Self::Two(halves) => halves[0].size,
            Self::One(whole) => whole.size,
        }
    }

    /// How far the picture may be off by rounding, as a fraction.
    pub(super) fn rounding(&self) -> f64 {
        match self {
            Self::Two(halves) => halves[0].rounding.max(halves[1].rounding),
            Self::One(whole) => whole.rounding,
        }
    }

    /// Samples a pixel, as far as they are known.
    pub fn spp(&self) -> f64 {
        match self {
            Self::Two(halves) => halves[0].spp + halves[1].spp,
            Self::One(whole) => whole.spp,
        }
    }

    /// Takes in more of the same picture.
    ///
    /// # Panics
    ///
    /// If one is in halves and the other is not.
    pub fn merge(&mut self, other: &Halves) {
        match (self, other) {
            (Self::Two(a), Self::Two(b)) => a.iter_mut().zip(b.iter()).for_each(|(a, b)| a.merge(b)),
            (Self::One(a), Self::One(b)) => a.merge(b),
            _ => panic!("halves are merged with halves"),
        }
    }

    /// Mean, variance and third cumulant of the whole's mean in one channel of one pixel.
    pub fn pixel(&self, channel: usize, p: usize) -> [f64; 3] {
        match self {
            Self::One(whole) => whole.pixel(channel, p),
            Self::Two(halves) => {
                let ([m0, v0, t0], [m1, v1, t1]) = (halves[0].pixel(channel, p), halves[1].pixel(channel, p));
                let w = halves[0].spp / (halves[0].spp + halves[1].spp);
                let u = 1.0 - w;
                [w * m0 + u * m1, w * w * v0 + u * u * v1, w * w * w * t0 + u * u * u * t1]
            }
        }
    }

    pub(super) fn is_finite(&self, p: usize) -> bool {
        match self {
            Self::One(whole) => whole.is_finite(p),
            Self::Two(halves) => halves.iter().all(|half| half.is_finite(p)),
        }
    }
}

/// All of a picture, or one of its halves.
#[derive(Clone, Copy)]
pub(super) enum View<'a> {
    All(&'a Halves),
    Half(&'a Estimate),
}

impl View<'_> {
    pub fn pixel(&self, channel: usize, p: usize) -> [f64; 3] {
        match self {
            Self::All(all) => all.pixel(channel, p),
            Self::Half(half) => half.pixel(channel, p),
        }
    }

    pub fn is_finite(&self, p: usize) -> bool {
        match self {
            Self::All(all) => all.is_finite(p),
            Self::Half(half) => half.is_finite(p),
        }
    }

    /// Whether the third cumulants are known.
    pub fn knows_third(&self) -> bool {
        match self {
            Self::All(Halves::Two(_)) => true,
            Self::All(Halves::One(half)) => half.knows_third(),
            Self::Half(half) => half.knows_third(),
        }
    }
}
