//! The page: one file with everything in it.

use std::fmt::Write;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use limpid_frame::compare::{Family, Finding, Parts};

use super::super::rounds::{Outcome, TARGET};
use super::super::verdict::{Verdict, brightness, number, parts_in_words, percent, probability};
use super::About;

/// Places that are listed.
const LISTED: usize = 8;
const CHANNELS: [&str; 3] = ["red", "green", "blue"];

/// What the pictures show.
pub struct Shown<'a> {
    /// PNG files: ours, the other, difference, p values.
    pub pictures: Vec<Vec<u8>>,
    /// Brightness of the first two, in stops.
    pub ev: f32,
    /// The difference at which its colours are full.
    pub full: f64,
    /// The family that the p values are of.
    pub blocks: &'a Family,
}

/// The page of one scene.
pub fn page(about: &About, outcome: &Outcome, shown: &Shown) -> String {
    let comparison = &outcome.comparison;
    let [width, height] = outcome.ours.size();
    let verdict = Verdict::of(outcome);
    let places = places(outcome, shown.blocks);
    let name = |path: &Path| escaped(&path.display().to_string());
    let stem = crate::output::default_stem(about.scene);
    let fields = [
        ("TITLE", name(&stem)),
        ("SCENE", name(about.scene)),
        ("OTHER", escaped(about.other)),
        ("CLASS", verdict.class().to_owned()),
        ("WORD", verdict.word().to_owned()),
        ("VERDICT", code(&escaped(about.verdict))),
        ("WIDTH", width.to_string()),
        ("HEIGHT", height.to_string()),
        ("SPP", outcome.spp.to_string()),
        ("RATIO", brightness(comparison.mean_ratio)),
        ("REACH", percent(outcome.detectable_bias())),
        ("TARGET", percent(TARGET)),
        ("P", probability(comparison.p)),
        ("FAMILIES", families(&comparison.families)),
        ("PLACES", places_table(&places)),
        ("BOXES", boxes(&places)),
        ("NOTES", list(about.notes)),
        ("WARNINGS", warnings(about.warnings)),
        ("LEFT_OUT", left_out(outcome)),
        ("EV", format!("{:+.1}", shown.ev)),
        ("FULL", number(shown.full)),
        ("BLOCK", escaped(&parts_in_words(shown.blocks.parts))),
        ("LEVEL", number(shown.blocks.level)),
        ("VERSION", env!("CARGO_PKG_VERSION").to_owned()),
        ("PICTURE_0", STANDARD.encode(&shown.pictures[0])),
        ("PICTURE_1", STANDARD.encode(&shown.pictures[1])),
        ("PICTURE_2", STANDARD.encode(&shown.pictures[2])),
        ("PICTURE_3", STANDARD.encode(&shown.pictures[3])),
    ];
    filled(include_str!("page.html"), &fields)
}

/// What does not count, as items of a list.
fn left_out(outcome: &Outcome) -> String {
    let mut items = String::new();
    if outcome.share < 1.0 {
        let background = percent(1.0 - outcome.share);
        let _ = write!(
            items,
            "<li>{background} of the light comes from pixels that show nothing but the background. They are compared like all others, but how \
             well they are known does not count for what would have been found</li>"
        );
    }
    if outcome.comparison.left_out > 0 {
        let _ = write!(
            items,
            "<li>{} pixels were left out because they are not finite in one of the pictures, or lie in the border of a wide filter</li>",
            outcome.comparison.left_out
        );
    }
    items
}

/// What stands between backticks, as code.
fn code(text: &str) -> String {
    let parts = text.split('`').enumerate();
    parts.map(|(i, part)| if i % 2 == 1 { format!("<code>{part}</code>") } else { part.to_owned() }).collect()
}

/// The page of several scenes: a table with links. Each row is a scene, its folder, its outcome and the verdict.
pub fn index(rows: &[(String, String, Verdict, f64, f64, f64)]) -> String {
    let mut table = String::new();
    for (scene, folder, verdict, ratio, reach, p) in rows {
        let _ = write!(
            table,
            "<tr class=\"{}\"><td><a href=\"{}/index.html\">{}</a></td><td><b>{}</b></td><td>{}</td><td>{}</td>\
             <td>{}</td></tr>",
            verdict.class(),
            escaped(folder),
            escaped(scene),
            verdict.word(),
            brightness(*ratio),
            percent(*reach),
            probability(*p),
        );
    }
    filled(include_str!("index.html"), &[("ROWS", table), ("TARGET", percent(TARGET))])
}

/// `{{NAME}}` becomes its value; values are not searched again. A name without a value stays, for tests to see.
fn filled(template: &str, fields: &[(&str, String)]) -> String {
    let mut page = String::new();
    let mut rest = template;
    while let Some((before, after)) = rest.split_once("{{") {
        let (key, after) = after.split_once("}}").unwrap_or((after, ""));
        page.push_str(before);
        match fields.iter().find(|(name, _)| *name == key) {
            Some((_, value)) => page.push_str(value),
            None => page.extend(["{{", key, "}}"]),
        }
        rest = after;
    }
    page + rest
}

fn families(families: &[Family]) -> String {
    let mut rows = String::new();
    for family in families {
        let mut reaches: Vec<f64> =
            family.findings.iter().map(|f| f.detectable).filter(|r| r.is_finite()).collect();
        reaches.sort_by(f64::total_cmp);
        let (middle, worst) = (reaches.get(reaches.len() / 2), reaches.last());
        let in_words = |reach: Option<&f64>| reach.map_or("–".to_owned(), |reach| percent(*reach));
        let least = family.findings.iter().map(|finding| finding.p).fold(1.0, f64::min);
        let alarms = family.findings.iter().filter(|finding| finding.p < family.level).count();
        let _ = write!(
            rows,
            "<tr{}><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>",
            if alarms > 0 { " class=\"differ\"" } else { "" },
            escaped(&parts_in_words(family.parts)),
            family.findings.len(),
            probability(least),
            number(family.level),
            alarms,
            in_words(middle),
            in_words(worst),
        );
    }
    rows
}

/// Where the pictures differ most clearly: small blocks, and larger ones that hold none of those.
fn places(outcome: &Outcome, finest: &Family) -> Vec<(Finding, bool)> {
    let families = outcome.comparison.families.iter();
    let divided = families.filter(|family| !matches!(family.parts, Parts::Whole | Parts::Weighted));
    let mut all: Vec<(Finding, f64)> = divided
        .chain([finest])
        .flat_map(|family| family.findings.iter().map(|f| (*f, family.level)))
        .collect();
    // By how far each is towards an alarm of its own family.
    let clear = |(finding, level): &(Finding, f64)| finding.p.max(f64::MIN_POSITIVE).ln() / level.ln();
    all.sort_by(|a, b| clear(b).total_cmp(&clear(a)));
    let mut chosen: Vec<(Finding, bool)> = Vec::new();
    for (finding, level) in all {
        if chosen.len() < LISTED && !chosen.iter().any(|(other, _)| overlap(&finding, other)) {
            chosen.push((finding, finding.p < level));
        }
    }
    chosen
}

fn overlap(a: &Finding, b: &Finding) -> bool {
    let (a, b) = (a.area, b.area);
    a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height
}

fn places_table(places: &[(Finding, bool)]) -> String {
    let mut rows = String::new();
    for (i, (finding, alarm)) in places.iter().enumerate() {
        let area = finding.area;
        let _ = write!(
            rows,
            "<tr{}><td>{}</td><td>{}, {}</td><td>{}&thinsp;×&thinsp;{}</td><td>{}</td><td>{}</td><td>{}</td>\
             <td>{:+.2} % ± {}</td><td>{}</td><td>{}</td></tr>",
            if *alarm { " class=\"differ\"" } else { "" },
            i + 1,
            area.x,
            area.y,
            area.width,
            area.height,
            CHANNELS[finding.channel],
            number(finding.means[0]),
            number(finding.means[1]),
            100.0 * finding.bias(),
            percent(finding.error() / finding.means[1].abs().max(f64::MIN_POSITIVE)),
            probability(finding.p),
            if *alarm { "alarm" } else { "chance" },
        );
    }
    rows
}

fn boxes(places: &[(Finding, bool)]) -> String {
    let mut svg = String::new();
    for (i, (finding, alarm)) in places.iter().enumerate() {
        let area = finding.area;
        let _ = write!(
            svg,
            "<g class=\"{}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/><text x=\"{}\" y=\"{}\">{}</text></g>",
            if *alarm { "alarm" } else { "chance" },
            area.x,
            area.y,
            area.width,
            area.height,
            area.x as f64 + 0.5 * area.width as f64,
            area.y as f64 + 0.5 * area.height as f64,
            i + 1,
        );
    }
    svg
}

fn list(items: &[String]) -> String {
    items.iter().map(|item| format!("<li>{}</li>", escaped(item))).collect()
}

fn warnings(warnings: &[String]) -> String {
    if warnings.is_empty() {
        return String::new();
    }
    let intro = "limpid reads these parts of the scene otherwise than they stand there. Look here first if the pictures differ:";
    format!("<h3>Warnings of the reader</h3><p>{intro}</p><ul>{}</ul>", list(warnings))
}

fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_cannot_write_into_the_page() {
        let page = filled("<p>{{A}}</p>{{B}}", &[("A", escaped("<script>{{B}}\"")), ("B", "x".into())]);
        assert_eq!(page, "<p>&lt;script&gt;{{B}}&quot;</p>x");
    }

    #[test]
    fn the_page_of_several_scenes_is_filled_and_links_each() {
        let row = ("hall".to_owned(), "hall".to_owned(), Verdict::Agree, 1.001, 0.004, 0.3);
        let page = index(&[row]);
        assert!(
            !page.contains("{{") && page.contains("href=\"hall/index.html\"") && page.contains("They agree")
        );
    }
}
