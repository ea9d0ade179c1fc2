//! Mitsuba 3 on this machine: a virtual environment that is made on first use, and the variant that works there.

use std::env;
use std::fs::{self, File};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::cli::Common;
use crate::error::CliError;
use crate::progress::with_spinner;
use crate::words;

/// The version whose answers the documentation quotes.
pub const VERSION: &str = "3.9.1";
/// Names an interpreter that has Mitsuba already.
const VARIABLE: &str = "LIMPID_MITSUBA_PYTHON";
/// Compiled for this processor while it runs, and much faster; but its LLVM may crash the process.
const FAST: &str = "llvm_ad_rgb";
/// Works everywhere.
pub const SURE: &str = "scalar_rgb";

/// A Python that renders with Mitsuba.
pub struct Environment {
    /// The interpreter.
    pub python: PathBuf,
    /// The variant that works there.
    pub variant: String,
}

impl Environment {
    /// The one that is named by `LIMPID_MITSUBA_PYTHON`, or else our own, made if it is not there.
    ///
    /// # Errors
    ///
    /// Where there is no Python, no network to install from, or no Mitsuba in the interpreter that was named.
    pub fn ready(common: &Common) -> Result<Self, CliError> {
        let cache = cache_folder()?;
        let (python, remembered) = match env::var_os(VARIABLE).filter(|named| !named.is_empty()) {
            Some(named) => {
                let python = PathBuf::from(named);
                check_named(&python, common)?;
                let mut hasher = DefaultHasher::new();
                python.hash(&mut hasher);
                (python, cache.join(format!("mitsuba-variant-{:016x}", hasher.finish())))
            }
            None => {
                let folder = cache.join(format!("mitsuba-{VERSION}"));
                let python = own(&folder, common)?;
                (python, folder.join("variant"))
            }
        };
        let variant = variant(&python, &remembered, common);
        Ok(Self { python, variant })
    }
}

/// `XDG_CACHE_HOME/limpid`, `~/.cache/limpid`, or its like on Windows.
fn cache_folder() -> Result<PathBuf, CliError> {
    let folder = |name: &str| env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let cache = folder("XDG_CACHE_HOME")
        .or_else(|| folder("HOME").map(|home| home.join(".cache")))
        .or_else(|| folder("LOCALAPPDATA"));
    cache.map(|cache| cache.join("limpid")).ok_or_else(|| {
        failed(
            "there is no folder to keep it in",
            format!("set XDG_CACHE_HOME, or name a Python that has it in {VARIABLE}"),
        )
    })
}

fn failed(problem: impl Into<String>, help: impl Into<String>) -> CliError {
    CliError::Mitsuba { problem: problem.into(), help: help.into() }
}

/// Whether the interpreter that was named has Mitsuba; another version is worth a note.
fn check_named(python: &Path, common: &Common) -> Result<(), CliError> {
    let help = format!("`{} -m pip install mitsuba=={VERSION} numpy`, or unset {VARIABLE}", python.display());
    let script = "import mitsuba, numpy; print(mitsuba.__version__)";
    let output = Command::new(python).args(["-c", script]).output().map_err(|error| {
        failed(format!("{VARIABLE} names {}, which does not start: {error}", python.display()), help.as_str())
    })?;
    if !output.status.success() {
        let problem = format!("{} has no Mitsuba: {}", python.display(), last_line(&output));
        return Err(failed(problem, help));
    }
    let version = String::from_utf8_lossy(&output.stdout).trim().to_owned();
    if version != VERSION {
        words::note(common, format_args!("note: Mitsuba {version} takes part, not {VERSION}"));
    }
    Ok(())
}

/// The interpreter of our own environment. A file says that it is whole; one that was left half made is made again.
fn own(folder: &Path, common: &Common) -> Result<PathBuf, CliError> {
    let venv = folder.join("venv");
    let python = if cfg!(windows) { venv.join("Scripts/python.exe") } else { venv.join("bin/python") };
    let whole = folder.join("whole");
    let trouble = |error: io::Error| {
        let help = format!("make room there, set XDG_CACHE_HOME, or name a Python that has it in {VARIABLE}");
        failed(format!("{}: {error}", folder.display()), help)
    };
    fs::create_dir_all(folder).map_err(trouble)?;
    // Two commands at once: the second waits and finds it made.
    let lock = File::create(folder.join("lock")).map_err(trouble)?;
    lock.lock().map_err(trouble)?;
    if whole.is_file() && python.is_file() {
        return Ok(python);
    }
    words::note(
        common,
        format_args!("note: installing Mitsuba {VERSION} (about 60 MB) into {}, once", folder.display()),
    );
    let system = if cfg!(windows) { "python" } else { "python3" };
    let help =
        format!("install Python 3.8 or newer with venv and pip, or name one that has Mitsuba in {VARIABLE}");
    step(Command::new(system).args(["-m", "venv", "--clear"]).arg(&venv), common, &help)?;
    let help = format!("check the network, or name a Python that has Mitsuba in {VARIABLE}");
    let wheel = format!("mitsuba=={VERSION}");
    let pip = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-input"];
    step(Command::new(&python).args(pip).args([wheel.as_str(), "numpy"]), common, &help)?;
    File::create(&whole).map_err(trouble)?;
    Ok(python)
}

fn step(command: &mut Command, common: &Common, help: &str) -> Result<(), CliError> {
    let name = command.get_program().to_string_lossy().into_owned();
    match with_spinner(common, "installing Mitsuba", || command.output()) {
        Ok(output) if output.status.success() => Ok(()),
        Ok(output) => Err(failed(format!("it cannot be installed: {}", last_line(&output)), help)),
        Err(error) => Err(failed(format!("it cannot be installed: {name}: {error}"), help)),
    }
}

/// The last thing that a program said before it failed.
pub fn last_line(output: &Output) -> String {
    let text = [&output.stderr, &output.stdout].map(|bytes| String::from_utf8_lossy(bytes).into_owned());
    let last = text.iter().flat_map(|text| text.lines().rev()).find(|line| !line.trim().is_empty());
    last.map_or_else(|| output.status.to_string(), |line| line.trim().to_owned())
}

/// The fast variant where a small render in a process of its own ends well, else the sure one. The answer is kept;
/// where it cannot be kept it is asked for again.
fn variant(python: &Path, remembered: &Path, common: &Common) -> String {
    if let Ok(known) = fs::read_to_string(remembered)
        && [FAST, SURE].contains(&known.trim())
    {
        return known.trim().to_owned();
    }
    let works = with_spinner(common, "trying Mitsuba", || {
        let probe = Command::new(python).args(["-c", include_str!("probe.py"), FAST]).output();
        probe.is_ok_and(|output| output.status.success())
    });
    let variant = if works { FAST } else { SURE };
    let _ = remembered.parent().map(fs::create_dir_all);
    let _ = fs::write(remembered, variant);
    variant.to_owned()
}
