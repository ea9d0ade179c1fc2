//! Directional albedos of microfacet lobes, for the feature layers.

use std::sync::OnceLock;

use glam::{Vec2, Vec3};
use limpid_scenes::Distribution;

use super::microfacet::Microfacet;
use crate::color::Rgb;

/// Rows of the table: cosines and square roots of widths, from 0 to 1.
const SIZE: usize = 16;

/// (a, b): the albedo of a lobe whose reflectance runs from `f0` at normal incidence to `f90` at grazing incidence as
/// f0 + (f90 − f0)(1 − cos)⁵ is a f0 + b f90 (the split of Karis 2013).
type Table = [[(f32, f32); SIZE]; SIZE];

/// Albedo of a lobe with reflectance `f0` at normal and `f90` at grazing incidence, within a few per cent.
pub fn specular(microfacet: &Microfacet, cos: f32, f0: Rgb, f90: Rgb) -> Rgb {
    static TABLES: [OnceLock<Table>; 2] = [OnceLock::new(), OnceLock::new()];
    let slot = match microfacet.distribution {
        Distribution::Beckmann => &TABLES[0],
        Distribution::Ggx => &TABLES[1],
    };
    let table = slot.get_or_init(|| tabulate(microfacet.distribution));
    let last = (SIZE - 1) as f32;
    let x = cos.clamp(0.0, 1.0) * last;
    let y = (microfacet.alpha_x * microfacet.alpha_y).sqrt().sqrt().clamp(0.0, 1.0) * last;
    let (i, j) = ((x as usize).min(SIZE - 2), (y as usize).min(SIZE - 2));
    let (s, t) = (x - i as f32, y - j as f32);
    let mix = |f: fn((f32, f32)) -> f32| {
        let row = |j: usize| f(table[j][i]) * (1.0 - s) + f(table[j][i + 1]) * s;
        row(j) * (1.0 - t) + row(j + 1) * t
    };
    f0 * mix(|ab| ab.0) + f90 * mix(|ab| ab.1)
}

fn tabulate(distribution: Distribution) -> Table {
    let mut table = [[(0.0, 0.0); SIZE]; SIZE];
    for (j, row) in table.iter_mut().enumerate() {
        let alpha = (j as f32 / (SIZE - 1) as f32).powi(2);
        let facets = Microfacet::new(distribution, alpha, alpha);
        for (i, cell) in row.iter_mut().enumerate() {
            let cos = (i as f32 / (SIZE - 1) as f32).max(1e-3);
            *cell = integrate(&facets, cos);
        }
    }
    table
}

fn integrate(facets: &Microfacet, cos: f32) -> (f32, f32) {
    const N: u32 = 24;
    let wo = Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
    let (mut a, mut b) = (0.0, 0.0);
    for k in 0..N * N {
        let u = Vec2::new((k % N) as f32 + 0.5, (k / N) as f32 + 0.5) / N as f32;
        let m = facets.sample_visible(wo, u);
        let cos_m = wo.dot(m);
        let wi = 2.0 * cos_m * m - wo;
        if wi.z > 0.0 && cos_m > 0.0 {
            let g = facets.g1(wi, m);
            let schlick = (1.0 - cos_m).max(0.0).powi(5);
            a += g * (1.0 - schlick);
            b += g * schlick;
        }
    }
    let n = (N * N) as f32;
    (a / n, b / n)
}
