//! Skins at rest: joints are where their nodes are.

use std::sync::Arc;

use glam::DMat4;

use super::Reader;
use super::accessors::Floats;
use super::json::Item;
use super::nodes::Nodes;
use crate::SceneError;

/// The joints of a skin.
pub(super) struct Skin {
    /// From the space of the mesh to world space, by joint.
    joints: Vec<DMat4>,
}

/// Which joints move a vertex and how much: pairs of numbers of joints and weights.
pub(super) struct Bound {
    sets: Vec<(Arc<Floats>, Arc<Floats>)>,
}

impl Skin {
    /// The weighted mean of the joints that move a vertex.
    pub fn matrix(&self, bound: &Bound, vertex: usize) -> DMat4 {
        let mut sum = DMat4::ZERO;
        let mut total = 0.0;
        for (joints, weights) in &bound.sets {
            let (joints, weights): ([f32; 4], [f32; 4]) = (joints.get(vertex), weights.get(vertex));
            for (joint, weight) in joints.into_iter().zip(weights.map(f64::from)) {
                if weight > 0.0
                    && let Some(matrix) = self.joints.get(joint as usize)
                {
                    sum += *matrix * weight;
                    total += weight;
                }
            }
        }
        // a vertex that nothing moves stays with the first joint
        if total > 0.0 {
            sum * (1.0 / total)
        } else {
            self.joints.first().copied().unwrap_or(DMat4::IDENTITY)
        }
    }
}

impl Reader<'_> {
    pub(super) fn skin(&mut self, index: usize, nodes: &Nodes) -> Result<Skin, SceneError> {
        let item = self.document.entry("skins", index)?;
        let inverse = match item.index("inverseBindMatrices", "accessors")? {
            Some(accessor) => Some(self.floats(accessor)?),
            None => None,
        };
        let joints = item.indices("joints", "nodes")?;
        if let Some(inverse) = &inverse
            && inverse.len() < joints.len()
        {
            let problem = format!("{} matrices for {} joints", inverse.len(), joints.len());
            return Err(item.error("inverseBindMatrices", problem, super::json::EXPORT_AGAIN));
        }
        self.take((size_of::<DMat4>() * joints.len()) as u64, &item)?;
        let joint = |(i, &node): (usize, &usize)| {
            let world = nodes.world_from(node).unwrap_or(DMat4::IDENTITY);
            let inverse = inverse.as_ref().map(|m| DMat4::from_cols_array(&m.get::<16>(i).map(f64::from)));
            world * inverse.unwrap_or(DMat4::IDENTITY)
        };
        Ok(Skin { joints: joints.iter().enumerate().map(joint).collect() })
    }

    /// The joints of the vertices of a primitive.
    pub(super) fn bound(&mut self, attributes: Option<&Item<'_>>, count: usize) -> Result<Bound, SceneError> {
        let mut sets = Vec::new();
        for set in 0..4 {
            let joints = self.attribute(attributes, &format!("JOINTS_{set}"), Some(count))?;
            let weights = self.attribute(attributes, &format!("WEIGHTS_{set}"), Some(count))?;
            match (joints, weights) {
                (Some(joints), Some(weights)) => sets.push((joints, weights)),
                _ => break,
            }
        }
        Ok(Bound { sets })
    }
}
