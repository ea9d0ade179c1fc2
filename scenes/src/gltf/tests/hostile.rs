//! Input made to break the reader: it must end soon, in little memory, and never in a panic.

use std::time::{Duration, Instant};

use super::*;
use crate::testing::mutations;

/// Something of everything.
fn all() -> String {
    let mut bytes = square();
    bytes.extend([0u8; 16]);
    bytes.extend(floats(&[1.0, 0.0, 0.0, 0.0].repeat(4)));
    let json = with_square(
        r#", "material": 0, "targets": [{"POSITION": 0}]"#,
        r#", "scene": 0, "scenes": [{"nodes": [1, 3]}], "skins": [{"joints": [2]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "aspectRatio": 2, "znear": 0.5}}],
        "extensionsUsed": ["KHR_lights_punctual", "A_b"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "spot": {"outerConeAngle": 0.5}}]}},
        "materials": [{"alphaMode": "MASK", "doubleSided": true, "normalTexture": {"index": 0, "scale": 2},
          "emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0, "texCoord": 1},
          "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5], "baseColorTexture": {"index": 0},
          "metallicRoughnessTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"scale": [2, 2]}}}},
          "extensions": {"KHR_materials_volume": {"thicknessFactor": 1, "attenuationDistance": 2},
          "KHR_materials_transmission": {"transmissionFactor": 1}}}],
        "textures": [{"source": 0, "sampler": 0}], "samplers": [{"wrapS": 33648, "wrapT": 33648}],
        "images": [{"uri": "data:image/bmp;base64,Qk06AAAAAAAAADYAAAAoAAAAAQAAAAEAAAABABgAAAAAAAQAAAAAAAAAAAAAAAAAAAAAAAAAAAD/AA=="}]"#,
    )
    .replace(r#""TEXCOORD_0": 1"#, r#""TEXCOORD_0": 1, "JOINTS_0": 3, "WEIGHTS_0": 4"#)
    .replace(
        r#"[{"mesh": 0}]"#,
        r#"[{"mesh": 0, "weights": [0.5]}, {"children": [0, 2], "rotation": [0, 0, 1, 0]}, {"mesh": 0, "skin": 0},
        {"camera": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}}]"#,
    )
    .replace(
        r#""byteLength": 12}]"#,
        r#""byteLength": 12}, {"buffer": 0, "byteOffset": 92, "byteLength": 16}, {"buffer": 0, "byteOffset": 108, "byteLength": 64}]"#,
    )
    .replace(
        r#""type": "SCALAR", "count": 6}"#,
        r#""type": "SCALAR", "count": 6}, {"bufferView": 3, "componentType": 5121, "type": "VEC4", "count": 4}, {"bufferView": 4, "componentType": 5126, "type": "VEC4", "count": 4,
        "sparse": {"count": 1, "indices": {"bufferView": 3, "componentType": 5121}, "values": {"bufferView": 0}}}"#,
    );
    let uri = format!("data:;base64,{}", base64(&bytes));
    json.replace("BUFFER", &uri).replace("LENGTH", &bytes.len().to_string())
}

#[test]
fn mutated_files_load_or_fail_but_never_panic() {
    let all = all();
    let scene = loaded(&all, &[]);
    assert_eq!(
        (scene.shapes.len(), scene.cameras.len(), scene.lights.len()),
        (2, 1, 1),
        "{:?}",
        messages(&scene)
    );
    let start = Instant::now();
    let mut good = 0;
    for bytes in mutations(all.as_bytes(), 20_000) {
        good += usize::from(read(bytes, Path::new("m.gltf"), Files::default()).is_ok());
    }
    println!("{good} of 20000 mutated files load, in {:?}", start.elapsed());
    assert!((200..19_800).contains(&good), "{good}: the mutations are too wild or too tame");
    assert!(start.elapsed() < Duration::from_secs(60));
}

#[test]
fn small_files_that_mean_much_are_refused() {
    let list = |n: usize, item: &str| vec![item; n].join(",");
    // a sparse accessor of zeros, and many of them
    let zeros = with_square("", "").replace(
        r#"{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4}"#,
        r#"{"componentType": 5126, "type": "VEC3", "count": 4000000000}"#,
    );
    assert!(refused(&zeros, &square()).problem.contains("64 times"));
    // primitives times nodes
    let primitive = r#"{"attributes": {"POSITION": 0}}"#;
    let many = with_square("", "")
        .replace(r#"[{"mesh": 0}]"#, &format!("[{}]", list(2000, r#"{"mesh": 0}"#)))
        .replace(r#""primitives": ["#, &format!(r#""primitives": [{},"#, list(2000, primitive)));
    assert!(refused(&many, &square()).problem.contains("more often"));
    let deep = format!("{{\"asset\": {}", "[".repeat(100_000));
    refused(&deep, &[]);
}

#[test]
fn long_files_end_soon() {
    let start = Instant::now();
    let n = 20_000;
    let list = |item: &dyn Fn(usize) -> String| (0..n).map(item).collect::<Vec<_>>().join(",");
    // a chain of nodes, one below the other; the same camera and light at every node; warnings that differ
    for nodes in [
        list(&|i| if i + 1 < n { format!(r#"{{"children": [{}], "mesh": 0}}"#, i + 1) } else { "{}".into() }),
        list(&|_| r#"{"camera": 0, "mesh": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}}"#.into()),
        list(&|_| r#"{"camera": 0, "scale": [0, 0, 0]}"#.into()),
    ] {
        let rest = r#", "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}],
            "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}}"#;
        loaded(&with_square("", rest).replace(r#"[{"mesh": 0}]"#, &format!("[{nodes}]")), &square());
    }
    assert!(start.elapsed() < Duration::from_secs(60), "{:?}", start.elapsed());
}
