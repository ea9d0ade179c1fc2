//! Pictures as textures.

use std::sync::{Arc, LazyLock};

use glam::DVec2;
use limpid_scenes::{Image, TexelFilter, Texels, WrapMode};

use super::fract;
use crate::color::Rgb;

/// A picture over [0, 1]², its first row at v = 0.
pub struct Bitmap {
    pub image: Arc<Image>,
    pub filter: TexelFilter,
    pub wrap: WrapMode,
}

impl Bitmap {
    /// The colour at a texture coordinate.
    pub fn color(&self, uv: DVec2) -> Rgb {
        let Image { width, height, .. } = *self.image;
        if width == 0 || height == 0 {
            return Rgb::ZERO;
        }
        let (x, y) = (wrap(uv.x, self.wrap) * f64::from(width), wrap(uv.y, self.wrap) * f64::from(height));
        match self.filter {
            TexelFilter::Nearest => texel(&self.image, (x as u32).min(width - 1), (y as u32).min(height - 1)),
            TexelFilter::Bilinear => {
                let ([x0, x1], s) = neighbours(x, width, self.wrap);
                let ([y0, y1], t) = neighbours(y, height, self.wrap);
                let row = |y| texel(&self.image, x0, y) * (1.0 - s) + texel(&self.image, x1, y) * s;
                row(y0) * (1.0 - t) + row(y1) * t
            }
        }
    }

    /// ∂/∂u and ∂/∂v of the interpolated colour; 0 without interpolation.
    pub fn gradient(&self, uv: DVec2) -> [Rgb; 2] {
        let Image { width, height, .. } = *self.image;
        if width == 0 || height == 0 || self.filter == TexelFilter::Nearest {
            return [Rgb::ZERO; 2];
        }
        let (x, y) = (wrap(uv.x, self.wrap) * f64::from(width), wrap(uv.y, self.wrap) * f64::from(height));
        let ([x0, x1], s) = neighbours(x, width, self.wrap);
        let ([y0, y1], t) = neighbours(y, height, self.wrap);
        let [[a, b], [c, d]] = [y0, y1].map(|y| [x0, x1].map(|x| texel(&self.image, x, y)));
        // where the picture is mirrored, it runs backwards
        let sign = |x: f64| if self.wrap == WrapMode::Mirror && fract(0.5 * x) > 0.5 { -1.0 } else { 1.0 };
        let du = ((b - a) * (1.0 - t) + (d - c) * t) * (width as f32 * sign(uv.x));
        let dv = ((c - a) * (1.0 - s) + (d - b) * s) * (height as f32 * sign(uv.y));
        [du, dv]
    }
}

/// Brings a coordinate into [0, 1].
#[inline]
fn wrap(x: f64, mode: WrapMode) -> f64 {
    match mode {
        WrapMode::Repeat => fract(x),
        WrapMode::Mirror => {
            let twice = 2.0 * fract(0.5 * x);
            if twice > 1.0 { 2.0 - twice } else { twice }
        }
        WrapMode::Clamp if x > 0.0 => x.min(1.0),
        WrapMode::Clamp => 0.0, // also where x is NaN
    }
}

/// The texels on both sides of `x` in [0, n], whose centres lie at i + ½, and the weight of the second.
#[inline]
fn neighbours(x: f64, n: u32, mode: WrapMode) -> ([u32; 2], f32) {
    let shifted = x + 0.5; // of the texel to the right, plus 1 to stay positive
    let right = (shifted as u32).min(n);
    let weight = (shifted - f64::from(right)) as f32;
    // A texel and its mirror image are neighbours, so that mirroring and clamping are the same from here on.
    let repeat = mode == WrapMode::Repeat;
    let left = match right {
        0 => {
            if repeat {
                n - 1
            } else {
                0
            }
        }
        _ => right - 1,
    };
    let right = match right {
        _ if right < n => right,
        _ => {
            if repeat {
                0
            } else {
                n - 1
            }
        }
    };
    ([left, right], weight)
}

/// The linear value of a texel; column and row must lie within the picture.
#[inline]
pub fn texel(image: &Image, x: u32, y: u32) -> Rgb {
    let at = 3 * (y as usize * image.width as usize + x as usize);
    match &image.texels {
        Texels::Srgb8(bytes) => {
            let linear = &*LINEAR_FROM_SRGB;
            Rgb::from_array([0, 1, 2].map(|c| linear[bytes[at + c] as usize]))
        }
        Texels::Linear8(bytes) => Rgb::from_array([0, 1, 2].map(|c| f32::from(bytes[at + c]) / 255.0)),
        Texels::Linear32(values) => Rgb::from_slice(&values[at..at + 3]),
    }
}

/// IEC 61966-2-1.
static LINEAR_FROM_SRGB: LazyLock<[f32; 256]> = LazyLock::new(|| {
    std::array::from_fn(|byte| {
        let x = byte as f64 / 255.0;
        (if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }) as f32
    })
});
