//! XML text as a flat list of elements: includes spliced in, parameters expanded, names in version-3 spelling.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::parameters::{Parameters, snake_case};
use super::value::shorten;
use super::{guard, text};
use crate::files::{Files, identity};
use crate::{LoadOptions, Place, SceneError, Warning};

/// Index of an [`Element`] in its [`Document`], in the order of the text with all includes in their places.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct ElementId(pub usize);

/// An element with everything that its text says.
#[derive(Debug)]
pub(super) struct Element {
    pub id: ElementId,
    pub tag: String,
    attributes: Vec<Attribute>,
    pub children: Vec<ElementId>,
    /// Of its `<`.
    pub place: Place,
    /// The name of the parameter, in version-3 spelling; empty where it has none.
    pub key: String,
    /// From a file of Mitsuba 0.x, where some defaults differ.
    pub is_old: bool,
}

/// An attribute, its parameters expanded.
#[derive(Debug)]
pub(super) struct Attribute {
    pub name: String,
    pub value: String,
    /// Of its value.
    line: u32,
    column: u32,
}

impl Element {
    /// The value of an attribute.
    pub fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|a| a.name == name).map(|a| a.value.as_str())
    }

    /// Where the value of an attribute stands, or the element where it has none.
    pub fn place_of(&self, name: &str) -> Place {
        let attribute = self.attributes.iter().find(|a| a.name == name);
        attribute.map_or_else(
            || self.place.clone(),
            |a| Place { line: a.line, column: a.column, ..self.place.clone() },
        )
    }

    /// What the user would search for: `bsdf "floor"`, `float "radius"`, or its type where it has no name.
    pub fn label(&self) -> String {
        let name = self.attribute("id").or(self.attribute("name")).or(self.attribute("type"));
        name.map_or_else(
            || shorten(&self.tag),
            |name| format!("{} \"{}\"", shorten(&self.tag), shorten(name)),
        )
    }
}

/// All elements of a scene file and the files that it includes.
#[derive(Debug, Default)]
pub(super) struct Document {
    pub elements: Vec<Element>,
    /// The elements of the scene itself.
    pub top: Vec<ElementId>,
    ids: HashMap<String, ElementId>,
    aliases: HashMap<String, String>,
    pub warnings: Vec<(ElementId, Warning)>,
}

impl Document {
    /// Parses a text and what it includes. `file` is what places and relative names refer to.
    pub fn parse(
        text: &str,
        file: &Path,
        files: &mut Files,
        options: &LoadOptions,
    ) -> Result<Self, SceneError> {
        let mut builder = Builder {
            document: Self::default(),
            files,
            parameters: Parameters::new(&options.defines),
            including: Vec::new(),
            budget: Budget { files: 0, bytes: MAX_INCLUDED },
        };
        let top = builder.file(text, file, None)?;
        let Builder { mut document, parameters, .. } = builder;
        document.top = top;
        for name in parameters.unused_defines() {
            let place = Place { file: Arc::new(file.into()), line: 1, column: 1 };
            let message = format!("the file does not use the parameter \"{name}\"");
            let warning = Warning { place, element: format!("-D {name}"), message, unused_parameter: true };
            document.warnings.push((ElementId(0), warning));
        }
        Ok(document)
    }

    pub fn element(&self, id: ElementId) -> &Element {
        &self.elements[id.0]
    }

    /// The element that carries an id.
    pub fn by_id(&self, id: &str) -> Option<ElementId> {
        let mut id = id;
        // an alias of an alias of an alias: a long chain would cost its length for each reference, a circle would not end
        for _ in 0..MAX_ALIASES {
            match self.aliases.get(id) {
                Some(original) => id = original,
                None => break,
            }
        }
        self.ids.get(id).copied()
    }

    /// The ids and aliases of the document, for messages: the first ten thousand, in its order.
    pub fn ids(&self) -> impl Iterator<Item = &str> {
        let elements = self.elements.iter().filter(|element| element.tag != "ref");
        let mut aliases: Vec<_> = self.aliases.keys().map(String::as_str).collect();
        aliases.sort();
        aliases.into_iter().chain(elements.filter_map(|element| element.attribute("id"))).take(10_000)
    }
}

/// How often an alias may stand for another alias.
const MAX_ALIASES: usize = 16;
/// Bytes of an id: it is repeated in names and messages.
const MAX_ID: usize = 1024;
/// How often files may be included in all, and how deep.
const MAX_INCLUDES: usize = 4096;
const MAX_INCLUDE_DEPTH: usize = 16;
/// Bytes of included text. A file counts each time: includes of includes could multiply it without end.
const MAX_INCLUDED: usize = 256 << 20;

struct Budget {
    files: usize,
    bytes: usize,
}

struct Builder<'a> {
    document: Document,
    files: &'a mut Files,
    parameters: Parameters,
    /// The files that are being read, outermost first.
    including: Vec<PathBuf>,
    budget: Budget,
}

/// What the elements of one file have in common.
struct Source<'t> {
    file: Arc<PathBuf>,
    xml: &'t str,
    cursor: text::Cursor<'t>,
    is_old: bool,
}

impl Source<'_> {
    fn place(&mut self, byte: usize) -> Place {
        let (line, column) = self.cursor.line_column(byte);
        Place { file: Arc::clone(&self.file), line, column }
    }
}

impl Builder<'_> {
    /// Reads one file; gives what it contributes to the place where it is included.
    fn file(
        &mut self,
        xml: &str,
        file: &Path,
        parent_is_old: Option<bool>,
    ) -> Result<Vec<ElementId>, SceneError> {
        let mut source = Source {
            file: Arc::new(file.into()),
            xml,
            cursor: text::Cursor::new(xml),
            is_old: parent_is_old.unwrap_or(false),
        };
        guard::check(xml).map_err(|(byte, problem)| {
            let help = "no scene needs this; was the file written by a faulty program?";
            SceneError::at(&source.place(byte), "XML", problem, help)
        })?;
        let parsed = roxmltree::Document::parse(xml).map_err(|error| text::xml_error(file, xml, &error))?;
        let root = parsed.root_element();
        let is_scene = root.has_tag_name("scene");
        if !is_scene && parent_is_old.is_none() {
            let problem = format!("the outermost element is <{}>", root.tag_name().name());
            let place = source.place(root.range().start);
            return Err(SceneError::at(
                &place,
                root.tag_name().name(),
                problem,
                "a scene begins with <scene version=\"3.0.0\">",
            ));
        }
        match root.attribute("version") {
            Some(version) => {
                let major = version.trim().split('.').next().and_then(|major| major.parse::<u32>().ok());
                let Some(major) = major else {
                    let place = source.place(root.range().start);
                    let problem = format!("version \"{version}\" is none");
                    return Err(SceneError::at(
                        &place,
                        "scene",
                        problem,
                        "write a version like 3.0.0 or 0.6.0",
                    ));
                };
                source.is_old = major < 2;
            }
            None if parent_is_old.is_none() => {
                let place = source.place(root.range().start);
                let message = "no version; read as 3.0.0".into();
                let warning = Warning { place, element: "scene".into(), message, unused_parameter: false };
                self.document.warnings.push((ElementId(0), warning));
            }
            None => {}
        }
        self.including.push(identity(file));
        let elements =
            if is_scene { self.children(root, &mut source)? } else { self.element(root, &mut source)? };
        self.including.pop();
        Ok(elements)
    }

    fn children(
        &mut self,
        parent: roxmltree::Node<'_, '_>,
        source: &mut Source<'_>,
    ) -> Result<Vec<ElementId>, SceneError> {
        let mut children = Vec::new();
        for node in parent.children() {
            if node.is_element() {
                children.extend(self.element(node, source)?);
            } else if node.is_text()
                && let Some(stray) = source.xml.get(node.range())
                && let Some(start) = stray.find(|c: char| !c.is_whitespace())
            {
                let place = source.place(node.range().start + start);
                let words = shorten(stray.trim());
                let message =
                    format!("the text \"{words}\" between elements means nothing and is passed over");
                let element = parent.tag_name().name().into();
                let id = ElementId(self.document.elements.len());
                self.document
                    .warnings
                    .push((id, Warning { place, element, message, unused_parameter: false }));
            }
        }
        Ok(children)
    }

    /// Takes in one element; none comes of those that only tell how to read others.
    fn element(
        &mut self,
        node: roxmltree::Node<'_, '_>,
        source: &mut Source<'_>,
    ) -> Result<Vec<ElementId>, SceneError> {
        let tag = node.tag_name().name();
        let place = source.place(node.range().start);
        let mut element = Element {
            id: ElementId(self.document.elements.len()),
            tag: tag.into(),
            attributes: Vec::new(),
            children: Vec::new(),
            place,
            key: String::new(),
            is_old: source.is_old,
        };
        for attribute in node.attributes() {
            let Place { line, column, .. } = source.place(attribute.range_value().start);
            let place = Place { line, column, ..element.place.clone() };
            let value = self.parameters.expand(attribute.value()).map_err(|unexpandable| {
                let label = format!("{tag} attribute \"{}\"", attribute.name());
                SceneError::at(&place, &label, unexpandable.problem, unexpandable.help)
            })?;
            element.attributes.push(Attribute { name: attribute.name().into(), value, line, column });
        }
        match tag {
            "default" => {
                let (name, value) = (required(&element, "name")?, required(&element, "value")?);
                self.parameters.default(name, value);
                Ok(Vec::new())
            }
            "path" => {
                self.path(&element)?;
                Ok(Vec::new())
            }
            "alias" => {
                let (id, name) = (required(&element, "id")?, required(&element, "as")?);
                self.check_unused_id(name, &element)?;
                self.document.aliases.insert(name.into(), id.into());
                Ok(Vec::new())
            }
            "include" => self.include(&element),
            _ => {
                if let Some(name) = element.attribute("name") {
                    element.key = if source.is_old { snake_case(name) } else { name.into() };
                }
                let id = element.id;
                if let Some(name) = element.attribute("id").filter(|_| tag != "ref").map(String::from) {
                    if name.len() > MAX_ID {
                        let problem = format!("an id of {} bytes", name.len());
                        let help = format!("use at most {MAX_ID} bytes");
                        return Err(SceneError::at(&element.place, &element.label(), problem, help));
                    }
                    self.check_unused_id(&name, &element)?;
                    self.document.ids.insert(name, id);
                }
                self.document.elements.push(element);
                let children = self.children(node, source)?;
                self.document.elements[id.0].children = children;
                Ok(vec![id])
            }
        }
    }

    fn check_unused_id(&self, id: &str, element: &Element) -> Result<(), SceneError> {
        let earlier = match self.document.ids.get(id) {
            Some(earlier) => self.document.element(*earlier).place.line.to_string(),
            None if self.document.aliases.contains_key(id) => "an <alias>".into(),
            None => return Ok(()),
        };
        let problem = format!("the id \"{id}\" is taken (line {earlier})");
        Err(SceneError::at(&element.place, &element.label(), problem, "give each object an id of its own"))
    }

    /// `<path value="folder"/>`: names are looked for in the folder from here on.
    fn path(&mut self, element: &Element) -> Result<(), SceneError> {
        let folder = required(element, "value")?;
        match self.files.find(folder, &element.place.file) {
            Some(found) => self.files.folders.insert(0, found.path),
            None => {
                let message = format!("the folder \"{folder}\" is not there; names are not looked for in it");
                let warning = Warning {
                    place: element.place.clone(),
                    element: "path".into(),
                    message,
                    unused_parameter: false,
                };
                self.document.warnings.push((ElementId(self.document.elements.len()), warning));
            }
        }
        Ok(())
    }

    fn include(&mut self, element: &Element) -> Result<Vec<ElementId>, SceneError> {
        let name = required(element, "filename")?;
        let label = format!("include \"{name}\"");
        let error = |problem: String, help: &str| Err(SceneError::at(&element.place, &label, problem, help));
        let Some(found) = self.files.find(name, &element.place.file) else {
            return error(
                "the file is not there".into(),
                "include a file beside the scene, or name its folder with <path>",
            );
        };
        if self.including.contains(&identity(&found.path)) {
            return error("the file includes itself, in the end".into(), "cut the circle of includes");
        }
        let bytes = match self.files.read(&found.path) {
            Ok(bytes) => bytes,
            Err(problem) => return error(problem.to_string(), "include a file that can be read"),
        };
        self.budget.files += 1;
        let within = bytes.len() <= self.budget.bytes && self.budget.files <= MAX_INCLUDES;
        if !within || self.including.len() > MAX_INCLUDE_DEPTH {
            return error(
                format!(
                    "more than {MAX_INCLUDES} includes, {MAX_INCLUDE_DEPTH} of them in one another, or {MAX_INCLUDED} bytes in all"
                ),
                "include less: files that include each other multiply",
            );
        }
        self.budget.bytes -= bytes.len();
        let xml = text::decode(bytes, &found.path)?;
        if found.respelt {
            let message = format!("found as {}", found.path.display());
            let warning =
                Warning { place: element.place.clone(), element: label, message, unused_parameter: false };
            self.document.warnings.push((ElementId(self.document.elements.len()), warning));
        }
        self.file(&xml, &found.path, Some(element.is_old))
    }
}

/// The value of an attribute that must be there.
pub(super) fn required<'e>(element: &'e Element, name: &str) -> Result<&'e str, SceneError> {
    element.attribute(name).ok_or_else(|| {
        let problem = format!("<{}> without the attribute \"{name}\"", element.tag);
        SceneError::at(
            &element.place,
            &element.label(),
            problem,
            format!("write <{} {name}=\"…\">", element.tag),
        )
    })
}
