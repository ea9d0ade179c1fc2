//! A Mitsuba process that has one scene loaded and renders pass after pass of it.

use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use serde_json::{Value, json};

use crate::cli::{Common, Crosscheck};
use crate::error::CliError;

/// How much of what Mitsuba said is shown when it fails, in bytes.
const SAID: u64 = 4096;

/// A running Mitsuba. It ends when this goes.
pub struct Mitsuba {
    child: Child,
    orders: Option<ChildStdin>,
    answers: BufReader<ChildStdout>,
    /// Passes, and what the process says, until the end.
    folder: tempfile::TempDir,
    /// `[width, height]` of what it renders, in pixels.
    pub size: [usize; 2],
    /// What people should know about how the scene was taken.
    pub notes: Vec<String>,
    /// Its version.
    pub version: String,
}

impl Mitsuba {
    /// Loads the scene's own file: ours is the reader that is under test, so its reading is no help here.
    ///
    /// # Errors
    ///
    /// Where Mitsuba refuses the scene, or cannot be run.
    pub fn start(
        python: &Path,
        variant: &str,
        scene: &Path,
        camera: usize,
        options: &Crosscheck,
        common: &Common,
    ) -> Result<Self, CliError> {
        let folder =
            tempfile::tempdir().map_err(|error| broken(format!("no folder for its pictures: {error}")))?;
        let said = File::create(folder.path().join("said")).map_err(|error| broken(error.to_string()))?;
        let job = json!({
            "scene": fs::canonicalize(scene).unwrap_or_else(|_| scene.to_owned()),
            "variant": variant,
            "camera": camera,
            "size": options.size,
            "defines": options.reading.defines,
            "threads": common.threads.unwrap_or(0),
        });
        let mut child = Command::new(python)
            .args(["-c", include_str!("render.py")])
            .arg(job.to_string())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(said)
            .spawn()
            .map_err(|error| broken(format!("{}: {error}", python.display())))?;
        let orders = child.stdin.take();
        let answers = BufReader::new(child.stdout.take().expect("standard output is piped"));
        let mut mitsuba =
            Self { child, orders, answers, folder, size: [0, 0], notes: Vec::new(), version: String::new() };
        let loaded = mitsuba.answer(scene)?;
        mitsuba.size = [0, 1].map(|i| loaded["size"][i].as_u64().unwrap_or(0) as usize);
        mitsuba.version = loaded["version"].as_str().unwrap_or_default().to_owned();
        let notes = loaded["notes"].as_array().into_iter().flatten();
        mitsuba.notes = notes.filter_map(|note| note.as_str().map(str::to_owned)).collect();
        Ok(mitsuba)
    }

    /// One pass: planes R, G and B.
    ///
    /// # Errors
    ///
    /// Where the process dies.
    pub fn pass(&mut self, scene: &Path, seed: u32, spp: u32) -> Result<[Vec<f32>; 3], CliError> {
        let path: PathBuf = self.folder.path().join("pass");
        let order = json!({ "seed": seed, "spp": spp, "path": path });
        // A process that is gone says why below.
        if let Some(orders) = &mut self.orders {
            let _ = writeln!(orders, "{order}").and_then(|()| orders.flush());
        }
        self.answer(scene)?;
        let bytes =
            fs::read(&path).map_err(|error| broken(format!("its picture cannot be read: {error}")))?;
        let pixels = self.size[0] * self.size[1];
        if bytes.len() != pixels * 12 {
            let [width, height] = self.size;
            return Err(broken(format!("its picture of {width}x{height} has {} bytes", bytes.len())));
        }
        let value = |i: usize| f32::from_le_bytes([bytes[i], bytes[i + 1], bytes[i + 2], bytes[i + 3]]);
        Ok(std::array::from_fn(|channel| (0..pixels).map(|p| value(12 * p + 4 * channel)).collect()))
    }

    fn answer(&mut self, scene: &Path) -> Result<Value, CliError> {
        let mut line = String::new();
        let read = self.answers.read_line(&mut line);
        let answer: Option<Value> = read.ok().and_then(|_| serde_json::from_str(&line).ok());
        match answer {
            Some(answer) => match (answer["refused"].as_str(), answer["failed"].as_str()) {
                (None, None) => Ok(answer),
                (None, Some(problem)) => Err(broken(problem.to_owned())),
                // Its own words: the place in the file, the plugin, and what it has against it.
                (Some(problem), _) => Err(CliError::File {
                    path: scene.to_owned(),
                    problem: format!(
                        "Mitsuba does not take this scene, so there is nothing to compare with: {problem}; \
                         a picture of another renderer can take its place with `--against`"
                    ),
                }),
            },
            None => {
                let status = self.child.wait().map_or_else(|error| error.to_string(), |s| s.to_string());
                let said = self.said().unwrap_or_default();
                let last = said.lines().rev().find(|line| !line.trim().is_empty()).unwrap_or_default();
                Err(broken(format!("it died ({status}) {}", last.trim())))
            }
        }
    }

    /// The end of what the process said on standard error.
    fn said(&self) -> io::Result<String> {
        use io::{Seek, SeekFrom};
        let mut file = File::open(self.folder.path().join("said"))?;
        let length = file.metadata()?.len();
        file.seek(SeekFrom::Start(length.saturating_sub(SAID)))?;
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes)?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }
}

impl Drop for Mitsuba {
    fn drop(&mut self) {
        self.orders = None; // it ends at the end of its input; one in the middle of a pass is not waited for
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Of a Mitsuba that is there.
fn broken(problem: String) -> CliError {
    let problem = format!("while rendering: {problem}");
    let help = "try again with fewer pixels or samples, or compare with a picture by `--against`";
    CliError::Mitsuba { problem, help: help.into() }
}
