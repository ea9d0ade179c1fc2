//! Joint nonlocal means (Rousselle, Manzi, Zwicker 2013), per component.
//!
//! 1. Diffuse radiance over albedo, specular radiance and emission are filtered each by itself
//!    ([`components`](crate::wrap::components)); without them the beauty as a whole.
//! 2. Normal and albedo guide, prefiltered ([`features`](crate::wrap::features)). Without them colour alone does.
//! 3. First pass ([`nlm`](super::nlm)): the weights come from one half of the samples and filter the other.
//! 4. Second pass, over half the distance: weights from the mean of both filtered halves filter it once more.
//!    What the halves still differ by is the noise it goes by. It averages the weights over the patch.
//!    Without halves (one sample, other renderers) there is one pass, with weights from the picture itself.
//!
//! The smaller of colour and feature weight counts, as in the paper. Unlike it, the first pass has no second
//! and third candidate to choose from, features are compared with k = 1.2 and not 0.6, and a Gaussian
//! over the distance stands in for the world position.
//!
//! What its parts are worth: relMSE over that of the defaults, geometric mean over the scenes corner, court and shelf of
//! `scenes/tune` at 192x144 with 16 and 64 samples, as `docs/joint-nlm.sh` prints it. The defaults were chosen on these
//! and on other frames, some with a lamp in view:
//!
//! | variant | |
//! | --- | --- |
//! | one pass (`second_radius=0`) | 1.55 |
//! | one pass, patch 3 x 3: the paper's FIRST (`second_radius=0 patch=1`) | 1.23 |
//! | one pass, features only: the paper's THIRD (`second_radius=0 k_color=100 tau=1e-4`) | 8.28 |
//! | no Gaussian (`sigma_spatial=1000000`) | 1.02 |
//!
//! Tried once while it was made, over ten other frames (no command keeps these figures), and dropped: position as a
//! third feature instead of the Gaussian (2 % better, and it needs the scene's extent); a quotient of sums over the
//! patch instead of the mean of quotients (4 % worse); averaged weights in the first pass too (6 % worse); a third
//! pass (2 % better for half the time again); a pyramid of two or three levels against low-frequency noise (2 % and
//! 1 % worse); the second pass on each half by itself (1 % worse for twice its time); a lamp's edge with the second
//! pass's wider k (27 % worse over frames with a lamp in view, which leaks into its surroundings); the residual noise
//! smoothed over 5 x 5 pixels (2 % worse over the same frames). Some of the frames with a lamp showed the Cornell box,
//! which also serves to judge: what they favoured held on nine others.

use limpid_frame::{Frame, Layer, LayerRequest};

use super::nlm::{Buffer, Feature, Guide, Window, filter};
use crate::method::{Parameter, Values};
use crate::plane::{Size, box_mean, map2};
use crate::wrap::components::{Component, Components, recombine, split};
use crate::wrap::features::{Guided, prefiltered};
use crate::wrap::repair::squared;
use crate::{DenoiseError, Denoiser};

pub(super) const PARAMETERS: &[Parameter] = &[
    Parameter {
        name: "radius",
        doc: "of the search window of the first pass, in pixels",
        default: 10.0,
        min: 1.0,
        max: 32.0,
        integer: true,
    },
    Parameter {
        name: "patch",
        doc: "radius of the patches that are compared, in pixels",
        default: 3.0,
        min: 0.0,
        max: 8.0,
        integer: true,
    },
    Parameter {
        name: "k_color",
        doc: "how many standard deviations of noise still count as equal, in the first pass",
        default: 0.3,
        min: 0.01,
        max: 100.0,
        integer: false,
    },
    Parameter {
        name: "k_feature",
        doc: "the same for features",
        default: 1.2,
        min: 0.01,
        max: 100.0,
        integer: false,
    },
    Parameter {
        name: "tau",
        doc: "squared difference of features below which they count as equal",
        default: 1e-3,
        min: 1e-9,
        max: 1e3,
        integer: false,
    },
    Parameter {
        name: "sigma_spatial",
        doc: "of a Gaussian over the distance, in pixels; the second pass takes half of it, emission none",
        default: 4.0,
        min: 0.1,
        max: 1e6,
        integer: false,
    },
    Parameter {
        name: "second_radius",
        doc: "of the search window of the second pass, in pixels; 0: no second pass",
        default: 5.0,
        min: 0.0,
        max: 32.0,
        integer: true,
    },
    Parameter {
        name: "second_k_color",
        doc: "k_color of the second pass; emission keeps the first one's",
        default: 0.9,
        min: 0.01,
        max: 100.0,
        integer: false,
    },
];

/// Joint nonlocal means; the module's documentation says how it works. Its parameters are described in
/// the table of [`methods`](crate::methods).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointNlm {
    /// In pixels.
    pub radius: usize,
    /// In pixels.
    pub patch: usize,
    /// In standard deviations.
    pub k_color: f32,
    /// In standard deviations.
    pub k_feature: f32,
    /// In squared units of albedo and normal.
    pub tau: f32,
    /// In pixels.
    pub sigma_spatial: f32,
    /// In pixels; 0: one pass only.
    pub second_radius: usize,
    /// In standard deviations.
    pub second_k_color: f32,
}

impl Default for JointNlm {
    fn default() -> Self {
        Self::from_values(&Values::defaults(PARAMETERS))
    }
}

impl JointNlm {
    pub(super) fn from_values(values: &Values) -> Self {
        Self {
            radius: values.count("radius"),
            patch: values.count("patch"),
            k_color: values.get("k_color"),
            k_feature: values.get("k_feature"),
            tau: values.get("tau"),
            sigma_spatial: values.get("sigma_spatial"),
            second_radius: values.count("second_radius"),
            second_k_color: values.get("second_k_color"),
        }
    }

    /// What goes into the frame's header: the parameters, and what the method worked on.
    fn record(&self, components: &Components, guides: &[(Layer, Guided)]) -> String {
        let Self { radius, patch, k_color, k_feature, tau, sigma_spatial, second_radius, second_k_color } =
            self;
        let mut text = format!(
            "joint-nlm radius={radius} patch={patch} k_color={k_color} k_feature={k_feature} tau={tau} \
             sigma_spatial={sigma_spatial} second_radius={second_radius} second_k_color={second_k_color}"
        );
        if let Some(why) = components.whole {
            text += &format!("; filtered as a whole: {why}");
        }
        let names: Vec<&str> = guides.iter().map(|(layer, _)| layer.name()).collect();
        text += &if names.is_empty() {
            "; no features".to_owned()
        } else {
            format!("; features {}", names.join(" "))
        };
        if components.repaired > 0 {
            text += &format!("; pixels filled {}", components.repaired);
        }
        text
    }

    /// One pass over all components: the buffers become the filtered ones.
    fn pass(&self, size: Size, second: bool, components: &mut Components, features: &[Feature]) {
        let radius = if second { self.second_radius } else { self.radius };
        let window = Window { radius, patch: self.patch, average: second };
        let guides: Vec<Guide> =
            components.filtered.iter().map(|component| self.guide(second, component)).collect();
        let mut filtered = filter(size, &window, &guides, features).into_iter();
        for component in &mut components.filtered {
            component.buffers = filtered.by_ref().take(component.buffers.len()).collect();
        }
    }

    /// The guide of a component: each half filters the other, so that a sample has no part in its own weight.
    fn guide<'a>(&self, second: bool, component: &'a Component) -> Guide<'a> {
        let (k, sigma_spatial) = match (component.layer, second) {
            // A lamp's edge is alike as far as it goes, and what leaks out of it outshines what it leaks into.
            (Layer::Emission, _) => (self.k_color, f32::INFINITY),
            (_, false) => (self.k_color, self.sigma_spatial),
            (_, true) => (self.second_k_color, 0.5 * self.sigma_spatial),
        };
        let buffers = match component.buffers.as_slice() {
            [a, b] => vec![Buffer { mean: b, targets: a }, Buffer { mean: a, targets: b }],
            buffers => buffers.iter().map(|mean| Buffer { mean, targets: mean }).collect(),
        };
        Guide { k, sigma_spatial, variance: &component.variance, buffers }
    }
}

impl Denoiser for JointNlm {
    fn name(&self) -> &'static str {
        "joint-nlm"
    }

    fn needs(&self) -> LayerRequest {
        let layers = [
            Layer::Diffuse,
            Layer::Specular,
            Layer::Emission,
            Layer::DiffuseAlbedo,
            Layer::Albedo,
            Layer::Normal,
        ];
        layers.into_iter().fold(LayerRequest::beauty(), LayerRequest::with_statistics)
    }

    fn denoise(&self, frame: &Frame) -> Result<Frame, DenoiseError> {
        let size = Size { width: frame.width(), height: frame.height() };
        let mut components = split(frame)?;
        let guides: Vec<(Layer, Guided)> = [Layer::Normal, Layer::Albedo]
            .into_iter()
            .filter_map(|layer| Some((layer, prefiltered(frame, layer)?)))
            .collect();
        let features: Vec<_> =
            guides.iter().map(|(_, guided)| guided.feature(size, self.k_feature, self.tau)).collect();

        self.pass(size, false, &mut components, &features);
        let halves = components.filtered.iter().all(|component| component.buffers.len() == 2);
        components.filtered.iter_mut().for_each(|component| join_halves(size, component));
        // Without halves nobody knows what noise is left, which is what a second pass goes by.
        if halves && self.second_radius > 0 {
            self.pass(size, true, &mut components, &features);
        }

        let mut out = frame.clone();
        for (name, plane) in ["R", "G", "B"].into_iter().zip(frame.rgb()?) {
            out.insert(format!("noisy.{name}"), plane.to_vec());
        }
        components.repaired += recombine(&mut out, &components);
        let mut record = self.record(&components, &guides);
        if !halves {
            record += "; no halves: one pass, weights from the picture itself";
        }
        out.metadata.insert("limpid:denoise".to_owned(), record);
        Ok(out)
    }
}

/// Makes one buffer of two, their mean, with its variance: a quarter of their squared difference, smoothed
/// over 3 x 3 pixels.
fn join_halves(size: Size, component: &mut Component) {
    if let [a, b] = component.buffers.as_slice() {
        let pairs = || a.iter().zip(b);
        let variance = pairs().map(|(a, b)| box_mean(size, &map2(a, b, |a, b| squared(0.5 * (a - b))), 1));
        component.variance = variance.collect();
        component.buffers = vec![pairs().map(|(a, b)| map2(a, b, |a, b| 0.5 * (a + b))).collect()];
    }
}

#[cfg(test)]
mod tests;
