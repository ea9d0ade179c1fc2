//! Values of vertices and faces beside their form.

use super::Note;
use crate::{AttributeDomain, MeshAttribute};

/// Gives each triangle the values of the face that it was cut from; `faces` as in [`RawMesh`](super::raw::RawMesh).
pub(super) fn of_triangles(attributes: &mut [MeshAttribute], faces: &[u32]) {
    if faces.is_empty() {
        return; // every face is a triangle
    }
    for attribute in attributes.iter_mut().filter(|a| a.domain == AttributeDomain::Face) {
        let channels = attribute.channels as usize;
        let of_face = |face: &u32| {
            let start = (*face as usize - 1) * channels;
            attribute.values[start..start + channels].iter().copied()
        };
        attribute.values = faces.iter().flat_map(of_face).collect();
    }
}

/// Puts 0 for what is no number.
pub(super) fn make_finite(attributes: &mut [MeshAttribute], notes: &mut Vec<Note>) {
    for attribute in attributes {
        let bad = attribute.values.iter_mut().filter(|v| !v.is_finite()).map(|v| *v = 0.0).count();
        if bad > 0 {
            let message = format!("{bad} values of {} are not finite; 0 stands in", attribute.name);
            notes.push(Note { line: 0, message });
        }
    }
}

/// Keeps the values of the vertices or triangles that `keep` marks.
pub(super) fn retain(attributes: &mut [MeshAttribute], domain: AttributeDomain, keep: &[bool]) {
    for attribute in attributes.iter_mut().filter(|a| a.domain == domain) {
        let channels = attribute.channels as usize;
        let mut marks = keep.iter().flat_map(|mark| std::iter::repeat_n(mark, channels));
        attribute.values.retain(|_| marks.next().is_some_and(|mark| *mark));
    }
}
