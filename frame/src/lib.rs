//! A picture with everything a denoiser can use beside it: the contract between renderer and denoiser.

mod frame;
mod layer;

pub use frame::Frame;
pub use layer::{Layer, LayerRequest, Statistic};
