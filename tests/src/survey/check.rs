//! The checks of a row.

use std::cell::RefCell;
use std::collections::HashMap;
use std::fs;
use std::path::Path;

use limpid_frame::Frame;
use limpid_scenes::{LoadOptions, Scene, SceneError, Shape, load};

use super::{Construct, Means, Names, Parameter, Plugin, files, staged};
use crate::rendered;

/// A folder with the files that rows name, and the rows read so far.
pub struct Kit {
    folder: tempfile::TempDir,
    pictures: RefCell<HashMap<String, Frame>>,
}

impl Kit {
    /// Writes the files.
    ///
    /// # Panics
    ///
    /// If the system gives no folder.
    pub fn new() -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        files::write(folder.path()).expect("writes");
        Self { folder, pictures: RefCell::default() }
    }

    fn read(&self, text: &str, defines: &[(&str, &str)]) -> Result<Scene, SceneError> {
        let path = self.folder.path().join("scene.xml");
        fs::write(&path, text).expect("writes");
        let defines = defines.iter().map(|(name, value)| (name.to_string(), value.to_string())).collect();
        load(&path, &LoadOptions { defines, strict: false })
    }

    /// The picture of a scene at a few samples, which must be finite in all channels.
    fn picture(&self, scene: &Scene) -> Result<Frame, String> {
        let key = plain(scene);
        if let Some(known) = self.pictures.borrow().get(&key) {
            return Ok(known.clone());
        }
        let seen = rendered(scene, |s| {
            let large = s.width * s.height > 4096; // a film of the default size
            s.spp = if large { 1 } else { s.spp.min(8) };
            s.max_depth = Some(s.max_depth.unwrap_or(12).min(12));
        });
        let finite = seen.frame.channels().all(|(_, plane)| plane.iter().all(|v| v.is_finite()));
        ensure(finite && seen.rejected == 0, || "samples that are no number".into())?;
        self.pictures.borrow_mut().insert(key, seen.frame.clone());
        Ok(seen.frame)
    }
}

impl Default for Kit {
    fn default() -> Self {
        Self::new()
    }
}

/// Checks a plugin by itself and with each of its parameters; gives the number of rows, and adds to `failures` what is
/// not as it should be.
pub fn check_plugin(kit: &Kit, plugin: &Plugin, failures: &mut Vec<String>) -> usize {
    let Plugin { frame, tag, kind, given, means, warned, names, parameters } = *plugin;
    let attribute = if tag == "texture" { r#" name="reflectance""# } else { "" };
    let text = |inside: &str| {
        frame.replace("{}", &format!("<{tag} type=\"{kind}\"{attribute}>{given}{inside}</{tag}>"))
    };
    let itself = Parameter { xml: "", means, warned, names };
    let mut note = |row: &Parameter, result: Result<(), String>| {
        if let Err(problem) = result {
            failures.push(format!("{tag} \"{kind}\" {}: {problem}", row.xml));
        }
    };
    note(&itself, check(kit, &itself, &text(""), &|plain| frame.replace("{}", plain)));
    for parameter in parameters {
        let row =
            Parameter { names: if names == Names::Both { parameter.names } else { names }, ..*parameter };
        note(&row, check(kit, &row, &text(row.xml), &text));
    }
    1 + parameters.len()
}

/// Checks `with`, the text that holds the row; `in_place` is the text with something else in its place, or nothing.
fn check(kit: &Kit, row: &Parameter, with: &str, in_place: &dyn Fn(&str) -> String) -> Result<(), String> {
    for (generation, other) in [("3.0.0", Names::Old), ("0.6.0", Names::New)] {
        if row.names == other {
            continue;
        }
        let read = |text: &str| {
            let text = staged(text);
            let text = if other == Names::New { old_names(&text) } else { text };
            kit.read(&format!("<scene version=\"{generation}\">{text}</scene>"), &[])
        };
        check_version(kit, row, &|text| read(text), with, in_place)
            .map_err(|problem| format!("{problem} (version {generation})"))?;
    }
    Ok(())
}

fn check_version(
    kit: &Kit,
    row: &Parameter,
    read: &dyn Fn(&str) -> Result<Scene, SceneError>,
    with: &str,
    in_place: &dyn Fn(&str) -> String,
) -> Result<(), String> {
    if let Means::Refused(words) = row.means {
        return check_error(read(with), &[words]);
    }
    let said = |error: SceneError| error.to_string();
    let (scene, base) = (read(with).map_err(said)?, read(&in_place("")).map_err(said)?);
    let warned = if row.warned.is_empty() { &[] } else { std::slice::from_ref(&row.warned) };
    if row.warned != "*" {
        check_warnings(&scene, &base, warned)?;
    }
    let picture = kit.picture(&scene)?;
    ensure(is_lit(&picture), || "black".into())?;
    match row.means {
        Means::Shows(words) | Means::Keeps(words) => {
            let shown = plain(&scene);
            ensure(shown.contains(words), || {
                format!("no `{words}` where it shows {}", difference(&shown, &plain(&base)))
            })?;
            ensure(!plain(&base).contains(words), || format!("`{words}` also without it"))?;
            let changes = !same_picture(&picture, &kit.picture(&base)?);
            let wanted = matches!(row.means, Means::Shows(_));
            ensure(changes == wanted, || {
                format!("the picture {} change", if changes { "does" } else { "does not" })
            })
        }
        Means::Changes => {
            ensure(!is_same(&scene, &base), || "the scene is the same without it".into())?;
            ensure(!same_picture(&picture, &kit.picture(&base)?), || "the picture does not change".into())
        }
        Means::Is(other) => {
            same_scene(&scene, &read(&in_place(other)).map_err(said)?)?;
            ensure(!is_same(&scene, &base), || "the scene is the same without it".into())
        }
        Means::Nothing => same_scene(&scene, &base),
        Means::Refused(_) => unreachable!("handled above"),
    }
}

/// Checks a construct of the language.
///
/// # Errors
///
/// What is not as it should be.
pub fn check_construct(kit: &Kit, row: &Construct) -> Result<(), String> {
    for (name, text) in row.files {
        let path = kit.folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap_or(Path::new("."))).expect("makes a folder");
        fs::write(path, text).expect("writes");
    }
    let read = |text: &str, defines| {
        let text = staged(text);
        let whole = if text.starts_with("<scene") {
            text
        } else {
            format!("<scene version=\"3.0.0\">{text}</scene>")
        };
        kit.read(&whole, defines)
    };
    if row.plain.is_empty() {
        return check_error(read(row.xml, row.defines), row.warned);
    }
    let said = |error: SceneError| error.to_string();
    let (scene, other) = (read(row.xml, row.defines).map_err(said)?, read(row.plain, &[]).map_err(said)?);
    check_warnings(&scene, &other, row.warned)?;
    same_scene(&scene, &other)?;
    ensure(is_lit(&kit.picture(&scene)?), || "black".into())
}

/// An error with these words, which says where, and about what.
fn check_error(read: Result<Scene, SceneError>, words: &[&str]) -> Result<(), String> {
    let Err(error) = read else { return Err("it is read".into()) };
    ensure(words.iter().all(|words| error.to_string().contains(words)), || {
        format!("no {words:?} in {error}")
    })?;
    ensure(!error.element.is_empty() && !error.help.is_empty(), || format!("no element or help in {error}"))?;
    // meshes without lines give their bytes
    ensure(error.line > 0 || error.file.extension().is_some_and(|e| e != "xml"), || {
        format!("no line in {error}")
    })
}

/// Each warning that `base` has not must hold the words that are its turn.
fn check_warnings(scene: &Scene, base: &Scene, words: &[&str]) -> Result<(), String> {
    let known: Vec<&str> = base.warnings.iter().map(|w| w.message.as_str()).collect();
    let new: Vec<_> = scene.warnings.iter().filter(|w| !known.contains(&w.message.as_str())).collect();
    let mut distinct: Vec<&str> = Vec::new();
    for message in new.iter().map(|w| w.message.as_str()) {
        if !distinct.contains(&message) {
            distinct.push(message); // the frame may hold the row twice
        }
    }
    let fits = distinct.len() == words.len() && distinct.iter().zip(words).all(|(m, w)| m.contains(w));
    ensure(fits, || format!("the warnings {distinct:?} where {words:?} belong"))?;
    ensure(new.iter().all(|w| w.place.line > 0 && !w.element.is_empty()), || {
        "a warning without a place".into()
    })
}

fn ensure(holds: bool, problem: impl Fn() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(problem()) }
}

/// That two scenes differ in nothing but names, places and the rounding of numbers.
fn same_scene(a: &Scene, b: &Scene) -> Result<(), String> {
    ensure(is_same(a, b), || {
        let (a, b) = (plain(a), plain(b));
        format!("the scene shows {} where {} belongs", difference(&a, &b), difference(&b, &a))
    })
}

/// The part of `a` where it begins to differ from `b`.
fn difference(a: &str, b: &str) -> String {
    let same = a.chars().zip(b.chars()).take_while(|(a, b)| a == b).count();
    format!("`…{}…`", a.chars().skip(same.saturating_sub(80)).take(300).collect::<String>())
}

fn is_same(a: &Scene, b: &Scene) -> bool {
    let separators = [' ', ',', '(', ')', '[', ']', '{', '}'];
    let words = |text: String| -> Vec<String> {
        text.split(separators).filter(|word| !word.is_empty()).map(String::from).collect()
    };
    let (a, b) = (words(plain(a)), words(plain(b)));
    let near = |a: &str, b: &str| match (a.parse::<f64>(), b.parse::<f64>()) {
        (Ok(x), Ok(y)) => (x - y).abs() <= 1e-6 * x.abs().max(y.abs()).max(1.0), // numbers here are about 1
        _ => false,
    };
    a.len() == b.len() && a.iter().zip(&b).all(|(a, b)| a == b || near(a, b))
}

/// A scene as text, without what says where it came from.
fn plain(scene: &Scene) -> String {
    let mut scene = scene.clone();
    (scene.file, scene.content_hash) = Default::default();
    scene.warnings.clear();
    let bare = |shape: &mut Shape| {
        (shape.name, shape.place) = Default::default();
        if let Some(emission) = &mut shape.emission {
            (emission.name, emission.place) = Default::default();
        }
    };
    scene.shapes.iter_mut().for_each(bare);
    for group in &mut scene.groups {
        (group.name, group.place) = Default::default();
        group.shapes.iter_mut().for_each(bare);
    }
    scene.cameras.iter_mut().for_each(|c| (c.name, c.place) = Default::default());
    scene.materials.iter_mut().for_each(|m| (m.name, m.place) = Default::default());
    scene.textures.iter_mut().for_each(|t| (t.name, t.place) = Default::default());
    scene.lights.iter_mut().for_each(|l| (l.name, l.place) = Default::default());
    format!("{scene:?}")
}

fn is_lit(frame: &Frame) -> bool {
    ["R", "G", "B"].iter().filter_map(|name| frame.channel(name)).flatten().any(|&v| v > 0.0)
}

fn same_picture(a: &Frame, b: &Frame) -> bool {
    let size = |f: &Frame| (f.width(), f.height());
    size(a) == size(b) && a.channels().eq(b.channels())
}

/// A text in the spelling of 0.x: `name="to_world"` becomes `name="toWorld"`, `int_ior` becomes `intIOR`.
fn old_names(text: &str) -> String {
    let mut parts = text.split("name=\"");
    let mut old = String::from(parts.next().unwrap_or_default());
    for part in parts {
        let (name, rest) = part.split_once('"').unwrap_or((part, ""));
        let mut words = name.split('_');
        let mut camel = String::from(words.next().unwrap_or_default());
        for word in words {
            if word == "ior" {
                camel += "IOR";
            } else {
                let mut letters = word.chars();
                camel.extend(letters.next().into_iter().flat_map(char::to_uppercase));
                camel += letters.as_str();
            }
        }
        old += &format!("name=\"{camel}\"{rest}");
    }
    old
}
