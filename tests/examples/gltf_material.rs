//! How far glTF's material is from the nearest that Mitsuba has, with which a glTF scene is exported: a ball under the
//! sky that stands in, one dial at a time, both rendered by limpid. Prints the table of `docs/mitsuba.md`.
//!
//! ```sh
//! cargo build --release && cargo run --release -p limpid-tests --example gltf_material
//! ```

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use limpid_tests::start::{call, done};
use serde_json::{Value, json};

/// What is said of the material, and its JSON.
fn rows() -> Vec<(&'static str, Value)> {
    let base = |metallic: f64, roughness: f64| json!({ "baseColorFactor": [0.8, 0.5, 0.3, 1.0], "metallicFactor": metallic, "roughnessFactor": roughness });
    let plain = |metallic, roughness| json!({ "pbrMetallicRoughness": base(metallic, roughness) });
    let with = |metallic, roughness, extensions| json!({ "pbrMetallicRoughness": base(metallic, roughness), "extensions": extensions });
    let glass = |roughness, volume: Value| {
        with(
            0.0,
            roughness,
            json!({ "KHR_materials_transmission": { "transmissionFactor": 1.0 }, "KHR_materials_volume": volume }),
        )
    };
    let thick = json!({ "thicknessFactor": 1.0 });
    let tinted =
        json!({ "thicknessFactor": 1.0, "attenuationDistance": 1.0, "attenuationColor": [0.8, 0.5, 0.3] });
    vec![
        (
            "emission alone",
            json!({ "pbrMetallicRoughness": { "baseColorFactor": [0.0, 0.0, 0.0, 1.0], "metallicFactor": 1.0 }, "emissiveFactor": [0.5, 0.5, 0.5] }),
        ),
        ("`KHR_materials_unlit`", with(0.0, 1.0, json!({ "KHR_materials_unlit": {} }))),
        ("metal, roughness 0.1", plain(1.0, 0.1)),
        ("metal, roughness 0.5", plain(1.0, 0.5)),
        ("metal, roughness 1", plain(1.0, 1.0)),
        ("half metal, roughness 0.5", plain(0.5, 0.5)),
        ("dielectric, roughness 0.1", plain(0.0, 0.1)),
        ("dielectric, roughness 0.5", plain(0.0, 0.5)),
        ("dielectric, roughness 1", plain(0.0, 1.0)),
        ("`ior` 1.8", with(0.0, 0.3, json!({ "KHR_materials_ior": { "ior": 1.8 } }))),
        (
            "`specularFactor` 0",
            with(0.0, 0.3, json!({ "KHR_materials_specular": { "specularFactor": 0.0 } })),
        ),
        (
            "`specularFactor` 0.5",
            with(0.0, 0.3, json!({ "KHR_materials_specular": { "specularFactor": 0.5 } })),
        ),
        (
            "`specularColorFactor` of gold",
            with(0.0, 0.3, json!({ "KHR_materials_specular": { "specularColorFactor": [1.0, 0.8, 0.3] } })),
        ),
        (
            "clear coat, roughness 0.1",
            with(
                0.0,
                0.5,
                json!({ "KHR_materials_clearcoat": { "clearcoatFactor": 1.0, "clearcoatRoughnessFactor": 0.1 } }),
            ),
        ),
        (
            "clear coat, roughness 0.5",
            with(
                0.0,
                0.5,
                json!({ "KHR_materials_clearcoat": { "clearcoatFactor": 1.0, "clearcoatRoughnessFactor": 0.5 } }),
            ),
        ),
        (
            "sheen, white, roughness 0.5",
            with(
                0.0,
                1.0,
                json!({ "KHR_materials_sheen": { "sheenColorFactor": [1.0, 1.0, 1.0], "sheenRoughnessFactor": 0.5 } }),
            ),
        ),
        (
            "thin transmission, roughness 0.1",
            with(0.0, 0.1, json!({ "KHR_materials_transmission": { "transmissionFactor": 1.0 } })),
        ),
        (
            "half thin transmission, roughness 0.5",
            with(0.0, 0.5, json!({ "KHR_materials_transmission": { "transmissionFactor": 0.5 } })),
        ),
        ("glass, roughness 0.1", glass(0.1, thick.clone())),
        ("glass, roughness 0.5", glass(0.5, thick)),
        ("glass that absorbs, roughness 0.1", glass(0.1, tinted)),
    ]
}

/// A ball of radius 1 that an orthographic camera along -z sees, without anything beside it.
fn scene(material: &Value) -> Value {
    let (rings, sectors) = (64u32, 128u32);
    let (mut floats, mut indices) = (Vec::<f32>::new(), Vec::<u32>::new());
    for ring in 0..=rings {
        for sector in 0..=sectors {
            let theta = std::f32::consts::PI * ring as f32 / rings as f32;
            let phi = std::f32::consts::TAU * sector as f32 / sectors as f32;
            floats.extend([theta.sin() * phi.sin(), theta.cos(), theta.sin() * phi.cos()]);
        }
    }
    for ring in 0..rings {
        for sector in 0..sectors {
            let a = ring * (sectors + 1) + sector;
            let below = a + sectors + 1;
            indices.extend([a, below, a + 1, a + 1, below, below + 1]);
        }
    }
    let mut bytes: Vec<u8> = floats.iter().flat_map(|x| x.to_le_bytes()).collect();
    let of_points = bytes.len();
    bytes.extend(indices.iter().flat_map(|i| i.to_le_bytes()));
    let uri = format!("data:application/octet-stream;base64,{}", STANDARD.encode(&bytes));
    json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0, 1] }],
        "nodes": [{ "mesh": 0 }, { "camera": 0, "translation": [0.0, 0.0, 3.0] }],
        "cameras": [{ "type": "orthographic", "orthographic": { "xmag": 0.7, "ymag": 0.7, "znear": 0.1, "zfar": 10.0 } }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0, "NORMAL": 0 }, "indices": 1, "material": 0 }] }],
        "materials": [material],
        "buffers": [{ "uri": uri, "byteLength": bytes.len() }],
        "bufferViews": [
            { "buffer": 0, "byteLength": of_points },
            { "buffer": 0, "byteOffset": of_points, "byteLength": bytes.len() - of_points },
        ],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": floats.len() / 3, "type": "VEC3",
              "min": [-1.0, -1.0, -1.0], "max": [1.0, 1.0, 1.0] },
            { "bufferView": 1, "componentType": 5125, "count": indices.len(), "type": "SCALAR" },
        ],
    })
}

fn main() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    println!("| material | glTF's mean over the other's | would show from | at the clearest place |");
    println!("|---|---|---|---|");
    for (name, material) in rows() {
        std::fs::write(folder.path().join("ball.gltf"), scene(&material).to_string()).expect("writes");
        let size = "--size 48x48 --spp 1024 --quiet";
        let own = "--sampler independent --seed 1 --layers beauty.variance -o own.exr";
        done(folder.path(), &format!("render ball.gltf {size} {own}"));
        done(folder.path(), "export ball.gltf -o ball.xml --quiet");
        let against = "--against own.exr --against-variance own.exr";
        let words = format!("crosscheck ball.xml {size} {against} --json");
        let call = call(folder.path(), words.split(' '));
        let answer: Value = serde_json::from_str(&call.stdout)
            .unwrap_or_else(|_| panic!("{name}: exit code {}: {}", call.code, call.stderr));
        let found = &answer["scenes"][0];
        let percent = |value: &Value| 100.0 * value.as_f64().unwrap_or(f64::NAN);
        // There the other is limpid's first picture.
        let turned = |ratio: f64| 100.0 * (1.0 / ratio - 1.0);
        let worst = &found["worst"][0];
        let place = if worst["alarm"] == true {
            format!("{:+.1} %", turned(1.0 + percent(&worst["bias"]) / 100.0))
        } else {
            "no difference".into()
        };
        println!(
            "| {name} | {:+.2} % | {:.2} % | {place} |",
            turned(percent(&found["mean_ratio"]) / 100.0),
            percent(&found["detectable_bias"]),
        );
    }
}
