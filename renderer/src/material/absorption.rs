//! Absorption between the surfaces of a material.

use crate::color::Rgb;

/// What a homogeneous inside leaves of light, by the two numbers of glTF's `KHR_materials_volume`: after `distance` (world
/// space) white has become `color`. Beer and Lambert's law, with σ = −ln(color) / distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Absorption {
    pub color: Rgb,
    pub distance: f32,
}

impl Absorption {
    /// exp(−σ · length), in \[0, 1\]; as a power, so that a black `color` leaves all of a way of no length.
    #[inline]
    pub fn transmittance(&self, length: f32) -> Rgb {
        self.color.map(|c| c.powf(length / self.distance))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ways_multiply_and_extremes_are_finite() {
        let glass = Absorption { color: Rgb::new(0.5, 0.0, 1.0), distance: 2.0 };
        assert_eq!(glass.transmittance(2.0), Rgb::new(0.5, 0.0, 1.0));
        assert_eq!(glass.transmittance(4.0), Rgb::new(0.25, 0.0, 1.0));
        assert_eq!(glass.transmittance(0.0), Rgb::ONE);
        assert_eq!(glass.transmittance(f32::INFINITY), Rgb::new(0.0, 0.0, 1.0));
    }
}
