//! Many rays at a time through one tree.
//!
//! A ray alone waits for memory at each node: it cannot know which node comes next before it has tested this one.
//! Here `WAYS` independent rays take turns. Each does one step, a node or a leaf, learns which comes next, asks for it, and
//! by its next turn, a microsecond's worth of other rays' steps later, that has come. Steps of one kind follow each
//! other, so that the processor works on several at once and no jump between kinds is mispredicted.

use std::hint::select_unpredictable;

use super::along::{Slabs, Stack};
use super::node::{Child, WIDTH};
use super::{Blocks, Isa, ShearedRay, Tree};
use crate::accel::{Hit, NONE, Ray};

/// Rays under way at a time.
const WAYS: usize = 32;

/// A ray under way.
struct Slot {
    slabs: Slabs<false>,
    /// See [`Slabs::limit`].
    limit: f32,
    /// Where it goes next; [`Child::NONE`] at its end.
    child: Child,
    /// First free entry of its part of the stack; the first one of all holds [`Child::NONE`].
    top: usize,
    /// Its index.
    number: usize,
    hit: Hit,
    sheared: ShearedRay,
}

impl Slot {
    #[inline(always)]
    fn new(ray: &Ray, number: usize, hit: Hit, base: usize) -> Self {
        let slabs = Slabs::new(ray);
        Self {
            limit: slabs.limit(hit.t),
            slabs,
            child: Child::node(0),
            top: base + 1,
            number,
            hit,
            sheared: ShearedRay::new(ray),
        }
    }
}

/// See [`super::closest`]; the tree is not empty.
#[inline(always)]
pub fn closest<I: Isa, B: Blocks>(isa: I, tree: &Tree<B>, rays: &[Ray], hits: &mut [Hit]) {
    trace::<I, B, Hit, false>(isa, tree, rays, hits, |_| true, |hit| *hit, |out, hit| *out = *hit)
}

/// See [`super::occluded`]; the tree is not empty.
#[inline(always)]
pub fn occluded<I: Isa, B: Blocks>(isa: I, tree: &Tree<B>, rays: &[Ray], blocked: &mut [bool]) {
    trace::<I, B, bool, true>(
        isa,
        tree,
        rays,
        blocked,
        |blocked| !blocked,
        |_| Hit::MISS,
        |out, hit| *out = hit.prim != NONE,
    )
}

/// Traces the rays whose output is `wanted`, from the hit that `begin` makes of it, and puts the end into it by `finish`.
/// With `ANY` a ray ends at its first hit, whatever it is.
#[inline(always)]
fn trace<I: Isa, B: Blocks, T: Copy, const ANY: bool>(
    isa: I,
    tree: &Tree<B>,
    rays: &[Ray],
    out: &mut [T],
    wanted: impl Fn(T) -> bool,
    begin: impl Fn(&T) -> Hit,
    finish: impl Fn(&mut T, &Hit),
) {
    let stride = tree.stack_need + WIDTH; // the unused lanes of a write do not reach the next one's part
    let ways = WAYS.min(rays.len());
    let of_blocks = ways * stride;
    let mut stack = Stack::new(of_blocks + tree.block_need);
    let mut slots: Vec<Slot> = Vec::with_capacity(ways);
    let mut begun = 0;
    let mut next = |out: &[T]| {
        while begun < rays.len() && !wanted(out[begun]) {
            begun += 1;
        }
        begun += 1;
        begun - 1
    };
    let hit_before = |ray: &Ray, out: &T| if ANY { Hit { t: ray.t_max, ..Hit::MISS } } else { begin(out) };
    // Slots by the kind of their next step; a slot without a ray is in neither.
    let (mut at_node, mut at_leaf) = ([0usize; WAYS], [0usize; WAYS]);
    let (mut nodes, mut leaves) = (0, 0);
    while nodes < ways {
        let number = next(out);
        let Some(ray) = rays.get(number) else { break };
        slots.push(Slot::new(ray, number, hit_before(ray, &out[number]), nodes * stride));
        at_node[nodes] = nodes;
        nodes += 1;
    }
    while nodes + leaves > 0 {
        for i in 0..std::mem::take(&mut nodes) {
            let at = at_node[i];
            let slot = &mut slots[at];
            let node = &tree.nodes[slot.child.index()];
            slot.child = stack.visit(isa, node, &slot.slabs, slot.limit, &mut slot.top);
            ask_for(isa, tree, slot.child);
            // Both are written, one counts: no branch. There are never more than `WAYS` in the two together.
            let is_node = slot.child.is_node();
            (at_node[nodes % WAYS], at_leaf[leaves % WAYS]) = (at, at);
            nodes += usize::from(is_node);
            leaves += usize::from(!is_node);
        }
        for i in 0..std::mem::take(&mut leaves) {
            let at = at_leaf[i];
            let slot = &mut slots[at];
            let base = at * stride;
            if slot.child == Child::NONE {
                finish(&mut out[slot.number], &slot.hit);
                let number = next(out);
                let Some(ray) = rays.get(number) else { continue };
                *slot = Slot::new(ray, number, hit_before(ray, &out[number]), base);
                at_node[nodes % WAYS] = at;
                nodes += 1;
                continue;
            }
            let block = &tree.blocks[slot.child.index()];
            let ray = &rays[slot.number];
            if ANY {
                if block.occluded(isa, ray, &slot.sheared, &mut stack, of_blocks) {
                    (slot.hit.prim, slot.top) = (0, base + 1);
                }
            } else {
                let before = slot.hit.t;
                block.closest(isa, ray, &slot.sheared, &mut stack, of_blocks, &mut slot.hit);
                if slot.hit.t < before {
                    slot.limit = slot.slabs.limit(slot.hit.t);
                    stack.drop_beyond(slot.limit, base + 1, &mut slot.top);
                }
            }
            slot.child = stack.pop(&mut slot.top);
            ask_for(isa, tree, slot.child);
            let is_node = slot.child.is_node();
            (at_node[nodes % WAYS], at_leaf[leaves % WAYS]) = (at, at);
            nodes += usize::from(is_node);
            leaves += usize::from(!is_node);
        }
    }
}

/// Asks for a node or leaf before it is needed.
#[inline(always)]
fn ask_for<I: Isa, B: Blocks>(isa: I, tree: &Tree<B>, child: Child) {
    let index = child.index();
    let (node, block) = (tree.nodes.as_ptr().wrapping_add(index), tree.blocks.as_ptr().wrapping_add(index));
    isa.prefetch(select_unpredictable(child.is_node(), node.cast::<u8>(), block.cast::<u8>()));
}
