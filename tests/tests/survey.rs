//! What people's Mitsuba scenes hold, row by row: it loads, means what it says, and renders.
//!
//! The rows are in `src/survey/`. Those of a test share a folder with the files that they name.

use limpid_tests::survey::{CONSTRUCTS, Kit, check_construct, check_plugin, plugins};

fn check_all(tags: &[&str]) {
    let (kit, mut failures) = (Kit::new(), Vec::new());
    let of_tags = plugins().filter(|plugin| tags.contains(&plugin.tag));
    let rows: usize = of_tags.map(|plugin| check_plugin(&kit, plugin, &mut failures)).sum();
    conclude(rows, &tags.join(", "), &failures);
}

fn conclude(rows: usize, what: &str, failures: &[String]) {
    println!("{rows} rows of {what}");
    assert!(rows > 0 && failures.is_empty(), "{} of {rows} fail:\n{}", failures.len(), failures.join("\n"));
}

#[test]
fn every_construct_of_the_language_says_what_its_plain_form_does() {
    let kit = Kit::new();
    let result = |row| check_construct(&kit, row);
    let failures: Vec<_> = CONSTRUCTS
        .iter()
        .filter_map(|row| result(row).err().map(|problem| format!("{}: {problem}", row.name)))
        .collect();
    conclude(CONSTRUCTS.len(), "the language", &failures);
}

#[test]
fn every_integrator_and_its_parameters_mean_what_they_say() {
    check_all(&["integrator"]);
}

#[test]
fn every_camera_film_filter_and_sampler_means_what_it_says() {
    check_all(&["sensor", "film", "rfilter", "sampler"]);
}

#[test]
fn every_shape_and_its_parameters_mean_what_they_say() {
    check_all(&["shape"]);
}

#[test]
fn every_bsdf_and_its_parameters_mean_what_they_say() {
    check_all(&["bsdf"]);
}

#[test]
fn every_texture_and_its_parameters_mean_what_they_say() {
    check_all(&["texture"]);
}

#[test]
fn every_emitter_and_its_parameters_mean_what_they_say() {
    check_all(&["emitter"]);
}
