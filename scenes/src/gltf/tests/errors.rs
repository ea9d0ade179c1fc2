//! What makes no scene, with its place and its cure.

use super::*;

#[test]
fn errors_say_where_in_the_text_and_what_to_do() {
    let cases = [
        (r#""mesh": 0"#, r#""mesh": 7"#, "nodes[0].mesh", "index 7, but the file has 1 meshes"),
        (r#""POSITION": 0"#, r#""POSITION": 9"#, "meshes[0].primitives[0].attributes.POSITION", "index 9"),
        (
            r#""POSITION": 0"#,
            r#""POSITION": 2"#,
            "meshes[0].primitives[0].attributes.TEXCOORD_0",
            "4 elements for 6",
        ),
        (r#""componentType": 5126"#, r#""componentType": 7"#, "accessors[0].componentType", "unknown type 7"),
        (r#""count": 4"#, r#""count": 5"#, "accessors[0].count", "5 elements take 60 bytes"),
        (r#""count": 4"#, r#""count": -1"#, "accessors[0].count", "-1 where a whole number belongs"),
        (r#""byteLength": 48"#, r#""byteLength": 4800"#, "bufferViews[0].byteLength", "4800 bytes"),
        (
            r#""byteLength": LENGTH"#,
            r#""byteLength": 9999"#,
            "buffers[0].byteLength",
            "9999 bytes are announced",
        ),
        ("BUFFER", "nowhere.bin", "buffers[0].uri", "\"nowhere.bin\" is not there"),
        ("BUFFER", "https://a.b/c", "buffers[0].uri", "nothing is fetched"),
        ("BUFFER", "data:x;base64,*", "buffers[0].uri", "not base64"),
        (r#""version": "2.0""#, r#""version": "1.0""#, "asset.version", "glTF 1.0; 2.0 is read"),
        (r#""type": "VEC3""#, r#""type": "VEC9""#, "accessors[0].type", "unknown type \"VEC9\""),
    ];
    for (part, other, element, problem) in cases {
        let json = with_square("", "");
        assert!(json.contains(part), "{part}");
        let error = refused(&json.replacen(part, other, 1), &square());
        assert_eq!(error.element, element, "{other}: {error}");
        assert!(error.problem.contains(problem), "{other}: {error}");
        assert!(!error.help.is_empty());
    }
}

#[test]
fn a_text_that_is_no_json_is_named_with_line_and_column() {
    let error = refused("{\n  \"asset\": oops\n}", &[]);
    assert_eq!((error.line, error.column > 0), (2, true), "{error}");
    for json in ["[]", "", "3", "{}"] {
        refused(json, &[]);
    }
}

#[test]
fn an_extension_that_is_required_and_not_read_is_an_error_with_its_cure() {
    for (name, word) in
        [("KHR_draco_mesh_compression", "compression"), ("KHR_texture_basisu", "PNG"), ("X_y", "without")]
    {
        let rest = format!(r#", "extensionsUsed": ["{name}"], "extensionsRequired": ["{name}"]"#);
        let error = refused(&with_square("", &rest), &square());
        assert!(error.problem.contains(name) && error.help.contains(word), "{error}");
    }
    let rest =
        r#", "extensionsUsed": ["KHR_texture_transform"], "extensionsRequired": ["KHR_texture_transform"]"#;
    loaded(&with_square("", rest), &square());
}

#[test]
fn an_extension_that_is_used_and_not_read_is_one_warning() {
    let rest = r#", "extensionsUsed": ["A_b", "A_b", "KHR_materials_ior"]"#;
    let scene = loaded(&with_square("", rest), &square());
    let about: Vec<_> = messages(&scene).into_iter().filter(|m| m.contains("extensionsUsed")).collect();
    assert_eq!(about, ["extensionsUsed: A_b is not read; the model is shown without it"]);
}

#[test]
fn triangles_beyond_the_last_vertex_are_dropped_with_their_number() {
    let mut bytes = square();
    bytes[80 + 6..80 + 8].copy_from_slice(&999u16.to_le_bytes());
    let scene = loaded(&with_square("", ""), &bytes);
    assert_eq!(corners(&scene, 0).len(), 1);
    assert!(messages(&scene)[0].contains("1 triangles with vertices beyond"), "{:?}", messages(&scene));
}

#[test]
fn unknown_keys_and_odd_values_where_nothing_is_read_do_no_harm() {
    let rest = r#", "animations": [{"channels": "none"}], "extras": 3, "skins": [null], "images": [7], "nonsense": {}"#;
    assert_eq!(loaded(&with_square("", rest), &square()).shapes.len(), 1);
}
