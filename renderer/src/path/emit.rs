//! Light that a path runs into.

use super::{Context, Path, mis_weight};
use crate::accel::Ray;
use crate::effects::Counters;
use crate::geometry::Surface;

/// The path hit a surface: adds what it emits.
#[inline]
pub fn emit_surface(cx: &Context, path: &mut Path, ray: &Ray, surface: &Surface) {
    if path.edges == 1 && cx.settings.hide_emitters {
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
    if !lights.has_infinite() || (path.edges == 1 && cx.settings.hide_emitters) {
        return;
    }
    counters.environment += 1;
    for (radiance, pdf) in lights.miss(ray.d) {
        let weight = if path.delta { 1.0 } else { mis_weight(path.pdf, pdf) };
        path.gather(path.beta * weight, radiance);
    }
}
