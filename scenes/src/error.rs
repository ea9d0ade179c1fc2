//! What can be wrong with a scene, and where.

use std::fmt;
use std::path::PathBuf;

use crate::Place;

/// What is wrong in a scene file, where, and what would mend it.
///
/// It shows as two lines:
///
/// ```text
/// box/scene.xml:41:18: bsdf "floor": unknown type "difuse"
///   = help: did you mean "diffuse"? known types: diffuse, …
/// ```
///
/// A format without lines shows `file: byte N: …`, and a file that could not be opened `file: …`.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub struct SceneError {
    /// As the user gave it or as the naming file led to it, not canonicalised.
    pub file: PathBuf,
    /// Counted from 1; 0 where the format has no lines.
    pub line: u32,
    /// Counted from 1, in characters; the byte offset where the format has no lines.
    pub column: u32,
    /// What the user would search for: `bsdf "floor"`, `mesh`.
    pub element: String,
    /// One clause, lower case, no full stop; quotes the offending text.
    pub problem: String,
    /// An instruction, never the problem said again.
    pub help: String,
}

impl SceneError {
    /// An error at a place in a scene file.
    pub fn at(place: &Place, element: &str, problem: impl Into<String>, help: impl Into<String>) -> Self {
        Self {
            file: place.file.as_ref().clone(),
            line: place.line,
            column: place.column,
            element: element.into(),
            problem: problem.into(),
            help: help.into(),
        }
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:", self.file.display())?;
        match (self.line, self.column) {
            (0, 0) => {}
            (0, byte) => write!(f, " byte {byte}:")?,
            (line, column) => write!(f, "{line}:{column}:")?,
        }
        write!(f, " {}: {}\n  = help: {}", self.element, self.problem, self.help)
    }
}
