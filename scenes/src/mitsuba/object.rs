//! Typed access to the parameters of an object, with an eye on those that nobody asked for.

use std::cell::RefCell;
use std::collections::HashSet;

use glam::{DMat4, DVec3};

use super::document::{Document, Element, ElementId, required};
use super::value::{self, shorten, value_error};
use crate::nearest::suggest;
use crate::{Place, SceneError, Warning};

/// Unused parameters of one object that are named one by one.
const MAX_UNUSED: usize = 20;

/// An element with a type (`bsdf`, `shape`, …) whose parameters are being read.
///
/// What was asked for is remembered: [`finish`](Self::finish) warns of the rest.
pub(super) struct Object<'d> {
    pub document: &'d Document,
    pub id: ElementId,
    pub element: &'d Element,
    used: RefCell<HashSet<ElementId>>,
    asked: RefCell<Vec<&'static str>>,
}

impl<'d> Object<'d> {
    pub fn new(document: &'d Document, id: ElementId) -> Self {
        let element = document.element(id);
        Self { document, id, element, used: RefCell::default(), asked: RefCell::default() }
    }

    /// The type of the plugin.
    pub fn kind(&self) -> Result<&'d str, SceneError> {
        required(self.element, "type")
    }

    /// `float "radius" of sphere "ball"`: what an error about a parameter is about.
    pub fn label_of(&self, parameter: &Element) -> String {
        let kind =
            self.element.attribute("type").map(|kind| format!("{} \"{}\"", self.element.tag, shorten(kind)));
        let owner = match self.element.attribute("id") {
            None => kind.unwrap_or_else(|| self.element.tag.clone()),
            Some(_) => self.element.label(),
        };
        format!("{} of {owner}", parameter.label())
    }

    /// An error about this object.
    pub fn error(&self, problem: impl Into<String>, help: impl Into<String>) -> SceneError {
        SceneError::at(&self.element.place, &self.element.label(), problem, help)
    }

    /// An error about the value of one of its parameters.
    pub fn value_error(
        &self,
        parameter: &Element,
        problem: impl Into<String>,
        help: impl Into<String>,
    ) -> SceneError {
        SceneError::at(&parameter.place_of("value"), &self.label_of(parameter), problem, help)
    }

    /// The parameter of this name, whatever its type; of several, the last counts.
    pub fn find(&self, key: &'static str) -> Option<(ElementId, &'d Element)> {
        self.asked.borrow_mut().push(key);
        let children = self.element.children.iter().rev();
        let found =
            children.map(|&id| (id, self.document.element(id))).find(|(_, child)| child.key == key)?;
        self.used.borrow_mut().insert(found.0);
        Some(found)
    }

    /// The parameter of this name, which must be one of `tags`.
    fn typed(&self, key: &'static str, tags: &[&str]) -> Result<Option<&'d Element>, SceneError> {
        match self.find(key) {
            Some((_, found)) if !tags.contains(&found.tag.as_str()) => {
                let help = format!("write <{} name=\"{key}\" …/>", tags[0]);
                let problem = format!("<{}> where <{}> belongs", found.tag, tags[0]);
                Err(SceneError::at(&found.place, &self.label_of(found), problem, help))
            }
            found => Ok(found.map(|(_, element)| element)),
        }
    }

    /// Renames an error after the parameter and its object.
    fn named<T>(&self, parameter: &Element, result: Result<T, SceneError>) -> Result<T, SceneError> {
        result.map_err(|error| SceneError { element: self.label_of(parameter), ..error })
    }

    /// A finite number.
    pub fn maybe_float(&self, key: &'static str) -> Result<Option<f64>, SceneError> {
        let found = self.typed(key, &["float", "integer"])?;
        found.map(|found| self.named(found, value::number(found, "value"))).transpose()
    }

    /// A finite number, or what stands in for it.
    pub fn float(&self, key: &'static str, default: f64) -> Result<f64, SceneError> {
        Ok(self.maybe_float(key)?.unwrap_or(default))
    }

    /// A number that `accept`s, else an error that says what is `wanted`.
    pub fn float_where(
        &self,
        key: &'static str,
        default: f64,
        wanted: &str,
        accept: impl Fn(f64) -> bool,
    ) -> Result<f64, SceneError> {
        let value = self.float(key, default)?;
        match self.find(key) {
            Some((_, found)) if !accept(value) => Err(self.value_error(
                found,
                format!("{value} is not {wanted}"),
                format!("give a number that is {wanted}"),
            )),
            _ => Ok(value),
        }
    }

    /// A whole number within bounds that both count.
    pub fn integer(&self, key: &'static str, bounds: [i64; 2]) -> Result<Option<i64>, SceneError> {
        let Some(found) = self.typed(key, &["integer"])? else { return Ok(None) };
        let text = required(found, "value")?;
        match text.trim().parse::<i64>() {
            Ok(value) if (bounds[0]..=bounds[1]).contains(&value) => Ok(Some(value)),
            Ok(value) => {
                let help = format!("give a whole number from {} to {}", bounds[0], bounds[1]);
                Err(self.value_error(found, format!("{value} is out of bounds"), help))
            }
            Err(_) => {
                let problem = format!("\"{}\" is not a whole number", shorten(text));
                Err(self.value_error(found, problem, "write a number such as 64"))
            }
        }
    }

    /// `true` or `false`.
    pub fn boolean(&self, key: &'static str, default: bool) -> Result<bool, SceneError> {
        let Some(found) = self.typed(key, &["boolean"])? else { return Ok(default) };
        match required(found, "value")?.trim().to_ascii_lowercase().as_str() {
            "true" => Ok(true),
            "false" => Ok(false),
            other => {
                let problem = format!("\"{}\" is neither true nor false", shorten(other));
                Err(self.value_error(found, problem, "write true or false"))
            }
        }
    }

    /// A text and its element.
    pub fn string(&self, key: &'static str) -> Result<Option<(&'d str, &'d Element)>, SceneError> {
        let Some(found) = self.typed(key, &["string"])? else { return Ok(None) };
        Ok(Some((required(found, "value")?, found)))
    }

    /// One of a few words, with its meaning; the first where the file says nothing.
    pub fn choice<T: Copy>(&self, key: &'static str, choices: &[(&'static str, T)]) -> Result<T, SceneError> {
        let Some((word, found)) = self.string(key)? else { return Ok(choices[0].1) };
        let known = choices.iter().find(|(name, _)| name.eq_ignore_ascii_case(word.trim()));
        known.map(|(_, meaning)| *meaning).ok_or_else(|| {
            let help = suggest(word, "words", choices.iter().map(|(name, _)| *name));
            self.value_error(found, format!("unknown word \"{}\"", shorten(word)), help)
        })
    }

    /// A point or vector.
    pub fn vector(&self, key: &'static str, default: DVec3) -> Result<DVec3, SceneError> {
        let found = self.typed(key, &["point", "vector"])?;
        found.map_or(Ok(default), |found| self.named(found, value::vector(found, 0.0)))
    }

    /// A transform, or identity.
    pub fn transform(&self, key: &'static str) -> Result<DMat4, SceneError> {
        let found = self.typed(key, &["transform"])?;
        found.map_or(Ok(DMat4::IDENTITY), |found| {
            value::transform(self.document, found).map_err(|error| {
                // the operation alone says too little: the transform and its object belong to the name
                let element = format!("{} in {}", error.element, self.label_of(found));
                SceneError {
                    element: if error.element == found.label() { self.label_of(found) } else { element },
                    ..error
                }
            })
        })
    }

    /// Takes note of parameters that change nothing here, so that nobody is warned of them.
    pub fn without_effect(&self, keys: &[&'static str]) {
        for key in keys {
            self.find(key);
        }
    }

    /// Takes note of everything inside.
    pub fn all_without_effect(&self) {
        self.used.borrow_mut().extend(self.element.children.iter().copied());
    }

    /// The nested objects of a class, references followed, each with the element that stands in this object.
    pub fn nested(&self, class: &str) -> Result<Vec<(ElementId, &'d Element)>, SceneError> {
        let mut found = Vec::new();
        for &id in &self.element.children {
            let element = self.document.element(id);
            let target = self.resolve(id)?;
            if self.document.element(target).tag == class {
                self.used.borrow_mut().insert(id);
                found.push((target, element));
            }
        }
        Ok(found)
    }

    /// Follows a `<ref>` to its object; other elements stand for themselves.
    pub fn resolve(&self, id: ElementId) -> Result<ElementId, SceneError> {
        let element = self.document.element(id);
        if element.tag != "ref" {
            return Ok(id);
        }
        let name = required(element, "id")?;
        self.document.by_id(name).ok_or_else(|| {
            let help = suggest(name, "ids", self.document.ids());
            value_error(element, "id", format!("no object has the id \"{}\"", shorten(name)), &help)
        })
    }

    /// Warnings about every parameter that nobody asked for.
    pub fn finish(self, warnings: &mut Vec<(ElementId, Warning)>) {
        let (used, asked) = (self.used.borrow(), self.asked.borrow());
        let unused: Vec<_> = self.element.children.iter().filter(|id| !used.contains(id)).collect();
        for &&id in unused.iter().take(MAX_UNUSED) {
            let child = self.document.element(id);
            let what =
                if child.key.is_empty() { format!("<{}>", child.tag) } else { format!("\"{}\"", child.key) };
            let message = if asked.contains(&child.key.as_str()) {
                format!("{what} is given again further down; the last counts")
            } else if child.key.is_empty() || asked.is_empty() {
                format!("unused parameter {what}")
            } else {
                let help = suggest(&child.key, "parameters", asked.iter().copied());
                format!("unused parameter {what}; {help}")
            };
            warnings.push((
                id,
                Warning {
                    place: child.place.clone(),
                    element: self.element.label(),
                    message,
                    unused_parameter: true,
                },
            ));
        }
        if let Some(&&next) = unused.get(MAX_UNUSED) {
            let place = self.document.element(next).place.clone();
            let message = format!("{} more unused parameters from here on", unused.len() - MAX_UNUSED);
            let element = self.element.label();
            warnings.push((next, Warning { place, element, message, unused_parameter: true }));
        }
    }

    /// Where the object stands.
    pub fn place(&self) -> Place {
        self.element.place.clone()
    }
}
