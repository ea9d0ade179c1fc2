//! The source that every instruction set compiles. Everything is inlined into [`filter_tile`], so that the
//! caller's instructions are used throughout.

use std::ops::Range;

use super::Job;
use crate::exp::exp_neg;
use crate::filter::nlm::tile::{Grid, LANES, Rect};
use crate::filter::nlm::{Buffer, Feature, Guide};
use crate::plane::{Plane, Size};

/// Keeps a quotient finite or infinite, never 0/0, where a variance is zero: equal pixels without noise are
/// then at distance 0 and others at infinity. Guides are scaled to an ordinary exposure, so that this
/// constant is far below any variance that matters.
const TINY: f32 = f32::MIN_POSITIVE;

/// Sums of one buffer over the tile: of the weights, and of each target's weighted differences from the
/// pixel itself.
struct Sums {
    weights: Vec<f32>,
    targets: Vec<Vec<f32>>,
}

/// What is used again for each offset.
#[derive(Default)]
struct Scratch {
    /// The features' and the spatial exponent.
    exponent: Grid,
    /// Δ² per pixel of each buffer of a guide, zero where an end of it is outside the image.
    pixel: Vec<Grid>,
    /// d², then the colour weight.
    patch: Grid,
    /// The colour weight averaged over the patch.
    averaged: Grid,
    rows: Rows,
}

/// Rows in the first-level cache.
#[derive(Default)]
struct Rows {
    /// 1 / [k² (V_p + V_q)], channel after channel.
    scale: Vec<f32>,
    /// Σ over channels of (V_p + min(V_p, V_q)) / [k² (V_p + V_q)].
    noise: Vec<f32>,
    /// Sums over the height of the patch.
    columns: Vec<f32>,
    /// One over the valid width of the patch.
    share: Vec<f32>,
    weights: Vec<f32>,
}

/// See [`super::filter_tile`].
#[inline(always)]
pub(super) fn filter_tile(job: &Job, tile: &Rect) -> Vec<Vec<Plane>> {
    let buffers = || job.guides.iter().flat_map(|guide| &guide.buffers);
    // The pixel itself has weight 1: none is left without weights.
    let zero = |buffer: &Buffer| Sums {
        weights: vec![1.0; tile.pixels()],
        targets: vec![vec![0.0; tile.pixels()]; buffer.targets.len()],
    };
    let mut sums: Vec<Sums> = buffers().map(zero).collect();
    let mut scratch = Scratch::default();
    let radius = job.window.radius as isize;
    for dy in -radius..=radius {
        for dx in -radius..=radius {
            let valid = Rect::with_neighbour(job.size, (dx, dy));
            let part = tile.meet(&valid);
            if (dx, dy) != (0, 0) && !part.is_empty() {
                add_offset(job, tile, (&part, &valid), (dx, dy), &mut scratch, &mut sums);
            }
        }
    }
    let answer = buffers().zip(sums).map(|(buffer, sums)| {
        let Sums { weights, mut targets } = sums;
        for (sum, target) in targets.iter_mut().zip(buffer.targets) {
            let own = tile.y.clone().flat_map(|y| &target[tile.row_in(y, job.size)]);
            for ((sum, weight), own) in sum.iter_mut().zip(&weights).zip(own) {
                *sum = own + *sum / weight;
            }
        }
        targets
    });
    answer.collect()
}

/// Adds the neighbours at one offset to the sums of all buffers. `part` are the tile's pixels among the
/// `valid` ones, which have a neighbour there.
#[inline(always)]
fn add_offset(
    job: &Job,
    tile: &Rect,
    (part, valid): (&Rect, &Rect),
    (dx, dy): (isize, isize),
    scratch: &mut Scratch,
    sums: &mut [Sums],
) {
    let step = dy * job.size.width as isize + dx;
    let near = (dx * dx + dy * dy) as f32 / (2.0 * job.window.sigma_spatial * job.window.sigma_spatial);
    scratch.exponent.reset(part, near);
    for feature in job.features {
        raise_exponent(job.size, feature, part, step, scratch);
    }
    let mut sums = sums.iter_mut();
    for guide in job.guides {
        pixel_distances(job, guide, (part, valid), step, scratch);
        for (index, buffer) in guide.buffers.iter().enumerate() {
            color_weights(job, (part, valid), scratch, index);
            let Some(sums) = sums.next() else { return }; // there is one for each buffer
            for y in part.y.clone() {
                row_weights(job.window.average, y, part, scratch);
                let weights = &scratch.rows.weights;
                let here = tile.local(y, &part.x);
                add(&mut sums.weights[here.clone()], weights);
                let own = part.row_in(y, job.size);
                let other = shifted(own.clone(), step);
                for (sum, target) in sums.targets.iter_mut().zip(buffer.targets) {
                    add_differences(
                        &mut sum[here.clone()],
                        weights,
                        &target[own.clone()],
                        &target[other.clone()],
                    );
                }
            }
        }
    }
}

// `f32::min` and `max` also say what happens to a NaN, which costs three instructions more each.
#[inline(always)]
fn min(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

#[inline(always)]
fn max(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

#[inline(always)]
fn shifted(range: Range<usize>, step: isize) -> Range<usize> {
    range.start.wrapping_add_signed(step)..range.end.wrapping_add_signed(step)
}

#[inline(always)]
fn add(sum: &mut [f32], values: &[f32]) {
    for (sum, value) in sum.iter_mut().zip(values) {
        *sum += value;
    }
}

/// Adds `w (t_q − t_p)`. Differences, because where all are equal the answer is then exact.
#[inline(always)]
fn add_differences(sum: &mut [f32], weights: &[f32], own: &[f32], other: &[f32]) {
    let n = sum.len();
    let (weights, own, other) = (&weights[..n], &own[..n], &other[..n]);
    for i in 0..n {
        sum[i] += weights[i] * (other[i] - own[i]);
    }
}

/// Raises the exponent to Φ² of a feature where that is larger.
#[inline(always)]
fn raise_exponent(size: Size, feature: &Feature, part: &Rect, step: isize, scratch: &mut Scratch) {
    let share = 1.0 / feature.mean.len() as f32;
    for y in part.y.clone() {
        let own = part.row_in(y, size);
        let other = shifted(own.clone(), step);
        let n = part.width();
        let row = &mut scratch.rows.weights;
        row.clear();
        row.resize(n, 0.0);
        let channels = feature.mean.iter().zip(&feature.variance).zip(&feature.denominator);
        for ((mean, variance), denominator) in channels {
            let row = &mut row[..n];
            let (u_p, u_q) = (&mean[own.clone()][..n], &mean[other.clone()][..n]);
            let (v_p, v_q) = (&variance[own.clone()][..n], &variance[other.clone()][..n]);
            let (d_p, d_q) = (&denominator[own.clone()][..n], &denominator[other.clone()][..n]);
            for i in 0..n {
                let difference = u_p[i] - u_q[i];
                let noise = v_p[i] + min(v_p[i], v_q[i]);
                row[i] += (difference * difference - noise) / (d_p[i] + d_q[i] + TINY);
            }
        }
        for (exponent, sum) in scratch.exponent.row_mut(y, &part.x).iter_mut().zip(row.iter()) {
            *exponent = max(*exponent, sum * share);
        }
    }
}

/// Where d² is needed, and so Δ² a patch further.
#[inline(always)]
fn wanted(job: &Job, (part, valid): (&Rect, &Rect)) -> Rect {
    if job.window.average { part.grown(job.window.patch).meet(valid) } else { part.clone() }
}

/// Leaves Δ² of each buffer of a guide in `scratch.pixel`. Both halves of the samples have the same variance,
/// so that what depends on it alone, with its divisions, is computed once for them.
#[inline(always)]
fn pixel_distances(job: &Job, guide: &Guide, parts: (&Rect, &Rect), step: isize, scratch: &mut Scratch) {
    let wanted = wanted(job, parts).grown(job.window.patch);
    let inner = wanted.meet(parts.1);
    let n = inner.width();
    let Scratch { pixel, rows: Rows { scale, noise, .. }, .. } = scratch;
    pixel.resize_with(guide.buffers.len().max(pixel.len()), Grid::default);
    for grid in &mut pixel[..guide.buffers.len()] {
        grid.reset(&wanted, 0.0);
    }
    let k2 = job.window.k * job.window.k * guide.variance.len() as f32;
    scale.clear();
    scale.resize(n * guide.variance.len(), 0.0);
    for y in inner.y.clone() {
        let own = inner.row_in(y, job.size);
        let other = shifted(own.clone(), step);
        noise.clear();
        noise.resize(n, 0.0);
        let noise = &mut noise[..n];
        for (variance, scale) in guide.variance.iter().zip(scale.chunks_exact_mut(n)) {
            let (v_p, v_q) = (&variance[own.clone()][..n], &variance[other.clone()][..n]);
            for i in 0..n {
                scale[i] = 1.0 / (k2 * (v_p[i] + v_q[i]) + TINY);
                noise[i] += (v_p[i] + min(v_p[i], v_q[i])) * scale[i];
            }
        }
        for (buffer, grid) in guide.buffers.iter().zip(pixel.iter_mut()) {
            let row = &mut grid.row_mut(y, &inner.x)[..n];
            for (mean, scale) in buffer.mean.iter().zip(scale.chunks_exact(n)) {
                let (u_p, u_q) = (&mean[own.clone()][..n], &mean[other.clone()][..n]);
                for i in 0..n {
                    let difference = u_p[i] - u_q[i];
                    row[i] += difference * difference * scale[i];
                }
            }
            for i in 0..n {
                row[i] -= noise[i];
            }
        }
    }
}

/// Leaves d² over the part in `scratch.patch`, or the averaged weights in `scratch.averaged`.
#[inline(always)]
fn color_weights(job: &Job, parts: (&Rect, &Rect), scratch: &mut Scratch, buffer: usize) {
    let patch = job.window.patch;
    let Scratch { pixel, patch: distance, averaged, rows, .. } = scratch;
    let part = parts.0;
    if !job.window.average {
        distance.reset(part, 0.0);
        box_mean(&pixel[buffer], distance, parts, patch, rows);
        return;
    }
    let wanted = wanted(job, parts);
    distance.reset(&part.grown(patch), 0.0);
    box_mean(&pixel[buffer], distance, (&wanted, parts.1), patch, rows);
    for y in wanted.y.clone() {
        for d in distance.row_mut(y, &wanted.x) {
            *d = exp_neg(max(*d, 0.0));
        }
    }
    averaged.reset(part, 0.0);
    box_mean(distance, averaged, parts, patch, rows);
}

/// Mean of `from` over the patch around each pixel of a part, over as much of it as is valid; `from` is
/// zero elsewhere and reaches just a patch beyond the part.
#[inline(always)]
fn box_mean(from: &Grid, to: &mut Grid, (part, valid): (&Rect, &Rect), patch: usize, rows: &mut Rows) {
    let reach = patch as isize;
    let inside = |at: isize, range: &Range<isize>| {
        ((at + reach + 1).min(range.end) - (at - reach).max(range.start)) as f32
    };
    let Rows { columns, share, .. } = rows;
    share.clear();
    for x in part.x.clone() {
        share.push(1.0 / inside(x, &valid.x));
    }
    let side = 2 * patch + 1;
    let width = part.width();
    columns.clear();
    columns.resize((width + side).next_multiple_of(LANES) + LANES, 0.0);
    for y in part.y.clone() {
        for start in (0..(width + side - 1).next_multiple_of(LANES)).step_by(LANES) {
            let mut sum = [0.0; LANES];
            for row in y - reach..=y + reach {
                let from = &from.padded_row(row)[start..][..LANES];
                for i in 0..LANES {
                    sum[i] += from[i];
                }
            }
            columns[start..][..LANES].copy_from_slice(&sum);
        }
        let share_of_rows = 1.0 / inside(y, &valid.y);
        let to = to.row_mut(y, &part.x);
        let blocks = to.chunks_mut(LANES).zip(share.chunks(LANES));
        for (block, (to, share)) in blocks.enumerate() {
            let mut sum = [0.0; LANES];
            for k in 0..side {
                let columns = &columns[block * LANES + k..][..LANES];
                for i in 0..LANES {
                    sum[i] += columns[i];
                }
            }
            for ((to, share), sum) in to.iter_mut().zip(share).zip(&sum) {
                *to = sum * share * share_of_rows;
            }
        }
    }
}

/// Leaves the weights of one row of the part in `scratch.rows.weights`.
#[inline(always)]
fn row_weights(average: bool, y: isize, part: &Rect, scratch: &mut Scratch) {
    let Scratch { exponent, patch, averaged, rows: Rows { weights, .. }, .. } = scratch;
    let n = part.width();
    let exponent = &exponent.row(y, &part.x)[..n];
    weights.clear();
    weights.resize(n, 0.0);
    let weights = &mut weights[..n];
    if average {
        let color = &averaged.row(y, &part.x)[..n];
        for i in 0..n {
            weights[i] = min(color[i], exp_neg(exponent[i]));
        }
    } else {
        let color = &patch.row(y, &part.x)[..n];
        for i in 0..n {
            weights[i] = exp_neg(max(color[i], exponent[i]));
        }
    }
}
