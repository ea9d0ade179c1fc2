//! Where readers of Mitsuba scenes go wrong, as pictures: the side that +x lies on, the first row of a bitmap, the back of
//! a surface, what is a number and what a colour.

use std::fs;

use limpid_frame::{Frame, Layer, Statistic, write_png};
use limpid_scenes::{LoadOptions, Scene, load, load_str};
use limpid_tests::{rendered, within};

fn read(elements: &str) -> Scene {
    let text = format!("<scene version=\"3.0.0\">{elements}</scene>");
    load_str(&text, "".as_ref(), &LoadOptions::default()).unwrap_or_else(|error| panic!("{error}"))
}

/// A scene with a picture beside it, of one row of grey values, the first first.
fn with_picture(elements: &str, rows: &[[f32; 3]]) -> Scene {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let plane = |channel: usize| rows.iter().map(|row| row[channel]).collect::<Vec<f32>>();
    let planes = [plane(0), plane(1), plane(2)];
    write_png(planes.each_ref().map(Vec::as_slice), 1, rows.len(), 0.0, &folder.path().join("p.png"))
        .expect("writes");
    let path = folder.path().join("scene.xml");
    fs::write(&path, format!("<scene version=\"3.0.0\">{elements}</scene>")).expect("writes");
    load(&path, &LoadOptions::default()).unwrap_or_else(|error| panic!("{error}"))
}

fn picture(scene: &Scene) -> Frame {
    rendered(scene, |s| s.spp = 16).frame
}

/// Sum of the green channel over a part of the picture, in shares of its width and height.
fn sum(frame: &Frame, x: std::ops::Range<f64>, y: std::ops::Range<f64>) -> f64 {
    let green = frame.channel("G").expect("every frame has its beauty");
    let (width, height) = (frame.width(), frame.height());
    let inside = |at: usize, size: usize, range: &std::ops::Range<f64>| {
        range.contains(&((at as f64 + 0.5) / size as f64))
    };
    (0..green.len())
        .filter(|i| inside(i % width, width, &x) && inside(i / width, height, &y))
        .map(|i| f64::from(green[i]))
        .sum()
}

/// A camera in the origin that looks along +z with +y up.
const EYE: &str = r#"<sensor type="perspective"><float name="fov" value="60"/><film type="hdrfilm"><integer name="width" value="24"/><integer name="height" value="16"/><rfilter type="box"/></film></sensor>"#;
/// One that looks at the origin from +z, with +y up.
const FRONT: &str = r#"<sensor type="perspective"><float name="fov" value="60"/><transform name="to_world"><lookat origin="0 0 3" target="0 0 0" up="0 1 0"/></transform><film type="hdrfilm"><integer name="width" value="24"/><integer name="height" value="16"/><rfilter type="box"/></film></sensor>"#;
const SKY: &str = r#"<emitter type="constant"/>"#;
const GLOW: &str = r#"<emitter type="area"><rgb name="radiance" value="1"/></emitter>"#;

#[test]
fn plus_x_of_a_camera_is_on_the_left_and_plus_y_above() {
    let lamp = format!(
        r#"{EYE}<shape type="sphere"><point name="center" x="1" y="0.7" z="4"/><float name="radius" value="0.2"/>{GLOW}</shape>"#
    );
    let frame = picture(&read(&lamp));
    let all = sum(&frame, 0.0..1.0, 0.0..1.0);
    assert!(all > 0.0);
    within("left and above", sum(&frame, 0.0..0.5, 0.0..0.5), all, 1e-6);
}

#[test]
fn the_first_row_of_a_bitmap_lies_at_v_0_and_obj_turns_it() {
    let texture = r#"<emitter type="area"><texture name="radiance" type="bitmap"><string name="filename" value="p.png"/><string name="filter_type" value="nearest"/></texture></emitter>"#;
    let rows = [[1.0; 3], [0.0; 3]];
    let frame = picture(&with_picture(&format!("{FRONT}<shape type=\"rectangle\">{texture}</shape>"), &rows));
    // a rectangle has v = 0 at its lower edge
    let all = sum(&frame, 0.0..1.0, 0.0..1.0);
    within("below", sum(&frame, 0.0..1.0, 0.5..1.0), all, 1e-6);
    assert!(all > 10.0, "{all}");

    let folder = tempfile::tempdir().expect("a temporary folder");
    let square =
        "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
    fs::write(folder.path().join("s.obj"), square).expect("writes");
    let planes = [[1.0f32, 0.0]; 3];
    write_png(planes.each_ref().map(|p| &p[..]), 1, 2, 0.0, &folder.path().join("p.png")).expect("writes");
    let text = format!(
        r#"<scene version="3.0.0">{FRONT}<shape type="obj"><string name="filename" value="s.obj"/>{texture}</shape></scene>"#
    );
    fs::write(folder.path().join("scene.xml"), text).expect("writes");
    let frame = picture(&load(&folder.path().join("scene.xml"), &LoadOptions::default()).expect("loads"));
    let all = sum(&frame, 0.0..1.0, 0.0..1.0);
    within("above", sum(&frame, 0.0..1.0, 0.0..0.5), all, 1e-6);
    assert!(all > 10.0, "{all}");
}

#[test]
fn the_back_of_a_surface_is_black_unless_two_sided_and_never_shines() {
    let behind = |inside: &str| {
        let turned =
            r#"<transform name="to_world"><scale value="9"/><rotate x="1" angle="180"/></transform>"#;
        let frame =
            picture(&read(&format!("{FRONT}{SKY}<shape type=\"rectangle\">{turned}{inside}</shape>")));
        sum(&frame, 0.4..0.6, 0.4..0.6)
    };
    let pixels = sum(&picture(&read(&format!("{FRONT}{SKY}"))), 0.4..0.6, 0.4..0.6);
    within("one-sided", behind(r#"<bsdf type="diffuse"/>"#), 0.0, 0.0);
    within("two-sided", behind(r#"<bsdf type="twosided"><bsdf type="diffuse"/></bsdf>"#), 0.5 * pixels, 1e-5);
    let two_sided_lamp = format!(
        r#"{GLOW}<bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></bsdf>"#
    );
    within("a lamp", behind(&two_sided_lamp), 0.0, 0.0);
}

#[test]
fn numbers_from_a_picture_are_its_decoded_luminance() {
    let sky = sum(&picture(&read(&format!("{FRONT}{SKY}"))), 0.4..0.6, 0.4..0.6);
    let black = r#"<bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>"#;
    let masked = format!(
        r#"{FRONT}{SKY}<shape type="rectangle"><transform name="to_world"><scale value="9"/></transform><bsdf type="mask">
        <texture name="opacity" type="bitmap"><string name="filename" value="p.png"/></texture>{black}</bsdf></shape>"#
    );
    let through = |text: &str, color: [f32; 3]| {
        let frame = rendered(&with_picture(text, &[color]), |s| s.spp = 1024).frame;
        sum(&frame, 0.4..0.6, 0.4..0.6) / sky
    };
    // 1024 samples of some 12 pixels: a standard deviation below 0.005. Colours are linear, the file's bytes encoded.
    within("red lets through", through(&masked, [1.0, 0.0, 0.0]), 1.0 - 0.2126, 0.03);
    within("half grey lets through", through(&masked, [0.5; 3]), 0.5, 0.05);
    let raw = r#"<boolean name="raw" value="true"/><string name="filename""#;
    let raw = masked.replace(r#"<string name="filename""#, raw);
    within("raw half grey lets through", through(&raw, [0.5; 3]), 1.0 - 0.735, 0.08);
}

#[test]
fn a_crop_is_a_part_of_the_same_view() {
    let things = r#"<emitter type="constant"/><shape type="sphere"><point name="center" x="0.5" y="0" z="3"/></shape>"#;
    let whole = picture(&read(&format!("{EYE}{things}")));
    let crop = r#"<integer name="crop_offset_x" value="5"/><integer name="crop_offset_y" value="3"/><integer name="crop_width" value="10"/><integer name="crop_height" value="8"/><rfilter"#;
    let part = picture(&read(&format!("{}{things}", EYE.replace("<rfilter", crop))));
    assert_eq!((part.width(), part.height()), (10, 8));
    let (whole, part) = (whole.channel("G").expect("there"), part.channel("G").expect("there"));
    for y in 0..8 {
        assert_eq!(part[10 * y..10 * y + 10], whole[24 * (y + 3) + 5..24 * (y + 3) + 15], "row {y}");
    }
}

#[test]
fn the_angle_of_view_is_along_its_axis_also_on_a_portrait_film() {
    // a lamp that fills the view at distance 1 as far as tan 30° to the side and 2 tan 30° above
    let share = |axis: &str, width: u32, height: u32| {
        let eye = EYE
            .replace("\"width\" value=\"24\"", &format!("\"width\" value=\"{width}\""))
            .replace("\"height\" value=\"16\"", &format!("\"height\" value=\"{height}\""))
            .replace("<film", &format!("<string name=\"fov_axis\" value=\"{axis}\"/><film"));
        let half = 30f64.to_radians().tan();
        let lamp = format!(
            r#"<shape type="rectangle"><transform name="to_world"><scale x="{half}" y="{half}"/><rotate y="1" angle="180"/><translate z="1"/></transform>{GLOW}</shape>"#
        );
        sum(&rendered(&read(&format!("{eye}{lamp}")), |s| s.spp = 64).frame, 0.0..1.0, 0.0..1.0)
            / f64::from(width * height)
    };
    // a square of half the width, or all of it
    within("x, portrait", share("x", 16, 32), 0.5, 0.01);
    within("y, portrait", share("y", 16, 32), 1.0, 0.01);
    within("smaller, portrait", share("smaller", 16, 32), 0.5, 0.01);
    within("larger, portrait", share("larger", 16, 32), 1.0, 0.01);
    within("larger, landscape", share("larger", 32, 16), 1.0, 0.01);
    within("smaller, landscape", share("smaller", 32, 16), 0.5, 0.01);
}

#[test]
fn hidden_emitters_leave_neither_light_nor_alpha() {
    let rgba = EYE.replace("<rfilter", r#"<string name="pixel_format" value="rgba"/><rfilter"#);
    let hide = r#"<integrator type="path"><boolean name="hide_emitters" value="true"/></integrator>"#;
    let lamp = format!(
        r#"<shape type="rectangle"><transform name="to_world"><rotate y="1" angle="180"/><translate x="3" z="6"/></transform>{GLOW}</shape>"#
    );
    let ball = r#"<shape type="sphere"><point name="center" x="-1" y="0" z="4"/></shape>"#;
    let frame = picture(&read(&format!("{hide}{rgba}{SKY}{lamp}{ball}")));
    let alpha = frame.layer(Layer::Alpha, Statistic::Mean).expect("asked for")[0];
    let green = frame.channel("G").expect("there");
    let empty = alpha.iter().zip(green).filter(|(a, g)| **a == 0.0 && **g == 0.0).count();
    let full = alpha.iter().zip(green).filter(|(a, g)| **a == 1.0 && **g > 0.0).count();
    assert!(empty > alpha.len() / 2 && full > 10, "{empty} empty and {full} full of {}", alpha.len());
    assert!(alpha.iter().zip(green).all(|(a, g)| *a > 0.0 || *g == 0.0), "light without alpha");
}

#[test]
fn the_sky_stands_on_y_in_0_x_and_on_z_in_3() {
    // what is seen a quarter of a degree around a direction, by the sun of this one; none where it is below the horizon
    let seen = |version: &str, sun: [f64; 3], towards: [f64; 3]| {
        let (name, [x, y, z]) = (if version == "3.0.0" { "sun_direction" } else { "sunDirection" }, sun);
        let [a, b, c] = towards;
        let text = format!(
            r#"<scene version="{version}"><emitter type="sunsky"><vector name="{name}" x="{x}" y="{y}" z="{z}"/></emitter>
            <sensor type="perspective"><float name="fov" value="0.25"/><transform name="{}"><lookat origin="0 0 0" target="{a} {b} {c}" up="1 0 0"/></transform>
            <film type="hdrfilm"><integer name="width" value="4"/><integer name="height" value="4"/></film></sensor></scene>"#,
            if version == "3.0.0" { "to_world" } else { "toWorld" }
        );
        let scene = load_str(&text, "".as_ref(), &LoadOptions::default()).expect("loads");
        (!scene.lights.is_empty()).then(|| sum(&picture(&scene), 0.0..1.0, 0.0..1.0) / 16.0)
    };
    let (over_y, over_z, beside) = ([0.3, 0.9, -0.1], [0.3, -0.1, 0.9], [0.9, 0.3, 0.3]);
    for (version, over, below) in [("0.6.0", over_y, over_z), ("3.0.0", over_z, over_y)] {
        let (sun, sky) = (seen(version, over, over), seen(version, over, beside));
        let (sun, sky) = (sun.expect("is up"), sky.expect("is up"));
        assert!(sky > 0.0 && sun > 1000.0 * sky, "{version}: the sun {sun}, the sky {sky}");
        assert_eq!(seen(version, below, below), None, "{version}");
    }
}

#[test]
fn the_middle_of_an_environment_map_is_seen_along_plus_z() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    // bright in the middle, a little above the horizon
    let (width, height) = (64, 32);
    let bright = |i: usize| (30..34).contains(&(i % width)) && (12..15).contains(&(i / width));
    let plane: Vec<f32> = (0..width * height).map(|i| if bright(i) { 1.0 } else { 0.0 }).collect();
    write_png([&plane, &plane, &plane], width, height, 0.0, &folder.path().join("p.png")).expect("writes");
    let text = format!(
        r#"<scene version="3.0.0">{EYE}<emitter type="envmap"><string name="filename" value="p.png"/></emitter></scene>"#
    );
    fs::write(folder.path().join("scene.xml"), text).expect("writes");
    let frame = picture(&load(&folder.path().join("scene.xml"), &LoadOptions::default()).expect("loads"));
    let all = sum(&frame, 0.0..1.0, 0.0..1.0);
    assert!(all > 1.0, "{all}");
    within("in the middle, above", sum(&frame, 0.25..0.75, 0.0..0.5), all, 1e-6);
}

#[test]
fn object_ids_follow_the_file_also_through_a_merge() {
    let ids = r#"<integrator type="aov"><string name="aovs" value="i:shape_index"/><integrator type="path"/></integrator>"#;
    let ball = |x: f64| {
        format!(
            r#"<shape type="sphere"><point name="center" x="{x}" y="0" z="6"/><float name="radius" value="0.8"/></shape>"#
        )
    };
    let elements =
        format!("{ids}{EYE}{SKY}{}<shape type=\"merge\">{}{}</shape>", ball(2.0), ball(0.0), ball(-2.0));
    let frame = picture(&read(&elements));
    let plane = frame.layer(Layer::Id, Statistic::Mean).expect("asked for")[0];
    let row = &plane[8 * 24..9 * 24];
    let background = plane[0];
    let mut objects: Vec<f32> = row.iter().copied().filter(|id| *id != background).collect();
    objects.dedup(); // from left to right
    let first = objects[0];
    assert_eq!(objects, [first, first + 1.0, first + 2.0], "{row:?}");
}
