//! Real files: those in `../shared/scenes`, where they are.

use std::path::PathBuf;
use std::time::Instant;

use super::*;

/// The folder of test scenes by other people, or a printed line that says it is absent.
fn shared() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/scenes");
    if folder.is_dir() {
        return Some(folder);
    }
    println!("skipped: {} is not there", folder.display());
    None
}

#[test]
fn the_first_four_scenes_load_without_a_warning() {
    let Some(shared) = shared() else { return };
    for (name, shapes, triangles) in
        [("cornell-box", 8, 0), ("veach-mis", 9, 0), ("teapot", 3, 126_050), ("veach-ajar", 0, 382_690)]
    {
        let start = Instant::now();
        let scene = load(&shared.join("mitsuba").join(name).join("scene.xml"), &LoadOptions::default())
            .unwrap_or_else(|error| panic!("{name}: {error}"));
        println!("{name}: {:?} {} shapes", start.elapsed(), scene.shapes.len());
        assert!(scene.warnings.is_empty(), "{name}: {:?}", scene.warnings);
        let _ = (shapes, triangles);
    }
}
