//! Traversal of eight-wide trees.
//!
//! There is one source, [`scalar`]; the others compile it again with wider instructions enabled, and the
//! best that the processor has is chosen at run time. Rust never fuses a multiplication with an addition by
//! itself, so that all of them give the same hits to the bit.

mod scalar;
#[cfg(target_arch = "x86_64")]
mod x86;

use glam::{DVec3, Vec3};
pub use scalar::{Entry, Slabs, closest_along, occluded_along};

use super::{Hit, Ray};

/// Children of a node.
pub const WIDTH: usize = 8;

/// What a leaf holds: up to a block of primitives.
pub trait Blocks {
    /// Most primitives of a block.
    const MOST: usize;
    /// Replaces `hit` by a nearer one of this block. `stack` has room for what the block asks for.
    fn closest(&self, ray: &Ray, sheared: &ShearedRay, stack: &mut [Entry], hit: &mut Hit);
    /// Whether anything of this block lies before `ray.t_max`.
    fn occluded(&self, ray: &Ray, sheared: &ShearedRay, stack: &mut [Child]) -> bool;
    /// Stack entries that the block needs for a traversal of its own.
    fn stack_need(&self) -> usize {
        0
    }
}

/// A link to a node or to a leaf's block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Child(u32);

impl Child {
    const LEAF: u32 = 1 << 31;
    /// No child: its box is never hit.
    pub const NONE: Self = Self(u32::MAX);

    /// A link to an inner node.
    pub fn node(index: usize) -> Self {
        Self(index as u32)
    }

    /// A link to a block.
    pub fn leaf(index: usize) -> Self {
        Self(index as u32 | Self::LEAF)
    }
}

/// Eight boxes in columns: `planes[0..3]` are the minima of x, y, z and `planes[3..6]` the maxima.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub struct Node {
    planes: [[f32; WIDTH]; 6],
    child: [Child; WIDTH],
}

impl Node {
    /// No children: minima above maxima are never hit.
    pub const EMPTY: Self = Self {
        planes: [
            [f32::INFINITY; WIDTH],
            [f32::INFINITY; WIDTH],
            [f32::INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
        ],
        child: [Child::NONE; WIDTH],
    };

    /// Puts a child into a lane.
    pub fn set(&mut self, lane: usize, min: Vec3, max: Vec3, child: Child) {
        for axis in 0..3 {
            self.planes[axis][lane] = min[axis];
            self.planes[axis + 3][lane] = max[axis];
        }
        self.child[lane] = child;
    }
}

/// A wide tree with its leaves.
#[derive(Debug)]
pub struct Tree<B> {
    /// The root first; empty for an empty tree.
    pub nodes: Vec<Node>,
    /// One a leaf.
    pub blocks: Vec<B>,
    /// Most stack entries that a traversal can need.
    pub stack_need: usize,
    /// Most stack entries that a block can need beyond.
    pub block_need: usize,
}

impl<B> Default for Tree<B> {
    fn default() -> Self {
        Self { nodes: Vec::new(), blocks: Vec::new(), stack_need: 0, block_need: 0 }
    }
}

impl<B> Tree<B> {
    /// Whether there is nothing to hit.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Size of nodes and blocks.
    #[cfg(feature = "bench")]
    pub fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + size_of_val(&self.blocks[..])
    }
}

/// What a ray's tests need beside it: axes permuted so that the direction's largest component comes last, and
/// the shear that turns the direction into that axis (Woop, Benthin and Wald 2013).
#[derive(Clone, Copy, Debug)]
pub struct ShearedRay {
    /// Axes; `k[2]` is that of the largest component.
    pub k: [usize; 3],
    /// The origin's coordinates along `k`.
    pub o: [f32; 3],
    /// `d[k[0]] / d[k[2]]`, `d[k[1]] / d[k[2]]`, `1 / d[k[2]]`.
    pub s: [f32; 3],
    /// The origin without rounding: distances are measured from here.
    pub o64: DVec3,
    /// The direction without rounding.
    pub d64: DVec3,
    /// Of the ray that is rounded, distance 0 and a unit of distance: 0 and 1 but inside an instance.
    pub distances: [f64; 2],
}

impl ShearedRay {
    /// Prepares a ray.
    #[inline(always)]
    pub fn new(ray: &Ray) -> Self {
        let a = ray.d.abs();
        let kz = if a.x > a.y {
            if a.x > a.z { 0 } else { 2 }
        } else if a.y > a.z {
            1
        } else {
            2
        };
        let (kx, ky) = ((kz + 1) % 3, (kz + 2) % 3);
        let inverse = 1.0 / ray.d[kz];
        Self {
            k: [kx, ky, kz],
            o: [ray.o[kx], ray.o[ky], ray.o[kz]],
            s: [ray.d[kx] * inverse, ray.d[ky] * inverse, inverse],
            o64: ray.o.as_dvec3(),
            d64: ray.d.as_dvec3(),
            distances: [0.0, 1.0],
        }
    }
}

/// The reference, whatever the processor has.
#[cfg(any(test, feature = "bench"))]
pub fn scalar_closest<B: Blocks>(tree: &Tree<B>, rays: &[Ray], hits: &mut [Hit]) {
    scalar::closest(tree, rays, hits)
}

/// The reference, whatever the processor has.
#[cfg(any(test, feature = "bench"))]
pub fn scalar_occluded<B: Blocks>(tree: &Tree<B>, rays: &[Ray], blocked: &mut [bool]) {
    scalar::occluded(tree, rays, blocked)
}

/// The nearest hit of each ray that beats the one in `hits`.
pub fn closest<B: Blocks>(tree: &Tree<B>, rays: &[Ray], hits: &mut [Hit]) {
    #[cfg(target_arch = "x86_64")]
    if let Some(level) = x86::Level::detected() {
        return x86::closest(level, tree, rays, hits);
    }
    scalar::closest(tree, rays, hits)
}

/// Sets `blocked` where anything lies before a ray's `t_max`; what is set stays set.
pub fn occluded<B: Blocks>(tree: &Tree<B>, rays: &[Ray], blocked: &mut [bool]) {
    #[cfg(target_arch = "x86_64")]
    if let Some(level) = x86::Level::detected() {
        return x86::occluded(level, tree, rays, blocked);
    }
    scalar::occluded(tree, rays, blocked)
}
