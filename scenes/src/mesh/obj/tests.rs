use super::*;

const AS_IT_IS: MeshOptions = MeshOptions { flip_tex_coords: false, face_normals: true };

fn load(text: &str, options: MeshOptions) -> Result<LoadedMesh, SceneError> {
    read(text.as_bytes(), Path::new("m.obj"), options)
}

#[test]
fn faces_of_all_groups_share_their_vertices() {
    let text = "o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl x\nf 1 2 3\ng b\nv 1 1 0\nf 2 -1 3\n";
    let mesh = load(text, AS_IT_IS).unwrap().mesh;
    assert_eq!(mesh.positions, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]]);
    assert_eq!(mesh.triangles, [[0, 1, 2], [1, 3, 2]]);
    assert!(mesh.normals.is_empty() && mesh.uvs.is_empty());
}

#[test]
fn corners_that_differ_in_uv_or_normal_are_vertices_of_their_own() {
    let text =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 .25\nvt 1 1\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\nf 1/2/1 2/1/1 3/1/1\n";
    let options = MeshOptions { flip_tex_coords: true, face_normals: false };
    let mesh = load(text, options).unwrap().mesh;
    assert_eq!(mesh.positions.len(), 4);
    assert_eq!(mesh.uvs[0], [0.0, 0.75]);
    assert_eq!(mesh.uvs[3], [1.0, 0.0]);
    assert_eq!(mesh.normals, [[0.0, 0.0, 1.0]; 4]);
}

#[test]
fn odd_but_legal_lines_are_read() {
    let cases = [
        ("\u{feff}# bom\r\nv 0 0 0 1\r\nv 1 0 0 0.5 0.5 0.5\r\nv\t0  1 0\r\nf 1 \\\r\n2 3 # c\r\n", 1),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\np 1\ns off\nvp 1\nunknown\nf 1// 2// 3//", 1),
        ("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", 1), // used before it is defined
        ("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 1 2\nf\n", 2),
        ("", 0),
    ];
    for (text, triangles) in cases {
        let loaded = load(text, AS_IT_IS).unwrap_or_else(|e| panic!("{text:?}: {e}"));
        assert_eq!(loaded.mesh.triangles.len(), triangles, "{text:?}");
    }
}

#[test]
fn dropped_faces_are_counted_at_the_line_of_the_first() {
    let notes = load("v 0 0 0\nv 1 0 0\nf 1 2\nf 1\n", AS_IT_IS).unwrap().notes;
    assert_eq!(notes, [Note { line: 3, message: "face with 2 corners dropped, and 1 more".into() }]);
}

#[test]
fn normals_and_texture_coordinates_that_are_not_there_count_as_not_given() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1/1 2//-4 3//4294967295\n";
    let loaded = load(text, MeshOptions { face_normals: false, ..AS_IT_IS }).unwrap();
    assert_eq!(loaded.mesh.normals, [[0.0, 0.0, 1.0]; 3]);
    assert!(loaded.mesh.uvs.is_empty());
    let message = "face with texture coordinates that the file does not hold; it is read without, and 3 more";
    assert_eq!(loaded.notes, [Note { line: 4, message: message.into() }]);
}

#[test]
fn errors_name_file_line_and_text() {
    let cases = [
        ("v 0 0 0\nf 1 2 99999999999\n", "m.obj:2:1: mesh: face with vertex 99999999999"),
        ("v 0 0 0\nv 0 0 0\nf 1 2 3\n", "m.obj:3:1: mesh: face with vertex 3: the file has 2"),
        ("v 0 0 0\nf 0 1 1\n", "m.obj:2:1: mesh: face with vertex 0"),
        ("v 0 0 0\nf 1 1 -2\n", "m.obj:2:1: mesh: face with vertex -2"),
        ("v 0 0 0\nf 1/a 1 1\n", "m.obj:2:1: mesh: face with the corner \"1/a\""),
        ("v 0 0 0\nf 1/1/1/1 1 1\n", "m.obj:2:1: mesh: face with the corner \"1/1/1/1\""),
        ("v 0 0\n", "m.obj:1:1: mesh: 2 numbers where 3 belong"),
        ("\nv 0 \\\n0 zero\n", "m.obj:2:1: mesh: \"zero\" is not a number"),
    ];
    for (text, message) in cases {
        let error = load(text, AS_IT_IS).unwrap_err().to_string();
        assert!(error.starts_with(message), "{text:?}: {error}");
    }
}

#[test]
fn numbers_that_are_none_drop_their_faces_only() {
    let text = "v nan 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 -1.#IND\nv 1 1 1\nf 1 2 3\nf 2 5 3\nf 2 4 3\n";
    let loaded = load(text, AS_IT_IS).unwrap();
    assert_eq!(loaded.mesh.triangles.len(), 1);
    assert!(loaded.notes[0].message.contains("first face 1"), "{:?}", loaded.notes);
}

#[test]
fn vertex_colours_are_passed_over_with_one_remark_at_the_first() {
    let square = "v 0 0 0\nv 1 0 0 1.0\nv 1 1 0 0.1 0.2 0.3\nv 0 1 0 0.4 0.5 0.6 # red\nf 1 2 3 4\n";
    let loaded = load(square, AS_IT_IS).unwrap();
    assert_eq!(loaded.mesh.positions[2], [1.0, 1.0, 0.0]);
    assert_eq!(loaded.notes, [Note { line: 3, message: super::NO_COLORS.into() }]);
    let commented = load("v 0 0 0 # four five six\nv 1 0 0 1\nv 0 1 0\nf 1 2 3\n", AS_IT_IS).unwrap();
    assert_eq!(commented.notes, []);
}
