//! The two innermost steps, for any processor: reference and specification.

use super::along::{Slabs, WIDEN};
use super::node::{Child, Node, WIDTH};
use super::{CORNERS, Corners, Isa, LANES, Met, ShearedRay};

/// Whatever the processor has.
#[derive(Clone, Copy)]
pub struct Scalar;

impl Isa for Scalar {
    #[inline(always)]
    fn visit<const INSIDE: bool>(
        self,
        node: &Node,
        slabs: &Slabs<INSIDE>,
        limit: f32,
        enters: &mut [f32; WIDTH],
        links: &mut [Child; WIDTH],
    ) -> Met {
        visit(node, slabs, limit, enters, links)
    }

    #[inline(always)]
    fn inside(self, corners: &Corners, sheared: &ShearedRay, edges: &mut [[f64; LANES]; 3]) -> u32 {
        inside(corners, sheared, edges)
    }

    #[inline(always)]
    fn prefetch<T>(self, _: *const T) {}
}

/// Slab test of eight boxes (Kay and Kajiya 1986). The plane number q of an axis is met at
///
/// ```text
/// t = q · (step / d) + (origin − o) / d
/// ```
///
/// The nearest child is the one whose box is entered first, by the upper 16 bits of the distance; of equals the one in the
/// lower lane. The others come, the nearest last, in the order of their lanes' numbers, of which those bits are
/// flipped whose axes the ray goes down ([`Node::new`] puts children into lanes accordingly).
#[inline(always)]
pub fn visit<const INSIDE: bool>(
    node: &Node,
    slabs: &Slabs<INSIDE>,
    limit: f32,
    enters: &mut [f32; WIDTH],
    links: &mut [Child; WIDTH],
) -> Met {
    let (mut enter, mut leave) = ([0.0f32; WIDTH], [f32::MAX; WIDTH]);
    for axis in 0..3 {
        let (near, far) = (&node.planes[slabs.near[axis]], &node.planes[slabs.far[axis]]);
        let step = node.step[axis] * slabs.inverse[axis];
        let first = finite((node.origin[axis] - slabs.o[axis]) * slabs.inverse[axis]);
        let first_far = if INSIDE {
            finite((node.origin[axis] - slabs.o_far[axis]) * slabs.inverse[axis])
        } else {
            first
        };
        for i in 0..WIDTH {
            // Written so that a NaN (of infinite products) changes nothing.
            let t0 = f32::from(near[i]).mul_add(step, first);
            let t1 = f32::from(far[i]).mul_add(step, first_far);
            enter[i] = if t0 > enter[i] { t0 } else { enter[i] };
            leave[i] = if t1 < leave[i] { t1 } else { leave[i] };
        }
    }
    let mut met = 0;
    for lane in 0..WIDTH {
        let leave = leave[lane] * WIDEN;
        let leave = if leave < limit { leave } else { limit };
        met |= u32::from(enter[lane] <= leave && node.absent[lane] == 0) << lane;
    }
    let (any, mut others) = (met != 0, 0);
    let nearest = (0..WIDTH)
        .filter(|&lane| met >> lane & 1 != 0)
        .min_by_key(|&lane| enter[lane].to_bits() >> 16)
        .unwrap_or(0);
    for lane in (0..WIDTH).rev().map(|rank| rank ^ slabs.octant) {
        if met >> lane & 1 != 0 && lane != nearest {
            (enters[others], links[others]) = (enter[lane], node.child[lane]);
            others += 1;
        }
    }
    Met { any, nearest: node.child[nearest], others }
}

/// NaN for infinities: a grid that begins infinitely far away, as counted along a nearly parallel axis, says nothing.
#[inline(always)]
fn finite(x: f32) -> f32 {
    if x.is_finite() { x } else { f32::NAN }
}

/// Edge functions of four triangles in the ray's own space (Woop, Benthin and Wald 2013), and a bit mask of those
/// whose edge functions do not have both signs. Each corner is moved and sheared in `f32`, once for all triangles that share
/// it; the products of two `f32` numbers are exact in `f64`, and so are the signs of their differences.
#[inline(always)]
pub fn inside(corners: &Corners, sheared: &ShearedRay, edges: &mut [[f64; LANES]; 3]) -> u32 {
    let [kx, ky, kz] = sheared.k;
    let (mut x, mut y) = ([0.0f32; CORNERS], [0.0f32; CORNERS]);
    for i in 0..CORNERS {
        let z = corners.v[kz][i] - sheared.o[2];
        x[i] = (corners.v[kx][i] - sheared.o[0]) - sheared.s[0] * z;
        y[i] = (corners.v[ky][i] - sheared.o[1]) - sheared.s[1] * z;
    }
    let mut mask = 0;
    for i in 0..LANES {
        let vertex = |number: usize| {
            let at = usize::from(corners.index[number][i]) % CORNERS;
            (f64::from(x[at]), f64::from(y[at]))
        };
        let ((ax, ay), (bx, by), (cx, cy)) = (vertex(0), vertex(1), vertex(2));
        let (u, v, w) = (cx * by - cy * bx, ax * cy - ay * cx, bx * ay - by * ax);
        let outside = (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0);
        mask |= u32::from(!outside) << i;
        for (out, edge) in edges.iter_mut().zip([u, v, w]) {
            out[i] = edge;
        }
    }
    mask
}
