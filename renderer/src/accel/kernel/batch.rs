//! Many rays at a time through one tree of triangles.
//!
//! A ray alone waits for memory at each node: it cannot know which node comes next before it has tested this one.
//! Here `WAYS` independent rays take turns. Each does one step, a node or a leaf, learns which comes next, asks for it, and
//! by its next turn, a microsecond's worth of other rays' steps later, that has come. Steps of one kind follow each
//! other, so that the processor works on several at once and no jump between kinds is mispredicted.

use std::hint::select_unpredictable;

use super::along::{Slabs, Stack};
use super::node::{Child, WIDTH};
use super::{Isa, LANES, Query, ShearedRay, Tree};
use crate::accel::triangle::TriangleBlock;
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
    /// First free entry of its part of the stack, the lowest of which holds [`Child::NONE`].
    top: usize,
    /// Its index.
    number: usize,
    hit: Hit,
    sheared: ShearedRay,
    /// What the last leaf's test found: see [`TriangleBlock::candidates`].
    candidates: u32,
    edges: [[f64; LANES]; 3],
    block: u32,
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
            candidates: 0,
            edges: [[0.0; LANES]; 3],
            block: 0,
        }
    }
}

/// Numbers of slots whose next step is of one kind. There are never more than `WAYS` in all of them together.
#[derive(Default)]
struct Queue {
    slots: [u32; WAYS],
    count: usize,
}

impl Queue {
    /// Writes in any case and counts if `really`: no jump.
    #[inline(always)]
    fn push_if(&mut self, really: bool, slot: usize) {
        self.slots[self.count % WAYS] = slot as u32;
        self.count += usize::from(really);
    }

    /// Empties it; what it held is still there to be read, as long as no more is written than was read.
    #[inline(always)]
    fn take(&mut self) -> usize {
        std::mem::take(&mut self.count)
    }
}

/// Many rays at a time.
#[inline(always)]
pub fn trace<I: Isa>(isa: I, tree: &Tree<TriangleBlock>, rays: &[Ray], query: Query) {
    if tree.is_empty() {
        return;
    }
    match query {
        Query::Closest(hits) => {
            run::<I, Hit, false>(isa, tree, rays, hits, |_| true, |_, hit| *hit, |hit| *hit);
        }
        Query::Occluded(blocked) => {
            let before = |ray: &Ray, _: &bool| Hit { t: ray.t_max, ..Hit::MISS };
            run::<I, bool, true>(isa, tree, rays, blocked, |blocked| !blocked, before, |h| h.prim != NONE);
        }
    }
}

/// Traces the rays whose output is `wanted`, from the hit `before` on, and puts `end` of the hit into the output.
/// With `ANY` a ray ends at its first hit, whatever it is.
#[inline(always)]
fn run<I: Isa, T: Copy, const ANY: bool>(
    isa: I,
    tree: &Tree<TriangleBlock>,
    rays: &[Ray],
    out: &mut [T],
    wanted: impl Fn(T) -> bool,
    before: impl Fn(&Ray, &T) -> Hit,
    end: impl Fn(&Hit) -> T,
) {
    let stride = tree.stack_need + WIDTH; // the unused lanes of a write do not reach the next one's part
    let ways = WAYS.min(rays.len());
    let mut stack = Stack::new(ways * stride);
    let mut slots: Vec<Slot> = Vec::with_capacity(ways);
    let mut begun = 0;
    let mut next = |out: &[T]| {
        while begun < rays.len() && !wanted(out[begun]) {
            begun += 1;
        }
        begun += 1;
        begun - 1
    };
    let (mut at_node, mut at_leaf, mut at_hit) = (Queue::default(), Queue::default(), Queue::default());
    while slots.len() < ways {
        let number = next(out);
        let Some(ray) = rays.get(number) else { break };
        let slot = slots.len();
        slots.push(Slot::new(ray, number, before(ray, &out[number]), slot * stride));
        at_node.push_if(true, slot);
    }
    while at_node.count + at_leaf.count > 0 {
        for i in 0..at_node.take() {
            let number = at_node.slots[i] as usize;
            let slot = &mut slots[number];
            let node = &tree.nodes[slot.child.index()];
            slot.child = stack.visit(isa, node, &slot.slabs, slot.limit, &mut slot.top);
            ask_for(isa, tree, slot.child);
            at_node.push_if(slot.child.is_node(), number);
            at_leaf.push_if(!slot.child.is_node(), number);
        }
        for i in 0..at_leaf.take() {
            let number = at_leaf.slots[i] as usize;
            let slot = &mut slots[number];
            if slot.child == Child::NONE {
                out[slot.number] = end(&slot.hit);
                let index = next(out);
                if let Some(ray) = rays.get(index) {
                    *slot = Slot::new(ray, index, before(ray, &out[index]), number * stride);
                    at_node.push_if(true, number);
                }
                continue;
            }
            slot.block = slot.child.index() as u32;
            let block = &tree.blocks[slot.child.index()];
            slot.candidates = block.candidates(isa, &slot.sheared, &mut slot.edges);
            slot.child = stack.pop(&mut slot.top);
            ask_for(isa, tree, slot.child);
            let any = slot.candidates != 0;
            at_hit.push_if(any, number);
            at_node.push_if(!any & slot.child.is_node(), number);
            at_leaf.push_if(!any & !slot.child.is_node(), number);
        }
        for i in 0..at_hit.take() {
            let number = at_hit.slots[i] as usize;
            let slot = &mut slots[number];
            let (block, ray) = (&tree.blocks[slot.block as usize], &rays[slot.number]);
            if ANY {
                if block.any(slot.candidates, &slot.edges, ray, &slot.sheared) {
                    (slot.hit.prim, slot.child) = (0, Child::NONE);
                }
            } else {
                let t = slot.hit.t;
                block.nearest(slot.candidates, &slot.edges, ray, &slot.sheared, &mut slot.hit);
                if slot.hit.t < t {
                    slot.limit = slot.slabs.limit(slot.hit.t);
                    slot.top += 1; // what was taken off may be too far away, too
                    stack.drop_beyond(slot.limit, number * stride + 1, &mut slot.top);
                    slot.child = stack.pop(&mut slot.top);
                    ask_for(isa, tree, slot.child);
                }
            }
            at_node.push_if(slot.child.is_node(), number);
            at_leaf.push_if(!slot.child.is_node(), number);
        }
    }
}

/// Asks for a node or leaf before it is needed.
#[inline(always)]
fn ask_for<I: Isa>(isa: I, tree: &Tree<TriangleBlock>, child: Child) {
    let index = child.index();
    let (node, block) = (tree.nodes.as_ptr().wrapping_add(index), tree.blocks.as_ptr().wrapping_add(index));
    isa.prefetch(select_unpredictable(child.is_node(), node.cast::<u8>(), block.cast::<u8>()));
}
