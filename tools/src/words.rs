//! What the program says: words for people on standard error, results on standard output.
//!
//! A closed pipe at either is no error: whoever read it has seen enough.

use std::fmt::Display;
use std::fs::File;
use std::io::{self, BufRead, BufReader, ErrorKind, Read, Write};
use std::process::ExitCode;

use limpid_scenes::{SceneError, Warning};

use crate::cli::Common;
use crate::error::CliError;

/// Warnings that are shown one by one; a scene by others may have thousands of a kind.
const MAX_WARNINGS: usize = 20;
/// How much of a scene file is searched for the line to show, in bytes.
const MAX_SEARCHED: u64 = 64 << 20;
/// How much of a line is shown, in characters: a file may be one line of megabytes.
const MAX_SHOWN: usize = 100;

/// A result: one line of standard output.
pub fn result(text: impl Display) -> Result<(), CliError> {
    match writeln!(io::stdout(), "{text}") {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(CliError::Stdout(error)),
        _ => Ok(()),
    }
}

/// Something good to know.
pub fn note(common: &Common, text: impl Display) {
    if !common.quiet {
        say(text);
    }
}

/// The first warnings of a scene, and how many there are beyond.
pub fn warnings(common: &Common, warnings: &[Warning]) {
    if common.quiet {
        return;
    }
    for warning in warnings.iter().take(MAX_WARNINGS) {
        say(format_args!("warning: {}", describe(warning)));
    }
    if let Some(rest @ 1..) = warnings.len().checked_sub(MAX_WARNINGS) {
        say(format_args!("warning: and {rest} more: `limpid info --json` lists them all"));
    }
}

/// `file:line:column: element: message`
pub fn describe(warning: &Warning) -> String {
    let Warning { place, element, message, .. } = warning;
    let file = place.file.display();
    match (place.line, place.column) {
        (0, 0) => format!("{file}: {element}: {message}"),
        (0, byte) => format!("{file}: byte {byte}: {element}: {message}"),
        (line, column) => format!("{file}:{line}:{column}: {element}: {message}"),
    }
}

/// Says why the program ends, and gives its exit code.
pub fn fail(error: &CliError) -> ExitCode {
    let word = if matches!(error.exit_code(), 1 | 130) { "" } else { "error: " };
    match error {
        CliError::Scene(scene) => say(format_args!("{word}{}", with_excerpt(scene))),
        _ => say(format_args!("{word}{error}")),
    }
    ExitCode::from(error.exit_code())
}

/// One message on standard error. What a scene file put into it must not steer the terminal.
fn say(text: impl Display) {
    let text: String =
        text.to_string().chars().map(|c| if c.is_control() && c != '\n' { ' ' } else { c }).collect();
    let _ = writeln!(io::stderr(), "{text}");
}

/// The error with the line it is about between its two lines, where that line can be read.
fn with_excerpt(error: &SceneError) -> String {
    let message = error.to_string();
    match (message.split_once('\n'), excerpt(error)) {
        (Some((problem, help)), Some(excerpt)) => format!("{problem}\n{excerpt}\n{help}"),
        _ => message,
    }
}

fn excerpt(error: &SceneError) -> Option<String> {
    let (line, column) = (error.line.checked_sub(1)?, error.column.checked_sub(1)? as usize);
    let file = File::open(&error.file).ok().filter(|f| f.metadata().is_ok_and(|m| m.is_file()))?;
    let mut lines = BufReader::new(file.take(MAX_SEARCHED)).split(b'\n').skip(line as usize);
    let text = String::from_utf8_lossy(&lines.next()?.ok()?).trim_end().to_owned();
    let length = text.chars().count();
    if column > length {
        return None; // the file has changed since it was read
    }
    let begin = if length <= MAX_SHOWN { 0 } else { column.saturating_sub(MAX_SHOWN / 2) };
    let shown: String = text.chars().skip(begin).take(MAX_SHOWN).collect();
    let number = error.line.to_string();
    let margin = " ".repeat(number.len());
    let pointer = " ".repeat(column - begin);
    Some(format!("{margin} |\n{number} | {shown}\n{margin} | {pointer}^"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error_in(text: &str, line: u32, column: u32) -> String {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = folder.path().join("box.xml");
        std::fs::write(&file, text).expect("writes");
        let (element, problem, help) = ("bsdf".into(), "unknown type".into(), "write diffuse".into());
        let shown = with_excerpt(&SceneError { file, line, column, element, problem, help });
        let (_, shown) = shown.split_once("box.xml").expect("names the file");
        shown.to_owned()
    }

    #[test]
    fn a_scene_error_points_into_its_line() {
        let shown = error_in("<scene>\n  <bsdf type=\"difuse\"/>\n</scene>", 2, 3);
        let lines = "  |\n2 |   <bsdf type=\"difuse\"/>\n  |   ^";
        assert_eq!(shown, format!(":2:3: bsdf: unknown type\n{lines}\n  = help: write diffuse"));
    }

    #[test]
    fn of_a_long_line_only_the_part_around_the_error_is_shown() {
        let shown = error_in(&"x".repeat(1 << 20), 1, 500_000);
        assert!(shown.len() < 400, "{} bytes", shown.len());
        assert!(shown.contains('^'));
    }

    #[test]
    fn a_place_that_is_not_in_the_file_is_not_shown() {
        for (line, column) in [(0, 0), (0, 7), (9, 1), (1, 9)] {
            assert!(!error_in("<scene/>\n", line, column + u32::from(column == 9)).contains('^'));
        }
    }
}
