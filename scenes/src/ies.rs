//! Photometric files: IES LM-63 of 1986 to 2002, with photometry of type C, that of luminaires.

use std::ops::Range;

/// How much a lamp sends into each direction, over the whole circle of azimuths.
#[derive(Clone, Debug, PartialEq)]
pub struct IesProfile {
    /// Angles from the lamp's axis in degrees, rising, within [0, 180]. Nothing is sent beyond the first and the last.
    pub vertical_deg: Vec<f32>,
    /// Angles around the axis in degrees, rising; the last is the first once around, 360 more.
    pub horizontal_deg: Vec<f32>,
    /// Candelas at `[horizontal][vertical]`, not negative.
    pub candelas: Vec<f32>,
}

impl IesProfile {
    /// Candelas into a direction, its angles in degrees: bilinear in these.
    pub fn at(&self, vertical_deg: f64, horizontal_deg: f64) -> f64 {
        let [Some(&first), Some(&last)] = [self.horizontal_deg.first(), self.horizontal_deg.last()] else {
            return 0.0;
        };
        let around = f64::from(first) + (horizontal_deg - f64::from(first)).rem_euclid(360.0);
        let Some((v, t)) = cell(&self.vertical_deg, vertical_deg) else { return 0.0 };
        let Some((h, s)) = cell(&self.horizontal_deg, around.min(last.into())) else { return 0.0 };
        let count = self.vertical_deg.len();
        let at = |h: usize, v: usize| f64::from(self.candelas[h * count + v.min(count - 1)]);
        let plane = |h| at(h, v) * (1.0 - t) + at(h, v + 1) * t;
        plane(h) * (1.0 - s) + plane(h + 1) * s
    }

    /// Mean of the candelas over all directions, 1/4π ∫∫ I sin θ dθ dφ: exact, since they are linear between the angles.
    pub fn mean(&self) -> f64 {
        let weights: Vec<[f64; 2]> = self.vertical_deg.windows(2).map(hat_integrals).collect();
        let plane = |h: usize| -> f64 {
            let candelas = self.candelas[h * self.vertical_deg.len()..].windows(2);
            candelas.zip(&weights).map(|(c, w)| f64::from(c[0]) * w[0] + f64::from(c[1]) * w[1]).sum()
        };
        let widths = self.horizontal_deg.windows(2).map(|ends| f64::from(ends[1]) - f64::from(ends[0]));
        widths.enumerate().map(|(h, width)| width / 360.0 * 0.25 * (plane(h) + plane(h + 1))).sum()
    }

    /// Whether nothing is sent anywhere.
    pub fn is_dark(&self) -> bool {
        self.candelas.iter().all(|&candelas| candelas == 0.0)
    }
}

/// ∫ (1 − t) sin θ dθ and ∫ t sin θ dθ from one angle to the next, in degrees, where t goes from 0 to 1.
fn hat_integrals(ends: &[f32]) -> [f64; 2] {
    let [a, b] = [ends[0], ends[1]].map(|angle| f64::from(angle).to_radians());
    // about the middle: sin θ = sin m cos x + cos m sin x, for differences of cosines cancel in a narrow beam
    let (middle, h) = (0.5 * (a + b), 0.5 * (b - a));
    // ∫ x/2h sin x dx, by its series where it would cancel
    let odd = if h < 0.01 { h * h / 3.0 * (1.0 - 0.1 * h * h) } else { h.sin() / h - h.cos() };
    let (even, odd) = (middle.sin() * h.sin(), middle.cos() * odd);
    [even - odd, even + odd]
}

/// The interval of rising `angles` that holds an angle, and where in it; `None` outside and for NaN.
fn cell(angles: &[f32], angle: f64) -> Option<(usize, f64)> {
    let (first, last) = (f64::from(*angles.first()?), f64::from(*angles.last()?));
    if !(first..=last).contains(&angle) {
        return None;
    }
    let i = angles.partition_point(|&a| f64::from(a) <= angle).min(angles.len() - 1).max(1) - 1;
    let low = f64::from(angles[i]);
    let width = angles.get(i + 1).map_or(0.0, |&a| f64::from(a) - low);
    Some((i, if width > 0.0 { (angle - low) / width } else { 0.0 }))
}

/// What is wrong with a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct IesError {
    /// Counted from 1.
    pub line: u32,
    pub problem: String,
    pub help: &'static str,
}

const EXPORT_AGAIN: &str = "get the file from the maker of the lamp again";
const TURNED_TYPE: &str = "convert it to type C; most tools for photometric files do";
const OF_TYPE_C: &str = "in type C vertical angles are from 0, along the axis, to 180, and horizontal ones from 0 to 360; a file \
                         with negative angles is of type A or B: convert it to type C";

/// Reads the text of a file.
pub(crate) fn parse(text: &[u8]) -> Result<IesProfile, IesError> {
    let mut numbers = Numbers::after_tilt(text)?;
    let _lamps = numbers.next("the number of lamps")?;
    let _lumens = numbers.next("the lumens of a lamp")?;
    let multiplier = numbers.next("the multiplier")?;
    let vertical = numbers.count("the number of vertical angles")?;
    let horizontal = numbers.count("the number of horizontal angles")?;
    let kind = numbers.next("the photometric type")?;
    if kind != 1.0 {
        let name = if kind == 2.0 { "B" } else { "A" };
        return Err(numbers.error(format!("photometry of type {name} ({kind})"), TURNED_TYPE));
    }
    for what in ["the units", "the width", "the length", "the height"] {
        numbers.next(what)?;
    }
    // The third, once kept for the future, is a factor of the ballast's lamp in 1995 and 1 in most files.
    let factor =
        multiplier * numbers.next("the ballast factor")? * numbers.next("the second ballast factor")?;
    let _watts = numbers.next("the input watts")?;
    if !(factor.is_finite() && factor >= 0.0) {
        return Err(numbers.error(format!("a factor of {factor} on all values"), EXPORT_AGAIN));
    }
    if vertical.saturating_mul(horizontal).saturating_add(vertical + horizontal) > numbers.left() {
        let problem = format!("{vertical} × {horizontal} values with their angles, more than the file has");
        return Err(numbers.error(problem, EXPORT_AGAIN));
    }
    let vertical_deg = numbers.angles("vertical", vertical, 0.0..180.0)?;
    let measured = numbers.angles("horizontal", horizontal, 0.0..360.0)?;
    let mut planes = Vec::with_capacity(horizontal);
    for _ in 0..horizontal {
        let mut plane = Vec::with_capacity(vertical);
        for _ in 0..vertical {
            let candelas = (numbers.next("a value in candelas")? * factor) as f32;
            if !(candelas.is_finite() && candelas >= 0.0) {
                return Err(numbers.error(format!("a value of {candelas} candelas"), EXPORT_AGAIN));
            }
            plane.push(candelas);
        }
        planes.push(plane);
    }
    let around = whole_circle(&measured).map_err(|problem| numbers.error(problem, EXPORT_AGAIN))?;
    Ok(IesProfile {
        vertical_deg,
        horizontal_deg: around.iter().map(|&(angle, _)| angle).collect(),
        candelas: around.iter().flat_map(|&(_, plane)| planes[plane].iter().copied()).collect(),
    })
}

/// The circle of azimuths from what was measured, with the index of each one's plane: all around, or one half (0 to 180, or 90
/// to 270: the same on both sides of the plane through its ends) or quarter that is mirrored, or a single plane.
fn whole_circle(measured: &[f32]) -> Result<Vec<(f32, usize)>, String> {
    let (first, last) = (measured[0], measured[measured.len() - 1]);
    let planes = || measured.iter().copied().zip(0usize..);
    let mut around: Vec<(f32, usize)> = if measured.len() == 1 {
        vec![(0.0, 0), (360.0, 0)]
    } else if (first, last) == (0.0, 90.0) {
        planes().flat_map(|(a, i)| [a, 180.0 - a, 180.0 + a, 360.0 - a].map(|a| (a, i))).collect()
    } else if (first, last) == (0.0, 180.0) {
        planes().flat_map(|(a, i)| [a, 360.0 - a].map(|a| (a, i))).collect()
    } else if (first, last) == (90.0, 270.0) {
        let turned = |a: f32| if a < 0.0 { a + 360.0 } else { a };
        planes().flat_map(|(a, i)| [a, turned(180.0 - a)].map(|a| (a, i))).collect()
    } else if first == 0.0 && last > 180.0 {
        planes().collect()
    } else {
        return Err(format!("horizontal angles from {first} to {last} degrees"));
    };
    around.sort_by(|a, b| a.0.total_cmp(&b.0));
    around.dedup_by_key(|(angle, _)| *angle);
    // the circle closes at the first plane, which is at 0 but for a half without a plane in its middle
    let once_around = around[0].0 + 360.0;
    if around.last().is_some_and(|(angle, _)| *angle < once_around) {
        around.push((once_around, around[0].1));
    }
    Ok(around)
}

/// The numbers of a file, one after the other.
struct Numbers<'a> {
    words: Vec<(&'a str, u32)>,
    next: usize,
    last_line: u32,
}

impl<'a> Numbers<'a> {
    /// Those behind the line `TILT=`, and behind the table that `TILT=INCLUDE` brings: how much a lamp loses when it is tilted.
    fn after_tilt(text: &'a [u8]) -> Result<Self, IesError> {
        // keywords may be in any encoding; numbers are ASCII
        let lines = text.split(|&byte| byte == b'\n' || byte == b'\r').zip(1u32..);
        // "\r\n" ends one line, not two
        let is_windows = text.windows(2).any(|pair| pair == b"\r\n");
        let number = |line: u32| if is_windows { line.div_ceil(2) } else { line };
        let mut lines =
            lines.map(|(line, i)| (std::str::from_utf8(line).unwrap_or_default().trim(), number(i)));
        let is_tilt = |line: &str| line.get(..5).is_some_and(|word| word.eq_ignore_ascii_case("TILT="));
        let Some((tilt, line)) = lines.find(|(line, _)| is_tilt(line)) else {
            let problem = "no line TILT=, so it is no IES file".into();
            return Err(IesError { line: 1, problem, help: "name a file of IES LM-63" });
        };
        let mut words = Vec::new();
        let mut last_line = line;
        for (text, line) in lines {
            let of_line = text.split(|c: char| c.is_whitespace() || c == ',').filter(|word| !word.is_empty());
            words.extend(of_line.map(|word| (word, line)));
            last_line = line;
        }
        let mut numbers = Self { words, next: 0, last_line };
        if tilt[5..].trim().eq_ignore_ascii_case("INCLUDE") {
            numbers.next("the lamp's position")?;
            for _ in 0..2 * numbers.count("the number of tilts")? {
                numbers.next("the tilt's table")?;
            }
        }
        Ok(numbers)
    }

    fn next(&mut self, what: &str) -> Result<f64, IesError> {
        let Some((word, line)) = self.words.get(self.next) else {
            let problem = format!("the file ends where {what} belongs");
            return Err(IesError { line: self.last_line, problem, help: EXPORT_AGAIN });
        };
        self.next += 1;
        word.parse().ok().filter(|value: &f64| value.is_finite()).ok_or_else(|| {
            let shown: String = word.chars().take(40).collect();
            let problem = format!("\"{shown}\", where {what} belongs");
            IesError { line: *line, problem, help: EXPORT_AGAIN }
        })
    }

    fn count(&mut self, what: &str) -> Result<usize, IesError> {
        let value = self.next(what)?;
        if value >= 1.0 && value.fract() == 0.0 && value <= self.words.len() as f64 {
            Ok(value as usize)
        } else {
            Err(self.error(format!("{what} is {value}"), EXPORT_AGAIN))
        }
    }

    fn angles(&mut self, what: &str, count: usize, within: Range<f32>) -> Result<Vec<f32>, IesError> {
        let mut angles: Vec<f32> = Vec::with_capacity(count);
        for _ in 0..count {
            let angle = self.next("an angle")? as f32;
            if !(within.start..=within.end).contains(&angle) {
                return Err(self.error(format!("a {what} angle of {angle} degrees"), OF_TYPE_C));
            }
            if let Some(before) = angles.last().filter(|&&before| before >= angle) {
                let problem = format!("a {what} angle of {angle} degrees after one of {before}");
                return Err(self.error(problem, "angles rise from each to the next"));
            }
            angles.push(angle);
        }
        Ok(angles)
    }

    fn left(&self) -> usize {
        self.words.len() - self.next
    }

    /// At the number that was read last.
    fn error(&self, problem: String, help: &'static str) -> IesError {
        let line = self.next.checked_sub(1).map_or(self.last_line, |i| self.words[i].1);
        IesError { line, problem, help }
    }
}

#[cfg(test)]
mod tests;
