//! Parallel light from infinity.

use glam::DVec3;

use super::delta::Arriving;
use crate::color::{Rgb, luminance};

/// The same light everywhere, along one direction.
pub struct Directional {
    /// Towards the light, unit.
    pub wi: DVec3,
    /// On a surface across `wi`, in W·m⁻².
    pub irradiance: Rgb,
}

impl Directional {
    #[inline]
    pub fn at(&self) -> Arriving {
        Arriving { wi: self.wi, distance: f64::INFINITY, irradiance: self.irradiance }
    }

    /// Its luminance.
    pub fn irradiance(&self) -> f64 {
        luminance(self.irradiance).into()
    }
}
