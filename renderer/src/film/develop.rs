//! From sums to a frame.

use limpid_frame::{Frame, Layer, Statistic};

use super::channels::{condition, first_channel};
use super::{Film, Tile};

/// Moments of one channel of one pixel.
struct Moments {
    /// Sums of the halves.
    sums: [f64; 2],
    /// Sum of squares about the shift, and the shift.
    squares: Option<(f64, f64)>,
    /// Samples that count in each half.
    counts: [f64; 2],
}

impl Moments {
    fn get(&self, statistic: Statistic) -> f32 {
        let n = self.counts[0] + self.counts[1];
        let ratio = |sum: f64, n: f64| if n > 0.0 { (sum / n) as f32 } else { 0.0 };
        match statistic {
            Statistic::Mean => ratio(self.sums[0] + self.sums[1], n),
            Statistic::A => ratio(self.sums[0], self.counts[0]),
            Statistic::B => ratio(self.sums[1], self.counts[1]),
            Statistic::Variance => match self.squares {
                Some((square, shift)) if n > 1.0 => {
                    let deviation = self.sums[0] + self.sums[1] - n * shift;
                    ((square - deviation * deviation / n).max(0.0) / (n - 1.0) / n).min(f32::MAX.into())
                        as f32
                }
                _ => -1.0,
            },
        }
    }
}

impl Film {
    /// The frame of what has been summed so far. The halves are left out where any pixel has but one sample.
    pub fn develop(&self) -> Frame {
        let mut frame = Frame::new(self.width as usize, self.height as usize);
        let halves = self.tiles.iter().all(|tile| tile.samples > 1);
        for (layer, statistic) in self.plan.layers.iter() {
            if !halves && matches!(statistic, Statistic::A | Statistic::B) {
                continue;
            }
            let planes = (0..layer.channels().len()).map(|channel| self.plane(layer, statistic, channel));
            frame.insert_layer(layer, statistic, planes.collect());
        }
        frame
    }

    /// The beauty with its halves, whatever was asked for: what the error figure is made of. `None` with one sample.
    pub fn beauty_halves(&self) -> Option<Frame> {
        if self.tiles.iter().any(|tile| tile.samples < 2) {
            return None;
        }
        let mut frame = Frame::new(self.width as usize, self.height as usize);
        for statistic in [Statistic::Mean, Statistic::A, Statistic::B] {
            let planes = (0..3).map(|channel| self.plane(Layer::Beauty, statistic, channel)).collect();
            frame.insert_layer(Layer::Beauty, statistic, planes);
        }
        Some(frame)
    }

    fn plane(&self, layer: Layer, statistic: Statistic, channel: usize) -> Vec<f32> {
        let slots = Slots::new(self, layer, channel);
        let mut plane = vec![0.0; self.width as usize * self.height as usize];
        for tile in &self.tiles {
            for pixel in 0..tile.pixels() {
                let (x, y) = (pixel as u32 % tile.width, pixel as u32 / tile.width);
                let (x, y) = (tile.x - self.origin[0] + x, tile.y - self.origin[1] + y);
                plane[y as usize * self.width as usize + x as usize] = match layer {
                    Layer::Samples => tile.samples as f32,
                    Layer::Id => tile.ids[pixel][channel],
                    _ => slots.moments(self, tile, pixel).get(statistic),
                };
            }
        }
        plane
    }
}

/// Where one channel stands in a tile's sums.
struct Slots {
    sums: Option<usize>,
    squares: Option<usize>,
    /// The sums that count the samples, where not all do.
    counts: Option<usize>,
    conditional: bool,
}

impl Slots {
    fn new(film: &Film, layer: Layer, channel: usize) -> Self {
        let channel = first_channel(layer).map(|first| first + channel);
        let sum_of = |channel: usize| film.plan.sums.iter().position(|&c| c as usize == channel);
        Self {
            sums: channel.and_then(sum_of),
            squares: film.plan.squares.iter().position(|&(c, _)| Some(c as usize) == channel),
            counts: condition(layer).and_then(sum_of),
            conditional: condition(layer).is_some(),
        }
    }

    fn moments(&self, film: &Film, tile: &Tile, pixel: usize) -> Moments {
        let plan = &film.plan;
        let sums =
            |slot: Option<usize>| slot.map_or([0.0; 2], |slot| tile.sums[pixel * plan.sums.len() + slot]);
        let squares = self.squares.map(|slot| {
            let i = pixel * plan.squares.len() + slot;
            (tile.squares[i], f64::from(tile.shifts[i]))
        });
        let counts = if self.conditional {
            sums(self.counts)
        } else {
            [f64::from(tile.samples.div_ceil(2)), f64::from(tile.samples / 2)]
        };
        Moments { sums: sums(self.sums), squares, counts }
    }
}
