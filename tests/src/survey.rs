//! Everything that a survey of 406 people's Mitsuba scenes found in them, media and volumes apart: a small scene for each
//! construct of the language, each plugin and each of their parameters, with what it must come to.
//!
//! A row says what the scene then holds; the check is that it does, that it does not without the row's text, and that the
//! picture changes where it should and nowhere else. Rows are read in both naming generations, `to_world` and `toWorld`,
//! unless they belong to one.

mod bsdfs;
mod cameras;
mod check;
mod files;
mod integrators;
mod language;
mod lights;
mod models;
mod shapes;
mod textures;

pub use check::{Kit, check_construct, check_plugin};
pub use language::CONSTRUCTS;

/// What a row must come to.
#[derive(Clone, Copy, Debug)]
pub enum Means {
    /// The scene, printed, holds these words, and only with the row's text; the picture changes.
    Shows(&'static str),
    /// As [`Shows`](Self::Shows), but the picture stays: what is said about sampling or files is known, not obeyed.
    Keeps(&'static str),
    /// Scene and picture are others than without.
    Changes,
    /// The scene is that of this text in place of the row's, and another than without either.
    Is(&'static str),
    /// The scene is the same as without.
    Nothing,
    /// An error with these words, which names line and element.
    Refused(&'static str),
}

/// The naming generations that a row belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Names {
    /// The scene is the same in both.
    Both,
    /// Version 2 and later.
    New,
    /// Version 0.x; the text is in version-3 spelling and is translated.
    Old,
}

/// A parameter of a plugin.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// Its element.
    pub xml: &'static str,
    /// What it must come to.
    pub means: Means,
    /// Words of the one warning that it makes; empty: it makes none; `*`: whatever.
    pub warned: &'static str,
    /// Where it belongs.
    pub names: Names,
}

/// A plugin with all parameters that were seen.
#[derive(Clone, Copy, Debug)]
pub struct Plugin {
    /// The elements around it, as [`staged`] takes them; it stands at `{}`.
    pub frame: &'static str,
    /// `bsdf`.
    pub tag: &'static str,
    /// Its `type`.
    pub kind: &'static str,
    /// What stands in it whatever the row: parameters that it cannot do without.
    pub given: &'static str,
    /// What it must come to by itself.
    pub means: Means,
    /// Words of the one warning that it makes by itself; likewise.
    pub warned: &'static str,
    /// Where it belongs.
    pub names: Names,
    /// One row each.
    pub parameters: &'static [Parameter],
}

/// A construct of the language, with other text for the same scene.
#[derive(Clone, Copy, Debug)]
pub struct Construct {
    /// What it shows.
    pub name: &'static str,
    /// The whole file, as [`staged`] takes it; a version is put before it unless it begins with `<scene`.
    pub xml: &'static str,
    /// The same in plain words; empty: the construct is refused, with the words of `warned`.
    pub plain: &'static str,
    /// Words of each warning beyond those of the plain text.
    pub warned: &'static [&'static str],
    /// Files beside it.
    pub files: &'static [(&'static str, &'static str)],
    /// `-D name=value`.
    pub defines: &'static [(&'static str, &'static str)],
}

impl Parameter {
    const fn new(xml: &'static str, means: Means) -> Self {
        Self { xml, means, warned: "", names: Names::Both }
    }

    const fn warned(self, words: &'static str) -> Self {
        Self { warned: words, ..self }
    }

    const fn only(self, names: Names) -> Self {
        Self { names, ..self }
    }
}

/// The element `xml` is a parameter of the scene, which shows these words then.
const fn sets(xml: &'static str, words: &'static str) -> Parameter {
    Parameter::new(xml, Means::Shows(words))
}

/// The element `xml` changes the scene and the picture, by numbers that other tests know.
const fn changes(xml: &'static str) -> Parameter {
    Parameter::new(xml, Means::Changes)
}

/// The element `xml` says what `plain` does.
const fn is(xml: &'static str, plain: &'static str) -> Parameter {
    Parameter::new(xml, Means::Is(plain))
}

/// The element `xml` changes nothing.
const fn idle(xml: &'static str) -> Parameter {
    Parameter::new(xml, Means::Nothing)
}

impl Plugin {
    const fn new(
        frame: &'static str,
        tag: &'static str,
        kind: &'static str,
        means: Means,
        parameters: &'static [Parameter],
    ) -> Self {
        Self { frame, tag, kind, given: "", means, warned: "", names: Names::Both, parameters }
    }

    const fn given(self, given: &'static str) -> Self {
        Self { given, ..self }
    }

    const fn warned(self, words: &'static str) -> Self {
        Self { warned: words, ..self }
    }

    const fn only(self, names: Names) -> Self {
        Self { names, ..self }
    }
}

/// All plugins of the survey.
pub fn plugins() -> impl Iterator<Item = &'static Plugin> {
    let lists = [
        integrators::INTEGRATORS,
        cameras::CAMERAS,
        shapes::SHAPES,
        bsdfs::BSDFS,
        models::MODELS,
        textures::TEXTURES,
        lights::LIGHTS,
    ];
    lists.into_iter().flatten()
}

/// What frames name with an `@`, in words.
const STAGE: [(&str, &str); 4] = [
    (
        "@eye",
        r#"<sensor type="perspective"><float name="fov" value="40"/><transform name="to_world"><lookat origin="0.5 -5 3" target="0.3 0 0.6" up="0 0 1"/></transform>@film</sensor>"#,
    ),
    (
        "@film",
        r#"<film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="12"/><rfilter type="box"/></film>"#,
    ),
    (
        "@things",
        r#"<shape type="rectangle"><transform name="to_world"><scale value="3"/></transform><bsdf type="twosided"><bsdf type="diffuse"/></bsdf></shape>
<shape type="sphere"><float name="radius" value="0.7"/><point name="center" x="0" y="0" z="0.75"/><bsdf type="roughplastic"/></shape>"#,
    ),
    (
        "@light",
        r#"<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="180"/><translate x="-1" y="-1" z="2.5"/></transform><emitter type="area"><rgb name="radiance" value="9 8 7"/></emitter></shape>
<emitter type="constant"><rgb name="radiance" value="0.2 0.25 0.3"/></emitter>"#,
    ),
];

/// A text with all that is named by an `@` written out.
pub fn staged(text: &str) -> String {
    STAGE.iter().fold(text.to_owned(), |text, (name, words)| text.replace(name, words))
}
