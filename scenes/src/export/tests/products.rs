//! Products and channels of textures.

use std::sync::Arc;

use glam::DMat3;

use super::*;
use crate::{
    Color, Image, MaterialKind, Rgb, TexelFilter, Texels, Texture, TextureId, TextureKind, WrapMode,
};

/// A triangle whose material has the last of these textures, and whose vertices have these colours.
fn scene_of(kinds: &[TextureKind], colors: [Rgb; 3]) -> Scene {
    let folder = tempfile::tempdir().unwrap();
    let vertices = [[0, 0], [1, 0], [0, 1]].iter().zip(colors);
    let vertices = vertices.map(|([x, y], [r, g, b])| format!("{x} {y} 0 {r} {g} {b}\n")).collect::<String>();
    let ply = format!(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        property float color_0\nproperty float color_1\nproperty float color_2\nelement face 1\n\
        property list uchar int vertex_indices\nend_header\n{vertices}3 0 1 2\n"
    );
    fs::write(folder.path().join("m.ply"), ply).unwrap();
    let xml = r#"<scene version="3.0.0"><sensor type="perspective"/><shape type="ply"><string name="filename" value="m.ply"/>
        <bsdf type="diffuse"><texture type="mesh_attribute" name="reflectance"><string name="name" value="vertex_color"/>
        </texture></bsdf></shape></scene>"#;
    fs::write(folder.path().join("scene.xml"), xml).unwrap();
    let mut scene = load(&folder.path().join("scene.xml"), &LoadOptions::default()).unwrap();
    scene.textures.clear();
    for kind in kinds {
        let place = scene.shapes[0].place.clone();
        let (name, uv_from_surface) = (format!("number {}", scene.textures.len()), DMat3::IDENTITY);
        scene.textures.push(Texture { name, kind: kind.clone(), uv_from_surface, place });
    }
    let last = TextureId(kinds.len() as u32 - 1);
    let id = scene.shapes[0].material;
    scene.materials[id.0 as usize].kind = MaterialKind::Diffuse { reflectance: Color::Texture(last) };
    scene
}

fn picture(texels: &[f32], width: u32) -> TextureKind {
    let image = Image { width, height: 1, texels: Texels::Linear32(texels.to_vec()) };
    TextureKind::Bitmap { image: Arc::new(image), filter: TexelFilter::Bilinear, wrap: WrapMode::Repeat }
}

/// The texture of the material, when it has been exported and read, and the notes.
fn exported(kinds: &[TextureKind], colors: [Rgb; 3]) -> (String, Vec<String>) {
    let (again, exported) = there_and_back(&scene_of(kinds, colors));
    let MaterialKind::Diffuse { reflectance } = again.materials[again.shapes[0].material.0 as usize].kind
    else {
        panic!("{:?}", again.materials)
    };
    let shown = match reflectance {
        Color::Constant(color) => format!("{color:?}"),
        Color::Texture(id) => match &again.textures[id.0 as usize].kind {
            TextureKind::Bitmap { image, .. } => format!("{:?}", image.texels),
            kind => format!("{kind:?}"),
        },
    };
    (shown, exported.notes)
}

fn attribute() -> TextureKind {
    TextureKind::MeshAttribute { name: "vertex_color".into(), scale: 1.0 }
}

fn product(a: u32, b: u32) -> TextureKind {
    TextureKind::Product { a: Color::Texture(TextureId(a)), b: Color::Texture(TextureId(b)) }
}

const CORNERS: [Rgb; 3] = [[1.0, 0.0, 0.25], [0.5, 0.25, 0.25], [0.0, 0.5, 0.25]];
const TEXELS: [f32; 6] = [0.0, 0.25, 0.5, 1.0, 0.75, 0.5];

#[test]
fn a_product_with_what_is_the_same_everywhere_is_exact() {
    let checks = TextureKind::Checkerboard {
        color0: Color::Constant([0.5, 0.25, 1.0]),
        color1: Color::Constant([0.25; 3]),
    };
    let tint =
        |of| TextureKind::Product { a: Color::Constant([1.0, 2.0, 0.5]), b: Color::Texture(TextureId(of)) };
    let scaled = r#"MeshAttribute { name: "vertex_color", scale: 0.5 }"#;
    let tinted = "Checkerboard { color0: Constant([0.5, 0.5, 0.5]), color1: Constant([0.25, 0.5, 0.125]) }";
    for (kinds, colors, expected) in [
        // white vertices, as many exporters write them
        (
            vec![picture(&TEXELS, 2), attribute(), product(0, 1)],
            [[1.0; 3]; 3],
            "Linear32([0.0, 0.25, 0.5, 1.0, 0.75, 0.5])",
        ),
        (
            vec![picture(&TEXELS, 2), attribute(), product(1, 0)],
            [[1.0, 0.5, 2.0]; 3],
            "Linear32([0.0, 0.125, 1.0, 1.0, 0.375, 1.0])",
        ),
        (vec![picture(&[0.5; 6], 2), attribute(), product(0, 1)], CORNERS, scaled),
        (vec![checks.clone(), tint(0)], CORNERS, tinted),
        (
            vec![attribute(), TextureKind::Channel { of: TextureId(0), channel: 1 }],
            [[1.0, 0.5, 2.0]; 3],
            "[0.5, 0.5, 0.5]",
        ),
    ] {
        let (shown, notes) = exported(&kinds, colors);
        assert_eq!(shown, expected, "{kinds:?}");
        assert!(notes.is_empty(), "{kinds:?}: {notes:?}");
    }
}

#[test]
fn a_picture_stands_in_for_its_product_with_the_colours_of_vertices() {
    for kind in [product(0, 1), product(1, 0)] {
        let (shown, notes) = exported(&[picture(&TEXELS, 2), attribute(), kind], CORNERS);
        assert_eq!(shown, "Linear32([0.0, 0.0625, 0.125, 0.5, 0.1875, 0.125])");
        let expected = "texture \"number 2\": Mitsuba has no product of a picture and the values of vertices: in place of the \
                        latter stands its mean";
        assert_eq!(notes, [expected]);
    }
}

#[test]
fn the_first_picture_stands_in_for_a_product_of_two_that_do_not_fit() {
    let other = [0.5, 0.5, 0.5, 0.0, 0.0, 0.0, 0.25, 0.25, 0.25];
    let (shown, notes) = exported(&[picture(&TEXELS, 2), picture(&other, 3), product(0, 1)], CORNERS);
    assert_eq!(shown, "Linear32([0.0, 0.0625, 0.125, 0.25, 0.1875, 0.125])");
    assert!(notes.len() == 1 && notes[0].contains("a picture and a picture"), "{notes:?}");
}

#[test]
fn the_mean_stands_in_for_a_channel_of_what_is_no_picture() {
    let channel = TextureKind::Channel { of: TextureId(0), channel: 1 };
    let (shown, notes) = exported(&[attribute(), channel], CORNERS);
    assert_eq!(shown, "[0.25, 0.25, 0.25]");
    assert!(notes.len() == 1 && notes[0].contains("no channel of the values of vertices"), "{notes:?}");
}
