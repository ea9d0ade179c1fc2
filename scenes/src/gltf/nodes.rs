//! The tree of nodes: what is shown, and where.

use glam::{DMat4, DQuat, DVec3};

use super::Reader;
use super::json::Item;
use crate::SceneError;

/// Where every node is in the world.
pub(super) struct Nodes {
    /// `None` for nodes in a circle, which are nowhere.
    world: Vec<Option<DMat4>>,
}

impl Nodes {
    /// To world space from that of node `index`, if the node is anywhere.
    pub fn world_from(&self, index: usize) -> Option<DMat4> {
        self.world[index]
    }
}

impl Reader<'_> {
    /// Reads all that the file's default scene shows: the first one where none is named, all nodes where there are no scenes.
    pub(super) fn nodes(&mut self) -> Result<(), SceneError> {
        let children = (0..self.document.count("nodes"))
            .map(|index| self.document.entry("nodes", index)?.indices("children", "nodes"))
            .collect::<Result<Vec<_>, _>>()?;
        let (roots, nodes) = self.place_nodes(&children)?;
        let shown = self.shown(roots)?;
        let mut seen = vec![false; children.len()];
        let mut open: Vec<usize> = shown.into_iter().rev().collect();
        while let Some(index) = open.pop() {
            if std::mem::replace(&mut seen[index], true) {
                continue; // once is enough, whoever else names it
            }
            let item = self.document.entry("nodes", index)?;
            match nodes.world_from(index) {
                Some(world) => self.node(index, &item, world, &nodes)?,
                None => self.warn(&item.path, "a node that is below itself; it is left out"),
            }
            open.extend(children[index].iter().rev());
        }
        Ok(())
    }

    /// Nodes without parent, and the places of all: of two parents the first counts.
    fn place_nodes(&mut self, children: &[Vec<usize>]) -> Result<(Vec<usize>, Nodes), SceneError> {
        let mut parent = vec![None; children.len()];
        for (index, list) in children.iter().enumerate() {
            for &child in list {
                match parent[child] {
                    Some(other) if other != index => {
                        let message =
                            format!("a child of nodes {other} and {index}; it is shown once, below {other}");
                        self.warn(&format!("nodes[{child}]"), message);
                    }
                    _ => parent[child] = Some(index),
                }
            }
        }
        let roots: Vec<usize> = (0..children.len()).filter(|&index| parent[index].is_none()).collect();
        let mut world = vec![None; children.len()];
        let mut open = roots.clone();
        while let Some(index) = open.pop() {
            let above = parent[index].and_then(|parent: usize| world[parent]).unwrap_or(DMat4::IDENTITY);
            world[index] = Some(above * local(&self.document.entry("nodes", index)?)?);
            open.extend(children[index].iter().copied().filter(|&child| parent[child] == Some(index)));
        }
        Ok((roots, Nodes { world }))
    }

    /// The roots of what is to be shown.
    fn shown(&mut self, roots: Vec<usize>) -> Result<Vec<usize>, SceneError> {
        let root = self.document.root();
        let count = self.document.count("scenes");
        let index = root.index("scene", "scenes")?;
        if count == 0 {
            return Ok(roots);
        }
        let index = index.unwrap_or(0);
        let item = self.document.entry("scenes", index)?;
        if count > 1 {
            let mut names = Vec::new();
            for other in (0..count.min(20)).filter(|&other| other != index) {
                names.push(format!("\"{}\"", self.document.entry("scenes", other)?.name_or("scene", other)));
            }
            let name = item.name_or("scene", index);
            let message = format!("scene \"{name}\" of {count} is shown; left out: {}", names.join(", "));
            self.warn("scenes", message);
        }
        item.indices("nodes", "nodes")
    }

    /// What hangs on a node.
    fn node(&mut self, index: usize, item: &Item<'_>, world: DMat4, nodes: &Nodes) -> Result<(), SceneError> {
        if let Some(mesh) = item.index("mesh", "meshes")? {
            self.mesh(index, item, mesh, world, nodes)?;
        }
        if let Some(camera) = item.index("camera", "cameras")? {
            self.camera(item, camera, world)?;
        }
        if let Some(light) = item.extension("KHR_lights_punctual")? {
            self.light(item, &light, world)?;
        }
        Ok(())
    }
}

/// From the space of a node to that of its parent: its matrix, or translation, rotation and scale.
fn local(item: &Item<'_>) -> Result<DMat4, SceneError> {
    if let Some(matrix) = item.numbers::<16>("matrix")? {
        let mut matrix = DMat4::from_cols_array(&matrix);
        // the last row must be this one
        for (column, w) in [(0, 0.0), (1, 0.0), (2, 0.0), (3, 1.0)] {
            matrix.col_mut(column).w = w;
        }
        return Ok(matrix);
    }
    let translation = item.numbers("translation")?.map_or(DVec3::ZERO, DVec3::from);
    let scale = item.numbers("scale")?.map_or(DVec3::ONE, DVec3::from);
    let rotation = item.numbers("rotation")?.map_or(DQuat::IDENTITY, unit);
    Ok(DMat4::from_scale_rotation_translation(scale, rotation, translation))
}

/// Files hold quaternions of length 1 but for rounding; one of length 0 turns nothing.
pub(super) fn unit(xyzw: [f64; 4]) -> DQuat {
    let [x, y, z, w] = xyzw;
    let length = x.hypot(y).hypot(z.hypot(w));
    let q = DQuat::from_array(xyzw.map(|v| v / length));
    if q.is_finite() { q } else { DQuat::IDENTITY }
}
