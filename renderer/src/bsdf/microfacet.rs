//! Microfacet distributions (Walter et al. 2007) with sampling of visible normals.
//!
//! D is normalised so that ∫ D(m) cos θ_m dm = 1; the shadowing is Smith's, separable: G = G1(wi) G1(wo). Widths
//! `alpha` are used as they are, not squared.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};
use libm::erf;
use limpid_scenes::Distribution;

/// A distribution with its widths along x and y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Microfacet {
    /// Its family.
    pub distribution: Distribution,
    /// Width along x, positive.
    pub alpha_x: f32,
    /// Width along y, positive.
    pub alpha_y: f32,
}

/// Below this width the lobe is narrower than `f32` directions resolve.
pub const SMALLEST_ALPHA: f32 = 1e-4;

impl Microfacet {
    /// Widths are kept from falling under [`SMALLEST_ALPHA`]; a NaN becomes that.
    pub fn new(distribution: Distribution, alpha_x: f32, alpha_y: f32) -> Self {
        Self { distribution, alpha_x: alpha_x.max(SMALLEST_ALPHA), alpha_y: alpha_y.max(SMALLEST_ALPHA) }
    }

    /// Density of normals at `m`, per steradian and per projected area; zero below the surface.
    pub fn d(&self, m: Vec3) -> f32 {
        if m.z <= 0.0 {
            return 0.0;
        }
        let (x, y) = (m.x / self.alpha_x, m.y / self.alpha_y);
        let cos2 = m.z * m.z;
        let area = PI * self.alpha_x * self.alpha_y;
        let value = match self.distribution {
            Distribution::Beckmann => (-(x * x + y * y) / cos2).exp() / (area * cos2 * cos2),
            Distribution::Ggx => {
                let denominator = x * x + y * y + cos2;
                1.0 / (area * denominator * denominator)
            }
        };
        if value.is_finite() { value } else { 0.0 }
    }

    /// Share of the facets of normal `m` that `v` sees.
    pub fn g1(&self, v: Vec3, m: Vec3) -> f32 {
        if v.dot(m) * v.z <= 0.0 {
            return 0.0;
        }
        let slope2 = (v.x * self.alpha_x).powi(2) + (v.y * self.alpha_y).powi(2);
        if slope2 == 0.0 {
            return 1.0;
        }
        // tan² θ · α², squared cosines by components: no 1 − cos² of a rounded cosine.
        let tan2_alpha2 = slope2 / (v.z * v.z);
        match self.distribution {
            Distribution::Ggx => 2.0 / (1.0 + (1.0 + tan2_alpha2).sqrt()),
            Distribution::Beckmann => {
                // The rational fit of Walter et al., off by less than 0.35 %.
                let a = 1.0 / tan2_alpha2.sqrt();
                if a >= 1.6 { 1.0 } else { (3.535 * a + 2.181 * a * a) / (1.0 + 2.276 * a + 2.577 * a * a) }
            }
        }
    }

    /// A normal that `wo` sees, with density [`Self::visible_pdf`]; `wo` lies above the surface.
    pub fn sample_visible(&self, wo: Vec3, u: Vec2) -> Vec3 {
        let stretched = Vec3::new(self.alpha_x * wo.x, self.alpha_y * wo.y, wo.z).normalize();
        let m = match self.distribution {
            Distribution::Ggx => {
                let h = ggx_visible(stretched, u);
                Vec3::new(self.alpha_x * h.x, self.alpha_y * h.y, h.z.max(0.0))
            }
            Distribution::Beckmann => {
                let slope = beckmann_visible_slope(stretched, u);
                Vec3::new(-self.alpha_x * slope.x, -self.alpha_y * slope.y, 1.0)
            }
        };
        m.try_normalize().unwrap_or(Vec3::Z)
    }

    /// Density of [`Self::sample_visible`] per steradian of normals: D G1 |wo · m| / cos θ_o.
    pub fn visible_pdf(&self, wo: Vec3, m: Vec3) -> f32 {
        if wo.z <= 0.0 {
            return 0.0;
        }
        self.d(m) * self.g1(wo, m) * wo.dot(m).max(0.0) / wo.z
    }
}

/// A normal of the unit-width GGX hemisphere seen from `v`: a point of a spherical cap (Dupuy and Benyoub 2023).
fn ggx_visible(v: Vec3, u: Vec2) -> Vec3 {
    let z = (1.0 - u.y) * (1.0 + v.z) - v.z;
    let sin = (1.0 - z * z).max(0.0).sqrt();
    let (s, c) = (2.0 * PI * u.x).sin_cos();
    Vec3::new(sin * c, sin * s, z) + v
}

/// A slope of the unit-width Beckmann surface seen from `v` (Heitz and d'Eon 2014): the slope along the view by inverting
/// its cumulative distribution, the one across by a Gaussian.
fn beckmann_visible_slope(v: Vec3, u: Vec2) -> Vec2 {
    let sin = v.x.hypot(v.y);
    if sin == 0.0 || sin < 1e-6 * v.z {
        // Seen from above: all slopes are visible.
        let r = (-(1.0 - u.x).ln()).max(0.0).sqrt();
        let (s, c) = (2.0 * PI * u.y).sin_cos();
        return Vec2::new(r * c, r * s);
    }
    let along = visible_slope_along(f64::from(v.z) / f64::from(sin), f64::from(u.x)) as f32;
    let across = erf_inv(2.0 * f64::from(u.y).clamp(1e-9, 1.0 - 1e-9) - 1.0) as f32;
    let (c, s) = (v.x / sin, v.y / sin);
    Vec2::new(c * along - s * across, s * along + c * across)
}

/// Solves C(x) = u for the slope x towards the viewer at cotangent `cot`: the density of x is proportional to
/// (cot − x) exp(−x²) below cot, since a facet of slope x is seen in proportion to cos θ − x sin θ.
/// With y = erf(x): C ∝ cot (1 + erf x) + exp(−x²)/√π. Bisection guards Newton's steps.
fn visible_slope_along(cot: f64, u: f64) -> f64 {
    const INV_SQRT_PI: f64 = 0.564_189_583_547_756_3;
    let mass = |x: f64| cot * (1.0 + erf(x)) + INV_SQRT_PI * (-x * x).exp();
    let total = mass(cot);
    let target = u.clamp(0.0, 1.0 - 1e-12) * total;
    let (mut low, mut high) = (-6.0f64, cot.min(6.0));
    let mut x = 0.5 * (low + high).min(0.0);
    for _ in 0..64 {
        let error = mass(x) - target;
        if error > 0.0 {
            high = x
        } else {
            low = x
        }
        let slope = 2.0 * INV_SQRT_PI * (cot - x) * (-x * x).exp();
        let newton = x - error / slope;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if (next - x).abs() <= 1e-7 * (1.0 + x.abs()) {
            return next;
        }
        x = next;
    }
    x
}

/// Inverse of the error function: Giles' single-precision fit (2010).
fn erf_inv(y: f64) -> f64 {
    let w = -((1.0 - y) * (1.0 + y)).ln();
    #[rustfmt::skip]
    let fit = if w < 5.0 {
        [2.81022636e-08, 3.43273939e-07, -3.5233877e-06, -4.39150654e-06, 0.00021858087, -0.00125372503,
         -0.00417768164, 0.246640727, 1.50140941].iter().fold(0.0, |sum, c| sum * (w - 2.5) + c)
    } else {
        [-0.000200214257, 0.000100950558, 0.00134934322, -0.00367342844, 0.00573950773, -0.0076224613,
         0.00943887047, 1.00167406, 2.83297682].iter().fold(0.0, |sum, c| sum * (w.sqrt() - 3.0) + c)
    };
    fit * y
}

/// The half vector of reflection from `wo` to `wi`, on the upper side; `None` where they cancel.
pub fn half_vector(wo: Vec3, wi: Vec3) -> Option<Vec3> {
    (wo + wi).try_normalize().map(|m| if m.z < 0.0 { -m } else { m })
}
