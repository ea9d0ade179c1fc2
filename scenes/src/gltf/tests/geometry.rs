//! Meshes, nodes, skins, morph targets.

use std::sync::Arc;

use glam::DVec3;

use super::*;

#[test]
fn a_square_is_two_flat_triangles_with_the_texture_coordinates_of_the_file() {
    let scene = loaded(&with_square("", ""), &square());
    let ShapeKind::Mesh(mesh) = &scene.shapes[0].kind else { panic!("a mesh") };
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
    assert!(mesh.normals.is_empty());
    assert_eq!(mesh.uvs, [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]]);
}

#[test]
fn strips_and_fans_keep_the_orientation_of_their_first_triangle() {
    for mode in [5, 6] {
        // without indices: corners in their order
        let json = with_square(&format!(r#", "mode": {mode}"#), "").replace(r#""indices": 2"#, r#""x": 0"#);
        let scene = loaded(&json, &square());
        let triangles = corners(&scene, 0);
        assert_eq!(triangles.len(), 2);
        let normal = |t: &[DVec3; 3]| (t[1] - t[0]).cross(t[2] - t[0]);
        assert!(normal(&triangles[0]).z > 0.0, "mode {mode}");
    }
    let strip = super::super::primitives::triangles_of(5, &[0, 1, 2, 3, 4]);
    assert_eq!(strip, [[0, 1, 2], [2, 1, 3], [2, 3, 4]]);
    let fan = super::super::primitives::triangles_of(6, &[0, 1, 2, 3]);
    assert_eq!(fan, [[0, 1, 2], [0, 2, 3]]);
}

#[test]
fn points_and_lines_are_left_out_with_a_warning() {
    for (mode, word) in [(0, "points"), (1, "lines"), (3, "lines")] {
        let scene = loaded(&with_square(&format!(r#", "mode": {mode}"#), ""), &square());
        assert!(scene.shapes.is_empty());
        assert!(messages(&scene)[0].contains(word), "{:?}", messages(&scene));
    }
}

#[test]
fn places_of_nodes_multiply_and_their_rotation_is_a_quaternion() {
    let half = 0.5f64.sqrt();
    let nodes = format!(
        r#", "scene": 0, "scenes": [{{"nodes": [1]}}], "nodes": [
        {{"mesh": 0, "scale": [2, 2, 2]}},
        {{"children": [0], "translation": [10, 0, 0], "rotation": [0, 0, {half}, {half}]}}]"#
    );
    let json = with_square("", &nodes).replacen(r#""nodes": [{"mesh": 0}]"#, r#""x": 0"#, 1);
    let scene = loaded(&json, &square());
    // (1, 0, 0), doubled, turned a quarter round z, moved
    let p = corners(&scene, 0)[0][1];
    assert!(p.distance(DVec3::new(10.0, 2.0, 0.0)) < 1e-12, "{p}");
}

#[test]
fn a_matrix_is_written_column_after_column() {
    let nodes = r#", "nodes": [{"mesh": 0, "matrix": [0,1,0,0, -1,0,0,0, 0,0,1,0, 5,6,7,1]}]"#;
    let json = with_square("", nodes).replacen(r#""nodes": [{"mesh": 0}]"#, r#""x": 0"#, 1);
    let p = corners(&loaded(&json, &square()), 0)[0][1];
    assert_eq!(p, DVec3::new(5.0, 7.0, 7.0));
}

#[test]
fn nodes_that_show_the_same_mesh_share_it() {
    let json = with_square("", "").replace(r#"[{"mesh": 0}]"#, r#"[{"mesh": 0}, {"mesh": 0}, {"mesh": 0}]"#);
    let scene = loaded(&json, &square());
    let mesh = |i: usize| match &scene.shapes[i].kind {
        ShapeKind::Mesh(mesh) => Arc::as_ptr(mesh),
        _ => panic!("a mesh"),
    };
    assert_eq!((mesh(0), mesh(0)), (mesh(1), mesh(2)));
}

#[test]
fn the_default_scene_is_shown_and_the_others_are_named() {
    let rest = r#", "scene": 1, "scenes": [{"name": "left", "nodes": [1]}, {"name": "right", "nodes": [0]}]"#;
    let json = with_square("", rest)
        .replace(r#"[{"mesh": 0}]"#, r#"[{"mesh": 0, "name": "a"}, {"mesh": 0, "name": "b"}]"#);
    let scene = loaded(&json, &square());
    assert_eq!(scene.shapes.iter().map(|s| s.name.as_str()).collect::<Vec<_>>(), ["a"]);
    assert!(messages(&scene)[0].contains("\"left\""), "{:?}", messages(&scene));
}

#[test]
fn nodes_in_a_circle_are_left_out_and_nodes_with_two_parents_are_shown_once() {
    let circle = r#"[{"mesh": 0, "children": [1]}, {"children": [0]}, {"mesh": 0, "name": "free"}]"#;
    let json = with_square("", r#", "scenes": [{"nodes": [0, 2]}]"#).replace(r#"[{"mesh": 0}]"#, circle);
    let scene = loaded(&json, &square());
    assert_eq!(scene.shapes.len(), 1);
    assert!(messages(&scene).iter().any(|m| m.contains("below itself")), "{:?}", messages(&scene));
    let shared = r#"[{"children": [2]}, {"children": [2]}, {"mesh": 0}]"#;
    let scene = loaded(&with_square("", "").replace(r#"[{"mesh": 0}]"#, shared), &square());
    assert_eq!(scene.shapes.len(), 1);
}

#[test]
fn vertices_that_no_triangle_uses_are_dropped() {
    let json =
        with_square("", "").replace(r#""type": "SCALAR", "count": 6"#, r#""type": "SCALAR", "count": 3"#);
    let scene = loaded(&json, &square());
    let ShapeKind::Mesh(mesh) = &scene.shapes[0].kind else { panic!("a mesh") };
    assert_eq!((mesh.positions.len(), mesh.uvs.len(), &mesh.triangles[..]), (3, 3, &[[0, 1, 2]][..]));
}

#[test]
fn sparse_values_replace_those_of_the_buffer() {
    let mut bytes = square();
    bytes.extend([2u8, 0, 0, 0]); // vertex 2
    bytes.extend(floats(&[5.0, 6.0, 7.0]));
    let sparse = r#""count": 4, "sparse": {"count": 1,
        "indices": {"bufferView": 3, "componentType": 5121}, "values": {"bufferView": 4}}}"#;
    let json = with_square("", "")
        .replacen(r#""count": 4}"#, sparse, 1)
        .replace(
            r#""byteLength": 12}]"#,
            r#""byteLength": 12}, {"buffer": 0, "byteOffset": 92, "byteLength": 1}, {"buffer": 0, "byteOffset": 96, "byteLength": 12}]"#,
        );
    let p = corners(&loaded(&json, &bytes), 0)[0][2];
    assert_eq!(p, DVec3::new(5.0, 6.0, 7.0));
}

#[test]
fn normalized_integers_span_minus_one_to_one() {
    let mut bytes = vec![0u8, 0, 0, 127, 0, 0, 128, 129, 0]; // as signed bytes: 0 0 0, 127 0 0, -128 -127 0
    bytes.resize(12, 0);
    let json = r#"{"asset": {"version": "2.0"}, "buffers": [{"uri": "BUFFER", "byteLength": LENGTH}],
        "bufferViews": [{"buffer": 0, "byteLength": 9}],
        "accessors": [{"bufferView": 0, "componentType": 5120, "normalized": true, "type": "VEC3", "count": 3}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "nodes": [{"mesh": 0}]}"#;
    let [t] = corners(&loaded(json, &bytes), 0)[..] else { panic!("one triangle") };
    assert_eq!(t, [DVec3::ZERO, DVec3::X, DVec3::new(-1.0, -1.0, 0.0)]);
}

#[test]
fn morph_targets_count_with_the_weights_of_the_node_or_else_of_the_mesh() {
    let mut bytes = square();
    bytes.extend(floats(&[0.0, 0.0, 8.0].repeat(4)));
    let targets = r#", "targets": [{"POSITION": 3}]"#;
    let base = with_square(targets, "")
        .replace(r#""byteLength": 12}]"#, r#""byteLength": 12}, {"buffer": 0, "byteOffset": 92, "byteLength": 48}]"#)
        .replace(r#""type": "SCALAR", "count": 6}"#, r#""type": "SCALAR", "count": 6}, {"bufferView": 3, "componentType": 5126, "type": "VEC3", "count": 4}"#)
        .replace(r#""meshes": [{"#, r#""meshes": [{"weights": [0.5], "#);
    assert_eq!(corners(&loaded(&base, &bytes), 0)[0][0].z, 4.0);
    let json = base.replace(r#"[{"mesh": 0}]"#, r#"[{"mesh": 0, "weights": [0.25]}]"#);
    assert_eq!(corners(&loaded(&json, &bytes), 0)[0][0].z, 2.0);
}

#[test]
fn skinned_vertices_follow_their_joints_and_not_their_node() {
    let mut bytes = square();
    bytes.extend([1u8, 0, 0, 0].repeat(4)); // joints: the second
    bytes.extend(floats(&[1.0, 0.0, 0.0, 0.0].repeat(4)));
    let json = with_square("", r#", "skins": [{"joints": [1, 2]}]"#)
        .replace(r#""TEXCOORD_0": 1"#, r#""JOINTS_0": 3, "WEIGHTS_0": 4"#)
        .replace(r#"[{"mesh": 0}]"#, r#"[{"mesh": 0, "skin": 0, "translation": [99, 0, 0]}, {"translation": [50, 0, 0]}, {"translation": [3, 2, 1]}]"#)
        .replace(r#""byteLength": 12}]"#, r#""byteLength": 12}, {"buffer": 0, "byteOffset": 92, "byteLength": 16}, {"buffer": 0, "byteOffset": 108, "byteLength": 64}]"#)
        .replace(r#""type": "SCALAR", "count": 6}"#, r#""type": "SCALAR", "count": 6}, {"bufferView": 3, "componentType": 5121, "type": "VEC4", "count": 4}, {"bufferView": 4, "componentType": 5126, "type": "VEC4", "count": 4}"#);
    assert_eq!(corners(&loaded(&json, &bytes), 0)[0][0], DVec3::new(3.0, 2.0, 1.0));
}

#[test]
fn a_binary_file_is_read_like_a_text_with_its_buffer_beside() {
    let bytes = square();
    let mut json =
        with_square("", "").replace(r#""uri": "BUFFER", "#, "").replace("LENGTH", &bytes.len().to_string());
    while !json.len().is_multiple_of(4) {
        json.push(' ');
    }
    let mut glb = b"glTF".to_vec();
    let word = |n: usize| (n as u32).to_le_bytes();
    glb.extend(word(2));
    glb.extend(word(12 + 8 + json.len() + 8 + bytes.len()));
    glb.extend(word(json.len()));
    glb.extend(b"JSON");
    glb.extend(json.as_bytes());
    glb.extend(word(bytes.len()));
    glb.extend(b"BIN\0");
    glb.extend(&bytes);
    let scene = read(glb.clone(), Path::new("m.glb"), Files::default()).unwrap();
    assert_eq!(corners(&scene, 0), corners(&loaded(&with_square("", ""), &bytes), 0));
    glb.truncate(glb.len() - 4);
    let error = read(glb, Path::new("m.glb"), Files::default()).unwrap_err();
    assert_eq!(error.column, 8, "{error}");
}

#[test]
fn instances_of_the_extension_are_shapes_of_one_mesh() {
    let node = r#"[{"mesh": 0, "translation": [0, 0, 5], "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}}}]"#;
    let scene = loaded(&with_square("", "").replace(r#"[{"mesh": 0}]"#, node), &square());
    assert_eq!(scene.shapes.len(), 4);
    assert_eq!(corners(&scene, 2)[0][0], DVec3::new(1.0, 1.0, 5.0));
}

#[test]
fn vertex_colours_multiply_the_base_colour_where_there_are_any() {
    let mut bytes = square();
    bytes.extend([255u8, 0, 51, 255].repeat(4));
    let json = with_square(r#", "material": 0"#, r#", "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.5, 1, 1, 1]}}]"#)
        .replace(r#""TEXCOORD_0": 1"#, r#""COLOR_0": 3"#)
        .replace(r#""primitives": ["#, r#""primitives": [{"attributes": {"POSITION": 0}, "indices": 2, "material": 0},"#)
        .replace(r#""byteLength": 12}]"#, r#""byteLength": 12}, {"buffer": 0, "byteOffset": 92, "byteLength": 16}]"#)
        .replace(r#""type": "SCALAR", "count": 6}"#, r#""type": "SCALAR", "count": 6}, {"bufferView": 3, "componentType": 5121, "normalized": true, "type": "VEC4", "count": 4}"#);
    let scene = loaded(&json, &bytes);
    let base = |shape: usize| match &scene.materials[scene.shapes[shape].material.0 as usize].kind {
        crate::MaterialKind::Gltf(material) => material.base_color,
        other => panic!("{other:?}"),
    };
    assert_eq!(base(0), crate::Color::Constant([0.5, 1.0, 1.0]));
    let crate::Color::Texture(id) = base(1) else { panic!("{:?}", base(1)) };
    assert!(matches!(scene.textures[id.0 as usize].kind, crate::TextureKind::Product { .. }));
    let ShapeKind::Mesh(mesh) = &scene.shapes[1].kind else { panic!("a mesh") };
    assert_eq!(mesh.attributes[0].values[..3], [1.0, 0.0, 0.2]);
}
