//! A point that shines into all directions alike.

use std::f64::consts::PI;

use glam::DVec3;

use super::delta::{Arriving, scaled};
use crate::color::{Rgb, luminance};

/// A point light: the irradiance falls with the square of the distance.
pub struct Point {
    /// In render space.
    pub position: DVec3,
    /// W·sr⁻¹.
    pub intensity: Rgb,
}

impl Point {
    #[inline]
    pub fn at(&self, p: DVec3) -> Option<Arriving> {
        let to = self.position - p;
        let distance2 = to.length_squared();
        Some(Arriving {
            wi: to.try_normalize()?,
            distance: distance2.sqrt(),
            irradiance: scaled(self.intensity, 1.0 / distance2),
        })
    }

    /// 4π · intensity.
    pub fn power(&self) -> f64 {
        4.0 * PI * f64::from(luminance(self.intensity))
    }
}
