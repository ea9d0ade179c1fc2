//! Random numbers and what is drawn with them.

mod distribution;
mod pixel_filter;
mod sampler;
mod sobol;
pub mod warp;

pub use distribution::{Distribution1d, Distribution2d};
pub use pixel_filter::{PixelFilterSampler, Splat};
pub use sampler::{Dim, PixelSampler};
