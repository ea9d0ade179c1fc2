//! The layer that Mitsuba 0.x's `coating` and `roughcoating` put over another material.

use crate::{Color, Distribution};

/// A dielectric layer. It is there on both sides of the surface, whatever the material below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coat {
    /// Distribution and width of the facets of its surface; `None`: smooth.
    pub facets: Option<(Distribution, f32)>,
    /// Index of the layer, positive.
    pub int_ior: f32,
    /// Index outside, positive.
    pub ext_ior: f32,
    /// In the inverse unit of `sigma_a`, at least 0.
    pub thickness: f32,
    /// What it absorbs in each unit of length, at least 0.
    pub sigma_a: Color,
    /// Factor on the reflection of its surface.
    pub specular_reflectance: Color,
}

impl Default for Coat {
    /// Smooth, and Mitsuba's.
    fn default() -> Self {
        let [zero, one] = [0.0, 1.0].map(|x| Color::Constant([x; 3]));
        Self {
            facets: None,
            int_ior: 1.5046,
            ext_ior: 1.000277,
            thickness: 1.0,
            sigma_a: zero,
            specular_reflectance: one,
        }
    }
}
