//! One tile of the image: the loop over the offsets of the window, and what it does for each.

use std::ops::Range;

use super::{Feature, Guide, Window};
use crate::exp::exp_neg;
use crate::plane::{Plane, Size};

/// Side in pixels. The accumulators of two components in two halves take 128 KiB then.
const SIDE: usize = 64;

/// Keeps a quotient finite or infinite, never 0/0, where a variance is zero: equal pixels without noise are
/// then at distance 0 and others at infinity. Guides are scaled to an ordinary exposure, so that this
/// constant is far below any variance that matters.
const TINY: f32 = f32::MIN_POSITIVE;

/// A rectangle of pixels; what lies in a halo may lie outside the image.
#[derive(Clone, Debug, PartialEq)]
struct Rect {
    x: Range<isize>,
    y: Range<isize>,
}

impl Rect {
    fn width(&self) -> usize {
        self.x.len()
    }

    fn is_empty(&self) -> bool {
        self.x.is_empty() || self.y.is_empty()
    }

    fn grown(&self, by: usize) -> Rect {
        let by = by as isize;
        Rect { x: self.x.start - by..self.x.end + by, y: self.y.start - by..self.y.end + by }
    }

    fn meet(&self, other: &Rect) -> Rect {
        let meet = |a: &Range<isize>, b: &Range<isize>| a.start.max(b.start)..a.end.min(b.end);
        Rect { x: meet(&self.x, &other.x), y: meet(&self.y, &other.y) }
    }

    /// Where row `y` of this part lies in a plane of this width.
    fn row_in(&self, y: isize, width: usize) -> Range<usize> {
        let start = y as usize * width + self.x.start as usize;
        start..start + self.width()
    }
}

/// Values over a rectangle.
#[derive(Default)]
struct Grid {
    /// Top left corner.
    x: isize,
    y: isize,
    width: usize,
    values: Vec<f32>,
}

impl Grid {
    /// Makes this cover a rectangle, with the same value everywhere.
    fn reset(&mut self, rect: &Rect, value: f32) {
        (self.x, self.y, self.width) = (rect.x.start, rect.y.start, rect.width());
        self.values.clear();
        self.values.resize(rect.width() * rect.y.len(), value);
    }

    fn at(&self, y: isize, x: &Range<isize>) -> Range<usize> {
        let start = (y - self.y) as usize * self.width + (x.start - self.x) as usize;
        start..start + x.len()
    }

    fn row(&self, y: isize, x: &Range<isize>) -> &[f32] {
        &self.values[self.at(y, x)]
    }

    fn row_mut(&mut self, y: isize, x: &Range<isize>) -> &mut [f32] {
        let at = self.at(y, x);
        &mut self.values[at]
    }
}

/// What is used again for each offset.
#[derive(Default)]
struct Scratch {
    /// The features' and the spatial exponent.
    exponent: Grid,
    /// Δ² per pixel, zero where an end of it is outside the image.
    pixel: Grid,
    /// d², then the colour weight.
    patch: Grid,
    /// The colour weight averaged over the patch.
    averaged: Grid,
    columns: Vec<f32>,
    share: Vec<f32>,
    weights: Vec<f32>,
}

/// Sums of one guide over the tile: of the weights, and of each target's weighted differences from the pixel itself.
struct Sums {
    weights: Vec<f32>,
    targets: Vec<Vec<f32>>,
}

/// A part of the image that is filtered by itself.
pub(super) struct Tile {
    rect: Rect,
}

impl Tile {
    /// The tiles of an image.
    pub fn all(size: Size) -> Vec<Tile> {
        let cut = |length: usize| {
            (0..length).step_by(SIDE).map(move |a| a as isize..(a + SIDE).min(length) as isize)
        };
        cut(size.height)
            .flat_map(|y| cut(size.width).map(move |x| Tile { rect: Rect { x, y: y.clone() } }))
            .collect()
    }

    /// Copies a plane of this tile into the image's.
    pub fn place(&self, size: Size, part: &[f32], out: &mut [f32]) {
        for (y, row) in self.rect.y.clone().zip(part.chunks_exact(self.rect.width())) {
            out[self.rect.row_in(y, size.width)].copy_from_slice(row);
        }
    }

    /// The filtered targets of each guide, planes of this tile.
    pub fn filter(
        &self,
        size: Size,
        window: &Window,
        guides: &[Guide],
        features: &[Feature],
    ) -> Vec<Vec<Plane>> {
        let pixels = self.rect.width() * self.rect.y.len();
        // The pixel itself has weight 1: none is left without weights.
        let zero = |guide: &Guide| Sums {
            weights: vec![1.0; pixels],
            targets: vec![vec![0.0; pixels]; guide.targets.len()],
        };
        let mut sums: Vec<Sums> = guides.iter().map(zero).collect();
        let mut scratch = Scratch::default();
        let radius = window.radius as isize;
        for dy in -radius..=radius {
            for dx in -radius..=radius {
                if (dx, dy) != (0, 0) {
                    self.offset(size, window, guides, features, (dx, dy), &mut scratch, &mut sums);
                }
            }
        }
        let filtered = guides.iter().zip(sums).map(|(guide, sums)| {
            let Sums { weights, mut targets } = sums;
            for (sum, target) in targets.iter_mut().zip(guide.targets) {
                let own = self.rect.y.clone().flat_map(|y| &target[self.rect.row_in(y, size.width)]);
                for ((sum, weight), own) in sum.iter_mut().zip(&weights).zip(own) {
                    *sum = own + *sum / weight;
                }
            }
            targets
        });
        filtered.collect()
    }

    #[allow(clippy::too_many_arguments)] // the loop's body, apart for its length only
    fn offset(
        &self,
        size: Size,
        window: &Window,
        guides: &[Guide],
        features: &[Feature],
        (dx, dy): (isize, isize),
        scratch: &mut Scratch,
        sums: &mut [Sums],
    ) {
        // Pixels with a neighbour at this offset, in the image and in the tile.
        let (width, height) = (size.width as isize, size.height as isize);
        let valid = Rect { x: (-dx).max(0)..width.min(width - dx), y: (-dy).max(0)..height.min(height - dy) };
        let part = self.rect.meet(&valid);
        if part.is_empty() {
            return;
        }
        let step = dy * width + dx;
        let near = (dx * dx + dy * dy) as f32 / (2.0 * window.sigma_spatial * window.sigma_spatial);
        scratch.exponent.reset(&part, near);
        for feature in features {
            feature_exponent(size, feature, &part, step, &mut scratch.exponent);
        }
        for (guide, sums) in guides.iter().zip(sums) {
            color_weights(size, window, guide, (&part, &valid), step, scratch);
            for y in part.y.clone() {
                let exponent = scratch.exponent.row(y, &part.x);
                let weights = &mut scratch.weights;
                weights.clear();
                if window.average {
                    let color = scratch.averaged.row(y, &part.x);
                    weights.extend(color.iter().zip(exponent).map(|(&w, &e)| min(w, exp_neg(e))));
                } else {
                    let color = scratch.patch.row(y, &part.x);
                    weights.extend(color.iter().zip(exponent).map(|(&d, &e)| exp_neg(max(d, e))));
                }
                let here = self.rect.local(y, &part.x);
                let there = shifted(part.row_in(y, size.width), step);
                add(&mut sums.weights[here.clone()], weights);
                for (sum, target) in sums.targets.iter_mut().zip(guide.targets) {
                    let own = &target[part.row_in(y, size.width)];
                    add_differences(&mut sum[here.clone()], weights, own, &target[there.clone()]);
                }
            }
        }
    }
}

impl Rect {
    /// Where part of row `y` lies in a plane of this rectangle.
    fn local(&self, y: isize, x: &Range<isize>) -> Range<usize> {
        let start = (y - self.y.start) as usize * self.width() + (x.start - self.x.start) as usize;
        start..start + x.len()
    }
}

// `f32::min` and `max` also say what happens to a NaN, which costs three instructions more each.
fn min(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

fn max(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

fn shifted(range: Range<usize>, step: isize) -> Range<usize> {
    range.start.wrapping_add_signed(step)..range.end.wrapping_add_signed(step)
}

fn add(sum: &mut [f32], values: &[f32]) {
    sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
}

/// Adds `w (t_q − t_p)`. Differences, because where all are equal the answer is then exact.
fn add_differences(sum: &mut [f32], weights: &[f32], own: &[f32], other: &[f32]) {
    let n = sum.len();
    let (weights, own, other) = (&weights[..n], &own[..n], &other[..n]);
    for i in 0..n {
        sum[i] += weights[i] * (other[i] - own[i]);
    }
}

/// Raises the exponent to Φ² of a feature where that is larger.
fn feature_exponent(size: Size, feature: &Feature, part: &Rect, step: isize, exponent: &mut Grid) {
    let share = 1.0 / feature.mean.len() as f32;
    let mut row = vec![0.0; part.width()];
    for y in part.y.clone() {
        let p = part.row_in(y, size.width);
        row.fill(0.0);
        for ((mean, variance), denominator) in
            feature.mean.iter().zip(&feature.variance).zip(&feature.denominator)
        {
            add_distance(&mut row, (mean, variance, denominator), p.clone(), step, 1.0);
        }
        let exponent = exponent.row_mut(y, &part.x);
        exponent.iter_mut().zip(&row).for_each(|(e, &sum)| *e = max(*e, sum * share));
    }
}

/// Adds `[(u_p − u_q)² − (V_p + min(V_p, V_q))] / [k2 (D_p + D_q)]` of one channel for a row of pixels.
#[inline]
fn add_distance(
    row: &mut [f32],
    (mean, variance, denominator): (&[f32], &[f32], &[f32]),
    p: Range<usize>,
    step: isize,
    k2: f32,
) {
    let n = row.len();
    let q = shifted(p.clone(), step);
    let (u_p, u_q) = (&mean[p.clone()][..n], &mean[q.clone()][..n]);
    let (v_p, v_q) = (&variance[p.clone()][..n], &variance[q.clone()][..n]);
    let (d_p, d_q) = (&denominator[p][..n], &denominator[q][..n]);
    for i in 0..n {
        let difference = u_p[i] - u_q[i];
        let noise = v_p[i] + min(v_p[i], v_q[i]);
        row[i] += (difference * difference - noise) / (k2 * (d_p[i] + d_q[i]) + TINY);
    }
}

/// Leaves d² over the part in `scratch.patch`, or the averaged weights in `scratch.averaged`.
fn color_weights(
    size: Size,
    window: &Window,
    guide: &Guide,
    (part, valid): (&Rect, &Rect),
    step: isize,
    scratch: &mut Scratch,
) {
    let patch = window.patch;
    let Scratch { pixel, patch: distance, averaged, columns, share, .. } = scratch;
    // Where d² is needed, and Δ² for it.
    let wanted = if window.average { part.grown(patch).meet(valid) } else { part.clone() };
    let inner = wanted.grown(patch).meet(valid);
    pixel.reset(&wanted.grown(patch), 0.0);
    let k2 = window.k * window.k * guide.mean.len() as f32;
    for y in inner.y.clone() {
        let row = pixel.row_mut(y, &inner.x);
        for (mean, variance) in guide.mean.iter().zip(guide.variance) {
            add_distance(row, (mean, variance, variance), inner.row_in(y, size.width), step, k2);
        }
    }
    if !window.average {
        distance.reset(part, 0.0);
        box_mean(pixel, distance, part, valid, patch, columns, share);
        return;
    }
    distance.reset(&part.grown(patch), 0.0);
    box_mean(pixel, distance, &wanted, valid, patch, columns, share);
    for y in wanted.y.clone() {
        distance.row_mut(y, &wanted.x).iter_mut().for_each(|d| *d = exp_neg(max(*d, 0.0)));
    }
    averaged.reset(part, 0.0);
    box_mean(distance, averaged, part, valid, patch, columns, share);
}

/// Mean of `from` over the patch around each pixel of a part, over as much of it as is valid; `from` is
/// zero elsewhere and reaches a patch beyond the part.
fn box_mean(
    from: &Grid,
    to: &mut Grid,
    part: &Rect,
    valid: &Rect,
    patch: usize,
    columns: &mut Vec<f32>,
    share: &mut Vec<f32>,
) {
    let reach = patch as isize;
    let inside = |at: isize, range: &Range<isize>| {
        ((at + reach + 1).min(range.end) - (at - reach).max(range.start)) as f32
    };
    share.clear();
    share.extend(part.x.clone().map(|x| 1.0 / inside(x, &valid.x)));
    let wide = part.x.start - reach..part.x.end + reach;
    for y in part.y.clone() {
        columns.clear();
        columns.resize(wide.len(), 0.0);
        for row in y - reach..=y + reach {
            add(columns, from.row(row, &wide));
        }
        let to = to.row_mut(y, &part.x);
        to.fill(0.0);
        for k in 0..=2 * patch {
            add(to, &columns[k..][..part.width()]);
        }
        let rows = 1.0 / inside(y, &valid.y);
        to.iter_mut().zip(share.iter()).for_each(|(value, share)| *value *= share * rows);
    }
}
