//! What the insides of materials take from light on its way.

use limpid_scenes::MaterialId;

use super::{Connection, Context, Path};
use crate::accel::Ray;
use crate::color::Rgb;
use crate::effects::Counters;
use crate::geometry::Surface;

/// Insides within each other that are kept apart; one that is deeper in counts as the one around it.
const MOST: usize = 3;

/// The materials whose insides a ray goes through, the innermost last: that one absorbs. Light is inside where it has
/// gone through the surface of a material. A hole is no surface: it is a way out of an inside, and none into it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inside {
    of: [u32; MOST],
    depth: u32,
}

impl Inside {
    /// Past the surface of a material, from the front or from behind; thin ones have no inside.
    #[inline]
    pub fn cross(&mut self, cx: &Context, material: MaterialId, from_front: bool) {
        if cx.scene.materials.absorption(material).is_none() {
            return;
        }
        if from_front {
            self.enter(material);
        } else {
            self.leave(material);
        }
    }

    fn enter(&mut self, MaterialId(id): MaterialId) {
        if (self.depth as usize) < MOST {
            self.of[self.depth as usize] = id;
            self.depth += 1;
        }
    }

    /// Out of the innermost of this material; where insides overlap another may be further in.
    pub fn leave(&mut self, MaterialId(id): MaterialId) {
        let depth = self.depth as usize;
        if let Some(at) = self.of[..depth].iter().rposition(|&other| other == id) {
            self.of.copy_within(at + 1..depth, at);
            self.depth -= 1;
        }
    }

    /// What is left of light after `length` in the innermost.
    #[inline]
    pub fn left(&self, cx: &Context, length: f32) -> Rgb {
        let innermost = (self.depth as usize).checked_sub(1).map(|last| MaterialId(self.of[last]));
        let absorption = innermost.and_then(|material| cx.scene.materials.absorption(material));
        absorption.map_or(Rgb::ONE, |absorption| absorption.transmittance(length))
    }
}

/// What the path's current ray loses until `surface`, or on its way to infinity.
#[inline]
pub fn absorb(cx: &Context, path: &mut Path, ray: &Ray, surface: Option<&Surface>, counters: &mut Counters) {
    if path.edges == 1
        && let Some(surface) = surface
        && surface.ng.dot(ray.d) > 0.0
    {
        path.inside.cross(cx, material(cx, surface), true); // the camera is in it
    }
    if path.inside.depth > 0 {
        let length = surface.map_or(f32::INFINITY, |surface| (surface.p - ray.o).length());
        counters.absorption += 1;
        path.beta = path.beta * path.inside.left(cx, length);
    }
}

/// What a light sample loses until it leaves what it is in by a hole in `surface`, if it is in that.
pub fn leave_by_hole(cx: &Context, connection: &mut Connection, surface: &Surface) {
    if surface.ng.dot(connection.ray.d) > 0.0 {
        let distance = (surface.p - connection.ray.o).length();
        connection.radiance *= connection.inside.left(cx, distance - connection.from);
        connection.inside.leave(material(cx, surface));
        connection.from = distance;
    }
}

/// Of a surface.
#[inline]
pub fn material(cx: &Context, surface: &Surface) -> MaterialId {
    cx.scene.geometry.shapes[surface.shape as usize].material
}

#[cfg(test)]
mod tests {
    use super::*;

    fn inside(of: &[u32]) -> Inside {
        let mut inside = Inside::default();
        of.iter().for_each(|&id| inside.enter(MaterialId(id)));
        inside
    }

    #[test]
    fn insides_are_left_in_any_order_and_one_too_many_counts_as_the_one_around_it() {
        let mut nested = inside(&[4, 7, 4]);
        nested.leave(MaterialId(9)); // it is not in that one
        assert_eq!(nested.of, [4, 7, 4]);
        nested.enter(MaterialId(5));
        assert_eq!(nested.depth, 3);
        nested.leave(MaterialId(5));
        nested.leave(MaterialId(7));
        assert_eq!((nested.depth, &nested.of[..2]), (2, &[4, 4][..]));
        nested.leave(MaterialId(4));
        nested.leave(MaterialId(4));
        assert_eq!(nested.depth, 0);
    }
}
