//! Features that say which pixels belong together, with their noise taken out.

use limpid_frame::{Frame, Layer, Statistic};

use crate::filter::nlm::{Buffer, Feature, Guide, Window, filter};
use crate::plane::{Plane, Size, map2, squared_gradient, three_tap_mean};
use crate::wrap::repair::{fill_non_finite, squared};

/// Values beyond this are no albedo and no normal: they are cut off, that distances stay finite.
const LIMIT: f32 = 1e4;

/// A layer whose noise has been taken out.
pub(crate) struct Guided {
    pub mean: Vec<Plane>,
    /// Of what noise was left, plane by plane.
    pub variance: Vec<Plane>,
}

/// Reads a layer and takes its noise out, by nonlocal means guided by the layer itself (Rousselle et al.
/// 2013, section 4.2: window 11 x 11, patch 7 x 7, k = 1). Both halves are filtered with the same
/// weights, and what they still differ by is the noise that is left.
///
/// Without halves the variance stays what it was, which makes the feature less strict than it could be.
/// Without any statistics the layer counts as free of noise and stays as it is. `None` if it is not there.
pub(crate) fn prefiltered(frame: &Frame, layer: Layer) -> Option<Guided> {
    let size = Size { width: frame.width(), height: frame.height() };
    let read = |statistic| -> Option<Vec<Plane>> {
        Some(frame.layer(layer, statistic)?.into_iter().map(<[f32]>::to_vec).collect())
    };
    let mean = read(Statistic::Mean)?;
    let halves = read(Statistic::A).zip(read(Statistic::B));
    let variance = read(Statistic::Variance).filter(|planes| planes.iter().flatten().all(|v| *v >= 0.0));
    let channels = mean.len();

    let mut planes = mean;
    if let Some((a, b)) = halves {
        planes.extend(a);
        planes.extend(b);
    }
    let with_halves = planes.len() > channels;
    fill_non_finite(size, &mut planes.iter_mut().collect::<Vec<_>>());
    planes.iter_mut().flatten().for_each(|value| *value = value.clamp(-LIMIT, LIMIT));
    let left_noise = |a: &[Plane], b: &[Plane]| -> Vec<Plane> {
        a.iter()
            .zip(b)
            .map(|(a, b)| three_tap_mean(size, &map2(a, b, |a, b| squared(0.5 * (a - b)))))
            .collect()
    };
    let variance = match variance {
        Some(mut planes) => {
            fill_non_finite(size, &mut planes.iter_mut().collect::<Vec<_>>());
            planes.iter_mut().flatten().for_each(|value| *value = value.min(LIMIT * LIMIT));
            planes.iter().map(|plane| three_tap_mean(size, plane)).collect()
        }
        None if with_halves => left_noise(&planes[channels..2 * channels], &planes[2 * channels..]),
        None => vec![vec![0.0; size.len()]; channels],
    };
    if variance.iter().flatten().all(|v| *v == 0.0) {
        planes.truncate(channels);
        return Some(Guided { mean: planes, variance });
    }

    let window = Window { radius: 5, patch: 3, average: false };
    let buffers = vec![Buffer { mean: &planes[..channels], targets: &planes }];
    let guide = Guide { k: 1.0, sigma_spatial: f32::INFINITY, variance: &variance, buffers };
    let mut filtered = filter(size, &window, &[guide], &[]).remove(0);
    let variance = if with_halves {
        left_noise(&filtered[channels..2 * channels], &filtered[2 * channels..])
    } else {
        variance
    };
    filtered.truncate(channels);
    Some(Guided { mean: filtered, variance })
}

impl Guided {
    /// The feature with its denominator `k² max(V, ‖∇f‖², τ)`.
    pub fn feature(&self, size: Size, k: f32, tau: f32) -> Feature {
        let denominator = self.mean.iter().zip(&self.variance).map(|(mean, variance)| {
            map2(variance, &squared_gradient(size, mean), |v, g| k * k * v.max(g).max(tau))
        });
        Feature {
            mean: self.mean.clone(),
            variance: self.variance.clone(),
            denominator: denominator.collect(),
        }
    }
}
