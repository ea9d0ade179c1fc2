//! Shapes that hold others, mesh files of several meshes, and what meshes carry.

use std::fs;
use std::sync::Arc;

use super::{loaded, try_load};
use crate::{Color, GroupId, LoadOptions, MaterialId, Scene, ShapeKind, TextureKind, load};

const GROUP: &str = r#"<shape type="shapegroup" id="tree">
    <shape type="sphere" id="crown"><bsdf type="diffuse" id="leaf"/></shape>
    <shape type="merge"><shape type="cube"/><shape type="cylinder"/></shape></shape>"#;

#[test]
fn groups_are_read_once_and_shown_by_instances() {
    let scene = loaded(&format!(
        r#"<shape type="instance" id="early"><ref id="tree"/></shape>{GROUP}<shape type="disk"/>
<shape type="instance"><ref id="tree"/><transform name="to_world"><translate z="3"/></transform></shape>"#
    ));
    assert_eq!(scene.groups.len(), 1);
    let names = |shapes: &[crate::Shape]| shapes.iter().map(|s| s.name.clone()).collect::<Vec<_>>();
    assert_eq!(scene.groups[0].name, "tree");
    assert_eq!(names(&scene.groups[0].shapes), ["crown", "cube 2", "cylinder 3"]);
    assert_eq!(names(&scene.shapes), ["early", "disk 2", "instance 3"]);
    for i in [0, 2] {
        assert!(matches!(scene.shapes[i].kind, ShapeKind::Instance { group: GroupId(0) }));
        assert_eq!(scene.shapes[i].material, scene.groups[0].shapes[0].material);
    }
    assert_eq!(scene.shapes[2].world_from_object.w_axis.z, 3.0);
    assert_eq!(scene.materials[scene.groups[0].shapes[0].material.0 as usize].name, "leaf");
    // the default camera sees what the instances show
    assert_eq!(scene.cameras.len(), 1);
    assert!(scene.warnings.len() == 1 && scene.cameras[0].world_from_camera.w_axis.z < -1.0);
}

#[test]
fn what_no_instance_can_be_of_is_an_error() {
    let light = r#"<emitter type="area"/>"#;
    let cases = [
        (r#"<shape type="instance"/>"#.to_string(), "an instance of nothing"),
        (r#"<shape type="instance"><shape type="cube"/></shape>"#.into(), "which is no shapegroup"),
        (
            format!(r#"{GROUP}<shape type="instance"><ref id="tree"/><ref id="tree"/></shape>"#),
            "more than one shape",
        ),
        (
            format!(
                r#"{GROUP}<shape type="shapegroup" id="b"><shape type="instance"><ref id="tree"/></shape></shape>"#
            ),
            "a shapegroup that holds a shape of the type \"instance\"",
        ),
        (
            r#"<shape type="shapegroup"><shape type="shapegroup"/></shape>"#.into(),
            "a shapegroup that holds a shape of the type \"shapegroup\"",
        ),
        (
            format!(r#"<shape type="shapegroup"><shape type="cube">{light}</shape></shape>"#),
            "a shape that emits, inside a shapegroup",
        ),
        (
            r#"<shape type="merge" id="m"><shape type="merge"><ref id="m"/></shape></shape>"#.into(),
            "contains itself",
        ),
    ];
    for (elements, problem) in cases {
        let error = try_load(&elements).unwrap_err().to_string();
        assert!(error.contains(problem), "{error}\nexpected {problem}");
    }
}

#[test]
fn instances_of_nothing_are_left_out_with_a_warning() {
    let scene = loaded(
        r#"<shape type="shapegroup" id="none"/><shape type="instance"><ref id="none"/></shape>
<shape type="shapegroup" id="g"><shape type="cube"/></shape>
<shape type="instance"><ref id="g"/><transform name="to_world"><scale x="0"/></transform></shape>"#,
    );
    assert!(scene.shapes.is_empty());
    let messages: Vec<_> = scene.warnings.iter().map(|w| w.message.as_str()).collect();
    assert!(messages[0].contains("empty") && messages[1].contains("flattens"), "{messages:?}");
}

#[test]
fn parts_of_a_merge_stay_apart_in_the_order_of_the_file() {
    let scene = loaded(
        r#"<shape type="sphere"/><shape type="merge"><shape type="cube" id="a"/><shape type="disk"/></shape><shape type="cube"/>"#,
    );
    let names: Vec<_> = scene.shapes.iter().map(|s| s.name.as_str()).collect();
    assert_eq!(names, ["sphere 1", "a", "disk 3", "cube 4"]);
}

#[test]
fn textures_of_attributes_factors_and_constants_are_read() {
    let reflectance = |texture: &str| {
        let scene = loaded(&format!(r#"<bsdf type="diffuse">{texture}</bsdf>"#));
        let crate::MaterialKind::Diffuse { reflectance } = scene.materials[MaterialId(0).0 as usize].kind
        else {
            unreachable!("it is diffuse")
        };
        (reflectance, scene.textures)
    };
    let attribute = r#"<texture type="mesh_attribute" name="reflectance"><string name="name" value="vertex_color"/><float name="scale" value="2"/></texture>"#;
    let (_, textures) = reflectance(attribute);
    assert!(
        matches!(&textures[0].kind, TextureKind::MeshAttribute { name, scale: 2.0 } if name == "vertex_color")
    );
    let scaled = format!(
        r#"<texture type="scale" name="reflectance"><float name="scale" value="0.5"/>{attribute}</texture>"#
    );
    let (_, textures) = reflectance(&scaled);
    let inner = Color::Texture(crate::TextureId(0));
    assert!(
        matches!(&textures[1].kind, TextureKind::Scaled { color, factor } if *color == inner && *factor == [0.5; 3])
    );
    for (texture, color) in [
        (r#"type="rawconstant" name="reflectance"><float name="value" value="0.25"/>"#, [0.25; 3]),
        (
            r#"type="rawconstant" name="reflectance"><vector name="value" value="0.1 0.2 0.3"/>"#,
            [0.1, 0.2, 0.3],
        ),
        (r#"type="uniform" name="reflectance"><float name="value" value="0.75"/>"#, [0.75; 3]),
        (r#"type="srgb" name="reflectance"><rgb name="color" value="0.1 0.2 0.3"/>"#, [0.1, 0.2, 0.3]),
    ] {
        assert_eq!(
            reflectance(&format!("<texture {texture}</texture>")).0,
            Color::Constant(color),
            "{texture}"
        );
    }
    let black = "no mesh of the scene has an attribute \"vertex_color\"; it is black";
    assert!(loaded(attribute).warnings.iter().any(|w| w.message == black));
    let error = try_load(r#"<texture type="mesh_attribute"><string name="name" value="color"/></texture>"#);
    assert!(error.unwrap_err().to_string().contains("begins with neither vertex_ nor face_"));
}

#[test]
fn attributes_follow_their_vertices_and_faces() {
    let folder = tempfile::tempdir().unwrap();
    let ply = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n\
        property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float w_0\nelement face 2\n\
        property list uchar int vertex_indices\nproperty float weight_0\nend_header\n\
        nan 0 0 1 2 3 9\n0 0 0 0 255 0 1\n1 0 0 255 0 0 2\n1 1 0 0 0 255 inf\n0 1 0 255 255 255 4\n\
        3 0 1 2 7\n4 1 2 3 4 8\n";
    fs::write(folder.path().join("m.ply"), ply).unwrap();
    let with = |names: &[&str]| {
        let texture = |name: &&str| {
            format!(r#"<texture type="mesh_attribute"><string name="name" value="{name}"/></texture>"#)
        };
        let textures: String = names.iter().map(texture).collect();
        let shape = r#"<shape type="ply"><string name="filename" value="m.ply"/></shape>"#;
        fs::write(folder.path().join("scene.xml"), super::scene(&format!("{shape}{textures}"))).unwrap();
        load(&folder.path().join("scene.xml"), &LoadOptions::default()).unwrap()
    };
    let scene = with(&["vertex_color", "vertex_w", "face_weight"]);
    let mesh = |scene: &Scene| match &scene.shapes[0].kind {
        ShapeKind::Mesh(mesh) => Arc::clone(mesh),
        other => panic!("{other:?}"),
    };
    let kept: Vec<_> = mesh(&with(&["vertex_w"])).attributes.iter().map(|a| a.name.clone()).collect();
    assert_eq!(kept, ["vertex_w"]); // what no texture looks up is let go
    let mesh = mesh(&scene);
    let values: Vec<_> =
        mesh.attributes.iter().map(|a| (a.name.as_str(), a.channels, &a.values[..])).collect();
    let color = [0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
    assert_eq!(
        values,
        [
            ("vertex_color", 3, &color[..]),
            ("vertex_w", 1, &[1.0, 2.0, 0.0, 4.0]),
            ("face_weight", 1, &[8.0, 8.0])
        ]
    );
    let notes: Vec<_> = scene.warnings.iter().map(|w| w.message.as_str()).collect();
    assert!(notes[0].contains("read as sRGB with white at 255"), "{notes:?}");
    assert!(notes.iter().any(|n| n.contains("1 values of vertex_w are not finite")), "{notes:?}");
}
