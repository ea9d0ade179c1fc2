//! Colours and the split of what a surface scatters.

use std::ops::{Add, AddAssign, Mul};

use glam::Vec3;

/// Linear Rec. 709.
pub type Rgb = Vec3;

/// Luminance of a linear Rec. 709 colour.
pub fn luminance(c: Rgb) -> f32 {
    0.212_639 * c.x + 0.715_169 * c.y + 0.072_192 * c.z
}

/// A scattered quantity by the lobe it went through: f = f_d + f_s, part by part.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Split {
    /// Through diffuse lobes.
    pub diffuse: Rgb,
    /// Through all others.
    pub specular: Rgb,
}

impl Split {
    /// Nothing scattered.
    pub const ZERO: Self = Self { diffuse: Rgb::ZERO, specular: Rgb::ZERO };

    /// All through the diffuse lobe.
    pub fn diffuse(diffuse: Rgb) -> Self {
        Self { diffuse, specular: Rgb::ZERO }
    }

    /// All through other lobes.
    pub fn specular(specular: Rgb) -> Self {
        Self { diffuse: Rgb::ZERO, specular }
    }

    /// Both parts together.
    pub fn total(self) -> Rgb {
        self.diffuse + self.specular
    }

    /// Whether both parts are zero in every channel.
    pub fn is_zero(self) -> bool {
        self == Self::ZERO
    }
}

impl Add for Split {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { diffuse: self.diffuse + other.diffuse, specular: self.specular + other.specular }
    }
}

impl AddAssign for Split {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Mul<f32> for Split {
    type Output = Self;
    fn mul(self, factor: f32) -> Self {
        Self { diffuse: self.diffuse * factor, specular: self.specular * factor }
    }
}

impl Mul<Rgb> for Split {
    type Output = Self;
    fn mul(self, factor: Rgb) -> Self {
        Self { diffuse: self.diffuse * factor, specular: self.specular * factor }
    }
}
