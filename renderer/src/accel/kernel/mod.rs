//! Traversal of eight-wide trees.
//!
//! [`scalar`] is the specification of the two innermost steps, the test of a node's eight boxes and that of a leaf's four
//! triangles; [`x86`] does the same operations in the same order on AVX2 registers, compiled for AVX2 and for AVX-512, and the
//! best that the processor has is chosen at run time. All fuse the same multiplications with the same additions, those of the
//! box test, and no others: they visit the same nodes and give the same hits to the bit.
//!
//! [`along`] follows one ray through a tree, [`batch`] many at a time.

mod along;
mod batch;
mod node;
mod scalar;
#[cfg(target_arch = "x86_64")]
mod x86;

use glam::DVec3;

pub use along::{Slabs, Stack, closest_along, occluded_along};
pub use node::{Child, Node, WIDTH};
#[cfg(test)]
pub use scalar::Scalar;

use super::triangle::TriangleBlock;
use super::{Hit, Ray};

/// Triangles of a leaf.
pub const LANES: usize = 4;
/// Corners of a leaf's triangles.
pub const CORNERS: usize = 8;

/// What a leaf holds: up to a block of primitives.
pub trait Blocks {
    /// Most primitives of a block.
    const MOST: usize;
    /// Replaces `hit` by a nearer one of this block. `stack` has room for what the block asks for from `base` on.
    fn closest<I: Isa>(
        &self,
        isa: I,
        ray: &Ray,
        sheared: &ShearedRay,
        stack: &mut Stack,
        base: usize,
        hit: &mut Hit,
    );
    /// Whether anything of this block lies before `ray.t_max`.
    fn occluded<I: Isa>(
        &self,
        isa: I,
        ray: &Ray,
        sheared: &ShearedRay,
        stack: &mut Stack,
        base: usize,
    ) -> bool;
    /// Stack entries that the block needs for a traversal of its own.
    fn stack_need(&self) -> usize {
        0
    }
}

/// An instruction set: the two steps that are written for each.
pub trait Isa: Copy {
    /// Which children's boxes the ray meets before `limit`: all but the nearest are written, with the distances at which
    /// the ray enters them (see [`scalar::visit`]); what lies beyond these in the arrays is arbitrary.
    fn visit<const INSIDE: bool>(
        self,
        node: &Node,
        slabs: &Slabs<INSIDE>,
        limit: f32,
        enters: &mut [f32; WIDTH],
        links: &mut [Child; WIDTH],
    ) -> Met;

    /// Bit mask of the triangles that the ray is not outside of, and all edge functions (see [`scalar::inside`]).
    fn inside(self, corners: &Corners, sheared: &ShearedRay, edges: &mut [[f64; LANES]; 3]) -> u32;

    /// Asks for the two cache lines at `data`.
    fn prefetch<T>(self, data: *const T);
}

/// What a ray meets of a node.
#[derive(Clone, Copy, Debug)]
pub struct Met {
    /// Whether it meets any child.
    pub any: bool,
    /// The nearest child; arbitrary if there is none.
    pub nearest: Child,
    /// Number of the others.
    pub others: usize,
}

/// Up to four triangles with their corners in columns: `v[axis][corner]`. Corners of equal position are one.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Corners {
    /// Coordinates.
    pub v: [[f32; CORNERS]; 3],
    /// The corner that is the first, second, third vertex of each triangle.
    pub index: [[u8; LANES]; 3],
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
        let (kx, ky) = ([1, 2, 0][kz], [2, 0, 1][kz]);
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

/// What is done along rays: the nearest hit that beats the one in the array, or whether anything lies before `t_max`, where
/// that is not known yet.
pub enum Query<'a> {
    /// Nearest hits.
    Closest(&'a mut [Hit]),
    /// What is set stays set.
    Occluded(&'a mut [bool]),
}

/// Traces rays one by one: where leaves are costly.
pub fn one_by_one<B: Blocks>(tree: &Tree<B>, rays: &[Ray], query: Query) {
    #[cfg(target_arch = "x86_64")]
    if let Some(level) = x86::Level::detected() {
        return x86::one_by_one(level, tree, rays, query);
    }
    along::trace(scalar::Scalar, tree, rays, query)
}

/// Traces many rays at a time, so that memory is waited for once for all of them.
pub fn interleaved(tree: &Tree<TriangleBlock>, rays: &[Ray], query: Query) {
    #[cfg(target_arch = "x86_64")]
    if let Some(level) = x86::Level::detected() {
        return x86::interleaved(level, tree, rays, query);
    }
    batch::trace(scalar::Scalar, tree, rays, query)
}

/// The reference: scalar whatever the processor has, and a ray at a time.
#[cfg(any(test, feature = "bench"))]
pub fn reference<B: Blocks>(tree: &Tree<B>, rays: &[Ray], query: Query) {
    along::trace(scalar::Scalar, tree, rays, query)
}

#[cfg(test)]
mod tests;
