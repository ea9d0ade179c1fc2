//! One ray's way through a tree.

#![allow(unsafe_code)]

use std::hint::select_unpredictable;

use super::node::{Child, Node, WIDTH};
use super::{Blocks, Isa, Query, ShearedRay, Tree};
use crate::accel::{Hit, Ray};

/// Slab distances carry a few roundings each; widening the far side keeps the box test conservative (Ize 2013).
pub const WIDEN: f32 = 1.0 + 8.0 * f32::EPSILON;

/// Largest inverse of a direction's component: what is multiplied by it stays finite in most scenes, and where it does not, the
/// boxes are not tested along that axis. A ray moves less than 2⁻⁶⁰ of its way along an axis for which this is not
/// the inverse: far less than the boxes' margin, unless the way is 2⁴² times as long as the box.
const LARGEST_INVERSE: f32 = (1u64 << 60) as f32;

/// What the box tests of one ray need. `INSIDE` an instance the ray was rounded: boxes are padded by how far it may be
/// from the true one, and its distances are counted from elsewhere, in another unit.
#[derive(Clone, Copy)]
pub struct Slabs<const INSIDE: bool> {
    /// The ray's origin; the fourth is 0, here and below.
    pub o: [f32; 4],
    /// The origin against which the far planes are tested, where boxes are padded.
    pub o_far: [f32; 4],
    /// Of the direction's components.
    pub inverse: [f32; 4],
    /// The plane of each axis through which the ray enters a box; it leaves through the other.
    pub near: [usize; 3],
    /// The other.
    pub far: [usize; 3],
    /// A bit for each axis along which the ray goes down.
    pub octant: usize,
    distances: [f64; 2],
}

impl Slabs<false> {
    /// Of a ray as it is.
    #[inline(always)]
    pub fn new(ray: &Ray) -> Self {
        Self::padded(ray, [0.0; 3], [0.0, 1.0])
    }
}

impl<const INSIDE: bool> Slabs<INSIDE> {
    /// With boxes larger by `pad` along each axis; `distances` as in [`ShearedRay`].
    #[inline(always)]
    pub fn padded(ray: &Ray, pad: [f32; 3], distances: [f64; 2]) -> Self {
        let (o, d) = (ray.o.to_array(), ray.d.to_array());
        let towards = |a: usize, by: f32| if d[a] < 0.0 { o[a] - by } else { o[a] + by };
        let with_zero = |[x, y, z]: [f32; 3]| [x, y, z, 0.0];
        Self {
            o: with_zero(std::array::from_fn(|a| if INSIDE { towards(a, pad[a]) } else { o[a] })),
            o_far: with_zero(std::array::from_fn(|a| if INSIDE { towards(a, -pad[a]) } else { o[a] })),
            inverse: with_zero(d.map(|d| (1.0 / (d + 0.0)).clamp(-LARGEST_INVERSE, LARGEST_INVERSE))), // −0 as 0,
            near: std::array::from_fn(|a| if d[a] < 0.0 { a + 3 } else { a }),
            far: std::array::from_fn(|a| if d[a] < 0.0 { a } else { a + 3 }),
            octant: (0..3).map(|a| usize::from(d[a] < 0.0) << a).sum(),
            distances,
        }
    }

    /// Boxes that are entered farther away than this cannot hold a hit before the distance `t`. Finite.
    #[inline(always)]
    pub fn limit(&self, t: f32) -> f32 {
        let limit = if INSIDE {
            // The distance was rounded to f32 where it is large; what is left of it here may be small.
            let [start, unit] = self.distances;
            ((f64::from(t) * f64::from(WIDEN) - start) / unit * f64::from(WIDEN)) as f32
        } else {
            t * WIDEN
        };
        limit.min(f32::MAX)
    }
}

/// Nodes and leaves to visit, with the distances at which their boxes are entered.
pub struct Stack {
    enters: Vec<f32>,
    links: Vec<Child>,
    /// How many there may be; the vectors are longer by `WIDTH`.
    entries: usize,
}

impl Stack {
    /// With room for `entries`, and for the unused lanes of the last write. All are [`Child::NONE`].
    pub fn new(entries: usize) -> Self {
        Self { enters: vec![0.0; entries + WIDTH], links: vec![Child::NONE; entries + WIDTH], entries }
    }

    /// Visits a node: of the children that the ray meets the nearest is returned, and the others are put on top; where there
    /// is none, the topmost entry is taken off and returned. The stack is not empty.
    #[inline(always)]
    pub fn visit<I: Isa, const INSIDE: bool>(
        &mut self,
        isa: I,
        node: &Node,
        slabs: &Slabs<INSIDE>,
        limit: f32,
        top: &mut usize,
    ) -> Child {
        let at = top.wrapping_sub(1);
        assert!(at < self.entries, "a stack has room for what its tree needs");
        // SAFETY: `at` is within both, and there are `WIDTH` more above.
        let (last, enters, links) = unsafe {
            let enters = &mut *self.enters.as_mut_ptr().add(at + 1).cast::<[f32; WIDTH]>();
            let links = self.links.as_mut_ptr().add(at);
            (*links, enters, &mut *links.add(1).cast::<[Child; WIDTH]>())
        };
        let met = isa.visit(node, slabs, limit, enters, links);
        *top = *top + met.others - usize::from(!met.any);
        select_unpredictable(met.any, met.nearest, last)
    }

    /// Takes the topmost entry off.
    #[inline(always)]
    pub fn pop(&mut self, top: &mut usize) -> Child {
        *top -= 1;
        self.links[*top]
    }

    /// Removes what is entered beyond `limit` from the entries `base..top`.
    #[inline(always)]
    pub fn drop_beyond(&mut self, limit: f32, base: usize, top: &mut usize) {
        let (enters, links) = (&mut self.enters[base..*top], &mut self.links[base..*top]);
        let mut kept = 0;
        for i in 0..enters.len() {
            let (enter, link) = (enters[i], links[i]);
            (enters[kept], links[kept]) = (enter, link);
            kept += usize::from(enter <= limit);
        }
        *top = base + kept;
    }
}

/// The rays one by one.
#[inline(always)]
pub fn trace<I: Isa, B: Blocks>(isa: I, tree: &Tree<B>, rays: &[Ray], query: Query) {
    if tree.is_empty() {
        return;
    }
    let mut stack = Stack::new(tree.stack_need + tree.block_need);
    match query {
        Query::Closest(hits) => {
            for (ray, hit) in rays.iter().zip(hits) {
                closest_along(isa, tree, ray, &Slabs::new(ray), &ShearedRay::new(ray), &mut stack, 0, hit);
            }
        }
        Query::Occluded(blocked) => {
            for (ray, blocked) in rays.iter().zip(blocked).filter(|(_, blocked)| !**blocked) {
                *blocked =
                    occluded_along(isa, tree, ray, &Slabs::new(ray), &ShearedRay::new(ray), &mut stack, 0);
            }
        }
    }
}

/// One ray's way through a tree that is not empty, with the entries of `stack` from `base` on.
#[inline(always)]
#[expect(clippy::too_many_arguments)]
pub fn closest_along<I: Isa, B: Blocks, const INSIDE: bool>(
    isa: I,
    tree: &Tree<B>,
    ray: &Ray,
    slabs: &Slabs<INSIDE>,
    sheared: &ShearedRay,
    stack: &mut Stack,
    base: usize,
    hit: &mut Hit,
) {
    let of_blocks = base + tree.stack_need;
    let mut limit = slabs.limit(hit.t);
    stack.links[base] = Child::NONE;
    let mut top = base + 1;
    let mut child = Child::node(0);
    while child != Child::NONE {
        if child.is_node() {
            child = stack.visit(isa, &tree.nodes[child.index()], slabs, limit, &mut top);
            continue;
        }
        let before = hit.t;
        tree.blocks[child.index()].closest(isa, ray, sheared, stack, of_blocks, hit);
        if hit.t < before {
            limit = slabs.limit(hit.t);
            stack.drop_beyond(limit, base + 1, &mut top);
        }
        child = stack.pop(&mut top);
    }
}

/// Whether one ray meets anything on its way through a tree that is not empty.
#[inline(always)]
pub fn occluded_along<I: Isa, B: Blocks, const INSIDE: bool>(
    isa: I,
    tree: &Tree<B>,
    ray: &Ray,
    slabs: &Slabs<INSIDE>,
    sheared: &ShearedRay,
    stack: &mut Stack,
    base: usize,
) -> bool {
    let of_blocks = base + tree.stack_need;
    let limit = slabs.limit(ray.t_max);
    stack.links[base] = Child::NONE;
    let mut top = base + 1;
    let mut child = Child::node(0);
    while child != Child::NONE {
        if child.is_node() {
            child = stack.visit(isa, &tree.nodes[child.index()], slabs, limit, &mut top);
            continue;
        }
        if tree.blocks[child.index()].occluded(isa, ray, sheared, stack, of_blocks) {
            return true;
        }
        child = stack.pop(&mut top);
    }
    false
}
