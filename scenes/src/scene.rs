//! The scene as plain data. Its parts are in `cameras`, `shapes`, `materials`, `textures` and `lights`.
//!
//! Conventions, whatever the file format was:
//! - right-handed world space; `world_from_object * p_object` with column vectors;
//! - a camera looks along its local +z with +y up, so +x points to the *left* of the picture;
//! - colours are linear Rec. 709; lengths are the file's own unit; angles are degrees where the name says so;
//! - row 0 of an [`Image`](crate::Image) is the top row of its file and lies at v = 0.

use std::path::PathBuf;
use std::sync::Arc;

use crate::{Camera, Group, Light, Material, Shape, Texture};

/// Linear Rec. 709 colour.
pub type Rgb = [f32; 3];

/// Where in its file something was said, so that a later error can point at it.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Place {
    /// As the user gave it or as the including file names it; not canonicalised.
    pub file: Arc<PathBuf>,
    /// Counted from 1; 0 where the format has no lines.
    pub line: u32,
    /// Counted from 1, in characters; the byte offset where the format has no lines.
    pub column: u32,
}

/// A scene: cameras, shapes, what they are made of, and lights.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// The file that was read, as the user gave it.
    pub file: PathBuf,
    /// SHA-256 over the contents of every file that was read, in reading order, as hexadecimal digits.
    pub content_hash: String,
    /// At least one after a reader: a file without a camera gets a stated default.
    pub cameras: Vec<Camera>,
    /// How light is to be transported.
    pub integrator: Integrator,
    /// In the order of the file: a shape's index is its `id.object`.
    pub shapes: Vec<Shape>,
    /// Shapes that are seen where an instance shows them; indexed by [`GroupId`].
    pub groups: Vec<Group>,
    /// Indexed by [`MaterialId`], which is also `id.material`.
    pub materials: Vec<Material>,
    /// Indexed by [`TextureId`].
    pub textures: Vec<Texture>,
    /// Lights that are not the surface of a shape.
    pub lights: Vec<Light>,
    /// Indexed by [`MediumId`].
    pub media: Vec<Medium>,
    /// What was said in the file and could not be honoured, in file order.
    pub warnings: Vec<Warning>,
}

/// Something in a file that was left out or replaced, and by what.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// Where it stands.
    pub place: Place,
    /// What it is about, as the user would search for it: `bsdf "floor"`.
    pub element: String,
    /// One clause: what is not honoured and what happens in its place.
    pub message: String,
    /// An unused parameter, which `--strict` turns into an error.
    pub unused_parameter: bool,
}

/// Index into [`Scene::materials`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct MaterialId(pub u32);

/// Index into [`Scene::textures`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct TextureId(pub u32);

/// Index into [`Scene::groups`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct GroupId(pub u32);

/// Index into [`Scene::media`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct MediumId(pub u32);

/// How light is transported.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Integrator {
    /// The file's word: `path`, `direct`, …; whatever it is, paths are traced.
    pub kind: String,
    /// Longest path in edges: 1 shows lights only, 2 direct light; unlimited where absent.
    pub max_depth: Option<u32>,
    /// Depth from which Russian roulette may end a path.
    pub rr_depth: u32,
    /// Lights and background are not seen directly by the camera.
    pub hide_emitters: bool,
    /// What is asked for beside the colours, each once.
    pub aovs: Vec<Aov>,
}

/// A quantity at the hit that a file asks for beside the colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aov {
    /// Reflectance.
    Albedo,
    /// Distance from the camera.
    Depth,
    /// In world space.
    Position,
    /// Shading normal, in world space.
    ShadingNormal,
    /// Index of the shape.
    ShapeIndex,
}

impl Default for Integrator {
    /// Mitsuba's `path`.
    fn default() -> Self {
        Self { kind: "path".into(), max_depth: None, rr_depth: 5, hide_emitters: false, aovs: Vec::new() }
    }
}

/// A participating medium. It is read, and refused by the renderer.
#[derive(Clone, Debug)]
pub struct Medium {
    /// The file's id, or its kind and a number.
    pub name: String,
    /// The file's word.
    pub kind: String,
    /// Where it stands.
    pub place: Place,
}
