//! Reading EXR, ours and others'.

use std::collections::HashSet;
use std::io::{self, BufReader, Read, Seek};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use exr::block::chunk::{Chunk, CompressedBlock, CompressedScanLineBlock, CompressedTileBlock};
use exr::block::reader::{ChunksReader, Reader};
use exr::block::{BlockIndex, UncompressedBlock};
use exr::error::Error as ExrError;
use exr::math::Vec2;
use exr::meta::MetaData;
use exr::meta::attribute::SampleType;
use exr::meta::header::Header;
use exr::prelude::{Compression, f16};
use rayon::prelude::*;

use super::window::empty_window;
use super::{decode_text, is_metadata_name, text_of};
use crate::whole::open_regular;
use crate::{Frame, FrameError};

/// A header may declare at most this many times the file's length, plus [`SLACK`]. ZIP shrinks a
/// constant picture by a thousand; only made-up headers ask for more.
const MAX_RATIO: u64 = 4096;
/// What any file may declare, in bytes.
const SLACK: u64 = 64 << 10;
/// What no file may declare, in bytes: 100 channels at 8K are 13 GiB.
const MAX_BYTES: u64 = 32 << 30;
/// A single block of up to this many bytes is read even where the whole picture is smaller.
const SMALL_BLOCK: u64 = 16 << 20;

/// Names of parts that mean the picture itself: their channels get no prefix.
const BEAUTY_PARTS: [&str; 4] = ["", "beauty", "rgba", "rgb"];

/// Reads the data window of an EXR file, of any compression, scan lines or tiles; of a mip map its
/// finest level. 16-bit and integer channels become `f32` (integers above 2²⁴ are rounded).
///
/// In a file of several parts, a channel's name is `PART.CHANNEL`, unless the part has no name or is
/// called beauty, rgb or rgba, or the name begins with that of the part already; all parts must have the
/// same size. Text attributes become metadata, all others are left. Values that are not finite are kept.
///
/// No more memory is asked for than 4096 times the file's length, and never more than 32 GiB.
///
/// # Errors
///
/// [`FrameError::CannotRead`] if there is no such file or the system fails to read it,
/// [`FrameError::Malformed`] if it is not EXR, is cut short, contradicts itself or declares more than it
/// can hold, or has deep or subsampled channels.
pub fn read_exr(path: &Path) -> Result<Frame, FrameError> {
    let (file, length) = open_regular(path)?;
    decode(BufReader::with_capacity(1 << 18, file), length).map_err(|problem| match problem {
        Problem::Io(source) => FrameError::CannotRead { path: path.to_owned(), source },
        Problem::Malformed(problem) => FrameError::malformed(path, problem),
    })
}

/// What is wrong with a stream of bytes.
#[derive(Debug)]
pub(super) enum Problem {
    Io(io::Error),
    Malformed(String),
}

impl From<ExrError> for Problem {
    fn from(error: ExrError) -> Self {
        match error {
            // Offsets beyond all that can be asked of a file.
            ExrError::Io(error) if error.kind() == io::ErrorKind::InvalidInput => {
                Problem::Malformed("damaged EXR: an offset points outside the file".to_owned())
            }
            ExrError::Io(error) => Problem::Io(error),
            ExrError::NotSupported(what) => Problem::Malformed(format!("unsupported EXR: {what}")),
            ExrError::Invalid(what) if what == "file identifier missing" => {
                Problem::Malformed("this is not an EXR file; name the frame (.exr), not its PNG".to_owned())
            }
            // The crate's words for an unexpected end.
            ExrError::Invalid(what) if what == "reference to missing bytes" => {
                Problem::Malformed("the EXR file is cut short".to_owned())
            }
            other => Problem::Malformed(format!("damaged EXR: {other}")),
        }
    }
}

fn malformed(problem: impl Into<String>) -> Problem {
    Problem::Malformed(problem.into())
}

/// Decodes `length` bytes. The crate's decoders assert and index as if blocks were well-formed; where one
/// of them panics on damage, that is the file's fault and no reason to end the program.
pub(super) fn decode(bytes: impl Read + Seek, length: u64) -> Result<Frame, Problem> {
    catch_unwind(AssertUnwindSafe(|| decode_trusting(bytes, length)))
        .unwrap_or_else(|_| Err(malformed("damaged EXR: a block makes no sense")))
}

fn decode_trusting(mut bytes: impl Read + Seek, length: u64) -> Result<Frame, Problem> {
    if let Some([x_min, y_min, x_max, y_max]) = empty_window(&mut bytes).map_err(Problem::Io)? {
        return Err(malformed(format!(
            "the EXR file holds nothing: dataWindow from ({x_min}, {y_min}) to ({x_max}, {y_max})"
        )));
    }
    let reader = Reader::read_from_buffered(bytes, false)?;
    let size = check(reader.headers(), length)?;
    let names = channel_names(reader.headers())?;
    let mut planes: Vec<Vec<Vec<f32>>> =
        names.iter().map(|part| vec![vec![0.0; size.area()]; part.len()]).collect();

    let mut missing = HashSet::new();
    let chunks = reader.filter_chunks(false, |_, _, block| {
        let finest = block.level == Vec2(0, 0);
        if finest {
            missing.insert(block);
        }
        finest
    })?;
    let metadata = read_blocks(chunks, &mut missing, &mut planes, size.width())?;

    let mut frame = Frame::new(size.width(), size.height());
    for (name, plane) in names.into_iter().flatten().zip(planes.into_iter().flatten()) {
        frame.insert(name, plane);
    }
    for header in metadata.headers.iter().rev() {
        frame.metadata.extend(text_attributes(header)); // the first part has the last word
    }
    Ok(frame)
}

/// Refuses headers that ask for more memory than the file can fill; gives the size of all parts.
fn check(headers: &[Header], length: u64) -> Result<Vec2<usize>, Problem> {
    let limit = length.saturating_mul(MAX_RATIO).saturating_add(SLACK).min(MAX_BYTES);
    let first = headers.first().ok_or_else(|| malformed("the EXR file has no parts"))?;
    let mut total = 0_u64;
    for header in headers {
        let Vec2(width, height) = header.layer_size;
        if header.layer_size != first.layer_size {
            return Err(malformed(format!(
                "parts of different sizes cannot be one frame: dataWindow {}x{} and {width}x{height}",
                first.layer_size.width(),
                first.layer_size.height()
            )));
        }
        if width == 0 || height == 0 || header.channels.list.is_empty() {
            return Err(malformed(format!(
                "the EXR file holds nothing: dataWindow {width}x{height}, {} channels",
                header.channels.list.len()
            )));
        }
        // Planes are f32 whatever the file has.
        let bytes = bytes_of(header.layer_size, header.channels.list.len().saturating_mul(4));
        total = total.saturating_add(bytes);
        if total > limit {
            return Err(malformed(format!(
                "dataWindow {width}x{height} with {} channels is more than a file of {length} bytes can hold",
                header.channels.list.len()
            )));
        }
        let block = header.max_block_pixel_size();
        if bytes_of(block, header.channels.bytes_per_pixel) > limit.max(SMALL_BLOCK) {
            return Err(malformed(format!(
                "tiles of {}x{} pixels are more than a file of {length} bytes can hold",
                block.width(),
                block.height()
            )));
        }
    }
    Ok(first.layer_size)
}

fn bytes_of(size: Vec2<usize>, bytes_per_pixel: usize) -> u64 {
    (size.width() as u64).saturating_mul(size.height() as u64).saturating_mul(bytes_per_pixel as u64)
}

/// The frame's name for each channel of each part, all different.
fn channel_names(headers: &[Header]) -> Result<Vec<Vec<String>>, Problem> {
    let mut seen = HashSet::new();
    let mut names = Vec::new();
    for header in headers {
        let part = match &header.own_attributes.layer_name {
            Some(name) if headers.len() > 1 => decode_text(name.as_slice()),
            _ => String::new(),
        };
        let is_beauty = BEAUTY_PARTS.contains(&part.to_ascii_lowercase().as_str());
        let prefix = if is_beauty { String::new() } else { format!("{part}.") };
        let mut of_part = Vec::new();
        for channel in &header.channels.list {
            let channel = decode_text(channel.name.as_slice());
            let name = if channel.starts_with(&prefix) { channel } else { format!("{prefix}{channel}") };
            if !seen.insert(name.clone()) {
                return Err(malformed(format!("two channels of the EXR file are called `{name}`")));
            }
            of_part.push(name);
        }
        names.push(of_part);
    }
    Ok(names)
}

/// Fills `planes[part][channel]` with all blocks; gives the headers back.
fn read_blocks(
    mut chunks: impl ChunksReader,
    missing: &mut HashSet<BlockIndex>,
    planes: &mut [Vec<Vec<f32>>],
    width: usize,
) -> Result<MetaData, Problem> {
    let metadata = chunks.meta_data().clone();
    let expected = missing.len();
    loop {
        // Decompressed in parallel, a few blocks for each thread at a time.
        let batch: Vec<Chunk> =
            chunks.by_ref().take(2 * rayon::current_num_threads()).collect::<Result<_, _>>()?;
        if batch.is_empty() {
            break;
        }
        let blocks: Vec<Result<UncompressedBlock, Problem>> = batch
            .into_par_iter()
            .map(|chunk| {
                check_dwa(&chunk, &metadata)?;
                Ok(UncompressedBlock::decompress_chunk(chunk, &metadata, false)?)
            })
            .collect();
        for block in blocks {
            let block = block?;
            if missing.remove(&block.index) {
                insert(&metadata, &block, planes, width)?;
            }
        }
    }
    if !missing.is_empty() {
        return Err(malformed(format!("{} of the EXR file's {expected} blocks are missing", missing.len())));
    }
    Ok(metadata)
}

/// Refuses a DWA block whose own header, eleven 64-bit words, declares more than its pixels can be: the
/// crate would ask for that memory.
fn check_dwa(chunk: &Chunk, metadata: &MetaData) -> Result<(), Problem> {
    /// Bytes or 16-bit values of the four sections when unpacked.
    const UNPACKED: [usize; 5] = [1, 6, 7, 8, 9];
    let header = &metadata.headers[chunk.layer_index];
    let (CompressedBlock::ScanLine(CompressedScanLineBlock { compressed_pixels_le: bytes, .. })
    | CompressedBlock::Tile(CompressedTileBlock { compressed_pixels_le: bytes, .. })) =
        &chunk.compressed_block
    else {
        return Ok(());
    };
    if !matches!(header.compression, Compression::DWAA(_) | Compression::DWAB(_)) {
        return Ok(());
    }
    let place = header.get_block_data_indices(&chunk.compressed_block)?;
    let size = header.get_absolute_block_pixel_coordinates(place)?.size;
    if bytes.len() as u64 == bytes_of(size, header.channels.bytes_per_pixel) {
        return Ok(()); // stored as it is, without such a header
    }
    // Transformed in squares of 8x8; run lengths can take twice the space of what they encode.
    let padded = Vec2(size.width().next_multiple_of(8), size.height().next_multiple_of(8));
    let limit = bytes_of(padded, header.channels.list.len().saturating_mul(8));
    let (words, _) = bytes.as_chunks::<8>();
    let too_large = |word: &usize| words.get(*word).is_some_and(|w| u64::from_le_bytes(*w) > limit);
    if UNPACKED.iter().any(too_large) {
        return Err(malformed("damaged EXR: a DWA block declares more than its pixels"));
    }
    Ok(())
}

/// Copies a block's rows to their places.
fn insert(
    metadata: &MetaData,
    block: &UncompressedBlock,
    planes: &mut [Vec<Vec<f32>>],
    width: usize,
) -> Result<(), Problem> {
    let part = block.index.layer;
    let channels = &metadata.headers[part].channels;
    if block.data.len() != block.index.pixel_size.area() * channels.bytes_per_pixel {
        return Err(malformed("damaged EXR: a block has the wrong length"));
    }
    for line in block.lines(channels) {
        let at = line.location.position.y() * width + line.location.position.x();
        let row = &mut planes[part][line.location.channel][at..at + line.location.sample_count];
        match channels.list[line.location.channel].sample_type {
            SampleType::F32 => fill(row, line.value, f32::from_ne_bytes),
            SampleType::F16 => fill(row, line.value, |bytes| f16::from_ne_bytes(bytes).to_f32()),
            SampleType::U32 => fill(row, line.value, |bytes| u32::from_ne_bytes(bytes) as f32),
        }
    }
    Ok(())
}

fn fill<const N: usize>(row: &mut [f32], bytes: &[u8], value: impl Fn([u8; N]) -> f32) {
    let (samples, _) = bytes.as_chunks::<N>();
    for (pixel, sample) in row.iter_mut().zip(samples) {
        *pixel = value(*sample);
    }
}

/// The text attributes of one part that can be written again under their names.
fn text_attributes(header: &Header) -> Vec<(String, String)> {
    header
        .all_named_attributes()
        .filter(|(name, _)| is_metadata_name(name))
        .filter_map(|(name, value)| Some((decode_text(name), text_of(&value)?)))
        .collect()
}
