//! Uniform numbers.

use glam::Vec2;

/// SplitMix64 (Steele, Lea and Flood 2014): short, and good enough for statistical tests.
#[derive(Clone, Debug)]
pub struct Rng(u64);

impl Rng {
    /// Streams of different seeds are independent.
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0xd134_2543_de82_ef95))
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [0, 1): a multiple of 2⁻²⁴.
    pub fn uniform(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / (1 << 24) as f32
    }

    /// Uniform in [0, 1)².
    pub fn uniform2(&mut self) -> Vec2 {
        let bits = self.bits();
        let to_f32 = |bits: u64| (bits & 0xff_ffff) as f32 / (1 << 24) as f32;
        Vec2::new(to_f32(bits >> 40), to_f32(bits))
    }
}
