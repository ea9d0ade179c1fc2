//! The language: parameters, includes, references, numbers, colours, transforms, names of 0.x.

use std::fs;

use glam::{DMat4, DVec3};

use super::{loaded, scene};
use crate::{Color, LoadOptions, MaterialKind, Rgb, Scene, ShapeKind, load, load_str};

fn radius(scene: &Scene) -> f64 {
    match scene.shapes[0].kind {
        ShapeKind::Sphere { radius, .. } => radius,
        ref other => panic!("{other:?}"),
    }
}

/// The reflectance of the first shape, which is diffuse.
fn reflectance(scene: &Scene) -> Rgb {
    match scene.materials[scene.shapes[0].material.0 as usize].kind {
        MaterialKind::Diffuse { reflectance: Color::Constant(rgb) } => rgb,
        ref other => panic!("{other:?}"),
    }
}

fn assert_close(got: Rgb, expected: Rgb, what: &str) {
    assert!(
        got.iter().zip(expected).all(|(g, e)| (g - e).abs() < 1e-5),
        "{what}: {got:?}, expected {expected:?}"
    );
}

const BALL: &str = r#"<shape type="sphere"><float name="radius" value="$r"/></shape>"#;

#[test]
fn parameters_come_from_the_command_line_before_the_file() {
    let text = scene(&format!(r#"<default name="r" value="2"/><default name="r" value="3"/>{BALL}"#));
    let with = |defines: &[(&str, &str)]| {
        let defines = defines.iter().map(|(n, v)| (n.to_string(), v.to_string())).collect();
        radius(&load_str(&text, "".as_ref(), &LoadOptions { defines, strict: true }).unwrap())
    };
    assert_eq!(with(&[]), 2.0);
    assert_eq!(with(&[("r", "7")]), 7.0);
}

#[test]
fn parameters_stand_in_types_names_and_parts_of_values() {
    let elements = r#"<default name="kind" value="here"/><default name="p" value="ius"/><default name="n" value="$n2"/>"#;
    assert!(super::try_load(elements).is_err(), "a default that refers to nothing");
    let elements = r#"<default name="kind" value="phere"/><default name="p" value="ius"/><default name="e" value="e1"/>
        <shape type="s$kind"><float name="rad$p" value="2$e"/></shape>"#;
    assert_eq!(radius(&loaded(elements)), 20.0);
}

#[test]
fn numbers_are_written_in_many_ways() {
    for (text, value) in [
        ("2", 2.0),
        (" 2.50 ", 2.5),
        (".5", 0.5),
        ("5.", 5.0),
        ("+4", 4.0),
        ("4.37114e-008", 4.37114e-8),
        ("1E3", 1e3),
    ] {
        let elements = BALL.replace("$r", text);
        assert_eq!(radius(&loaded(&elements)), value, "{text}");
    }
    let integer = r#"<shape type="sphere"><integer name="radius" value="3"/></shape>"#;
    assert_eq!(radius(&loaded(integer)), 3.0);
}

#[test]
fn colours_are_written_in_many_ways() {
    let e = [1.0; 3];
    let cases: [(&str, Rgb); 12] = [
        (r#"<rgb name="reflectance" value="0.1, 0.2, 0.3"/>"#, [0.1, 0.2, 0.3]),
        (r#"<rgb name="reflectance" value="0.1 0.2 0.3"/>"#, [0.1, 0.2, 0.3]),
        (r#"<rgb name="reflectance" value=" .1 ,0.2	0.3 "/>"#, [0.1, 0.2, 0.3]),
        (r#"<rgb name="reflectance" value="0.4"/>"#, [0.4; 3]),
        (r#"<float name="reflectance" value="0.4"/>"#, [0.4; 3]),
        (r##"<rgb name="reflectance" value="#ff8000"/>"##, [1.0, 0.2158605, 0.0]),
        (r#"<srgb name="reflectance" value="1, 0.5, 0"/>"#, [1.0, 0.2140411, 0.0]),
        (r##"<srgb name="reflectance" value="#ff8000"/>"##, [1.0, 0.2158605, 0.0]),
        (r#"<spectrum name="reflectance" value="0.5"/>"#, [0.5; 3]),
        (r#"<spectrum name="reflectance" value="0.1 0.2 0.3"/>"#, [0.1, 0.2, 0.3]),
        // by Mitsuba 3.9.1
        (r#"<spectrum name="reflectance" value="400:1, 700:1"/>"#, [0.995342, 0.9997564, 0.9949091]),
        (r#"<spectrum name="reflectance" type="uniform"><float name="value" value="1"/></spectrum>"#, e),
    ];
    for (element, expected) in cases {
        let elements = format!(r#"<shape type="sphere"><bsdf type="diffuse">{element}</bsdf></shape>"#);
        assert_close(reflectance(&loaded(&elements)), expected, element);
    }
}

#[test]
fn light_is_written_in_many_ways() {
    let cases: [(&str, Rgb); 6] = [
        (r#"<rgb name="radiance" value="18.387, 10.9873, 2.75357"/>"#, [18.387, 10.9873, 2.75357]),
        // by Mitsuba 3.9.1
        (
            r#"<spectrum name="radiance" value="400:0, 500:8, 600:15.6, 700:18.4"/>"#,
            [20.710836, 10.854634, 2.771152],
        ),
        (r#"<spectrum name="radiance" value="0.5"/>"#, [0.60239697, 0.4741455, 0.45445803]),
        (r#"<float name="radiance" value="0.5"/>"#, [0.5; 3]),
        (r#"<spectrum name="radiance" type="d65"><float name="scale" value="3"/></spectrum>"#, [3.0; 3]),
        ("", [1.0; 3]),
    ];
    for (element, expected) in cases {
        let scene =
            loaded(&format!(r#"<shape type="sphere"><emitter type="area">{element}</emitter></shape>"#));
        let Some(Color::Constant(radiance)) = scene.shapes[0].emission.as_ref().map(|e| e.radiance) else {
            panic!("{element}")
        };
        assert!(radiance.iter().zip(expected).all(|(g, e)| (g - e).abs() < 5e-5), "{element}: {radiance:?}");
    }
}

#[test]
fn the_first_operation_of_a_transform_acts_first() {
    let turn = DMat4::from_rotation_x(90f64.to_radians());
    let cases = [
        (
            r#"<translate x="1"/><scale x="2"/>"#,
            DMat4::from_scale(DVec3::new(2.0, 1.0, 1.0)) * DMat4::from_translation(DVec3::X),
        ),
        (r#"<translate value="1, 2, 3"/>"#, DMat4::from_translation(DVec3::new(1.0, 2.0, 3.0))),
        (r#"<scale value="2"/>"#, DMat4::from_scale(DVec3::splat(2.0))),
        (
            r#"<scale value="2 3 4"/><rotate x="2" angle="90"/>"#,
            turn * DMat4::from_scale(DVec3::new(2.0, 3.0, 4.0)),
        ),
        (r#"<rotate value="1 0 0" angle="90"/>"#, turn),
        (
            r#"<matrix value="1 0 0 5 0 1 0 6 0 0 1 7 0 0 0 1"/>"#,
            DMat4::from_translation(DVec3::new(5.0, 6.0, 7.0)),
        ),
        (r#"<matrix value="2 0 0 0 3 0 0 0 4"/>"#, DMat4::from_scale(DVec3::new(2.0, 3.0, 4.0))),
        // +z goes to the target, +x to the left of the picture; by Mitsuba 3.9.1
        (
            r#"<lookat origin="1 2 3" target="4 2 3" up="0 1 0"/>"#,
            DMat4::from_cols_array(&[
                0.0, 0.0, -1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 1.0,
            ]),
        ),
        (
            r#"<lookAt origin="1 2 3" target="4 2 3"/>"#,
            DMat4::from_cols_array(&[
                0.0, -1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 1.0,
            ]),
        ),
        ("", DMat4::IDENTITY),
    ];
    for (operations, expected) in cases {
        let elements =
            format!(r#"<shape type="cube"><transform name="to_world">{operations}</transform></shape>"#);
        let got = loaded(&elements).shapes[0].world_from_object;
        assert!(got.abs_diff_eq(expected, 1e-12), "{operations}: {got}");
    }
}

#[test]
fn references_follow_ids_forwards_aliases_and_classes() {
    let red = r#"<bsdf type="diffuse" id="red"><rgb name="reflectance" value="1 0 0"/></bsdf>"#;
    for elements in [
        format!(r#"{red}<shape type="sphere"><ref id="red"/></shape>"#),
        format!(r#"<shape type="sphere"><ref id="red"/></shape>{red}"#),
        format!(r#"<shape type="sphere"><ref name="bsdf" id="red"/></shape>{red}"#),
        format!(
            r#"<alias id="rouge" as="r"/><alias id="red" as="rouge"/><shape type="sphere"><ref id="r"/></shape>{red}"#
        ),
        format!(
            r#"<medium type="homogeneous" id="m"/><shape type="sphere"><ref name="interior" id="m"/><ref id="red"/></shape>{red}"#
        ),
    ] {
        assert_eq!(reflectance(&loaded(&elements)), [1.0, 0.0, 0.0], "{elements}");
    }
    let shared = loaded(&format!(
        r#"{red}<shape type="sphere"><ref id="red"/></shape><shape type="cube"><ref id="red"/></shape>"#
    ));
    assert_eq!(shared.materials.len(), 1);
    assert_eq!(shared.shapes[0].material, shared.shapes[1].material);
}

#[test]
fn included_files_share_ids_and_parameters_and_keep_their_own_version() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, text).unwrap();
        path
    };
    write("parts/sizes.xml", &scene(r#"<default name="r" value="3"/>"#));
    write(
        "parts/old.xml",
        r#"<scene version="0.5.0"><bsdf type="roughplastic" id="b"><float name="intIOR" value="1.7"/></bsdf></scene>"#,
    );
    write("lib/bare.xml", r#"<bsdf type="diffuse" id="bare"/>"#);
    write("lib/more/inner.xml", &scene(r#"<include filename="bare.xml"/>"#));
    let main = write(
        "main.xml",
        &scene(&format!(
            r#"<path value="lib"/><include filename="parts/sizes.xml"/><include filename="parts/old.xml"/>
            <include filename="more/inner.xml"/>{BALL}<shape type="cube"><ref id="b"/></shape><shape type="cube"><ref id="bare"/></shape>"#
        )),
    );
    let scene = load(&main, &LoadOptions { strict: true, ..LoadOptions::default() }).unwrap();
    assert_eq!(radius(&scene), 3.0);
    let names: Vec<_> = scene.materials.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(names, ["b", "bare", "grey"]);
    assert!(matches!(scene.materials[0].kind, MaterialKind::RoughPlastic { int_ior: 1.7, .. }));
    assert_eq!(scene.materials[0].place.file.as_path(), folder.path().join("parts/old.xml"));
    assert_eq!(scene.content_hash.len(), 64);

    // the hash is over all files: another word in an included one changes it
    write("lib/bare.xml", r#"<bsdf type="diffuse"  id="bare"/>"#);
    assert_ne!(load(&main, &LoadOptions::default()).unwrap().content_hash, scene.content_hash);
}

#[test]
fn names_of_0_x_are_understood_by_the_version_of_the_file() {
    let text = r#"<scene version="0.6.0"><sensor type="perspective"><float name="nearClip" value="1"/>
            <film type="hdrfilm"><integer name="cropOffsetX" value="3"/></film></sensor>
        <shape type="sphere"><bsdf type="diffuse"><texture type="checkerboard" name="diffuseReflectance">
            <float name="uscale" value="10"/><float name="voffset" value="2"/></texture></bsdf>
            <transform name="toWorld"><scale value="2"/></transform></shape>
        <shape type="sphere"><bsdf type="conductor"/></shape></scene>"#;
    let scene = load_str(text, "".as_ref(), &LoadOptions { strict: true, ..LoadOptions::default() }).unwrap();
    assert_eq!(scene.cameras[0].near_clip, Some(1.0));
    assert_eq!(scene.cameras[0].film.crop.unwrap().x, 3);
    assert_eq!(scene.shapes[0].world_from_object, DMat4::from_scale(DVec3::splat(2.0)));
    let matrix = scene.textures[0].uv_from_surface;
    assert_eq!(matrix * DVec3::new(0.5, 0.5, 1.0), DVec3::new(5.0, 2.5, 1.0));
    // copper was the default
    assert!(
        matches!(scene.materials[1].kind, MaterialKind::Conductor { ior: Some(_), .. }),
        "{:?}",
        scene.materials
    );
}
