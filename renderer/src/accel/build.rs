//! From obvhs's binary tree to eight-wide nodes.

use arrayvec::ArrayVec;
use glam::{DVec3, Vec3, Vec3A};
use obvhs::{Boundable, BvhBuildParams, aabb::Aabb, bvh2::Bvh2, bvh2::builder::build_bvh2};

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
pub fn wide_tree<B: Blocks>(
    bounds: &[Bounds],
    fits: impl Fn(&[u32]) -> bool,
    block: impl Fn(&[u32]) -> B,
) -> Tree<B> {
    let mut tree = Tree::default();
    if bounds.is_empty() {
        return tree;
    }
    let params = BvhBuildParams { max_prims_per_leaf: 1, ..BvhBuildParams::fast_build() };
    let bvh = build_bvh2(bounds, params, &mut std::time::Duration::default());
    let plan = Plan::new(&bvh, B::MOST, fits);
    let mut stack = vec![(0usize, 0usize, 0usize)]; // binary node, wide node, stack entries in use above it
    tree.nodes.push(Node::EMPTY);
    let (mut children, mut prims) = (Vec::new(), Vec::new());
    let mut boxes = Vec::new();
    while let Some((binary, wide, used)) = stack.pop() {
        children.clear();
        plan.children(&bvh, binary, &mut children);
        let used = used + children.len();
        tree.stack_need = tree.stack_need.max(used + 2); // and the end's mark
        boxes.clear();
        for &child in &children {
            let aabb = bvh.nodes[child].aabb();
            let link = if plan.is_leaf(&bvh, child) {
                prims.clear();
                prims_below(&bvh, child, &mut prims);
                let block = block(&prims);
                tree.block_need = tree.block_need.max(block.stack_need());
                tree.blocks.push(block);
                Child::leaf(tree.blocks.len() - 1)
            } else {
                tree.nodes.push(Node::EMPTY);
                stack.push((child, tree.nodes.len() - 1, used));
                Child::node(tree.nodes.len() - 1)
            };
            boxes.push((Vec3::from(aabb.min), Vec3::from(aabb.max), link));
        }
        tree.nodes[wide] = Node::new(&boxes);
    }
    tree
}

/// Appends the primitives below a binary node.
fn prims_below(bvh: &Bvh2, root: usize, prims: &mut Vec<u32>) {
    let mut todo = ArrayVec::<usize, 64>::new();
    todo.push(root);
    while let Some(at) = todo.pop() {
        let node = &bvh.nodes[at];
        let first = node.first_index as usize;
        if node.is_leaf() {
            prims.extend_from_slice(&bvh.primitive_indices[first..first + node.prim_count as usize]);
        } else {
            todo.push(first + 1);
            todo.push(first);
        }
    }
}

/// What a visit of a leaf costs, in visits of a node.
const LEAF_COST: f64 = 1.0;

/// Which binary nodes become wide ones and leaves: the choice with the least expected cost by the surface area
/// heuristic, found by dynamic programming (Ylitalo et al., "Efficient incoherent ray traversal on GPUs through compressed wide BVHs", 2017, section 3).
struct Plan {
    /// `cost[n][i]`: least cost of what is below the binary node n, as a forest of up to i + 1 subtrees.
    cost: Vec<[f32; WIDTH - 1]>,
    /// Whether the node, alone, is best a leaf.
    leaf: Vec<bool>,
}

impl Plan {
    fn new(bvh: &Bvh2, most: usize, fits: impl Fn(&[u32]) -> bool) -> Self {
        let count = bvh.nodes.len();
        let mut plan = Self { cost: vec![[0.0; WIDTH - 1]; count], leaf: vec![false; count] };
        let mut size = vec![0u32; count];
        let mut prims = Vec::new();
        // Parents before children, to be gone through backwards.
        let mut order = vec![0usize];
        let mut next = 0;
        while next < order.len() {
            let node = &bvh.nodes[order[next]];
            if !node.is_leaf() {
                order.extend([node.first_index as usize, node.first_index as usize + 1]);
            }
            next += 1;
        }
        for &at in order.iter().rev() {
            let node = &bvh.nodes[at];
            let aabb = node.aabb();
            let area = Bounds { min: aabb.min.into(), max: aabb.max.into() }.half_area();
            let leaf_cost = (area * LEAF_COST) as f32;
            if node.is_leaf() {
                (size[at], plan.leaf[at]) = (node.prim_count, true);
                plan.cost[at] = [leaf_cost; WIDTH - 1];
                continue;
            }
            let (left, right) = (node.first_index as usize, node.first_index as usize + 1);
            size[at] = size[left] + size[right];
            let (l, r) = (plan.cost[left], plan.cost[right]);
            let split = |n: usize| (1..n).map(|k| l[k - 1] + r[n - k - 1]).fold(f32::INFINITY, f32::min);
            let mut cost = [0.0; WIDTH - 1];
            cost[0] = area as f32 + split(WIDTH);
            if size[at] as usize <= most && leaf_cost <= cost[0] {
                prims.clear();
                prims_below(bvh, at, &mut prims);
                plan.leaf[at] = fits(&prims);
                if plan.leaf[at] {
                    cost[0] = leaf_cost;
                }
            }
            for n in 2..WIDTH {
                cost[n - 1] = split(n).min(cost[n - 2]);
            }
            plan.cost[at] = cost;
        }
        plan
    }

    fn is_leaf(&self, _: &Bvh2, at: usize) -> bool {
        self.leaf[at]
    }

    /// The children of the wide node at a binary node; of a tree that is one leaf, that leaf.
    fn children(&self, bvh: &Bvh2, at: usize, children: &mut Vec<usize>) {
        if self.leaf[at] {
            children.push(at);
            return;
        }
        let mut todo = vec![(at, WIDTH)];
        let mut forced = true;
        while let Some((at, mut n)) = todo.pop() {
            // As few as cost as little.
            while !forced && n > 1 && self.cost[at][n - 1] == self.cost[at][n - 2] {
                n -= 1;
            }
            if n == 1 && !forced {
                children.push(at);
                continue;
            }
            forced = false;
            let (left, right) = (bvh.nodes[at].first_index as usize, bvh.nodes[at].first_index as usize + 1);
            let (l, r) = (&self.cost[left], &self.cost[right]);
            let k = (1..n)
                .min_by(|&a, &b| (l[a - 1] + r[n - a - 1]).total_cmp(&(l[b - 1] + r[n - b - 1])))
                .expect("n is at least 2");
            todo.push((right, n - k));
            todo.push((left, k));
        }
    }
}
