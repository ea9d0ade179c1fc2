//! A picture with everything a denoiser can use beside it: the contract between renderer and denoiser.

mod error;
mod estimate;
mod exr;
mod frame;
mod layer;
mod metrics;
mod png;
mod records;
mod request;
pub mod stats;
#[cfg(test)]
mod testing;
mod whole;

pub use error::{Fault, FrameError};
pub use estimate::{ErrorEstimate, estimate_relmse};
pub use exr::{read_exr, write_exr, write_exr_half};
pub use frame::Frame;
pub use layer::{Layer, LayerRequest, Statistic};
pub use metrics::{Metrics, metrics};
pub use png::{display_transform, write_beauty_png, write_png};
pub use records::{RecordTile, SampleRecord};
pub use whole::write_whole;
