//! Triangle meshes from files.

pub(crate) mod obj;
pub(crate) mod ply;
pub(crate) mod serialized;

mod attributes;
mod normals;
mod polygon;
mod raw;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DVec3;

pub(crate) use self::raw::{Positions, RawMesh};
use crate::{Mesh, SceneError};

/// What a scene says about how a mesh file is to be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct MeshOptions {
    /// Texture coordinates become (u, 1 − v).
    pub flip_tex_coords: bool,
    /// Flat faces: the file's normals are dropped and none are computed.
    pub face_normals: bool,
}

/// A mesh as a file holds it.
#[derive(Clone, Debug)]
pub(crate) struct LoadedMesh {
    pub mesh: Arc<Mesh>,
    /// What was subtracted from all vertices so that `f32` keeps their digits; to be added back by the transform.
    pub offset: DVec3,
    /// What the file says and the mesh does not.
    pub notes: Vec<Note>,
}

/// A remark about a mesh file. The line is 0 where the format has none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Note {
    pub line: u32,
    pub message: String,
}

/// An error in a mesh file. `line` and `column` as in [`SceneError`].
fn mesh_error(file: &Path, line: u32, column: u32, problem: impl Into<String>, help: &str) -> SceneError {
    SceneError {
        file: PathBuf::from(file),
        line,
        column,
        element: "mesh".into(),
        problem: problem.into(),
        help: help.into(),
    }
}
