//! A picture with its layers.

use std::collections::BTreeMap;

use crate::{Layer, Statistic};

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
}
