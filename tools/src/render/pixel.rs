//! `--pixel`: the values of one pixel.

use std::collections::BTreeMap;

use limpid_frame::{Frame, Layer, Statistic};
use serde::Serialize;

/// A pixel with all its channels.
#[derive(Serialize)]
pub struct Pixel<'a> {
    /// Column in the whole film.
    pub x: u32,
    /// Row in the whole film.
    pub y: u32,
    /// By channel name.
    pub values: BTreeMap<&'a str, f32>,
}

impl<'a> Pixel<'a> {
    /// The one pixel of `frame`, which stands at `place` in the whole film.
    pub fn of(frame: &'a Frame, [x, y]: [u32; 2]) -> Self {
        let values = frame.channels().filter_map(|(name, plane)| Some((name, *plane.first()?)));
        Self { x, y, values: values.collect() }
    }
}

/// A line a layer with its channels; a number is as long as it needs to be read back to the bit.
pub fn table(frame: &Frame) -> String {
    let line = |(layer, statistic): (Layer, Statistic)| {
        let statistic_name = match statistic {
            Statistic::Mean => "",
            Statistic::Variance => ".variance",
            Statistic::A => ".a",
            Statistic::B => ".b",
        };
        let values = frame.layer(layer, statistic).unwrap_or_default();
        let channels = layer.channels().iter().zip(values);
        let values: Vec<_> =
            channels.filter_map(|(name, plane)| Some(format!("{name} {}", plane.first()?))).collect();
        format!("{:<24} {}", format!("{}{statistic_name}", layer.name()), values.join("  "))
    };
    frame.layers_present().iter().map(line).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_colour_stands_first_and_reads_back_to_the_bit() {
        let mut frame = Frame::new(1, 1);
        for (name, value) in [("R", 0.1_f32), ("G", 1.0 / 3.0), ("B", 2e-9), ("depth.Z", 0.5)] {
            frame.insert(name, vec![value]);
        }
        let table = table(&frame);
        let words: Vec<&str> = table.split_whitespace().collect();
        assert_eq!((words[0], words[7], words[8]), ("beauty", "depth", "Z"));
        let values = [2, 4, 6, 9].map(|i| words[i].parse::<f32>());
        assert_eq!(values, [Ok(0.1), Ok(1.0 / 3.0), Ok(2e-9), Ok(0.5)]);
    }
}
