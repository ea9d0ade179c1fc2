//! Albedo of isotropic microfacet lobes, for the feature layers: a small table, made when it is first asked for.

use std::sync::OnceLock;

use glam::{Vec2, Vec3};
use limpid_scenes::Distribution;

use super::microfacet::{LARGEST_TABULATED, Microfacet};
use crate::color::Rgb;

/// Entries a side, equally spaced in √cos θ and √alpha from 0 to 1.
const SIZE: usize = 20;

/// By √alpha, then by √cos θ.
type Table = [[Lobe; SIZE]; SIZE];

/// The albedo of a white lobe, then the mean cosine to the facet in each part of what it reflects, by that cosine.
type Lobe = [f32; 1 + SHARES.len()];

/// The parts, narrower towards grazing incidence, where reflectances bend.
const SHARES: [f32; 6] = [0.05, 0.1, 0.15, 0.2, 0.25, 0.25];

/// Albedo of a lobe with the reflectance `f` of the cosine to the facet.
///
/// Schlick's curve with one value for the table to store (Karis 2013) was up to 25 % off for weak metals, whose
/// reflectance is no such curve; four values of the true one do for any, and are exact for narrow lobes.
pub fn albedo(distribution: Distribution, alpha: f32, cos: f32, f: impl Fn(f32) -> Rgb) -> Rgb {
    let [white, cosines @ ..] = lobe(distribution, alpha, cos);
    cosines.iter().zip(SHARES).map(|(&cos_m, share)| f(cos_m) * (white * share)).sum()
}

fn lobe(distribution: Distribution, alpha: f32, cos: f32) -> Lobe {
    static TABLES: [OnceLock<Table>; 2] = [OnceLock::new(), OnceLock::new()];
    let table = TABLES[(distribution == Distribution::Ggx) as usize].get_or_init(|| tabulate(distribution));
    let (x, i) = place(cos.clamp(0.0, 1.0));
    let (y, j) = place(alpha.clamp(0.0, LARGEST_TABULATED));
    std::array::from_fn(|k| {
        let row = |j: usize| (1.0 - x) * table[j][i][k] + x * table[j][i + 1][k];
        (1.0 - y) * row(j) + y * row(j + 1)
    })
}

/// Way between two entries, and the first of them.
fn place(x: f32) -> (f32, usize) {
    let x = x.sqrt() * (SIZE - 1) as f32;
    let i = (x as usize).min(SIZE - 2);
    (x - i as f32, i)
}

fn tabulate(distribution: Distribution) -> Table {
    let square = |i: usize| (i as f32 / (SIZE - 1) as f32).powi(2);
    std::array::from_fn(|j| {
        let facets = Microfacet::new(distribution, square(j), square(j));
        std::array::from_fn(|i| integrate(&facets, square(i).max(1e-6)))
    })
}

fn integrate(facets: &Microfacet, cos: f32) -> Lobe {
    let wo = Vec3::new(((1.0 - cos) * (1.0 + cos)).sqrt(), 0.0, cos);
    let mut reflected: Vec<(f32, f32)> = lattice::<377, 233>()
        .filter_map(|u| facets.reflection(wo, facets.sample(wo, u)?))
        .map(|lobe| (lobe.cos_m, lobe.weight))
        .collect();
    reflected.sort_by(|a, b| a.0.total_cmp(&b.0));
    let total: f32 = reflected.iter().map(|r| r.1).sum();
    let mut means = [0.0; SHARES.len()];
    let (mut part, mut filled) = (0, 0.0);
    for (cos_m, weight) in reflected {
        means[part] += cos_m * weight;
        filled += weight;
        // The last part takes what rounding leaves.
        while part + 1 < SHARES.len() && filled >= SHARES[part] * total {
            means[part] -= cos_m * (filled - SHARES[part] * total);
            filled -= SHARES[part] * total;
            part += 1;
            means[part] += cos_m * filled;
        }
    }
    std::array::from_fn(|i| match i {
        0 => total / 377.0,
        _ => (means[i - 1] / (SHARES[i - 1] * total)).clamp(0.0, 1.0),
    })
}

/// Fibonacci's lattice in the unit square: `POINTS` and `STEP` are neighbours in his sequence. Its rows and columns are
/// all different, which a grid's are not: edges of the integrand hurt it less.
pub fn lattice<const POINTS: u32, const STEP: u32>() -> impl Iterator<Item = Vec2> {
    (0..POINTS).map(|i| Vec2::new((i * STEP % POINTS) as f32, i as f32 + 0.5) / POINTS as f32)
}
