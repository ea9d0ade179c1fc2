//! What is left out or replaced, and said.

use std::fs;

use super::{loaded, scene, unmark};
use crate::{LoadOptions, Projection, load, load_str};

/// The warnings about anything but the missing camera: line, column, element and text.
fn warnings(text: &str) -> Vec<String> {
    let warnings = load_str(text, "".as_ref(), &LoadOptions::default()).unwrap().warnings;
    let of_all = ["no sensor", "Mitsuba 3 refuses"]; // about the file as a whole
    let others = warnings.iter().filter(|w| !of_all.iter().any(|words| w.message.starts_with(words)));
    others.map(|w| format!("{}:{}: {}: {}", w.place.line, w.place.column, w.element, w.message)).collect()
}

#[test]
fn each_stand_in_is_named_with_its_place() {
    let cases = [
        (
            r#"¦<bsdf type="coating" id="p"><bsdf type="mask"><bsdf type="diffuse"/></bsdf></bsdf>"#,
            "bsdf \"p\": a coat over what lets light through is left out",
        ),
        (
            r#"¦<bsdf type="ward"><rgb name="specular_reflectance" value="0.7"/></bsdf>"#,
            "bsdf \"ward\": diffuse_reflectance and specular_reflectance add up to 1.2, and are scaled together to 1",
        ),
        (
            r#"¦<bsdf type="roughcoating"><bsdf type="coating"><bsdf type="plastic"/></bsdf></bsdf>"#,
            "bsdf \"roughcoating\": a coat over another coat is left out",
        ),
        (r#"¦<texture type="volume"/>"#, "texture \"volume\": volume is not read yet; grey 0.5 stands in"),
        (
            r#"¦<sensor type="thinlens"/>"#,
            "sensor \"thinlens\": thinlens: the aperture has no radius; a pinhole stands in",
        ),
        (r#"¦<integrator type="sppm"/>"#, "integrator \"sppm\": sppm: rendered with path"),
        (
            r#"¦<emitter type="area"/>"#,
            "emitter \"area\": area: no shape holds it or refers to it; the light is left out",
        ),
        (
            r#"<emitter type="constant"/>¦<emitter type="constant"/>"#,
            "emitter \"constant\": constant: a second background is left out: a scene has one",
        ),
        (
            r#"¦<shape type="cube"><transform name="to_world"><scale z="0"/></transform></shape>"#,
            "shape \"cube\": to_world flattens the shape; it is left out",
        ),
        (
            r#"<shape type="cube"><transform name="to_world"><rotate x="0.6" y="-0.8" angle="9"/>¦<rotate x="1" y="1" angle="9"/>
                <rotate z="3" angle="9"/></transform></shape>"#,
            "rotate: the axis is not unit: Mitsuba 3 scales with its length, limpid turns alone",
        ),
        (
            r#"<bsdf type="diffuse">¦<rgb name="reflectance" value="2"/></bsdf>"#,
            "rgb \"reflectance\" of bsdf \"diffuse\": a reflectance beyond 0 to 1",
        ),
        ("¦stray", "scene: the text \"stray\" between elements means nothing"),
        (r#"¦<path value="gone"/>"#, "path: the folder \"gone\" is not there"),
    ];
    for (marked, message) in cases {
        let (text, place) = unmark(&scene(marked));
        let warnings = warnings(&text);
        let expected = format!("{place}: {message}");
        assert!(
            warnings.len() == 1 && warnings[0].starts_with(&expected),
            "{marked}: {warnings:?}\nexpected {expected}"
        );
    }
}

#[test]
fn what_mitsuba_3_refuses_is_said_once_at_its_first_place() {
    let marked = r##"<bsdf type="diffuse"/><bsdf type="twosided">¦<bsdf type="phong"/></bsdf><bsdf type="phong"/>
        <bsdf type="conductor"><float name="ext_eta" value="1"/></bsdf><sensor type="perspective"><sampler type="halton"/>
        <transform name="to_world"><lookAt origin="0 0 1" target="0 0 0"/></transform></sensor>
        <emitter type="constant"><spectrum name="radiance" value="1, 2 3"/></emitter><emitter type="point">
        <rgb name="intensity" value="#ffffff"/></emitter>"##;
    let (text, place) = unmark(&scene(marked));
    let warnings = load_str(&text, "".as_ref(), &LoadOptions::default()).unwrap().warnings;
    let [warning] = &warnings[..] else { panic!("{warnings:?}") };
    assert_eq!(format!("{}:{}", warning.place.line, warning.place.column), place);
    let names = "phong, ext_eta, halton, <lookAt>, a <spectrum> of three numbers, #rrggbb";
    assert_eq!(warning.message, format!("Mitsuba 3 refuses {names}, which this file has and limpid reads"));
    assert!(load_str(&text, "".as_ref(), &LoadOptions { strict: true, ..LoadOptions::default() }).is_ok());
}

#[test]
fn unused_parameters_are_warned_of_and_refused_if_strict() {
    let marked =
        r#"<shape type="sphere">¦<float name="radiu" value="2"/><float name="radius" value="1"/></shape>"#;
    let (text, place) = unmark(&scene(marked));
    let expected = format!("{place}: shape \"sphere\": unused parameter \"radiu\"");
    let warning = &warnings(&text)[0];
    assert!(warning.starts_with(&expected) && warning.contains("did you mean \"radius\""), "{warning}");
    let strict = LoadOptions { strict: true, ..LoadOptions::default() };
    let error = load_str(&text, "".as_ref(), &strict).unwrap_err().to_string();
    assert!(error.starts_with(&format!("(text):{expected}")), "{error}");

    let twice =
        r#"<shape type="sphere"><float name="radius" value="3"/><float name="radius" value="1"/></shape>"#;
    assert!(warnings(&scene(twice))[0].contains("\"radius\" is given again further down; the last counts"));
    let nested = r#"<bsdf type="diffuse"><texture type="checkerboard"/></bsdf>"#;
    assert!(warnings(&scene(nested))[0].contains("unused parameter <texture>"));
    let many = format!("<shape type=\"cube\">{}</shape>", r#"<float name="x" value="1"/>"#.repeat(100));
    assert_eq!(warnings(&scene(&many)).len(), 21);

    let defines = vec![("spp".to_string(), "4".to_string())];
    let options = LoadOptions { defines, strict: true };
    let error = load_str(&scene(""), "".as_ref(), &options).unwrap_err().to_string();
    assert!(error.contains("-D spp: the file does not use the parameter"), "{error}");
}

#[test]
fn warnings_come_in_the_order_of_the_file() {
    let elements = r#"<bsdf type="diffuse" id="a"><float name="x" value="1"/></bsdf>
        <shape type="cube"><ref id="b"/><float name="y" value="1"/></shape>
        <bsdf type="diffuse" id="b"><float name="z" value="1"/></bsdf>"#;
    let lines: Vec<_> = loaded(elements).warnings.iter().map(|w| w.place.line).collect();
    assert_eq!(lines, [1, 2, 3, 1]); // the last is about the camera
}

#[test]
fn a_scene_without_camera_gets_one_that_sees_it() {
    let camera =
        &loaded(r#"<shape type="cube"><transform name="to_world"><translate x="10"/></transform></shape>"#)
            .cameras[0];
    // as Mitsuba places it: the box's half size is seen under half of 45 degrees
    let position = camera.world_from_camera.w_axis;
    let distance = 1.0 / 22.5f64.to_radians().tan();
    assert!(
        position.truncate().abs_diff_eq(glam::DVec3::new(10.0, 0.0, -1.0 - distance), 1e-9),
        "{position}"
    );
    assert!(matches!(camera.projection, Projection::Perspective { fov_deg: 45.0, .. }));
    assert!(loaded("").cameras[0].world_from_camera.is_finite());
}

#[test]
fn files_are_found_in_other_spellings_with_a_warning() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("Models")).unwrap();
    fs::write(folder.path().join("Models/A b.OBJ"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let path = folder.path().join("scene.xml");
    for (name, found) in [
        ("Models/A b.OBJ", false),
        ("models/a B.obj", true),
        (r".\Models\A b.OBJ", true),
        (r"Models\a b.obj", true),
    ] {
        fs::write(
            &path,
            scene(&format!(r#"<shape type="obj"><string name="filename" value="{name}"/></shape>"#)),
        )
        .unwrap();
        let scene = load(&path, &LoadOptions::default()).unwrap();
        assert_eq!(scene.shapes.len(), 1);
        assert_eq!(scene.warnings[0].message.contains("was found as"), found, "{name}: {:?}", scene.warnings);
    }
}

#[test]
fn dropped_faces_are_warned_of_with_mesh_face_and_vertex() {
    let folder = tempfile::tempdir().unwrap();
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 nan 0\nf 1 2 3\nf 4 2 3\nf 1\n";
    fs::write(folder.path().join("m.obj"), obj).unwrap();
    let path = folder.path().join("scene.xml");
    fs::write(&path, scene(r#"<shape type="obj" id="wall"><string name="filename" value="m.obj"/></shape>"#))
        .unwrap();
    let warnings = load(&path, &LoadOptions::default()).unwrap().warnings;
    assert!(warnings[0].place.file.ends_with("m.obj") && warnings[0].element == "shape \"wall\"");
    assert_eq!((warnings[0].place.line, warnings[0].message.as_str()), (7, "face with 1 corners dropped"));
    assert!(warnings[1].message.contains("first face 2 with vertex 4"), "{warnings:?}");
}
