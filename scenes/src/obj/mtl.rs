//! The text of an MTL file: materials as they are written, with their maps.

use crate::Rgb;

/// A material as the file writes it; `None` where it says nothing.
#[derive(Clone, Debug, Default)]
pub(super) struct Mtl {
    pub name: String,
    /// Of `newmtl`.
    pub line: u32,
    pub diffuse: Option<Rgb>,
    pub specular: Option<Rgb>,
    pub emission: Option<Rgb>,
    pub filter: Option<Rgb>,
    /// Numbers by their word, such as `Ns`.
    numbers: Vec<(&'static str, f32)>,
    /// Maps by their word without `map_`, such as `Kd`, `bump`, `norm`.
    maps: Vec<(&'static str, MapStatement)>,
}

/// A picture with its options.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MapStatement {
    pub file: String,
    pub line: u32,
    /// `-s`.
    pub scale: [f64; 2],
    /// `-o`.
    pub offset: [f64; 2],
    /// `-clamp on`.
    pub clamp: bool,
    /// `-bm`.
    pub multiplier: f32,
    /// `-imfchan` r, g, b: 0 to 2.
    pub channel: Option<u8>,
}

/// What is wrong in a line, with its number.
pub(super) type Remark = (u32, String);

const NUMBERS: [&str; 12] =
    ["Ns", "Ni", "d", "Tr", "illum", "Pr", "Pm", "Ps", "Pc", "Pcr", "aniso", "anisor"];
/// Maps that are read, as they are known here, and what they are called in files.
const MAPS: [(&str, &[&str]); 11] = [
    ("Kd", &["map_kd"]),
    ("Ks", &["map_ks"]),
    ("Ke", &["map_ke"]),
    ("Ns", &["map_ns"]),
    ("d", &["map_d", "map_tr"]),
    ("bump", &["map_bump", "bump"]),
    ("norm", &["norm", "map_norm", "map_kn"]),
    ("Pr", &["map_pr"]),
    ("Pm", &["map_pm"]),
    ("Ps", &["map_ps"]),
    ("Pc", &["map_pc"]),
];
/// Statements that change nothing that is shown here.
const SILENT: [&str; 8] = ["ka", "map_ka", "sharpness", "kt", "km", "map_aat", "#", "map_km"];

impl Mtl {
    /// A number that the file gives.
    pub fn number(&self, word: &str) -> Option<f32> {
        self.numbers.iter().rev().find(|(known, _)| *known == word).map(|(_, value)| *value)
    }

    /// A map that the file gives.
    pub fn map(&self, word: &str) -> Option<&MapStatement> {
        self.maps.iter().rev().find(|(known, _)| *known == word).map(|(_, map)| map)
    }

    /// Whether a statement of the extension for physically based materials is there.
    pub fn is_physical(&self) -> bool {
        ["Pr", "Pm", "Ps", "Pc"].iter().any(|word| self.number(word).is_some() || self.map(word).is_some())
    }
}

/// Reads the text of an MTL file. Lines that cannot be read are passed over with a remark.
pub(super) fn parse(text: &[u8]) -> (Vec<Mtl>, Vec<Remark>) {
    let (mut materials, mut remarks): (Vec<Mtl>, Vec<Remark>) = (Vec::new(), Vec::new());
    for (line, number) in text.split(|&byte| byte == b'\n').zip(1u32..) {
        let line = String::from_utf8_lossy(line);
        let line = line.trim().trim_start_matches('\u{feff}');
        let (word, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        let rest = rest.trim();
        if word == "newmtl" {
            materials.push(Mtl { name: rest.into(), line: number, ..Mtl::default() });
        } else if let Some(material) = materials.last_mut()
            && let Err(problem) = statement(material, word, rest, number)
        {
            remarks.push((number, problem));
        }
    }
    (materials, remarks)
}

fn statement(material: &mut Mtl, word: &str, rest: &str, line: u32) -> Result<(), String> {
    let lower = word.to_ascii_lowercase();
    let color = || color(rest).map(Some);
    match lower.as_str() {
        "kd" => material.diffuse = color()?,
        "ks" => material.specular = color()?,
        "ke" => material.emission = color()?,
        "tf" => material.filter = color()?,
        _ => {
            if let Some(known) = NUMBERS.iter().find(|known| known.eq_ignore_ascii_case(word)) {
                // `d -halo 0.5` fades towards the rim, which is not read
                let text = rest.split_whitespace().find(|word| *word != "-halo").unwrap_or_default();
                let value = text.parse().ok().filter(|value: &f32| value.is_finite());
                let value = value.ok_or_else(|| format!("{word}: \"{}\" is not a number", shorten(text)))?;
                material.numbers.push((known, value));
            } else if let Some((known, _)) = MAPS.iter().find(|(_, words)| words.contains(&lower.as_str())) {
                material.maps.push((known, map(rest, line)?));
            } else if !word.is_empty() && !word.starts_with('#') && !SILENT.contains(&lower.as_str()) {
                return Err(format!("{} is not read", shorten(word)));
            }
        }
    }
    Ok(())
}

/// One number, or three; spectra and XYZ are not read.
fn color(rest: &str) -> Result<Rgb, String> {
    let mut numbers = Vec::new();
    for word in rest.split_whitespace().take_while(|word| !word.starts_with('#')).take(3) {
        let value = word.parse().ok().filter(|value: &f32| value.is_finite());
        numbers.push(
            value.ok_or_else(|| format!("a colour with \"{}\", which is not a number", shorten(word)))?,
        );
    }
    match numbers[..] {
        [grey] => Ok([grey; 3]),
        [r, g, b] => Ok([r, g, b]),
        _ => Err(format!("a colour of {} numbers, where 1 or 3 belong", numbers.len())),
    }
}

/// A picture's name, which may hold blanks, with options before or behind it.
fn map(rest: &str, line: u32) -> Result<MapStatement, String> {
    let mut statement = MapStatement {
        file: String::new(),
        line,
        scale: [1.0; 2],
        offset: [0.0; 2],
        clamp: false,
        multiplier: 1.0,
        channel: None,
    };
    let mut words = rest.split_whitespace().peekable();
    let (mut begin, mut end) = (None, 0);
    let at = |word: &str| word.as_ptr() as usize - rest.as_ptr() as usize;
    while let Some(word) = words.next() {
        let number = |word: &str| word.parse::<f64>().ok().filter(|value| value.is_finite());
        let mut pair = |default: f64| {
            let mut values = [default; 2];
            for i in 0..3 {
                let Some(value) = words.peek().and_then(|word| number(word)) else { break };
                words.next();
                if let Some(place) = values.get_mut(i) {
                    *place = value;
                }
            }
            values
        };
        match word {
            "-s" => statement.scale = pair(1.0),
            "-o" => statement.offset = pair(0.0),
            "-t" => _ = pair(0.0),
            "-mm" => _ = pair(0.0),
            "-bm" => statement.multiplier = words.next().and_then(number).unwrap_or(1.0) as f32,
            "-clamp" => statement.clamp = words.next() == Some("on"),
            "-imfchan" => {
                statement.channel = match words.next() {
                    Some("r") => Some(0),
                    Some("g") => Some(1),
                    Some("b") => Some(2),
                    _ => None,
                }
            }
            "-blendu" | "-blendv" | "-cc" | "-boost" | "-texres" | "-type" => _ = words.next(),
            _ => {
                begin.get_or_insert(at(word));
                end = at(word) + word.len();
            }
        }
    }
    let name = begin.map_or("", |begin| &rest[begin..end.max(begin)]);
    if name.is_empty() {
        return Err("a map without the name of a picture".into());
    }
    statement.file = name.into();
    Ok(statement)
}

fn shorten(text: &str) -> String {
    text.chars().take(40).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(text: &str) -> Mtl {
        let (mut materials, remarks) = parse(format!("newmtl m\n{text}").as_bytes());
        assert_eq!(remarks, [], "{text}");
        materials.remove(0)
    }

    #[test]
    fn options_may_stand_before_and_behind_names_with_blanks() {
        let mtl = one(
            "bump -bm 2 bump 01.png\nmap_Kd -s 2 3 4 -o 0.5 -clamp on my wood.jpg\nmap_d a.png -imfchan g",
        );
        let bump = mtl.map("bump").unwrap();
        assert_eq!((bump.file.as_str(), bump.multiplier, bump.line), ("bump 01.png", 2.0, 2));
        let kd = mtl.map("Kd").unwrap();
        assert_eq!(
            (kd.file.as_str(), kd.scale, kd.offset, kd.clamp),
            ("my wood.jpg", [2.0, 3.0], [0.5, 0.0], true)
        );
        let d = mtl.map("d").unwrap();
        assert_eq!((d.file.as_str(), d.channel), ("a.png", Some(1)));
    }

    #[test]
    fn words_are_known_in_any_case_and_colours_may_be_grey() {
        let mtl = one("kd .5\nKS 1 0.5 0 # shiny\nNS 10\nTf 1.0\nmap_kd .\\wood.jpg");
        assert_eq!((mtl.diffuse, mtl.specular), (Some([0.5; 3]), Some([1.0, 0.5, 0.0])));
        assert_eq!((mtl.number("Ns"), mtl.filter), (Some(10.0), Some([1.0; 3])));
        assert_eq!(mtl.map("Kd").unwrap().file, ".\\wood.jpg");
        assert!(!mtl.is_physical() && one("Pm 0").is_physical());
    }

    #[test]
    fn lines_that_cannot_be_read_are_named_and_passed_over() {
        let (materials, remarks) =
            parse(b"Kd 1 1 1\nnewmtl a\nKd 1 x 1\nKd 1 1\nNs nan\nmap_Kd -s 1 1\nwobble 3\nKd 0.5 0.5 0.5\n");
        assert_eq!(materials[0].diffuse, Some([0.5; 3]));
        let lines: Vec<u32> = remarks.iter().map(|(line, _)| *line).collect();
        assert_eq!(lines, [3, 4, 5, 6, 7]);
    }
}
