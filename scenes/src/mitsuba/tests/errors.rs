//! What makes no scene, and how it is said.

use std::fs;

use super::{scene, unmark};
use crate::{LoadOptions, load, load_str};

/// What stands inside the scene element, `¦` before what the error points at; and how the message begins.
#[test]
fn errors_say_where_what_and_how_to_mend_it() {
    let cases = [
        (
            r#"<shape type="sphere"><bsdf type="¦difuse"/></shape>"#,
            "bsdf \"difuse\": unknown type \"difuse\"\n  = help: did you mean \"diffuse\"? known types: diffuse, ",
        ),
        (r#"<bsdf type="¦difuse" id="floor"/>"#, "bsdf \"floor\": unknown type \"difuse\""),
        (
            "\n  <shape type=\"sphere\">\n    <float name=\"radius\" value=\"¦nan\"/></shape>",
            "float \"radius\" of shape \"sphere\": \"nan\" is not a finite number",
        ),
        (
            r#"<shape type="sphere" id="é"><float name="radius" value="¦-1"/></shape>"#,
            "float \"radius\" of shape \"é\": -1 is not above 0",
        ),
        (
            r#"<sensor type="perspective"><film type="hdrfilm"><integer name="width" value="¦0"/></film></sensor>"#,
            "integer \"width\" of film \"hdrfilm\": 0 is out of bounds\n  = help: give a whole number from 1 to",
        ),
        (
            r#"<sensor type="perspective"><film type="hdrfilm"><integer name="width" value="¦1e3"/></film></sensor>"#,
            "integer \"width\" of film \"hdrfilm\": \"1e3\" is not a whole number",
        ),
        (
            r#"<sensor type="perspective">¦<film type="hdrfilm"><integer name="width" value="999999"/><integer name="height" value="999999"/></film></sensor>"#,
            "film \"hdrfilm\": 999999x999999 pixels",
        ),
        (
            r#"<sensor type="perspective"><film type="hdrfilm"><integer name="crop_width" value="¦769"/></film></sensor>"#,
            "integer \"crop_width\" of film \"hdrfilm\": 769 is out of bounds",
        ),
        (
            r#"<sensor type="perspective"><float name="fov" value="¦180"/></sensor>"#,
            "float \"fov\" of sensor \"perspective\": 180 is not between 0 and 180 degrees",
        ),
        (
            r#"<sensor type="¦perspectiv"/>"#,
            "sensor \"perspectiv\": unknown type \"perspectiv\"\n  = help: did you mean \"perspective\"",
        ),
        (
            r#"<shape type="sphere">¦<string name="radius" value="1"/></shape>"#,
            "string \"radius\" of shape \"sphere\": <string> where <float> belongs",
        ),
        (
            r#"<shape type="sphere"><boolean name="flip_normals" value="¦1"/></shape>"#,
            "boolean \"flip_normals\" of shape \"sphere\": \"1\" is neither true nor false",
        ),
        (
            r#"<shape type="cube"><transform name="to_world">¦<rotate angle="9"/></transform></shape>"#,
            "rotate in transform \"to_world\" of shape \"cube\": a rotation about an axis of no length",
        ),
        (
            r#"<shape type="cube"><transform name="to_world"><matrix value="¦1 2"/></transform></shape>"#,
            "matrix in transform \"to_world\" of shape \"cube\": 2 numbers",
        ),
        (
            r#"<shape type="cube"><transform name="to_world">¦<skale x="2"/></transform></shape>"#,
            "skale in transform \"to_world\" of shape \"cube\": unknown operation <skale>\n  = help: did you mean \"scale\"",
        ),
        (
            r#"<shape type="cube">¦<transform name="to_world"><scale value="1e200"/><scale value="1e200"/></transform></shape>"#,
            "transform \"to_world\" of shape \"cube\": the operations make numbers too large",
        ),
        (
            r#"<shape type="obj"><string name="filename" value="¦nowhere.obj"/></shape>"#,
            "shape \"obj\": the file \"nowhere.obj\" is not there",
        ),
        (
            r#"<texture type="bitmap"><string name="filename" value="¦nowhere.png"/></texture>"#,
            "texture \"bitmap\": the file \"nowhere.png\" is not there",
        ),
        (r#"¦<shape type="obj"/>"#, "shape \"obj\": no \"filename\""),
        (r#"¦<shape/>"#, "shape: <shape> without the attribute \"type\""),
        (
            r#"<shape type="cube"><ref id="¦flor"/></shape><bsdf type="diffuse" id="floor"/>"#,
            "ref \"flor\": no object has the id \"flor\"\n  = help: did you mean \"floor\"",
        ),
        (r#"¦<bsdf type="twosided" id="a"><ref id="a"/></bsdf>"#, "bsdf \"a\": the object contains itself"),
        (
            r#"¦<texture type="checkerboard" id="a"><ref name="color0" id="b"/></texture><texture type="checkerboard" id="b"><ref name="color1" id="a"/></texture>"#,
            "texture \"a\": the object contains itself",
        ),
        (
            r#"<bsdf type="diffuse" id="a"/>¦<bsdf type="diffuse" id="a"/>"#,
            "bsdf \"a\": the id \"a\" is taken (line 1)",
        ),
        (
            r#"<shape type="sphere"><float name="radius" value="¦$rad"/></shape>"#,
            "float attribute \"value\": the parameter $rad has no value",
        ),
        (r#"¦<include filename="gone.xml"/>"#, "include \"gone.xml\": the file is not there"),
        (r#"¦<hide/>"#, "hide: unknown element <hide>"),
        (r#"<bsdf type="¦pplastic"/>"#, "bsdf \"pplastic\": type \"pplastic\" is out of scope (polarised)"),
        (
            r#"<bsdf type="diffuse"><rgb name="reflectance" value="¦1 2"/></bsdf>"#,
            "rgb \"reflectance\": 2 numbers",
        ),
        (
            r#"<bsdf type="diffuse"><spectrum name="reflectance" value="¦500:1, 400:2"/></bsdf>"#,
            "spectrum \"reflectance\": 400 nm after 500 nm",
        ),
        (
            r#"<bsdf type="conductor"><string name="material" value="¦cu"/></bsdf>"#,
            "string \"material\" of bsdf \"conductor\": unknown metal \"cu\"\n  = help: did you mean \"Cu\"",
        ),
        (
            r#"¦<shape type="cube"><bsdf type="diffuse"/><bsdf type="diffuse"/></shape>"#,
            "shape \"cube\": more than one bsdf inside",
        ),
        (
            r#"<emitter type="constant"><rgb name="radiance" value="¦-1"/></emitter>"#,
            "rgb \"radiance\" of emitter \"constant\": negative values",
        ),
        (r#"<shape type="sphere">¦</bsdf>"#, "XML: expected 'shape' tag, not 'bsdf'"),
    ];
    for (marked, message) in cases {
        let (elements, place) = unmark(&scene(marked));
        let error =
            load_str(&elements, "".as_ref(), &LoadOptions::default()).expect_err(&elements).to_string();
        let expected = format!("(text):{place}: {message}");
        assert!(error.starts_with(&expected), "{marked}\n{error}\nexpected\n{expected}");
        assert!(error.contains("\n  = help: "), "{error}");
    }
}

#[test]
fn text_that_is_no_scene_is_refused_where_it_goes_wrong() {
    let half = scene("<shape type=\"sphere\">\n<float¦");
    let cases = [
        ("¦", "XML: "),
        ("   \n ¦", "XML: "),
        ("¦no xml", "XML: "),
        (half.trim_end_matches("</scene>"), "XML: "),
        ("¦<bsdf type=\"diffuse\"/>", "bsdf: the outermost element is <bsdf>"),
        ("¦<scene version=\"three\"/>", "scene: version \"three\" is none"),
        ("¦<!DOCTYPE a [<!ENTITY b \"c\">]><scene version=\"3.0.0\"/>", "XML: "),
    ];
    for (marked, message) in cases {
        let (text, place) = unmark(marked);
        let error = load_str(&text, "".as_ref(), &LoadOptions::default()).expect_err(&text).to_string();
        let expected = format!("(text):{place}: {message}");
        assert!(error.starts_with(&expected), "{marked}\n{error}\nexpected\n{expected}");
    }
}

#[test]
fn circles_of_includes_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("cycle.xml", &scene(r#"<include filename="cycle.xml"/>"#));
    write("a.xml", &scene(r#"<include filename="b.xml"/>"#));
    write("b.xml", &scene("\n<include filename=\"./a.xml\"/>"));
    for (name, place) in [("cycle.xml", "cycle.xml:1:24"), ("a.xml", "b.xml:2:1")] {
        let error = load(&folder.path().join(name), &LoadOptions::default()).unwrap_err().to_string();
        assert!(error.contains(place) && error.contains("the file includes itself"), "{error}");
    }
}

#[test]
fn errors_in_meshes_and_pictures_name_their_file() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &[u8]| fs::write(folder.path().join(name), text).unwrap();
    write("bad.obj", b"v 0 0 0\nf 1 2 99999999999\n");
    write("bad.ply", b"ply\nformat ascii 1.0\nelement vertex 1\n");
    write("bad.png", b"\x89PNG\r\n\x1a\n");
    write("bad.exr", b"\x76\x2f\x31\x01\x02\0\0\0");
    write("bad.txt", b"what");
    for (element, message) in [
        (
            r#"<shape type="obj"><string name="filename" value="bad.obj"/></shape>"#,
            "bad.obj:2:1: mesh: face with vertex 99999999999",
        ),
        (
            r#"<shape type="ply"><string name="filename" value="bad.ply"/></shape>"#,
            "bad.ply: byte 38: mesh: the header does not end",
        ),
        (
            r#"<shape type="ply"><string name="filename" value="bad.txt"/></shape>"#,
            "bad.txt: mesh: the header does not end",
        ),
        (
            r#"<texture type="bitmap"><string name="filename" value="bad.png"/></texture>"#,
            "scene.xml:1:78: texture \"bitmap\": ",
        ),
        (r#"<texture type="bitmap"><string name="filename" value="bad.exr"/></texture>"#, "bad.exr: "),
        (
            r#"<emitter type="envmap"><string name="filename" value="bad.txt"/></emitter>"#,
            "bad.txt: not a PNG",
        ),
        (r#"<emitter type="envmap"><string name="filename" value="."/></emitter>"#, "not a regular file"),
    ] {
        write("scene.xml", scene(element).as_bytes());
        let error =
            load(&folder.path().join("scene.xml"), &LoadOptions::default()).expect_err(element).to_string();
        assert!(error.contains(message), "{element}\n{error}");
    }
}

#[test]
fn files_are_read_as_their_extension_says() {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes, message) in [
        ("a.gltf", &b"{\"asset\":{}}"[..], "a.gltf: asset.version: not there"),
        (
            "a.glb",
            b"glTF\x02\0\0\0\x7f\x7f\x7f\x7f",
            "a.glb: byte 8: container: 2139062143 bytes are announced, but the file has 12",
        ),
        ("a.obj", b"v 0 0 0\nf 1 2 99999999999\n", "a.obj:2:1: mesh: face with vertex 99999999999"),
        ("a.xml", b"\xff\xfe<\0", "a.xml: XML: the text is UTF-16"),
        ("A.XML", b"<", "A.XML:1:"),
        (
            "a.ply",
            b"ply",
            "a.ply: scene: unknown extension \".ply\"\n  = help: scenes are read from .xml, .gltf, .glb, .obj",
        ),
        ("a", b"<scene/>", "a: scene: a scene file without extension"),
    ] {
        let path = folder.path().join(name);
        fs::write(&path, bytes).unwrap();
        let error = load(&path, &LoadOptions::default()).unwrap_err().to_string();
        assert!(error.contains(message), "{error}");
    }
    let error = load(&folder.path().join("gone.xml"), &LoadOptions::default()).unwrap_err().to_string();
    assert!(error.contains("gone.xml: scene: "), "{error}");
}
