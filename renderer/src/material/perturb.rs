//! What normal and bump maps do to the shading normal.

use glam::Vec3;
use limpid_scenes::{Color, NormalMap, Scalar};

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
            NormalMap::Tangent { normal, scale } => self.tangent(normal, scale, textures),
            NormalMap::Bump { height, scale } => self.bumped(height, scale, textures),
        };
        if map.flip_invalid && wo.z * wo.dot(n) <= 0.0 {
            n = Vec3::new(-n.x, -n.y, n.z);
        }
        Perturbation::new(n, map.shadowing)
    }

    /// A normal whose y axis points against ∂p/∂v: where texture coordinates are mirrored, the other way from `z × x`.
    fn tangent(&self, normal: Color, scale: f32, textures: &Textures) -> Vec3 {
        let n = textures.color(normal, self.uv) * 2.0 - 1.0;
        let [du, dv] = self.dp_duv;
        // seen along −z, with u to the right, v of an unmirrored picture runs down
        let is_mirrored = du.x * dv.y - du.y * dv.x > 0.0;
        let y = if is_mirrored { -n.y } else { n.y };
        Vec3::new(n.x * scale, y * scale, n.z)
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
