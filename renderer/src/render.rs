//! The only entry: a prepared scene and settings become a frame.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};

use limpid_frame::Frame;
use rayon::prelude::*;

use crate::camera::Camera;
use crate::effects::{Counters, Effect};
use crate::film::{Film, Sample, Tile};
use crate::path::{Batch, Context, accumulate, trace};
use crate::prepare::Prepared;
use crate::sampling::PixelFilterSampler;
use crate::settings::Settings;

/// Paths in a batch: with their queues about 700 KiB, so that a batch stays in a core's own cache.
const BATCH: usize = 2048;
/// Samples of a pass: often enough for a preview, seldom enough that its seams cost nothing.
const PASS: u32 = 16;

/// Seen and steered from other threads while a render runs.
#[derive(Debug, Default)]
pub struct Progress {
    /// Set it to stop after what is being traced. Every pixel gets at least its first pass, except with a recorder: there
    /// tiles that were not begun stay empty.
    pub cancel: AtomicBool,
    /// Samples done.
    pub samples: AtomicU64,
    /// Samples to do; 0 until the render has begun.
    pub total: AtomicU64,
    /// Rays traced, those towards lights included.
    pub rays: AtomicU64,
}

/// A frame and what it took.
#[derive(Debug)]
pub struct Rendered {
    /// The layers that were asked for.
    pub frame: Frame,
    /// The beauty with its halves, for the error figure; `None` with one sample per pixel.
    pub halves: Option<Frame>,
    /// Samples that every pixel has; fewer than asked for where the render was cancelled.
    pub spp: u32,
    /// What was done.
    pub counters: Counters,
    /// Samples with a contribution that was not finite and counts as 0.
    pub rejected: u64,
    /// The first pixel, in reading order of the film, that has one.
    pub first_rejected: Option<[u32; 2]>,
    /// The render was cancelled: pixels may have fewer samples than asked for.
    pub interrupted: bool,
}

/// A finished tile with every single sample, handed out when records are asked for.
pub struct TileSamples<'a> {
    /// First pixel in the whole film.
    pub x: u32,
    /// First pixel in the whole film.
    pub y: u32,
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// Samples per pixel.
    pub spp: u32,
    /// `[pixel][sample]`, rows from the top.
    pub samples: &'a [Sample],
}

/// Takes tiles with their samples, from several threads, in any order.
pub type Recorder<'a> = &'a (dyn Fn(TileSamples) + Sync);

/// Renders. With a `recorder` every tile's samples are handed out, and the film is made in one pass.
pub fn render(
    scene: &Prepared,
    settings: &Settings,
    progress: &Progress,
    recorder: Option<Recorder>,
) -> Rendered {
    let (origin, width, height) = match settings.crop {
        Some(crop) => ([crop.x, crop.y], crop.width, crop.height),
        None => ([0, 0], settings.width, settings.height),
    };
    let mut film = Film::new(origin, width, height, settings.tile, &settings.layers);
    progress.samples.store(0, Relaxed);
    progress.rays.store(0, Relaxed);
    progress.total.store(u64::from(width) * u64::from(height) * u64::from(settings.spp), Relaxed);

    let pool = rayon::ThreadPoolBuilder::new().num_threads(settings.threads.unwrap_or(0)).build();
    let tally = Tally::default();
    let mut run = || {
        let mut begin = 0;
        while begin < settings.spp && (begin == 0 || !progress.cancel.load(Relaxed)) {
            let end = if recorder.is_some() { settings.spp } else { pass_end(begin).min(settings.spp) };
            pass(scene, settings, progress, recorder, &mut film, begin..end, &tally);
            begin = end;
        }
    };
    match pool {
        Ok(pool) => pool.install(run),
        Err(_) => run(), // no threads to be had: the global pool does
    }

    let interrupted = film.tiles.iter().any(|tile| tile.samples < settings.spp);
    let (counters, rejected, first_rejected) = tally.totals();
    let mut frame = film.develop();
    let spp = film.tiles.iter().map(|tile| tile.samples).min().unwrap_or(0);
    describe(scene, settings, spp, rejected, &mut frame);
    Rendered { frame, halves: film.beauty_halves(), spp, counters, rejected, first_rejected, interrupted }
}

/// Passes are aligned blocks of samples: 2, 4, 8, 16 and then every 16.
fn pass_end(begin: u32) -> u32 {
    match begin {
        0 => 2,
        _ => begin.saturating_mul(2).min(begin.saturating_add(PASS)),
    }
}

/// What threads count; sums do not depend on their order.
#[derive(Default)]
struct Tally {
    batches: Mutex<Vec<Batch>>,
    rejected: AtomicU64,
    /// y in the upper half, x in the lower, plus one; 0 for none.
    first_rejected: AtomicU64,
}

impl Tally {
    fn reject(&self, [x, y]: [u32; 2]) {
        self.rejected.fetch_add(1, Relaxed);
        let key = (u64::from(y) << 32 | u64::from(x)) + 1;
        let _ = self
            .first_rejected
            .fetch_update(Relaxed, Relaxed, |first| (first == 0 || key < first).then_some(key));
    }

    fn totals(&self) -> (Counters, u64, Option<[u32; 2]>) {
        let mut counters = Counters::default();
        for batch in self.batches.lock().unwrap_or_else(|e| e.into_inner()).iter() {
            counters.add(&batch.counters);
        }
        let first = self.first_rejected.load(Relaxed).checked_sub(1);
        (counters, self.rejected.load(Relaxed), first.map(|key| [key as u32, (key >> 32) as u32]))
    }
}

/// One pass over the whole film.
fn pass(
    scene: &Prepared,
    settings: &Settings,
    progress: &Progress,
    recorder: Option<Recorder>,
    film: &mut Film,
    samples: std::ops::Range<u32>,
    tally: &Tally,
) {
    let (plan, tiles) = film.parts();
    let cx = Context {
        scene,
        camera: Camera::new(&scene.camera, settings.width, settings.height),
        filter: PixelFilterSampler::of(&scene.camera.film),
        settings,
        features: plan.features || recorder.is_some(),
    };
    let cancelled = || progress.cancel.load(Relaxed);
    tiles.par_iter_mut().with_max_len(1).for_each(|tile| {
        if recorder.is_some() && cancelled() {
            return; // a tile's record is whole or not there
        }
        let batches = || tally.batches.lock().unwrap_or_else(|e| e.into_inner());
        let mut batch = batches().pop().unwrap_or_default();
        let pixels = pixels_of(tile);
        let step = (BATCH / pixels.len()).max(1) as u32;
        let mut record = Vec::new();
        if recorder.is_some() {
            record.resize(pixels.len() * samples.len(), Sample::ZERO);
        }
        let mut begin = samples.start;
        while begin < samples.end && (samples.start == 0 || !cancelled()) {
            let slice = begin..samples.end.min(begin.saturating_add(step));
            let rays = batch.counters.rays + batch.counters.shadow_rays;
            trace(&cx, &mut batch, &pixels, slice.clone());
            for (k, (path, sample)) in batch.paths.iter().zip(&mut batch.samples).enumerate() {
                let (pixel, index) = (k / slice.len(), slice.start + (k % slice.len()) as u32);
                if accumulate(&cx, path, sample) {
                    tally.reject(pixels[pixel]);
                }
                tile.add(plan, pixel, index, sample);
                if recorder.is_some() {
                    record[pixel * samples.len() + index as usize] = *sample;
                }
            }
            tile.samples = slice.end;
            begin = slice.end;
            progress.samples.fetch_add(batch.paths.len() as u64, Relaxed);
            progress.rays.fetch_add(batch.counters.rays + batch.counters.shadow_rays - rays, Relaxed);
        }
        if let Some(recorder) = recorder {
            let Tile { x, y, width, height, .. } = *tile;
            recorder(TileSamples { x, y, width, height, spp: samples.len() as u32, samples: &record });
        }
        batches().push(batch);
    });
}

fn pixels_of(tile: &Tile) -> Vec<[u32; 2]> {
    (0..tile.height).flat_map(|y| (0..tile.width).map(move |x| [tile.x + x, tile.y + y])).collect()
}

/// What is known here of the picture goes into its header; `spp` is what every pixel has.
fn describe(scene: &Prepared, settings: &Settings, spp: u32, rejected: u64, frame: &mut Frame) {
    let effects: Vec<&str> = scene.effects().iter().map(|called| Effect::name(called.effect)).collect();
    let origin = scene.origin;
    for (key, value) in [
        ("limpid:seed", settings.seed.to_string()),
        ("limpid:spp", spp.to_string()),
        ("limpid:effects", effects.join(" ")),
        ("limpid:rejected", rejected.to_string()),
        ("limpid:origin", format!("{} {} {}", origin.x, origin.y, origin.z)),
    ] {
        frame.metadata.insert(key.into(), value);
    }
}
