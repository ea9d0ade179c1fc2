//! The traversal: reference and specification.

use super::{Blocks, Child, Node, ShearedRay, Tree, WIDTH};
use crate::accel::{Hit, Ray};

/// Slab distances carry three roundings; widening the far side keeps the box test conservative (Ize 2013).
const WIDEN: f32 = 1.0 + 4.0 * f32::EPSILON;

/// A node to visit, and the distance at which the ray enters it.
#[derive(Clone, Copy)]
struct Entry {
    t: f32,
    child: Child,
}

/// What the box tests of one ray need.
struct Slabs {
    o: [f32; 3],
    inverse: [f32; 3],
    /// The plane of each axis through which the ray enters a box; it leaves through the other.
    near: [usize; 3],
    far: [usize; 3],
}

impl Slabs {
    #[inline(always)]
    fn new(ray: &Ray) -> Self {
        let d = ray.d.to_array();
        Self {
            o: ray.o.to_array(),
            inverse: d.map(|d| 1.0 / d),
            near: std::array::from_fn(|a| if d[a] < 0.0 { a + 3 } else { a }),
            far: std::array::from_fn(|a| if d[a] < 0.0 { a } else { a + 3 }),
        }
    }

    /// Entry distances, and a bit mask of the children that the ray meets before `t_max`.
    #[inline(always)]
    fn test(&self, node: &Node, t_max: f32) -> ([f32; WIDTH], u32) {
        // Widened like the far planes: a hit in a flat box may lie before the box's own rounded distance. Finite, so that
        // a plane parallel to the ray (∞) is never reached.
        let (mut enter, mut leave) = ([0.0f32; WIDTH], [(t_max * WIDEN).min(f32::MAX); WIDTH]);
        for axis in 0..3 {
            let (near, far) = (&node.planes[self.near[axis]], &node.planes[self.far[axis]]);
            let (o, inverse) = (self.o[axis], self.inverse[axis]);
            for i in 0..WIDTH {
                // Written so that a NaN (0 · ∞: the origin lies in a plane parallel to the ray) changes nothing.
                let t0 = (near[i] - o) * inverse;
                let t1 = (far[i] - o) * inverse * WIDEN;
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
    let mut stack = vec![Entry { t: 0.0, child: Child::NONE }; tree.stack_need.max(1)];
    for (ray, hit) in rays.iter().zip(hits) {
        let (slabs, sheared) = (Slabs::new(ray), ShearedRay::new(ray));
        let mut top = 1;
        stack[0] = Entry { t: 0.0, child: Child::node(0) };
        while top > 0 {
            top -= 1;
            let Entry { t, child } = stack[top];
            if t > hit.t * WIDEN {
                continue;
            }
            if child.0 & Child::LEAF != 0 {
                tree.blocks[(child.0 & !Child::LEAF) as usize].closest(ray, &sheared, hit);
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
}

/// See [`super::occluded`].
#[inline(always)]
pub fn occluded<B: Blocks>(tree: &Tree<B>, rays: &[Ray], blocked: &mut [bool]) {
    if tree.is_empty() {
        return;
    }
    let mut stack = vec![Child::NONE; tree.stack_need.max(1)];
    for (ray, blocked) in rays.iter().zip(blocked) {
        if *blocked {
            continue;
        }
        let (slabs, sheared) = (Slabs::new(ray), ShearedRay::new(ray));
        let mut top = 1;
        stack[0] = Child::node(0);
        while top > 0 {
            top -= 1;
            let child = stack[top];
            if child.0 & Child::LEAF != 0 {
                if tree.blocks[(child.0 & !Child::LEAF) as usize].occluded(ray, &sheared) {
                    *blocked = true;
                    break;
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
    }
}
