use std::sync::Arc;

use limpid_scenes::{
    AttributeDomain, Image, Mesh, MeshAttribute, Place, ShapeKind, TexelFilter, Texels, WrapMode,
};

use super::*;

fn prepare(kinds: Vec<TextureKind>, uv_from_surface: DMat3) -> Textures {
    let textures = kinds
        .into_iter()
        .map(|kind| limpid_scenes::Texture {
            name: "t".into(),
            kind,
            uv_from_surface,
            place: Place::default(),
        })
        .collect();
    Textures::prepare(&Scene { textures, ..Scene::default() })
}

/// 4×2 texels of (column, row, something).
fn picture() -> Arc<Image> {
    let texel = |j: u32, i: u32| [i as f32, j as f32, ((i * 7 + j * 3) % 5) as f32];
    let values = (0..2).flat_map(|j| (0..4).flat_map(move |i| texel(j, i))).collect();
    Arc::new(Image { width: 4, height: 2, texels: Texels::Linear32(values) })
}

fn bitmap(filter: TexelFilter, wrap: WrapMode) -> TextureKind {
    TextureKind::Bitmap { image: picture(), filter, wrap }
}

const FIRST: Color = Color::Texture(TextureId(0));

const POINTS: [[f32; 2]; 8] =
    [[0.1, 0.2], [0.49, 0.8], [0.95, 0.97], [-0.3, 1.3], [1.6, -0.7], [2.3, 3.9], [0.5, 0.5], [0.25, 0.75]];

fn assert_colors(textures: &Textures, truth: [[f32; 3]; 8], what: &str) {
    for (uv, truth) in POINTS.into_iter().zip(truth) {
        let color = textures.color(FIRST, Vec2::from(uv));
        assert!(color.abs_diff_eq(truth.into(), 1e-5), "{what} at {uv:?}: {color}, not {truth:?}");
    }
}

// What Mitsuba 3.9.1 (scalar_rgb) gives for the same picture, raw.
#[rustfmt::skip]
const MITSUBA: [(TexelFilter, WrapMode, [[f32; 3]; 8]); 6] = [
    (TexelFilter::Nearest, WrapMode::Repeat, [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [3.0, 1.0, 4.0], [2.0, 0.0, 4.0], [2.0, 0.0, 4.0], [1.0, 1.0, 0.0], [2.0, 1.0, 2.0], [1.0, 1.0, 0.0]]),
    (TexelFilter::Nearest, WrapMode::Mirror, [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [3.0, 1.0, 4.0], [1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 2.0], [2.0, 1.0, 2.0], [1.0, 1.0, 0.0]]),
    (TexelFilter::Nearest, WrapMode::Clamp, [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [3.0, 1.0, 4.0], [0.0, 1.0, 3.0], [3.0, 0.0, 1.0], [3.0, 1.0, 4.0], [2.0, 1.0, 2.0], [1.0, 1.0, 0.0]]),
    (TexelFilter::Bilinear, WrapMode::Repeat, [[0.3, 0.1, 0.4], [1.46, 0.9, 1.12], [2.1, 0.56, 2.38], [2.3, 0.1, 3.05], [1.9, 0.1, 3.6], [0.7, 0.7, 1.05], [1.5, 0.5, 2.0], [0.5, 1.0, 1.5]]),
    (TexelFilter::Bilinear, WrapMode::Mirror, [[0.0, 0.0, 0.0], [1.46, 1.0, 0.92], [3.0, 1.0, 4.0], [0.7, 0.9, 0.95], [1.1, 0.9, 0.4], [0.7, 0.0, 1.4], [1.5, 0.5, 2.0], [0.5, 1.0, 1.5]]),
    (TexelFilter::Bilinear, WrapMode::Clamp, [[0.0, 0.0, 0.0], [1.46, 1.0, 0.92], [3.0, 1.0, 4.0], [0.0, 1.0, 3.0], [3.0, 0.0, 1.0], [3.0, 1.0, 4.0], [1.5, 0.5, 2.0], [0.5, 1.0, 1.5]]),
];

#[test]
fn bitmaps_are_looked_up_as_in_mitsuba() {
    for (filter, wrap, truth) in MITSUBA {
        let textures = prepare(vec![bitmap(filter, wrap)], DMat3::IDENTITY);
        assert_colors(&textures, truth, &format!("{filter:?} {wrap:?}"));
    }
}

#[test]
fn surface_coordinates_are_transformed_as_in_mitsuba() {
    let uv_from_surface = DMat3::from_cols_array_2d(&[[2.0, 0.25, 0.0], [0.5, 3.0, 0.0], [0.1, 0.2, 1.0]]);
    let textures = prepare(vec![bitmap(TexelFilter::Bilinear, WrapMode::Repeat)], uv_from_surface);
    #[rustfmt::skip]
    let truth = [[1.1, 0.85, 0.5], [1.42, 0.945, 0.95], [1.44, 0.195, 2.49], [0.1, 0.45, 1.325], [2.1, 0.5, 2.2], [2.1, 0.45, 3.025], [0.9, 0.85, 0.525], [1.8, 0.525, 2.175]];
    assert_colors(&textures, truth, "transformed");
}

fn checkerboard(color0: Color, color1: Color) -> TextureKind {
    TextureKind::Checkerboard { color0, color1 }
}

#[test]
fn checkers_are_where_mitsuba_has_them() {
    let (red, green) = (Color::Constant([1.0, 0.0, 0.0]), Color::Constant([0.0, 1.0, 0.0]));
    let textures = prepare(vec![checkerboard(red, green)], DMat3::IDENTITY);
    let is_red = |u, v| textures.color(FIRST, Vec2::new(u, v)).x == 1.0;
    let found = POINTS.map(|[u, v]| is_red(u, v));
    assert_eq!(found, [true, false, true, false, false, false, true, false]);
    // On the borders.
    assert_eq!(
        [is_red(0.5, 0.2), is_red(0.2, 0.5), is_red(0.0, 0.7), is_red(1.0, 0.7)],
        [true, true, false, false]
    );
}

#[test]
fn checkers_may_be_textures_with_mappings_of_their_own() {
    let white = Color::Constant([1.0; 3]);
    let kinds = vec![
        checkerboard(Color::Texture(TextureId(1)), white),
        bitmap(TexelFilter::Nearest, WrapMode::Repeat),
    ];
    let textures = prepare(kinds, DMat3::from_diagonal(glam::DVec3::new(2.0, 1.0, 1.0)));
    // 2u = 0.4 and v = 0.3 lie below ½; the picture sees 2u as well, once.
    assert_eq!(textures.color(FIRST, Vec2::new(0.2, 0.3)), Rgb::new(1.0, 0.0, 2.0));
    assert_eq!(textures.color(FIRST, Vec2::new(0.4, 0.3)), Rgb::ONE);
}

#[test]
fn a_channel_is_that_of_the_texture_as_a_grey() {
    let of = TextureId(1);
    let texture = bitmap(TexelFilter::Nearest, WrapMode::Repeat);
    for (channel, truth) in [(0, 3.0), (1, 1.0), (2, 4.0), (9, 4.0)] {
        let textures = prepare(vec![TextureKind::Channel { of, channel }, texture.clone()], DMat3::IDENTITY);
        assert_eq!(textures.color(FIRST, Vec2::new(0.95, 0.97)), Rgb::splat(truth), "channel {channel}");
        let number = textures.scalar(Scalar::Texture(TextureId(0)), Vec2::new(0.95, 0.97));
        assert!((number - truth).abs() < 1e-5, "channel {channel}: {number}");
    }
}

#[test]
fn a_product_multiplies_channel_by_channel() {
    let (a, b) = (Color::Constant([2.0, 0.5, 0.25]), Color::Texture(TextureId(1)));
    let kinds = vec![TextureKind::Product { a, b }, bitmap(TexelFilter::Nearest, WrapMode::Repeat)];
    let textures = prepare(kinds, DMat3::IDENTITY);
    assert_eq!(textures.color(FIRST, Vec2::new(0.95, 0.97)), Rgb::new(6.0, 0.5, 1.0));
    let kinds = vec![TextureKind::Product { a: b, b }, bitmap(TexelFilter::Nearest, WrapMode::Repeat)];
    assert_eq!(prepare(kinds, DMat3::IDENTITY).color(FIRST, Vec2::new(0.95, 0.97)), Rgb::new(9.0, 1.0, 16.0));
}

#[test]
fn textures_that_contain_themselves_end() {
    let channel = TextureKind::Channel { of: TextureId(0), channel: 0 };
    for kind in [checkerboard(FIRST, FIRST), channel, TextureKind::Product { a: FIRST, b: FIRST }] {
        let textures = prepare(vec![kind], DMat3::IDENTITY);
        assert_eq!(textures.color(FIRST, Vec2::ZERO), Rgb::ZERO);
    }
    let textures = prepare(vec![checkerboard(FIRST, FIRST)], DMat3::IDENTITY);
    assert_eq!(textures.color(Color::Texture(TextureId(9)), Vec2::ZERO), Rgb::ZERO);
}

#[test]
fn bytes_are_decoded() {
    let bytes = vec![0, 10, 200];
    let decoded = |texels| {
        let image = Arc::new(Image { width: 1, height: 1, texels });
        let kind = TextureKind::Bitmap { image, filter: TexelFilter::Bilinear, wrap: WrapMode::Repeat };
        prepare(vec![kind], DMat3::IDENTITY).color(FIRST, Vec2::splat(0.3))
    };
    // The first as Mitsuba 3.9.1 decodes them.
    assert!(decoded(Texels::Srgb8(bytes.clone())).abs_diff_eq(Rgb::new(0.0, 0.003035, 0.577581), 1e-6));
    assert!(decoded(Texels::Linear8(bytes)).abs_diff_eq(Rgb::new(0.0, 10.0, 200.0) / 255.0, 1e-7));
}

#[test]
fn numbers_from_colours_are_their_luminance() {
    let textures = prepare(vec![checkerboard(Color::Constant([1.0, 2.0, 3.0]), FIRST)], DMat3::IDENTITY);
    let number = textures.scalar(Scalar::Texture(TextureId(0)), Vec2::ZERO);
    assert!((number - (0.212639 + 2.0 * 0.715169 + 3.0 * 0.072192)).abs() < 1e-6);
    assert_eq!(textures.scalar(Scalar::Constant(0.25), Vec2::ZERO), 0.25);
}

#[test]
fn nonfinite_texels_come_through_and_nonfinite_coordinates_do_not() {
    let mut values = vec![0.5; 12];
    values[3] = f32::NAN;
    values[7] = f32::INFINITY;
    let image = Arc::new(Image { width: 2, height: 2, texels: Texels::Linear32(values) });
    for wrap in [WrapMode::Repeat, WrapMode::Mirror, WrapMode::Clamp] {
        for filter in [TexelFilter::Nearest, TexelFilter::Bilinear] {
            let kind = TextureKind::Bitmap { image: image.clone(), filter, wrap };
            let textures = prepare(vec![kind, bitmap(filter, wrap)], DMat3::IDENTITY);
            assert!(textures.color(FIRST, Vec2::new(0.7, 0.3)).x.is_nan());
            assert_eq!(textures.color(FIRST, Vec2::new(0.3, 0.7)).y, f32::INFINITY);
            let odd =
                [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN, 1e15, -1e-30, 1.0, -1.0];
            for u in odd {
                for v in odd {
                    assert!(
                        textures.color(Color::Texture(TextureId(1)), Vec2::new(u, v)).is_finite(),
                        "{u} {v}"
                    );
                }
            }
        }
    }
}

fn attribute(name: &str, domain: AttributeDomain, channels: u32, values: &[f32]) -> MeshAttribute {
    MeshAttribute { name: name.into(), domain, channels, values: values.to_vec() }
}

/// A scene whose second shape is a mesh of two triangles with attributes, and again in a group.
fn with_attributes(kinds: Vec<TextureKind>) -> Textures {
    let mesh = Arc::new(Mesh {
        positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
        triangles: vec![[0, 1, 2], [3, 0, 2]],
        attributes: vec![
            attribute(
                "vertex_color",
                AttributeDomain::Vertex,
                3,
                &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 4.0, 4.0, 4.0],
            ),
            attribute("vertex_w", AttributeDomain::Vertex, 1, &[1.0, 2.0, 3.0, 4.0]),
            attribute("face_color", AttributeDomain::Face, 3, &[0.1, 0.2, 0.3, 0.4, 0.5, 0.6]),
            attribute("face_w", AttributeDomain::Face, 1, &[5.0, 6.0]),
        ],
        ..Mesh::default()
    });
    let mut scene = limpid_testkit::scene::scene(
        limpid_testkit::scene::camera(glam::DVec3::ZERO, glam::DVec3::X, 1, 1),
        Vec::new(),
    );
    let place = || Place::default();
    scene.textures = (kinds.into_iter())
        .map(|kind| limpid_scenes::Texture {
            name: "t".into(),
            kind,
            uv_from_surface: DMat3::IDENTITY,
            place: place(),
        })
        .collect();
    let mut add = |kind| limpid_testkit::scene::add(&mut scene, kind, glam::DMat4::IDENTITY, 0).clone();
    add(ShapeKind::Cube);
    let shape = add(ShapeKind::Mesh(mesh));
    add(ShapeKind::Rectangle);
    let sphere = add(ShapeKind::Disk);
    scene.groups.push(limpid_scenes::Group { name: "g".into(), shapes: vec![sphere, shape], place: place() });
    Textures::prepare(&scene)
}

#[test]
fn attributes_are_those_of_the_mesh_that_is_hit() {
    let named = |name: &str, scale| TextureKind::MeshAttribute { name: name.into(), scale };
    let textures = with_attributes(vec![
        named("vertex_color", 1.0),
        named("vertex_w", 0.5),
        named("face_color", 1.0),
        named("face_w", 1.0),
        TextureKind::Scaled { color: Color::Texture(TextureId(2)), factor: [10.0, 0.0, 1.0] },
        named("face_none", 1.0),
    ]);
    let at = |texture, prim| {
        let point = TexturePoint { uv: Vec2::ZERO, prim, bary: Vec2::new(0.25, 0.5) };
        textures.color(Color::Texture(TextureId(texture)), point)
    };
    // The cube has 12 triangles, the mesh 12 and 13, the square 14 and 15, the mesh in the group 16 and 17.
    for first in [12, 16] {
        assert_eq!(at(0, first), Rgb::new(0.25, 0.25, 0.5));
        assert_eq!(at(0, first + 1), Rgb::new(1.25, 1.0, 1.5));
        assert_eq!(at(1, first), Rgb::splat(0.5 * (0.25 + 0.5 + 1.5)));
        assert_eq!(at(2, first + 1), Rgb::new(0.4, 0.5, 0.6));
        assert_eq!(at(3, first), Rgb::splat(5.0));
        assert_eq!(at(4, first), Rgb::new(1.0, 0.0, 0.3));
        assert_eq!(at(5, first), Rgb::ZERO);
    }
    for prim in [0, 11, 14, 15, 18, NONE] {
        assert_eq!(at(0, prim), Rgb::ZERO, "{prim}");
    }
}
