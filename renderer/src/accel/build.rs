//! From obvhs's binary tree to eight-wide nodes.

use arrayvec::ArrayVec;
use glam::{DVec3, Vec3, Vec3A};
use obvhs::{Boundable, BvhBuildParams, aabb::Aabb, bvh2::Bvh2, bvh2::builder::build_bvh2};

use rayon::prelude::*;

use super::kernel::{Blocks, Child, Node, Tree, WIDTH};

/// An axis-aligned box.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    pub min: Vec3,
    pub max: Vec3,
}

impl Boundable for Bounds {
    fn aabb(&self) -> Aabb {
        Aabb::new(Vec3A::from(self.min), Vec3A::from(self.max))
    }
}

impl Bounds {
    pub const EMPTY: Self = Self { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY };

    pub fn of_points(points: &[Vec3]) -> Self {
        points.iter().fold(Self::EMPTY, |b, &p| Self { min: b.min.min(p), max: b.max.max(p) })
    }

    /// Rounded so that nothing is cut off.
    pub fn outwards(min: DVec3, max: DVec3) -> Self {
        Self {
            min: Vec3::from_array(min.to_array().map(round_down)),
            max: Vec3::from_array(max.to_array().map(round_up)),
        }
    }

    pub fn union(&self, other: &Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Half the surface area, in `f64` since a product of two extents can leave the range of `f32`.
    fn half_area(&self) -> f64 {
        let d = (self.max.as_dvec3() - self.min.as_dvec3()).max(DVec3::ZERO);
        d.x * d.y + d.y * d.z + d.z * d.x
    }

    pub fn is_finite(&self) -> bool {
        self.min.is_finite() && self.max.is_finite()
    }

    /// Half the diagonal; 0 if empty.
    pub fn radius(&self) -> f64 {
        if self.min.x > self.max.x {
            return 0.0;
        }
        0.5 * (self.max.as_dvec3() - self.min.as_dvec3()).length()
    }
}

pub fn round_down(x: f64) -> f32 {
    let y = x as f32;
    if f64::from(y) > x { y.next_down() } else { y }
}

pub fn round_up(x: f64) -> f32 {
    let y = x as f32;
    if f64::from(y) < x { y.next_up() } else { y }
}

/// Builds the wide tree over boxes; `block` makes a leaf's data from its primitives' indices, of which `fits` says whether
/// they fit into one.
pub fn wide_tree<B: Blocks + Send>(
    bounds: &[Bounds],
    fits: impl Fn(&[u32]) -> bool,
    block: impl Fn(&[u32]) -> B + Sync,
) -> Tree<B> {
    if bounds.is_empty() {
        return Tree::default();
    }
    let params = BvhBuildParams { max_prims_per_leaf: 1, ..BvhBuildParams::fast_build() };
    let bvh = build_bvh2(bounds, params, &mut std::time::Duration::default());
    let plan = Plan::new(&bvh, B::MOST, fits);
    let Shape { nodes, leaves, stack_need } = Shape::new(&bvh, &plan);
    let nodes = (nodes.par_iter())
        .map(|children| {
            let boxes: ArrayVec<_, WIDTH> = (children.iter())
                .map(|&(at, link)| {
                    let aabb = bvh.nodes[at as usize].aabb();
                    (Vec3::from(aabb.min), Vec3::from(aabb.max), link)
                })
                .collect();
            Node::new(&boxes)
        })
        .collect();
    let blocks: Vec<B> = (leaves.par_iter())
        .map(|&at| {
            let mut prims = ArrayVec::new();
            prims_below(&bvh, at, &mut prims);
            block(&prims)
        })
        .collect();
    let block_need = blocks.iter().map(B::stack_need).max().unwrap_or(0);
    Tree { nodes, blocks, stack_need, block_need }
}

/// Most primitives of a leaf of any kind.
const MOST: usize = 4;

/// Appends the primitives below a binary node, of which there are few.
fn prims_below(bvh: &Bvh2, at: u32, prims: &mut ArrayVec<u32, MOST>) {
    let node = &bvh.nodes[at as usize];
    if node.is_leaf() {
        prims.push(bvh.primitive_indices[node.first_index as usize]);
    } else {
        prims_below(bvh, node.first_index, prims);
        prims_below(bvh, node.first_index + 1, prims);
    }
}

/// Which binary nodes become wide ones and leaves: the choice with the least expected cost by the surface area
/// heuristic, found by dynamic programming (Ylitalo et al., "Efficient incoherent ray traversal on GPUs through compressed wide
/// BVHs", 2017, section 3). A visit of a leaf is taken to cost what a visit of a node does: half or
/// double that changed the speed by less than what repeats did.
struct Plan {
    /// For each binary node the best ways to make of what is below it a forest of at most n subtrees: in the bits
    /// 3 n to 3 n + 2 how many of these are on the left, or 0 where fewer than n cost as little.
    left: Vec<u32>,
}

/// Of a binary node that is planned.
struct Planned {
    /// `cost[n − 1]`: least cost of a forest of at most n subtrees.
    cost: [f32; WIDTH - 1],
    /// What is below, if it fits into a leaf.
    prims: ArrayVec<u32, MOST>,
}

impl Plan {
    /// In the bits of n = 0, which is no forest: the node, as one subtree, is a leaf.
    const LEAF: u32 = 1;

    fn new(bvh: &Bvh2, most: usize, fits: impl Fn(&[u32]) -> bool) -> Self {
        let mut left = vec![0u32; bvh.nodes.len()];
        // As shares of the root's, which no size of the scene can bring out of the range of f32.
        let area = |at: u32| {
            let aabb = bvh.nodes[at as usize].aabb();
            Bounds { min: aabb.min.into(), max: aabb.max.into() }.half_area()
        };
        let whole = area(0);
        let scale = if whole > 0.0 { 1.0 / whole } else { 0.0 };
        // Children before parents: a node is met once to plan its children, and once more to be planned.
        let mut todo = vec![(0u32, false)];
        let mut planned: Vec<Planned> = Vec::new();
        while let Some((at, children_planned)) = todo.pop() {
            let node = &bvh.nodes[at as usize];
            let area = (area(at) * scale) as f32;
            if node.is_leaf() {
                left[at as usize] = Self::LEAF;
                let prims = std::iter::once(bvh.primitive_indices[node.first_index as usize]).collect();
                planned.push(Planned { cost: [area; WIDTH - 1], prims });
                continue;
            }
            if !children_planned {
                todo.extend([(at, true), (node.first_index + 1, false), (node.first_index, false)]);
                continue;
            }
            let r = planned.pop().expect("both children are planned");
            let l = planned.last_mut().expect("both children are planned");
            let mut choice = 0;
            let mut split = [f32::INFINITY; WIDTH + 1];
            for (n, best) in split.iter_mut().enumerate().skip(2) {
                for k in 1..n {
                    let cost = l.cost[k - 1] + r.cost[n - k - 1];
                    if k == 1 || cost < *best {
                        *best = cost;
                        choice = choice & !(7 << (3 * n)) | (k as u32) << (3 * n);
                    }
                }
            }
            let mut cost = [area + split[WIDTH]; WIDTH - 1];
            if l.prims.is_empty() || r.prims.is_empty() || l.prims.len() + r.prims.len() > most {
                l.prims.clear();
            } else {
                l.prims.extend(r.prims);
                if !fits(&l.prims) {
                    l.prims.clear();
                } else if area <= cost[0] {
                    cost[0] = area;
                    choice |= Self::LEAF;
                }
            }
            for n in 2..WIDTH {
                cost[n - 1] = split[n].min(cost[n - 2]);
                if split[n] >= cost[n - 2] {
                    choice &= !(7 << (3 * n));
                }
            }
            l.cost = cost;
            left[at as usize] = choice;
        }
        Self { left }
    }

    fn is_leaf(&self, at: u32) -> bool {
        self.left[at as usize] & Self::LEAF != 0
    }

    /// Appends the roots of the best forest of at most n subtrees below a binary node.
    fn forest(&self, bvh: &Bvh2, at: u32, n: usize, roots: &mut ArrayVec<u32, WIDTH>) {
        let first = bvh.nodes[at as usize].first_index;
        match (self.left[at as usize] >> (3 * n) & 7) as usize {
            _ if n == 1 => roots.push(at),
            0 => self.forest(bvh, at, n - 1, roots),
            k => {
                self.forest(bvh, first, k, roots);
                self.forest(bvh, first + 1, n - k, roots);
            }
        }
    }
}

/// The wide tree with binary nodes in place of boxes and primitives.
struct Shape {
    nodes: Vec<ArrayVec<(u32, Child), WIDTH>>,
    leaves: Vec<u32>,
    stack_need: usize,
}

impl Shape {
    fn new(bvh: &Bvh2, plan: &Plan) -> Self {
        let mut shape = Self { nodes: vec![ArrayVec::new()], leaves: Vec::new(), stack_need: 0 };
        let mut todo = vec![(0u32, 0usize, 1usize)]; // binary node, wide node, stack entries in use above it
        while let Some((binary, wide, used)) = todo.pop() {
            let mut children = ArrayVec::new();
            if plan.is_leaf(binary) {
                children.push(binary); // the whole tree is one leaf
            } else {
                plan.forest(bvh, binary, WIDTH, &mut children);
            }
            let used = used + children.len();
            shape.stack_need = shape.stack_need.max(used);
            for at in children {
                let link = if plan.is_leaf(at) {
                    shape.leaves.push(at);
                    Child::leaf(shape.leaves.len() - 1)
                } else {
                    shape.nodes.push(ArrayVec::new());
                    todo.push((at, shape.nodes.len() - 1, used));
                    Child::node(shape.nodes.len() - 1)
                };
                shape.nodes[wide].push((at, link));
            }
        }
        shape
    }
}
