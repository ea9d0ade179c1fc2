//! Statistical test tools: does a sampling routine follow its density ([`chi2`]), what does it scatter on the mean
//! ([`furnace`]), do two pictures differ by more than their noise ([`image`])? And small [`scene`]s as plain data.
//!
//! All are deterministic. A test that compares random numbers with a truth fails by chance with the probability
//! [`FALSE_ALARM`] if its seed were drawn anew; with the fixed seed it passes always or never.

mod cells;
pub mod chi2;
pub mod furnace;
pub mod image;
mod rng;
pub mod scene;

pub use chi2::{assert_chi2, assert_chi2_discrete, assert_chi2_lobes, assert_chi2_square};
pub use furnace::furnace;
pub use image::{assert_same_image, compare_images};
pub use rng::Rng;

/// Probability with which one test rejects what is right: a hundred tests reject one right thing in a hundred seeds
/// (1 − (1 − 1e-4)¹⁰⁰, Šidák).
pub const FALSE_ALARM: f64 = 1e-4;
