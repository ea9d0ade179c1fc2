use std::io::Write;
use std::time::{Duration, Instant};

use flate2::{Compression, write::ZlibEncoder};

use super::*;
use crate::testing::mutations;

const AS_IT_IS: MeshOptions = MeshOptions { flip_tex_coords: false, face_normals: false };

fn load(bytes: &[u8], index: u32) -> Result<LoadedMesh, SceneError> {
    read(bytes, Path::new("m.serialized"), AS_IT_IS, index)
}

/// A mesh as it stands in a file, of the content behind its flags and name.
fn mesh(version: u16, flags: u32, content: &[u8]) -> Vec<u8> {
    let mut plain = flags.to_le_bytes().to_vec();
    plain.extend(if version == 4 { &b"a name\0"[..] } else { b"" });
    plain.extend(content);
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(&plain).unwrap();
    let mut bytes = MAGIC.to_le_bytes().to_vec();
    bytes.extend(version.to_le_bytes());
    bytes.extend(encoder.finish().unwrap());
    bytes
}

/// Counts, numbers and triangles of the content of a mesh.
fn content(double: bool, vertices: u64, numbers: &[f64], triangles: &[[u32; 3]]) -> Vec<u8> {
    let mut bytes = vertices.to_le_bytes().to_vec();
    bytes.extend((triangles.len() as u64).to_le_bytes());
    for &x in numbers {
        if double { bytes.extend(x.to_le_bytes()) } else { bytes.extend((x as f32).to_le_bytes()) }
    }
    triangles.iter().flatten().for_each(|i| bytes.extend(i.to_le_bytes()));
    bytes
}

/// A file of two meshes: a bare triangle, and a square with everything a mesh can have.
fn file(version: u16, double: bool) -> Vec<u8> {
    let precision = if double { DOUBLE } else { 0x1000 };
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let bare: Vec<f64> = corners[..3].iter().flat_map(|[x, y]| [*x, *y, 5.0]).collect();
    let mut full: Vec<f64> = corners.iter().flat_map(|[x, y]| [*x, *y, 0.25]).collect();
    full.extend([0.0, 0.0, 2.0].repeat(4));
    full.extend(corners.iter().flat_map(|[x, y]| [x + 0.5, *y]));
    full.extend(corners.iter().flat_map(|[x, y]| [*x, *y, 0.75]));
    let all = precision | HAS_NORMALS | HAS_UVS | HAS_COLORS;
    let first = mesh(version, precision, &content(double, 3, &bare, &[[0, 1, 2]]));
    let second = mesh(version, all, &content(double, 4, &full, &[[0, 1, 2], [0, 2, 3]]));
    let mut bytes = first.clone();
    bytes.extend(second);
    for offset in [0, first.len()] {
        match version {
            3 => bytes.extend((offset as u32).to_le_bytes()),
            _ => bytes.extend((offset as u64).to_le_bytes()),
        }
    }
    bytes.extend(2u32.to_le_bytes());
    bytes
}

#[test]
fn both_versions_and_precisions_hold_the_same_meshes() {
    for (version, double) in [(3, false), (3, true), (4, false), (4, true)] {
        let bytes = file(version, double);
        let bare = load(&bytes, 0).unwrap().mesh;
        assert_eq!(bare.positions[2], [1.0, 1.0, 5.0]);
        assert_eq!(bare.normals, [[0.0, 0.0, 1.0]; 3]); // computed
        assert!(bare.uvs.is_empty() && bare.attributes.is_empty());
        let full = load(&bytes, 1).unwrap().mesh;
        assert_eq!(full.triangles, [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(full.normals, [[0.0, 0.0, 2.0]; 4]);
        assert_eq!(full.uvs[2], [1.5, 1.0]);
        assert_eq!(full.attributes[0].name, "vertex_color");
        assert_eq!(full.attributes[0].values[3..6], [1.0, 0.0, 0.75]);
    }
}

#[test]
fn faces_are_flat_where_the_file_or_the_scene_says_so() {
    let numbers = [0.0; 9];
    let flat = mesh(4, FACE_NORMALS, &content(false, 3, &numbers, &[[0, 1, 2]]));
    assert!(load(&flat, 0).unwrap().mesh.normals.is_empty());
    let options = MeshOptions { face_normals: true, ..AS_IT_IS };
    assert!(read(&file(4, false), Path::new("m"), options, 1).unwrap().mesh.normals.is_empty());
}

#[test]
fn errors_name_the_mesh_and_what_is_wrong() {
    let good = file(4, false);
    let second = u64::from_le_bytes(*good[good.len() - 12..].first_chunk().unwrap()) as usize;
    let mut bad_table = good.clone();
    bad_table[good.len() - 12] = 0xff;
    bad_table[good.len() - 10] = 0xff;
    let triangle = mesh(4, 0, &content(false, 3, &[0.0; 9], &[[0, 1, 3]]));
    let short = mesh(3, 0, &content(false, 4, &[0.0; 9], &[[0, 1, 2]]));
    let mut noise = good.clone();
    noise[second + 4..second + 40].fill(0xee);
    let cases: [(&[u8], u32, &str); 9] = [
        (b"", 0, "fewer bytes"),
        (b"ply\nformat", 0, "begins with 0x6c70, not with 0x041c"),
        (b"\x1c\x04\x05\0xxxx", 0, "version 5"),
        (&good, 2, "shape_index 2 of a file with 2 meshes"),
        (&bad_table, 1, "does not hold"),
        (&triangle, 0, "triangle 1 names vertex 3 of 3"),
        (&short, 0, "48 bytes of the 60 that its counts call for"),
        (&noise, 1, "no zlib stream"),
        (&good[..20], 0, "end early"),
    ];
    for (bytes, index, message) in cases {
        let error = load(bytes, index).unwrap_err().to_string();
        assert!(
            error.starts_with("m.serialized: ") && error.contains(message),
            "{error}\nexpected {message}"
        );
    }
    let place = format!("byte {second}: mesh: the compressed");
    assert!(load(&noise, 1).unwrap_err().to_string().contains(&place));
}

#[test]
fn counts_are_not_believed_and_bombs_are_refused() {
    let start = Instant::now();
    for (vertices, triangles) in
        [(u64::MAX, 1), (1, u64::MAX), (u64::MAX / 3, u64::MAX / 3), (1 << 31, 0), (0, 1 << 31)]
    {
        let mut content = vertices.to_le_bytes().to_vec();
        content.extend(triangles.to_le_bytes());
        let error = load(&mesh(4, 0, &content), 0).unwrap_err();
        assert!(error.help.contains("counts are wrong"), "{error}");
    }
    // 100 MB of vertices at the origin out of 100 kB.
    let vertices = 100_000_000 / 12;
    let mut bomb = (vertices as u64).to_le_bytes().to_vec();
    bomb.resize(16 + 12 * vertices, 0);
    let bytes = mesh(4, 0, &bomb);
    assert!(bytes.len() < 200_000);
    assert!(load(&bytes, 0).unwrap_err().help.contains("counts are wrong"));
    assert!(start.elapsed() < Duration::from_secs(20));
}

#[test]
fn mutated_files_load_or_fail_but_never_panic() {
    let mut good = 0;
    for (version, double) in [(3, true), (4, false)] {
        let bytes = file(version, double);
        for mutated in mutations(&bytes, 3_000) {
            good += [0, 1].iter().filter(|&&index| load(&mutated, index).is_ok()).count();
        }
        // Behind the checksum nothing is left of most mutations: those of the plain content matter as much.
        let plain = content(double, 3, &[0.5; 9], &[[0, 1, 2]]);
        for mutated in mutations(&plain, 2_000) {
            good += usize::from(load(&mesh(version, if double { DOUBLE } else { 0 }, &mutated), 0).is_ok());
        }
    }
    assert!((100..15_900).contains(&good), "{good}: the mutations are too wild or too tame");
}

#[test]
fn a_real_file_of_mitsuba_is_read() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../shared/scenes/mitsuba-tests/common/meshes/matpreview.serialized");
    let Ok(bytes) = std::fs::read(&path) else {
        println!("skipped: {} is not there", path.display());
        return;
    };
    // Counts as Mitsuba 3.9.1 gives them.
    for (index, vertices, triangles) in [(0, 289, 512), (1, 2078, 3936), (2, 29439, 57152)] {
        let mesh = load(&bytes, index).unwrap().mesh;
        assert_eq!((mesh.positions.len(), mesh.triangles.len()), (vertices, triangles));
    }
}
