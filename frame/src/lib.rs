//! A picture with everything a denoiser can use beside it: the contract between renderer and denoiser.
//!
//! A [`Frame`] is a set of named planes of `f32`, row-major from the top left. The names are those of the
//! channels in its EXR file; [`Layer`] knows the ones that limpid makes, and others pass through.
//!
//! | layer | channels | what a pixel holds |
//! |---|---|---|
//! | beauty | `R` `G` `B` | mean radiance, W·sr⁻¹·m⁻² per channel, linear Rec. 709 |
//! | alpha | `A` | share of what is there; the beauty is multiplied by it already |
//! | diffuse, specular | `diffuse.R` … | the part that left the first non-delta vertex through the diffuse, the specular part of its BSDF |
//! | emission | `emission.R` … | lights and background seen directly or in mirrors and glass; the three add up to the beauty |
//! | albedo | `albedo.R` … | reflectance at the feature hit, 1 for background and pure delta |
//! | diffuse_albedo | `diffuse_albedo.R` … | of the diffuse lobe alone, tinted by the mirrors before it |
//! | normal | `normal.X` … | shading normal in world space, averaged, not renormalised; 0 for background |
//! | position | `position.X` … | of the feature hit, relative to the origin in the metadata |
//! | depth | `depth.Z` | mean distance of the first hit over the samples that hit |
//! | hit | `hit.V` | share of the samples that hit |
//! | roughness | `roughness.V` | at the feature hit: 1 diffuse, 0 background |
//! | visibility | `visibility.V` | unoccluded share of the light samples at the feature hit |
//! | offset | `offset.X` `offset.Y` | mean sample position from the pixel's centre, in pixels |
//! | id | `id.object` `id.material` | of the first sample's first hit, −1 for background |
//! | samples | `samples.N` | number of samples |
//!
//! The *feature hit* is the first vertex that is not a perfect mirror or glass. Each layer but the last three
//! can also have its `variance` (of the mean, −1 where unknown) and the means of its two halves of the
//! samples, `a` and `b`: `diffuse.variance.R`, `normal.a.X`, and plain `variance.R` and `a.R` of the beauty.
//! The halves are independent, so that (a − b)²/4 tells the error of the mean: [`estimate_relmse`].
//!
//! ```
//! use limpid_frame::{Frame, metrics, read_exr, write_exr};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let mut frame = Frame::new(2, 1);
//! for name in ["R", "G", "B"] {
//!     frame.insert(name, vec![0.5, 1.0]);
//! }
//! frame.metadata.insert("limpid:spp".into(), "64".into());
//!
//! let folder = tempfile::tempdir()?;
//! let path = folder.path().join("picture.exr");
//! write_exr(&frame, &path)?;
//! let read = read_exr(&path)?;
//! assert_eq!(read, frame);
//!
//! let m = metrics(&read, &frame)?;
//! assert_eq!((m.mse, m.psnr), (0.0, None)); // None: infinitely good
//! # Ok(())
//! # }
//! ```
//!
//! Files appear whole or not at all ([`write_whole`]), and the same content is the same bytes. Errors name
//! the file, and say whose fault they are ([`FrameError::fault`]).

pub mod compare;
mod error;
mod estimate;
mod exr;
mod frame;
mod layer;
mod metrics;
mod png;
mod records;
mod request;
pub use request::nearest_first;
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
pub use whole::{discard_unfinished, without_name, write_whole};
