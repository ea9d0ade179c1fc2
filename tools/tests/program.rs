//! The program starts. Its behaviour is tested in `tests/` at the root of the workspace, which starts the binary that cargo
//! builds for *this* test: without one here, `cargo test --workspace` would build no binary.

use std::process::Command;

#[test]
fn program_says_its_version_and_lists_its_verbs() {
    let said = |argument| {
        let output =
            Command::new(env!("CARGO_BIN_EXE_limpid")).arg(argument).output().expect("the program starts");
        assert!(output.status.success(), "{argument}: {output:?}");
        String::from_utf8(output.stdout).expect("text")
    };
    assert_eq!(said("--version").trim(), concat!("limpid ", env!("CARGO_PKG_VERSION")));
    for verb in ["render", "denoise", "info", "metrics", "methods"] {
        assert!(said("--help").contains(verb), "{verb}");
    }
}
