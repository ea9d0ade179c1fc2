//! A point that shines as a photometric file says.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::DVec3;
use limpid_scenes::IesProfile;

use super::delta::{Arriving, Place, scaled};
use crate::color::{Rgb, luminance};

/// A lamp with the intensity of its profile: vertical angles are from the +z of light space, horizontal ones from +x towards +y.
pub struct Ies {
    pub place: Place,
    /// Factor on the profile's candelas, which count as W·sr⁻¹.
    pub intensity: Rgb,
    pub profile: Arc<IesProfile>,
}

impl Ies {
    pub fn at(&self, p: DVec3) -> Option<Arriving> {
        let local = self.place.local(p);
        let vertical = local.x.hypot(local.y).atan2(local.z).to_degrees();
        let around = local.y.atan2(local.x).to_degrees();
        let candelas = self.profile.at(vertical, around);
        if candelas <= 0.0 {
            return None;
        }
        let to = self.place.position - p;
        let distance2 = to.length_squared();
        Some(Arriving {
            wi: to.try_normalize()?,
            distance: distance2.sqrt(),
            irradiance: scaled(self.intensity, candelas / distance2),
        })
    }

    /// 4π · intensity · mean of the candelas over all directions.
    pub fn power(&self) -> f64 {
        4.0 * PI * f64::from(luminance(self.intensity)) * self.profile.mean()
    }
}
