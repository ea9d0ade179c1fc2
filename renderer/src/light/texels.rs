//! Where a textured light emits.

use glam::{DVec2, Vec2};
use limpid_scenes::Color;

use crate::color::luminance;
use crate::sampling::Distribution2d;
use crate::texture::{TexturePoint, Textures};

/// Cells along a side, at most: a megabyte of sums a megapixel.
const MOST_CELLS: f64 = 1024.0;
/// Look-ups along the side of a cell, at most.
const MOST_LOOK_UPS: f64 = 8.0;
/// Share of the mean that is added everywhere: what the look-ups have missed is still drawn, and a dark part that is near
/// costs at most a factor of 20.
pub const FLOOR: f64 = 0.05;

/// The luminance of a texture over [0, 1]² in cells, about a texel each.
pub struct Texels {
    cells: Distribution2d,
    size: [usize; 2],
    mean: f64,
}

impl Texels {
    /// `None` where nothing is to be gained: of a constant, and of what is black as far as it was looked at.
    pub fn new(emission: Color, textures: &Textures) -> Option<Self> {
        let Color::Texture(_) = emission else { return None };
        let detail = textures.detail(emission);
        let side = |texels: f64| texels.ceil().clamp(1.0, MOST_CELLS);
        let (width, height) = (side(detail.x), side(detail.y));
        // Two at least, for what is interpolated between texels.
        let look_ups = |texels: f64, cells: f64| (texels / cells).ceil().clamp(2.0, MOST_LOOK_UPS) as u32;
        let (columns, rows) = (look_ups(detail.x, width), look_ups(detail.y, height));
        let size = [width as usize, height as usize];
        let mut values = Vec::with_capacity(size[0] * size[1]);
        for cell in 0..size[0] * size[1] {
            let (column, row) = ((cell % size[0]) as f64, (cell / size[0]) as f64);
            let at = |k: u32| {
                let x = column + (f64::from(k % columns) + 0.5) / f64::from(columns);
                let y = row + (f64::from(k / columns) + 0.5) / f64::from(rows);
                DVec2::new(x / width, y / height).as_vec2()
            };
            let sum: f64 = (0..columns * rows).map(|k| luminance_at(emission, textures, at(k))).sum();
            values.push(sum / f64::from(columns * rows));
        }
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        if mean.is_nan() || mean <= 0.0 || mean.is_infinite() {
            return None;
        }
        let cells = Distribution2d::new(size[0], size[1], |i, j| values[j * size[0] + i] + FLOOR * mean)?;
        Some(Self { cells, size, mean })
    }

    /// Mean luminance.
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// A point of [0, 1]².
    #[inline]
    pub fn sample(&self, u: DVec2) -> DVec2 {
        let ([column, row], [x, y]) = self.cells.sample(u.to_array());
        DVec2::new((column as f64 + x) / self.size[0] as f64, (row as f64 + y) / self.size[1] as f64)
    }

    /// Density of a point, 1 in the mean over [0, 1]².
    #[inline]
    pub fn density(&self, uv: Vec2) -> f64 {
        let cell = |x: f32, n: usize| ((f64::from(x) * n as f64) as usize).min(n - 1);
        let [width, height] = self.size;
        self.cells.pmf([cell(uv.x, width), cell(uv.y, height)]) * (width * height) as f64
    }
}

/// Of a colour; 0 where it is negative or no number.
pub fn luminance_at(color: Color, textures: &Textures, at: impl Into<TexturePoint>) -> f64 {
    let value = f64::from(luminance(textures.color(color, at)));
    if value.is_finite() { value.max(0.0) } else { 0.0 }
}

#[cfg(test)]
mod tests;
