//! A node: eight boxes, rounded outwards to a grid of 8 bits over their common box.

use glam::{DVec3, Vec3};

use crate::accel::build;

/// Children of a node.
pub const WIDTH: usize = 8;

/// Steps of the grid along an axis.
const STEPS: f64 = 255.0;

/// Every box is larger than what it holds by at least this share of the node's own extent. A slab distance has an error of
/// a few roundings (2⁻²⁴) of the distance between the ray's origin and the node, or of the node's extent; the latter,
/// which may be any multiple of the distance itself, is what this covers.
const MARGIN: f64 = 1.0 / (1 << 18) as f64;

/// A link to a node or to a leaf's block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(transparent)]
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

    /// Whether it leads to an inner node.
    #[inline(always)]
    pub fn is_node(self) -> bool {
        self.0 & Self::LEAF == 0
    }

    /// Of the node or block.
    #[inline(always)]
    pub fn index(self) -> usize {
        (self.0 & !Self::LEAF) as usize
    }
}

/// Eight boxes in columns, in two cache lines.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(128))]
pub struct Node {
    /// Where the grid begins; the fourth is 0.
    pub origin: [f32; 4],
    /// Its step along each axis; the fourth is 0.
    pub step: [f32; 4],
    /// `planes[0..3]` are the minima of x, y, z and `planes[3..6]` the maxima, in steps.
    pub planes: [[u8; WIDTH]; 6],
    /// Links.
    pub child: [Child; WIDTH],
    /// All ones where there is no child.
    pub absent: [u8; WIDTH],
}

impl Node {
    /// No children.
    pub const EMPTY: Self = Self {
        origin: [0.0; 4],
        step: [0.0; 4],
        planes: [[0; WIDTH]; 6],
        child: [Child::NONE; WIDTH],
        absent: [0xff; WIDTH],
    };

    /// Boxes (minimum, maximum) with their links, at most eight. Each goes into the lane whose number says where it lies:
    /// a bit for each axis, set on the upper side (Ylitalo et al. 2017, section 3.3).
    pub fn new(children: &[(Vec3, Vec3, Child)]) -> Self {
        let (low, high) = children
            .iter()
            .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), c| (low.min(c.0), high.max(c.1)));
        let (low, high) = (low.as_dvec3(), high.as_dvec3());
        // In f64, where the difference of two f32 numbers can neither overflow nor vanish.
        let margin = (high - low) * MARGIN;
        let mut node = Self::EMPTY;
        let mut per_step = DVec3::ZERO;
        for axis in 0..3 {
            let origin = build::round_down(low[axis] - margin[axis]).max(f32::MIN);
            let extent = high[axis] + margin[axis] - f64::from(origin);
            let step = build::round_up(extent / STEPS);
            (node.origin[axis], node.step[axis]) = (origin, step);
            per_step[axis] = if step > 0.0 { 1.0 / f64::from(step) } else { 0.0 };
        }
        let origin = Vec3::from_slice(&node.origin).as_dvec3();
        for (lane, &(min, max, child)) in lanes(children).into_iter().zip(children) {
            let first = (min.as_dvec3() - margin - origin) * per_step;
            let last = (max.as_dvec3() + margin - origin) * per_step;
            for axis in 0..3 {
                // `as` saturates; the margin outweighs the rounding of these products many times.
                node.planes[axis][lane] = first[axis] as u8;
                node.planes[axis + 3][lane] = last[axis].ceil() as u8;
            }
            node.child[lane] = child;
            node.absent[lane] = 0;
        }
        node
    }
}

/// A lane for each box. Of all that is left, the pair of box and lane goes first for which the box lies farthest
/// towards the lane's corner: near the best assignment of all.
fn lanes(children: &[(Vec3, Vec3, Child)]) -> [usize; WIDTH] {
    let center = |c: &(Vec3, Vec3, Child)| 0.5 * c.0 + 0.5 * c.1;
    let mean = children.iter().map(|c| center(c) / children.len() as f32).sum::<Vec3>();
    let mut towards = [[f32::NEG_INFINITY; WIDTH]; WIDTH]; // by lane and box
    for (number, child) in children.iter().enumerate() {
        let p = center(child) - mean;
        for (lane, towards) in towards.iter_mut().enumerate() {
            let side = |axis: usize| if lane >> axis & 1 != 0 { p[axis] } else { -p[axis] };
            towards[number] = side(0) + side(1) + side(2);
        }
    }
    let (mut lanes, mut taken) = ([0; WIDTH], [false; WIDTH]);
    let mut left: Vec<usize> = (0..children.len()).collect();
    while !left.is_empty() {
        let mut best = (f32::NEG_INFINITY, 0, 0);
        for (at, &number) in left.iter().enumerate() {
            for lane in (0..WIDTH).filter(|&lane| !taken[lane]) {
                if best.0.is_infinite() || towards[lane][number] > best.0 {
                    best = (towards[lane][number], at, lane);
                }
            }
        }
        let (_, at, lane) = best;
        lanes[left.remove(at)] = lane;
        taken[lane] = true;
    }
    lanes
}
