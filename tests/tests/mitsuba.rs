//! limpid beside Mitsuba 3, over the table of small scenes. Where Mitsuba cannot be had the tests say so and pass.
//!
//! The whole table, as the docs show it:
//!
//! ```sh
//! cargo test --release -p limpid-tests --test mitsuba -- --ignored --nocapture
//! ```

use std::path::{Path, PathBuf};

use limpid_tests::start::{call, lacks_mitsuba};
use limpid_tests::table::{self, Row};
use serde_json::Value;

/// What `crosscheck` says of the scene; `None` where there is no Mitsuba.
fn crosschecked(folder: &Path, scene: &Path, seed: &str) -> Option<Value> {
    let words = ["crosscheck", "--power", "--json", "--seed", seed].map(Path::new);
    let call = call(folder, words.into_iter().chain([scene]));
    if lacks_mitsuba(&call) {
        return None;
    }
    assert!(call.code == 0 || call.code == 1, "exit code {}: {}", call.code, call.stderr);
    let report: Value = serde_json::from_str(&call.stdout).unwrap_or_else(|e| panic!("{e}: {}", call.stdout));
    Some(report["scenes"][0].clone())
}

/// Checks the rows and prints them as a table; the seeds are fixed. Each scene's false-alarm rate is 1 %, of which a table of
/// 160 has 1.6 to expect: what alarms is compared again with other seeds, and differs where that alarms, too. So the
/// table's own rate is 1.6 %, and a difference that a comparison finds with a chance of 90 % is found with 81 %.
fn check(rows: Vec<(Row, PathBuf)>, folder: &Path) {
    let (mut lines, mut failed) = (Vec::new(), Vec::new());
    let (mut blocks, mut reach) = (0, 0.0f64);
    for (row, path) in &rows {
        let Some(mut found) = crosschecked(folder, path, "0") else {
            assert!(lines.is_empty(), "{}: Mitsuba rendered the rows before it", row.name);
            return;
        };
        let first = found["p"].as_f64().filter(|_| found["verdict"] == "differ");
        if first.is_some() {
            found = crosschecked(folder, path, "1").expect("Mitsuba was there");
        }
        let again = first.map_or(String::new(), |p| format!(", at first {p:.1e}"));
        let number = |key: &str| found[key].as_f64().unwrap_or(f64::NAN);
        let line = format!(
            "| {} | {:+.2} % | {:.2} % | {:.2}{again} | {} | {} |",
            row.name,
            100.0 * (number("mean_ratio") - 1.0),
            100.0 * number("detectable_bias"),
            number("p"),
            number("spp"),
            found["agree"].as_bool().map_or("?", |yes| if yes { "yes" } else { "**no**" }),
        );
        println!("{line}");
        if found["agree"] != true || !(0.0..=0.005).contains(&number("detectable_bias")) {
            failed.push(format!("{line} {}", found["worst"]));
        }
        blocks += found["blocks"].as_u64().unwrap_or(0);
        reach = reach.max(number("detectable_bias"));
        lines.push(line);
    }
    println!(
        "{} scenes, {blocks} places, every difference of {:.2} % of a picture would show",
        rows.len(),
        100.0 * reach
    );
    assert!(failed.is_empty(), "{} of {} differ:\n{}", failed.len(), rows.len(), failed.join("\n"));
}

#[test]
fn mitsuba_agrees_on_a_few_scenes() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let rows = table::write(folder.path()).expect("writes");
    check(rows.into_iter().filter(|(row, _)| row.in_subset).collect(), folder.path());
}

#[test]
#[ignore = "the whole table takes a quarter of an hour"]
fn mitsuba_agrees_on_the_whole_table() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let only = std::env::var("LIMPID_ROWS").unwrap_or_default();
    let rows = table::write(folder.path()).expect("writes");
    check(rows.into_iter().filter(|(row, _)| row.name.contains(&only)).collect(), folder.path());
}
