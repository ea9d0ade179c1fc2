//! Materials, textures, cameras and lights.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::*;
use crate::{
    Color, GltfMaterial, LightKind, MaterialKind, NormalMap, Projection, Scalar, TexelFilter, Texels,
    TextureId, TextureKind, WrapMode,
};

/// A PNG of 2×1 texels with alpha: (255, 128, 0, 255) and (0, 64, 255, 51).
fn png() -> String {
    let mut bytes = Vec::new();
    let encoder = ::image::codecs::png::PngEncoder::new(&mut bytes);
    let texels = [255, 128, 0, 255, 0, 64, 255, 51];
    ::image::ImageEncoder::write_image(encoder, &texels, 2, 1, ::image::ExtendedColorType::Rgba8).unwrap();
    format!("data:image/png;base64,{}", base64(&bytes))
}

/// The scene of a square with this material; texture 0 is [`png`].
fn with_material(material: &str) -> Scene {
    loaded(&json_of(material), &square())
}

fn json_of(material: &str) -> String {
    let rest = format!(
        r#", "materials": [{{"name": "m" {material}}}], "textures": [{{"source": 0, "sampler": 0}}],
        "samplers": [{{"magFilter": 9728, "wrapS": 33071, "wrapT": 33071}}], "images": [{{"uri": "{}"}}]"#,
        png()
    );
    with_square(r#", "material": 0"#, &rest)
}

/// The kinds from the outermost material of the first shape inwards.
fn kinds(scene: &Scene) -> Vec<MaterialKind> {
    let mut id = scene.shapes[0].material;
    let mut kinds = Vec::new();
    loop {
        let kind = scene.materials[id.0 as usize].kind.clone();
        let inner = kind.inner().first().copied();
        kinds.push(kind);
        match inner {
            Some(inner) => id = inner,
            None => return kinds,
        }
    }
}

fn gltf(scene: &Scene) -> GltfMaterial {
    match kinds(scene).pop() {
        Some(MaterialKind::Gltf(material)) => *material,
        other => panic!("{other:?}"),
    }
}

fn texture(scene: &Scene, TextureId(id): TextureId) -> &TextureKind {
    &scene.textures[id as usize].kind
}

#[test]
fn a_primitive_without_material_is_rough_white_metal_as_the_format_says() {
    let material = gltf(&loaded(&with_square("", ""), &square()));
    assert_eq!(material, GltfMaterial::default());
}

#[test]
fn factors_multiply_channels_of_textures() {
    let scene = with_material(
        r#", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 1, 1, 1], "baseColorTexture": {"index": 0},
        "metallicFactor": 0.25, "metallicRoughnessTexture": {"index": 0}}"#,
    );
    let material = gltf(&scene);
    let Color::Texture(base) = material.base_color else { panic!("{material:?}") };
    let TextureKind::Scaled { factor: [0.5, 1.0, 1.0], color: Color::Texture(base) } = *texture(&scene, base)
    else {
        panic!("{:?}", texture(&scene, base))
    };
    let TextureKind::Bitmap { image, filter, wrap } = texture(&scene, base) else { panic!("a picture") };
    assert_eq!((*filter, *wrap), (TexelFilter::Nearest, WrapMode::Clamp));
    assert!(matches!(image.texels, Texels::Srgb8(_)), "colours are sRGB");
    // a factor of 1 needs no product
    let Scalar::Texture(roughness) = material.roughness else { panic!("{material:?}") };
    let TextureKind::Channel { of, channel: 1 } = *texture(&scene, roughness) else { panic!("green") };
    let TextureKind::Bitmap { image, .. } = texture(&scene, of) else { panic!("a picture") };
    assert!(matches!(image.texels, Texels::Linear8(_)), "numbers are linear");
    let Scalar::Texture(metallic) = material.metallic else { panic!("{material:?}") };
    let TextureKind::Scaled { color: Color::Texture(blue), .. } = *texture(&scene, metallic) else {
        panic!("product")
    };
    let TextureKind::Channel { of: other, channel: 2 } = *texture(&scene, blue) else { panic!("blue") };
    assert_eq!(of, other, "one picture, decoded once");
}

#[test]
fn alpha_modes_cut_and_blend() {
    let base =
        r#""pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5], "baseColorTexture": {"index": 0}}"#;
    assert_eq!(kinds(&with_material(&format!(", {base}"))).len(), 1);
    let mask = |mode: &str| {
        let scene = with_material(&format!(", {base}, {mode}"));
        let MaterialKind::Mask { opacity: Scalar::Texture(opacity), .. } = kinds(&scene)[0] else {
            panic!("{:?}", kinds(&scene))
        };
        let of = match *texture(&scene, opacity) {
            TextureKind::Scaled { factor: [0.5, 0.5, 0.5], color: Color::Texture(of) } => of,
            _ => opacity,
        };
        let TextureKind::Bitmap { image, .. } = texture(&scene, of) else { panic!("a picture") };
        image.texels.clone()
    };
    assert_eq!(mask(r#""alphaMode": "BLEND""#), Texels::Linear8(vec![255, 255, 255, 51, 51, 51]));
    // 0.5 and 0.1 against the cutoff
    let cut = |cutoff: f32| mask(&format!(r#""alphaMode": "MASK", "alphaCutoff": {cutoff}"#));
    assert_eq!(cut(0.4), Texels::Linear8(vec![255, 255, 255, 0, 0, 0]));
    assert_eq!(cut(0.6), Texels::Linear8(vec![0; 6]));
    assert_eq!(cut(0.05), Texels::Linear8(vec![255; 6]));
}

#[test]
fn two_sides_go_inside_normal_maps_and_glass_has_both_by_itself() {
    let scene = with_material(r#", "doubleSided": true, "normalTexture": {"index": 0, "scale": 0.5}"#);
    let kinds = kinds(&scene);
    assert!(matches!(kinds[0], MaterialKind::Perturbed { map: NormalMap::Tangent { scale: 0.5, .. }, .. }));
    assert!(matches!(kinds[1], MaterialKind::TwoSided { .. }));
    let glass = r#", "doubleSided": true, "pbrMetallicRoughness": {"metallicFactor": 0},
        "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}}"#;
    let scene = with_material(glass);
    let material = gltf(&scene);
    assert_eq!(super::looks::kinds(&scene).len(), 1);
    assert!(material.thin && material.transmission == Scalar::Constant(1.0));
}

#[test]
fn extensions_of_materials_are_read() {
    let material = gltf(&with_material(
        r#", "extensions": {
        "KHR_materials_ior": {"ior": 1.8},
        "KHR_materials_transmission": {"transmissionFactor": 0.5},
        "KHR_materials_volume": {"thicknessFactor": 2, "attenuationDistance": 3, "attenuationColor": [0.5, 1, 1]},
        "KHR_materials_clearcoat": {"clearcoatFactor": 0.25, "clearcoatRoughnessFactor": 0.75},
        "KHR_materials_sheen": {"sheenColorFactor": [0.1, 0.2, 0.3], "sheenRoughnessFactor": 0.4},
        "KHR_materials_specular": {"specularFactor": 0.6, "specularColorFactor": [2, 1, 0]}},
        "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.125}"#,
    ));
    let truth = GltfMaterial {
        base_color: Color::Constant([1.0; 3]),
        metallic: Scalar::Constant(0.0),
        roughness: Scalar::Constant(0.125),
        ior: 1.8,
        specular: Scalar::Constant(0.6),
        specular_color: Color::Constant([2.0, 1.0, 0.0]),
        clearcoat: Scalar::Constant(0.25),
        clearcoat_roughness: Scalar::Constant(0.75),
        sheen_color: Color::Constant([0.1, 0.2, 0.3]),
        sheen_roughness: Scalar::Constant(0.4),
        transmission: Scalar::Constant(0.5),
        thin: false,
        attenuation: Some((3.0, [0.5, 1.0, 1.0])),
    };
    assert_eq!(material, truth);
}

#[test]
fn emission_has_its_strength_and_unlit_surfaces_emit_their_colour() {
    let strong = r#", "emissiveFactor": [1, 0.5, 0], "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 8}}"#;
    let scene = with_material(strong);
    assert_eq!(scene.shapes[0].emission.as_ref().unwrap().radiance, Color::Constant([8.0, 4.0, 0.0]));
    assert!(scene.lights.is_empty(), "a lamp needs no sky");
    let unlit = r#", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 1]}, "extensions": {"KHR_materials_unlit": {}}"#;
    let scene = with_material(unlit);
    assert_eq!(scene.shapes[0].emission.as_ref().unwrap().radiance, Color::Constant([0.5, 0.25, 1.0]));
    assert!(matches!(
        kinds(&scene)[..],
        [MaterialKind::Diffuse { reflectance: Color::Constant([0.0, 0.0, 0.0]) }]
    ));
    assert!(matches!(scene.lights[0].kind, LightKind::EnvMap { .. }));
}

#[test]
fn texture_transforms_are_offset_rotation_and_scale_as_the_extension_has_them() {
    let quarter = std::f64::consts::FRAC_PI_2;
    let scene = with_material(&format!(
        r#", "pbrMetallicRoughness": {{"baseColorTexture": {{"index": 0, "extensions": {{"KHR_texture_transform":
        {{"offset": [0.5, 0.25], "rotation": {quarter}, "scale": [2, 3]}}}}}}}}"#
    ));
    let uv = |u: f64, v: f64| (scene.textures[0].uv_from_surface * DVec2::new(u, v).extend(1.0)).truncate();
    // counter-clockwise on the picture: u goes up, which is against v
    for (at, truth) in [((0.0, 0.0), (0.5, 0.25)), ((1.0, 0.0), (0.5, -1.75)), ((0.0, 1.0), (3.5, 0.25))] {
        let found = uv(at.0, at.1);
        assert!(found.distance(DVec2::new(truth.0, truth.1)) < 1e-12, "{at:?}: {found}");
    }
}

#[test]
fn the_set_of_texture_coordinates_is_the_one_that_the_textures_ask_for() {
    let material = r#", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 1}}"#;
    let json = json_of(material).replace(r#""TEXCOORD_0": 1"#, r#""TEXCOORD_1": 1"#);
    let scene = loaded(&json, &square());
    let ShapeKind::Mesh(mesh) = &scene.shapes[0].kind else { panic!("a mesh") };
    assert_eq!(mesh.uvs[1], [1.0, 1.0]);
    let both = r#", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 1}}, "emissiveFactor": [1, 1, 1],
        "emissiveTexture": {"index": 0}"#;
    let warnings = messages(&loaded(&json_of(both), &square()));
    assert!(warnings[0].contains("TEXCOORD_1 and TEXCOORD_0"), "{warnings:?}");
}

#[test]
fn cameras_look_along_minus_z_with_x_to_the_right() {
    let json = with_square(
        "",
        r#", "cameras": [
        {"type": "perspective", "perspective": {"yfov": 1, "aspectRatio": 2, "znear": 0.5}},
        {"type": "orthographic", "orthographic": {"xmag": 3, "ymag": 2, "znear": 0, "zfar": 9}}]"#,
    )
    .replace(
        r#"[{"mesh": 0}]"#,
        r#"[{"camera": 0, "translation": [1, 2, 3], "scale": [5, 5, 5], "name": "eye"}, {"camera": 1}]"#,
    );
    let scene = loaded(&json, &square());
    let [perspective, orthographic] = &scene.cameras[..] else { panic!("two cameras") };
    let m = perspective.world_from_camera;
    assert_eq!(m.transform_vector3(DVec3::Z), DVec3::NEG_Z);
    assert_eq!(m.transform_vector3(DVec3::X), DVec3::NEG_X);
    assert_eq!(m.transform_point3(DVec3::ZERO), DVec3::new(1.0, 2.0, 3.0));
    assert_eq!(
        (perspective.name.as_str(), perspective.film.width, perspective.film.height),
        ("eye", 960, 480)
    );
    assert_eq!((perspective.near_clip, perspective.far_clip), (Some(0.5), None));
    let Projection::Perspective { fov_deg, .. } = perspective.projection else { panic!("perspective") };
    assert!((fov_deg - 1f64.to_degrees()).abs() < 1e-12);
    assert_eq!(orthographic.projection, Projection::Orthographic);
    assert_eq!(orthographic.world_from_camera.transform_vector3(DVec3::X), DVec3::new(-3.0, 0.0, 0.0));
    assert_eq!((orthographic.film.width, orthographic.film.height), (960, 640));
    assert_eq!((orthographic.near_clip, orthographic.far_clip), (None, Some(9.0)));
}

#[test]
fn lights_shine_along_minus_z_of_their_nodes() {
    let lights = r#", "extensions": {"KHR_lights_punctual": {"lights": [
        {"type": "directional", "color": [1, 0.5, 0], "intensity": 2}, {"type": "point", "name": "bulb"},
        {"type": "spot", "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5}}]}}"#;
    let node = |i: usize| {
        format!(r#"{{"translation": [1, 2, 3], "extensions": {{"KHR_lights_punctual": {{"light": {i}}}}}}}"#)
    };
    let nodes = format!("[{}, {}, {}]", node(0), node(1), node(2));
    let scene = loaded(&with_square("", lights).replace(r#"[{"mesh": 0}]"#, &nodes), &square());
    let [sun, bulb, spot] = &scene.lights[..] else { panic!("{:?}", scene.lights) };
    let LightKind::Directional { direction, irradiance } = sun.kind else { panic!("{sun:?}") };
    assert_eq!((direction, irradiance), (DVec3::NEG_Z, [2.0, 1.0, 0.0]));
    let LightKind::Point { position, intensity } = bulb.kind else { panic!("{bulb:?}") };
    assert_eq!((position, intensity, bulb.name.as_str()), (DVec3::new(1.0, 2.0, 3.0), [1.0; 3], "bulb"));
    let LightKind::Spot { world_from_light, cutoff_deg, beam_deg, .. } = spot.kind else {
        panic!("{spot:?}")
    };
    assert_eq!(world_from_light.transform_vector3(DVec3::Z), DVec3::NEG_Z);
    assert!((cutoff_deg - 0.5f64.to_degrees()).abs() < 1e-12 && (beam_deg - 0.5 * cutoff_deg).abs() < 1e-12);
}

#[test]
fn pictures_are_shared_by_all_that_use_them_alike() {
    let scene = with_material(
        r#", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "emissiveFactor": [1, 1, 1],
        "emissiveTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"scale": [2, 2]}}}"#,
    );
    let images: Vec<_> = scene
        .textures
        .iter()
        .filter_map(|texture| match &texture.kind {
            TextureKind::Bitmap { image, .. } => Some(Arc::as_ptr(image)),
            _ => None,
        })
        .collect();
    assert_eq!(images.len(), 2);
    assert_eq!(images[0], images[1]);
}
