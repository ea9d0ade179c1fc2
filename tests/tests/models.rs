//! glTF and OBJ models of other people: all load, and render without a sample that is no number.

use std::path::{Path, PathBuf};

use limpid_scenes::{LoadOptions, Scene, load};
use limpid_tests::rendered;

/// Files of the shared models with one of these extensions, or a printed line that they are absent.
fn models(folder: &str, extensions: &[&str]) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/scenes").join(folder);
    if !folder.is_dir() {
        println!("skipped: {} is not there", folder.display());
        return Vec::new();
    }
    let mut found = Vec::new();
    let mut folders = vec![folder];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("the folder is readable") {
            let path = entry.expect("the entry is readable").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| extensions.iter().any(|known| e == *known)) {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// Renders with every camera, at 64x48 with 4 samples.
fn check(scene: Scene, name: &str) {
    for camera in 0..scene.cameras.len() {
        let mut scene = scene.clone();
        scene.cameras.swap(0, camera);
        let rendered = rendered(&scene, |s| (s.width, s.height, s.spp) = (64, 48, 4));
        assert_eq!(rendered.rejected, 0, "{name}: samples that are no number");
        let plane = rendered.frame.channel("G").expect("every frame has its beauty");
        assert!(plane.iter().all(|x| x.is_finite()), "{name}");
        assert!(plane.iter().any(|&x| x > 0.0), "{name}: black");
    }
}

#[test]
fn every_shared_gltf_model_renders() {
    for path in models("gltf", &["gltf", "glb"]) {
        let scene = load(&path, &LoadOptions::default()).unwrap_or_else(|error| panic!("{error}"));
        check(scene, &path.display().to_string());
    }
}

#[test]
fn every_shared_obj_model_renders_or_names_its_line() {
    for path in models("obj", &["obj"]) {
        match load(&path, &LoadOptions::default()) {
            Ok(scene) => check(scene, &path.display().to_string()),
            Err(error) => assert!(error.line > 0, "{error}"),
        }
    }
}
