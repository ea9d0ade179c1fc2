//! Statistical test tools: do draws follow their density, is energy kept, are two pictures the same but for noise.
//!
//! Every test here draws from fixed seeds, so it passes or fails always alike; its false-alarm rate is the chance
//! that a *new* right implementation would be called wrong.

mod chi2;
mod furnace;
mod picture;
mod random;
pub mod scene;

pub use chi2::{Chi2, assert_chi2, assert_chi2_1d, assert_chi2_2d, chi2, chi2_2d};
pub use furnace::furnace;
pub use picture::{Estimate, PictureTest, assert_same_picture, compare_pictures};
pub use random::Random;
