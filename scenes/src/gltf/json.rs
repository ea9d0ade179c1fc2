//! Objects of the JSON text, each with the way to it, so that every complaint says where: `materials[3].alphaCutoff`.

use std::path::Path;

use serde_json::{Map, Value};

use crate::SceneError;

/// A JSON object.
#[derive(Clone)]
pub(super) struct Item<'a> {
    pub document: &'a Document,
    object: &'a Map<String, Value>,
    /// From the root, such as `materials[3]`; empty for the root.
    pub path: String,
}

/// The root object, and the file that errors name.
pub(super) struct Document {
    pub file: std::path::PathBuf,
    pub root: Map<String, Value>,
}

impl Document {
    pub fn root(&self) -> Item<'_> {
        Item { document: self, object: &self.root, path: String::new() }
    }

    /// Length of one of the root's lists; 0 where it is not there.
    pub fn count(&self, list: &str) -> usize {
        self.root.get(list).and_then(Value::as_array).map_or(0, Vec::len)
    }

    /// Entry `index` of one of the root's lists.
    ///
    /// # Errors
    ///
    /// If it is not there or no object.
    pub fn entry(&self, list: &'static str, index: usize) -> Result<Item<'_>, SceneError> {
        let path = format!("{list}[{index}]");
        let value = self.root.get(list).and_then(Value::as_array).and_then(|list| list.get(index));
        match value {
            Some(Value::Object(object)) => Ok(Item { document: self, object, path }),
            Some(other) => Err(error(&self.file, &path, wrong(other, "an object"), EXPORT_AGAIN)),
            None => {
                let problem = format!("not there: the file has {} {list}", self.count(list));
                Err(error(&self.file, &path, problem, EXPORT_AGAIN))
            }
        }
    }
}

/// What is to be done about a file that breaks the format's rules.
pub(super) const EXPORT_AGAIN: &str = "export the model again, or repair it there";

/// An error at a place in the JSON text.
pub(super) fn error(file: &Path, element: &str, problem: impl Into<String>, help: &str) -> SceneError {
    let element = if element.is_empty() { "file" } else { element };
    SceneError {
        file: file.into(),
        line: 0,
        column: 0,
        element: element.into(),
        problem: problem.into(),
        help: help.into(),
    }
}

impl<'a> Item<'a> {
    /// An error about the key of this object, or about the object where `key` is empty.
    pub fn error(&self, key: &str, problem: impl Into<String>, help: &str) -> SceneError {
        error(&self.document.file, &self.at(key), problem, help)
    }

    /// The way to a key.
    pub fn at(&self, key: &str) -> String {
        match (self.path.as_str(), key) {
            (path, "") => path.into(),
            ("", key) => key.into(),
            (path, key) => format!("{path}.{key}"),
        }
    }

    /// The value of a key; JSON's null counts as not given.
    pub fn get(&self, key: &str) -> Option<&'a Value> {
        self.object.get(key).filter(|value| !value.is_null())
    }

    fn typed<T>(
        &self,
        key: &str,
        what: &str,
        read: impl FnOnce(&'a Value) -> Option<T>,
    ) -> Result<Option<T>, SceneError> {
        let Some(value) = self.get(key) else { return Ok(None) };
        read(value).map(Some).ok_or_else(|| self.error(key, wrong(value, what), EXPORT_AGAIN))
    }

    /// A nested object.
    pub fn object(&self, key: &str) -> Result<Option<Item<'a>>, SceneError> {
        let object = self.typed(key, "an object", Value::as_object)?;
        Ok(object.map(|object| Item { document: self.document, object, path: self.at(key) }))
    }

    /// Object number `index` of a list.
    ///
    /// # Errors
    ///
    /// If it is not there or no object.
    pub fn nth(&self, key: &str, index: usize) -> Result<Item<'a>, SceneError> {
        let path = format!("{}[{index}]", self.at(key));
        let list = self.typed(key, "a list", Value::as_array)?.map_or(&[][..], Vec::as_slice);
        match list.get(index) {
            Some(Value::Object(object)) => Ok(Item { document: self.document, object, path }),
            Some(other) => Err(error(&self.document.file, &path, wrong(other, "an object"), EXPORT_AGAIN)),
            None => {
                let problem = format!("not there: the list has {}", list.len());
                Err(error(&self.document.file, &path, problem, EXPORT_AGAIN))
            }
        }
    }

    /// Length of a list; 0 where it is not there.
    pub fn count(&self, key: &str) -> usize {
        self.get(key).and_then(Value::as_array).map_or(0, Vec::len)
    }

    /// The parameters of an extension, where the object has it.
    pub fn extension(&self, name: &str) -> Result<Option<Item<'a>>, SceneError> {
        match self.object("extensions")? {
            Some(extensions) => extensions.object(name),
            None => Ok(None),
        }
    }

    pub fn string(&self, key: &str) -> Result<Option<&'a str>, SceneError> {
        self.typed(key, "a string", Value::as_str)
    }

    pub fn boolean(&self, key: &str) -> Result<bool, SceneError> {
        Ok(self.typed(key, "true or false", Value::as_bool)?.unwrap_or(false))
    }

    pub fn number(&self, key: &str) -> Result<Option<f64>, SceneError> {
        self.typed(key, "a number", Value::as_f64)
    }

    /// A number that must lie in a range, which `what` says in words.
    pub fn number_in(
        &self,
        key: &str,
        default: f32,
        range: std::ops::RangeInclusive<f32>,
    ) -> Result<f32, SceneError> {
        let Some(value) = self.number(key)?.map(|value| value as f32) else { return Ok(default) };
        if range.contains(&value) {
            return Ok(value);
        }
        let problem = match (*range.start(), *range.end()) {
            (low, f32::MAX) => format!("{value} is not a number from {low} on"),
            (low, high) => format!("{value} is not in [{low}, {high}]"),
        };
        Err(self.error(key, problem, "correct the number"))
    }

    /// A list of exactly `N` numbers.
    pub fn numbers<const N: usize>(&self, key: &str) -> Result<Option<[f64; N]>, SceneError> {
        self.typed(key, &format!("a list of {N} numbers"), |value| {
            let list = value.as_array().filter(|list| list.len() == N)?;
            let mut numbers = [0.0; N];
            for (number, value) in numbers.iter_mut().zip(list) {
                *number = value.as_f64()?;
            }
            Some(numbers)
        })
    }

    /// A list of numbers of any length.
    pub fn number_list(&self, key: &str) -> Result<Option<Vec<f64>>, SceneError> {
        self.typed(key, "a list of numbers", |value| value.as_array()?.iter().map(Value::as_f64).collect())
    }

    /// A whole number, not negative.
    pub fn unsigned(&self, key: &str) -> Result<Option<u64>, SceneError> {
        self.typed(key, "a whole number", whole)
    }

    /// An index into one of the root's lists.
    pub fn index(&self, key: &str, list: &'static str) -> Result<Option<usize>, SceneError> {
        let Some(index) = self.unsigned(key)? else { return Ok(None) };
        self.within(key, index, list).map(Some)
    }

    /// A list of indices into one of the root's lists.
    pub fn indices(&self, key: &str, list: &'static str) -> Result<Vec<usize>, SceneError> {
        let indices = self.typed(key, "a list of whole numbers", |value| {
            value.as_array()?.iter().map(whole).collect::<Option<Vec<_>>>()
        })?;
        indices.unwrap_or_default().into_iter().map(|index| self.within(key, index, list)).collect()
    }

    fn within(&self, key: &str, index: u64, list: &str) -> Result<usize, SceneError> {
        let count = self.document.count(list);
        if index < count as u64 {
            return Ok(index as usize);
        }
        let problem = format!("index {index}, but the file has {count} {list}");
        Err(self.error(key, problem, EXPORT_AGAIN))
    }

    /// The name that the file gives it, or `other` and its number, counted from 1.
    pub fn name_or(&self, other: &str, index: usize) -> String {
        match self.get("name").and_then(Value::as_str) {
            Some(name) if !name.is_empty() => name.into(),
            _ => format!("{other} {}", index + 1),
        }
    }

    /// The text of some of its keys, for comparing.
    pub fn text_of(&self, keys: &[&str]) -> String {
        keys.iter().map(|key| self.get(key).map(Value::to_string).unwrap_or_default() + ";").collect()
    }
}

/// Some writers give whole numbers as 3.0.
fn whole(value: &Value) -> Option<u64> {
    let exact = |x: f64| (x >= 0.0 && x < (1u64 << 53) as f64 && x.fract() == 0.0).then_some(x as u64);
    value.as_u64().or_else(|| value.as_f64().and_then(exact))
}

fn wrong(value: &Value, what: &str) -> String {
    let mut text: String = value.to_string().chars().take(41).collect();
    if text.chars().count() > 40 {
        text.pop();
        text.push('…');
    }
    format!("{text} where {what} belongs")
}
