//! A path tracer: a scene becomes a frame.
//!
//! [`Prepared::new`] moves a scene into the space of its camera and builds what the rays need; [`render`] makes a
//! frame of it. Nothing here reads or writes files.
//!
//! Features, both off: `bench` opens the ray queries to `benches/traversal.rs`; `embree` puts Embree's library beside
//! them there. No feature changes a picture.

mod accel;
#[cfg(feature = "bench")]
#[doc(hidden)]
pub mod bench;
mod bsdf;
mod camera;
mod color;
mod effects;
#[cfg(feature = "embree")]
mod embree;
mod film;
mod geometry;
mod light;
mod material;
mod path;
mod prepare;
mod render;
mod sampling;
mod settings;
#[cfg(test)]
mod testing;
mod texture;

pub use effects::{Called, Counters, Effect, effects};
pub use film::Sample;
pub use prepare::{PrepareError, Prepared, WorldHit, WorldRay, WorldScatter};
pub use render::{Progress, Recorder, Rendered, TileSamples, render};
pub use sampling::Splat;
pub use settings::{Sampler, Settings};
