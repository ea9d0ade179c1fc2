//! A frame apart into what is filtered by itself, and together again.
//!
//! Diffuse radiance is divided by the albedo before and multiplied after, so that no texture is blurred;
//! specular radiance goes by itself, and so does emission seen directly. The sum is the picture (Zimmer et
//! al. 2015; Bako et al. 2017).
//!
//! Emission has noise only where a pixel sees the edge of a lamp, and passes through elsewhere: a filter leaves
//! alone what has no noise around it. At the edge it has to be filtered, for a lamp a hundred times brighter
//! than the wall makes it most of the picture's error (passed through as it is, half of the relMSE of a box
//! with a visible lamp at 16 samples). Pixels right beside the edge belong to it: with a wide pixel filter
//! some see the lamp once in thirty samples, and most of them not at all in sixteen.
//!
//! The albedo that is divided out and multiplied in again is the *prefiltered* one, the same both times.
//! With the noisy one its own noise (defocus, edges, texture under a pixel) comes back with the last step,
//! untouched by any filter: over four frames of 16 and 64 samples that cost a third more error.

use limpid_frame::{Frame, FrameError, Layer, Statistic};

use crate::plane::{Plane, Size, map2};
use crate::wrap::features::prefiltered;
use crate::wrap::noise;
use crate::wrap::repair::{exposure_exponent, fill_non_finite, scale, scale_variance};

/// Added to the albedo before it divides (Bako et al. 2017): what is black stays finite.
const ALBEDO_FLOOR: f32 = 0.00316;

/// The same where the beauty is filtered as a whole. A lamp has an albedo near zero there: divided by it, what
/// a lamp's edge leaks into its neighbours becomes a hundred times as bright. Over ten frames 0.00316 gave 2.1
/// times the error; 1 gave 5 % less, but up to 25 % more where there is texture and little else.
const WHOLE_FLOOR: f32 = 0.3;

/// What adds up to the beauty.
const PARTS: [Layer; 3] = [Layer::Diffuse, Layer::Specular, Layer::Emission];

/// Radiance that is filtered by itself, divided by its albedo and brought to an ordinary exposure.
pub(crate) struct Component {
    pub layer: Layer,
    /// The two halves of the samples, or the mean alone where there are none. Three planes each.
    pub buffers: Vec<Vec<Plane>>,
    /// Variance of one of the buffers.
    pub variance: Vec<Plane>,
    /// What the answer is multiplied by.
    albedo: Option<Vec<Plane>>,
    /// The buffers were multiplied by 2^−e.
    exponent: i32,
}

/// A frame, apart.
pub(crate) struct Components {
    pub filtered: Vec<Component>,
    /// Pixels that were not finite in a component and were filled from their neighbours.
    pub repaired: usize,
    /// Why the picture was filtered as a whole, if it was.
    pub whole: Option<&'static str>,
}

/// Takes a frame apart: into diffuse, specular and emission if all are there and add up to the beauty,
/// otherwise into one component, the beauty, divided by `albedo` where there is one.
///
/// # Errors
///
/// [`FrameError::MissingChannel`] if there is no beauty.
pub(crate) fn split(frame: &Frame) -> Result<Components, FrameError> {
    let beauty = frame.rgb()?;
    let size = Size { width: frame.width(), height: frame.height() };
    let parts: Option<Vec<_>> = PARTS
        .into_iter()
        .chain([Layer::DiffuseAlbedo])
        .map(|layer| frame.layer(layer, Statistic::Mean))
        .collect();
    let mut repaired = 0;
    let whole = match parts {
        None => Some("no components"),
        Some(parts) if !add_up(&beauty, &parts[..3]) => Some("its components do not add up"),
        Some(_) => None,
    };
    if whole.is_some() {
        let filtered = component(frame, size, Layer::Beauty, Layer::Albedo, &mut repaired)?;
        return Ok(Components { filtered: vec![filtered], repaired, whole });
    }
    let mut filtered = vec![component(frame, size, Layer::Diffuse, Layer::DiffuseAlbedo, &mut repaired)?];
    let specular = frame.layer(Layer::Specular, Statistic::Mean).unwrap_or_default();
    if specular.iter().any(|plane| plane.iter().any(|v| *v != 0.0)) {
        filtered.push(component(frame, size, Layer::Specular, Layer::Specular, &mut repaired)?);
    }
    // Without statistics of its own, emission counts as free of noise.
    let emission = frame.layer(Layer::Emission, Statistic::Variance).unwrap_or_default();
    if emission.iter().any(|plane| plane.iter().any(|v| *v > 0.0)) {
        filtered.push(component(frame, size, Layer::Emission, Layer::Emission, &mut repaired)?);
    }
    Ok(Components { filtered, repaired, whole })
}

/// Puts the components, each of one filtered buffer, together into `frame`: themselves and, as `R G B`, their
/// sum. Returns how many pixels of what passes through were not finite and were filled.
pub(crate) fn recombine(frame: &mut Frame, components: &Components) -> usize {
    let size = Size { width: frame.width(), height: frame.height() };
    for component in &components.filtered {
        let mut planes: Vec<Plane> = component.buffers.first().cloned().unwrap_or_default();
        for (c, plane) in planes.iter_mut().enumerate() {
            scale(plane, component.exponent);
            if let Some(albedo) = &component.albedo {
                plane.iter_mut().zip(&albedo[c]).for_each(|(value, albedo)| *value *= albedo);
            }
            limit(plane);
        }
        frame.insert_layer(component.layer, Statistic::Mean, planes);
    }
    if components.whole.is_some() {
        return 0;
    }
    let mut repaired = 0;
    let mut sum = vec![vec![0.0; size.len()]; 3];
    for layer in PARTS {
        let mut planes = copy(frame, layer, Statistic::Mean).unwrap_or_default();
        repaired += fill_non_finite(size, &mut planes.iter_mut().collect::<Vec<_>>());
        for (sum, plane) in sum.iter_mut().zip(&planes) {
            sum.iter_mut().zip(plane).for_each(|(sum, value)| *sum += value);
            limit(sum);
        }
    }
    frame.insert_layer(Layer::Beauty, Statistic::Mean, sum);
    repaired
}

/// Products and sums of huge values may leave the range of f32.
fn limit(plane: &mut [f32]) {
    plane.iter_mut().for_each(|value| *value = value.clamp(f32::MIN, f32::MAX));
}

/// Whether parts add up to the beauty, over the whole picture and up to rounding. A picture with a part
/// that is not among them (light scattered in a medium) must not lose it.
fn add_up(beauty: &[&[f32]; 3], parts: &[Vec<&[f32]>]) -> bool {
    let (mut missing, mut total) = (0.0, 0.0);
    for (c, beauty) in beauty.iter().enumerate() {
        for (p, whole) in beauty.iter().enumerate() {
            let sum: f64 = parts.iter().map(|part| f64::from(part[c][p])).sum();
            if sum.is_finite() && whole.is_finite() {
                missing += (sum - f64::from(*whole)).abs();
                total += f64::from(*whole).abs();
            }
        }
    }
    missing <= 1e-3 * total
}

fn copy(frame: &Frame, layer: Layer, statistic: Statistic) -> Option<Vec<Plane>> {
    Some(frame.layer(layer, statistic)?.into_iter().map(<[f32]>::to_vec).collect())
}

/// Reads one component, repairs it, divides it by its albedo, scales it, and finds how noisy it is.
/// `albedo` is `layer` itself where there is nothing to divide by.
fn component(
    frame: &Frame,
    size: Size,
    layer: Layer,
    albedo: Layer,
    repaired: &mut usize,
) -> Result<Component, FrameError> {
    let mean = copy(frame, layer, Statistic::Mean)
        .ok_or_else(|| FrameError::MissingChannel { channel: layer.name().to_owned() })?;
    let halves = copy(frame, layer, Statistic::A).zip(copy(frame, layer, Statistic::B));
    let mut buffers = halves.map_or_else(|| vec![mean], |(a, b)| vec![a, b]);
    *repaired += fill_non_finite(size, &mut buffers.iter_mut().flatten().collect::<Vec<_>>());
    let mut variance = copy(frame, layer, Statistic::Variance);

    let albedo = if albedo == layer { None } else { prefiltered(frame, albedo) };
    let albedo: Option<Vec<Plane>> = albedo.map(|albedo| {
        let floor = if layer == Layer::Beauty { WHOLE_FLOOR } else { ALBEDO_FLOOR };
        let floored = |plane: &Plane| plane.iter().map(|a| a.max(0.0) + floor).collect();
        albedo.mean.iter().map(floored).collect()
    });
    let exponent = exposure_exponent(buffers.iter().flatten().cloned().collect::<Vec<_>>().as_slice());
    for planes in &mut buffers {
        for (c, plane) in planes.iter_mut().enumerate() {
            scale(plane, -exponent);
            if let Some(albedo) = &albedo {
                plane.iter_mut().zip(&albedo[c]).for_each(|(value, albedo)| *value /= albedo);
            }
        }
    }
    if let Some(planes) = &mut variance {
        for (c, plane) in planes.iter_mut().enumerate() {
            if plane.iter().any(|v| *v < 0.0) {
                continue; // unknown, and it stays so
            }
            scale_variance(plane, -exponent);
            if let Some(albedo) = &albedo {
                plane.iter_mut().zip(&albedo[c]).for_each(|(value, albedo)| *value /= albedo * albedo);
            }
        }
        fill_non_finite(size, &mut planes.iter_mut().collect::<Vec<_>>());
    }
    let variance = (0..3)
        .map(|c| {
            let variance = variance.as_ref().map(|planes| &planes[c]);
            match buffers.as_slice() {
                [a, b] => {
                    let mean = map2(&a[c], &b[c], |a, b| 0.5 * (a + b));
                    let of_mean = noise::variance(size, &mean, variance, Some([&a[c], &b[c]]));
                    of_mean.into_iter().map(|v| 2.0 * v).collect() // a half has half the samples
                }
                buffers => noise::variance(size, &buffers[0][c], variance, None),
            }
        })
        .collect();
    Ok(Component { layer, buffers, variance, albedo, exponent })
}
