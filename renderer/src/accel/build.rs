//! From obvhs's binary tree to eight-wide nodes.

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

fn round_down(x: f64) -> f32 {
    let y = x as f32;
    if f64::from(y) > x { y.next_down() } else { y }
}

fn round_up(x: f64) -> f32 {
    let y = x as f32;
    if f64::from(y) < x { y.next_up() } else { y }
}

/// Builds the wide tree over boxes; `block` makes a leaf's data from its primitives' indices.
pub fn wide_tree<B: Blocks>(bounds: &[Bounds], block: impl Fn(&[u32]) -> B) -> Tree<B> {
    let mut tree = Tree::default();
    if bounds.is_empty() {
        return tree;
    }
    let params = BvhBuildParams { max_prims_per_leaf: B::MOST as u32, ..BvhBuildParams::fast_build() };
    let bvh = build_bvh2(bounds, params, &mut std::time::Duration::default());
    let mut stack = vec![(0usize, 0usize, 0usize)]; // binary node, wide node, stack entries in use above it
    tree.nodes.push(Node::EMPTY);
    while let Some((binary, wide, used)) = stack.pop() {
        let children = gather(&bvh, binary);
        let used = used + children.len();
        tree.stack_need = tree.stack_need.max(used + 1);
        for (lane, &child) in children.iter().enumerate() {
            let node = &bvh.nodes[child];
            let aabb = node.aabb();
            let link = if node.is_leaf() {
                let first = node.first_index as usize;
                let prims = &bvh.primitive_indices[first..first + node.prim_count as usize];
                let block = block(prims);
                tree.block_need = tree.block_need.max(block.stack_need());
                tree.blocks.push(block);
                Child::leaf(tree.blocks.len() - 1)
            } else {
                tree.nodes.push(Node::EMPTY);
                stack.push((child, tree.nodes.len() - 1, used));
                Child::node(tree.nodes.len() - 1)
            };
            tree.nodes[wide].set(lane, Vec3::from(aabb.min), Vec3::from(aabb.max), link);
        }
    }
    tree
}

/// Up to eight descendants of a binary node that cover it: again and again the largest inner one is opened.
fn gather(bvh: &Bvh2, root: usize) -> Vec<usize> {
    let mut children = vec![root];
    while children.len() < WIDTH {
        let area = |&i: &usize| {
            let b = bvh.nodes[i].aabb();
            Bounds { min: b.min.into(), max: b.max.into() }.half_area()
        };
        let largest = (0..children.len())
            .filter(|&c| !bvh.nodes[children[c]].is_leaf())
            .max_by(|&a, &b| area(&children[a]).total_cmp(&area(&children[b])));
        let Some(largest) = largest else { break };
        let first = bvh.nodes[children[largest]].first_index as usize;
        children[largest] = first;
        children.push(first + 1);
    }
    children
}
