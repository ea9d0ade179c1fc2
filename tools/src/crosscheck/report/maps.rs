//! Pictures that show where two pictures differ.

use limpid_frame::Frame;
use limpid_frame::compare::{Family, Finding, Halves};

/// Linear colours: red where the first picture is brighter, blue where it is darker, white where nothing is to be seen.
const BRIGHTER: [f32; 3] = [0.6, 0.02, 0.02];
const DARKER: [f32; 3] = [0.02, 0.08, 0.6];
/// Colours are full at twice the difference that this share of the pixels is below: a few fireflies must not set the scale.
const MOST: f64 = 0.9;

/// Planes R, G and B.
pub type Planes = [Vec<f32>; 3];

/// The mean of a picture, with its variance as layers of the frame.
pub fn frame(picture: &Halves) -> Frame {
    let [width, height] = picture.size();
    let mut frame = Frame::new(width, height);
    for (channel, name) in ["R", "G", "B"].into_iter().enumerate() {
        let plane = |i: usize| (0..width * height).map(|p| picture.pixel(channel, p)[i] as f32).collect();
        frame.insert(name, plane(0));
        frame.insert(format!("variance.{name}"), plane(1));
    }
    frame
}

/// The first picture less the second.
pub fn difference(ours: &Halves, theirs: &Halves) -> Frame {
    let [width, height] = ours.size();
    let mut frame = Frame::new(width, height);
    for (channel, name) in ["R", "G", "B"].into_iter().enumerate() {
        let of = |p| (ours.pixel(channel, p)[0] - theirs.pixel(channel, p)[0]) as f32;
        frame.insert(name, (0..width * height).map(of).collect());
    }
    frame
}

/// The p value of each pixel's block and channel.
pub fn p_values(blocks: &Family, [width, height]: [usize; 2]) -> Frame {
    let mut frame = Frame::new(width, height);
    for (channel, name) in ["R", "G", "B"].into_iter().enumerate() {
        let of_channel = blocks.findings.iter().filter(|finding| finding.channel == channel);
        frame.insert(name, painted(of_channel, width, height, |finding| finding.p as f32));
    }
    frame
}

/// The difference in colours, and the difference at which they are full.
pub fn difference_colours(difference: &Frame) -> (Planes, f64) {
    let planes = difference.rgb().expect("has its channels");
    let mean: Vec<f32> =
        (0..difference.len()).map(|p| planes.iter().map(|plane| plane[p]).sum::<f32>() / 3.0).collect();
    let mut sizes: Vec<f32> = mean.iter().map(|d| d.abs()).filter(|d| d.is_finite()).collect();
    sizes.sort_by(f32::total_cmp);
    let most = sizes.get((sizes.len() as f64 * MOST) as usize).copied().filter(|most| *most > 0.0);
    let full = 2.0 * most.or(sizes.last().copied()).unwrap_or(0.0);
    let share = |d: f32| if full > 0.0 { d / full } else { 0.0 };
    (colours(mean.iter().map(|&d| share(d))), full.into())
}

/// How clear the difference of each block is, in colours that are full at an alarm. Of its channels the clearest counts.
pub fn p_colours(blocks: &Family, [width, height]: [usize; 2]) -> Planes {
    let clear = |finding: &Finding| (finding.p.max(f64::MIN_POSITIVE).ln() / blocks.level.ln()) as f32;
    let clearest: Vec<Finding> = blocks
        .findings
        .chunks(3)
        .filter_map(|channels| channels.iter().min_by(|a, b| a.p.total_cmp(&b.p)).copied())
        .collect();
    let sign = |finding: &Finding| if finding.means[0] < finding.means[1] { -1.0 } else { 1.0 };
    let values = painted(clearest.iter(), width, height, |finding| sign(finding) * clear(finding));
    colours(values.into_iter())
}

fn painted<'a>(
    findings: impl Iterator<Item = &'a Finding>,
    width: usize,
    height: usize,
    value: impl Fn(&Finding) -> f32,
) -> Vec<f32> {
    let mut plane = vec![f32::NAN; width * height];
    for finding in findings {
        let area = finding.area;
        for row in plane.chunks_mut(width).skip(area.y).take(area.height) {
            row[area.x..area.x + area.width].fill(value(finding));
        }
    }
    plane
}

/// From −1 to 1; beyond that colours stay full, and what is not finite is grey.
fn colours(values: impl Iterator<Item = f32>) -> Planes {
    let mut planes: Planes = Default::default();
    for value in values {
        let end = if value < 0.0 { DARKER } else { BRIGHTER };
        let share = value.abs().min(1.0);
        for (plane, end) in planes.iter_mut().zip(end) {
            plane.push(if value.is_finite() { 1.0 + share * (end - 1.0) } else { 0.2 });
        }
    }
    planes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_red_where_brighter_blue_where_darker_and_white_where_equal() {
        let mut difference = Frame::new(3, 1);
        for name in ["R", "G", "B"] {
            difference.insert(name, vec![2.0, -2.0, 0.0]);
        }
        let ([r, g, b], full) = difference_colours(&difference);
        assert_eq!(full, 4.0);
        assert!(r[0] > b[0] && b[1] > r[1]);
        assert_eq!((r[2], g[2], b[2]), (1.0, 1.0, 1.0));
    }
}
