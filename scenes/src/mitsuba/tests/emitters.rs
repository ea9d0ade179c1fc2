//! `<emitter>`: lights without a surface.

use glam::DVec3;

use super::{loaded, try_load};
use crate::{Color, LightKind};

fn light(kind: &str, inside: &str) -> LightKind {
    let scene = loaded(&format!(r#"<emitter type="{kind}">{inside}</emitter>"#));
    assert!(scene.warnings.iter().all(|w| w.element == "scene"), "{inside}: {:?}", scene.warnings);
    scene.lights[0].kind.clone()
}

#[test]
fn points_stand_where_position_or_transform_says() {
    let at = |inside: &str| match light("point", inside) {
        LightKind::Point { position, intensity } => (position, intensity),
        other => panic!("{other:?}"),
    };
    assert_eq!(at(""), (DVec3::ZERO, [1.0; 3]));
    let colour = r#"<rgb name="intensity" value="1 2 3"/><float name="sampling_weight" value="2"/>"#;
    let moved = r#"<transform name="to_world"><translate x="1" z="3"/></transform>"#;
    assert_eq!(at(&format!("{colour}{moved}")), (DVec3::new(1.0, 0.0, 3.0), [1.0, 2.0, 3.0]));
    assert_eq!(at(r#"<point name="position" x="1" y="2" z="4"/>"#).0, DVec3::new(1.0, 2.0, 4.0));
}

#[test]
fn spots_have_the_defaults_of_mitsuba() {
    let spot = |inside: &str| match light("spot", inside) {
        LightKind::Spot { cutoff_deg, beam_deg, texture, .. } => (cutoff_deg, beam_deg, texture),
        other => panic!("{other:?}"),
    };
    let white = Color::Constant([1.0; 3]);
    assert_eq!(spot(""), (20.0, 15.0, white));
    assert_eq!(spot(r#"<float name="cutoff_angle" value="40"/>"#), (40.0, 30.0, white));
    let textured =
        spot(r#"<texture type="checkerboard" name="texture"/><float name="beam_width" value="5"/>"#);
    assert!(matches!(textured, (20.0, 5.0, Color::Texture(_))));
    let wide = loaded(r#"<emitter type="spot"><float name="beam_width" value="30"/></emitter>"#);
    assert!(matches!(wide.lights[0].kind, LightKind::Spot { beam_deg: 20.0, .. }));
    assert!(wide.warnings[0].message.contains("beam of 30 degrees"), "{:?}", wide.warnings);
}

#[test]
fn directions_are_unit_whatever_the_file_says() {
    let way = |inside: &str| match light("directional", inside) {
        LightKind::Directional { direction, irradiance } => (direction, irradiance),
        other => panic!("{other:?}"),
    };
    assert_eq!(way(""), (DVec3::Z, [1.0; 3]));
    let given = r#"<vector name="direction" x="0" y="-2" z="0"/><rgb name="irradiance" value="4"/>"#;
    assert_eq!(way(given), (DVec3::NEG_Y, [4.0; 3]));
    let turned =
        way(r#"<transform name="to_world"><scale value="3"/><rotate x="1" angle="90"/></transform>"#).0;
    assert!(turned.abs_diff_eq(DVec3::NEG_Y, 1e-12), "{turned}");
}

#[test]
fn projectors_have_the_shape_of_their_picture() {
    let half = |inside: &str| match light("projector", inside) {
        LightKind::Projector { half_size: [x, y], .. } => [x, y],
        other => panic!("{other:?}"),
    };
    let near = |[x, y]: [f64; 2], truth: [f64; 2]| (x - truth[0]).abs() < 1e-9 && (y - truth[1]).abs() < 1e-9;
    assert!(near(half(r#"<float name="fov" value="90"/>"#), [1.0, 1.0]));
    // 50 mm before the diagonal of a negative
    let diagonal = 43.266_615_305_567_875 / 100.0 / 2f64.sqrt();
    assert!(near(half(""), [diagonal, diagonal]));
}

#[test]
fn only_backgrounds_crowd_each_other_out() {
    let lights = r#"<emitter type="point"/><emitter type="constant"/><emitter type="directional"/><emitter type="point"/>"#;
    assert_eq!(loaded(lights).lights.len(), 4);
    let two = r#"<emitter type="point"/><emitter type="constant"/><emitter type="constant"/>"#;
    assert_eq!(loaded(two).lights.len(), 2);
}

#[test]
fn lights_that_make_no_sense_are_errors_with_a_cure() {
    for (emitter, help) in [
        (
            r#"<emitter type="directional"><vector name="direction" value="0 0 0"/></emitter>"#,
            "name a direction",
        ),
        (r#"<emitter type="spot"><float name="cutoff_angle" value="0"/></emitter>"#, "above 0"),
        (
            r#"<emitter type="projector"><transform name="to_world"><scale z="0"/></transform></emitter>"#,
            "scales other",
        ),
        (r#"<emitter type="projector"><float name="scale" value="-1"/></emitter>"#, "at least 0"),
        (r#"<emitter type="point"><texture type="checkerboard" name="intensity"/></emitter>"#, "projector"),
        (r#"<emitter type="spot"><rgb name="intensity" value="-1 0 0"/></emitter>"#, "at least 0"),
    ] {
        let error = try_load(emitter).unwrap_err().to_string();
        assert!(error.contains(help), "{emitter}: {error}");
    }
}

#[test]
fn photometric_files_become_lights() {
    let lamp = b"TILT=NONE\n1 100 2 2 1 1 2 0 0 0\n1 1 9\n0 90\n0\n3 1\n";
    // as a file of 0.x has it
    let emitter = |key: &str| {
        format!(
            r#"<emitter type="ies"><string name="{key}" value="lamp.ies"/><rgb name="intensity" value="1 2 3"/>
            <transform name="to_world"><translate x="5"/></transform></emitter>"#
        )
    };
    let folder = tempfile::tempdir().unwrap();
    let load = |key: &str| {
        let text = format!(r#"<scene version="0.6.0">{}</scene>"#, emitter(key));
        crate::load_str(&text, folder.path(), &crate::LoadOptions::default())
    };
    std::fs::write(folder.path().join("lamp.ies"), lamp).unwrap();
    for key in ["path", "filename"] {
        let scene = load(key).unwrap();
        assert!(scene.warnings.iter().all(|w| w.element == "scene"), "{:?}", scene.warnings);
        let LightKind::Ies { world_from_light, intensity, profile } = &scene.lights[0].kind else { panic!() };
        assert_eq!((world_from_light.w_axis.x, intensity), (5.0, &[1.0, 2.0, 3.0]));
        assert_eq!([0.0, 45.0, 91.0].map(|v| profile.at(v, 77.0)), [6.0, 4.0, 0.0]);
    }
    std::fs::write(folder.path().join("lamp.ies"), lamp.strip_suffix(b"1\n").unwrap()).unwrap();
    let error = load("path").unwrap_err().to_string();
    assert!(error.contains("lamp.ies:3:1: emitter \"ies\": 2 × 1 values"), "{error}");
    assert!(try_load(r#"<emitter type="ies"/>"#).unwrap_err().to_string().contains("name an IES file"));
}

/// The lights of one emitter in a file of this version, and its warnings.
fn daylight(version: &str, kind: &str, inside: &str) -> (Vec<crate::Light>, Vec<String>) {
    let text = format!(r#"<scene version="{version}"><emitter type="{kind}">{inside}</emitter></scene>"#);
    let scene = crate::load_str(&text, "".as_ref(), &crate::LoadOptions::default()).unwrap();
    let warnings = scene.warnings.into_iter().filter(|w| w.element != "scene").map(|w| w.message);
    (scene.lights, warnings.collect())
}

/// Towards a day's sun in world space.
fn towards(day: &crate::Daylight) -> DVec3 {
    day.world_from_light.transform_vector3(day.sun)
}

#[test]
fn daylight_is_a_sky_and_a_sun() {
    let given = r#"<rgb name="albedo" value="0.1 0.2 0.3"/><float name="turbidity" value="4"/>"#;
    let (lights, warnings) = daylight("3.0.0", "sunsky", given);
    assert!(warnings.is_empty(), "{warnings:?}");
    let [sky, sun] = &lights[..] else { panic!("{lights:?}") };
    let LightKind::Sky { daylight: day, scale: 1.0 } = &sky.kind else { panic!("{sky:?}") };
    assert_eq!((day.albedo, day.turbidity), ([0.1, 0.2, 0.3], 4.0));
    // +z is up; where Mitsuba 3.9.1 has the sun of its default place and time
    assert!(day.world_from_light.transform_vector3(DVec3::Y).abs_diff_eq(DVec3::Z, 1e-12));
    assert!(towards(day).abs_diff_eq(DVec3::new(0.0546, 0.6941, 0.7179), 0.006), "{day:?}");
    let LightKind::Sun { daylight: same, half_deg, scale: 1.0 } = sun.kind else { panic!("{sun:?}") };
    assert!(same == *day && (half_deg - 0.2679).abs() < 1e-6 && sun.name == "sunsky 1.sun", "{sun:?}");

    // of 0.x: +y is up, +x east and +z south; the sun of an afternoon stands in the west
    let (old, _) = daylight("0.6.0", "sun", r#"<float name="sunRadiusScale" value="2"/>"#);
    let [LightKind::Sun { daylight: west, half_deg, .. }] = [&old[0].kind] else { panic!("{old:?}") };
    let place = towards(west);
    assert!(
        (place.y - day.sun.y).abs() < 1e-9 && place.x < -0.6 && (half_deg - 0.5358).abs() < 1e-6,
        "{place}"
    );
    assert!(matches!(daylight("0.6.0", "sky", "").0[..], [crate::Light { kind: LightKind::Sky { .. }, .. }]));
}

#[test]
fn suns_have_their_direction_size_and_scale() {
    let sun = |inside: &str| {
        let up = r#"<vector name="sun_direction" value="0 3 4"/><float name="sky_scale" value="0"/>"#;
        let (lights, warnings) = daylight("3.0.0", "sunsky", &format!("{up}{inside}"));
        let [crate::Light { kind: LightKind::Sun { daylight, half_deg, scale }, .. }] = lights[..] else {
            panic!("{lights:?}")
        };
        assert!(towards(&daylight).abs_diff_eq(DVec3::new(0.0, 0.6, 0.8), 1e-12), "{daylight:?}");
        (half_deg, scale, warnings)
    };
    assert_eq!(sun(r#"<float name="sun_aperture" value="5"/>"#).0, 2.5);
    // a point has no direction to be drawn: it gets a width that nobody sees
    assert_eq!(sun(r#"<float name="sun_aperture" value="0"/>"#).0, 1e-3);
    assert_eq!(sun(r#"<float name="sun_scale" value="0.5"/><float name="scale" value="3"/>"#).1, 1.5);
    assert!(sun(r#"<boolean name="complex_sun" value="true"/>"#).2[0].contains("rim"));
}

#[test]
fn night_has_no_daylight() {
    let (lights, warnings) = daylight("3.0.0", "sunsky", r#"<float name="hour" value="2"/>"#);
    assert!(lights.is_empty() && warnings[0].contains("below the horizon"), "{warnings:?}");
    let wrong = r#"<emitter type="sunsky"><float name="turbidity" value="11"/></emitter>"#;
    assert!(try_load(wrong).unwrap_err().to_string().contains("between 1 and 10"));
}
