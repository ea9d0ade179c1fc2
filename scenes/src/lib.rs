//! Scenes as plain data, and the readers that make them from files.
//!
//! [`Scene`] is what every reader produces and what the renderer takes: no file format shows
//! in it, and no acceleration structure or sampling table either. Transforms are `f64`, so
//! that a scene far from its origin keeps its digits until the renderer has moved it to the camera.
//!
//! [`load()`] reads a file, [`load_str`] a text. A file is Mitsuba XML of versions 0.x and 2 to 3, glTF 2.0
//! (text or binary) or OBJ with MTL; a text is Mitsuba XML. What a file
//! says and limpid cannot honour is among the scene's [`warnings`](Scene::warnings), each with its place; what makes
//! no scene is a [`SceneError`]. No input makes the readers panic, hang, or take memory beyond a constant times its size.
//!
//! ```
//! use std::path::Path;
//!
//! let xml = r#"<scene version="3.0.0">
//!     <default name="grey" value="0.8"/>
//!     <shape type="sphere" id="ball">
//!         <float name="radius" value="2"/>
//!         <bsdf type="diffuse"><rgb name="reflectance" value="$grey"/></bsdf>
//!     </shape>
//!     <emitter type="constant"/>
//! </scene>"#;
//! let scene = limpid_scenes::load_str(xml, Path::new("."), &Default::default())?;
//! assert_eq!(scene.shapes[0].name, "ball");
//! assert_eq!(scene.cameras.len(), 1); // the file has none: a default stands in, with a warning
//! assert!(scene.warnings[0].message.contains("no sensor"));
//! # Ok::<(), limpid_scenes::SceneError>(())
//! ```

mod as_mitsuba;
mod cameras;
mod coat;
mod daylight;
mod error;
mod export;
mod files;
mod gltf;
mod gltf_in_mitsuba;
mod gltf_material;
mod ies;
mod image;
mod lights;
mod load;
mod materials;
mod mesh;
mod mitsuba;
mod nearest;
mod obj;
mod principled;
mod scene;
mod shapes;
mod spectrum;
mod standins;
#[cfg(test)]
mod testing;
mod textures;

pub use as_mitsuba::as_mitsuba;
pub use cameras::*;
pub use coat::Coat;
pub use daylight::{Daylight, SkyRadiance};
pub use error::SceneError;
pub use export::{ExportError, Exported, export_mitsuba};
pub use gltf_material::GltfMaterial;
pub use ies::IesProfile;
pub use lights::*;
pub use load::{LoadOptions, load, load_str};
pub use materials::*;
pub use principled::{Principled, PrincipledThin};
pub use scene::*;
pub use shapes::*;
pub use textures::*;
