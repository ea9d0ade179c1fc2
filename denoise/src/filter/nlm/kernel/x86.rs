//! The scalar source compiled for AVX2 and AVX-512.

#![allow(unsafe_code)]

use super::{Job, scalar};
use crate::filter::nlm::tile::Rect;
use crate::plane::Plane;

/// What the processor has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    Avx512,
    Avx2,
}

impl Level {
    /// The best first.
    pub const ALL: [Level; 2] = [Level::Avx512, Level::Avx2];

    /// Whether this processor has it (the standard library remembers the answer).
    pub fn is_here(self) -> bool {
        match self {
            Level::Avx2 => is_x86_feature_detected!("avx2"),
            Level::Avx512 => is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512vl"),
        }
    }

    /// The best of this processor.
    pub fn detected() -> Option<Self> {
        Self::ALL.into_iter().find(|level| level.is_here())
    }
}

/// See [`super::filter_tile`].
pub fn filter_tile(level: Level, job: &Job, tile: &Rect) -> Vec<Vec<Plane>> {
    assert!(level.is_here(), "{level:?} is not on this processor");
    // SAFETY: it is.
    match level {
        Level::Avx2 => unsafe { filter_tile_avx2(job, tile) },
        Level::Avx512 => unsafe { filter_tile_avx512(job, tile) },
    }
}

#[target_feature(enable = "avx2")]
fn filter_tile_avx2(job: &Job, tile: &Rect) -> Vec<Vec<Plane>> {
    scalar::filter_tile(job, tile)
}

#[target_feature(enable = "avx2,avx512f,avx512vl")]
fn filter_tile_avx512(job: &Job, tile: &Rect) -> Vec<Vec<Plane>> {
    scalar::filter_tile(job, tile)
}
