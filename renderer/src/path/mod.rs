//! The integrator: unidirectional path tracing with next-event estimation, multiple importance sampling and
//! Russian roulette, over batches of paths.
//!
//! ```text
//! generate → [ extend → (absorb) → emit → shade → connect → survive ]* → accumulate
//! ```
//!
//! Each stage is a plain function over the batch around a core for one path; [`depth_first`] drives the same cores one
//! path at a time and is what the tests compare with. Queues stay in pixel order: the order of rays is worth more
//! than that of materials.

mod absorb;
mod batch;
mod connect;
mod emit;
mod generate;
mod shade;
mod survive;

use glam::Vec3;

#[cfg(test)]
pub use batch::depth_first;
pub use batch::{Batch, accumulate, trace};
pub use shade::Scattering;

use absorb::Inside;

use crate::accel::Ray;
use crate::camera::Camera;
use crate::color::{Rgb, Split};
use crate::prepare::Prepared;
use crate::sampling::{PixelFilterSampler, PixelSampler};
use crate::settings::Settings;

/// What all paths of a render share.
pub struct Context<'a> {
    pub scene: &'a Prepared,
    pub camera: Camera,
    pub filter: PixelFilterSampler,
    pub settings: &'a Settings,
    /// Something beyond radiance is asked for.
    pub features: bool,
}

/// A path on its way: what outlives a stage.
#[derive(Clone, Copy, Debug)]
pub struct Path {
    /// Its random numbers.
    pub sampler: PixelSampler,
    /// Throughput Π f · cos / pdf, roulette included. Before the first non-delta vertex it is whole in `specular`; from
    /// there on it is split by the lobe that was taken *at that vertex*.
    pub beta: Split,
    /// Radiance gathered after the first non-delta vertex, by its lobe.
    pub scattered: Split,
    /// Radiance gathered before it.
    pub emission: Rgb,
    /// The last vertex: where the current ray starts, in render space.
    pub p: Vec3,
    /// Density per steradian with which the current direction was drawn.
    pub pdf: f32,
    /// Edges so far, the current ray included.
    pub edges: u32,
    /// Π η² over refractions: what radiance gained by them and will lose again.
    pub eta_scale: f32,
    /// The current direction was drawn from a delta lobe, or is the camera's: no light sample stands for it.
    pub delta: bool,
    /// What the current ray goes through.
    pub inside: Inside,
    /// A non-delta vertex has been met.
    pub split: bool,
    /// The last event let the path go straight on: a hole in a surface, which counts as no vertex.
    pub straight: bool,
    /// Something is seen: a surface that is there, or the background. The sample's alpha.
    pub present: bool,
    /// A surface has been met that was there, and is in the features.
    pub met: bool,
    /// The feature hit has been met.
    pub feature_done: bool,
    /// A contribution was not finite and was replaced by 0.
    pub rejected: bool,
    /// Weight of the pixel filter: ±a constant.
    pub weight: f32,
}

impl Path {
    /// Adds radiance that arrives along the path; `through` is the throughput up to and including its last vertex.
    #[inline]
    fn gather(&mut self, through: Split, radiance: Rgb) {
        let gained = through * radiance;
        if !gained.total().is_finite() {
            self.rejected = true;
        } else if self.split {
            self.scattered += gained;
        } else {
            self.emission += gained.specular;
        }
    }
}

/// A light sample that waits for its visibility.
#[derive(Clone, Copy, Debug)]
pub struct Connection {
    /// Towards the light.
    pub ray: Ray,
    /// Throughput to the vertex, times f · cos / pdf and the MIS weight.
    pub through: Split,
    /// Emitted towards the vertex; what is absorbed beyond the distance `from` is still in it.
    pub radiance: Rgb,
    /// What the ray goes through from the distance `from` on.
    pub inside: Inside,
    pub from: f32,
    /// Of the path that ends at the light.
    pub edges: u32,
    /// The vertex is the feature hit.
    pub at_feature: bool,
}

/// Weight of a strategy with density `pdf` beside one with density `other`, by the power heuristic with exponent 2
/// (Veach 1997), in the form that no density can overflow.
#[inline]
fn mis_weight(pdf: f32, other: f32) -> f32 {
    let ratio = other / pdf;
    1.0 / (1.0 + ratio * ratio)
}

#[cfg(test)]
mod tests;
