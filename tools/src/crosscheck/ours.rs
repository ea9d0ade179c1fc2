//! limpid's side of a comparison: the scene, ready for pass after pass.

use std::path::Path;

use limpid_frame::{Layer, LayerRequest, Statistic};
use limpid_renderer::{Prepared, Progress, Sampler, Settings, Splat, render};
use limpid_scenes::PixelFilter;

use crate::cli::{Common, Crosscheck};
use crate::error::CliError;
use crate::progress::with_spinner;
use crate::{scene, system, words};

/// Bytes that a comparison keeps a pixel: the moments of both pictures' passes and halves.
const BYTES_PER_PIXEL: u64 = 700;

/// Samples of a pixel that look for what is before the background.
const LOOKS: u32 = 4;

/// The scene, its settings, and what is worth knowing about them.
pub struct Ours {
    prepared: Prepared,
    settings: Settings,
    /// What the scene's own filter does to a renderer that splats.
    pub splat: Splat,
    /// Samples per pixel that the file asks for.
    pub spp: u32,
    /// Which of the scene's cameras it is.
    pub camera: usize,
    /// Warnings of the reader: what limpid does not honour is often where pictures differ.
    pub warnings: Vec<String>,
}

impl Ours {
    /// Reads and prepares the scene; `against` a picture it keeps its own filter, else it gets the box.
    ///
    /// # Errors
    ///
    /// Where the scene cannot be read or rendered, or is too large for the memory.
    pub fn new(path: &Path, options: &Crosscheck, common: &Common) -> Result<Self, CliError> {
        let mut scene = scene::load(path, &options.reading, common)?;
        let camera = scene::camera(&scene, options.camera.as_deref(), path)?;
        let splat = Splat::of(scene.cameras[camera].film.filter);
        if options.against.is_none() {
            limpid_scenes::as_mitsuba(&mut scene);
            scene.cameras[camera].film.filter = PixelFilter::Box;
        }
        let mut settings = Settings::for_camera(&scene, camera);
        if let Some([width, height]) = options.size {
            (settings.width, settings.height, settings.crop) = (width, height, None);
        }
        settings.sampler = Sampler::Independent;
        settings.layers = LayerRequest::beauty();
        settings.threads = common.threads;
        let spp = settings.spp;
        let warnings = scene.warnings.iter().map(words::describe).collect();
        let prepared = with_spinner(common, "preparing the scene", || Prepared::new(&scene, camera))?;
        let ours = Self { prepared, settings, splat, spp, camera, warnings };
        let [width, height] = ours.size();
        let needed = width as u64 * height as u64 * BYTES_PER_PIXEL;
        if let Some(free) = system::available_memory_bytes().filter(|&free| needed > free) {
            let mib = |bytes: u64| bytes >> 20;
            let problem = format!(
                "comparing {width}x{height} pixels takes {} MiB of memory, and {} are free; ask for fewer with `--size`",
                mib(needed),
                mib(free)
            );
            return Err(CliError::File { path: path.to_owned(), problem });
        }
        Ok(ours)
    }

    /// `[width, height]` of what is rendered, in pixels.
    pub fn size(&self) -> [usize; 2] {
        let Settings { width, height, crop, .. } = self.settings;
        crop.map_or([width, height], |crop| [crop.width, crop.height]).map(|length| length as usize)
    }

    /// The pixels that show something before the background.
    pub fn seen(&self) -> Vec<bool> {
        let layers = LayerRequest::parse("hit").expect("is a layer");
        let settings = Settings { layers, spp: LOOKS, ..self.settings.clone() };
        let rendered = render(&self.prepared, &settings, &Progress::default(), None);
        let hit = rendered.frame.layer(Layer::Hit, Statistic::Mean).expect("was asked for");
        hit[0].iter().map(|&hit| hit > 0.0).collect()
    }

    /// One pass: planes R, G and B.
    pub fn pass(&mut self, seed: u64, spp: u32) -> [Vec<f32>; 3] {
        (self.settings.seed, self.settings.spp) = (seed, spp);
        let rendered = render(&self.prepared, &self.settings, &Progress::default(), None);
        rendered.frame.rgb().expect("the beauty was asked for").map(<[f32]>::to_vec)
    }
}
