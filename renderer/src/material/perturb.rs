//! What normal and bump maps do to the shading normal.

use glam::Vec3;
use limpid_scenes::{NormalMap, Scalar};

use super::flatten::Map;
use crate::bsdf::Perturbation;
use crate::texture::{TexturePoint, Textures};

/// A hit as a map sees it; directions are in the frame of the shading normal whose x axis leans towards ∂p/∂u.
pub struct Perturbed {
    pub uv: TexturePoint,
    pub wo: Vec3,
    /// Geometric normal.
    pub ng: Vec3,
    pub dp_duv: [Vec3; 2],
}

impl Perturbed {
    /// The turned frame. `over`: the surface is turned over before the map, so that `wo` lies on the other side.
    pub fn by(&self, map: &Map, over: bool, textures: &Textures) -> Perturbation {
        let wo = if over { Vec3::new(self.wo.x, self.wo.y, -self.wo.z) } else { self.wo };
        let mut n = match map.map {
            NormalMap::Normal(color) => textures.color(color, self.uv) * 2.0 - 1.0,
            NormalMap::Bump { height, scale } => self.bumped(height, scale, textures),
        };
        if map.flip_invalid && wo.z * wo.dot(n) <= 0.0 {
            n = Vec3::new(-n.x, -n.y, n.z);
        }
        Perturbation::new(n, map.shadowing)
    }

    /// The normal of the surface displaced by the height along its normal, whose own change over the surface is left
    /// out (Blinn 1978); on the side of the geometric normal.
    fn bumped(&self, height: Scalar, scale: f32, textures: &Textures) -> Vec3 {
        let gradient = textures.gradient(height, self.uv.uv) * scale;
        let [du, dv] = self.dp_duv;
        let n = Vec3::new(du.x, du.y, gradient.x).cross(Vec3::new(dv.x, dv.y, gradient.y));
        if n.dot(self.ng) < 0.0 { -n } else { n }
    }
}
