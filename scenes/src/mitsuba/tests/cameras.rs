//! `<sensor>` and `<film>` beyond the pinhole.

use super::{loaded, try_load};
use crate::{Camera, Lens, Projection};

fn camera(kind: &str, inside: &str) -> Camera {
    let scene = loaded(&format!(r#"<sensor type="{kind}">{inside}</sensor>"#));
    assert!(scene.warnings.is_empty(), "{inside}: {:?}", scene.warnings);
    scene.cameras[0].clone()
}

#[test]
fn a_thin_lens_is_a_pinhole_with_an_aperture() {
    let given = r#"<float name="fov" value="40"/><float name="aperture_radius" value="0.25"/>"#;
    let lens = |inside: &str| {
        let camera = camera("thinlens", &format!("{given}{inside}"));
        assert!(matches!(camera.projection, Projection::Perspective { fov_deg: 40.0, .. }));
        camera.lens.unwrap()
    };
    // Mitsuba 3.9.1 focuses on its far clip where the file says nothing
    assert_eq!(lens(""), Lens { aperture_radius: 0.25, focus_distance: 1e4 });
    assert_eq!(lens(r#"<float name="far_clip" value="7"/>"#).focus_distance, 7.0);
    assert_eq!(lens(r#"<float name="focus_distance" value="3"/>"#).focus_distance, 3.0);
    assert_eq!(camera("perspective", r#"<float name="focus_distance" value="3"/>"#).lens, None);
    for wrong in [
        r#"<float name="aperture_radius" value="-1"/>"#,
        r#"<float name="aperture_radius" value="1"/><float name="focus_distance" value="0"/>"#,
    ] {
        assert!(try_load(&format!(r#"<sensor type="thinlens">{wrong}</sensor>"#)).is_err(), "{wrong}");
    }
}

#[test]
fn an_orthographic_camera_has_no_angle() {
    let given = camera(
        "orthographic",
        r#"<transform name="to_world"><scale x="10" y="5"/><translate z="2"/></transform><float name="near_clip" value="1"/>"#,
    );
    assert_eq!((given.projection, given.lens, given.near_clip), (Projection::Orthographic, None, Some(1.0)));
    assert_eq!(given.world_from_camera.x_axis.x, 10.0);
}

#[test]
fn pixel_formats_with_alpha_ask_for_it() {
    for (format, alpha) in [
        ("rgb", false),
        ("rgba", true),
        ("luminance", false),
        ("luminance_alpha", true),
        ("luminanceAlpha", true),
        ("xyza", true),
    ] {
        let film = format!(r#"<film type="hdrfilm"><string name="pixel_format" value="{format}"/></film>"#);
        assert_eq!(camera("perspective", &film).film.alpha, alpha, "{format}");
    }
    assert!(!camera("perspective", r#"<film type="hdrfilm"/>"#).film.alpha);
}
