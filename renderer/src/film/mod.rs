//! The film: sums per pixel, and the frame made of them.
//!
//! Sums are `f64`, in sample order, a pixel at a time: 2^24 samples lose nothing, and neither the number of threads
//! nor the size of the tiles changes a bit. The two halves are summed apart. Squares are summed about
//! the pixel's first value, so that a large mean does not swallow a small variance.

mod channels;
mod develop;

use limpid_frame::LayerRequest;

use channels::Plan;
pub use channels::Sample;

/// The pixels of a film, tile by tile, so that threads share out tiles and nothing else.
pub struct Film {
    /// What is summed.
    plan: Plan,
    /// First pixel in the whole film.
    pub origin: [u32; 2],
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// Row by row.
    pub tiles: Vec<Tile>,
}

/// A rectangle of pixels and their sums.
pub struct Tile {
    /// First pixel in the whole film.
    pub x: u32,
    /// First pixel in the whole film.
    pub y: u32,
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// Samples that every pixel of this tile has.
    pub samples: u32,
    /// Sums of the even and odd samples: `[pixel][selected channel][half]`.
    sums: Vec<[f64; 2]>,
    /// Sums of squares about `shift`: `[pixel][channel with variance]`.
    squares: Vec<f64>,
    /// The first value: `[pixel][channel with variance]`.
    shifts: Vec<f32>,
    /// Object and material of each pixel's first sample.
    ids: Vec<[f32; 2]>,
}

impl Film {
    /// An empty film over `width` × `height` pixels from `origin` on, in tiles of side `tile`.
    pub fn new(origin: [u32; 2], width: u32, height: u32, tile: u32, layers: &LayerRequest) -> Self {
        let plan = Plan::new(layers);
        let side = tile.max(1);
        let mut tiles = Vec::new();
        for y in (0..height).step_by(side as usize) {
            for x in (0..width).step_by(side as usize) {
                let (w, h) = (side.min(width - x), side.min(height - y));
                let pixels = w as usize * h as usize;
                tiles.push(Tile {
                    x: origin[0] + x,
                    y: origin[1] + y,
                    width: w,
                    height: h,
                    samples: 0,
                    sums: vec![[0.0; 2]; pixels * plan.sums.len()],
                    squares: vec![0.0; pixels * plan.squares.len()],
                    shifts: vec![0.0; pixels * plan.squares.len()],
                    ids: vec![[-1.0; 2]; if plan.ids { pixels } else { 0 }],
                });
            }
        }
        Self { plan, origin, width, height, tiles }
    }

    /// The tiles with what tells them how to add a sample.
    pub fn parts(&mut self) -> (&Plan, &mut [Tile]) {
        (&self.plan, &mut self.tiles)
    }
}

impl Tile {
    /// In pixels.
    pub fn pixels(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// Adds sample number `index` of a pixel. Samples of a pixel come in their order.
    #[inline]
    pub fn add(&mut self, plan: &Plan, pixel: usize, index: u32, sample: &Sample) {
        let half = (index & 1) as usize;
        let sums = &mut self.sums[pixel * plan.sums.len()..][..plan.sums.len()];
        for (sum, &channel) in sums.iter_mut().zip(&plan.sums) {
            sum[half] += f64::from(sample.values[channel as usize]);
        }
        let count = plan.squares.len();
        let squares = &mut self.squares[pixel * count..][..count];
        let shifts = &mut self.shifts[pixel * count..][..count];
        for ((square, shift), &(channel, condition)) in squares.iter_mut().zip(shifts).zip(&plan.squares) {
            let value = sample.values[channel as usize];
            if let Some(condition) = condition {
                // A sample that does not count must not count as a deviation. Depths and shares have no large mean
                // over a small variance that `f64` could not hold, so their shift stays 0.
                if sample.values[condition as usize] == 0.0 {
                    continue;
                }
            } else if index == 0 {
                *shift = value;
            }
            let d = f64::from(value) - f64::from(*shift);
            *square += d * d;
        }
        if plan.ids && index == 0 {
            self.ids[pixel] = sample.ids;
        }
    }
}

#[cfg(test)]
mod tests;
