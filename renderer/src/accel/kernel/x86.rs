//! The scalar source compiled for AVX2 and AVX-512.

#![allow(unsafe_code)]

use super::{Blocks, Tree, scalar};
use crate::accel::{Hit, Ray};

/// What the processor has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    Avx2,
    Avx512,
}

impl Level {
    /// The best of this processor (the standard library remembers the answer).
    #[inline]
    pub fn detected() -> Option<Self> {
        let avx2 = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("bmi1");
        if avx2 && is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512vl") {
            return Some(Self::Avx512);
        }
        avx2.then_some(Self::Avx2)
    }
}

/// See [`super::closest`].
pub fn closest<B: Blocks>(level: Level, tree: &Tree<B>, rays: &[Ray], hits: &mut [Hit]) {
    // SAFETY: `level` was detected on this processor.
    match level {
        Level::Avx2 => unsafe { closest_avx2(tree, rays, hits) },
        Level::Avx512 => unsafe { closest_avx512(tree, rays, hits) },
    }
}

/// See [`super::occluded`].
pub fn occluded<B: Blocks>(level: Level, tree: &Tree<B>, rays: &[Ray], blocked: &mut [bool]) {
    // SAFETY: `level` was detected on this processor.
    match level {
        Level::Avx2 => unsafe { occluded_avx2(tree, rays, blocked) },
        Level::Avx512 => unsafe { occluded_avx512(tree, rays, blocked) },
    }
}

#[target_feature(enable = "avx2,bmi1")]
fn closest_avx2<B: Blocks>(tree: &Tree<B>, rays: &[Ray], hits: &mut [Hit]) {
    scalar::closest(tree, rays, hits)
}

#[target_feature(enable = "avx2,bmi1,avx512f,avx512vl")]
fn closest_avx512<B: Blocks>(tree: &Tree<B>, rays: &[Ray], hits: &mut [Hit]) {
    scalar::closest(tree, rays, hits)
}

#[target_feature(enable = "avx2,bmi1")]
fn occluded_avx2<B: Blocks>(tree: &Tree<B>, rays: &[Ray], blocked: &mut [bool]) {
    scalar::occluded(tree, rays, blocked)
}

#[target_feature(enable = "avx2,bmi1,avx512f,avx512vl")]
fn occluded_avx512<B: Blocks>(tree: &Tree<B>, rays: &[Ray], blocked: &mut [bool]) {
    scalar::occluded(tree, rays, blocked)
}
