//! The layers of a [`Frame`](crate::Frame): names, channels, and what is asked of the renderer.

use std::collections::BTreeSet;

/// A quantity that the renderer can write beside the picture. The table with all meanings is in the
/// crate's documentation; this is the list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Layer {
    /// Mean radiance, W·sr⁻¹·m⁻² per channel in linear Rec. 709. Its channels have no prefix.
    Beauty,
    /// Share of what is there: 1 where a surface or the background is seen, 0 where nothing is. The beauty is
    /// multiplied by it already. Its channel has no prefix.
    Alpha,
    /// Radiance that left the first non-delta vertex through the diffuse part of its BSDF.
    Diffuse,
    /// Radiance that left it through the specular part.
    Specular,
    /// Lights and background seen directly or through delta vertices only.
    Emission,
    /// Directional-hemispherical reflectance at the feature hit; 1 for background and pure delta.
    Albedo,
    /// Albedo of the diffuse lobe alone, times the tint of the delta chain before it.
    DiffuseAlbedo,
    /// Shading normal at the feature hit in world space, averaged and not renormalised; 0 for background.
    Normal,
    /// Position of the feature hit, relative to the origin in the metadata; 0 for background.
    Position,
    /// Mean distance of the first hit over the samples that hit, in scene units; 0 where none did.
    Depth,
    /// Share of the samples that hit something.
    Hit,
    /// Roughness at the feature hit, the square root of the microfacet width alpha; 1 for diffuse, 0 for background.
    Roughness,
    /// Mean unoccluded share of the light samples at the feature hit.
    Visibility,
    /// Mean position of the samples relative to the pixel's centre, in pixels.
    Offset,
    /// Object and material at the first sample's first hit, never averaged; −1 for background.
    Id,
    /// Number of samples of the pixel.
    Samples,
}

impl Layer {
    /// All layers, in the order of the table.
    pub const ALL: [Layer; 16] = [
        Layer::Beauty,
        Layer::Alpha,
        Layer::Diffuse,
        Layer::Specular,
        Layer::Emission,
        Layer::Albedo,
        Layer::DiffuseAlbedo,
        Layer::Normal,
        Layer::Position,
        Layer::Depth,
        Layer::Hit,
        Layer::Roughness,
        Layer::Visibility,
        Layer::Offset,
        Layer::Id,
        Layer::Samples,
    ];

    /// As `--layers` and methods name it.
    pub fn name(self) -> &'static str {
        match self {
            Layer::Beauty => "beauty",
            Layer::Alpha => "alpha",
            Layer::Diffuse => "diffuse",
            Layer::Specular => "specular",
            Layer::Emission => "emission",
            Layer::Albedo => "albedo",
            Layer::DiffuseAlbedo => "diffuse_albedo",
            Layer::Normal => "normal",
            Layer::Position => "position",
            Layer::Depth => "depth",
            Layer::Hit => "hit",
            Layer::Roughness => "roughness",
            Layer::Visibility => "visibility",
            Layer::Offset => "offset",
            Layer::Id => "id",
            Layer::Samples => "samples",
        }
    }

    /// The layer of this name, if there is one.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|layer| layer.name() == name)
    }

    /// The last part of its channels' names, in their order.
    pub fn channels(self) -> &'static [&'static str] {
        match self {
            Layer::Beauty
            | Layer::Diffuse
            | Layer::Specular
            | Layer::Emission
            | Layer::Albedo
            | Layer::DiffuseAlbedo => &["R", "G", "B"],
            Layer::Alpha => &["A"],
            Layer::Normal | Layer::Position => &["X", "Y", "Z"],
            Layer::Depth => &["Z"],
            Layer::Hit | Layer::Roughness | Layer::Visibility => &["V"],
            Layer::Offset => &["X", "Y"],
            Layer::Id => &["object", "material"],
            Layer::Samples => &["N"],
        }
    }

    /// Whether variance and half buffers of it can be asked for.
    pub fn has_statistics(self) -> bool {
        !matches!(self, Layer::Offset | Layer::Id | Layer::Samples)
    }

    /// The full channel names of one statistic of this layer: `diffuse.variance.R`, `a.R`, `depth.Z`.
    pub fn channel_names(self, statistic: Statistic) -> Vec<String> {
        let mut prefix = String::new();
        if !matches!(self, Layer::Beauty | Layer::Alpha) {
            prefix = format!("{}.", self.name());
        }
        prefix += match statistic {
            Statistic::Mean => "",
            Statistic::Variance => "variance.",
            Statistic::A => "a.",
            Statistic::B => "b.",
        };
        self.channels().iter().map(|c| format!("{prefix}{c}")).collect()
    }
}

/// What of a layer is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Statistic {
    /// The mean over the samples: the layer itself.
    Mean,
    /// The sample variance / n, or −1 ("unknown") with one sample.
    Variance,
    /// The mean of the even samples; with B absent where there is one sample.
    A,
    /// The mean of the odd samples.
    B,
}

impl Statistic {
    /// All statistics, in the order of the table.
    pub const ALL: [Statistic; 4] = [Statistic::Mean, Statistic::Variance, Statistic::A, Statistic::B];
}

/// A set of layers and statistics: what a method needs and what `--layers` asks for.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LayerRequest {
    items: BTreeSet<(Layer, Statistic)>,
}

impl LayerRequest {
    /// Nothing but the beauty's mean, which every frame has.
    pub fn beauty() -> Self {
        Self::default().with(Layer::Beauty, Statistic::Mean)
    }

    /// Every layer with every statistic.
    pub fn all() -> Self {
        let mut all = Self::default();
        for layer in Layer::ALL {
            all = all.with(layer, Statistic::Mean);
            if layer.has_statistics() {
                all = all.with_statistics(layer);
            }
        }
        all
    }

    /// Adds one statistic of a layer.
    pub fn with(mut self, layer: Layer, statistic: Statistic) -> Self {
        self.items.insert((layer, statistic));
        self
    }

    /// Adds mean, variance and both halves of a layer.
    pub fn with_statistics(self, layer: Layer) -> Self {
        self.with(layer, Statistic::Mean)
            .with(layer, Statistic::Variance)
            .with(layer, Statistic::A)
            .with(layer, Statistic::B)
    }

    /// Adds everything in `other`.
    pub fn union(mut self, other: &LayerRequest) -> Self {
        self.items.extend(other.items.iter().copied());
        self
    }

    /// Whether this statistic of this layer is asked for.
    pub fn contains(&self, layer: Layer, statistic: Statistic) -> bool {
        self.items.contains(&(layer, statistic))
    }

    /// Whether any statistic of this layer is asked for.
    pub fn contains_layer(&self, layer: Layer) -> bool {
        self.items.iter().any(|(l, _)| *l == layer)
    }

    /// What is asked for, in the order of the table.
    pub fn iter(&self) -> impl Iterator<Item = (Layer, Statistic)> + '_ {
        self.items.iter().copied()
    }
}
