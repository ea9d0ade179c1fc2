//! The table of methods and of their parameters.

use limpid_frame::{LayerRequest, nearest_first};

use crate::{DenoiseError, Denoiser, filter};

/// What sort of method it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A formula with a few parameters; nothing was trained.
    Filter,
    /// A network whose weights were trained.
    Learned,
    /// A program of others, called for comparison.
    Peer,
}

impl Kind {
    /// In lower case, as the program prints it.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Filter => "filter",
            Kind::Learned => "learned",
            Kind::Peer => "peer",
        }
    }
}

/// A number that changes how a method works, set as `--set name=value`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// As it is written.
    pub name: &'static str,
    /// One line: what it does, with its unit.
    pub doc: &'static str,
    /// What it is where nobody sets it.
    pub default: f64,
    /// The least value.
    pub min: f64,
    /// The greatest value.
    pub max: f64,
    /// Whether it has to be a whole number.
    pub integer: bool,
}

/// A denoising method: a row of [`methods`].
#[derive(Debug)]
pub struct Method {
    /// As `--denoise` and `--method` name it.
    pub name: &'static str,
    /// What sort of method it is.
    pub kind: Kind,
    /// The paper it comes from.
    pub source: &'static str,
    /// What it does, in one line.
    pub summary: &'static str,
    /// What can be set.
    pub parameters: &'static [Parameter],
    pub(crate) build: fn(&Values) -> Box<dyn Denoiser>,
}

/// Every denoiser that there is.
pub fn methods() -> &'static [Method] {
    filter::METHODS
}

/// The method of this name.
///
/// # Errors
///
/// [`DenoiseError::UnknownMethod`] lists the known ones, nearest first.
pub fn by_name(name: &str) -> Result<&'static Method, DenoiseError> {
    methods().iter().find(|method| method.name == name).ok_or_else(|| DenoiseError::UnknownMethod {
        name: name.to_owned(),
        known: nearest_first(name, methods().iter().map(|method| method.name)),
    })
}

impl Method {
    /// The denoiser with its default parameters.
    pub fn denoiser(&self) -> Box<dyn Denoiser> {
        (self.build)(&Values::defaults(self.parameters))
    }

    /// The denoiser with some parameters set; each item is `name=value`, of two of a name the last holds.
    ///
    /// # Errors
    ///
    /// [`DenoiseError::Assignment`], [`DenoiseError::UnknownParameter`] and [`DenoiseError::OutOfRange`].
    pub fn configure(&self, assignments: &[String]) -> Result<Box<dyn Denoiser>, DenoiseError> {
        let mut values = Values::defaults(self.parameters);
        for text in assignments {
            let (key, value) = self.parse(text)?;
            values.set(key, value);
        }
        Ok((self.build)(&values))
    }

    /// The layers that it reads, the optional ones too.
    pub fn needs(&self) -> LayerRequest {
        self.denoiser().needs()
    }

    fn parse(&self, text: &str) -> Result<(&'static str, f64), DenoiseError> {
        let assignment = || DenoiseError::Assignment {
            text: text.to_owned(),
            example: self
                .parameters
                .first()
                .map_or("key=1".to_owned(), |p| format!("{}={}", p.name, p.default)),
        };
        let (key, value) = text.split_once('=').ok_or_else(assignment)?;
        let (key, value) = (key.trim(), value.trim().parse::<f64>().map_err(|_| assignment())?);
        let Some(parameter) = self.parameters.iter().find(|parameter| parameter.name == key) else {
            return Err(DenoiseError::UnknownParameter {
                method: self.name,
                key: key.to_owned(),
                known: nearest_first(key, self.parameters.iter().map(|parameter| parameter.name)),
            });
        };
        // A NaN fails this test too, which is why it is not written the other way round.
        let Parameter { name, min, max, integer, .. } = *parameter;
        if !(min <= value && value <= max) || (integer && value.fract() != 0.0) {
            return Err(DenoiseError::OutOfRange { method: self.name, key: name, value, min, max, integer });
        }
        Ok((name, value))
    }
}

/// The values of a method's parameters.
pub(crate) struct Values(Vec<(&'static str, f64)>);

impl Values {
    pub(crate) fn defaults(parameters: &[Parameter]) -> Self {
        Self(parameters.iter().map(|parameter| (parameter.name, parameter.default)).collect())
    }

    fn set(&mut self, name: &str, value: f64) {
        for entry in self.0.iter_mut().filter(|entry| entry.0 == name) {
            entry.1 = value;
        }
    }

    /// The value of a parameter that the method's table lists.
    pub(crate) fn get(&self, name: &str) -> f32 {
        let entry = self.0.iter().find(|entry| entry.0 == name);
        entry.expect("a method asks only for parameters that its table lists").1 as f32
    }

    /// The same of a whole number that is not negative.
    pub(crate) fn count(&self, name: &str) -> usize {
        self.get(name) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(method: &str, assignments: &[&str]) -> Result<Box<dyn Denoiser>, DenoiseError> {
        let assignments: Vec<String> = assignments.iter().map(|text| (*text).to_owned()).collect();
        by_name(method)?.configure(&assignments)
    }

    fn refusal(assignment: &str) -> String {
        set("joint-nlm", &[assignment]).err().expect("must be refused").to_string()
    }

    #[test]
    fn every_method_is_found_by_its_name_and_names_itself() {
        for method in methods() {
            assert_eq!(by_name(method.name).expect("is listed").denoiser().name(), method.name);
        }
    }

    #[test]
    fn every_default_is_within_its_range() {
        for method in methods() {
            let defaults: Vec<String> =
                method.parameters.iter().map(|p| format!("{}={}", p.name, p.default)).collect();
            assert!(method.configure(&defaults).is_ok(), "{}", method.name);
        }
    }

    #[test]
    fn an_unknown_method_lists_the_known_ones() {
        let error = by_name("joint_nlm").expect_err("is unknown").to_string();
        assert!(error.starts_with("unknown method `joint_nlm`; known, nearest first: joint-nlm"), "{error}");
    }

    #[test]
    fn a_wrong_assignment_is_refused_with_a_cure() {
        for text in ["patch", "patch=", "patch=many", "=", ""] {
            assert!(refusal(text).ends_with("write key=value with a number, such as `radius=10`"), "{text}");
        }
        assert!(
            refusal("patches=1")
                .starts_with("joint-nlm: unknown parameter `patches`; known, nearest first: patch")
        );
        let range = "joint-nlm: `patch=2.5` is out of range: it goes from 0 to 8, in whole numbers";
        assert_eq!(refusal("patch=2.5"), range);
        for text in ["radius=0", "radius=33", "k_color=NaN", "tau=inf", "sigma_spatial=-1"] {
            assert!(refusal(text).contains(" is out of range: it goes from "), "{text}");
        }
    }

    #[test]
    fn what_is_set_stands_in_the_answer_and_the_last_of_a_name_holds() {
        let denoiser = set("joint-nlm", &["patch=1", " radius = 5 ", "patch=2"]).expect("is right");
        let buffers = crate::Buffers { width: 1, height: 1, color: &[0.5; 3], ..Default::default() };
        let frame = denoiser.denoise(&buffers.to_frame().expect("fits")).expect("has a beauty");
        assert!(frame.metadata["limpid:denoise"].starts_with("joint-nlm radius=5 patch=2 "));
    }
}
