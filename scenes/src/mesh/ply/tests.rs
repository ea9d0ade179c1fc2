use std::time::{Duration, Instant};

use glam::DVec3;

use super::*;
use crate::testing::mutations;

const AS_IT_IS: MeshOptions = MeshOptions { flip_tex_coords: false, face_normals: false };

fn load(bytes: &[u8]) -> Result<LoadedMesh, SceneError> {
    read(bytes, Path::new("m.ply"), AS_IT_IS)
}

/// A triangle and a square with normals, texture coordinates and a column and an element that nobody needs,
/// in all three encodings.
fn files() -> [Vec<u8>; 3] {
    let rows = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [-1.0, 0.5]];
    let faces: [&[i32]; 2] = [&[0, 3, 4], &[0, 1, 2, 3]];
    ["ascii", "binary_little_endian", "binary_big_endian"].map(|format| {
        let mut bytes = format!(
            "ply\r\nformat {format} 1.0\r\ncomment é\r\nelement camera 1\r\nproperty list uchar short x\r\nelement vertex 5\r\n\
             property float nx\r\nproperty float ny\r\nproperty float nz\r\nproperty uchar red\r\nproperty float x\r\n\
             property double s\r\nproperty float y\r\nproperty short z\r\nproperty float t\r\nelement face 2\r\n\
             property list uchar int vertex_indices\r\nend_header\r\n"
        )
        .replace("comment é", "comment \u{e9}")
        .into_bytes();
        if format == "ascii" {
            bytes.extend(b"2 7 8\n");
            for [x, y] in rows {
                bytes.extend(format!("0 0 2 255 {x} {x} {y} 3 {y}\n").bytes());
            }
            for face in faces {
                bytes.extend(format!("{} {}\n", face.len(), face.iter().map(i32::to_string).collect::<Vec<_>>().join(" ")).bytes());
            }
            return bytes;
        }
        let mut put = |little: &[u8]| {
            let mut value = little.to_vec();
            if format == "binary_big_endian" {
                value.reverse();
            }
            bytes.extend(value);
        };
        put(&[2]);
        put(&7i16.to_le_bytes());
        put(&8i16.to_le_bytes());
        for [x, y] in rows {
            [0.0f32, 0.0, 2.0].iter().for_each(|n| put(&n.to_le_bytes()));
            put(&[255]);
            put(&(x as f32).to_le_bytes());
            put(&f64::to_le_bytes(x));
            put(&(y as f32).to_le_bytes());
            put(&3i16.to_le_bytes());
            put(&(y as f32).to_le_bytes());
        }
        for face in faces {
            put(&[face.len() as u8]);
            face.iter().for_each(|i| put(&i.to_le_bytes()));
        }
        bytes
    })
}

#[test]
fn all_encodings_hold_the_same_mesh() {
    for bytes in files() {
        let loaded = load(&bytes).unwrap();
        let mesh = &loaded.mesh;
        assert_eq!(mesh.positions[2], [1.0, 1.0, 3.0]);
        assert_eq!(mesh.normals, [[0.0, 0.0, 2.0]; 5]);
        assert_eq!(mesh.uvs[4], [-1.0, 0.5]);
        assert_eq!(mesh.triangles, [[0, 3, 4], [0, 1, 2], [0, 2, 3]]);
        assert!(loaded.notes.is_empty() && loaded.offset == DVec3::ZERO);
    }
}

fn ascii(vertex: &str, vertices: &str, face: &str, faces: &str) -> String {
    let rows = |text: &str| text.lines().count();
    format!(
        "ply\nformat ascii 1.0\nelement vertex {}\n{vertex}\nelement face {}\n{face}\nend_header\n{vertices}\n{faces}\n",
        rows(vertices),
        rows(faces)
    )
}

const XYZ: &str = "property float x\nproperty float y\nproperty float z";
const INDICES: &str = "property list uchar int vertex_index";
const CORNERS: &str = "0 0 0\n1 0 0\n0 1 0";

#[test]
fn faces_may_come_first_and_carry_more_columns() {
    let face = "property uchar flags\nproperty list uint uint vertex_index\nproperty float quality";
    let text = format!(
        "ply\nformat ascii 1.0\nelement face 1\n{face}\nelement vertex 3\n{XYZ}\nend_header\n7 3 0 1 2 0.5\n{CORNERS}\n"
    );
    let mesh = load(text.as_bytes()).unwrap().mesh;
    assert_eq!(mesh.triangles, [[0, 1, 2]]);
    assert_eq!(mesh.normals, [[0.0, 0.0, 1.0]; 3]); // computed
}

#[test]
fn lines_may_end_as_on_old_macintoshes() {
    let text = ascii(XYZ, CORNERS, INDICES, "3 0 1 2").replace('\n', "\r");
    assert_eq!(load(text.as_bytes()).unwrap().mesh.triangles, [[0, 1, 2]]);
}

#[test]
fn double_coordinates_far_away_keep_their_digits() {
    let double = XYZ.replace("float", "double");
    let text = ascii(&double, "1000000.125 0 0\n1000001.3 0 0\n1000000.125 1.1 0", INDICES, "3 0 1 2");
    let loaded = load(text.as_bytes()).unwrap();
    let x = f64::from(loaded.mesh.positions[1][0]) + loaded.offset.x;
    assert!((x - 1_000_001.3).abs() < 1e-7, "{x}");
}

#[test]
fn vertices_that_are_not_finite_take_their_faces_along() {
    let text = ascii(XYZ, "0 0 0\n1 0 0\n0 1 0\n-nan 0 inf", INDICES, "4 0 1 2 3\n3 0 1 2\n3 0 1 3\n2 0 1");
    let loaded = load(text.as_bytes()).unwrap();
    assert_eq!(loaded.mesh.triangles, [[0, 1, 2]]);
    assert_eq!(loaded.mesh.positions.len(), 3);
    assert!(loaded.notes[0].message.contains("first face 1 with vertex 4"), "{:?}", loaded.notes);
}

#[test]
fn errors_give_the_byte() {
    let cut = files()[1].clone();
    let end = format!("m.ply: byte {}: mesh: the file ends before", cut.len() - 1);
    let (word, index) = (ascii(XYZ, "0 0 0\n1 0 zero", INDICES, ""), ascii(XYZ, CORNERS, INDICES, "3 0 1 3"));
    let zero = format!("m.ply: byte {}: mesh: \"zero\" is not a number", word.find("zero").unwrap());
    let end_of_vertices = index.find("\n3 0 1 3").unwrap();
    let beyond = format!("m.ply: byte {end_of_vertices}: mesh: face 1 names vertex 3 of 3");
    let cases: [(&[u8], &str); 10] = [
        (&b""[..], "m.ply: mesh: the header does not end"),
        (&b"plx\n"[..], "m.ply: mesh: no \"ply\" in the first line"),
        (&cut[..cut.len() - 1], &end),
        (&b"ply\nformat ascii 1.0\nend_header\n"[..], "m.ply: mesh: no elements"),
        (&b"ply\nformat binary 1.0\nend_header\n"[..], "m.ply: byte 4: mesh: unknown format \"binary\""),
        (&b"ply\nend_header\n"[..], "m.ply: byte 4: mesh: a header without \"format\""),
        (&b"ply\nproperty float x\n"[..], "m.ply: byte 4: mesh: a property before any element"),
        (&b"ply\nelement vertex -1\n"[..], "m.ply: byte 4: mesh: -1 rows"),
        (word.as_bytes(), &zero),
        (index.as_bytes(), &beyond),
    ];
    for (bytes, message) in cases {
        let error = load(bytes).unwrap_err().to_string();
        assert!(error.starts_with(message), "{error}\nexpected {message}");
    }
}

#[test]
fn announced_sizes_are_not_believed() {
    let start = Instant::now();
    for (vertex, face) in [
        (XYZ, INDICES),
        ("property list uint double x", INDICES),
        (XYZ, "property list uint int vertex_index"),
    ] {
        for format in ["ascii", "binary_little_endian"] {
            let text = format!(
                "ply\nformat {format} 1.0\nelement nothing 4294967295\nelement vertex 4294967295\n{vertex}\nelement face 4294967295\n{face}\nend_header\n{}",
                "\u{7f}".repeat(1000)
            );
            assert!(load(text.as_bytes()).is_err());
        }
    }
    let no_rows = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex 0\n{XYZ}\nelement face 4294967295\n{INDICES}\nend_header\n"
    );
    assert!(load(no_rows.as_bytes()).is_err());
    assert!(start.elapsed() < Duration::from_secs(10));
}

#[test]
fn mutated_files_load_or_fail_but_never_panic() {
    let start = Instant::now();
    for bytes in files() {
        let good = mutations(&bytes, 5_000).filter(|mutated| load(mutated).is_ok()).count();
        assert!((100..4_900).contains(&good), "{good}: the mutations are too wild or too tame");
    }
    assert!(start.elapsed() < Duration::from_secs(60));
}
