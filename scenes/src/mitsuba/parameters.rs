//! `$name` in attribute values, and names of Mitsuba 0.x.

use std::collections::{HashMap, HashSet};

use crate::nearest::suggest;

/// Bytes that expansion may add to one file: values that hold each other double without end.
const MAX_EXPANDED: usize = 64 << 20;

/// Bytes of a name that is not set off from what follows it: each is tried.
const MAX_NAME: usize = 64;

/// The parameters of a file: `-D name=value` and `<default>`.
#[derive(Debug)]
pub(super) struct Parameters {
    values: HashMap<String, String>,
    defines: Vec<String>,
    used: HashSet<String>,
    budget: usize,
}

/// Why a value cannot be expanded.
#[derive(Debug)]
pub(super) struct Unexpandable {
    pub problem: String,
    pub help: String,
}

impl Parameters {
    /// Values from outside, which no `<default>` changes; of two for one name the later counts.
    pub fn new(defines: &[(String, String)]) -> Self {
        Self {
            values: defines.iter().cloned().collect(),
            defines: defines.iter().map(|(name, _)| name.clone()).collect(),
            used: HashSet::new(),
            budget: MAX_EXPANDED,
        }
    }

    /// `<default>`: gives a value to a parameter that has none yet.
    pub fn default(&mut self, name: &str, value: &str) {
        self.used.insert(name.into()); // declared is as good as used: the file knows the name
        self.values.entry(name.into()).or_insert_with(|| value.into());
    }

    /// Replaces each `$name`. The name goes as far as letters, digits and underscores do; where nothing is known by it,
    /// the longest beginning that is known counts (`$resx` with `res`).
    pub fn expand(&mut self, text: &str) -> Result<String, Unexpandable> {
        let Some((before, mut rest)) = text.split_once('$') else { return Ok(text.into()) };
        let mut expanded = String::from(before);
        loop {
            let end = rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(rest.len());
            let lengths = std::iter::once(end).chain((1..end.min(MAX_NAME)).rev());
            let known = lengths.into_iter().find(|&length| self.values.contains_key(&rest[..length]));
            let Some(length) = known else {
                let name = &rest[..end];
                let help = if self.values.is_empty() {
                    format!("give it a value: -D {name}=VALUE, or <default name=\"{name}\" value=\"…\"/>")
                } else {
                    suggest(name, "parameters", self.values.keys().map(String::as_str))
                };
                return Err(Unexpandable { problem: format!("the parameter ${name} has no value"), help });
            };
            let (name, after) = rest.split_at(length);
            let value = &self.values[name];
            if value.len() > self.budget {
                let problem = format!("parameters expand to more than {MAX_EXPANDED} bytes");
                return Err(Unexpandable {
                    problem,
                    help: "do not build parameters out of parameters".into(),
                });
            }
            self.budget -= value.len();
            expanded += value;
            self.used.insert(name.into());
            match after.split_once('$') {
                Some((between, next)) => {
                    expanded += between;
                    rest = next;
                }
                None => {
                    expanded += after;
                    return Ok(expanded);
                }
            }
        }
    }

    /// Names that were given from outside and that the file neither declares nor uses.
    pub fn unused_defines(&self) -> impl Iterator<Item = &str> {
        self.defines.iter().map(String::as_str).filter(|name| !self.used.contains(*name))
    }
}

/// A name of Mitsuba 0.x in version-3 spelling: `toWorld` → `to_world`, `intIOR` → `int_ior`.
pub(super) fn snake_case(name: &str) -> String {
    let mut snake = String::with_capacity(name.len() + 4);
    let mut after_small = false;
    for c in name.chars() {
        if c.is_ascii_uppercase() && after_small {
            snake.push('_');
        }
        after_small = c.is_ascii_lowercase();
        snake.push(c.to_ascii_lowercase());
    }
    snake
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parameters(pairs: &[(&str, &str)]) -> Parameters {
        Parameters::new(&pairs.iter().map(|(n, v)| (n.to_string(), v.to_string())).collect::<Vec<_>>())
    }

    #[test]
    fn parameters_expand_whole_or_in_part() {
        let mut parameters = parameters(&[("a", "1"), ("ab", "2")]);
        parameters.default("a", "7");
        parameters.default("m", "1 0 0");
        for (text, expanded) in [
            ("$a", "1"),
            ("$ab", "2"),
            ("$abc", "2c"),
            ("x$a/$ab.y", "x1/2.y"),
            ("$a$a", "11"),
            ("$m", "1 0 0"),
            ("", ""),
        ] {
            assert_eq!(parameters.expand(text).unwrap(), expanded, "{text}");
        }
    }

    #[test]
    fn an_unknown_parameter_names_the_known_ones() {
        let error = parameters(&[("spp", "1")]).expand("$sp").unwrap_err();
        assert!(error.problem.contains("$sp "), "{error:?}");
        assert!(error.help.contains("did you mean \"spp\""), "{error:?}");
        assert!(parameters(&[]).expand("50$").is_err());
    }

    #[test]
    fn doubling_parameters_end_at_the_budget() {
        let mut parameters = parameters(&[]);
        parameters.default("a", &"x".repeat(1024));
        let mut name = String::from("a");
        let mut refused = false;
        while !refused && name.len() < 40 {
            match parameters.expand(&format!("${name} ${name}")) {
                Ok(value) => {
                    name.push('a');
                    parameters.default(&name, &value);
                }
                Err(_) => refused = true,
            }
        }
        assert!(refused);
    }

    #[test]
    fn old_names_become_new_ones() {
        for (old, new) in [
            ("toWorld", "to_world"),
            ("intIOR", "int_ior"),
            ("rrDepth", "rr_depth"),
            ("radius", "radius"),
            ("extEta", "ext_eta"),
        ] {
            assert_eq!(snake_case(old), new);
        }
    }
}
