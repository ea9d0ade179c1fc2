//! Which numbers a sample has, and which of them a film sums.

use limpid_frame::{Layer, LayerRequest, Statistic};

/// Numbers of a sample.
const COUNT: usize = 32;

/// Where a layer's first channel stands in a sample's values; `None` for what is not summed.
pub const fn first_channel(layer: Layer) -> Option<usize> {
    Some(match layer {
        Layer::Beauty => 0,
        Layer::Diffuse => 3,
        Layer::Specular => 6,
        Layer::Emission => 9,
        Layer::Albedo => 12,
        Layer::DiffuseAlbedo => 15,
        Layer::Normal => 18,
        Layer::Position => 21,
        Layer::Depth => 24,
        Layer::Hit => 25,
        Layer::Roughness => 26,
        Layer::Visibility => 27,
        Layer::Offset => 28,
        Layer::Alpha => 31,
        Layer::Id | Layer::Samples => return None,
    })
}

/// 1 where the sample had a light sample at its feature hit, else 0.
const LIT: usize = 30;

/// The channel that says whether a sample counts for a layer; all do where there is none.
pub const fn condition(layer: Layer) -> Option<usize> {
    match layer {
        Layer::Depth => first_channel(Layer::Hit),
        Layer::Visibility => Some(LIT),
        _ => None,
    }
}

/// The numbers of one sample.
pub type Values = [f32; COUNT];

/// One sample of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The channels of all layers, one layer after the other; [`Self::get`] finds them by name.
    pub values: Values,
    /// Object and material of the first hit; −1 for the background.
    pub ids: [f32; 2],
}

impl Sample {
    /// All zero, no ids.
    pub const ZERO: Self = Self { values: [0.0; COUNT], ids: [-1.0; 2] };

    /// Writes a layer's channels.
    #[inline]
    pub fn set<const N: usize>(&mut self, layer: Layer, value: [f32; N]) {
        if let Some(first) = first_channel(layer) {
            self.values[first..first + N].copy_from_slice(&value);
        }
    }

    /// The visibility of the light at the feature hit, where a light sample was drawn there.
    #[inline]
    pub fn set_visibility(&mut self, share: f32) {
        self.set(Layer::Visibility, [share]);
        self.values[LIT] = 1.0;
    }

    /// The value of a layer's channel.
    pub fn get(&self, layer: Layer, channel: usize) -> f32 {
        first_channel(layer).map_or(0.0, |first| self.values[first + channel])
    }
}

/// Which channels a film sums, in the order of the values.
pub struct Plan {
    /// Channels with sums.
    pub sums: Vec<u8>,
    /// Channels with sums of squares, each with its condition.
    pub squares: Vec<(u8, Option<u8>)>,
    /// The ids of the first samples are kept.
    pub ids: bool,
    /// What was asked for, for the frame.
    pub layers: LayerRequest,
    /// Something beyond radiance is asked for.
    pub features: bool,
}

impl Plan {
    /// Sums what `layers` asks for, and the beauty with its statistics in any case: the error figure needs them.
    pub fn new(layers: &LayerRequest) -> Self {
        let layers = layers.clone().with(Layer::Beauty, Statistic::Mean);
        let mut sums = [false; COUNT];
        let mut squares = Vec::new();
        let mut features = false;
        for layer in Layer::ALL {
            let Some(first) = first_channel(layer) else { continue };
            let all = first..first + layer.channels().len();
            if layer == Layer::Beauty || layers.contains_layer(layer) {
                sums[all.clone()].fill(true);
                if let Some(condition) = condition(layer) {
                    sums[condition] = true;
                }
                features |= first >= 12 && layer != Layer::Alpha;
            }
            if layer == Layer::Beauty || layers.contains(layer, Statistic::Variance) {
                let condition = condition(layer).map(|c| c as u8);
                squares.extend(all.map(|c| (c as u8, condition)));
            }
        }
        Self {
            sums: (0..COUNT as u8).filter(|&c| sums[c as usize]).collect(),
            squares,
            ids: layers.contains_layer(Layer::Id),
            features: features || layers.contains_layer(Layer::Id),
            layers,
        }
    }
}
