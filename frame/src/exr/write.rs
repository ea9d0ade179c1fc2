//! Writing EXR.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::Path;

use exr::block::chunk::{Chunk, CompressedBlock};
use exr::block::{BlockIndex, UncompressedBlock};
use exr::math::Vec2;
use exr::meta::attribute::{self, AttributeValue, ChannelDescription, LineOrder, SampleType, Text};
use exr::meta::header::{Header, LayerAttributes};
use exr::meta::{BlockDescription, Requirements, magic_number, sequence_end};
use exr::prelude::{Compression, f16};
use rayon::prelude::*;

use super::{is_metadata_name, is_name};
use crate::{Frame, FrameError, write_whole};

/// Writes a frame as one flat part: a 32-bit float channel for each of its channels, under the same
/// name, ZIP compressed in blocks of 16 rows; its metadata are text attributes.
///
/// All cores compress, about 35 MB a second each; that is nearly all of the time it takes. (Lower effort is
/// up to six times as fast on noise, but twice as large where the picture is clean.)
///
/// The same frame gives the same bytes, whatever the number of threads. NaN and infinities are kept to
/// the bit. The file appears whole or not at all ([`write_whole`]).
///
/// # Errors
///
/// [`FrameError::Unwritable`] if the frame has no pixels or no channels, a name that is empty, longer
/// than 255 bytes or has a zero byte, or metadata under a name that EXR reserves (`compression`);
/// else those of [`write_whole`].
pub fn write_exr(frame: &Frame, path: &Path) -> Result<(), FrameError> {
    write(frame, path, &BTreeSet::new())
}

/// Like [`write_exr`] with 16-bit channels, half the size and 11 bits of precision. A layer with a
/// finite value that would become infinite (65520 and more) is kept in 32 bits; the names of such
/// channels are returned, so that the user can be told.
///
/// # Errors
///
/// As [`write_exr`].
pub fn write_exr_half(frame: &Frame, path: &Path) -> Result<Vec<String>, FrameError> {
    let layer = |name: &str| name.rsplit_once('.').map_or(String::new(), |(layer, _)| layer.to_owned());
    let too_large = |v: &f32| v.is_finite() && f16::from_f32(*v).is_infinite();
    let kept: BTreeSet<String> = frame
        .channels()
        .filter(|(_, plane)| plane.iter().any(too_large))
        .map(|(name, _)| layer(name))
        .collect();
    let (kept, half): (Vec<_>, Vec<_>) =
        frame.channels().map(|(name, _)| name.to_owned()).partition(|name| kept.contains(&layer(name)));
    write(frame, path, &half.into_iter().collect())?;
    Ok(kept)
}

/// Writes with the channels named in `half` in 16 bits.
fn write(frame: &Frame, path: &Path, half: &BTreeSet<String>) -> Result<(), FrameError> {
    let header = header(frame, half).map_err(|problem| FrameError::unwritable(path, problem))?;
    let mut attributes: BTreeMap<Vec<u8>, AttributeValue> =
        header.all_named_attributes().map(|(name, value)| (name.to_vec(), value)).collect();
    for (name, value) in &frame.metadata {
        if !is_metadata_name(name.as_bytes()) {
            let problem = format!("`{}` cannot be the name of a text attribute", name.escape_debug());
            return Err(FrameError::unwritable(path, problem));
        }
        // UTF-8, as the OpenEXR library reads it; the crate's own conversion knows Latin-1 only.
        let text = AttributeValue::Text(Text::from_slice_unchecked(value.as_bytes()));
        attributes.insert(name.as_bytes().to_vec(), text);
    }

    let planes: Vec<Plane> =
        frame.channels().map(|(name, plane)| Plane { values: plane, half: half.contains(name) }).collect();
    write_whole(path, |file| {
        write_header(file, &attributes)?;
        write_blocks(file, &header, &planes)
    })
}

/// One channel and whether it is stored in 16 bits.
struct Plane<'a> {
    values: &'a [f32],
    half: bool,
}

/// The structure of the file, or why this frame cannot be one.
fn header(frame: &Frame, half: &BTreeSet<String>) -> Result<Header, String> {
    let mut channels = Vec::new();
    for (name, _) in frame.channels() {
        if !is_name(name.as_bytes()) {
            return Err(format!("`{}` cannot be the name of a channel", name.escape_debug()));
        }
        let sample_type = if half.contains(name) { SampleType::F16 } else { SampleType::F32 };
        channels.push(ChannelDescription {
            name: Text::from_slice_unchecked(name.as_bytes()),
            sample_type,
            quantize_linearly: false,
            sampling: Vec2(1, 1),
        });
    }
    if channels.is_empty() || frame.is_empty() {
        return Err(format!(
            "a frame of {}x{} pixels and {} channels holds nothing",
            frame.width(),
            frame.height(),
            channels.len()
        ));
    }
    // Block lengths and coordinates are signed 32-bit in the file.
    let block_bytes = frame.width().saturating_mul(channels.len() * 4 * 16);
    if block_bytes > i32::MAX as usize || frame.height() > i32::MAX as usize {
        return Err(format!("{}x{} pixels are too many for EXR", frame.width(), frame.height()));
    }
    let size = Vec2(frame.width(), frame.height());
    Ok(Header::new(Text::from("unnamed"), size, channels.into())
        .with_attributes(LayerAttributes::default())
        .with_encoding(Compression::ZIP16, BlockDescription::ScanLines, LineOrder::Increasing))
}

/// The magic number, the version and the attributes in the order of their names.
fn write_header(file: &mut impl Write, attributes: &BTreeMap<Vec<u8>, AttributeValue>) -> io::Result<()> {
    let channel_names = attributes.values().filter_map(|value| match value {
        AttributeValue::ChannelList(list) => Some(list.list.iter().map(|c| c.name.as_slice().len())),
        _ => None,
    });
    let longest = attributes.keys().map(Vec::len).chain(channel_names.flatten()).max().unwrap_or(0);
    let requirements = Requirements {
        file_format_version: 2,
        is_single_layer_and_tiled: false,
        has_long_names: longest > 31,
        has_deep_data: false,
        has_multiple_layers: false,
    };
    magic_number::write(file).map_err(io_error)?;
    requirements.write(file).map_err(io_error)?;
    for (name, value) in attributes {
        attribute::write(name, value, file).map_err(io_error)?;
    }
    sequence_end::write(file).map_err(io_error)
}

/// The table of offsets and the blocks, from the top down: compressed in parallel, written in order.
fn write_blocks(file: &mut BufWriter<&mut File>, header: &Header, planes: &[Plane]) -> io::Result<()> {
    let blocks: Vec<BlockIndex> =
        exr::block::enumerate_ordered_header_block_indices(std::slice::from_ref(header))
            .map(|(_, block)| block)
            .collect();
    let table_start = file.stream_position()?;
    let mut offset = table_start + 8 * blocks.len() as u64;
    let mut offsets = Vec::with_capacity(blocks.len());
    file.seek(SeekFrom::Start(offset))?;

    // A few blocks for each thread at a time: the memory stays small next to the frame's.
    for batch in blocks.chunks(2 * rayon::current_num_threads()) {
        let chunks: Vec<io::Result<Chunk>> =
            batch.par_iter().map(|&block| compress(header, planes, block)).collect();
        for chunk in chunks {
            let chunk = chunk?;
            if let CompressedBlock::ScanLine(lines) = &chunk.compressed_block {
                offsets.push(offset);
                offset += 8 + lines.compressed_pixels_le.len() as u64; // row and length stand before the data
            }
            chunk.write(file, 1).map_err(io_error)?;
        }
    }

    file.seek(SeekFrom::Start(table_start))?;
    offsets.iter().try_for_each(|offset| file.write_all(&offset.to_le_bytes()))
}

/// One block of rows: for each row, for each channel, its values.
fn compress(header: &Header, planes: &[Plane], block: BlockIndex) -> io::Result<Chunk> {
    let width = header.layer_size.width();
    let rows = block.pixel_position.y()..block.pixel_position.y() + block.pixel_size.height();
    let mut data = Vec::with_capacity(header.channels.bytes_per_pixel * block.pixel_size.area());
    for y in rows {
        for plane in planes {
            let row = &plane.values[y * width..(y + 1) * width];
            if plane.half {
                data.extend(row.iter().flat_map(|v| f16::from_f32(*v).to_ne_bytes()));
            } else {
                data.extend(row.iter().flat_map(|v| v.to_ne_bytes()));
            }
        }
    }
    let block = UncompressedBlock { index: block, data };
    block.compress_to_chunk(std::slice::from_ref(header)).map_err(io_error)
}

fn io_error(error: exr::error::Error) -> io::Error {
    match error {
        exr::error::Error::Io(error) => error,
        other => io::Error::other(other.to_string()),
    }
}
