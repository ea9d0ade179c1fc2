//! What a picture looks like on a screen: the display transform, and PNG files.

use std::io;
use std::path::Path;

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder, ImageError};

use crate::{Frame, FrameError, write_whole};

/// Linear radiance to what a screen shows, both nominally in `[0, 1]`: clamped, then through the sRGB
/// transfer function (IEC 61966-2-1). No tone mapping: values of 1 and more are white. What is not
/// finite is black.
///
/// ```text
/// 12.92 x                    x ≤ 0.0031308
/// 1.055 x^(1/2.4) − 0.055    else
/// ```
pub fn display_transform(linear: f32) -> f32 {
    let x = if linear.is_finite() { linear.clamp(0.0, 1.0) } else { 0.0 };
    if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
}

/// Writes an 8-bit sRGB PNG: each value × 2^`exposure_ev` through [`display_transform`], rounded to the
/// nearest of 255 steps. `rgb` are three planes of `width × height` values, linear, row 0 on top.
///
/// The same planes give the same bytes; the file appears whole or not at all ([`write_whole`]).
///
/// # Errors
///
/// [`FrameError::Unwritable`] if there are no pixels, too many for PNG, or planes of another length;
/// else those of [`write_whole`].
pub fn write_png(
    rgb: [&[f32]; 3],
    width: usize,
    height: usize,
    exposure_ev: f32,
    path: &Path,
) -> Result<(), FrameError> {
    let pixels = width.checked_mul(height).filter(|n| *n > 0 && rgb.iter().all(|plane| plane.len() == *n));
    let (Some(_), Ok(png_width), Ok(png_height)) = (pixels, u32::try_from(width), u32::try_from(height))
    else {
        let problem = format!("planes of {:?} values are no PNG of {width}x{height}", rgb.map(<[f32]>::len));
        return Err(FrameError::unwritable(path, problem));
    };
    let scale = exposure_ev.exp2();
    // A finite value stays finite: bright must not turn black.
    let exposed = |v: f32| if v.is_finite() { (v * scale).clamp(f32::MIN, f32::MAX) } else { v };
    let to_byte = |v: f32| (display_transform(exposed(v)) * 255.0).round() as u8;
    let [r, g, b] = rgb;
    let bytes: Vec<u8> =
        r.iter().zip(g).zip(b).flat_map(|((&r, &g), &b)| [to_byte(r), to_byte(g), to_byte(b)]).collect();
    write_whole(path, |file| {
        PngEncoder::new_with_quality(file, CompressionType::Default, FilterType::Adaptive)
            .write_image(&bytes, png_width, png_height, ExtendedColorType::Rgb8)
            .map_err(|error| match error {
                ImageError::IoError(error) => error,
                other => io::Error::other(other.to_string()),
            })
    })
}

/// [`write_png`] of a frame's `R`, `G` and `B`.
///
/// # Errors
///
/// [`FrameError::MissingChannel`] if the frame lacks one of them; else as [`write_png`].
pub fn write_beauty_png(frame: &Frame, exposure_ev: f32, path: &Path) -> Result<(), FrameError> {
    write_png(frame.rgb()?, frame.width(), frame.height(), exposure_ev, path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn display_transform_has_the_standards_values_and_no_jump() {
        assert_eq!(display_transform(0.0), 0.0);
        assert_eq!(display_transform(-3.0), 0.0);
        assert!((display_transform(1.0) - 1.0).abs() < 1e-6);
        assert_eq!(display_transform(7.0), display_transform(1.0));
        // 0.214041 is the linear value of the middle code value 0.5.
        assert!((display_transform(0.214_041_14) - 0.5).abs() < 1e-6);
        let knee = 0.003_130_8_f32;
        assert!((display_transform(knee.next_up()) - display_transform(knee)).abs() < 1e-6);
    }

    #[test]
    fn what_is_not_finite_is_black() {
        for v in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            assert_eq!(display_transform(v), 0.0);
        }
    }

    #[test]
    fn a_png_holds_the_rounded_bytes_at_its_exposure() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a.png");
        let linear = [0.0, 0.25, 0.5, 1.0, f32::NAN, -1.0];
        write_png([&linear, &[0.5; 6], &[1.0; 6]], 3, 2, -1.0, &path).expect("writes");
        let png = image::open(&path).expect("is a PNG").into_rgb8();
        assert_eq!(png.dimensions(), (3, 2));
        let byte = |v: f32| (display_transform(v) * 255.0).round() as u8;
        assert_eq!(png.get_pixel(1, 0).0, [byte(0.125), byte(0.25), byte(0.5)]);
        assert_eq!(png.get_pixel(0, 1).0, [byte(0.5), byte(0.25), byte(0.5)]);
        assert_eq!(png.get_pixel(1, 1).0[0], 0);
        // sRGB of 0.5 is code value 187.52.
        assert_eq!(png.get_pixel(0, 0).0[2], 188);
        let first = std::fs::read(&path).expect("reads");
        write_png([&linear, &[0.5; 6], &[1.0; 6]], 3, 2, -1.0, &path).expect("writes");
        assert_eq!(std::fs::read(&path).expect("reads"), first);
    }

    #[test]
    fn planes_that_do_not_fit_are_refused() {
        let path = Path::new("never-written.png");
        for (length, width, height) in [(3, 2, 2), (0, 0, 5), (1, usize::MAX, 2)] {
            let plane = vec![0.0; length];
            let error = write_png([&plane; 3], width, height, 0.0, path).expect_err("does not fit");
            assert!(matches!(error, FrameError::Unwritable { .. }), "{error:?}");
        }
        let error = write_beauty_png(&Frame::new(2, 2), 0.0, path).expect_err("has no channels");
        assert!(matches!(error, FrameError::MissingChannel { .. }), "{error:?}");
    }
}
