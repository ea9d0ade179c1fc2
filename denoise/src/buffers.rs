//! Pictures in memory, as other renderers hold them.

use limpid_frame::{Frame, Layer, Statistic};

use crate::{DenoiseError, Denoiser};

/// A noisy picture in memory, with what is known beside it. Each slice is `[h, w, 3]`: row 0 on top,
/// three interleaved values a pixel.
///
/// What is `None` is not known; a method says in its documentation what it does without. More can be had
/// by filling a [`Frame`]: its diffuse and specular parts above all.
#[derive(Clone, Copy, Debug, Default)]
pub struct Buffers<'a> {
    /// In pixels.
    pub width: usize,
    /// In pixels.
    pub height: usize,
    /// Mean radiance: linear, at any exposure.
    pub color: &'a [f32],
    /// Reflectance at the first surface that is not a mirror, 0 to 1; 1 for the background.
    pub albedo: Option<&'a [f32]>,
    /// Shading normal there, any space, unit or averaged; 0 for the background.
    pub normal: Option<&'a [f32]>,
    /// Means of two disjoint halves of the samples, `color` being their mean.
    pub halves: Option<[&'a [f32]; 2]>,
    /// Variance of `color`, a channel at a time: sample variance / n.
    pub variance: Option<&'a [f32]>,
}

impl Buffers<'_> {
    /// As a frame.
    ///
    /// # Errors
    ///
    /// [`DenoiseError::BufferSize`] names the buffer that does not hold `3 × width × height` values.
    pub fn to_frame(&self) -> Result<Frame, DenoiseError> {
        let values = self.width.checked_mul(self.height).and_then(|pixels| pixels.checked_mul(3));
        let planes = |buffer: &'static str, slice: &[f32]| {
            if Some(slice.len()) != values {
                let (width, height) = (self.width, self.height);
                return Err(DenoiseError::BufferSize { buffer, values: slice.len(), width, height });
            }
            Ok((0..3).map(|c| slice.iter().skip(c).step_by(3).copied().collect()).collect())
        };
        let color = planes("color", self.color)?;
        let mut frame = Frame::new(self.width, self.height);
        frame.insert_layer(Layer::Beauty, Statistic::Mean, color);
        let [a, b] = self.halves.map_or([None, None], |halves| halves.map(Some));
        for (name, slice, layer, statistic) in [
            ("albedo", self.albedo, Layer::Albedo, Statistic::Mean),
            ("normal", self.normal, Layer::Normal, Statistic::Mean),
            ("first half", a, Layer::Beauty, Statistic::A),
            ("second half", b, Layer::Beauty, Statistic::B),
            ("variance", self.variance, Layer::Beauty, Statistic::Variance),
        ] {
            if let Some(slice) = slice {
                frame.insert_layer(layer, statistic, planes(name, slice)?);
            }
        }
        Ok(frame)
    }
}

/// Denoises a picture in memory; the answer is `[h, w, 3]`.
///
/// # Errors
///
/// Those of [`Buffers::to_frame`] and of the method.
pub fn denoise_buffers(denoiser: &dyn Denoiser, buffers: &Buffers) -> Result<Vec<f32>, DenoiseError> {
    let denoised = denoiser.denoise(&buffers.to_frame()?)?;
    let [r, g, b] = denoised.rgb()?;
    Ok(r.iter().zip(g).zip(b).flat_map(|((r, g), b)| [*r, *g, *b]).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_buffer_of_the_wrong_length_is_named() {
        let buffers =
            Buffers { width: 2, height: 2, color: &[0.0; 12], normal: Some(&[0.0; 4]), ..Buffers::default() };
        let error = buffers.to_frame().expect_err("the normal is too short");
        assert_eq!(
            error.to_string(),
            "buffer `normal` holds 4 values, but a 2x2 picture wants [h, w, 3] of them"
        );
        let huge = Buffers { width: usize::MAX, height: 2, ..Buffers::default() };
        assert!(matches!(huge.to_frame(), Err(DenoiseError::BufferSize { buffer: "color", .. })));
    }
}
