//! Light that a path runs into.

use super::{Context, Path, mis_weight};
use crate::accel::Ray;
use crate::effects::Counters;
use crate::geometry::Surface;

/// The path hit a surface: adds what it emits.
#[inline]
pub fn emit_surface(cx: &Context, path: &mut Path, ray: &Ray, surface: &Surface) {
    if hides(cx, path.edges == 1) {
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
    if !lights.has_infinite() || hides(cx, !path.present) {
        return;
    }
    path.present = true;
    counters.environment += 1;
    for (radiance, pdf) in lights.miss(ray.d) {
        let weight = if path.delta { 1.0 } else { mis_weight(path.pdf, pdf) };
        path.gather(path.beta * weight, radiance);
    }
}

/// Whether a light is not shown that is seen directly, or not: with `hide_emitters` a surface is hidden from the camera's
/// own rays, and the background from all that have met no surface but holes (as in Mitsuba 3.9). A path of depth 0 has
/// no edge.
#[inline]
fn hides(cx: &Context, directly: bool) -> bool {
    (directly && cx.settings.hide_emitters) || cx.settings.max_depth == Some(0)
}
