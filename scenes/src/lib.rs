//! Scenes as plain data, and the readers that make them from files.
//!
//! [`Scene`] is what every reader produces and what the renderer takes: no file format shows
//! in it, and no acceleration structure or sampling table either. Transforms are `f64`, so
//! that a scene far from its origin keeps its digits until the renderer has moved it to the camera.

mod error;
mod load;
mod scene;

pub use error::SceneError;
pub use load::{LoadOptions, load, load_str};
pub use scene::*;
