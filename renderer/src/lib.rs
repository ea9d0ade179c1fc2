//! A path tracer: a scene becomes a frame.

// The order is that of a path: from the camera to the film.
mod bsdf;
mod color;
mod light;
mod sampling;
mod settings;
mod texture;

pub use settings::{Sampler, Settings};
