//! Everything that can end the program early, and the exit code of each.

use std::fmt::Display;
use std::io;
use std::path::PathBuf;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use limpid_denoise::DenoiseError;
use limpid_frame::{Fault, FrameError};
use limpid_renderer::PrepareError;
use limpid_scenes::SceneError;

/// Why the program ends with another exit code than 0.
#[derive(Debug, thiserror::Error)]
pub enum CliError {
    /// The value of an option, and what to write instead.
    #[error("{option}: {problem}")]
    Option {
        /// As it was written: `--spp 0`.
        option: String,
        /// What is wrong, and the cure.
        problem: String,
    },
    /// A scene that cannot be read or rendered.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A frame that cannot be read or written.
    #[error(transparent)]
    Frame(#[from] FrameError),
    /// What one of several files has to do with it.
    #[error("{}: {problem}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What is wrong, and the cure.
        problem: String,
    },
    /// A frame that the method cannot take.
    #[error("{}: {source}", path.display())]
    Denoise {
        /// The frame's file.
        path: PathBuf,
        /// What the method said.
        source: DenoiseError,
    },
    /// The system gives no threads.
    #[error("--threads {threads}: the system gives no more: {problem}")]
    Threads {
        /// As many as were asked for.
        threads: usize,
        /// What the system said.
        problem: String,
    },
    /// Standard output cannot be written to.
    #[error("standard output: {0}")]
    Stdout(io::Error),
    /// Mitsuba 3 cannot be run here.
    #[error("Mitsuba: {problem}\n  = help: {help}")]
    Mitsuba {
        /// What went wrong.
        problem: String,
        /// What to do about it.
        help: String,
    },
    /// The command ran, and its answer is no.
    #[error("{0}")]
    No(String),
    /// Ctrl-C.
    #[error("interrupted: {kept}")]
    Interrupted {
        /// What is left of the work.
        kept: String,
    },
}

impl CliError {
    /// An option's value that is wrong.
    pub fn option(option: &str, value: impl Display, problem: impl Display) -> Self {
        Self::Option { option: format!("{option} {value}"), problem: problem.to_string() }
    }

    /// 2: the input or the call is wrong; 3: the machine failed; 130: interrupted.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Option { .. } | Self::Scene(_) | Self::File { .. } | Self::Denoise { .. } => 2,
            Self::Frame(error) => match error.fault() {
                Fault::Input => 2,
                Fault::Machine => 3,
            },
            Self::Threads { .. } | Self::Stdout(_) | Self::Mitsuba { .. } => 3,
            Self::No(_) => 1,
            Self::Interrupted { .. } => 130,
        }
    }

    /// clap's word about an option's value, in ours; `None` for what clap says better.
    pub fn from_clap(refusal: &clap::Error) -> Option<Self> {
        let text = |kind| match refusal.get(kind) {
            Some(ContextValue::String(text)) => Some(text.clone()),
            _ => None,
        };
        if refusal.kind() != ErrorKind::ValueValidation {
            return None;
        }
        // `--spp <N>`: the option and the name of its value.
        let option = text(ContextKind::InvalidArg)?;
        let option = option.split_once(' ').map_or(option.as_str(), |(name, _)| name);
        let problem = std::error::Error::source(refusal)?;
        Some(Self::option(option, text(ContextKind::InvalidValue)?, problem))
    }
}

impl From<PrepareError> for CliError {
    fn from(error: PrepareError) -> Self {
        let PrepareError { place, element, problem, help } = error;
        Self::Scene(SceneError::at(&place, &element, problem, help))
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;
    use crate::cli::Cli;

    fn refused(line: &[&str]) -> CliError {
        CliError::from_clap(&Cli::try_parse_from(line).expect_err("is refused")).expect("is about a value")
    }

    #[test]
    fn an_options_error_names_option_and_cure() {
        let error = refused(&["limpid", "render", "a.xml", "--spp", "0"]);
        assert_eq!(error.to_string(), "--spp 0: need at least 1 sample; for a preview use `--spp 1`");
        assert_eq!(error.exit_code(), 2);
        let error = refused(&["limpid", "render", "a.xml", "-o", "a.png"]);
        assert!(error.to_string().starts_with("-o a.png: a frame is an EXR file"), "{error}");
    }

    #[test]
    fn an_unknown_layer_or_method_lists_the_known_ones() {
        let error = refused(&["limpid", "render", "a.xml", "--layers", "albdo"]).to_string();
        assert!(error.starts_with("--layers albdo: unknown layer `albdo`"), "{error}");
        assert!(error.contains("albedo") && error.contains("normal"), "{error}");
        let error = refused(&["limpid", "render", "a.xml", "--denoise", "joint-nml"]).to_string();
        assert!(error.contains("joint-nlm"), "{error}");
    }

    #[test]
    fn a_full_disk_is_the_machines_fault_and_a_missing_folder_the_calls() {
        let (path, source) = (PathBuf::from("a.exr"), || io::Error::from(io::ErrorKind::StorageFull));
        let full = FrameError::WriteFailed { path: path.clone(), source: source() };
        assert_eq!(CliError::from(full).exit_code(), 3);
        assert_eq!(CliError::from(FrameError::OutputPath { path, source: source() }).exit_code(), 2);
    }
}
