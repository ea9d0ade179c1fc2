//! Statistical test tools.

pub mod scene;
