//! `limpid crosscheck` as a user starts it: what is planted is found, what is sound passes, and the report is whole.
//!
//! Most of it needs no Mitsuba: limpid's own pictures, or an estimator that stands here, take its place by `--against`.
//! Each comparison of sound pictures raises a false alarm in 1 % of all seeds.

use std::fs;
use std::path::Path;

use limpid_frame::{Frame, read_exr, write_exr};
use limpid_tests::start::{Call, call, cornell_box, done, folder, lacks_mitsuba, limpid, names_in};
use serde_json::Value;

/// A glass ball before a checkered wall on a grey floor, under a lamp and a faint sky.
const GLASS: &str = r#"<scene version="3.0.0">
    <default name="grey" value="0.5"/>
    <default name="lamp" value="4"/>
    <default name="ior" value="1.5"/>
    <integrator type="path"><integer name="max_depth" value="6"/></integrator>
    <sensor type="perspective">
        <float name="fov" value="30"/>
        <transform name="to_world"><lookat origin="0, 1, 5" target="0, 0.8, 0" up="0, 1, 0"/></transform>
        <film type="hdrfilm">
            <integer name="width" value="64"/><integer name="height" value="64"/>
            <rfilter type="box"/>
        </film>
        <sampler type="independent"><integer name="sample_count" value="256"/></sampler>
    </sensor>
    <shape type="sphere">
        <point name="center" x="0" y="0.9" z="0"/><float name="radius" value="0.8"/>
        <bsdf type="dielectric"><float name="int_ior" value="$ior"/><float name="ext_ior" value="1"/></bsdf>
    </shape>
    <shape type="rectangle">
        <transform name="to_world"><rotate x="1" angle="-90"/><scale value="3"/></transform>
        <bsdf type="diffuse"><rgb name="reflectance" value="$grey"/></bsdf>
    </shape>
    <shape type="rectangle">
        <transform name="to_world"><scale value="3"/><translate z="-2"/></transform>
        <bsdf type="diffuse"><texture name="reflectance" type="checkerboard">
            <rgb name="color0" value="0.7, 0.6, 0.5"/><rgb name="color1" value="0.2, 0.3, 0.4"/>
            <transform name="to_uv"><scale value="6"/></transform>
        </texture></bsdf>
    </shape>
    <shape type="rectangle">
        <transform name="to_world"><scale value="2"/><rotate x="1" angle="90"/><translate y="4"/></transform>
        <emitter type="area"><rgb name="radiance" value="$lamp"/></emitter>
    </shape>
    <emitter type="constant"><rgb name="radiance" value="0.2"/></emitter>
</scene>
"#;

/// A folder with `glass.xml`.
fn glass() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join("glass.xml"), GLASS).expect("writes");
    folder
}

/// Writes `ref.exr`: limpid's picture of the scene with the variance of its pixels.
fn reference(folder: &Path, more: &str) {
    done(
        folder,
        &format!(
            "render glass.xml --sampler independent --spp 512 --layers beauty.variance -o ref.exr --quiet{more}"
        ),
    );
}

fn crosscheck(folder: &Path, line: &str) -> (Call, Value) {
    let call = call(folder, format!("crosscheck {line} --json --quiet").split(' '));
    let answer = serde_json::from_str(&call.stdout).unwrap_or(Value::Null);
    (call, answer)
}

const AGAINST: &str = "glass.xml --against ref.exr --against-variance ref.exr";

#[test]
fn sound_pictures_pass_with_ten_seeds() {
    let folder = glass();
    for seed in 0..10 {
        reference(folder.path(), &format!(" --seed {}", 100 + seed));
        let (call, answer) = crosscheck(folder.path(), &format!("{AGAINST} --seed {seed} --power"));
        assert_eq!(call.code, 0, "seed {seed}: {} {answer}", call.stderr);
        let scene = &answer["scenes"][0];
        assert!(scene["detectable_bias"].as_f64().expect("is a number") <= 0.005, "{answer}");
        assert!(scene["p"].as_f64().expect("is a number") > 0.01, "{answer}");
    }
}

#[test]
fn a_planted_per_cent_is_found_in_reflectance_light_and_index() {
    let folder = glass();
    reference(folder.path(), " --seed 7");
    for planted in ["grey=0.505", "lamp=4.04", "ior=1.515"] {
        let (call, answer) = crosscheck(folder.path(), &format!("{AGAINST} --spp 512 -D {planted}"));
        let scene = &answer["scenes"][0];
        println!("{planted}: p {}, mean ratio {}", scene["p"], scene["mean_ratio"]);
        assert_eq!(call.code, 1, "{planted}: {answer}");
        assert_eq!(
            (&answer["agree"], &scene["verdict"]),
            (&Value::Bool(false), &Value::from("differ")),
            "{planted}"
        );
        assert!(scene["worst"][0]["alarm"].as_bool().expect("is said"), "{answer}");
    }
}

/// A floor lit from the side by a lamp that the camera does not see: direct light alone.
const FLOOR: &str = r#"<scene version="3.0.0">
    <integrator type="path"><integer name="max_depth" value="2"/></integrator>
    <sensor type="perspective">
        <float name="fov" value="30"/>
        <transform name="to_world"><lookat origin="0, 4, 0" target="0, 0, 0" up="0, 0, 1"/></transform>
        <film type="hdrfilm">
            <integer name="width" value="48"/><integer name="height" value="48"/>
            <rfilter type="box"/>
        </film>
        <sampler type="independent"><integer name="sample_count" value="1024"/></sampler>
    </sensor>
    <shape type="rectangle">
        <transform name="to_world"><rotate x="1" angle="-90"/><scale value="3"/></transform>
        <bsdf type="diffuse"><rgb name="reflectance" value="0.5"/></bsdf>
    </shape>
    <shape type="rectangle">
        <transform name="to_world"><rotate y="1" angle="-90"/><translate x="3" y="1.5"/></transform>
        <emitter type="area"><rgb name="radiance" value="10"/></emitter>
    </shape>
</scene>
"#;

/// The same floor by an estimator of its own, which draws points uniformly on the lamp and takes their density to be
/// `density` times what it is. 1024 samples a pixel in 16 passes, whose spread is the variance.
fn estimate(folder: &Path, name: &str, density: f64) {
    const SIDE: usize = 48;
    let mut state = 1u64;
    let mut uniform = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 * 2f64.powi(-53)
    };
    let slope = 15f64.to_radians().tan();
    let (mut means, mut variances) = (Vec::new(), Vec::new());
    for pixel in 0..SIDE * SIDE {
        let passes: Vec<f64> = (0..16)
            .map(|_| {
                let radiance = |_| {
                    // Camera x points to the left of the picture and to +x of the world, its y to +z.
                    let at = |p: usize, u: f64| slope * (1.0 - 2.0 * (p as f64 + u) / SIDE as f64);
                    let [x, z] = [4.0 * at(pixel % SIDE, uniform()), 4.0 * at(pixel / SIDE, uniform())];
                    let [dx, dy, dz] = [3.0 - x, 0.5 + 2.0 * uniform(), 2.0 * uniform() - 1.0 - z];
                    let d2 = dx * dx + dy * dy + dz * dz;
                    let pdf = density / 4.0; // of the lamp's 2 x 2
                    0.5 / std::f64::consts::PI * 10.0 * (dy * dx) / (d2 * d2) / pdf
                };
                (0..64).map(radiance).sum::<f64>() / 64.0
            })
            .collect();
        let mean = passes.iter().sum::<f64>() / 16.0;
        means.push(mean as f32);
        variances.push((passes.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / 15.0 / 16.0) as f32);
    }
    for (name, plane) in [(name.to_owned(), means), (format!("{name}-variance"), variances)] {
        let mut frame = Frame::new(SIDE, SIDE);
        for channel in ["R", "G", "B"] {
            frame.insert(channel, plane.clone());
        }
        write_exr(&frame, &folder.join(format!("{name}.exr"))).expect("writes");
    }
}

#[test]
fn a_density_that_is_one_per_cent_off_is_found() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join("floor.xml"), FLOOR).expect("writes");
    estimate(folder.path(), "right", 1.0);
    estimate(folder.path(), "wrong", 1.01);
    let (right, answer) =
        crosscheck(folder.path(), "floor.xml --against right.exr --against-variance right-variance.exr");
    assert_eq!(right.code, 0, "{} {answer}", right.stderr);
    let (wrong, answer) =
        crosscheck(folder.path(), "floor.xml --against wrong.exr --against-variance wrong-variance.exr");
    assert_eq!((wrong.code, &answer["scenes"][0]["verdict"]), (1, &Value::from("differ")), "{answer}");
    let ratio = answer["scenes"][0]["mean_ratio"].as_f64().expect("is a number");
    println!("density of the other x 1.01: p {}, mean ratio {ratio}", answer["scenes"][0]["p"]);
    assert!((ratio - 1.01).abs() < 0.002, "{ratio}");
}

#[test]
fn too_much_noise_is_no_agreement_and_says_what_it_takes() {
    let folder = glass();
    reference(folder.path(), "");
    let call = call(folder.path(), format!("crosscheck {AGAINST} --spp 16 -o report").split(' '));
    assert_eq!(call.code, 1, "{}", call.stderr);
    assert!(call.stdout.contains("not decided"), "{}", call.stdout);
    assert!(call.stderr.contains("--spp") && call.stderr.contains("--power"), "{}", call.stderr);
}

#[test]
fn the_report_is_whole_and_needs_no_network() {
    let folder = glass();
    reference(folder.path(), "");
    done(folder.path(), &format!("crosscheck {AGAINST} --spp 512 -o report"));
    let report = folder.path().join("report");
    let pictures = ["difference", "limpid", "p-values", "reference"];
    let mut expected: Vec<String> =
        pictures.iter().flat_map(|name| ["exr", "png"].map(|kind| format!("{name}.{kind}"))).collect();
    expected.push("index.html".into());
    expected.sort();
    assert_eq!(names_in(&report), expected);
    let page = fs::read_to_string(report.join("index.html")).expect("reads");
    assert!(!page.contains("http:") && !page.contains("https:") && !page.contains("{{"));
    assert_eq!(page.matches("data:image/png;base64,").count(), 4);
    for word in ["They agree", "Flip", "Split", "How to read this"] {
        assert!(page.contains(word), "no {word}");
    }
    let [ours, theirs, difference] = ["limpid", "reference", "difference"]
        .map(|name| read_exr(&report.join(format!("{name}.exr"))).expect("reads"));
    let at = |frame: &Frame| frame.channel("G").expect("has it")[1234];
    assert!((at(&ours) - at(&theirs) - at(&difference)).abs() <= 1e-6 * at(&ours).abs());
}

#[test]
fn a_splatted_reference_is_known_to_share_samples() {
    let folder = glass();
    fs::write(folder.path().join("glass.xml"), GLASS.replace("\"box\"", "\"gaussian\"")).expect("writes");
    reference(folder.path(), "");
    // As another renderer would have written it: without our header.
    let mut frame = read_exr(&folder.path().join("ref.exr")).expect("reads");
    let (_, ours) = crosscheck(folder.path(), &format!("{AGAINST} --spp 16"));
    assert_eq!(ours["scenes"][0]["notes"], Value::Array(Vec::new()), "{ours}");
    frame.metadata.clear();
    write_exr(&frame, &folder.path().join("ref.exr")).expect("writes");
    let (_, theirs) = crosscheck(folder.path(), &format!("{AGAINST} --spp 16"));
    let note = theirs["scenes"][0]["notes"][0].as_str().expect("has a note");
    assert!(note.contains("share samples") && note.contains("passes"), "{note}");
    assert_eq!(theirs["scenes"][0]["left_out"], 64 * 64 - 60 * 60);
}

#[test]
fn wrong_calls_are_told_apart_from_machines_without_mitsuba() {
    let folder = glass();
    let missing = limpid()
        .args(["crosscheck".as_ref(), cornell_box().as_os_str(), "--json".as_ref()])
        .env("LIMPID_MITSUBA_PYTHON", folder.path().join("no-python"))
        .current_dir(folder.path())
        .output()
        .expect("the program starts");
    let missing = Call::of(&missing);
    assert_eq!((missing.code, missing.stdout.as_str()), (3, ""), "{}", missing.stderr);
    assert!(
        missing.stderr.contains("LIMPID_MITSUBA_PYTHON") && missing.stderr.contains("help"),
        "{}",
        missing.stderr
    );
    reference(folder.path(), "");
    done(folder.path(), "render glass.xml --spp 1 -o plain.exr");
    for (line, word) in [
        ("glass.xml --against ref.exr", "--against-variance"),
        ("glass.xml --against ref.exr --against-variance none.exr", "none.exr"),
        ("glass.xml --against plain.exr --against-variance plain.exr", "--layers beauty.variance"),
        ("glass.xml --size 32x32 --against ref.exr --against-variance ref.exr", "64x64"),
        ("glass.xml --camera none --against ref.exr --against-variance ref.exr", "--camera"),
        ("none.xml --against ref.exr --against-variance ref.exr", "none.xml"),
        ("glass.xml --against ref.exr --against-variance ref.exr -o glass.xml/below", "glass.xml"),
    ] {
        let call = call(folder.path(), format!("crosscheck {line}").split(' '));
        assert_eq!(call.code, 2, "{line}: {}", call.stderr);
        assert!(call.stderr.contains(word), "{line}: {}", call.stderr);
    }
}

/// A Mitsuba whose fast variant renders the small scene that it is tried with, and dies of any other.
#[cfg(unix)]
const FRAIL: &str = r#"#!/bin/sh
case "$3" in
"") echo 3.9.1 ;;
llvm_ad_rgb) exit 0 ;;
*llvm_ad_rgb*) kill -9 $$ ;;
*)
    echo '{"size": [64, 64], "version": "3.9.1", "notes": []}'
    while read -r order; do
        path=$(echo "$order" | sed 's/.*"path":"\([^"]*\)".*/\1/')
        head -c 49152 /dev/zero > "$path"
        echo '{}'
    done
    ;;
esac
"#;

#[cfg(unix)]
#[test]
fn a_scene_that_the_fast_variant_dies_of_is_begun_again_with_the_sure_one() {
    use std::os::unix::fs::PermissionsExt;

    let folder = glass();
    let python = folder.path().join("python");
    fs::write(&python, FRAIL).expect("writes");
    fs::set_permissions(&python, fs::Permissions::from_mode(0o755)).expect("may be run");
    let output = limpid()
        .args(["crosscheck", "glass.xml", "--spp", "16", "--json"])
        .env("LIMPID_MITSUBA_PYTHON", &python)
        .env("XDG_CACHE_HOME", folder.path())
        .current_dir(folder.path())
        .output()
        .expect("the program starts");
    let call = Call::of(&output);
    assert_eq!(call.code, 1, "its pictures are black: {}", call.stderr);
    assert!(call.stderr.contains("trying scalar_rgb"), "{}", call.stderr);
    let answer: Value = serde_json::from_str(&call.stdout).expect("is JSON");
    assert_eq!(answer["scenes"][0]["other"], "Mitsuba 3.9.1 (scalar_rgb)");
}

#[test]
fn mitsuba_agrees_on_the_ball() {
    let folder = folder();
    // Another sensor before that of the ball, which is asked for by its name.
    let file = folder.path().join("ball.xml");
    let ball = fs::read_to_string(&file).expect("reads");
    let other = r#"<sensor type="perspective" id="other"/><sensor type="perspective" id="eye""#;
    fs::write(&file, ball.replace(r#"<sensor type="perspective" id="eye""#, other)).expect("writes");
    let (call, answer) = crosscheck(folder.path(), "ball.xml --camera eye --size 48x32 --power -o report");
    if lacks_mitsuba(&call) {
        return;
    }
    assert_eq!(call.code, 0, "{} {answer}", call.stderr);
    assert!(answer["scenes"][0]["other"].as_str().expect("is said").starts_with("Mitsuba 3"));
    assert!(names_in(&folder.path().join("report")).contains(&"mitsuba.exr".to_owned()));
}
