mod errors;
mod geometry;
mod hostile;
mod looks;

use std::path::Path;

use super::read;
use crate::files::Files;
use crate::{Scene, SceneError, ShapeKind};

/// Reads a JSON text in which `BUFFER` stands for a data URI of `bytes`, and `LENGTH` for their number.
fn try_read(json: &str, bytes: &[u8]) -> Result<Scene, SceneError> {
    let uri = format!("data:application/octet-stream;base64,{}", base64(bytes));
    let json = json.replace("BUFFER", &uri).replace("LENGTH", &bytes.len().to_string());
    read(json.into_bytes(), Path::new("m.gltf"), Files::default())
}

fn loaded(json: &str, bytes: &[u8]) -> Scene {
    try_read(json, bytes).unwrap_or_else(|error| panic!("{error}"))
}

fn refused(json: &str, bytes: &[u8]) -> SceneError {
    try_read(json, bytes).map(|scene| scene.shapes.len()).unwrap_err()
}

fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let digits = |chunk: &[u8]| {
        let bits = (0..3).fold(0u32, |bits, i| bits << 8 | u32::from(chunk.get(i).copied().unwrap_or(0)));
        (0..=chunk.len())
            .map(move |i| DIGITS[(bits >> (18 - 6 * i) & 63) as usize] as char)
            .collect::<Vec<_>>()
    };
    bytes.chunks(3).flat_map(digits).collect()
}

/// Little-endian bytes of numbers.
fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

/// Positions of a unit square in z = 0, whose first three corners run counter-clockwise, and texture coordinates.
fn square() -> Vec<u8> {
    let positions = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0];
    let uvs = [0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0];
    let mut bytes = floats(&positions);
    bytes.extend(floats(&uvs));
    bytes.extend([0u16, 1, 2, 0, 2, 3].iter().flat_map(|i| i.to_le_bytes()));
    bytes
}

/// A file that shows [`square`] at one node; `primitive` and `rest` are spliced into the primitive and the root, and
/// what they give comes first.
fn with_square(primitive: &str, rest: &str) -> String {
    format!(
        r#"{{"asset": {{"version": "2.0"}},
        "buffers": [{{"uri": "BUFFER", "byteLength": LENGTH}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 48}}, {{"buffer": 0, "byteOffset": 48, "byteLength": 32}},
                        {{"buffer": 0, "byteOffset": 80, "byteLength": 12}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4}},
                      {{"bufferView": 1, "componentType": 5126, "type": "VEC2", "count": 4}},
                      {{"bufferView": 2, "componentType": 5123, "type": "SCALAR", "count": 6}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0, "TEXCOORD_0": 1}}, "indices": 2 {primitive}}}]}}],
        "nodes": [{{"mesh": 0}}] {rest}}}"#
    )
}

/// World-space corners of the triangles of a shape.
fn corners(scene: &Scene, shape: usize) -> Vec<[glam::DVec3; 3]> {
    let shape = &scene.shapes[shape];
    let ShapeKind::Mesh(mesh) = &shape.kind else { panic!("a mesh") };
    let world = |i: u32| {
        let p = mesh.positions[i as usize].map(f64::from);
        shape.world_from_object.transform_point3(p.into())
    };
    mesh.triangles.iter().map(|t| t.map(world)).collect()
}

fn messages(scene: &Scene) -> Vec<String> {
    scene.warnings.iter().map(|w| format!("{}: {}", w.element, w.message)).collect()
}
