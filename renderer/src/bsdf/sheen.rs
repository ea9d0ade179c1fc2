//! The sheen of `KHR_materials_sheen`: fibres that stand off the surface.

use std::f32::consts::{PI, TAU};
use std::sync::OnceLock;

use glam::Vec3;

/// Narrower ones cannot be told apart, and their inverse width has to stay in range.
const SMALLEST_ALPHA: f32 = 1e-3;

/// Entries a side, equally spaced in √cos θ and √alpha from 0 to 1.
const SIZE: usize = 24;

/// `f · cos θi` of white sheen of width `alpha`, for directions above the surface (Conty Estevez and Kulla 2017, eqs. 2
/// and 3):
///
/// ```text
/// f = D / ((1 + Λ(θo) + Λ(θi)) 4 cos θo cos θi)     D = (2 + 1/α) sin^(1/α) θm / 2π
/// ```
///
/// The simpler visibility of Neubelt and Pettineo (2013), which the extension also allows, reflects 1.8 times what it gets
/// at grazing angles and roughness 0.2.
#[inline]
pub fn f_cos(wo: Vec3, wi: Vec3, alpha: f32) -> f32 {
    let Some(m) = (wo + wi).try_normalize() else { return 0.0 };
    let inverse = 1.0 / alpha.max(SMALLEST_ALPHA);
    let sin2 = (m.x * m.x + m.y * m.y).min(1.0);
    let d = (2.0 + inverse) * sin2.powf(0.5 * inverse) / TAU;
    d / ((1.0 + lambda(wo.z, alpha) + lambda(wi.z, alpha)) * 4.0 * wo.z)
}

/// The fit of Λ by its authors (2017, section 4 and table 1), but for the softened terminator.
#[inline]
fn lambda(cos: f32, alpha: f32) -> f32 {
    let t = (1.0 - alpha) * (1.0 - alpha);
    let mix = |smooth: f32, rough: f32| rough + (smooth - rough) * t;
    let (a, b, c) = (mix(25.3245, 21.5473), mix(3.32435, 3.82987), mix(0.16801, 0.19823));
    let (d, e) = (mix(-1.27393, -1.97760), mix(-4.85967, -4.32054));
    let l = |x: f32| a / (1.0 + b * x.powf(c)) + d * x + e;
    if cos < 0.5 { l(cos).exp() } else { (2.0 * l(0.5) - l((1.0 - cos).max(0.0))).exp() }
}

/// Directional albedo of white sheen from the cosine `cos`, from a table that is made when it is first asked for.
#[inline]
pub fn albedo(cos: f32, alpha: f32) -> f32 {
    static TABLE: OnceLock<Box<[[f32; SIZE]; SIZE]>> = OnceLock::new();
    let table = TABLE.get_or_init(tabulate);
    let place = |x: f32| {
        let x = x.clamp(0.0, 1.0).sqrt() * (SIZE - 1) as f32;
        let i = (x as usize).min(SIZE - 2);
        (x - i as f32, i)
    };
    let ((x, i), (y, j)) = (place(cos), place(alpha));
    let row = |j: usize| (1.0 - x) * table[j][i] + x * table[j][i + 1];
    ((1.0 - y) * row(j) + y * row(j + 1)).min(1.0)
}

fn tabulate() -> Box<[[f32; SIZE]; SIZE]> {
    let square = |i: usize| (i as f32 / (SIZE - 1) as f32).powi(2);
    Box::new(std::array::from_fn(|j| std::array::from_fn(|i| integrate(square(i), square(j)))))
}

/// By the midpoint rule over the angles: dω = sin θ dθ dφ.
fn integrate(cos: f32, alpha: f32) -> f32 {
    const N: usize = 48;
    let wo = Vec3::new(((1.0 - cos) * (1.0 + cos)).sqrt(), 0.0, cos);
    let mut sum = 0.0;
    for i in 0..N {
        let (sin, cos) = ((i as f32 + 0.5) / N as f32 * 0.5 * PI).sin_cos();
        for j in 0..N {
            let (sin_phi, cos_phi) = ((j as f32 + 0.5) / N as f32 * PI).sin_cos();
            sum += sin * f_cos(wo, Vec3::new(sin * cos_phi, sin * sin_phi, cos), alpha);
        }
    }
    // Half the circle stands for both.
    sum * PI * PI / (N * N) as f32
}

#[cfg(test)]
mod tests {
    use limpid_testkit::furnace;

    use super::*;
    use crate::sampling::warp::{cosine_hemisphere, cosine_hemisphere_pdf};

    #[test]
    fn the_table_holds_the_albedo() {
        for alpha in [0.01, 0.09, 0.25, 0.5, 1.0] {
            for cos in [0.05f32, 0.3, 0.7, 1.0] {
                let wo = Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
                let truth = furnace(1 << 15, |_, u| {
                    let wi = cosine_hemisphere(u);
                    Vec3::splat(f_cos(wo, wi, alpha) / cosine_hemisphere_pdf(wi).max(f32::MIN_POSITIVE))
                });
                let table = albedo(cos, alpha);
                let off = (f64::from(table) - truth.x.min(1.0)).abs();
                assert!(off < 0.02, "alpha {alpha}, cos {cos}: {table}, truth {}", truth.x);
            }
        }
    }
}
