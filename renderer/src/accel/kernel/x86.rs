//! The two innermost steps on AVX2 registers, and everything compiled for AVX2 and for AVX-512.

#![allow(unsafe_code)]

use std::arch::x86_64::*;

use super::along::{Slabs, WIDEN};
use super::node::{Child, Node, WIDTH};
use super::{Blocks, Corners, Isa, LANES, Order, ShearedRay, Tree, closest_with, occluded_with};
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
        let avx2 = is_x86_feature_detected!("avx2")
            && is_x86_feature_detected!("bmi1")
            && is_x86_feature_detected!("popcnt");
        if avx2 && is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512vl") {
            return Some(Self::Avx512);
        }
        avx2.then_some(Self::Avx2)
    }
}

/// See [`super::closest`].
pub fn closest<B: Blocks>(level: Level, order: Order, tree: &Tree<B>, rays: &[Ray], hits: &mut [Hit]) {
    // SAFETY: `level` was detected on this processor.
    match level {
        Level::Avx2 => unsafe { closest_avx2(order, tree, rays, hits) },
        Level::Avx512 => unsafe { closest_avx512(order, tree, rays, hits) },
    }
}

/// See [`super::occluded`].
pub fn occluded<B: Blocks>(level: Level, order: Order, tree: &Tree<B>, rays: &[Ray], blocked: &mut [bool]) {
    // SAFETY: `level` was detected on this processor.
    match level {
        Level::Avx2 => unsafe { occluded_avx2(order, tree, rays, blocked) },
        Level::Avx512 => unsafe { occluded_avx512(order, tree, rays, blocked) },
    }
}

#[target_feature(enable = "avx2,bmi1,popcnt")]
fn closest_avx2<B: Blocks>(order: Order, tree: &Tree<B>, rays: &[Ray], hits: &mut [Hit]) {
    closest_with(Avx2(()), order, tree, rays, hits)
}

#[target_feature(enable = "avx2,bmi1,popcnt,avx512f,avx512vl")]
fn closest_avx512<B: Blocks>(order: Order, tree: &Tree<B>, rays: &[Ray], hits: &mut [Hit]) {
    closest_with(Avx2(()), order, tree, rays, hits)
}

#[target_feature(enable = "avx2,bmi1,popcnt")]
fn occluded_avx2<B: Blocks>(order: Order, tree: &Tree<B>, rays: &[Ray], blocked: &mut [bool]) {
    occluded_with(Avx2(()), order, tree, rays, blocked)
}

#[target_feature(enable = "avx2,bmi1,popcnt,avx512f,avx512vl")]
fn occluded_avx512<B: Blocks>(order: Order, tree: &Tree<B>, rays: &[Ray], blocked: &mut [bool]) {
    occluded_with(Avx2(()), order, tree, rays, blocked)
}

/// A processor with AVX2: made in the functions above alone.
#[derive(Clone, Copy)]
struct Avx2(());

impl Isa for Avx2 {
    #[inline(always)]
    fn visit<const INSIDE: bool, const SORTED: bool>(
        self,
        node: &Node,
        slabs: &Slabs<INSIDE>,
        limit: f32,
        keys: &mut [u32; WIDTH],
        links: &mut [Child; WIDTH],
    ) -> usize {
        // SAFETY: whoever has `self` runs on a processor with these features.
        unsafe { visit::<INSIDE, SORTED>(node, slabs, limit, keys, links) }
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

/// Of eight lanes, for each mask the numbers of those that are set, packed to the front.
static PACKED: [[u8; WIDTH]; 256] = packed();

const fn packed() -> [[u8; WIDTH]; 256] {
    let mut table = [[0; WIDTH]; 256];
    let mut mask = 0;
    while mask < 256 {
        let (mut lane, mut at) = (0, 0);
        while lane < WIDTH {
            if mask >> lane & 1 != 0 {
                table[mask][at] = lane as u8;
                at += 1;
            }
            lane += 1;
        }
        mask += 1;
    }
    table
}

/// Eight bytes as lanes.
#[inline]
#[target_feature(enable = "avx2")]
fn lanes(bytes: &[u8; 8]) -> __m256i {
    _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(i64::from_le_bytes(*bytes)))
}

/// See [`super::scalar::visit`].
#[inline]
#[target_feature(enable = "avx2,bmi1,popcnt")]
fn visit<const INSIDE: bool, const SORTED: bool>(
    node: &Node,
    slabs: &Slabs<INSIDE>,
    limit: f32,
    keys: &mut [u32; WIDTH],
    links: &mut [Child; WIDTH],
) -> usize {
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
    let first = _mm_mul_ps(_mm_sub_ps(origin, o), inverse);
    let first_far = if INSIDE { _mm_mul_ps(_mm_sub_ps(origin, o_far), inverse) } else { first };
    let (mut enter, mut leave) = (_mm256_setzero_ps(), _mm256_set1_ps(f32::MAX));
    macro_rules! axis {
        ($axis:literal) => {
            let all = |v: __m128| _mm256_broadcastss_ps(_mm_permute_ps::<{ $axis * 0x55 }>(v));
            let near = _mm256_cvtepi32_ps(lanes(&node.planes[slabs.near[$axis]]));
            let far = _mm256_cvtepi32_ps(lanes(&node.planes[slabs.far[$axis]]));
            let step = all(step);
            let first = all(first);
            let first_far = if INSIDE { all(first_far) } else { first };
            // Where the first is NaN, the second is taken.
            enter = _mm256_max_ps(_mm256_add_ps(_mm256_mul_ps(near, step), first), enter);
            leave = _mm256_min_ps(_mm256_add_ps(_mm256_mul_ps(far, step), first_far), leave);
        };
    }
    axis!(0);
    axis!(1);
    axis!(2);
    let leave = _mm256_min_ps(_mm256_mul_ps(leave, _mm256_set1_ps(WIDEN)), _mm256_set1_ps(limit));
    let met = _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(enter, leave)) as u32 & node.present;
    let count = met.count_ones() as usize;
    let packed = lanes(&PACKED[met as usize & 255]);
    // SAFETY: `Child` is a `u32`.
    let child = unsafe { _mm256_loadu_si256(node.child.as_ptr().cast()) };
    if !SORTED {
        // SAFETY: eight lanes into an array of eight.
        unsafe { _mm256_storeu_si256(links.as_mut_ptr().cast(), _mm256_permutevar8x32_epi32(child, packed)) };
        return count;
    }
    let lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    let key = _mm256_or_si256(_mm256_andnot_si256(_mm256_set1_epi32(7), _mm256_castps_si256(enter)), lane);
    let key = _mm256_permutevar8x32_epi32(key, packed);
    // Lanes beyond the count become −1, less than any key.
    let beyond = _mm256_cmpgt_epi32(_mm256_set1_epi32(count as i32), lane);
    let key = _mm256_or_si256(key, _mm256_xor_si256(beyond, _mm256_set1_epi32(-1)));
    let key = if count <= 4 { sort4(_mm256_castsi256_si128(key)) } else { sort8(key) };
    // SAFETY: as above.
    unsafe {
        _mm256_storeu_si256(keys.as_mut_ptr().cast(), key);
        _mm256_storeu_si256(links.as_mut_ptr().cast(), _mm256_permutevar8x32_epi32(child, key));
    }
    count
}

/// Sorts downwards by a network of five comparisons; the upper four lanes are arbitrary.
#[inline]
#[target_feature(enable = "avx2")]
fn sort4(k: __m128i) -> __m256i {
    macro_rules! step {
        ($k:expr, $partner:literal, $less:literal) => {{
            let k = $k;
            let partner = _mm_shuffle_epi32::<$partner>(k);
            _mm_blend_epi32::<$less>(_mm_max_epi32(k, partner), _mm_min_epi32(k, partner))
        }};
    }
    let k = step!(k, 0b10_11_00_01, 0b1010);
    let k = step!(k, 0b01_00_11_10, 0b1100);
    _mm256_castsi128_si256(step!(k, 0b11_01_10_00, 0b0100))
}

/// Sorts downwards by Batcher's odd-even merge network.
#[inline(never)]
#[target_feature(enable = "avx2")]
fn sort8(k: __m256i) -> __m256i {
    macro_rules! step {
        ($k:expr, $partner:expr, $less:literal) => {{
            let k = $k;
            let [a, b, c, d, e, f, g, h] = $partner;
            let partner = _mm256_permutevar8x32_epi32(k, _mm256_setr_epi32(a, b, c, d, e, f, g, h));
            _mm256_blend_epi32::<$less>(_mm256_max_epi32(k, partner), _mm256_min_epi32(k, partner))
        }};
    }
    let k = step!(k, [1, 0, 3, 2, 5, 4, 7, 6], 0b1010_1010);
    let k = step!(k, [2, 3, 0, 1, 6, 7, 4, 5], 0b1100_1100);
    let k = step!(k, [0, 2, 1, 3, 4, 6, 5, 7], 0b0100_0100);
    let k = step!(k, [4, 5, 6, 7, 0, 1, 2, 3], 0b1111_0000);
    let k = step!(k, [0, 1, 4, 5, 2, 3, 6, 7], 0b0011_0000);
    step!(k, [0, 2, 1, 4, 3, 6, 5, 7], 0b0101_0100)
}

/// See [`super::scalar::inside`].
#[inline]
#[target_feature(enable = "avx2,bmi1,popcnt")]
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
