//! The answer in words.

use limpid_frame::compare::{Finding, POWER, Parts};

use super::rounds::{MAX_SPP, Outcome, TARGET};

/// What a comparison came to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// No difference, and one of 0.5 % would have been found.
    Agree,
    /// A difference.
    Differ,
    /// Too much noise to tell.
    Open,
}

impl Verdict {
    /// Of a comparison.
    pub fn of(outcome: &Outcome) -> Self {
        match (outcome.differs(), outcome.agrees()) {
            (true, _) => Self::Differ,
            (false, true) => Self::Agree,
            (false, false) => Self::Open,
        }
    }

    /// In a word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Agree => "They agree",
            Self::Differ => "They differ",
            Self::Open => "Not decided",
        }
    }

    /// For style sheets.
    pub fn class(self) -> &'static str {
        match self {
            Self::Agree => "agree",
            Self::Differ => "differ",
            Self::Open => "open",
        }
    }
}

/// The answer in two or three sentences.
pub fn sentences(outcome: &Outcome) -> String {
    let comparison = &outcome.comparison;
    let reach = percent(outcome.detectable_bias());
    let chance = format!("{:.0} %", 100.0 * POWER);
    match Verdict::of(outcome) {
        Verdict::Agree => format!(
            "No difference beyond noise at {} samples per pixel; one of {reach} of the whole picture would have been found \
             with a chance of {chance}.",
            outcome.spp
        ),
        Verdict::Differ => format!(
            "The pictures differ beyond noise (p = {} for all tests together): limpid is {} over the whole picture. {}",
            probability(comparison.p),
            brightness(comparison.mean_ratio),
            clearest(outcome),
        ),
        Verdict::Open => format!(
            "No difference was found, but the noise at {} samples per pixel could hide one of {reach} of the whole picture, \
             and the answer counts from {}. {}",
            outcome.spp,
            percent(TARGET),
            cure(outcome),
        ),
    }
}

fn cure(outcome: &Outcome) -> String {
    match outcome.spp_needed() {
        Some(needed) if needed <= f64::from(MAX_SPP) => {
            format!("It takes about {needed:.0} samples: `--spp {needed:.0}`, or `--power`, which renders as many as it takes.")
        }
        Some(needed) => format!(
            "It would take about {needed:.0} samples; a smaller picture does not help, a simpler scene or light that is easier \
             to find does."
        ),
        None => "No number of samples here will do: the picture it is compared with is too noisy itself, or black.".into(),
    }
}

fn clearest(outcome: &Outcome) -> String {
    let all = outcome.comparison.families.iter();
    let found: Option<(&Finding, Parts)> = all
        .flat_map(|family| family.findings.iter().map(move |finding| (finding, family)))
        .max_by(|(a, x), (b, y)| {
            let clear = |p: f64, level: f64| p.max(f64::MIN_POSITIVE).ln() / level.ln();
            clear(a.p, x.level).total_cmp(&clear(b.p, y.level))
        })
        .map(|(finding, family)| (finding, family.parts));
    let Some((finding, parts)) = found else { return String::new() };
    let channel = ["red", "green", "blue"][finding.channel];
    let bias = format!("{:+.2} % in {channel}", 100.0 * finding.bias());
    match parts {
        Parts::Whole | Parts::Weighted => format!("It is clearest in the {}: {bias}.", parts_in_words(parts)),
        Parts::Sixteenths | Parts::Blocks(_) => {
            let area = finding.area;
            format!(
                "It is clearest in {}x{} pixels at {},{}: {bias}.",
                area.width, area.height, area.x, area.y
            )
        }
    }
}

/// What a family looks at.
pub fn parts_in_words(parts: Parts) -> String {
    match parts {
        Parts::Whole => "whole picture".into(),
        Parts::Weighted => "whole picture, quiet blocks weighing more".into(),
        Parts::Sixteenths => "sixteenths of the picture".into(),
        Parts::Blocks(side) => format!("blocks of {side} pixels"),
    }
}

/// A fraction in per cent, with two digits that count.
pub fn percent(fraction: f64) -> String {
    let value = 100.0 * fraction;
    match value {
        v if !v.is_finite() => "any amount".into(),
        v if v >= 10.0 => format!("{v:.0} %"),
        v if v >= 1.0 => format!("{v:.1} %"),
        v if v >= 0.01 => format!("{v:.2} %"),
        0.0 => "0 %".into(),
        v => format!("{v:.1e} %"),
    }
}

/// How limpid's mean, over the other's, is to be called.
pub fn brightness(ratio: f64) -> String {
    match 100.0 * (ratio - 1.0) {
        percent if percent.is_infinite() => "bright, where the other is black".into(),
        percent if percent.is_nan() || percent.abs() < 5e-4 => "as bright".into(),
        percent => format!("{:.3} % {}", percent.abs(), if percent < 0.0 { "darker" } else { "brighter" }),
    }
}

/// A p value.
pub fn probability(p: f64) -> String {
    if p < f64::MIN_POSITIVE { "below 1e-300".into() } else { number(p) }
}

/// A number with three digits that count.
pub fn number(value: f64) -> String {
    match value.abs() {
        0.0 => "0".into(),
        v if !(1e-3..1e5).contains(&v) => format!("{value:.1e}"),
        v => format!("{value:.*}", (2 - v.log10().floor() as i32).max(0) as usize),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits_that_count() {
        let shown = [0.0, 0.8, 0.00123456, -12.345, 123.456, 4567.8, 5.2e-7, 1e9].map(number);
        assert_eq!(shown, ["0", "0.800", "0.00123", "-12.3", "123", "4568", "5.2e-7", "1.0e9"]);
        let shown = [0.98, 1.0012, 1.0, 1.0000049, f64::INFINITY, f64::NAN].map(brightness);
        let same = "as bright";
        assert_eq!(
            shown,
            ["2.000 % darker", "0.120 % brighter", same, same, "bright, where the other is black", same]
        );
        let shown = [0.0, 0.00469, 0.125, 0.0123, 1e-6, f64::INFINITY].map(percent);
        assert_eq!(shown, ["0 %", "0.47 %", "12 %", "1.2 %", "1.0e-4 %", "any amount"]);
    }
}
