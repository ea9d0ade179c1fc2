//! What the inside of a glass takes from light on its way.

use limpid_scenes::MaterialId;

use super::{Context, Path};
use crate::accel::Ray;
use crate::color::Rgb;
use crate::effects::Counters;
use crate::geometry::Surface;

/// What the path's current ray loses until `surface`, or on its way to infinity.
#[inline]
pub fn absorb(cx: &Context, path: &mut Path, ray: &Ray, surface: Option<&Surface>, counters: &mut Counters) {
    if path.inside.is_none()
        && let Some(surface) = surface
        && surface.ng.dot(ray.d) > 0.0
    {
        path.inside = inside(cx, surface, true); // the camera is in it
    }
    if path.inside.is_some() {
        let length = surface.map_or(f32::INFINITY, |surface| (surface.p - ray.o).length());
        counters.absorption += 1;
        path.beta = path.beta * left(cx, path.inside, length);
    }
}

/// What absorbs on one side of `surface`.
#[inline]
pub fn inside(cx: &Context, surface: &Surface, below: bool) -> Option<MaterialId> {
    let material = cx.scene.geometry.shapes[surface.shape as usize].material;
    (below && cx.scene.materials.absorption(material).is_some()).then_some(material)
}

/// What is left of light after `length` inside of `material`.
#[inline]
pub fn left(cx: &Context, material: Option<MaterialId>, length: f32) -> Rgb {
    let absorption = material.and_then(|material| cx.scene.materials.absorption(material));
    absorption.map_or(Rgb::ONE, |absorption| absorption.transmittance(length))
}
