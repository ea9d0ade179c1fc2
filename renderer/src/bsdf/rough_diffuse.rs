//! Rough diffuse surfaces: plaster, clay, sand.

use std::f32::consts::{FRAC_1_PI, FRAC_2_PI};

use glam::{Vec2, Vec3};

use super::{BsdfEval, BsdfFeatures, BsdfSample, albedo};
use crate::color::{Rgb, Split};
use crate::sampling::warp::{cosine_hemisphere, cosine_hemisphere_pdf};

/// Lambertian facets in V-shaped grooves, with shadowing, masking and a second bounce between them (Oren and Nayar
/// 1994), or the short form of that paper without the bounce. Light of more bounces is lost (of a white surface 10 % from
/// straight above at alpha 0.7), and the fit makes some at grazing incidence (up to 5 %, at alpha 0.5).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughDiffuse {
    albedo: Rgb,
    /// Square of the slopes' standard deviation in Oren and Nayar's sense.
    sigma2: f32,
    /// The short form.
    fast: bool,
}

impl RoughDiffuse {
    /// `alpha` is the root mean square slope of the facets, as of Beckmann's distribution; σ is alpha / √2, which
    /// Mitsuba 0.6 found to fit up to 0.5. A NaN counts as 0, which is Lambert.
    #[inline]
    pub fn new(albedo: Rgb, alpha: f32, fast: bool) -> Self {
        let alpha = alpha.clamp(0.0, LARGEST_ALPHA);
        Self { albedo, sigma2: if alpha > 0.0 { 0.5 * alpha * alpha } else { 0.0 }, fast }
    }

    /// Draws `wi` with density `cos θ / π`.
    #[inline]
    pub fn sample(&self, wo: Vec3, u: Vec2) -> Option<BsdfSample> {
        let wi = cosine_hemisphere(u);
        let value = self.eval(wo, wi);
        (value.pdf > 0.0).then(|| BsdfSample {
            wi,
            weight: value.f_cos * (1.0 / value.pdf),
            pdf: value.pdf,
            delta: false,
            eta: 1.0,
        })
    }

    /// Value and density. With α and β the larger and the smaller angle to the normal and Δ that between the azimuths:
    ///
    /// ```text
    /// π f / ρ = C1 + cos Δ C2 tan β + (1 − |cos Δ|) C3 tan((α + β) / 2) + ρ C4 (1 − cos Δ (2β/π)²)
    /// ```
    ///
    /// For wide facets the fit falls below 0 where both directions graze opposite sides; it is cut off there.
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> BsdfEval {
        if !(wo.z > 0.0 && wi.z > 0.0) {
            return BsdfEval::ZERO;
        }
        let (cos_a, cos_b) = (wo.z.min(wi.z), wo.z.max(wi.z)); // α ≥ β
        let [sin_o, sin_i] = [wo, wi].map(|w| Vec2::new(w.x, w.y).length());
        let (sin_a, sin_b) = if wo.z < wi.z { (sin_o, sin_i) } else { (sin_i, sin_o) };
        let sines = sin_o * sin_i;
        let delta = if sines > 0.0 { ((wo.x * wi.x + wo.y * wi.y) / sines).clamp(-1.0, 1.0) } else { 0.0 };
        // cos θi times the tangents: finite up to the horizon, where these are not.
        let tan_b = wi.z / cos_b * sin_b;

        let s = self.sigma2;
        let (c1, narrow) = (1.0 - 0.5 * s / (s + 0.33), s / (s + 0.09));
        if self.fast {
            let shape = c1 * wi.z + 0.45 * narrow * delta.max(0.0) * sin_a * tan_b;
            return self.reflected(wi, self.albedo * shape);
        }
        // 1 − 2α/π and the same of β, which keep their digits at the horizon.
        let [up_a, up_b] = [cos_a, cos_b].map(|cos| FRAC_2_PI * cos.min(1.0).asin());
        let down_b = 1.0 - up_b;
        // sin α, less (2β/π)³ where the directions are on opposite sides: both near 1, in terms of what is missing.
        let c2 = if delta >= 0.0 {
            sin_a
        } else {
            up_b * (3.0 - up_b * (3.0 - up_b)) - cos_a * cos_a / (1.0 + sin_a)
        };
        let c3 = 0.125 * ((1.0 - up_a) * down_b).powi(2);
        let tan_half = wi.z / (cos_a + cos_b) * (sin_a + sin_b);
        let once = c1 * wi.z + narrow * (0.45 * delta * c2 * tan_b + (1.0 - delta.abs()) * c3 * tan_half);
        let twice = 0.17 * s / (s + 0.13) * (1.0 - delta * down_b * down_b) * wi.z;
        self.reflected(wi, self.albedo * (once + self.albedo * twice).max(Rgb::ZERO))
    }

    /// π f cos θi with its density.
    #[inline]
    fn reflected(&self, wi: Vec3, pi_f_cos: Rgb) -> BsdfEval {
        BsdfEval { f_cos: Split::diffuse(pi_f_cos * FRAC_1_PI), pdf: cosine_hemisphere_pdf(wi) }
    }

    /// For the feature layers, by quadrature.
    pub fn features(&self, wo: Vec3) -> BsdfFeatures {
        let weight = |u: Vec2| self.sample(wo, u).map_or(Rgb::ZERO, |s| s.weight.diffuse);
        let albedo = albedo::lattice::<89, 55>().map(weight).sum::<Rgb>() / 89.0;
        BsdfFeatures { albedo, diffuse_albedo: albedo, roughness: 1.0 }
    }
}

/// Beyond any use, but its square stays in range.
const LARGEST_ALPHA: f32 = 1e3;

#[cfg(test)]
mod tests {
    use limpid_testkit::Random;

    use super::*;

    /// π f, as the paper writes it.
    fn oren_nayar(wo: Vec3, wi: Vec3, rho: f64, alpha: f64, fast: bool) -> f64 {
        use std::f64::consts::PI;
        let [o, i] = [wo, wi].map(|w| w.as_dvec3().normalize());
        let s = 0.5 * alpha * alpha;
        let (a, b) = (o.z.acos().max(i.z.acos()), o.z.acos().min(i.z.acos()));
        let delta = (o.y.atan2(o.x) - i.y.atan2(i.x)).cos();
        let c1 = 1.0 - 0.5 * s / (s + 0.33);
        let c2 = 0.45 * s / (s + 0.09);
        if fast {
            return rho * (c1 + c2 * delta.max(0.0) * a.sin() * b.tan());
        }
        let c2 = c2 * if delta >= 0.0 { a.sin() } else { a.sin() - (2.0 * b / PI).powi(3) };
        let c3 = 0.125 * s / (s + 0.09) * (4.0 * a * b / (PI * PI)).powi(2);
        let c4 = 0.17 * s / (s + 0.13);
        let once = c1 + delta * c2 * b.tan() + (1.0 - delta.abs()) * c3 * (0.5 * (a + b)).tan();
        rho * once + rho * rho * c4 * (1.0 - delta * (2.0 * b / PI).powi(2))
    }

    #[test]
    fn values_are_those_of_the_paper() {
        let mut random = Random::new(1);
        for case in 0..2000 {
            let mut up = || {
                Vec3::new(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() * 0.5).normalize()
            };
            let (wo, wi) = (up(), up());
            let (alpha, fast) = ([0.0, 0.05, 0.3, 0.7][case % 4], case % 8 < 4);
            let bsdf = RoughDiffuse::new(Rgb::splat(0.7), alpha, fast);
            let value = bsdf.eval(wo, wi).f_cos.diffuse.x / (wi.z * FRAC_1_PI);
            let truth = oren_nayar(wo, wi, f64::from(0.7f32), alpha.into(), fast).max(0.0);
            assert!(
                (f64::from(value) - truth).abs() < 1e-4 * truth,
                "{wo} {wi} {alpha} {fast}: {value} {truth}"
            );
        }
    }
}
