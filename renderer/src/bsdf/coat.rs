//! A dielectric layer over another BSDF.

use glam::Vec3;

use super::fresnel;
use super::rough_plastic::Coating;
use crate::color::Rgb;

/// What a layer does to a BSDF below it, as Mitsuba 0.6's `coating` and `roughcoating` have it (after Weidlich and Wilkie
/// 2007). With ' for directions refracted at its surface, T = 1 − F and d the optical depth straight through the layer
///
/// ```text
/// f_cos(wo, wi) = f'_cos(wo', wi') T(wo) T(wi) exp(−d / cos θo' − d / cos θi') cos θi / (η² cos θi')
/// ```
///
/// Its own reflection is a lobe of its own. Light that its surface throws back into it is lost: over a white diffuse base,
/// 60 % of what enters an index of 1.5. A rough surface refracts like a smooth one; its T is the mean over its facets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coat<'a> {
    /// Index of the layer over that outside, positive.
    pub eta: f32,
    /// Optical depth straight through.
    pub depth: Rgb,
    /// What a rough surface lets through; `None`: smooth.
    pub rough: Option<&'a Coating>,
    /// The normal map lies around the coat, not below it.
    pub in_map: bool,
    /// Chance of the coat's own reflection in the choice between it and what it covers.
    pub share: f32,
}

/// A direction on its way through the surface of a coat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// On the other side.
    pub v: Vec3,
    /// Of the surface and of the layer.
    pub transmittance: Rgb,
    /// Solid angle inside over that outside.
    pub narrowing: f32,
}

impl Crossing {
    /// Where there is no coat.
    #[inline]
    fn free(v: Vec3) -> Self {
        Self { v, transmittance: Rgb::ONE, narrowing: 1.0 }
    }
}

/// Neither lobe is left out, wrong as the estimate of its light may be.
const SMALLEST_SHARE: f32 = 1.0 / 64.0;

impl Coat<'_> {
    /// Sets the share by what is reflected and what goes down and up again at the cosine `cos`; `specular` is the factor on
    /// the reflection.
    pub fn shared(self, cos: f32, specular: Rgb) -> Self {
        let through = self.surface(cos.abs().min(1.0)).0;
        let top = (1.0 - through) * specular.element_sum();
        let below = through * (-2.0 * self.depth).exp().element_sum();
        let share = top / (top + below);
        let share = if share.is_nan() { 0.5 } else { share };
        Self { share: share.clamp(SMALLEST_SHARE, 1.0 - SMALLEST_SHARE), ..self }
    }

    /// What the surface lets through at a cosine outside, and the cosine inside; the latter is 0 for total reflection.
    #[inline]
    fn surface(&self, cos: f32) -> (f32, f32) {
        let boundary = fresnel::dielectric(cos, self.eta);
        let through = match self.rough {
            None => 1.0 - boundary.reflectance,
            Some(coating) if boundary.cos_t > 0.0 => coating.transmittance(cos),
            Some(_) => 0.0,
        };
        (through, boundary.cos_t)
    }

    /// A direction outside, on either side, as it is inside; `None` where nothing enters.
    #[inline]
    fn entered(&self, v: Vec3) -> Option<Crossing> {
        let cos = v.z.abs().min(1.0);
        let (through, cos_t) = self.surface(cos);
        (cos > 0.0 && cos_t > 0.0).then(|| Crossing {
            v: Vec3::new(v.x / self.eta, v.y / self.eta, cos_t.copysign(v.z)),
            transmittance: through * (self.depth / -cos_t).exp(),
            narrowing: cos / (self.eta * self.eta * cos_t),
        })
    }

    /// The other way: `v` is inside, the `v` of the crossing outside.
    #[inline]
    fn left(&self, v: Vec3) -> Option<Crossing> {
        let (x, y) = (v.x * self.eta, v.y * self.eta);
        let cos2 = 1.0 - (x * x + y * y);
        let v = (cos2 > 0.0).then(|| Vec3::new(x, y, cos2.sqrt().copysign(v.z)))?;
        Some(Crossing { v, ..self.entered(v)? })
    }
}

/// Through a coat that may be there, inwards.
#[inline]
pub fn enter(coat: Option<&Coat>, v: Vec3) -> Option<Crossing> {
    coat.map_or_else(|| Some(Crossing::free(v)), |coat| coat.entered(v))
}

/// Through a coat that may be there, outwards.
#[inline]
pub fn leave(coat: Option<&Coat>, v: Vec3) -> Option<Crossing> {
    coat.map_or_else(|| Some(Crossing::free(v)), |coat| coat.left(v))
}

/// Where a lobe lies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Layer {
    /// In the open.
    #[default]
    Bare,
    /// The reflection of a coat, given by its place in the list.
    Top(u8),
    /// Below a coat.
    Under(u8),
}

#[cfg(test)]
mod tests;
