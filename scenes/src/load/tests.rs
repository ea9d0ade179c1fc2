//! Real files: those in `../shared/scenes`, where they are.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use super::*;
use crate::{Color, MaterialKind, ShapeKind};

/// The folder of test scenes by other people, or a printed line that says it is absent.
fn shared() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/scenes");
    if folder.is_dir() {
        return Some(folder);
    }
    println!("skipped: {} is not there", folder.display());
    None
}

/// All files below a folder with this extension, sorted.
fn files_below(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == extension) {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

#[test]
fn the_first_four_scenes_load_whole_and_without_a_warning() {
    let Some(shared) = shared() else { return };
    // shapes, and triangles in mesh files: as Mitsuba 3.9.1 counts them
    for (name, shapes, triangles) in
        [("cornell-box", 8, 0), ("veach-mis", 9, 0), ("teapot", 3, 126_048), ("veach-ajar", 22, 382_688)]
    {
        let path = shared.join("mitsuba").join(name).join("scene.xml");
        let options = LoadOptions { strict: true, ..LoadOptions::default() };
        let scene = load(&path, &options).unwrap_or_else(|error| panic!("{error}"));
        assert!(scene.warnings.is_empty(), "{name}: {:?}", scene.warnings);
        let counts = scene.shapes.iter().map(|shape| match &shape.kind {
            ShapeKind::Mesh(mesh) => mesh.triangles.len(),
            _ => 0,
        });
        assert_eq!((scene.shapes.len(), counts.sum::<usize>()), (shapes, triangles), "{name}");
    }
}

#[test]
fn scenes_of_our_own_load_strictly_and_without_a_warning() {
    for folder in ["library", "tune"] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
        for path in files_below(&folder, "xml").iter().filter(|path| path.ends_with("scene.xml")) {
            let options = LoadOptions { strict: true, ..LoadOptions::default() };
            let scene = load(path, &options).unwrap_or_else(|error| panic!("{error}"));
            assert!(scene.warnings.is_empty(), "{}: {:?}", path.display(), scene.warnings);
        }
    }
}

#[test]
fn an_old_scene_is_the_same_as_its_new_version() {
    let Some(shared) = shared() else { return };
    let [old, new] = ["scene_v0.6.xml", "scene.xml"]
        .map(|name| load(&shared.join("mitsuba/teapot").join(name), &LoadOptions::default()).unwrap());
    let camera = |scene: &Scene| (scene.cameras[0].world_from_camera, scene.cameras[0].projection.clone());
    assert_eq!(camera(&old), camera(&new));
    for (a, b) in old.shapes.iter().zip(&new.shapes) {
        assert_eq!(a.world_from_object, b.world_from_object);
    }
    assert_eq!(old.textures[0].uv_from_surface, new.textures[0].uv_from_surface);
    assert!(old.warnings.iter().any(|w| w.message.contains("strict_normals")), "{:?}", old.warnings);
    assert!(!old.warnings.iter().any(|w| w.unused_parameter), "{:?}", old.warnings);
}

/// Fragments that others include do not stand alone, and one file is of a private dialect; all else loads.
#[test]
fn every_shared_scene_loads_or_says_why_not() {
    let Some(shared) = shared() else { return };
    let mut table = BTreeMap::<String, usize>::new();
    for path in files_below(&shared, "xml") {
        let stem = path.file_stem().unwrap().to_string_lossy().into_owned();
        // the tests of Mitsuba name the integrator in the file name
        let integrator = stem.rsplit('_').next().unwrap_or_default().to_string();
        let defines = vec![("integrator".to_string(), integrator), ("spp".to_string(), "16".to_string())];
        let outcome = match load(&path, &LoadOptions { defines, strict: false }) {
            Ok(scene) => {
                let about_file = |w: &&crate::Warning| !w.element.starts_with("-D");
                let warned = scene.warnings.iter().filter(about_file).count() > 0;
                String::from(if warned { "loads with warnings" } else { "loads" })
            }
            Err(error) => {
                let is_fragment =
                    path.parent().is_some_and(|p| p.ends_with("include") || p.ends_with("fragments"));
                let is_private = error.problem.contains("unknown element <mode>");
                assert!(is_fragment && error.problem.contains("is not there") || is_private, "{error}");
                let kind = if is_private { "private dialect" } else { "fragment without its files" };
                kind.into()
            }
        };
        *table.entry(outcome).or_default() += 1;
    }
    println!("{table:#?}");
    let loaded: usize = table.iter().filter(|(kind, _)| kind.starts_with("loads")).map(|(_, n)| n).sum();
    assert!(loaded >= 85, "{table:#?}");
}

#[test]
fn gltf_models_have_the_triangles_that_their_table_says() {
    let Some(shared) = shared() else { return };
    for (name, triangles) in [
        ("Box/Box.gltf", 12),
        ("SimpleSparseAccessor/SimpleSparseAccessor.gltf", 12),
        ("RiggedSimple/RiggedSimple.gltf", 188),
        ("CesiumMan/CesiumMan.glb", 4_672),
        ("MetalRoughSpheresNoTextures/MetalRoughSpheresNoTextures.glb", 1_040_409),
        ("DamagedHelmet/DamagedHelmet.glb", 15_452),
        ("AttenuationTest/AttenuationTest.gltf", 292), // 232 in the file, some shown more than once
        ("GlassBrokenWindow/GlassBrokenWindow.gltf", 987),
        ("IridescenceSuzanne/IridescenceSuzanne.gltf", 11_808),
    ] {
        let scene = load(&shared.join("gltf").join(name), &LoadOptions::default()).unwrap();
        let counts = scene.shapes.iter().map(|shape| match &shape.kind {
            ShapeKind::Mesh(mesh) => mesh.triangles.len(),
            _ => 0,
        });
        assert_eq!(counts.sum::<usize>(), triangles, "{name}");
    }
}

/// Every OBJ, whatever is wrong with it, as the one shape of a scene.
#[test]
fn every_shared_obj_loads_or_names_its_line() {
    let Some(shared) = shared() else { return };
    for path in files_below(&shared.join("obj"), "obj") {
        let name = path.file_name().unwrap().to_string_lossy();
        let xml = format!(
            r#"<scene version="3.0.0"><shape type="obj"><string name="filename" value="{name}"/></shape></scene>"#
        );
        match load_str(&xml, path.parent().unwrap(), &LoadOptions::default()) {
            Ok(scene) => {
                let notes = scene.warnings.iter().map(|w| w.message.as_str()).collect::<Vec<_>>();
                println!("{name}: {} shapes, {notes:?}", scene.shapes.len());
            }
            Err(error) => {
                println!("{error}");
                assert!(error.line > 0 && error.file.ends_with(&*name), "{error}");
            }
        }
    }
}

#[test]
fn the_spectral_cornell_box_has_the_colours_of_mitsuba() {
    let Some(shared) = shared() else { return };
    let path = shared.join("mitsuba-tests/scenes/cbox/cbox-spectral.xml");
    let scene = load(&path, &LoadOptions::default()).unwrap();
    // printed by Mitsuba 3.9.1, variant scalar_rgb
    for (name, expected) in [
        ("light", [0.7763668, 0.77981, 0.7760291]),
        ("white", [0.735013, 0.7356246, 0.73626435]),
        ("green", [0.06828254, 0.39776018, 0.08629087]),
        ("red", [0.49132004, 0.04922811, 0.0509219]),
    ] {
        let material = scene.materials.iter().find(|material| material.name == name).unwrap();
        let MaterialKind::Diffuse { reflectance: Color::Constant(rgb) } = material.kind else {
            panic!("{name}")
        };
        let worst = (0..3).map(|c| (rgb[c] - expected[c]).abs()).fold(0.0, f32::max);
        assert!(worst < 1e-6, "{name}: {rgb:?}, Mitsuba {expected:?}");
    }
}
