//! Lambert's ideal diffuse reflector.

use glam::{Vec2, Vec3};

use super::{BsdfEval, BsdfSample};
use crate::color::{Rgb, Split};
use crate::sampling::warp::{cosine_hemisphere, cosine_hemisphere_pdf};

/// `f = albedo / π` when both directions are above the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Diffuse {
    /// Reflected fraction per channel, in `[0, 1]`.
    pub albedo: Rgb,
}

impl Diffuse {
    /// Draws `wi` with density `cos θ / π`; cosine and π cancel, so the weight is the albedo.
    pub fn sample(&self, wo: Vec3, u: Vec2) -> Option<BsdfSample> {
        let wi = cosine_hemisphere(u);
        (wo.z > 0.0 && wi.z > 0.0).then(|| BsdfSample {
            wi,
            weight: Split::diffuse(self.albedo),
            pdf: cosine_hemisphere_pdf(wi),
            delta: false,
            eta: 1.0,
        })
    }

    /// `f · cos θi`, and the density with which [`sample`](Self::sample) draws `wi`.
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> BsdfEval {
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return BsdfEval::ZERO;
        }
        let pdf = cosine_hemisphere_pdf(wi);
        BsdfEval { f_cos: Split::diffuse(self.albedo * pdf), pdf }
    }
}
