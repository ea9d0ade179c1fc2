//! OpenEXR pictures: the first layer that holds colours.

use std::io::Cursor;

use exr::image::FlatSamples;
use exr::meta::MetaData;
use exr::prelude::{ReadChannels, ReadLayers, read};

use super::allowance;
use crate::{Image, Texels};

/// How every OpenEXR file begins.
pub(super) const MAGIC: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];

/// Decodes the first layer that has `R`, `G`, `B` or `Y`; its data window is the picture.
pub(super) fn decode(bytes: &[u8]) -> Result<Image, String> {
    check_sizes(bytes)?;
    // a thread pool costs more than it gains on a small file
    let parallel = bytes.len() > 1 << 20;
    let reader =
        read().no_deep_data().largest_resolution_level().all_channels().all_layers().all_attributes();
    let reader = if parallel { reader } else { reader.non_parallel() };
    let picture = reader.from_buffered(Cursor::new(bytes)).map_err(|e| e.to_string())?;

    for layer in &picture.layer_data {
        let channel = |name: &str| {
            let channels = &layer.channel_data.list;
            channels.iter().find(|c| c.name.eq_case_insensitive(name)).map(|c| &c.sample_data)
        };
        let rgb = match (channel("R"), channel("G"), channel("B"), channel("Y")) {
            (Some(r), Some(g), Some(b), _) => [r, g, b],
            (.., Some(y)) => [y; 3],
            // one channel under another name is a grey picture too
            _ => match &layer.channel_data.list[..] {
                [only] => [&only.sample_data; 3],
                _ => continue,
            },
        };
        let (width, height) = (layer.size.width(), layer.size.height());
        let pixels = width * height;
        if rgb.iter().any(|samples| samples.len() != pixels) {
            return Err("subsampled channels are not read".into());
        }
        let mut texels = vec![0.0; 3 * pixels];
        for (offset, samples) in rgb.into_iter().enumerate() {
            spread(samples, &mut texels[offset..]);
        }
        return Ok(Image { width: width as u32, height: height as u32, texels: Texels::Linear32(texels) });
    }
    Err("no layer has channels R, G, B or Y".into())
}

/// Refuses sizes that the file cannot hold: the decoder would take the memory first and look afterwards.
fn check_sizes(bytes: &[u8]) -> Result<(), String> {
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(|e| e.to_string())?;
    let mut total = 0u64;
    for header in &meta.headers {
        let (width, height) = (header.layer_size.width() as u64, header.layer_size.height() as u64);
        if width == 0 || height == 0 || width > u64::from(u32::MAX) || height > u64::from(u32::MAX) {
            return Err(format!("{width}x{height} pixels"));
        }
        // 4 bytes a sample in the file, and the picture that is made of them
        let samples = (header.channels.list.len() as u64 + 3).saturating_mul(width).saturating_mul(height);
        total = total.saturating_add(samples.saturating_mul(4));
        if total > allowance(bytes.len()) {
            return Err(format!("{width}x{height} pixels cannot be in a file of {} bytes", bytes.len()));
        }
    }
    Ok(())
}

/// Writes samples to every third place.
fn spread(samples: &FlatSamples, texels: &mut [f32]) {
    let places = texels.iter_mut().step_by(3);
    match samples {
        FlatSamples::F16(values) => places.zip(values).for_each(|(place, value)| *place = value.to_f32()),
        FlatSamples::F32(values) => places.zip(values).for_each(|(place, value)| *place = *value),
        FlatSamples::U32(values) => places.zip(values).for_each(|(place, value)| *place = *value as f32),
    }
}
