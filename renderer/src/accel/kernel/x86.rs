//! The two innermost steps on AVX2 registers, and everything compiled for AVX2 and for AVX-512.

#![allow(unsafe_code)]

use std::arch::x86_64::*;

use super::along::{Slabs, WIDEN};
use super::node::{Child, Node, WIDTH};
use super::{Blocks, Corners, Isa, LANES, Met, Query, ShearedRay, Tree, along, batch};
use crate::accel::Ray;
use crate::accel::triangle::TriangleBlock;

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
        let avx2 = is_x86_feature_detected!("avx2")
            && is_x86_feature_detected!("fma")
            && is_x86_feature_detected!("bmi1")
            && is_x86_feature_detected!("popcnt");
        if avx2 && is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512vl") {
            return Some(Self::Avx512);
        }
        avx2.then_some(Self::Avx2)
    }

    /// All that this processor has.
    #[cfg(test)]
    pub fn all_detected() -> Vec<Self> {
        match Self::detected() {
            Some(Self::Avx512) => vec![Self::Avx2, Self::Avx512],
            other => other.into_iter().collect(),
        }
    }
}

/// See [`super::one_by_one`].
pub fn one_by_one<B: Blocks>(level: Level, tree: &Tree<B>, rays: &[Ray], query: Query) {
    #[target_feature(enable = "avx2,fma,bmi1,popcnt")]
    fn avx2<B: Blocks>(tree: &Tree<B>, rays: &[Ray], query: Query) {
        along::trace(Avx2(()), tree, rays, query)
    }
    #[target_feature(enable = "avx2,fma,bmi1,popcnt,avx512f,avx512vl")]
    fn avx512<B: Blocks>(tree: &Tree<B>, rays: &[Ray], query: Query) {
        along::trace(Avx2(()), tree, rays, query)
    }
    // SAFETY: `level` was detected on this processor.
    match level {
        Level::Avx2 => unsafe { avx2(tree, rays, query) },
        Level::Avx512 => unsafe { avx512(tree, rays, query) },
    }
}

/// See [`super::interleaved`].
pub fn interleaved(level: Level, tree: &Tree<TriangleBlock>, rays: &[Ray], query: Query) {
    #[target_feature(enable = "avx2,fma,bmi1,popcnt")]
    fn avx2(tree: &Tree<TriangleBlock>, rays: &[Ray], query: Query) {
        batch::trace(Avx2(()), tree, rays, query)
    }
    #[target_feature(enable = "avx2,fma,bmi1,popcnt,avx512f,avx512vl")]
    fn avx512(tree: &Tree<TriangleBlock>, rays: &[Ray], query: Query) {
        batch::trace(Avx2(()), tree, rays, query)
    }
    // SAFETY: `level` was detected on this processor.
    match level {
        Level::Avx2 => unsafe { avx2(tree, rays, query) },
        Level::Avx512 => unsafe { avx512(tree, rays, query) },
    }
}

/// A processor with AVX2: made in the functions above alone.
#[derive(Clone, Copy)]
struct Avx2(());

impl Isa for Avx2 {
    #[inline(always)]
    fn visit<const INSIDE: bool>(
        self,
        node: &Node,
        slabs: &Slabs<INSIDE>,
        limit: f32,
        enters: &mut [f32; WIDTH],
        links: &mut [Child; WIDTH],
    ) -> Met {
        // SAFETY: whoever has `self` runs on a processor with these features.
        unsafe { visit(node, slabs, limit, enters, links) }
    }

    #[inline(always)]
    fn inside(self, corners: &Corners, sheared: &ShearedRay, edges: &mut [[f64; LANES]; 3]) -> u32 {
        // SAFETY: as above.
        unsafe { inside(corners, sheared, edges) }
    }

    #[inline(always)]
    fn prefetch<T>(self, data: *const T) {
        // SAFETY: a prefetch reads nothing that can be noticed, from whatever address.
        unsafe {
            _mm_prefetch::<_MM_HINT_T0>(data.cast());
            _mm_prefetch::<_MM_HINT_T0>(data.cast::<i8>().wrapping_add(64));
        }
    }
}

/// For each octant and each mask of eight lanes the numbers of those that are set, packed, the first in order last.
static PACKED: [[[u8; WIDTH]; 256]; 8] = packed();

const fn packed() -> [[[u8; WIDTH]; 256]; 8] {
    let mut table = [[[0; WIDTH]; 256]; 8];
    let mut entry = 0;
    while entry < 8 * 256 {
        let (octant, mask) = (entry / 256, entry % 256);
        let (mut rank, mut at) = (WIDTH, 0);
        while rank > 0 {
            rank -= 1;
            let lane = rank ^ octant;
            if mask >> lane & 1 != 0 {
                table[octant][mask][at] = lane as u8;
                at += 1;
            }
        }
        entry += 1;
    }
    table
}

/// Eight bytes as lanes.
#[inline]
#[target_feature(enable = "avx2")]
fn lanes(bytes: &[u8; 8]) -> __m256i {
    // SAFETY: eight bytes are read.
    _mm256_cvtepu8_epi32(unsafe { _mm_loadl_epi64(bytes.as_ptr().cast()) })
}

/// See [`super::scalar::visit`].
#[inline]
#[target_feature(enable = "avx2,fma,bmi1,popcnt")]
fn visit<const INSIDE: bool>(
    node: &Node,
    slabs: &Slabs<INSIDE>,
    limit: f32,
    enters: &mut [f32; WIDTH],
    links: &mut [Child; WIDTH],
) -> Met {
    // SAFETY: each load is from an array of its size.
    let (origin, step, o, o_far, inverse) = unsafe {
        (
            _mm_load_ps(node.origin.as_ptr()),
            _mm_load_ps(node.step.as_ptr()),
            _mm_loadu_ps(slabs.o.as_ptr()),
            _mm_loadu_ps(slabs.o_far.as_ptr()),
            _mm_loadu_ps(slabs.inverse.as_ptr()),
        )
    };
    let step = _mm_mul_ps(step, inverse);
    let finite = |v| _mm_add_ps(v, _mm_sub_ps(v, v));
    let first = finite(_mm_mul_ps(_mm_sub_ps(origin, o), inverse));
    let first_far = if INSIDE { finite(_mm_mul_ps(_mm_sub_ps(origin, o_far), inverse)) } else { first };
    let (mut enter, mut leave) = (_mm256_setzero_ps(), _mm256_set1_ps(f32::MAX));
    macro_rules! axis {
        ($axis:literal) => {
            let all = |v: __m128| _mm256_broadcastss_ps(_mm_permute_ps::<{ $axis * 0x55 }>(v));
            // SAFETY: there are planes of these numbers, since `Slabs::padded` alone sets them.
            let (near, far) = unsafe {
                (node.planes.get_unchecked(slabs.near[$axis]), node.planes.get_unchecked(slabs.far[$axis]))
            };
            let (near, far) = (_mm256_cvtepi32_ps(lanes(near)), _mm256_cvtepi32_ps(lanes(far)));
            let step = all(step);
            let first = all(first);
            let first_far = if INSIDE { all(first_far) } else { first };
            // Where the first is NaN, the second is taken.
            enter = _mm256_max_ps(_mm256_fmadd_ps(near, step, first), enter);
            leave = _mm256_min_ps(_mm256_fmadd_ps(far, step, first_far), leave);
        };
    }
    axis!(0);
    axis!(1);
    axis!(2);
    let leave = _mm256_min_ps(_mm256_mul_ps(leave, _mm256_set1_ps(WIDEN)), _mm256_set1_ps(limit));
    // All ones where a child is missed or absent.
    let absent = _mm256_cvtepi8_epi32(_mm_cvtsi64_si128(i64::from_le_bytes(node.absent)));
    let missed = _mm256_or_ps(_mm256_cmp_ps::<_CMP_NLE_UQ>(enter, leave), _mm256_castsi256_ps(absent));
    let met = !_mm256_movemask_ps(missed) as u32 & 0xff;
    // The nearest is not fetched from the stack once it is there: that way is longer.
    let near = _mm256_srli_epi32::<16>(_mm256_castps_si256(_mm256_or_ps(enter, missed)));
    let near = _mm_packus_epi32(_mm256_castsi256_si128(near), _mm256_extracti128_si256::<1>(near));
    let nearest = _mm_cvtsi128_si32(_mm_minpos_epu16(near)) as usize >> 16 & 7;
    let others = met & !(1 << nearest);
    let packed = lanes(&PACKED[slabs.octant % 8][others as usize % 256]);
    // SAFETY: loads and stores of eight lanes, of arrays of eight; a `Child` is a `u32`.
    unsafe {
        _mm256_storeu_ps(enters.as_mut_ptr(), _mm256_permutevar8x32_ps(enter, packed));
        let child = _mm256_loadu_si256(node.child.as_ptr().cast());
        _mm256_storeu_si256(links.as_mut_ptr().cast(), _mm256_permutevar8x32_epi32(child, packed));
    }
    Met { any: met != 0, nearest: node.child[nearest], others: others.count_ones() as usize }
}

/// See [`super::scalar::inside`].
#[inline]
#[target_feature(enable = "avx2,fma,bmi1,popcnt")]
fn inside(corners: &Corners, sheared: &ShearedRay, edges: &mut [[f64; LANES]; 3]) -> u32 {
    let [kx, ky, kz] = sheared.k;
    // SAFETY: each load is from an array of its size.
    let load = |axis: usize| unsafe { _mm256_loadu_ps(corners.v[axis].as_ptr()) };
    let all = |x: f32| _mm256_set1_ps(x);
    let z = _mm256_sub_ps(load(kz), all(sheared.o[2]));
    let shear = |axis: usize, o: f32, s: f32| {
        _mm256_sub_ps(_mm256_sub_ps(load(axis), all(o)), _mm256_mul_ps(all(s), z))
    };
    let x = shear(kx, sheared.o[0], sheared.s[0]);
    let y = shear(ky, sheared.o[1], sheared.s[1]);
    let [ia, ib, ic] = corners.index;
    let (ia, ib) = (u32::from_le_bytes(ia), u32::from_le_bytes(ib));
    let ab = lanes(&(u64::from(ia) | u64::from(ib) << 32).to_le_bytes());
    let c = lanes(&u64::from(u32::from_le_bytes(ic)).to_le_bytes());
    let (xab, yab) = (_mm256_permutevar8x32_ps(x, ab), _mm256_permutevar8x32_ps(y, ab));
    let (xc, yc) = (_mm256_permutevar8x32_ps(x, c), _mm256_permutevar8x32_ps(y, c));
    let low = |v: __m256| _mm256_cvtps_pd(_mm256_castps256_ps128(v));
    let high = |v: __m256| _mm256_cvtps_pd(_mm256_extractf128_ps::<1>(v));
    let (ax, ay, bx, by, cx, cy) = (low(xab), low(yab), high(xab), high(yab), low(xc), low(yc));
    let cross = |ax, ay, bx, by| _mm256_sub_pd(_mm256_mul_pd(ax, by), _mm256_mul_pd(ay, bx));
    let (u, v, w) = (cross(cx, cy, bx, by), cross(ax, ay, cx, cy), cross(bx, by, ax, ay));
    for (out, edge) in edges.iter_mut().zip([u, v, w]) {
        // SAFETY: four lanes into an array of four.
        unsafe { _mm256_storeu_pd(out.as_mut_ptr(), edge) };
    }
    let zero = _mm256_setzero_pd();
    // A NaN makes the determinant one, which is a miss: whether the mask has the lane does not matter.
    let negative = _mm256_cmp_pd::<_CMP_LT_OQ>(_mm256_min_pd(_mm256_min_pd(u, v), w), zero);
    let positive = _mm256_cmp_pd::<_CMP_GT_OQ>(_mm256_max_pd(_mm256_max_pd(u, v), w), zero);
    !_mm256_movemask_pd(_mm256_and_pd(negative, positive)) as u32 & 0b1111
}
