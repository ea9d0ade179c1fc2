//! Denoisers: a [`Frame`] becomes a cleaner frame.
//!
//! A picture of any renderer can be denoised in memory. Two halves of the samples and the guides make
//! the difference; variance helps too, and each can be left out:
//!
//! ```
//! use limpid_denoise::{Buffers, JointNlm, denoise_buffers};
//!
//! let (width, height) = (64, 48);
//! // A grey wall of radiance 0.5, lit by few samples: two halves whose noise is independent.
//! let noise = |seed: u32| -> Vec<f32> {
//!     (0..width * height * 3)
//!         .map(|i| {
//!             let hash = (i as u32 ^ seed.wrapping_mul(0x9e37_79b9)).wrapping_mul(0x85eb_ca6b);
//!             0.5 + 0.2 * ((hash ^ hash >> 15).wrapping_mul(0xc2b2_ae35) as f32 / u32::MAX as f32 - 0.5)
//!         })
//!         .collect()
//! };
//! let (a, b) = (noise(1), noise(2));
//! let color: Vec<f32> = a.iter().zip(&b).map(|(a, b)| 0.5 * (a + b)).collect();
//! let albedo = vec![0.6; color.len()];
//! let normal = [0.0, 0.0, 1.0].repeat(width * height);
//!
//! let denoised = denoise_buffers(
//!     &JointNlm::default(),
//!     &Buffers {
//!         width,
//!         height,
//!         color: &color,
//!         albedo: Some(&albedo),
//!         normal: Some(&normal),
//!         halves: Some([&a, &b]),
//!         ..Buffers::default()
//!     },
//! )?;
//!
//! let error = |x: &[f32]| x.iter().map(|v| (v - 0.5).powi(2)).sum::<f32>();
//! assert!(error(&denoised) < 0.1 * error(&color));
//! # Ok::<(), limpid_denoise::DenoiseError>(())
//! ```
//!
//! [`methods`] lists what there is, [`by_name`] finds one, and [`Method::configure`] sets its parameters.
//! `filter/` holds the methods without training, a file each; `wrap/` what goes around them: components,
//! noise levels, prefiltered features, repair of what is not finite.
//!
//! What all methods keep: the answer does not depend on the number of threads, no input makes a pixel that is not
//! finite, and a picture multiplied by a power of two gives the same picture multiplied by it.

mod buffers;
mod error;
mod exp;
pub mod filter;
mod method;
mod plane;
mod wrap;

use limpid_frame::{Frame, LayerRequest};

pub use buffers::{Buffers, denoise_buffers};
pub use error::DenoiseError;
pub use filter::JointNlm;
pub use method::{Kind, Method, Parameter, by_name, methods};

/// Takes the noise out of a picture.
pub trait Denoiser: Send + Sync {
    /// As the table of [`methods`] names it.
    fn name(&self) -> &'static str;

    /// The layers that it reads: what a renderer has to write for it to do its best.
    fn needs(&self) -> LayerRequest;

    /// A frame whose `R G B` are denoised, and so are those of its components that the method filters by
    /// themselves. The noisy picture is kept as `noisy.R`, `noisy.G` and `noisy.B`, every other channel as it is.
    /// Method and parameters stand in the metadata under `limpid:denoise`, with what had to be done without.
    ///
    /// # Errors
    ///
    /// If the frame lacks a layer without which the method cannot work.
    fn denoise(&self, frame: &Frame) -> Result<Frame, DenoiseError>;
}
