//! The Mitsuba project's own test scenes, beside its reference pictures of about 32,000 samples a pixel:
//!
//! ```sh
//! cargo test --release -p limpid-tests --test references -- --ignored --nocapture
//! ```
//!
//! Its variances were taken in XYZ and written as RGB: they are brought back, and the comparison is in XYZ. Each scene's
//! false-alarm rate is 1 %; seeds are fixed.

use std::path::{Path, PathBuf};

use limpid_frame::compare::{Comparison, Estimate, FALSE_ALARMS, Halves, Passes, compare};
use limpid_frame::{Frame, read_exr};
use limpid_renderer::{Prepared, Progress, Sampler, Settings, Splat, render};
use limpid_scenes::{LoadOptions, Scene, as_mitsuba, load};
use limpid_tests::start::{call, lacks_mitsuba};

/// Linear Rec. 709 to CIE XYZ (IEC 61966-2-1).
const XYZ_FROM_RGB: [[f64; 3]; 3] =
    [[0.412453, 0.357580, 0.180423], [0.212671, 0.715160, 0.072169], [0.019334, 0.119193, 0.950227]];
/// Samples a pixel behind each variance.
const REFERENCE_SPP: f64 = 32_000.0;
/// So far may sums of so many samples be off, which Mitsuba adds up in 32 bits: half a step of its last binary digits for
/// each. (White, 0.95046 in X, is 0.95074 in `test_orthographic_ref_rgb.exr`.)
const REFERENCE_ROUNDING: f64 = REFERENCE_SPP / (1u64 << 25) as f64;
/// References that Mitsuba 3.9.1 differs from as limpid does, in the same blocks. These scenes are compared with Mitsuba itself.
const OUTDATED: [&str; 1] = ["test_surf_area_light_volpath"];
/// Passes of one round, in two halves.
const PASSES: u32 = 16;
/// Samples of a pass in the first round.
const FIRST: u32 = 16;
/// Samples of all rounds, at most.
const MOST: u32 = 1 << 15;
/// The detectable bias at which more samples are not worth their time.
const TARGET: f64 = 0.005;

/// The scenes that have a reference, without those of media.
fn scenes() -> Vec<(PathBuf, PathBuf)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/scenes/mitsuba-tests/tests/scenes");
    if !root.is_dir() {
        println!("skipped: {} is not there", root.display());
        return Vec::new();
    }
    let files = |folder: &Path| -> Vec<PathBuf> {
        let entries = std::fs::read_dir(folder).expect("the folder is readable");
        entries.map(|entry| entry.expect("the entry is readable").path()).collect()
    };
    let mut found = Vec::new();
    for folder in files(&root) {
        for file in files(&folder).into_iter().filter(|file| file.extension().is_some_and(|e| e == "xml")) {
            let stem = file.file_stem().expect("a file has a name").to_string_lossy().into_owned();
            let (name, _) = stem.rsplit_once('_').expect("NAME_INTEGRATOR");
            found.push((file, folder.join("refs").join(format!("{name}_ref_rgb.exr"))));
        }
    }
    found.sort();
    found
}

fn to_xyz(rgb: [&[f32]; 3]) -> [Vec<f32>; 3] {
    XYZ_FROM_RGB.map(|row| {
        let sum = |p: usize| (0..3).map(|c| row[c] * f64::from(rgb[c][p])).sum::<f64>() as f32;
        (0..rgb[0].len()).map(sum).collect()
    })
}

/// Mitsuba adds a sample to all pixels in the filter's reach, and to fewer at the border, which is left out. The variance
/// is that of a sample, as if pixels were independent: right for the means of many, whose filters add up to 1.
fn reference(mean: &Path, splat: Splat) -> Halves {
    let xyz = |path: &Path, scale: f64| {
        let file = read_exr(path).unwrap_or_else(|e| panic!("{e}"));
        let mut frame = Frame::new(file.width(), file.height());
        for (name, plane) in ["R", "G", "B"].into_iter().zip(to_xyz(file.rgb().expect("a picture"))) {
            frame.insert(name, plane.iter().map(|v| (f64::from(*v) * scale) as f32).collect());
        }
        frame
    };
    let variance = mean.to_string_lossy().replace("_rgb.exr", "_rgb_var.exr");
    let mut variance = xyz(Path::new(&variance), 1.0 / REFERENCE_SPP);
    for name in ["R", "G", "B"] {
        let plane = variance.channel(name).expect("was put in").iter().map(|v| v.max(0.0)).collect();
        variance.insert(name, plane); // what does not vary was rounded
    }
    let mut estimate = Estimate::of_frames(&xyz(mean, 1.0), &variance).expect("they are of one size");
    estimate.set_rounding(REFERENCE_ROUNDING);
    if splat.radius > 0.5 {
        estimate.leave_out_border(splat.radius.ceil() as usize);
    }
    Halves::One(Box::new(estimate))
}

/// `PASSES` pictures of `spp` samples each with seeds from `first` on, in XYZ.
fn round(scene: &Scene, prepared: &Prepared, first: u64, spp: u32) -> Halves {
    let mut settings = Settings::for_camera(scene, 0);
    (settings.spp, settings.sampler) = (spp, Sampler::Independent);
    let size = [settings.width as usize, settings.height as usize];
    let mut halves = [Passes::new(size), Passes::new(size)];
    for pass in 0..u64::from(PASSES) {
        settings.seed = first + pass;
        let rendered = render(prepared, &settings, &Progress::default(), None);
        let xyz = to_xyz(rendered.frame.rgb().expect("every frame has its beauty"));
        halves[(pass & 1) as usize].push(xyz.each_ref().map(Vec::as_slice), spp);
    }
    Halves::Two(Box::new(halves.map(|half| half.estimate().expect("there are eight passes"))))
}

/// Renders until a difference of 0.5 % of the picture would show, as far as the reference allows.
fn compared(path: &Path, mean: &Path) -> (Comparison, u32) {
    let options =
        LoadOptions { defines: vec![("integrator".into(), integrator(path))], ..Default::default() };
    let mut scene = load(path, &options).unwrap_or_else(|e| panic!("{e}"));
    as_mitsuba(&mut scene);
    let reference = reference(mean, Splat::of(scene.cameras[0].film.filter));
    let prepared = Prepared::new(&scene, 0).unwrap_or_else(|e| panic!("{e}"));
    let mut ours = round(&scene, &prepared, 0, FIRST);
    let mut spp = PASSES * FIRST;
    loop {
        let comparison = compare(&ours, &reference);
        if comparison.detectable_bias <= TARGET || spp >= MOST {
            return (comparison, spp);
        }
        ours.merge(&round(&scene, &prepared, u64::from(spp), spp / PASSES));
        spp *= 2;
    }
}

/// Asks `crosscheck`, where there is Mitsuba.
fn agrees_with_mitsuba(scene: &Path) {
    let define = format!("integrator={}", integrator(scene));
    let words = ["crosscheck", "--power", "--json", "-D", &define];
    let call = call(Path::new("."), words.iter().map(Path::new).chain([scene]));
    if !lacks_mitsuba(&call) {
        assert_eq!(call.code, 0, "{}", call.stderr);
    }
}

/// `path` of `a/test_glass_path.xml`.
fn integrator(path: &Path) -> String {
    let stem = path.file_stem().expect("a file has a name").to_string_lossy();
    stem.rsplit_once('_').expect("NAME_INTEGRATOR").1.into()
}

/// Checks the scenes whose names hold `LIMPID_ROWS`, and prints them as a table.
fn check(in_time: impl Fn(&str) -> bool) {
    let only = std::env::var("LIMPID_ROWS").unwrap_or_default();
    let (mut count, mut blocks, mut failed) = (0, 0, Vec::new());
    for (scene, mean) in scenes() {
        let name = scene.file_stem().expect("a file has a name").to_string_lossy().into_owned();
        let has_medium = std::fs::read_to_string(&scene).expect("it is readable").contains("<medium");
        if has_medium || !name.contains(&only) || !in_time(&name) {
            continue;
        }
        let (found, spp) = compared(&scene, &mean);
        let agrees = found.p >= FALSE_ALARMS;
        let outdated = OUTDATED.contains(&&*name);
        let line = format!(
            "| {name} | {:+.2} % | {:.2} % | {:.2} | {spp} | {} |",
            100.0 * (found.mean_ratio - 1.0),
            100.0 * found.detectable_bias,
            found.p,
            match (agrees, outdated) {
                (true, _) if found.detectable_bias <= TARGET => "yes",
                (true, _) => "as far as it can show",
                (_, true) => "no, nor does Mitsuba 3.9.1",
                _ => "**no**",
            },
        );
        println!("{line}");
        if outdated {
            agrees_with_mitsuba(&scene);
        } else if !agrees {
            let findings = found.families.iter().flat_map(|family| &family.findings);
            let mut clear: Vec<_> = findings.collect();
            clear.sort_by(|a, b| a.p.total_cmp(&b.p));
            for finding in clear.iter().take(3) {
                println!("    {finding:?}");
            }
        }
        (count, blocks) = (count + 1, blocks + found.blocks);
        if !agrees && !outdated {
            failed.push(line);
        }
    }
    println!("{count} scenes, {blocks} places");
    assert!(failed.is_empty(), "{} of {count} differ:\n{}", failed.len(), failed.join("\n"));
}

#[test]
fn two_references_of_the_mitsuba_project_agree() {
    check(|name| ["test_directional_direct", "test_roughplastic_linear_path"].contains(&name));
}

#[test]
#[ignore = "takes minutes: for release builds"]
fn all_references_of_the_mitsuba_project_agree() {
    check(|_| true);
}
