//! Random numbers as a function of (seed, frame, pixel, sample, decision), never of order.
//!
//! Sample i belongs to half `i & 1` and takes index `i >> 1` of that half's own sequence; the half enters the key, so
//! the halves are independent whatever the sampler.

use glam::Vec2;

use super::sobol::{first_pair, scramble, scramble_reversed, second_pair};
use crate::settings::Sampler;

/// A random decision of a path. What is drawn together stands together: its numbers are stratified jointly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dim {
    /// Where in the pixel filter: a pair.
    Pixel,
    /// Which lobe, and the direction: one number and a pair. Of this vertex, counted from 0.
    Bsdf(u32),
    /// Which light, and the point on it: one number and a pair. Of this vertex.
    Light(u32),
    /// Whether the path goes on: one number. Of this path length.
    Roulette(u32),
    /// Where on the lens: a pair.
    Lens,
}

impl Dim {
    /// A number of its own for each decision. They are never reused: another one changes every picture.
    #[inline]
    fn code(self) -> u64 {
        let (kind, bounce) = match self {
            Self::Pixel => (1, 0),
            Self::Bsdf(bounce) => (2, bounce),
            Self::Light(bounce) => (3, bounce),
            Self::Roulette(bounce) => (4, bounce),
            Self::Lens => (5, 0),
        };
        kind << 32 | u64::from(bounce)
    }
}

/// The random numbers of one sample of one pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PixelSampler {
    /// Hash of (seed, frame, pixel, half).
    key: u64,
    /// In the half's sequence.
    index: u32,
    sampler: Sampler,
}

/// 2^64 over the golden ratio, odd: steps by it visit all 64-bit numbers, far from each other.
const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

/// A permutation of 64-bit numbers in which each bit of the result depends on all (Stafford 2011, variant 13).
#[inline]
fn mix(mut x: u64) -> u64 {
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// The upper 24 bits as a number in [0, 1).
#[inline]
fn unit(x: u32) -> f32 {
    (x >> 8) as f32 * (1.0 / (1 << 24) as f32)
}

/// Both halves of a hash.
#[inline]
fn split(x: u64) -> [u32; 2] {
    [x as u32, (x >> 32) as u32]
}

impl PixelSampler {
    /// Sample number `sample` of `pixel`, counted in the whole film.
    #[inline]
    pub fn new(sampler: Sampler, seed: u64, frame: u32, pixel: [u32; 2], sample: u32) -> Self {
        let half = sample & 1;
        let picture = mix(mix(seed.wrapping_add(STEP)) ^ (u64::from(frame) << 1 | u64::from(half)));
        let key = mix(picture.wrapping_add(STEP) ^ (u64::from(pixel[1]) << 32 | u64::from(pixel[0])));
        Self { key, index: sample >> 1, sampler }
    }

    /// One number in [0, 1).
    #[inline]
    pub fn draw1(&self, dim: Dim) -> f32 {
        let decision = self.decision(dim);
        unit(match self.sampler {
            Sampler::Independent => split(self.uncorrelated(decision))[0],
            Sampler::Sobol => {
                let [shuffle, x] = split(decision);
                scramble_reversed(scramble(self.index, shuffle), x).reverse_bits()
            }
        })
    }

    /// A pair in [0, 1)². For Sobol the first 2^k samples of each half are a (0, k, 2)-net.
    #[inline]
    pub fn draw2(&self, dim: Dim) -> Vec2 {
        let decision = self.decision(dim);
        let [x, y] = match self.sampler {
            Sampler::Independent => split(self.uncorrelated(decision)),
            Sampler::Sobol => {
                let [shuffle, _] = split(decision);
                scrambled(first_pair(scramble(self.index, shuffle)), decision)
            }
        };
        Vec2::new(unit(x), unit(y))
    }

    /// One number and a pair: the pair, in the last two places, is that of [`draw2`](Self::draw2).
    #[inline]
    pub fn draw3(&self, dim: Dim) -> [f32; 3] {
        let decision = self.decision(dim);
        let [[a, b], [c, _]] = match self.sampler {
            Sampler::Independent => {
                let hash = self.uncorrelated(decision);
                [split(hash), split(mix(hash.wrapping_add(STEP)))]
            }
            Sampler::Sobol => {
                let [shuffle, _] = split(decision);
                let index = scramble(self.index, shuffle);
                [scrambled(first_pair(index), decision), scrambled(second_pair(index), !decision)]
            }
        };
        [unit(c), unit(a), unit(b)]
    }

    /// Hash of the decision, the same for all samples of the pixel and half.
    #[inline]
    fn decision(&self, dim: Dim) -> u64 {
        mix(self.key.wrapping_add(dim.code().wrapping_mul(STEP)))
    }

    #[inline]
    fn uncorrelated(&self, decision: u64) -> u64 {
        mix(decision.wrapping_add(u64::from(self.index).wrapping_mul(STEP)))
    }
}

/// Owen-scrambles two reversed numbers with seeds made from `hash`, and turns them round.
#[inline]
fn scrambled([x, y]: [u32; 2], hash: u64) -> [u32; 2] {
    let [seed_x, seed_y] = split(mix(hash.wrapping_add(STEP)));
    [scramble_reversed(x, seed_x).reverse_bits(), scramble_reversed(y, seed_y).reverse_bits()]
}

#[cfg(test)]
mod tests;
