//! Light samples, as far as their way is free.

use super::absorb::leave_by_hole;
use super::{Connection, Context, Path};
use crate::accel::{Hit, NONE, Ray};
use crate::effects::Counters;
use crate::film::Sample;

/// Adds a light sample to its path. `share`: how much of the light gets through.
#[inline]
pub fn connect(cx: &Context, path: &mut Path, connection: &Connection, share: f32, features: &mut Sample) {
    if connection.at_feature {
        features.set_visibility(share);
    }
    if share > 0.0 {
        let mut radiance = connection.radiance;
        if cx.scene.has_absorption {
            radiance *= connection.inside.left(cx, connection.ray.t_max - connection.from);
        }
        path.gather(connection.through * share, radiance);
    }
}

/// More holes in a row than this count as a wall, so that no arrangement of them is endless.
const MOST_HOLES: u32 = 1000;

/// How much light gets along each connection in a scene whose surfaces have holes. A hole counts as an edge of the path,
/// as it does for rays that scattering sends through it.
pub fn through_holes(
    cx: &Context,
    connections: &mut [Connection],
    shares: &mut [f32],
    counters: &mut Counters,
) {
    shares.fill(1.0);
    let mut queue: Vec<usize> = (0..connections.len()).collect();
    let mut rays: Vec<Ray> = connections.iter().map(|c| c.ray).collect();
    let mut hits = Vec::new();
    for holes in 0.. {
        hits.resize(rays.len(), Hit::MISS);
        cx.scene.accel.closest(&rays, &mut hits);
        counters.shadow_rays += rays.len() as u64;
        let mut kept = 0;
        for k in 0..rays.len() {
            let (i, ray, hit) = (queue[k], rays[k], hits[k]);
            if hit.prim == NONE {
                continue;
            }
            let surface = cx.scene.geometry.surface(&ray, &hit);
            let edges = connections[i].edges + holes + 1;
            let last = holes == MOST_HOLES || cx.settings.max_depth.is_some_and(|max| edges > max);
            let share = shares[i] * if last { 0.0 } else { cx.scene.hole(&ray, &surface) };
            shares[i] = share;
            if share > 0.0 {
                counters.alpha += 1;
                if cx.scene.has_absorption {
                    leave_by_hole(cx, &mut connections[i], &surface);
                }
                let next = Ray { t_max: ray.t_max - hit.t, skip: ray.skip, ..surface.spawn(ray.d) };
                (queue[kept], rays[kept]) = (i, next);
                kept += 1;
            }
        }
        queue.truncate(kept);
        rays.truncate(kept);
        if rays.is_empty() {
            return;
        }
    }
}
