//! The source that every instruction set compiles. Everything is inlined into [`filter_tile`], so that the
//! caller's instructions are used throughout.
//!
//! Rows are whole blocks of [`LANES`], so that no loop has a remainder; what is outside the image or the tile is
//! computed from zeros, and cleared or never read. A block is copied before it is worked on and stored as a
//! whole: through references the compiler cannot know that they do not overlap, and computes value by value
//! (three times as slow).

use super::Job;
use crate::exp::exp_neg;
use crate::filter::nlm::tile::{Block, Grid, LANES, Local, Rect};
use crate::plane::Plane;

/// Keeps a quotient finite or infinite, never 0/0, where a variance is zero: equal pixels without noise are
/// then at distance 0 and others at infinity. Guides are scaled to an ordinary exposure, so that this
/// constant is far below any variance that matters.
const TINY: f32 = f32::MIN_POSITIVE;

/// A guide, a buffer and a feature as numbers of planes in a [`Local`].
struct Guide {
    k: f32,
    sigma_spatial: f32,
    /// Whether any pixel of the tile has noise: if not, there is nothing to do.
    noisy: bool,
    variance: Vec<usize>,
    buffers: Vec<Buffer>,
}

/// With the sums over the tile: of the weights, and of each target's weighted differences from the pixel itself.
struct Buffer {
    mean: Vec<usize>,
    targets: Vec<usize>,
    weights: Grid,
    sums: Vec<Grid>,
}

/// Mean, variance and denominator of each channel.
struct Feature {
    channels: Vec<[usize; 3]>,
}

/// One offset of the window.
struct Offset {
    dx: isize,
    dy: isize,
    /// The pixels with a neighbour there.
    valid: Rect,
    /// Those of the tile.
    part: Rect,
    /// Where d² is needed: all of the tile, and a patch around it if weights are averaged.
    wanted: Rect,
}

/// What is used again for each offset.
#[derive(Default)]
struct Scratch {
    /// The features' and the spatial exponent, over the tile.
    exponent: Grid,
    /// Δ² per pixel of each buffer of a guide, zero where an end of it is outside the image.
    pixel: Vec<Grid>,
    /// d², and `exp(−d²)` if weights are averaged.
    patch: Grid,
    /// The colour weight averaged over the patch.
    averaged: Grid,
    /// 1 / [k² (V_p + V_q)] of a row, channel after channel.
    scale: Vec<Block>,
    /// Σ over channels of (V_p + min(V_p, V_q)) / [k² (V_p + V_q)].
    noise: Vec<Block>,
    /// Sums over the height of the patch.
    columns: Vec<f32>,
    /// One over the valid width of the patch.
    share: Vec<f32>,
    row: Vec<Block>,
}

/// See [`super::filter_tile`].
#[inline(always)]
pub(super) fn filter_tile(job: &Job, tile: &Rect) -> Vec<Vec<Plane>> {
    let window = job.window;
    let halo = if window.average { 2 * window.patch } else { window.patch };
    let mut local = Local::new(job.size, tile, window.radius + halo);
    let mut guides = copy_guides(job, tile, &mut local);
    let features = copy_features(job, &mut local);
    for guide in &mut guides {
        guide.noisy = tile.y.clone().any(|y| noise_free(guide, &local, tile, y).contains(&false));
    }
    if !guides.iter().any(|guide| guide.noisy) {
        return finish(guides, &local, tile);
    }
    let mut scratch = Scratch::default();
    let radius = window.radius as isize;
    for dy in -radius..=radius {
        for dx in -radius..=radius {
            let valid = Rect::with_neighbour(job.size, (dx, dy));
            let part = tile.meet(&valid);
            if (dx, dy) == (0, 0) || part.is_empty() {
                continue;
            }
            let wanted = if window.average { tile.grown(window.patch) } else { tile.clone() };
            let offset = Offset { dx, dy, valid, part, wanted };
            scratch.exponent.cover(tile);
            for feature in &features {
                raise_exponent(feature, &local, tile, &offset, &mut scratch);
            }
            for guide in guides.iter_mut().filter(|guide| guide.noisy) {
                pixel_distances(job, guide, &local, &offset, &mut scratch);
                for (index, buffer) in guide.buffers.iter_mut().enumerate() {
                    color_weights(job, tile, &offset, &mut scratch, index);
                    accumulate(job, guide.sigma_spatial, buffer, &local, tile, &offset, &mut scratch);
                }
            }
        }
    }
    finish(guides, &local, tile)
}

/// Which pixels of a row of the tile have no variance in any channel.
fn noise_free(guide: &Guide, local: &Local, tile: &Rect, y: isize) -> Vec<bool> {
    let mut free = vec![true; tile.width()];
    for &variance in &guide.variance {
        let row = local.row(variance, (tile.x.start, y), tile.width().div_ceil(LANES));
        for (free, variance) in free.iter_mut().zip(row.as_flattened()) {
            *free &= *variance == 0.0;
        }
    }
    free
}

fn copy_guides<'a>(job: &Job<'a>, tile: &Rect, local: &mut Local<'a>) -> Vec<Guide> {
    let mut copy = |planes: &'a [Plane]| planes.iter().map(|plane| local.copy(plane)).collect::<Vec<_>>();
    let empty = || {
        let mut grid = Grid::default();
        grid.cover(tile);
        grid
    };
    let mut guides = Vec::new();
    for guide in job.guides {
        let variance = copy(guide.variance);
        let buffers = guide.buffers.iter().map(|buffer| Buffer {
            mean: copy(buffer.mean),
            targets: copy(buffer.targets),
            weights: empty(),
            sums: buffer.targets.iter().map(|_| empty()).collect(),
        });
        let buffers = buffers.collect();
        guides.push(Guide {
            k: guide.k,
            sigma_spatial: guide.sigma_spatial,
            noisy: false,
            variance,
            buffers,
        });
    }
    guides
}

fn copy_features<'a>(job: &Job<'a>, local: &mut Local<'a>) -> Vec<Feature> {
    let copy = |feature: &'a crate::filter::nlm::Feature| {
        let planes = feature.mean.iter().zip(&feature.variance).zip(&feature.denominator);
        let channels = planes.map(|((mean, variance), denominator)| {
            [mean, variance, denominator].map(|plane| local.copy(plane))
        });
        Feature { channels: channels.collect() }
    };
    job.features.iter().map(copy).collect()
}

/// The answer of each buffer. The pixel itself has weight 1: none is left without weights.
fn finish(guides: Vec<Guide>, local: &Local, tile: &Rect) -> Vec<Vec<Plane>> {
    let mut answer = Vec::new();
    for guide in &guides {
        for Buffer { targets, weights, sums, .. } in &guide.buffers {
            let mut planes = vec![Vec::with_capacity(tile.pixels()); targets.len()];
            for y in tile.y.clone() {
                let free = noise_free(guide, local, tile, y);
                let weights = weights.row(y).as_flattened();
                for ((plane, &target), sums) in planes.iter_mut().zip(targets).zip(sums) {
                    let own = local.row(target, (tile.x.start, y), sums.blocks()).as_flattened();
                    let row = own.iter().zip(sums.row(y).as_flattened()).zip(weights).zip(&free);
                    plane.extend(row.map(
                        |(((own, sum), weights), free)| {
                            if *free { *own } else { own + sum / (1.0 + weights) }
                        },
                    ));
                }
            }
            answer.push(planes);
        }
    }
    answer
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
fn zeros<T: Copy>(row: &mut Vec<T>, n: usize, zero: T) -> &mut [T] {
    row.clear();
    row.resize(n, zero);
    &mut row[..n]
}

/// Raises the exponent to Φ² of a feature where that is larger.
#[inline(always)]
fn raise_exponent(feature: &Feature, local: &Local, tile: &Rect, offset: &Offset, scratch: &mut Scratch) {
    let share = 1.0 / feature.channels.len() as f32;
    let n = scratch.exponent.blocks();
    for y in offset.part.y.clone() {
        let row = zeros(&mut scratch.row, n, [0.0; LANES]);
        for channel in &feature.channels {
            let neighbour = (tile.x.start + offset.dx, y + offset.dy);
            let [u_p, v_p, d_p] = channel.map(|number| local.row(number, (tile.x.start, y), n));
            let [u_q, v_q, d_q] = channel.map(|number| local.row(number, neighbour, n));
            for b in 0..n {
                let (u_p, v_p, d_p) = (u_p[b], v_p[b], d_p[b]);
                let (u_q, v_q, d_q) = (u_q[b], v_q[b], d_q[b]);
                let mut sum = row[b];
                for i in 0..LANES {
                    let difference = u_p[i] - u_q[i];
                    let noise = v_p[i] + min(v_p[i], v_q[i]);
                    sum[i] += (difference * difference - noise) / (d_p[i] + d_q[i] + TINY);
                }
                row[b] = sum;
            }
        }
        for (exponent, sum) in scratch.exponent.row_mut(y).iter_mut().zip(row.iter()) {
            let (mut raised, sum) = (*exponent, *sum);
            for i in 0..LANES {
                raised[i] = max(raised[i], sum[i] * share);
            }
            *exponent = raised;
        }
    }
}

/// Leaves Δ² of each buffer of a guide in `scratch.pixel`. Both halves of the samples have the same variance,
/// so that what depends on it alone, with its divisions, is computed once for them.
#[inline(always)]
fn pixel_distances(job: &Job, guide: &Guide, local: &Local, offset: &Offset, scratch: &mut Scratch) {
    let area = offset.wanted.grown(job.window.patch);
    let inner = area.meet(&offset.valid);
    let Scratch { pixel, scale, noise, .. } = scratch;
    pixel.resize_with(guide.buffers.len().max(pixel.len()), Grid::default);
    for grid in &mut pixel[..guide.buffers.len()] {
        grid.cover(&area);
    }
    let n = area.width().div_ceil(LANES);
    let k2 = guide.k * guide.k * guide.variance.len() as f32;
    zeros(scale, n * guide.variance.len(), [0.0; LANES]);
    for y in inner.y.clone() {
        let (own, other) = ((area.x.start, y), (area.x.start + offset.dx, y + offset.dy));
        let noise = zeros(noise, n, [0.0; LANES]);
        for (&variance, scale) in guide.variance.iter().zip(scale.chunks_exact_mut(n)) {
            let (v_p, v_q) = (local.row(variance, own, n), local.row(variance, other, n));
            for b in 0..n {
                let (v_p, v_q, mut s, mut sum) = (v_p[b], v_q[b], [0.0; LANES], noise[b]);
                for i in 0..LANES {
                    s[i] = 1.0 / (k2 * (v_p[i] + v_q[i]) + TINY);
                    sum[i] += (v_p[i] + min(v_p[i], v_q[i])) * s[i];
                }
                (scale[b], noise[b]) = (s, sum);
            }
        }
        for (buffer, grid) in guide.buffers.iter().zip(pixel.iter_mut()) {
            let row = grid.row_mut(y);
            for (row, noise) in row.iter_mut().zip(noise.iter()) {
                let mut negative = *noise;
                for value in &mut negative {
                    *value = -*value;
                }
                *row = negative;
            }
            for (&mean, scale) in buffer.mean.iter().zip(scale.chunks_exact(n)) {
                let (u_p, u_q) = (local.row(mean, own, n), local.row(mean, other, n));
                for b in 0..n {
                    let (u_p, u_q, scale, mut sum) = (u_p[b], u_q[b], scale[b], row[b]);
                    for i in 0..LANES {
                        let difference = u_p[i] - u_q[i];
                        sum[i] += difference * difference * scale[i];
                    }
                    row[b] = sum;
                }
            }
            grid.clear_outside(y, &inner.x);
        }
    }
}

/// Leaves d² over the tile in `scratch.patch`, or the averaged weights in `scratch.averaged`.
#[inline(always)]
fn color_weights(job: &Job, tile: &Rect, offset: &Offset, scratch: &mut Scratch, buffer: usize) {
    let patch = job.window.patch;
    let Scratch { pixel, patch: distance, averaged, columns, share, .. } = scratch;
    distance.cover(&offset.wanted);
    let inner = offset.wanted.meet(&offset.valid);
    box_mean(&pixel[buffer], distance, (&offset.wanted, &inner), offset, patch, columns, share);
    if job.window.average {
        for y in inner.y.clone() {
            for block in distance.row_mut(y) {
                let mut weights = *block;
                for weight in &mut weights {
                    *weight = exp_neg(max(*weight, 0.0));
                }
                *block = weights;
            }
            distance.clear_outside(y, &inner.x);
        }
        averaged.cover(tile);
        box_mean(distance, averaged, (tile, &offset.part), offset, patch, columns, share);
    }
}

/// Mean of `from` over the patch around the pixels of the `inner` rows of an area, over as much of it as is
/// valid; `from` is zero elsewhere and reaches just a patch beyond the area.
#[inline(always)]
fn box_mean(
    from: &Grid,
    to: &mut Grid,
    (area, inner): (&Rect, &Rect),
    offset: &Offset,
    patch: usize,
    columns: &mut Vec<f32>,
    share: &mut Vec<f32>,
) {
    let reach = patch as isize;
    // At least one, also where nothing is valid and the sum is not used.
    let inside = |at: isize, range: &std::ops::Range<isize>| {
        ((at + reach + 1).min(range.end) - (at - reach).max(range.start)).max(1) as f32
    };
    let share = zeros(share, to.blocks() * LANES, 0.0);
    for (x, share) in area.x.clone().zip(share.iter_mut()) {
        *share = 1.0 / inside(x, &offset.valid.x);
    }
    let share = share.as_chunks::<LANES>().0;
    let side = 2 * patch + 1;
    let columns = zeros(columns, from.blocks() * LANES + side.next_multiple_of(LANES), 0.0);
    for y in inner.y.clone() {
        let rows = from.rows(y - reach, side);
        for (b, columns) in columns.as_chunks_mut().0.iter_mut().enumerate().take(from.blocks()) {
            let mut sum = [0.0; LANES];
            for row in rows.chunks_exact(from.blocks()) {
                let row = row[b];
                for i in 0..LANES {
                    sum[i] += row[i];
                }
            }
            *columns = sum;
        }
        let share_of_rows = 1.0 / inside(y, &offset.valid.y);
        for (b, (to, share)) in to.row_mut(y).iter_mut().zip(share).enumerate() {
            let mut sum = [0.0; LANES];
            for k in 0..side {
                let columns: &[f32] = &columns[b * LANES + k..][..LANES];
                for i in 0..LANES {
                    sum[i] += columns[i];
                }
            }
            let share = *share;
            for i in 0..LANES {
                sum[i] *= share[i] * share_of_rows;
            }
            *to = sum;
        }
    }
}

/// Adds the neighbours at an offset to the sums of a buffer.
#[inline(always)]
fn accumulate(
    job: &Job,
    sigma: f32,
    buffer: &mut Buffer,
    local: &Local,
    tile: &Rect,
    offset: &Offset,
    scratch: &mut Scratch,
) {
    let Offset { dx, dy, part, .. } = offset;
    let near = (dx * dx + dy * dy) as f32 / (2.0 * sigma * sigma);
    let Scratch { exponent, patch, averaged, row, .. } = scratch;
    let n = exponent.blocks();
    for y in part.y.clone() {
        let row = zeros(row, n, [0.0; LANES]);
        let color = if job.window.average { averaged.row(y) } else { patch.row(y) };
        for ((row, color), exponent) in row.iter_mut().zip(color).zip(exponent.row(y)) {
            let (color, exponent, mut weights) = (*color, *exponent, [0.0; LANES]);
            for i in 0..LANES {
                let exponent = max(exponent[i], near);
                weights[i] = if job.window.average {
                    min(color[i], exp_neg(exponent))
                } else {
                    exp_neg(max(color[i], exponent))
                };
            }
            *row = weights;
        }
        // Where there is no neighbour, there is no weight.
        let flat = row.as_flattened_mut();
        flat[..(part.x.start - tile.x.start) as usize].fill(0.0);
        flat[(part.x.end - tile.x.start) as usize..].fill(0.0);
        for (sum, weights) in buffer.weights.row_mut(y).iter_mut().zip(row.iter()) {
            let (mut total, weights) = (*sum, *weights);
            for i in 0..LANES {
                total[i] += weights[i];
            }
            *sum = total;
        }
        for (sum, &target) in buffer.sums.iter_mut().zip(&buffer.targets) {
            let own = local.row(target, (tile.x.start, y), n);
            let other = local.row(target, (tile.x.start + dx, y + dy), n);
            for (b, sum) in sum.row_mut(y).iter_mut().enumerate() {
                let (own, other, weights, mut total) = (own[b], other[b], row[b], *sum);
                // Differences, because where all are equal the answer is then exact.
                for i in 0..LANES {
                    total[i] += weights[i] * (other[i] - own[i]);
                }
                *sum = total;
            }
        }
    }
}
