//! `--records`: every sample of a tile into a file of its own, while the render runs.

use std::path::Path;
use std::sync::atomic::Ordering::Relaxed;
use std::sync::{Mutex, PoisonError};

use limpid_frame::{FrameError, Layer, RecordTile, SampleRecord};
use limpid_renderer::{Progress, Sample, TileSamples};

use crate::error::CliError;

/// Writes tiles, from several threads; the first failure stops the render.
pub struct Records<'a> {
    folder: &'a Path,
    film: (usize, usize),
    progress: &'a Progress,
    failure: Mutex<Option<FrameError>>,
}

impl<'a> Records<'a> {
    /// `film` is the size of the whole film in pixels.
    pub fn new(folder: &'a Path, film: [u32; 2], progress: &'a Progress) -> Self {
        let film = (film[0] as usize, film[1] as usize);
        Self { folder, film, progress, failure: Mutex::new(None) }
    }

    /// Writes one tile.
    pub fn write(&self, tile: &TileSamples) {
        let failed = || self.failure.lock().unwrap_or_else(PoisonError::into_inner);
        if failed().is_some() {
            return;
        }
        if let Err(error) = record(tile, self.film).write(self.folder) {
            failed().get_or_insert(error);
            self.progress.cancel.store(true, Relaxed);
        }
    }

    /// What went wrong, if anything did.
    pub fn finish(self) -> Result<(), CliError> {
        match self.failure.into_inner().unwrap_or_else(PoisonError::into_inner) {
            Some(error) => Err(error.into()),
            None => Ok(()),
        }
    }
}

fn record(tile: &TileSamples, film: (usize, usize)) -> RecordTile {
    let [x, y, width, height, spp] =
        [tile.x, tile.y, tile.width, tile.height, tile.spp].map(|number| number as usize);
    let mut record = RecordTile::new((x, y), (width, height), film, spp);
    for (pixel, samples) in tile.samples.chunks(spp).enumerate() {
        for (i, sample) in samples.iter().enumerate() {
            record.set(i, pixel % width, pixel / width, &sample_record(sample));
        }
    }
    record
}

fn sample_record(sample: &Sample) -> SampleRecord {
    SampleRecord {
        diffuse: values(sample, Layer::Diffuse),
        specular: values(sample, Layer::Specular),
        emission: values(sample, Layer::Emission),
        albedo: values(sample, Layer::Albedo),
        normal: values(sample, Layer::Normal),
        position: values(sample, Layer::Position),
        depth: sample.get(Layer::Depth, 0),
        hit: sample.get(Layer::Hit, 0),
        offset: values(sample, Layer::Offset),
    }
}

fn values<const N: usize>(sample: &Sample, layer: Layer) -> [f32; N] {
    std::array::from_fn(|channel| sample.get(layer, channel))
}
