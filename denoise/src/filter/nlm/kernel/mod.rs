//! One tile of nonlocal means: the loop over the offsets of the window, and what it does for each.
//!
//! There is one source, [`scalar`], written in loops over slices of equal length that the compiler vectorises;
//! the others compile it again with wider instructions enabled, and the best that the processor has is chosen
//! at run time. Rust never fuses a multiplication with an addition by itself, so that all of them give the
//! same bits.

mod scalar;
#[cfg(target_arch = "x86_64")]
mod x86;

use super::tile::Rect;
use super::{Feature, Guide, Window};
use crate::plane::{Plane, Size};

/// What a tile is filtered with; the same for all tiles.
#[derive(Clone, Copy)]
pub(super) struct Job<'a> {
    pub size: Size,
    pub window: &'a Window,
    pub guides: &'a [Guide<'a>],
    pub features: &'a [Feature],
}

/// The filtered targets of each buffer of each guide, as planes of this tile.
pub(super) fn filter_tile(job: &Job, tile: &Rect) -> Vec<Vec<Plane>> {
    #[cfg(target_arch = "x86_64")]
    if let Some(level) = x86::Level::detected() {
        return x86::filter_tile(level, job, tile);
    }
    scalar::filter_tile(job, tile)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::filter::nlm::Buffer;

    #[cfg(target_arch = "x86_64")]
    #[test]
    fn every_instruction_set_gives_the_same_bits() {
        let size = Size { width: 50, height: 33 };
        let plane =
            |seed: usize| -> Plane { (0..size.len()).map(|p| ((p * seed) % 997) as f32 / 997.0).collect() };
        let (mean, variance) = ([plane(13), plane(29), plane(31)], [plane(7), plane(11), plane(17)]);
        let guides = [Guide {
            k: 0.5,
            sigma_spatial: 3.0,
            variance: &variance,
            buffers: vec![Buffer { mean: &mean, targets: &mean }],
        }];
        let feature = |seed| Feature {
            mean: vec![plane(seed)],
            variance: vec![vec![0.01; size.len()]],
            denominator: vec![vec![0.3; size.len()]],
        };
        let features = [feature(41), feature(43)];
        for average in [false, true] {
            let window = Window { radius: 6, patch: 3, average };
            let job = Job { size, window: &window, guides: &guides, features: &features };
            let tile = Rect { x: 3..50, y: 0..33 };
            let expected = scalar::filter_tile(&job, &tile);
            for level in x86::Level::ALL.into_iter().filter(|level| level.is_here()) {
                assert_eq!(x86::filter_tile(level, &job, &tile), expected, "{level:?}");
            }
        }
    }
}
