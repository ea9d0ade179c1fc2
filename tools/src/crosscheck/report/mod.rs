//! The report of a comparison: a folder with pictures and a page that explains them.

mod maps;
mod page;

use std::fs;
use std::path::{Path, PathBuf};

use limpid_frame::compare::{Family, Parts};
use limpid_frame::{Frame, write_exr, write_png, write_whole};

use super::rounds::Outcome;
use crate::error::CliError;
use crate::output::{self, output_error};

pub use page::index;

/// The share of the pixels that may be white in a picture of the report.
const WHITE: f64 = 0.03;

/// What was compared, for the page.
pub struct About<'a> {
    /// The scene's file.
    pub scene: &'a Path,
    /// What our picture was compared with: `Mitsuba 3.9.1`, or a file.
    pub other: &'a str,
    /// What was changed for the comparison, and other things to know.
    pub notes: &'a [String],
    /// The reader's.
    pub warnings: &'a [String],
    /// The verdict in words.
    pub verdict: &'a str,
}

/// The folder of a scene's report; `None` where none is to be written. With several scenes each has its own, named
/// after it, and a number where names are alike.
pub fn folders(scenes: &[PathBuf], output: Option<&Path>, json: bool) -> Vec<Option<PathBuf>> {
    let mut taken: Vec<PathBuf> = Vec::new();
    scenes
        .iter()
        .map(|scene| {
            let stem = output::default_stem(scene);
            let wanted = match output {
                Some(output) if scenes.len() == 1 => return Some(output.to_owned()),
                Some(output) => output.join(&stem),
                None if json => return None,
                None => PathBuf::from(format!("{}-crosscheck", stem.display())),
            };
            let numbered = |n: usize| match n {
                1 => wanted.clone(),
                n => PathBuf::from(format!("{}-{n}", wanted.display())),
            };
            let free = (1..).map(numbered).find(|path| !taken.contains(path));
            taken.extend(free.clone());
            free
        })
        .collect()
}

/// Makes a folder where it is not there; whether it was not.
///
/// # Errors
///
/// Where it cannot be made.
pub fn make_folder(folder: &Path) -> Result<bool, CliError> {
    let is_new = !folder.is_dir();
    fs::create_dir_all(folder).map_err(|source| output_error(folder, source))?;
    Ok(is_new)
}

/// Writes pictures and page.
///
/// # Errors
///
/// Where one of the files cannot be written.
pub fn write(folder: &Path, about: &About, outcome: &Outcome) -> Result<(), CliError> {
    make_folder(folder)?;
    let [ours, theirs] = [maps::frame(&outcome.ours), maps::frame(&outcome.theirs)];
    let difference = maps::difference(&outcome.ours, &outcome.theirs);
    let size = outcome.ours.size();
    let blocks = finest(outcome);
    let p_values = maps::p_values(blocks, size);
    let ev = exposure(&theirs);
    let other = if about.other.starts_with("Mitsuba") { "mitsuba" } else { "reference" };
    for (name, frame) in
        [("limpid", &ours), (other, &theirs), ("difference", &difference), ("p-values", &p_values)]
    {
        write_exr(frame, &folder.join(format!("{name}.exr")))?;
    }
    let (difference, full) = maps::difference_colours(&difference);
    let mut pictures = Vec::new();
    let mut picture = |name: &str, planes: [&[f32]; 3], ev: f32| -> Result<(), CliError> {
        let path = folder.join(format!("{name}.png"));
        write_png(planes, size[0], size[1], ev, &path)?;
        pictures.push(fs::read(&path).map_err(|source| output_error(&path, source))?);
        Ok(())
    };
    picture("limpid", ours.rgb()?, ev)?;
    picture(other, theirs.rgb()?, ev)?;
    picture("difference", difference.each_ref().map(Vec::as_slice), 0.0)?;
    picture("p-values", maps::p_colours(blocks, size).each_ref().map(Vec::as_slice), 0.0)?;
    let page = page::page(about, outcome, &page::Shown { pictures, ev, full, blocks });
    let path = folder.join("index.html");
    write_whole(&path, |file| std::io::Write::write_all(file, page.as_bytes()))?;
    Ok(())
}

/// The family of the smallest blocks that were tested.
fn finest(outcome: &Outcome) -> &Family {
    let families = &outcome.comparison.families;
    families
        .iter()
        .rfind(|family| family.parts != Parts::Weighted)
        .expect("the whole picture is always tested")
}

/// Stops that bring the brightest but a few pixels to white, in tenths.
fn exposure(frame: &Frame) -> f32 {
    let planes = frame.rgb().expect("has its channels");
    let brightest = |p: usize| planes.iter().map(|plane| plane[p]).fold(0.0, f32::max);
    let mut values: Vec<f32> = (0..frame.len()).map(brightest).filter(|v| v.is_finite()).collect();
    values.sort_by(f32::total_cmp);
    let white = values.get((values.len() as f64 * (1.0 - WHITE)) as usize).copied().unwrap_or(1.0);
    let ev = if white > 0.0 { -white.log2() } else { 0.0 };
    ((10.0 * ev).round() / 10.0).clamp(-64.0, 64.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reports_have_folders_of_their_own_and_json_none_unless_asked() {
        let scenes = ["a/kitchen.xml", "b/kitchen.xml", "hall.xml"].map(PathBuf::from);
        let of = |scenes: &[PathBuf], output: Option<&str>, json| {
            folders(scenes, output.map(Path::new), json)
                .into_iter()
                .map(|f| f.map(|f| f.display().to_string()))
                .collect()
        };
        let all: Vec<Option<String>> = of(&scenes, Some("out"), true);
        assert_eq!(all, ["out/kitchen", "out/kitchen-2", "out/hall"].map(|s| Some(s.to_owned())));
        let all: Vec<Option<String>> = of(&scenes[..1], None, false);
        assert_eq!(all, [Some("kitchen-crosscheck".to_owned())]);
        let all: Vec<Option<String>> = of(&scenes[..1], None, true);
        assert_eq!(all, [None]);
        let all: Vec<Option<String>> = of(&scenes[..1], Some("here"), false);
        assert_eq!(all, [Some("here".to_owned())]);
    }
}
