//! `--as-mitsuba`: leaves out what limpid does otherwise than Mitsuba 3 on purpose.
//!
//! Today that is the clip planes alone. What will differ by choice has its switch here, so that a comparison sees
//! mistakes and not decisions.

use limpid_scenes::Scene;

/// Where Mitsuba's cameras begin and end to see, in scene units, unless the file says otherwise.
const CLIP: [f64; 2] = [1e-2, 1e4];

/// Changes the scene so that it means here what it means there.
pub fn apply(scene: &mut Scene) {
    for camera in &mut scene.cameras {
        camera.near_clip.get_or_insert(CLIP[0]);
        camera.far_clip.get_or_insert(CLIP[1]);
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use limpid_scenes::{LoadOptions, load_str};

    use super::*;

    #[test]
    fn clip_planes_are_mitsubas_where_the_file_states_none() {
        let text = r#"<scene version="3.0.0">
            <sensor type="perspective"/>
            <sensor type="perspective"><float name="near_clip" value="3"/></sensor>
        </scene>"#;
        let mut scene = load_str(text, Path::new(""), &LoadOptions::default()).expect("is a scene");
        apply(&mut scene);
        let clips: Vec<_> = scene.cameras.iter().map(|camera| (camera.near_clip, camera.far_clip)).collect();
        assert_eq!(clips, [(Some(1e-2), Some(1e4)), (Some(3.0), Some(1e4))]);
    }
}
