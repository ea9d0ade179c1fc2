//! Starting the program as a user does.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The program. `cargo test --workspace` builds it.
pub fn limpid() -> Command {
    let mut folder = std::env::current_exe().expect("this test has a path");
    folder.pop(); // the test's name
    if folder.ends_with("deps") || folder.ends_with("examples") {
        folder.pop();
    }
    let program = folder.join(format!("limpid{}", std::env::consts::EXE_SUFFIX));
    assert!(program.is_file(), "{} is not there: build it with `cargo build -p limpid`", program.display());
    Command::new(program)
}

/// What a call came to.
pub struct Call {
    /// Its exit code.
    pub code: i32,
    /// What it wrote to standard output.
    pub stdout: String,
    /// What it wrote to standard error.
    pub stderr: String,
}

impl Call {
    /// What a process that has ended came to.
    pub fn of(output: &Output) -> Self {
        Self {
            code: output.status.code().unwrap_or(-1), // ended by a signal
            stdout: String::from_utf8_lossy(&output.stdout).into_owned(),
            stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
        }
    }
}

/// Whether a `crosscheck` says that there is no Mitsuba here, which is printed. One that is there and fails is not missing.
pub fn lacks_mitsuba(call: &Call) -> bool {
    let lacks = call.code == 3 && !call.stderr.contains("Mitsuba: while rendering");
    if lacks {
        println!("skipped: no mitsuba: {}", call.stderr.trim());
    }
    lacks
}

/// Calls the program in `folder`.
pub fn call<A: AsRef<OsStr>>(folder: &Path, arguments: impl IntoIterator<Item = A>) -> Call {
    let output = limpid().args(arguments).current_dir(folder).output().expect("the program starts");
    Call::of(&output)
}

/// Calls it with words that are parted by spaces; it must end well.
pub fn done(folder: &Path, line: &str) -> Call {
    let call = call(folder, line.split(' '));
    assert_eq!(call.code, 0, "limpid {line}: {}", call.stderr);
    call
}

/// A folder with `ball.xml`: a grey ball above a floor, under a lamp, 24x16 pixels, 4 samples.
pub fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(folder.path().join("ball.xml"), BALL).expect("writes");
    folder
}

/// What is in a folder, sorted.
pub fn names_in(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("the folder is there");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// The Cornell box of the library.
pub fn cornell_box() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/library/cornell-box/scene.xml")
}

const BALL: &str = r#"<scene version="3.0.0">
    <default name="grey" value="0.6"/>
    <sensor type="perspective" id="eye">
        <float name="fov" value="45"/>
        <transform name="to_world"><lookat origin="0, 1, 4" target="0, 0.5, 0" up="0, 1, 0"/></transform>
        <film type="hdrfilm"><integer name="width" value="24"/><integer name="height" value="16"/></film>
        <sampler type="independent"><integer name="sample_count" value="4"/></sampler>
    </sensor>
    <shape type="sphere">
        <point name="center" x="0" y="0.7" z="0"/><float name="radius" value="0.7"/>
        <bsdf type="roughconductor"><float name="alpha" value="0.3"/></bsdf>
    </shape>
    <shape type="rectangle">
        <transform name="to_world"><rotate x="1" angle="-90"/><scale value="5"/></transform>
        <bsdf type="diffuse"><rgb name="reflectance" value="$grey"/></bsdf>
    </shape>
    <shape type="rectangle">
        <transform name="to_world"><rotate x="1" angle="90"/><translate y="4"/></transform>
        <emitter type="area"><rgb name="radiance" value="8"/></emitter>
    </shape>
</scene>
"#;
