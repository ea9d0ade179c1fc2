//! The traversal: reference and specification.

use super::{Blocks, Child, Node, ShearedRay, Tree, WIDTH};
use crate::accel::{Hit, Ray};

/// Slab distances carry three roundings; widening the far side keeps the box test conservative (Ize 2013).
const WIDEN: f32 = 1.0 + 4.0 * f32::EPSILON;

/// A node to visit, and the distance at which the ray enters it.
#[derive(Clone, Copy)]
pub struct Entry {
    t: f32,
    child: Child,
}

/// What the box tests of one ray need. `INSIDE` an instance the ray was rounded: boxes are padded by how far it may be
/// from the true one, and its distances are counted from elsewhere, in another unit.
pub struct Slabs<const INSIDE: bool> {
    o: [f32; 3],
    /// The origin against which the far planes are tested, where boxes are padded.
    o_far: [f32; 3],
    inverse: [f32; 3],
    /// The plane of each axis through which the ray enters a box; it leaves through the other.
    near: [usize; 3],
    far: [usize; 3],
    distances: [f64; 2],
}

impl Slabs<false> {
    #[inline(always)]
    fn new(ray: &Ray) -> Self {
        Self::padded(ray, [0.0; 3], [0.0, 1.0])
    }
}

impl<const INSIDE: bool> Slabs<INSIDE> {
    /// With boxes larger by `pad` along each axis; `distances` as in [`ShearedRay`].
    #[inline(always)]
    pub fn padded(ray: &Ray, pad: [f32; 3], distances: [f64; 2]) -> Self {
        let (o, d) = (ray.o.to_array(), ray.d.to_array());
        let towards = |a: usize, by: f32| if d[a] < 0.0 { o[a] - by } else { o[a] + by };
        Self {
            o: std::array::from_fn(|a| if INSIDE { towards(a, pad[a]) } else { o[a] }),
            o_far: std::array::from_fn(|a| if INSIDE { towards(a, -pad[a]) } else { o[a] }),
            inverse: d.map(|d| 1.0 / d),
            near: std::array::from_fn(|a| if d[a] < 0.0 { a + 3 } else { a }),
            far: std::array::from_fn(|a| if d[a] < 0.0 { a } else { a + 3 }),
            distances,
        }
    }

    /// Boxes that are entered farther away than this cannot hold a hit before the distance `t`.
    #[inline(always)]
    fn limit(&self, t: f32) -> f32 {
        if INSIDE {
            // The distance was rounded to f32 where it is large; what is left of it here may be small.
            let [start, unit] = self.distances;
            ((f64::from(t) * f64::from(WIDEN) - start) / unit * f64::from(WIDEN)) as f32
        } else {
            t * WIDEN
        }
    }

    /// Entry distances, and a bit mask of the children that the ray meets before `t_max`.
    #[inline(always)]
    fn test(&self, node: &Node, t_max: f32) -> ([f32; WIDTH], u32) {
        // Widened like the far planes: a hit in a flat box may lie before the box's own rounded distance. Finite, so that
        // a plane parallel to the ray (∞) is never reached.
        let (mut enter, mut leave) = ([0.0f32; WIDTH], [self.limit(t_max).min(f32::MAX); WIDTH]);
        for axis in 0..3 {
            let (near, far) = (&node.planes[self.near[axis]], &node.planes[self.far[axis]]);
            let (o, inverse) = (self.o[axis], self.inverse[axis]);
            let o_far = if INSIDE { self.o_far[axis] } else { o };
            for i in 0..WIDTH {
                // Written so that a NaN (0 · ∞: the origin lies in a plane parallel to the ray) changes nothing.
                let t0 = (near[i] - o) * inverse;
                let t1 = (far[i] - o_far) * inverse * WIDEN;
                enter[i] = if t0 > enter[i] { t0 } else { enter[i] };
                leave[i] = if t1 < leave[i] { t1 } else { leave[i] };
            }
        }
        let mut mask = 0;
        for i in 0..WIDTH {
            mask |= u32::from(enter[i] <= leave[i]) << i;
        }
        (enter, mask)
    }
}

/// See [`super::closest`].
#[inline(always)]
pub fn closest<B: Blocks>(tree: &Tree<B>, rays: &[Ray], hits: &mut [Hit]) {
    if tree.is_empty() {
        return;
    }
    let need = tree.stack_need.max(1) + tree.block_need;
    let mut stack = vec![Entry { t: 0.0, child: Child::NONE }; need];
    for (ray, hit) in rays.iter().zip(hits) {
        closest_along(tree, ray, &Slabs::new(ray), &ShearedRay::new(ray), &mut stack, hit);
    }
}

/// One ray's way through a tree that is not empty.
#[inline(always)]
pub fn closest_along<B: Blocks, const INSIDE: bool>(
    tree: &Tree<B>,
    ray: &Ray,
    slabs: &Slabs<INSIDE>,
    sheared: &ShearedRay,
    stack: &mut [Entry],
    hit: &mut Hit,
) {
    let (stack, of_blocks) = stack.split_at_mut(tree.stack_need.max(1));
    let mut top = 1;
    stack[0] = Entry { t: 0.0, child: Child::node(0) };
    while top > 0 {
        top -= 1;
        let Entry { t, child } = stack[top];
        if t > slabs.limit(hit.t) {
            continue;
        }
        if child.0 & Child::LEAF != 0 {
            tree.blocks[(child.0 & !Child::LEAF) as usize].closest(ray, sheared, of_blocks, hit);
            continue;
        }
        let node = &tree.nodes[child.0 as usize];
        let (enter, mut mask) = slabs.test(node, hit.t);
        let first = top;
        while mask != 0 {
            let lane = mask.trailing_zeros() as usize;
            mask &= mask - 1;
            // Insertion keeps the nearest on top: seldom more than three children are met.
            let entry = Entry { t: enter[lane], child: node.child[lane] };
            let mut at = top;
            while at > first && stack[at - 1].t < entry.t {
                stack[at] = stack[at - 1];
                at -= 1;
            }
            stack[at] = entry;
            top += 1;
        }
    }
}

/// See [`super::occluded`].
#[inline(always)]
pub fn occluded<B: Blocks>(tree: &Tree<B>, rays: &[Ray], blocked: &mut [bool]) {
    if tree.is_empty() {
        return;
    }
    let mut stack = vec![Child::NONE; tree.stack_need.max(1) + tree.block_need];
    for (ray, blocked) in rays.iter().zip(blocked) {
        if !*blocked {
            *blocked = occluded_along(tree, ray, &Slabs::new(ray), &ShearedRay::new(ray), &mut stack);
        }
    }
}

/// Whether one ray meets anything on its way through a tree that is not empty.
#[inline(always)]
pub fn occluded_along<B: Blocks, const INSIDE: bool>(
    tree: &Tree<B>,
    ray: &Ray,
    slabs: &Slabs<INSIDE>,
    sheared: &ShearedRay,
    stack: &mut [Child],
) -> bool {
    let (stack, of_blocks) = stack.split_at_mut(tree.stack_need.max(1));
    let mut top = 1;
    stack[0] = Child::node(0);
    while top > 0 {
        top -= 1;
        let child = stack[top];
        if child.0 & Child::LEAF != 0 {
            if tree.blocks[(child.0 & !Child::LEAF) as usize].occluded(ray, sheared, of_blocks) {
                return true;
            }
            continue;
        }
        let node = &tree.nodes[child.0 as usize];
        let (_, mut mask) = slabs.test(node, ray.t_max);
        while mask != 0 {
            stack[top] = node.child[mask.trailing_zeros() as usize];
            mask &= mask - 1;
            top += 1;
        }
    }
    false
}
