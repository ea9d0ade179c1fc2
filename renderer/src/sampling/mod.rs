//! Random numbers and what is drawn with them.

pub mod warp;
