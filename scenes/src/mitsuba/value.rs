//! Numbers, colours and transforms as the file writes them.

use glam::{DMat4, DVec3};

use super::document::{Document, Element, required};
use crate::spectrum::{self, Quantity};
use crate::{Rgb, SceneError};

/// An error about the value of an attribute, at the value.
pub(super) fn value_error(element: &Element, attribute: &str, problem: String, help: &str) -> SceneError {
    SceneError::at(&element.place_of(attribute), &element.label(), problem, help)
}

/// Numbers between commas, blanks or both.
pub(super) fn numbers(element: &Element, attribute: &str) -> Result<Vec<f64>, SceneError> {
    let words = words(required(element, attribute)?);
    words.map(|word| parse(word).ok_or_else(|| not_a_number(element, attribute, word))).collect()
}

/// One number.
pub(super) fn number(element: &Element, attribute: &str) -> Result<f64, SceneError> {
    let text = required(element, attribute)?;
    parse(text.trim()).ok_or_else(|| not_a_number(element, attribute, text))
}

/// A number that is finite.
fn parse(word: &str) -> Option<f64> {
    word.parse().ok().filter(|value: &f64| value.is_finite())
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| c == ',' || c.is_whitespace()).filter(|word| !word.is_empty())
}

fn not_a_number(element: &Element, attribute: &str, word: &str) -> SceneError {
    let problem = format!("\"{}\" is not a finite number", shorten(word));
    value_error(element, attribute, problem, "write numbers like 1.5 or -2e-3")
}

/// Enough of a text to find it.
pub(super) fn shorten(text: &str) -> String {
    let mut short: String = text.chars().take(60).collect();
    if short.len() < text.len() {
        short.push('…');
    }
    short
}

/// `x`, `y`, `z`, each with its default; or `value` with one number for all three, or with three.
pub(super) fn vector(element: &Element, default: f64) -> Result<DVec3, SceneError> {
    if element.attribute("value").is_some() {
        return match numbers(element, "value")?[..] {
            [all] => Ok(DVec3::splat(all)),
            [x, y, z] => Ok(DVec3::new(x, y, z)),
            ref other => {
                let problem = format!("{} numbers", other.len());
                Err(value_error(element, "value", problem, "write one number or three"))
            }
        };
    }
    let mut vector = DVec3::splat(default);
    for (component, name) in vector.as_mut().iter_mut().zip(["x", "y", "z"]) {
        if element.attribute(name).is_some() {
            *component = number(element, name)?;
        }
    }
    Ok(vector)
}

/// The product of the operations in a `<transform>`; the first acts first.
pub(super) fn transform(document: &Document, element: &Element) -> Result<DMat4, SceneError> {
    let mut product = DMat4::IDENTITY;
    for &child in &element.children {
        product = operation(document.element(child))? * product;
    }
    if !product.is_finite() {
        let problem = "the operations make numbers too large";
        return Err(SceneError::at(&element.place, &element.label(), problem, "use smaller numbers"));
    }
    Ok(product)
}

const OPERATIONS: [&str; 5] = ["translate", "scale", "rotate", "lookat", "matrix"];

fn operation(element: &Element) -> Result<DMat4, SceneError> {
    match element.tag.as_str() {
        "translate" => Ok(DMat4::from_translation(vector(element, 0.0)?)),
        "scale" => Ok(DMat4::from_scale(vector(element, 1.0)?)),
        "rotate" => {
            let Some(axis) = vector(element, 0.0)?.try_normalize() else {
                let problem = "a rotation about an axis of no length";
                return Err(SceneError::at(
                    &element.place,
                    "rotate",
                    problem,
                    "name an axis, such as y=\"1\"",
                ));
            };
            Ok(DMat4::from_axis_angle(axis, number(element, "angle")?.to_radians()))
        }
        "lookat" | "lookAt" => look_at(element), // the latter of 0.x
        "matrix" => matrix(element),
        tag => {
            let help = crate::nearest::suggest(tag, "operations", OPERATIONS);
            Err(SceneError::at(&element.place, tag, format!("unknown operation <{tag}>"), help))
        }
    }
}

/// A camera at `origin` that looks at `target` along its +z with `up` above: its x axis points to the left.
fn look_at(element: &Element) -> Result<DMat4, SceneError> {
    let triple = |name: &str| match numbers(element, name)?[..] {
        [x, y, z] => Ok(DVec3::new(x, y, z)),
        ref other => {
            Err(value_error(element, name, format!("{} numbers", other.len()), "write three numbers"))
        }
    };
    let (origin, target) = (triple("origin")?, triple("target")?);
    let Some(forward) = (target - origin).try_normalize() else {
        return Err(value_error(
            element,
            "target",
            "target and origin are the same".into(),
            "look at another point",
        ));
    };
    let up = if element.attribute("up").is_some() { triple("up")? } else { any_up(forward) };
    let Some(left) = up.try_normalize().and_then(|up| up.cross(forward).try_normalize()) else {
        return Err(value_error(
            element,
            "up",
            "up points along the view".into(),
            "choose up across the view",
        ));
    };
    let up = forward.cross(left);
    Ok(DMat4::from_cols(left.extend(0.0), up.extend(0.0), forward.extend(0.0), origin.extend(1.0)))
}

/// Some direction across `forward`, for a `lookat` without `up` (Duff et al. 2017, as Mitsuba takes it).
fn any_up(forward: DVec3) -> DVec3 {
    let sign = 1.0f64.copysign(forward.z);
    let a = -1.0 / (sign + forward.z);
    let b = forward.x * forward.y * a;
    DVec3::new(1.0 + sign * forward.x * forward.x * a, sign * b, -sign * forward.x)
}

/// 16 numbers, or 9 for the linear part, row by row.
fn matrix(element: &Element) -> Result<DMat4, SceneError> {
    let values = numbers(element, "value")?;
    let size = match values.len() {
        16 => 4,
        9 => 3,
        other => {
            return Err(value_error(element, "value", format!("{other} numbers"), "write 16 numbers, or 9"));
        }
    };
    let mut matrix = DMat4::IDENTITY;
    for (i, value) in values.into_iter().enumerate() {
        matrix.col_mut(i % size)[i / size] = value;
    }
    if matrix.row(3) != glam::DVec4::W {
        let problem = "the last row is not 0 0 0 1".into();
        return Err(value_error(
            element,
            "value",
            problem,
            "only affine transforms are read: check the order, row by row",
        ));
    }
    Ok(matrix)
}

/// A `<float>`, `<rgb>`, `<srgb>`, `<spectrum>` or `<blackbody>` as a linear colour. `None`: the element is none of these.
pub(super) fn color(
    element: &Element,
    quantity: Quantity,
    file: impl FnOnce(&str) -> Result<Rgb, SceneError>,
) -> Result<Option<Rgb>, SceneError> {
    let color = match element.tag.as_str() {
        "float" | "integer" => [number(element, "value")? as f32; 3],
        "rgb" => rgb(element)?.map(|v| v as f32),
        "srgb" => rgb(element)?.map(|v| spectrum::linear_from_srgb(v as f32)),
        "blackbody" => {
            let text = required(element, "temperature")?;
            let kelvins =
                parse(text.trim().trim_end_matches(['k', 'K']).trim_end()).filter(|kelvins| *kelvins > 0.0);
            let Some(kelvins) = kelvins else { return Err(not_a_number(element, "temperature", text)) };
            let scale = if element.attribute("scale").is_some() { number(element, "scale")? } else { 1.0 };
            spectrum::blackbody(kelvins).map(|v| v * scale as f32)
        }
        "spectrum" if element.attribute("filename").is_some() => file(required(element, "filename")?)?,
        "spectrum" if element.attribute("type").is_none() => listed(element, quantity)?,
        _ => return Ok(None),
    };
    if color.iter().all(|channel| channel.is_finite()) {
        Ok(Some(color))
    } else {
        Err(value_error(element, "value", "the colour is too large".into(), "use smaller numbers"))
    }
}

/// `#rrggbb` (encoded, here decoded), one number or three (as they are).
fn rgb(element: &Element) -> Result<[f64; 3], SceneError> {
    let text = required(element, "value")?.trim();
    if let Some(digits) = text.strip_prefix('#') {
        let number = u32::from_str_radix(digits, 16).ok().filter(|_| digits.len() == 6);
        let Some(number) = number else {
            let problem = format!("\"{}\" is no colour", shorten(text));
            return Err(value_error(element, "value", problem, "write #rrggbb with six hexadecimal digits"));
        };
        let [_, r, g, b] = number.to_be_bytes().map(|byte| f32::from(byte) / 255.0);
        // an <srgb> decodes for itself
        let decode = |v| if element.tag == "srgb" { v } else { spectrum::linear_from_srgb(v) };
        return Ok([r, g, b].map(|v| f64::from(decode(v))));
    }
    match numbers(element, "value")?[..] {
        [grey] => Ok([grey; 3]),
        [r, g, b] => Ok([r, g, b]),
        ref other => Err(value_error(
            element,
            "value",
            format!("{} numbers", other.len()),
            "write one number or three",
        )),
    }
}

/// A `<spectrum>` in its text: one number, three (0.x: a colour), or `nm:value` pairs.
fn listed(element: &Element, quantity: Quantity) -> Result<Rgb, SceneError> {
    let text = required(element, "value")?;
    if !text.contains(':') {
        return match numbers(element, "value")?[..] {
            [constant] => Ok(spectrum::constant(constant, quantity)),
            [r, g, b] => Ok([r, g, b].map(|v| v as f32)),
            ref other => {
                let problem = format!("{} numbers", other.len());
                Err(value_error(
                    element,
                    "value",
                    problem,
                    "write one number, or pairs such as 400:0.1, 700:0.2",
                ))
            }
        };
    }
    let mut points = Vec::new();
    for word in words(text) {
        let pair = word.split_once(':').and_then(|(nm, value)| Some([parse(nm)?, parse(value)?]));
        let Some(pair) = pair else {
            let problem = format!("\"{}\" is no pair of wavelength and value", shorten(word));
            return Err(value_error(element, "value", problem, "write pairs such as 400:0.1, 700:0.2"));
        };
        points.push(pair);
    }
    check_order(&points).map_err(|problem| {
        value_error(element, "value", problem, "list wavelengths in nm from short to long")
    })?;
    Ok(spectrum::integrate(&points, quantity))
}

/// Wavelengths must not go back.
pub(super) fn check_order(points: &[[f64; 2]]) -> Result<(), String> {
    match points.windows(2).find(|pair| pair[1][0] < pair[0][0]) {
        Some(pair) => Err(format!("{} nm after {} nm", pair[1][0], pair[0][0])),
        None => Ok(()),
    }
}

/// The text of an `.spd` file: lines of wavelength and value, `#` begins a comment.
pub(super) fn spd_points(text: &str) -> Result<Vec<[f64; 2]>, (u32, String)> {
    let mut points = Vec::new();
    for (line, number) in text.lines().zip(1..) {
        let mut values = words(line.split('#').next().unwrap_or_default()).map(parse);
        match (values.next(), values.next(), values.next()) {
            (None, ..) => {}
            (Some(Some(nm)), Some(Some(value)), None) => points.push([nm, value]),
            _ => return Err((number, format!("\"{}\" is no pair of wavelength and value", shorten(line)))),
        }
    }
    check_order(&points).map_err(|problem| (0, problem))?;
    Ok(points)
}
