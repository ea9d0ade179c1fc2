//! Decoding of pictures: PNG, JPEG, BMP, Radiance HDR and OpenEXR.

mod exr;

use std::io::Cursor;

use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader};

use crate::spectrum::linear_from_srgb;
use crate::{Image, Texels};

/// No format here packs pixels tighter than this; what claims to is refused before memory is taken.
const MAX_EXPANSION: u64 = 4096;
/// Bytes that a decoded picture may take whatever its file's size.
const MAX_DECODED: u64 = 8 << 30;

/// Bytes that the picture in a file of `file_len` bytes may take.
fn allowance(file_len: usize) -> u64 {
    (file_len as u64).saturating_mul(MAX_EXPANSION).saturating_add(64 << 10).min(MAX_DECODED)
}

/// Decodes a picture; the format is told by the content. `raw`: bytes are linear values, not sRGB-encoded ones.
///
/// # Errors
///
/// One clause that says what is wrong.
pub(crate) fn decode(bytes: &[u8], raw: bool) -> Result<Image, String> {
    if bytes.starts_with(&exr::MAGIC) {
        return exr::decode(bytes);
    }
    let picture = picture(bytes)?;
    Ok(Image { width: picture.width(), height: picture.height(), texels: texels(picture, raw) })
}

/// Decodes the alpha channel of a picture, as grey; `None` where there is none, or it is 1 everywhere.
///
/// # Errors
///
/// One clause that says what is wrong.
pub(crate) fn decode_alpha(bytes: &[u8]) -> Result<Option<Image>, String> {
    if bytes.starts_with(&exr::MAGIC) {
        return Ok(None); // alpha of these is coverage that is in the colours already
    }
    let picture = picture(bytes)?;
    if !picture.color().has_alpha() {
        return Ok(None);
    }
    let (width, height) = (picture.width(), picture.height());
    let alpha: Vec<u8> = picture.into_rgba8().pixels().map(|pixel| pixel.0[3]).collect();
    if alpha.iter().all(|&a| a == 255) {
        return Ok(None);
    }
    let texels = Texels::Linear8(alpha.iter().flat_map(|&a| [a; 3]).collect());
    Ok(Some(Image { width, height, texels }))
}

/// Decodes what is not OpenEXR.
fn picture(bytes: &[u8]) -> Result<DynamicImage, String> {
    let mut reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format().map_err(|e| e.to_string())?;
    let formats = [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::Bmp, ImageFormat::Hdr];
    if !reader.format().is_some_and(|format| formats.contains(&format)) {
        return Err("not a PNG, JPEG, BMP, Radiance HDR or OpenEXR file".into());
    }
    let allowance = allowance(bytes.len());
    let mut limits = image::Limits::default();
    limits.max_alloc = Some(allowance);
    reader.limits(limits);
    let decoder = reader.into_decoder().map_err(|e| e.to_string())?;
    let (width, height) = decoder.dimensions();
    if width == 0 || height == 0 {
        return Err(format!("{width}x{height} pixels"));
    }
    if decoder.total_bytes() > allowance {
        return Err(format!("{width}x{height} pixels cannot be in a file of {} bytes", bytes.len()));
    }
    DynamicImage::from_decoder(decoder).map_err(|e| e.to_string())
}

fn texels(picture: DynamicImage, raw: bool) -> Texels {
    match picture {
        DynamicImage::ImageLuma8(_)
        | DynamicImage::ImageLumaA8(_)
        | DynamicImage::ImageRgb8(_)
        | DynamicImage::ImageRgba8(_) => {
            let values = picture.into_rgb8().into_raw();
            if raw { Texels::Linear8(values) } else { Texels::Srgb8(values) }
        }
        DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_) => {
            Texels::Linear32(picture.into_rgb32f().into_raw())
        }
        // sixteen bits: kept whole as floats
        _ => {
            let mut values = picture.into_rgb32f().into_raw();
            if !raw {
                values.iter_mut().for_each(|value| *value = linear_from_srgb(*value));
            }
            Texels::Linear32(values)
        }
    }
}

#[cfg(test)]
mod tests;
