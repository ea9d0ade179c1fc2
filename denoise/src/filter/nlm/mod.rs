//! Nonlocal means with a joint feature distance: the loop that all filters of this kind share.
//!
//! For every pixel p and neighbour q = p + δ in the search window, with `u` a guide's mean, `V` its
//! variance, `c` running over channels and `n` over the offsets inside a patch (Rousselle et al. 2012,
//! section 4, and 2013, section 4, each in the form of the authors' code):
//!
//! ```text
//! Δ²(p, q) = mean over c of [ (u_p − u_q)² − (V_p + min(V_p, V_q)) ] / [ k² (V_p + V_q) ]
//! d²(p, q) = mean over n of Δ²(p + n, q + n)
//! Φ²(p, q) = the same per pixel for a feature, with k_f² (D_p + D_q) below, D = max(V, ‖∇f‖², τ)
//! w(p, q)  = exp(−max(0, d², Φ² of each feature, ‖δ‖² / 2σ²)),   w(p, p) = 1
//! F(p)     = Σ_q w(p, q) t(q) / Σ_q w(p, q)
//! ```
//!
//! The *targets* t that a guide's weights filter are other planes than the guide where it can be, so that
//! weights and noise are independent. A pixel without noise (V = 0 in all channels) stays as it is. Neighbours
//! outside the image are skipped, and of a patch only what is inside at both ends counts. With `average` the
//! weight `exp(−max(0, d²))` is averaged over the patch once more (every patch that covers a pixel votes on
//! it) before the minimum with the other factors.
//!
//! The work goes offset by offset over tiles: patch sums are separable box sums, so their cost grows
//! with a patch's side and not its area, and what a tile needs stays in a core's own cache. Sums are taken
//! afresh at each pixel, which costs less than it saves: a running sum would make a pixel depend on where
//! its tile begins.

mod kernel;
mod tile;

#[cfg(test)]
mod tests;

use rayon::prelude::*;

use crate::plane::{Plane, Size};
use kernel::Job;
use tile::Rect;

/// How far the window and the patch reach.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Window {
    /// Of the search window, in pixels: it has a side of `2 radius + 1`.
    pub radius: usize,
    /// Of the patch, in pixels.
    pub patch: usize,
    /// Whether weights are averaged over the patch.
    pub average: bool,
}

/// Where colour weights come from: one picture, or two halves of its samples, which have the same variance.
pub(crate) struct Guide<'a> {
    /// k: how many standard deviations of the difference count as equal.
    pub k: f32,
    /// σ of a Gaussian over the distance ‖δ‖, in pixels.
    pub sigma_spatial: f32,
    /// V: of each buffer's mean, plane by plane.
    pub variance: &'a [Plane],
    pub buffers: Vec<Buffer<'a>>,
}

/// One of a guide's buffers, and what its weights filter.
pub(crate) struct Buffer<'a> {
    /// u: any number of planes.
    pub mean: &'a [Plane],
    /// t: planes that are filtered with these weights.
    pub targets: &'a [Plane],
}

/// A feature: planes that say which pixels belong together.
pub(crate) struct Feature {
    pub mean: Vec<Plane>,
    pub variance: Vec<Plane>,
    /// k_f² D, plane by plane.
    pub denominator: Vec<Plane>,
}

/// Filters the targets of each buffer of each guide; the answer has their order. The features' distance is
/// shared by all.
///
/// All planes have `size` and are finite.
pub(crate) fn filter(size: Size, window: &Window, guides: &[Guide], features: &[Feature]) -> Vec<Vec<Plane>> {
    let tiles = Rect::tiles(size);
    let job = Job { size, window, guides, features };
    let filtered: Vec<Vec<Vec<Plane>>> =
        tiles.par_iter().map(|tile| kernel::filter_tile(&job, tile)).collect();
    let buffers = guides.iter().flat_map(|guide| &guide.buffers);
    let mut out: Vec<Vec<Plane>> =
        buffers.map(|buffer| vec![vec![0.0; size.len()]; buffer.targets.len()]).collect();
    for (tile, parts) in tiles.iter().zip(&filtered) {
        for (out, part) in out.iter_mut().flatten().zip(parts.iter().flatten()) {
            tile.place(size, part, out);
        }
    }
    out
}
