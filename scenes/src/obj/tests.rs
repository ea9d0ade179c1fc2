use std::fs;

use super::*;
use crate::testing::mutations;
use crate::{
    Color, GltfMaterial, LightKind, MaterialId, MaterialKind, NormalMap, Scalar, Texels, TextureKind,
};

/// Reads an OBJ text, with a library `m.mtl` beside it.
fn loaded(obj: &str, mtl: &str) -> Scene {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("m.mtl"), mtl).unwrap();
    let mut png = Vec::new();
    let encoder = ::image::codecs::png::PngEncoder::new(&mut png);
    let texels = [128, 128, 255, 255, 120, 130, 250, 51];
    ::image::ImageEncoder::write_image(encoder, &texels, 2, 1, ::image::ExtendedColorType::Rgba8).unwrap();
    fs::write(folder.path().join("blue 1.png"), png).unwrap();
    read(obj.as_bytes(), &folder.path().join("m.obj"), Files::default()).unwrap()
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// The material of a library, as the first shape shows it, from the outermost inwards.
fn kinds(mtl: &str) -> (Scene, Vec<MaterialKind>) {
    let obj = format!("mtllib m.mtl\n{SQUARE}usemtl a\nf 1 2 3 4\n");
    let scene = loaded(&obj, &format!("newmtl a\n{mtl}"));
    let (mut id, mut kinds) = (scene.shapes[0].material, Vec::new());
    loop {
        let kind = scene.materials[id.0 as usize].kind.clone();
        let inner: Option<MaterialId> = kind.inner().first().copied();
        kinds.push(kind);
        match inner {
            Some(inner) => id = inner,
            None => return (scene, kinds),
        }
    }
}

fn gltf(mtl: &str) -> GltfMaterial {
    match kinds(mtl).1.pop() {
        Some(MaterialKind::Gltf(material)) => *material,
        other => panic!("{other:?}"),
    }
}

fn messages(scene: &Scene) -> Vec<String> {
    let text = |w: &Warning| {
        format!("{}:{}: {}", w.place.file.file_name().unwrap().display(), w.place.line, w.message)
    };
    scene.warnings.iter().map(text).collect()
}

#[test]
fn faces_are_shapes_by_object_and_material_however_often_these_change() {
    let obj = format!(
        "mtllib m.mtl\n{SQUARE}o x\nusemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\nusemtl a\nf 1 2 4\no y\nf 2 3 4\n"
    );
    let scene = loaded(&obj, "newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 1 0\n");
    let counts: Vec<_> = scene
        .shapes
        .iter()
        .map(|shape| match &shape.kind {
            ShapeKind::Mesh(mesh) => (shape.name.as_str(), mesh.triangles.len()),
            _ => panic!("a mesh"),
        })
        .collect();
    assert_eq!(counts, [("x a", 2), ("x b", 1), ("y a", 1)]);
    assert_eq!(scene.shapes[0].material, scene.shapes[2].material);
}

#[test]
fn faces_are_flat_outside_smoothing_groups_and_smooth_within_one() {
    // two squares at a right angle that share an edge
    let mesh = |groups: [&str; 2]| {
        let obj =
            format!("{SQUARE}v 0 0 1\nv 1 0 1\ns {}\nf 1 2 3 4\ns {}\nf 1 5 6 2\n", groups[0], groups[1]);
        match loaded(&obj, "").shapes.remove(0).kind {
            ShapeKind::Mesh(mesh) => mesh,
            _ => panic!("a mesh"),
        }
    };
    assert!(mesh(["off", "0"]).normals.is_empty());
    assert_eq!(mesh(["off", "off"]).positions.len(), 6);
    let one = mesh(["1", "1"]);
    assert_eq!(one.positions.len(), 6);
    let half = 0.5f32.sqrt();
    assert!(
        (glam::Vec3::from(one.normals[0]) - glam::Vec3::new(0.0, half, half)).length() < 1e-6,
        "{:?}",
        one.normals
    );
    let two = mesh(["1", "2"]);
    assert_eq!((two.positions.len(), two.normals[0]), (8, [0.0, 0.0, 1.0]));
    let mixed = mesh(["1", "off"]);
    assert_eq!((mixed.positions.len(), mixed.normals[0]), (8, [0.0, 0.0, 1.0]));
}

#[test]
fn a_dull_material_is_diffuse_and_a_shiny_one_has_a_highlight_as_wide_as_its_exponent() {
    let (_, dull) = kinds("Kd 0.1 0.2 0.3\nKs 0 0 0\nNs 10\n");
    assert!(matches!(dull[0], MaterialKind::TwoSided { .. }));
    assert_eq!(dull[1], MaterialKind::Diffuse { reflectance: Color::Constant([0.1, 0.2, 0.3]) });
    let shiny = gltf("Kd 0.1 0.2 0.3\nKs 0.5 0.5 0.5\nNs 30\nNi 1.6\n");
    assert_eq!(shiny.roughness, Scalar::Constant(0.5)); // α = √(2/32) = 1/4
    assert_eq!((shiny.ior, shiny.specular_color), (1.6, Color::Constant([0.5; 3])));
    let mirror = gltf("Kd 0 0 0\nKs 0.9 0.9 0.9\nillum 5\n");
    assert_eq!((mirror.metallic, mirror.roughness), (Scalar::Constant(1.0), Scalar::Constant(0.0)));
    let (_, glass) = kinds("Ks 1 1 1\nNi 1.5\nTf 0.5 1 1\nillum 7\nd 0.2\n");
    let [MaterialKind::Gltf(glass)] = &glass[..] else { panic!("{glass:?}") };
    assert!(glass.transmits() && !glass.thin);
    assert_eq!(glass.base_color, Color::Constant([0.5, 1.0, 1.0]));
}

#[test]
fn statements_of_the_physical_extension_make_its_material() {
    let material = gltf("Kd 1 0.5 0\nPr 0.2\nPm 0.3\nPs 0.4\nPc 0.5\nPcr 0.6\nNi 1.0\n");
    assert_eq!(material.roughness, Scalar::Constant(0.2));
    assert_eq!(material.metallic, Scalar::Constant(0.3));
    assert_eq!(material.sheen_color, Color::Constant([0.4; 3]));
    assert_eq!(
        (material.clearcoat, material.clearcoat_roughness),
        (Scalar::Constant(0.5), Scalar::Constant(0.6))
    );
    assert_eq!(material.ior, 1.0);
}

#[test]
fn opacity_is_d_or_one_less_tr() {
    for (text, opacity) in
        [("d 0.25", 0.25), ("Tr 0.25", 0.75), ("d 0.25\nTr 0.9", 0.25), ("d -halo 0.5", 0.5)]
    {
        let (_, kinds) = kinds(text);
        assert!(
            matches!(kinds[0], MaterialKind::Mask { opacity: Scalar::Constant(x), .. } if x == opacity),
            "{text}"
        );
    }
    let (scene, kinds) = kinds("Tr 1");
    assert!(!matches!(kinds[0], MaterialKind::Mask { .. }));
    assert!(messages(&scene)[0].starts_with("m.mtl:1: Tr 1"), "{:?}", messages(&scene));
}

#[test]
fn what_shines_needs_no_sky() {
    let (scene, _) = kinds("Ke 17 12 4\n");
    assert_eq!(scene.shapes[0].emission.as_ref().unwrap().radiance, Color::Constant([17.0, 12.0, 4.0]));
    assert!(scene.lights.is_empty());
    let (scene, _) = kinds("Ke 0 0 0\n");
    assert!(scene.shapes[0].emission.is_none());
    assert!(matches!(scene.lights[0].kind, LightKind::EnvMap { .. }));
}

#[test]
fn maps_have_their_options_and_pictures_of_normals_are_told_by_their_blue() {
    let (scene, kinds) = kinds(
        "Kd 0.5 0.5 0.5\nmap_Kd -s 2 4 -o 0.5 0.25 -clamp on .\\Blue 1.PNG\nmap_bump -bm 3 blue 1.png\n",
    );
    let MaterialKind::Perturbed { map: NormalMap::Tangent { scale: 3.0, .. }, .. } = kinds[0] else {
        panic!("{:?}", kinds[0])
    };
    let texture = &scene.textures[0];
    let TextureKind::Bitmap { image, wrap: crate::WrapMode::Clamp, .. } = &texture.kind else {
        panic!("{texture:?}")
    };
    assert!(matches!(image.texels, Texels::Srgb8(_)));
    // of a file that counts v upwards: u' = 2u + 0.5, w' = 4w + 0.25 with v = 1 − w
    let at = (texture.uv_from_surface * glam::DVec3::new(0.25, 0.75, 1.0)).truncate();
    assert_eq!(at, glam::DVec2::new(1.0, 1.0 - 1.25));
}

#[test]
fn opacity_maps_are_alpha_where_the_picture_has_it() {
    let (scene, kinds) = kinds("map_d blue 1.png\n");
    assert!(matches!(kinds[0], MaterialKind::Mask { opacity: Scalar::Texture(_), .. }));
    let TextureKind::Bitmap { image, .. } = &scene.textures[0].kind else { panic!("a picture") };
    assert_eq!(image.texels, Texels::Linear8(vec![255, 255, 255, 51, 51, 51]));
}

#[test]
fn what_is_missing_is_a_warning_with_its_line() {
    let obj = format!("mtllib n.mtl\n{SQUARE}usemtl a\nf 1 2 3 4\nusemtl b\nf 1 2 3\n");
    let warnings = messages(&loaded(&obj, ""));
    assert!(warnings[0].starts_with("m.obj:1: \"n.mtl\" is not there"), "{warnings:?}");
    assert!(warnings[1].starts_with("m.obj:6: no library has the material \"a\""), "{warnings:?}");
    assert!(warnings[2].starts_with("m.obj:8: no library"), "{warnings:?}");
    let (scene, _) = kinds("Kd 1 1 1\nmap_Kd nowhere.png\nfrobnicate 3\n");
    let warnings = messages(&scene);
    assert!(warnings[0].starts_with("m.mtl:4: frobnicate"), "{warnings:?}");
    assert!(warnings[1].starts_with("m.mtl:3: the file \"nowhere.png\" is not there"), "{warnings:?}");
}

#[test]
fn mutated_libraries_load_and_mutated_models_load_or_fail_but_neither_panics() {
    let mtl = "newmtl a\nKd .1 .2 .3\nKs 1 1 1\nNs 10\nNi 1.5\nd 0.5\nTf 1 1 1\nillum 7\nKe 1 1 1\nPr 0.2\nPm .3\nnorm -bm 2 blue 1.png\nmap_Kd -s 1 2 3 -o 1 -imfchan r -clamp on x.png\n";
    for bytes in mutations(mtl.as_bytes(), 5_000) {
        mtl::parse(&bytes);
    }
    let obj = format!(
        "mtllib m.mtl\no x\n{SQUARE}vt 0 0\nvn 0 0 1\ns 1\nusemtl a\nf 1/1/1 2/1/1 3/1/1 4//1\ns off\nf -1 -2 -3\n"
    );
    let folder = tempfile::tempdir().unwrap();
    let mut good = 0;
    for bytes in mutations(obj.as_bytes(), 5_000) {
        good += usize::from(read(&bytes, &folder.path().join("m.obj"), Files::default()).is_ok());
    }
    assert!((200..4_900).contains(&good), "{good}: the mutations are too wild or too tame");
}
