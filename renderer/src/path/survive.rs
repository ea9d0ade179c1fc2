//! Russian roulette.

use super::{Context, Path};
use crate::sampling::Dim;

/// Lowest chance of survival: a path of tiny throughput that still finds a bright light must not become a firefly.
const FLOOR: f32 = 0.5;

/// Whether a path goes on; if so its throughput makes up for those that don't. Not asked after a delta vertex, which
/// cost no light sample and says nothing about where the light is.
#[inline]
pub fn survive(cx: &Context, path: &mut Path) -> bool {
    if path.edges <= cx.settings.rr_depth || path.delta {
        return true;
    }
    let chance = (path.beta.total().max_element() * path.eta_scale).clamp(FLOOR, 1.0);
    if chance >= 1.0 {
        return true;
    }
    if path.sampler.draw1(Dim::Roulette(path.edges)) >= chance {
        return false;
    }
    path.beta = path.beta * (1.0 / chance);
    true
}
