//! Light that a path runs into.

use super::{Context, Path, mis_weight};
use crate::accel::Ray;
use crate::effects::Counters;
use crate::geometry::Surface;

/// The path hit a surface: adds what it emits.
#[inline]
pub fn emit_surface(cx: &Context, path: &mut Path, ray: &Ray, surface: &Surface) {
    if is_hidden(cx, path) {
        return;
    }
    let Some(light) = cx.scene.lights.of_shape(surface.shape) else { return };
    if path.delta {
        let radiance = cx.scene.lights.radiance(light, surface, -ray.d, &cx.scene.textures);
        path.gather(path.beta, radiance);
    } else {
        let (radiance, pdf) = cx.scene.lights.hit(light, path.p, surface, ray.d, &cx.scene.textures);
        path.gather(path.beta * mis_weight(path.pdf, pdf), radiance);
    }
}

/// The path left the scene: adds what comes from infinity.
#[inline]
pub fn emit_background(cx: &Context, path: &mut Path, ray: &Ray, counters: &mut Counters) {
    let lights = &cx.scene.lights;
    if !lights.has_infinite() || is_hidden(cx, path) {
        return;
    }
    counters.environment += 1;
    for (radiance, pdf) in lights.miss(ray.d) {
        let weight = if path.delta { 1.0 } else { mis_weight(path.pdf, pdf) };
        path.gather(path.beta * weight, radiance);
    }
}

/// Whether lights are not seen along the current ray: a path of depth 0 has no edge.
#[inline]
fn is_hidden(cx: &Context, path: &Path) -> bool {
    (path.edges == 1 && cx.settings.hide_emitters) || cx.settings.max_depth == Some(0)
}
