//! The program as a user starts it: what it writes, under which name, and what it says.

use std::fs;
use std::path::Path;

use limpid_frame::{Frame, RecordTile, read_exr};
use limpid_tests::start::{call, cornell_box, done, folder, names_in};
use serde_json::Value;

fn frame(folder: &Path, name: &str) -> Frame {
    read_exr(&folder.join(name)).expect("is a frame")
}

/// Whether every channel of `part` has the same bits in `whole`.
fn assert_within(part: &Frame, whole: &Frame) {
    for (name, plane) in part.channels() {
        let other = whole.channel(name).unwrap_or_else(|| panic!("no channel {name}"));
        let bits = |plane: &[f32]| plane.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
        assert!(bits(plane) == bits(other), "channel {name} differs");
    }
}

/// The one object on the one line of standard output.
fn json(folder: &Path, line: &str) -> Value {
    let call = done(folder, line);
    assert_eq!(call.stdout.matches('\n').count(), 1, "limpid {line}: {}", call.stdout);
    serde_json::from_str(&call.stdout).unwrap_or_else(|e| panic!("limpid {line}: {e}: {}", call.stdout))
}

#[test]
fn a_scene_is_rendered_under_its_own_name_here() {
    let folder = folder();
    let (here, kitchen) = (folder.path().join("here"), folder.path().join("kitchen"));
    fs::create_dir(&here).expect("makes a folder");
    fs::create_dir(&kitchen).expect("makes a folder");
    fs::copy(folder.path().join("ball.xml"), kitchen.join("scene.xml")).expect("copies");
    done(&here, "render ../ball.xml");
    assert_eq!(names_in(&here), ["ball.exr", "ball.png"]);
    done(&here, "render ../kitchen/scene.xml --spp 1");
    assert_eq!(names_in(&here), ["ball.exr", "ball.png", "kitchen.exr", "kitchen.png"]);
    assert_eq!((frame(&here, "ball.exr").width(), frame(&here, "ball.exr").height()), (24, 16));
}

#[test]
fn a_named_frame_comes_without_a_picture_unless_one_is_asked_for() {
    let folder = folder();
    done(folder.path(), "render ball.xml -o a.exr");
    done(folder.path(), "render ball.xml -o b.exr --png c.png --exposure -1");
    assert_eq!(names_in(folder.path()), ["a.exr", "b.exr", "ball.xml", "c.png"]);
    assert!(fs::read(folder.path().join("c.png")).expect("reads").starts_with(b"\x89PNG"));
}

#[test]
fn a_render_says_how_noisy_it_is_and_quiet_says_nothing() {
    let folder = folder();
    let call = done(folder.path(), "render ball.xml");
    let noise = call.stderr.lines().find(|line| line.starts_with("noise: ")).expect("says it");
    assert!(noise.contains("relMSE") && noise.contains("--denoise"), "{noise}");
    assert_eq!(call.stdout, "");
    let call = done(folder.path(), "render ball.xml --quiet");
    assert_eq!((call.stdout.as_str(), call.stderr.as_str()), ("", ""));
}

#[test]
fn json_is_one_object_on_one_line_with_the_keys_that_scripts_rely_on() {
    let folder = folder();
    let has = |object: &Value, keys: &str| {
        for key in keys.split(' ') {
            assert!(!object[key].is_null(), "no {key} in {object}");
        }
    };
    let render = json(folder.path(), "render ball.xml --denoise joint-nlm --png a.png --json");
    has(
        &render,
        "output png width height spp seconds render_s rays mrays_per_second error rejected effects counters",
    );
    has(&render["seconds"], "load prepare render denoise write");
    has(&render["error"], "relmse low high");
    if cfg!(target_os = "linux") {
        has(&render, "render_user_s peak_memory_bytes");
    }
    assert_eq!((render["width"].as_u64(), render["spp"].as_u64()), (Some(24), Some(4)));
    let scene = json(folder.path(), "info ball.xml --json");
    has(&scene, "triangles instances lights materials effects cameras size spp warnings");
    assert_eq!((scene["triangles"].as_u64(), scene["lights"].as_u64()), (Some(4), Some(1)));
    let frame = json(folder.path(), "info ball.exr --json");
    has(&frame, "width height layers metadata");
    assert_eq!(frame["metadata"]["limpid:scene"], "ball.xml");
    let metrics = json(folder.path(), "metrics ball.exr ball.exr --json");
    has(&metrics, "mse relmse relmse_trimmed smape left_out");
    assert_eq!(metrics["mse"].as_f64(), Some(0.0));
    let methods = json(folder.path(), "methods --json");
    has(&methods["methods"][0], "name needs kind source");
    done(folder.path(), "render ball.xml --layers all -o noisy.exr");
    has(&json(folder.path(), "denoise noisy.exr -o clean.exr --json"), "output method seconds");
    assert_eq!(
        json(folder.path(), "info ball.xml ball.exr --json")["files"].as_array().map(Vec::len),
        Some(2)
    );
}

#[test]
fn any_number_of_threads_gives_the_same_file() {
    let folder = folder();
    let scene = cornell_box();
    let bytes = ["1", "2", "7"].map(|threads| {
        let line = "--spp 4 --size 48x48 --layers all --denoise joint-nlm -o a.exr --png a.png --threads";
        let scene = scene.to_str().expect("has a plain path");
        let line = ["render", scene].into_iter().chain(line.split(' ')).chain([threads]);
        let call = call(folder.path(), line);
        assert_eq!(call.code, 0, "{}", call.stderr);
        ["a.exr", "a.png"].map(|name| fs::read(folder.path().join(name)).expect("was written"))
    });
    assert!(bytes[0] == bytes[1] && bytes[0] == bytes[2], "the files differ");
}

#[test]
fn a_pixel_alone_has_the_files_bits() {
    let folder = folder();
    done(folder.path(), "render ball.xml --layers all -o all.exr");
    let all = frame(folder.path(), "all.exr");
    for (x, y) in [(0, 0), (11, 6), (23, 15)] {
        let line = format!("render ball.xml --layers all --pixel {x},{y} --json");
        let report = json(folder.path(), &line);
        let values = report["pixel"]["values"].as_object().expect("are there");
        assert_eq!(values.len(), all.channels().count());
        for (name, plane) in all.channels() {
            let value = values[name].as_f64().unwrap_or_else(|| panic!("no number for {name}")) as f32;
            assert_eq!(value.to_bits(), plane[y * 24 + x].to_bits(), "{name} at {x},{y}");
        }
    }
    let call = done(folder.path(), "render ball.xml --pixel 11,6");
    let red = all.channel("R").expect("is there")[6 * 24 + 11];
    assert!(call.stdout.contains(&format!("R {red} ")), "{red} is not in {}", call.stdout);
    assert_eq!(names_in(folder.path()), ["all.exr", "ball.xml"]);
}

#[test]
fn a_crop_has_the_files_bits() {
    let folder = folder();
    done(folder.path(), "render ball.xml -o all.exr");
    done(folder.path(), "render ball.xml --crop 5,3,7,2 -o part.exr");
    let (all, part) = (frame(folder.path(), "all.exr"), frame(folder.path(), "part.exr"));
    assert_eq!((part.width(), part.height()), (7, 2));
    let (all, part) = (all.channel("G").expect("is there"), part.channel("G").expect("is there"));
    for y in 0..2 {
        assert_eq!(part[y * 7..][..7], all[(y + 3) * 24 + 5..][..7]);
    }
}

#[test]
fn asking_for_more_changes_no_bit_of_the_rest() {
    let folder = folder();
    done(folder.path(), "render ball.xml -o plain.exr");
    done(folder.path(), "render ball.xml --layers albedo,normal.variance -o some.exr");
    done(folder.path(), "render ball.xml --layers all -o all.exr");
    done(folder.path(), "render ball.xml --records records -o recorded.exr");
    let all = frame(folder.path(), "all.exr");
    assert_within(&frame(folder.path(), "some.exr"), &all);
    let plain = frame(folder.path(), "plain.exr");
    assert_within(&plain, &all);
    assert_within(&plain, &frame(folder.path(), "recorded.exr"));
}

#[test]
fn denoising_at_once_or_later_gives_the_same_picture() {
    let folder = folder();
    done(folder.path(), "render ball.xml --layers all -o noisy.exr");
    done(folder.path(), "denoise noisy.exr --set radius=4 -o later.exr --png later.png");
    done(folder.path(), "render ball.xml --denoise joint-nlm --set radius=4 -o at-once.exr");
    let (noisy, later) = (frame(folder.path(), "noisy.exr"), frame(folder.path(), "later.exr"));
    let at_once = frame(folder.path(), "at-once.exr");
    for name in ["R", "G", "B"] {
        assert_eq!(at_once.channel(name), later.channel(name));
        assert_ne!(at_once.channel(name), noisy.channel(name), "{name} is not denoised");
        assert_eq!(at_once.channel(&format!("noisy.{name}")), noisy.channel(name));
    }
    assert!(folder.path().join("later.png").is_file());
}

#[test]
fn files_of_others_are_denoised_with_albedo_and_normals_of_their_own() {
    let folder = folder();
    done(folder.path(), "render ball.xml --layers all -o all.exr");
    let all = frame(folder.path(), "all.exr");
    let write = |name: &str, from: &str, channels: [&str; 3]| {
        let mut part = Frame::new(all.width(), all.height());
        for (channel, c) in channels.iter().zip(["R", "G", "B"]) {
            part.insert(c, all.channel(&format!("{from}{channel}")).expect("is there").to_vec());
        }
        limpid_frame::write_exr(&part, &folder.path().join(name)).expect("writes");
    };
    write("color.exr", "", ["R", "G", "B"]);
    write("albedo.exr", "albedo.", ["R", "G", "B"]);
    write("normal.exr", "normal.", ["X", "Y", "Z"]);
    done(folder.path(), "denoise color.exr --albedo albedo.exr --normal normal.exr -o clean.exr");
    let clean = frame(folder.path(), "clean.exr");
    for name in ["albedo.R", "normal.X"] {
        assert_eq!(clean.channel(name), all.channel(name));
    }
    assert_eq!(clean.channel("noisy.R"), all.channel("R"));
}

#[test]
fn a_frame_can_be_made_again_from_its_header() {
    let folder = folder();
    let line = "render ball.xml --spp 3 --size 20x10 --crop 2,1,16,8 --seed 7 --max-depth 3 --rr-depth 2 --clamp 4 \
                --sampler independent --layers albedo,diffuse.variance,beauty.halves -D grey=0.3 -o first.exr";
    done(folder.path(), line);
    let first = frame(folder.path(), "first.exr");
    let settings: Value = serde_json::from_str(&first.metadata["limpid:settings"]).expect("is JSON");
    let text = |key: &str| settings[key].as_str().expect("is text").to_owned();
    let list = |value: &Value, between: &str| {
        let words = |v: &Value| v.as_str().map_or(v.to_string(), str::to_owned);
        value.as_array().expect("is a list").iter().map(words).collect::<Vec<_>>().join(between)
    };
    let again = format!(
        "render {} --camera {} --spp {} --size {}x{} --crop {} --seed {} --max-depth {} --rr-depth {} --clamp {} \
         --sampler {} --layers {} -D {} -o again.exr",
        first.metadata["limpid:scene"],
        text("camera"),
        settings["spp"],
        settings["width"],
        settings["height"],
        list(&settings["crop"], ","),
        settings["seed"],
        settings["max_depth"],
        settings["rr_depth"],
        settings["clamp"],
        text("sampler"),
        list(&settings["layers"], ","),
        list(&settings["defines"][0], "="),
    );
    done(folder.path(), &again);
    let bytes = ["first.exr", "again.exr"].map(|name| fs::read(folder.path().join(name)).expect("reads"));
    assert!(bytes[0] == bytes[1], "`limpid {again}` makes another file");
    done(folder.path(), &again.replace("grey=0.3", "grey=0.4"));
    let other = fs::read(folder.path().join("again.exr")).expect("reads");
    assert!(bytes[0] != other, "the value of -D does not matter");
}

#[test]
fn records_add_up_to_the_frame() {
    let folder = folder();
    done(folder.path(), "render ball.xml --size 40x36 --layers albedo --records records -o a.exr");
    let frame = frame(folder.path(), "a.exr");
    let mut pixels = 0;
    for name in names_in(&folder.path().join("records")) {
        let tile = RecordTile::read(&folder.path().join("records").join(name)).expect("is a tile");
        let ((x0, y0), (width, height)) = (tile.origin(), tile.size());
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let samples: Vec<_> = (0..tile.spp()).map(|i| tile.get(i, x, y)).collect();
            let mean = |value: &dyn Fn(usize) -> f64| {
                (0..samples.len()).map(value).sum::<f64>() / samples.len() as f64
            };
            let radiance = mean(&|i| {
                let s = &samples[i];
                f64::from(s.diffuse[0]) + f64::from(s.specular[0]) + f64::from(s.emission[0])
            });
            let albedo = mean(&|i| samples[i].albedo[1].into());
            let p = (y0 + y) * 40 + x0 + x;
            for (name, mean) in [("R", radiance), ("albedo.G", albedo)] {
                let written = f64::from(frame.channel(name).expect("is there")[p]);
                // The parts of a sample are rounded each by itself.
                assert!((mean - written).abs() <= 1e-6 * written.abs(), "{name}: {mean}, {written}");
            }
            pixels += 1;
        }
    }
    assert_eq!(pixels, 40 * 36);
}

#[test]
fn an_exported_scene_renders_the_same_picture() {
    let folder = folder();
    let report = json(folder.path(), "export ball.xml -o out.xml --json");
    assert_eq!(report["output"], "out.xml");
    done(folder.path(), "render ball.xml -o a.exr");
    done(folder.path(), "render out.xml -o b.exr");
    assert_within(&frame(folder.path(), "a.exr"), &frame(folder.path(), "b.exr"));
    let refused = call(folder.path(), ["export", "ball.xml", "-o", "out.gltf"]);
    assert_eq!(refused.code, 2);
    assert!(refused.stderr.contains("Mitsuba scene is an XML file"), "{}", refused.stderr);
}
