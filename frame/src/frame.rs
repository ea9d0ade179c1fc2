//! A picture with its layers.

use std::collections::BTreeMap;

use crate::{FrameError, Layer, LayerRequest, Statistic};

/// A picture: planes of `f32`, row-major from the top left, one value per pixel and channel.
///
/// A channel's key is its EXR name (`R`, `diffuse.G`, `normal.variance.X`); [`Layer`] knows the names
/// that limpid writes, and any other name passes through unchanged.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    width: usize,
    height: usize,
    channels: BTreeMap<String, Vec<f32>>,
    /// Text attributes of the header, under names that begin with `limpid:` where they are ours.
    pub metadata: BTreeMap<String, String>,
}

impl Frame {
    /// A frame without channels.
    pub fn new(width: usize, height: usize) -> Self {
        Self { width, height, ..Self::default() }
    }

    /// In pixels.
    pub fn width(&self) -> usize {
        self.width
    }

    /// In pixels.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Pixels of one channel.
    pub fn len(&self) -> usize {
        self.width * self.height
    }

    /// Whether there are no pixels.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// One channel by its EXR name.
    pub fn channel(&self, name: &str) -> Option<&[f32]> {
        self.channels.get(name).map(Vec::as_slice)
    }

    /// Adds or replaces a channel.
    ///
    /// # Panics
    ///
    /// If its length is not `width × height`.
    pub fn insert(&mut self, name: impl Into<String>, plane: Vec<f32>) {
        let name = name.into();
        assert_eq!(
            plane.len(),
            self.len(),
            "channel {name}: {} values for {}x{} pixels",
            plane.len(),
            self.width,
            self.height
        );
        self.channels.insert(name, plane);
    }

    /// Takes a channel out.
    pub fn remove(&mut self, name: &str) -> Option<Vec<f32>> {
        self.channels.remove(name)
    }

    /// All channels with their names, in the order of the names.
    pub fn channels(&self) -> impl Iterator<Item = (&str, &[f32])> {
        self.channels.iter().map(|(name, plane)| (name.as_str(), plane.as_slice()))
    }

    /// The planes of one statistic of a layer, if all its channels are here.
    pub fn layer(&self, layer: Layer, statistic: Statistic) -> Option<Vec<&[f32]>> {
        layer.channel_names(statistic).iter().map(|name| self.channel(name)).collect()
    }

    /// Adds or replaces one statistic of a layer; one plane a channel.
    ///
    /// # Panics
    ///
    /// If the number of planes or their length is not the layer's.
    pub fn insert_layer(&mut self, layer: Layer, statistic: Statistic, planes: Vec<Vec<f32>>) {
        let names = layer.channel_names(statistic);
        assert_eq!(
            planes.len(),
            names.len(),
            "layer {}: {} planes for {} channels",
            layer.name(),
            planes.len(),
            names.len()
        );
        for (name, plane) in names.into_iter().zip(planes) {
            self.insert(name, plane);
        }
    }

    /// The planes `R`, `G` and `B`.
    ///
    /// # Errors
    ///
    /// [`FrameError::MissingChannel`] names the first that is not here.
    pub fn rgb(&self) -> Result<[&[f32]; 3], FrameError> {
        let plane = |name: &str| {
            self.channel(name).ok_or_else(|| FrameError::MissingChannel { channel: name.to_owned() })
        };
        Ok([plane("R")?, plane("G")?, plane("B")?])
    }

    /// The layers and statistics all of whose channels are here.
    pub fn layers_present(&self) -> LayerRequest {
        let mut present = LayerRequest::default();
        for layer in Layer::ALL {
            for statistic in Statistic::ALL {
                if layer.channel_names(statistic).iter().all(|name| self.channels.contains_key(name)) {
                    present = present.with(layer, statistic);
                }
            }
        }
        present
    }

    /// The channels that hold values which are not finite, and how many: for a warning.
    pub fn non_finite(&self) -> Vec<(&str, usize)> {
        self.channels()
            .map(|(name, plane)| (name, plane.iter().filter(|v| !v.is_finite()).count()))
            .filter(|(_, count)| *count > 0)
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_present_are_those_with_all_their_channels() {
        let mut frame = Frame::new(2, 1);
        for name in ["R", "G", "B", "variance.R", "variance.G", "depth.Z", "depth.a.Z", "Z"] {
            frame.insert(name, vec![0.0; 2]);
        }
        let expected =
            LayerRequest::beauty().with(Layer::Depth, Statistic::Mean).with(Layer::Depth, Statistic::A);
        assert_eq!(frame.layers_present(), expected);
    }

    #[test]
    fn non_finite_values_are_counted_by_channel() {
        let mut frame = Frame::new(3, 1);
        frame.insert("R", vec![0.0; 3]);
        frame.insert("G", vec![f32::NAN, 1.0, f32::INFINITY]);
        assert_eq!(frame.non_finite(), [("G", 2)]);
    }

    #[test]
    fn a_missing_channel_is_named() {
        let mut frame = Frame::new(1, 1);
        frame.insert("R", vec![0.0]);
        let error = frame.rgb().expect_err("G is not there");
        assert_eq!(error.to_string(), "the frame has no channel `G`");
    }
}
