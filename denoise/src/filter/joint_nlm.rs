//! Joint nonlocal means (Rousselle, Manzi, Zwicker 2013), per component.
//!
//! TODO figures

use limpid_frame::{Frame, Layer, LayerRequest};

use super::nlm::{Buffer, Guide, Window, filter};
use crate::method::{Parameter, Values};
use crate::plane::{Plane, Size, box_mean, map2};
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
        default: 0.35,
        min: 0.01,
        max: 100.0,
        integer: false,
    },
    Parameter {
        name: "k_feature",
        doc: "the same for features",
        default: 1.5,
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
        doc: "of a Gaussian over the distance, in pixels; the second pass takes half of it",
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
        doc: "k_color of the second pass",
        default: 0.6,
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
    fn record(&self, components: &Components, guides: &[&str]) -> String {
        let Self { radius, patch, k_color, k_feature, tau, sigma_spatial, second_radius, second_k_color } =
            self;
        let mut text = format!(
            "joint-nlm radius={radius} patch={patch} k_color={k_color} k_feature={k_feature} tau={tau} \
             sigma_spatial={sigma_spatial} second_radius={second_radius} second_k_color={second_k_color}"
        );
        if let Some(why) = components.whole {
            text += &format!("; filtered as a whole: {why}");
        }
        if components.filtered.iter().any(|component| component.buffers.len() < 2) {
            text += "; no halves: one pass, weights from the picture itself";
        }
        text += &match guides {
            [] => "; no features".to_owned(),
            guides => format!("; features {}", guides.join(" ")),
        };
        if components.repaired > 0 {
            text += &format!("; pixels filled {}", components.repaired);
        }
        text
    }

    /// The windows of the passes, in their order.
    fn windows(&self) -> Vec<Window> {
        let first = Window {
            radius: self.radius,
            patch: self.patch,
            k: self.k_color,
            sigma_spatial: self.sigma_spatial,
            average: false,
        };
        let second = Window {
            radius: self.second_radius,
            k: self.second_k_color,
            sigma_spatial: 0.5 * self.sigma_spatial,
            average: true,
            ..first
        };
        if self.second_radius > 0 { vec![first, second] } else { vec![first] }
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

        for window in self.windows() {
            let guides: Vec<Guide> = components.filtered.iter().map(crossed).collect();
            let mut filtered = filter(size, &window, &guides, &features).into_iter();
            for component in &mut components.filtered {
                component.buffers = filtered.by_ref().take(component.buffers.len()).collect();
                if let [a, b] = component.buffers.as_slice() {
                    component.variance = a.iter().zip(b).map(|(a, b)| left_noise(size, a, b)).collect();
                }
            }
            if components.filtered.iter().any(|component| component.buffers.len() < 2) {
                break; // without halves nobody knows what noise is left, which a second pass needs
            }
        }

        let mut out = frame.clone();
        for (name, plane) in ["R", "G", "B"].into_iter().zip(frame.rgb()?) {
            out.insert(format!("noisy.{name}"), plane.to_vec());
        }
        let filtered = components.filtered.iter().map(|component| mean_of(&component.buffers)).collect();
        components.repaired += recombine(&mut out, &components, filtered);
        let used: Vec<&str> = guides.iter().map(|(layer, _)| layer.name()).collect();
        out.metadata.insert("limpid:denoise".to_owned(), self.record(&components, &used));
        Ok(out)
    }
}

/// The guide of a component: each half filters the other, so that a sample has no part in its own weight.
fn crossed(component: &Component) -> Guide<'_> {
    let buffers = match component.buffers.as_slice() {
        [a, b] => vec![Buffer { mean: b, targets: a }, Buffer { mean: a, targets: b }],
        buffers => buffers.iter().map(|mean| Buffer { mean, targets: mean }).collect(),
    };
    Guide { variance: &component.variance, buffers }
}

/// Variance of either filtered half: half their squared difference, smoothed over 3 x 3 pixels.
fn left_noise(size: Size, a: &[f32], b: &[f32]) -> Plane {
    let difference = map2(a, b, |a, b| squared((a - b) * std::f32::consts::FRAC_1_SQRT_2));
    box_mean(size, &difference, 1)
}

fn mean_of(buffers: &[Vec<Plane>]) -> Vec<Plane> {
    match buffers {
        [a, b] => a.iter().zip(b).map(|(a, b)| map2(a, b, |a, b| 0.5 * (a + b))).collect(),
        buffers => buffers.iter().flatten().cloned().collect(),
    }
}

#[cfg(test)]
mod tests;
