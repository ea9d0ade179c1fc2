//! Parameters of Burley's principled models (2012, 2015), as Mitsuba 3 names them.

use crate::{Color, Scalar};

/// Diffuse base with sheen, microfacets between dielectric, metal and glass, and a clear coat. All numbers are in
/// \[0, 1\] where nothing else is said.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Principled {
    /// Colour of the diffuse base and of metal; its root is that of what goes through.
    pub base_color: Color,
    /// Its square is the microfacet width.
    pub roughness: Scalar,
    /// Stretches the highlight along u.
    pub anisotropic: Scalar,
    /// From dielectric to metal.
    pub metallic: Scalar,
    /// From a diffuse base to glass, of what is not metal; constant 0 is black from behind.
    pub spec_trans: Scalar,
    /// Index on the side away from the normal over that on the side of the normal, positive.
    pub eta: f32,
    /// Tints the reflection of what is not metal.
    pub spec_tint: Scalar,
    /// Light at grazing angles, as of cloth.
    pub sheen: Scalar,
    /// Tints the sheen.
    pub sheen_tint: Scalar,
    /// From a diffuse base to one that looks as if light went some way inside.
    pub flatness: Scalar,
    /// A second highlight over everything.
    pub clearcoat: Scalar,
    /// Sharpness of the second highlight.
    pub clearcoat_gloss: Scalar,
}

impl Default for Principled {
    /// Mitsuba's.
    fn default() -> Self {
        let [zero, half] = [0.0, 0.5].map(Scalar::Constant);
        Self {
            base_color: Color::Constant([0.5; 3]),
            roughness: half,
            anisotropic: zero,
            metallic: zero,
            spec_trans: zero,
            eta: Self::eta_of_specular(0.5),
            spec_tint: zero,
            sheen: zero,
            sheen_tint: zero,
            flatness: zero,
            clearcoat: zero,
            clearcoat_gloss: zero,
        }
    }
}

impl Principled {
    /// All of its numbers that may be textured.
    pub fn scalars_mut(&mut self) -> [&mut Scalar; 10] {
        [
            &mut self.roughness,
            &mut self.anisotropic,
            &mut self.metallic,
            &mut self.spec_trans,
            &mut self.spec_tint,
            &mut self.sheen,
            &mut self.sheen_tint,
            &mut self.flatness,
            &mut self.clearcoat,
            &mut self.clearcoat_gloss,
        ]
    }

    /// The index of refraction of Burley's `specular` in \[0, 1\], which is the reflectance at normal incidence over 0.08.
    pub fn eta_of_specular(specular: f32) -> f32 {
        2.0 / (1.0 - (0.08 * specular).sqrt()) - 1.0
    }

    /// Whether some light goes through, somewhere.
    pub fn transmits(&self) -> bool {
        self.spec_trans != Scalar::Constant(0.0)
    }
}

/// A sheet without inside, which scatters on both sides. Numbers are in \[0, 1\] where nothing else is said.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrincipledThin {
    /// Colour of the diffuse lobes and of what goes through.
    pub base_color: Color,
    /// Its square is the microfacet width.
    pub roughness: Scalar,
    /// Stretches the highlight along u.
    pub anisotropic: Scalar,
    /// From diffuse to specular.
    pub spec_trans: Scalar,
    /// Index inside over that outside, positive.
    pub eta: Scalar,
    /// Tints the reflection.
    pub spec_tint: Scalar,
    /// Light at grazing angles, as of cloth.
    pub sheen: Scalar,
    /// Tints the sheen.
    pub sheen_tint: Scalar,
    /// From a diffuse base to one that looks as if light went some way inside.
    pub flatness: Scalar,
    /// Of the diffuse light, from 0, all reflected, to 2, all transmitted.
    pub diff_trans: Scalar,
}

impl Default for PrincipledThin {
    /// Mitsuba's.
    fn default() -> Self {
        let [zero, half, eta] = [0.0, 0.5, 1.5].map(Scalar::Constant);
        Self {
            base_color: Color::Constant([0.5; 3]),
            roughness: half,
            anisotropic: zero,
            spec_trans: zero,
            eta,
            spec_tint: zero,
            sheen: zero,
            sheen_tint: zero,
            flatness: zero,
            diff_trans: zero,
        }
    }
}

impl PrincipledThin {
    /// All of its numbers that may be textured.
    pub fn scalars_mut(&mut self) -> [&mut Scalar; 9] {
        [
            &mut self.roughness,
            &mut self.anisotropic,
            &mut self.spec_trans,
            &mut self.eta,
            &mut self.spec_tint,
            &mut self.sheen,
            &mut self.sheen_tint,
            &mut self.flatness,
            &mut self.diff_trans,
        ]
    }
}
