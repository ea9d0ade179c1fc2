//! Russian roulette.

use super::{Context, Path};
use crate::sampling::Dim;

/// Lowest chance of survival: a path of tiny throughput that still finds a bright light must not become a firefly.
const FLOOR: f32 = 0.5;
/// Where paths may be endless, those of more edges than this survive with at most this chance, whatever they met: a
/// closed box of perfect mirrors would never let go of them.
const LONG: u32 = 1000;
const MOST_WHEN_LONG: f32 = 0.95;

/// Whether a path goes on; if so its throughput makes up for those that don't. Not asked after a delta vertex or a
/// hole, which cost no light sample and say nothing about where the light is.
#[inline]
pub fn survive(cx: &Context, path: &mut Path) -> bool {
    let beta = path.beta.total();
    if !beta.is_finite() {
        path.rejected = true; // a bad texel: no later contribution could be told from noise
        return false;
    }
    let endless = cx.settings.max_depth.is_none() && path.edges > LONG;
    if (path.edges <= cx.settings.rr_depth || path.delta || path.straight) && !endless {
        return true;
    }
    let most = if endless { MOST_WHEN_LONG } else { 1.0 };
    let chance = (beta.max_element() * path.eta_scale).clamp(FLOOR, most);
    if chance >= 1.0 {
        return true;
    }
    if path.sampler.draw1(Dim::Roulette(path.edges)) >= chance {
        return false;
    }
    path.beta = path.beta * (1.0 / chance);
    true
}
