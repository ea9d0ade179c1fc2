//! Per-sample data: one file of named tensors a tile.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use safetensors::tensor::{Dtype, SafeTensors, TensorView};
use serde::{Deserialize, Serialize};

use crate::whole::{open_regular, output_error};
use crate::{FrameError, write_whole};

#[cfg(test)]
mod tests;

/// What one sample saw; each field as the frame's layer of that name defines it, before averaging.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SampleRecord {
    /// Radiance through the diffuse part of the first non-delta vertex.
    pub diffuse: [f32; 3],
    /// Radiance through its specular part.
    pub specular: [f32; 3],
    /// Radiance of lights and background seen directly; the three add up to the sample's radiance.
    pub emission: [f32; 3],
    /// Albedo at the feature hit.
    pub albedo: [f32; 3],
    /// Unit shading normal at the feature hit, 0 for background.
    pub normal: [f32; 3],
    /// Position of the feature hit, 0 for background.
    pub position: [f32; 3],
    /// Distance of the first hit; 0 where nothing is hit.
    pub depth: f32,
    /// 1 where something is hit, else 0.
    pub hit: f32,
    /// Where in the pixel the sample lies, relative to its centre, in pixels.
    pub offset: [f32; 2],
}

/// Name, channels and unit of each tensor of a file.
const TENSORS: [(&str, usize, &str); 9] = [
    ("radiance.diffuse", 3, "W/(sr m^2) in linear Rec. 709"),
    ("radiance.specular", 3, "W/(sr m^2) in linear Rec. 709"),
    ("radiance.emission", 3, "W/(sr m^2) in linear Rec. 709"),
    ("albedo", 3, "reflected fraction"),
    ("normal", 3, "unit vector in world space, 0 for background"),
    ("position", 3, "scene units, relative to the origin in the frame's header"),
    ("depth", 1, "scene units along the ray, 0 where nothing is hit"),
    ("hit", 1, "1 where something is hit, else 0"),
    ("offset", 2, "pixels from the pixel's centre"),
];

/// The metadata's one key. Its value is JSON: a hash map with several keys would be written in an order
/// that changes from run to run.
const KEY: &str = "limpid";
const FORMAT: &str = "limpid records 1";

/// Everything about a file but its tensors.
#[derive(Serialize, Deserialize)]
struct Description {
    format: String,
    layout: String,
    x: usize,
    y: usize,
    width: usize,
    height: usize,
    spp: usize,
    film_width: usize,
    film_height: usize,
    units: BTreeMap<String, String>,
}

/// All samples of one tile of the film.
///
/// As a file: safetensors, `f32` tensors of shape `[sample, channel, y, x]` named `radiance.diffuse`,
/// `radiance.specular`, `radiance.emission`, `albedo`, `normal`, `position` (3 channels each), `depth`,
/// `hit` (1) and `offset` (2). The metadata entry `limpid` is a JSON object with the tile's place
/// (`x`, `y`, `width`, `height`), `film_width`, `film_height`, `spp` and the `units`. Summed in double
/// precision in the order of the samples and divided by their number, a tensor is the frame's layer to
/// one unit in the last place; the depth layer is the mean over the samples with a hit.
/// `examples/records.py` does it in Python.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordTile {
    x: usize,
    y: usize,
    width: usize,
    height: usize,
    spp: usize,
    film: (usize, usize),
    /// One for each of [`TENSORS`], `[sample, channel, y, x]`.
    tensors: Vec<Vec<f32>>,
}

impl RecordTile {
    /// A tile of `size` pixels whose top left pixel is `origin` in a film of `film` pixels, all as
    /// (x, y), with `spp` samples a pixel, all zero.
    pub fn new(origin: (usize, usize), size: (usize, usize), film: (usize, usize), spp: usize) -> Self {
        let values = |channels: usize| vec![0.0; spp * channels * size.0 * size.1];
        let tensors = TENSORS.iter().map(|(_, channels, _)| values(*channels)).collect();
        Self { x: origin.0, y: origin.1, width: size.0, height: size.1, spp, film, tensors }
    }

    /// The top left pixel in the film, (x, y).
    pub fn origin(&self) -> (usize, usize) {
        (self.x, self.y)
    }

    /// Width and height in pixels.
    pub fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// Width and height of the whole film in pixels.
    pub fn film(&self) -> (usize, usize) {
        self.film
    }

    /// Samples a pixel.
    pub fn spp(&self) -> usize {
        self.spp
    }

    /// One tensor by its name in the file, `[sample, channel, y, x]`.
    pub fn tensor(&self, name: &str) -> Option<&[f32]> {
        TENSORS.iter().position(|(known, ..)| *known == name).map(|i| self.tensors[i].as_slice())
    }

    /// Sets one sample of the pixel (x, y) of this tile.
    ///
    /// # Panics
    ///
    /// If there is no such sample or pixel.
    pub fn set(&mut self, sample: usize, x: usize, y: usize, record: &SampleRecord) {
        let pixel = self.pixel(sample, x, y);
        let plane = self.width * self.height;
        let values: [&[f32]; TENSORS.len()] = [
            &record.diffuse,
            &record.specular,
            &record.emission,
            &record.albedo,
            &record.normal,
            &record.position,
            &[record.depth],
            &[record.hit],
            &record.offset,
        ];
        for (tensor, values) in self.tensors.iter_mut().zip(values) {
            for (channel, value) in values.iter().enumerate() {
                tensor[(sample * values.len() + channel) * plane + pixel] = *value;
            }
        }
    }

    /// One sample of the pixel (x, y) of this tile.
    ///
    /// # Panics
    ///
    /// If there is no such sample or pixel.
    pub fn get(&self, sample: usize, x: usize, y: usize) -> SampleRecord {
        let pixel = self.pixel(sample, x, y);
        let plane = self.width * self.height;
        let value = |tensor: usize, channels: usize, channel: usize| {
            self.tensors[tensor][(sample * channels + channel) * plane + pixel]
        };
        let rgb = |tensor| std::array::from_fn(|channel| value(tensor, 3, channel));
        SampleRecord {
            diffuse: rgb(0),
            specular: rgb(1),
            emission: rgb(2),
            albedo: rgb(3),
            normal: rgb(4),
            position: rgb(5),
            depth: value(6, 1, 0),
            hit: value(7, 1, 0),
            offset: [value(8, 2, 0), value(8, 2, 1)],
        }
    }

    fn pixel(&self, sample: usize, x: usize, y: usize) -> usize {
        assert!(
            sample < self.spp && x < self.width && y < self.height,
            "sample {sample} of pixel ({x}, {y}) in a tile of {}x{} pixels with {} samples",
            self.width,
            self.height,
            self.spp
        );
        y * self.width + x
    }

    /// Writes the tile into `folder`, which is made if it is missing, as `tile_YYYYY_XXXXX.safetensors`
    /// after its top left pixel; returns the path. The same tile gives the same bytes.
    ///
    /// # Errors
    ///
    /// Those of [`write_whole`].
    pub fn write(&self, folder: &Path) -> Result<PathBuf, FrameError> {
        fs::create_dir_all(folder).map_err(|error| output_error(folder, error))?;
        let path = folder.join(format!("tile_{:05}_{:05}.safetensors", self.y, self.x));
        let unwritable = |error: &dyn std::error::Error| FrameError::unwritable(&path, error.to_string());

        let bytes: Vec<Vec<u8>> =
            self.tensors.iter().map(|t| t.iter().flat_map(|v| v.to_le_bytes()).collect()).collect();
        let mut views = Vec::new();
        for ((name, channels, _), bytes) in TENSORS.iter().zip(&bytes) {
            let shape = vec![self.spp, *channels, self.height, self.width];
            views.push((*name, TensorView::new(Dtype::F32, shape, bytes).map_err(|e| unwritable(&e))?));
        }
        let description = serde_json::to_string(&self.description()).map_err(|e| unwritable(&e))?;
        let metadata = [(KEY.to_owned(), description)].into_iter().collect();
        let file_bytes = safetensors::serialize(views, Some(metadata)).map_err(|e| unwritable(&e))?;
        write_whole(&path, |file| std::io::Write::write_all(file, &file_bytes))?;
        Ok(path)
    }

    fn description(&self) -> Description {
        Description {
            format: FORMAT.to_owned(),
            layout: "[sample, channel, y, x]".to_owned(),
            x: self.x,
            y: self.y,
            width: self.width,
            height: self.height,
            spp: self.spp,
            film_width: self.film.0,
            film_height: self.film.1,
            units: TENSORS.iter().map(|(name, _, unit)| ((*name).to_owned(), (*unit).to_owned())).collect(),
        }
    }

    /// Reads a file that [`write`](Self::write) wrote.
    ///
    /// # Errors
    ///
    /// [`FrameError::CannotRead`], and [`FrameError::Malformed`] if the file is not one of ours or not whole.
    pub fn read(path: &Path) -> Result<Self, FrameError> {
        let (mut file, length) = open_regular(path)?;
        let mut bytes = Vec::with_capacity(length as usize);
        std::io::Read::read_to_end(&mut file, &mut bytes)
            .map_err(|source| FrameError::CannotRead { path: path.to_owned(), source })?;
        decode(&bytes).map_err(|problem| FrameError::malformed(path, problem))
    }
}

/// The tile in a file's bytes, or what is wrong with them. Needs no more memory than the file.
fn decode(bytes: &[u8]) -> Result<RecordTile, String> {
    let not_safetensors = |error| format!("no safetensors file: {error}");
    let (_, header) = SafeTensors::read_metadata(bytes).map_err(not_safetensors)?;
    let file = SafeTensors::deserialize(bytes).map_err(not_safetensors)?;
    let description = header
        .metadata()
        .as_ref()
        .and_then(|metadata| metadata.get(KEY))
        .ok_or_else(|| format!("no records: the metadata have no `{KEY}`"))?;
    let d: Description =
        serde_json::from_str(description).map_err(|error| format!("metadata `{KEY}`: {error}"))?;
    if d.format != FORMAT {
        return Err(format!("format `{}`, where `{FORMAT}` is known", d.format));
    }
    let mut tensors = Vec::new();
    for (name, channels, _) in TENSORS {
        let tensor = file.tensor(name).map_err(|error| format!("tensor `{name}`: {error}"))?;
        let shape = [d.spp, channels, d.height, d.width];
        if tensor.dtype() != Dtype::F32 || tensor.shape() != shape {
            return Err(format!(
                "tensor `{name}`: {:?} {:?}, the metadata want F32 {shape:?}",
                tensor.dtype(),
                tensor.shape()
            ));
        }
        let (values, _) = tensor.data().as_chunks::<4>();
        tensors.push(values.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect());
    }
    let film = (d.film_width, d.film_height);
    Ok(RecordTile { x: d.x, y: d.y, width: d.width, height: d.height, spp: d.spp, film, tensors })
}
