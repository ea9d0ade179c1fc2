//! `limpid crosscheck`: is it the same picture as Mitsuba's, and how sure is that?
//!
//! Mitsuba loads the user's own file; both render it with a box filter and independent samples, in passes with seeds of
//! their own, and `limpid_frame::compare` tests the means. What it says is told here: in words, as JSON, as a page.

mod against;
mod environment;
mod mitsuba;
mod ours;
mod report;
mod rounds;
mod verdict;

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::time::Instant;

use limpid_frame::FrameError;
use limpid_frame::compare::{Family, Finding, Parts};
use limpid_scenes::{LoadOptions, MaterialKind};
use serde_json::{Value, json};

use crate::cli::{Common, Crosscheck};
use crate::error::CliError;
use crate::progress::with_spinner;
use crate::{export, output, words};
use environment::{Environment, SURE};
use mitsuba::Mitsuba;
use ours::Ours;
use report::About;
use rounds::{Outcome, Theirs};
use verdict::Verdict;

/// Samples of the first round of `--power`.
const FIRST_ROUND: u32 = 64;
/// Places that JSON lists.
const LISTED: usize = 5;

/// Compares each scene; the answer is no where one does not agree.
pub fn run(options: &Crosscheck, common: &Common) -> Result<(), CliError> {
    let folders = report::folders(&options.scenes, options.output.as_deref(), common.json);
    // Before the work that they are to show: so that no work is lost.
    let mut new = Vec::new();
    for folder in folders.iter().flatten() {
        if report::make_folder(folder)? {
            new.push(folder);
        }
    }
    let done = compared(options, common, &folders);
    // What a comparison that never was would have filled.
    new.iter().for_each(|folder| _ = std::fs::remove_dir(folder));
    done
}

fn compared(options: &Crosscheck, common: &Common, folders: &[Option<PathBuf>]) -> Result<(), CliError> {
    let environment = match options.against {
        Some(_) => None,
        None => Some(Environment::ready(common)?),
    };
    let mut checked = Vec::new();
    for (scene, folder) in options.scenes.iter().zip(folders) {
        let done = check(scene, folder.as_deref(), environment.as_ref(), options, common)?;
        if !common.json {
            words::result(table(scene, folder.as_deref(), &done))?;
        }
        checked.push(done);
    }
    if let Some(folder) = options.output.as_ref().filter(|_| options.scenes.len() > 1) {
        let rows: Vec<_> =
            checked.iter().zip(folders).filter_map(|(done, folder)| row(done, folder.as_deref()?)).collect();
        let page = report::index(&rows);
        limpid_frame::write_whole(&folder.join("index.html"), |file| {
            std::io::Write::write_all(file, page.as_bytes())
        })?;
    }
    if common.json {
        let scenes: Vec<Value> = checked.iter().map(Checked::json).collect();
        let agree = checked.iter().all(|done| done.outcome.agrees());
        words::result(json!({ "agree": agree, "scenes": scenes }))?;
    }
    let no: Vec<&Checked> = checked.iter().filter(|done| !done.outcome.agrees()).collect();
    match no.as_slice() {
        [] => Ok(()),
        no => {
            let say = |done: &&Checked| format!("{}: {}", done.scene, verdict::sentences(&done.outcome));
            Err(CliError::No(no.iter().map(say).collect::<Vec<_>>().join("\n")))
        }
    }
}

/// A scene that was compared.
struct Checked {
    scene: String,
    other: String,
    outcome: Outcome,
    notes: Vec<String>,
    report: Option<String>,
    seconds: f64,
}

/// What Mitsuba loads.
struct ForMitsuba {
    file: PathBuf,
    notes: Vec<String>,
    /// Where an exported scene lies, for as long as it is needed.
    _folder: Option<tempfile::TempDir>,
}

/// The user's own file where it is Mitsuba's; a scene in another format is exported.
fn for_mitsuba(scene: &Path, options: &Crosscheck) -> Result<ForMitsuba, CliError> {
    let other = |extension: &OsStr| ["gltf", "glb", "obj"].iter().any(|x| extension.eq_ignore_ascii_case(x));
    if !scene.extension().is_some_and(other) {
        return Ok(ForMitsuba { file: scene.to_owned(), notes: Vec::new(), _folder: None });
    }
    let failed = |source| CliError::from(FrameError::WriteFailed { path: std::env::temp_dir(), source });
    let folder = tempfile::tempdir().map_err(failed)?;
    let file = folder.path().join("scene.xml");
    let reading = LoadOptions { defines: options.reading.defines.clone(), strict: options.reading.strict };
    let scene = limpid_scenes::load(scene, &reading)?;
    let (_, mut notes) = export::write(&scene, &file)?;
    notes.insert(0, "exported for Mitsuba: a fault of the reader would show in both pictures".into());
    if scene.materials.iter().any(|material| matches!(material.kind, MaterialKind::Gltf(_))) {
        let what = "both pictures show the nearest of Mitsuba's materials in the place of glTF's own, which `render` shows";
        notes.insert(1, what.into());
    }
    Ok(ForMitsuba { file, notes, _folder: Some(folder) })
}

fn check(
    scene: &Path,
    folder: Option<&Path>,
    environment: Option<&Environment>,
    options: &Crosscheck,
    common: &Common,
) -> Result<Checked, CliError> {
    let begin = Instant::now();
    let mut ours = Ours::new(scene, options, common)?;
    let size = ours.size();
    let spp = options.spp.unwrap_or(if options.power { FIRST_ROUND } else { ours.spp });
    let warnings = std::mem::take(&mut ours.warnings);
    let (splat, camera, seen) = (ours.splat, ours.camera, ours.seen());
    let seed = options.seed;
    let mut our_pass = |pass: u32, spp: u32| {
        let seed = seed << 32 | u64::from(pass); // passes of one seed and of another never meet
        Ok(with_spinner(common, "rendering here", || ours.pass(seed, spp)))
    };
    let mut tell = |outcome: &Outcome| {
        let reach = verdict::percent(outcome.detectable_bias());
        words::note(
            common,
            format_args!(
                "{}: at {} samples per pixel a difference of {reach} would show",
                scene.display(),
                outcome.spp
            ),
        );
    };
    let (outcome, other, notes) = match (environment, &options.against, &options.against_variance) {
        (None, Some(picture), Some(variance)) => {
            let (reference, notes) = against::picture(picture, variance, size, splat)?;
            notes.iter().for_each(|note| words::note(common, format_args!("note: {note}")));
            let theirs = Theirs::Fixed(reference);
            let outcome = rounds::run(&seen, size, spp, options.power, &mut our_pass, theirs, &mut tell)?;
            (outcome, picture.display().to_string(), notes)
        }
        (Some(environment), ..) => {
            let ForMitsuba { file, notes: of_export, _folder } = for_mitsuba(scene, options)?;
            let mut with = |variant: &str, notes: &[String]| {
                let load = || Mitsuba::start(&environment.python, variant, &file, camera, options, common);
                let mut mitsuba = with_spinner(common, "Mitsuba reads the scene", load)?;
                if mitsuba.size != size {
                    let [[w, h], [x, y]] = [size, mitsuba.size];
                    let problem = format!(
                        "limpid reads a film of {w}x{h} pixels, Mitsuba one of {x}x{y}; set one with `--size`"
                    );
                    return Err(CliError::File { path: scene.to_owned(), problem });
                }
                let mut notes = notes.to_vec();
                notes.append(&mut mitsuba.notes);
                notes.iter().for_each(|note| words::note(common, format_args!("note: {note}")));
                let other = format!("Mitsuba {} ({variant})", mitsuba.version);
                notes.insert(
                    0,
                    "both use a box filter and independent samples, whatever the file names".into(),
                );
                let mut their_pass = |pass: u32, spp: u32| {
                    let seed = (seed as u32).wrapping_mul(1009).wrapping_add(pass);
                    with_spinner(common, "rendering with Mitsuba", || mitsuba.pass(&file, seed, spp))
                };
                let theirs = Theirs::Renders(&mut their_pass);
                let outcome = rounds::run(&seen, size, spp, options.power, &mut our_pass, theirs, &mut tell)?;
                Ok((outcome, other, notes))
            };
            match with(&environment.variant, &of_export) {
                // Its LLVM may fail at this scene, though not at the one that it was tried with.
                Err(CliError::Mitsuba { problem, .. }) if environment.variant != SURE => {
                    words::note(
                        common,
                        format_args!("note: Mitsuba: {problem}; trying {SURE}, which is slower"),
                    );
                    with(SURE, &of_export)?
                }
                done => done?,
            }
        }
        _ => unreachable!("`--against` comes with its variance, and without it Mitsuba runs"),
    };
    if let Some(folder) = folder {
        let verdict = verdict::sentences(&outcome);
        let about = About { scene, other: &other, notes: &notes, warnings: &warnings, verdict: &verdict };
        report::write(folder, &about, &outcome)?;
    }
    Ok(Checked {
        scene: scene.display().to_string(),
        other,
        outcome,
        notes,
        report: folder.map(|folder| folder.display().to_string()),
        seconds: begin.elapsed().as_secs_f64(),
    })
}

impl Checked {
    fn json(&self) -> Value {
        let comparison = &self.outcome.comparison;
        let mut all: Vec<(&Finding, &Family)> = comparison
            .families
            .iter()
            .flat_map(|family| family.findings.iter().map(move |f| (f, family)))
            .collect();
        all.sort_by(|(a, x), (b, y)| {
            let clear = |p: f64, level: f64| p.max(f64::MIN_POSITIVE).ln() / level.ln();
            clear(b.p, y.level).total_cmp(&clear(a.p, x.level))
        });
        let worst: Vec<Value> = all
            .iter()
            .take(LISTED)
            .map(|(f, family)| {
                let channel = ["R", "G", "B"][f.channel];
                json!({
                    "parts": name(family.parts), "x": f.area.x, "y": f.area.y, "width": f.area.width, "height": f.area.height,
                    "channel": channel, "limpid": f.means[0], "other": f.means[1], "bias": f.bias(),
                    "p": f.p, "alarm": f.p < family.level,
                })
            })
            .collect();
        json!({
            "scene": self.scene,
            "agree": self.outcome.agrees(),
            "p": comparison.p,
            "mean_ratio": comparison.mean_ratio,
            "detectable_bias": self.outcome.detectable_bias(),
            "background": 1.0 - self.outcome.share,
            "blocks": comparison.blocks,
            "spp": self.outcome.spp,
            "verdict": Verdict::of(&self.outcome).class(),
            "spp_needed": self.outcome.spp_needed(),
            "left_out": comparison.left_out,
            "other": self.other,
            "families": comparison.families.iter().map(in_json).collect::<Vec<_>>(),
            "worst": worst,
            "notes": self.notes,
            "report": self.report,
            "seconds": self.seconds,
        })
    }
}

fn in_json(family: &Family) -> Value {
    let mut reaches: Vec<f64> =
        family.findings.iter().map(|f| f.detectable).filter(|r| r.is_finite()).collect();
    reaches.sort_by(f64::total_cmp);
    json!({
        "parts": name(family.parts),
        "tests": family.findings.len(),
        "p": family.p,
        "level": family.level,
        "alarms": family.findings.iter().filter(|finding| finding.p < family.level).count(),
        "detectable_bias": { "median": reaches.get(reaches.len() / 2), "worst": reaches.last() },
    })
}

fn name(parts: Parts) -> String {
    match parts {
        Parts::Whole => "whole".into(),
        Parts::Weighted => "weighted".into(),
        Parts::Sixteenths => "sixteenths".into(),
        Parts::Blocks(side) => format!("blocks-{side}"),
    }
}

/// What people see of a scene.
fn table(scene: &Path, folder: Option<&Path>, done: &Checked) -> String {
    let comparison = &done.outcome.comparison;
    let mut lines = vec![
        format!("{} beside {}", scene.display(), done.other),
        format!("  {:<18} {}", "answer", Verdict::of(&done.outcome).word().to_lowercase()),
        format!("  {:<18} {}", "limpid is", verdict::brightness(comparison.mean_ratio)),
        format!("  {:<18} {}", "would show from", verdict::percent(done.outcome.detectable_bias())),
        format!("  {:<18} {} (an alarm below 0.01)", "p", verdict::probability(comparison.p)),
        format!("  {:<18} {}", "samples per pixel", done.outcome.spp),
        format!("  {:<18} {} parts of the picture", "compared in", comparison.blocks),
    ];
    if done.outcome.share < 1.0 {
        let background = verdict::percent(1.0 - done.outcome.share);
        lines
            .push(format!("  {:<18} {background} of the light, which does not count as known", "background"));
    }
    if comparison.left_out > 0 {
        lines.push(format!("  {:<18} {} pixels", "left out", comparison.left_out));
    }
    if let Some(folder) = folder {
        lines.push(format!("  {:<18} {}", "report", folder.join("index.html").display()));
    }
    lines.join("\n")
}

/// The scene's row in the page of several.
fn row(done: &Checked, folder: &Path) -> Option<(String, String, Verdict, f64, f64, f64)> {
    let comparison = &done.outcome.comparison;
    let folder = folder.file_name()?.to_string_lossy().into_owned();
    let name = output::default_stem(Path::new(&done.scene)).display().to_string();
    let verdict = Verdict::of(&done.outcome);
    Some((name, folder, verdict, comparison.mean_ratio, done.outcome.detectable_bias(), comparison.p))
}
