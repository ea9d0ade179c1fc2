//! Contact sheets for the docs: what limpid shows, beside what Mitsuba shows, as one SVG.
//!
//! ```sh
//! cargo run --release -p limpid-tests --example sheet -- materials docs/pictures/materials.svg
//! cargo run --release -p limpid-tests --example sheet -- scenes docs/pictures/models.svg MODEL.glb…
//! ```
//!
//! Where Mitsuba cannot be had, or refuses a scene, limpid's picture stands alone. Build the program first.

use std::path::{Path, PathBuf};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use image::codecs::jpeg::JpegEncoder;
use limpid_frame::{FrameError, read_exr, write_png};
use limpid_tests::start::call;
use limpid_tests::table;

/// Side of a picture in pixels, samples of each pixel, and pairs in a row.
const SIDE: u32 = 144;
const SPP: u32 = 256;
const COLUMNS: usize = 4;
/// Of the JPEGs, of 100.
const QUALITY: u8 = 75;
/// Height of the words under a pair, and the way between pairs.
const WORDS: u32 = 18;
const GAP: u32 = 12;

/// A pair of JPEGs under one name; the second may be missing.
struct Pair {
    name: String,
    ours: Vec<u8>,
    theirs: Option<Vec<u8>>,
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let work = tempfile::tempdir().expect("a temporary folder");
    let (scenes, out) = match words[..] {
        ["materials", out] => {
            let rows = table::write_previews(work.path()).expect("writes");
            (rows.into_iter().map(|(row, path)| (row.name, path)).collect(), out)
        }
        ["scenes", out, ref files @ ..] if !files.is_empty() => {
            let here = std::env::current_dir().expect("there is a folder");
            let named = files.iter().map(|file| (name(Path::new(file)), here.join(file)));
            (named.collect::<Vec<_>>(), out)
        }
        _ => {
            eprintln!("sheet materials OUT.svg | sheet scenes OUT.svg SCENE…");
            std::process::exit(2);
        }
    };
    let mut pairs = Vec::new();
    for (name, scene) in scenes {
        match pair(&name, &scene, work.path()) {
            Ok(pair) => pairs.push(pair),
            Err(problem) => eprintln!("{name}: {problem}"),
        }
    }
    std::fs::write(out, svg(&pairs)).unwrap_or_else(|e| panic!("{out}: {e}"));
    println!("{out}: {} pairs", pairs.len());
}

/// `Box.gltf` of `a/Box/Box.gltf`.
fn name(file: &Path) -> String {
    file.file_name().unwrap_or(file.as_os_str()).to_string_lossy().into_owned()
}

/// limpid's picture of a scene and, where there is one, Mitsuba's, both at the scene's own brightness.
fn pair(name: &str, scene: &Path, work: &Path) -> Result<Pair, String> {
    let report = work.join("report");
    let (size, spp) = (format!("{SIDE}x{SIDE}"), SPP.to_string());
    let words = ["--size", &size, "--spp", &spp, "--quiet"].map(PathBuf::from);
    let with = |command: &str, out: &[&Path]| {
        let command = [PathBuf::from(command), scene.to_owned()];
        call(work, command.iter().chain(&words).map(PathBuf::as_path).chain(out.iter().copied()))
    };
    // Not the report's: there glTF has Mitsuba's materials on both sides.
    let frame = work.join("ours.exr");
    let rendered = with("render", &[Path::new("-o"), &frame]);
    if rendered.code != 0 {
        return Err(rendered.stderr);
    }
    let shown = |frame: &Path| {
        let png = work.join("shown.png");
        let said = |e: FrameError| e.to_string();
        let frame = read_exr(frame).map_err(said)?;
        let rgb = frame.rgb().map_err(said)?;
        write_png(rgb, frame.width(), frame.height(), 0.0, &png).map_err(said)?;
        smaller(&png)
    };
    let checked = with("crosscheck", &[Path::new("-o"), &report]);
    let theirs = match checked.code {
        0 | 1 => Some(shown(&report.join("mitsuba.exr"))?),
        _ => {
            eprintln!("{name}: {}", checked.stderr.trim());
            None
        }
    };
    Ok(Pair { name: name.into(), ours: shown(&frame)?, theirs })
}

/// A picture as JPEG: noise makes large PNGs.
fn smaller(png: &Path) -> Result<Vec<u8>, String> {
    let said = |e: image::ImageError| e.to_string();
    let picture = image::open(png).map_err(said)?.into_rgb8();
    let mut bytes = Vec::new();
    JpegEncoder::new_with_quality(&mut bytes, QUALITY).encode_image(&picture).map_err(said)?;
    Ok(bytes)
}

fn svg(pairs: &[Pair]) -> String {
    let [wide, high] = [2 * SIDE + GAP, SIDE + WORDS + GAP];
    let columns = COLUMNS.min(pairs.len()).max(1);
    let rows = pairs.len().div_ceil(columns);
    let [width, height] = [wide * columns as u32 + GAP, high * rows as u32 + GAP];
    let mut svg = format!(
        r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" font-family="sans-serif" font-size="12">
<rect width="100%" height="100%" fill="#fff"/>
"##
    );
    for (i, pair) in pairs.iter().enumerate() {
        let [x, y] = [GAP + wide * (i % columns) as u32, GAP + high * (i / columns) as u32];
        for (k, picture) in [Some(&pair.ours), pair.theirs.as_ref()].into_iter().enumerate() {
            let Some(picture) = picture else { continue };
            let data = STANDARD.encode(picture);
            let x = x + SIDE * k as u32;
            svg += &format!(
                r#"<image x="{x}" y="{y}" width="{SIDE}" height="{SIDE}" href="data:image/jpeg;base64,{data}"/>"#
            );
            svg.push('\n');
        }
        let name = pair.name.replace('&', "&amp;").replace('<', "&lt;");
        svg += &format!("<text x=\"{x}\" y=\"{}\" fill=\"#222\">{name}</text>\n", y + SIDE + 14);
    }
    svg + "</svg>\n"
}
