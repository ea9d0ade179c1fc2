//! What a render is asked for.

use limpid_frame::{Layer, LayerRequest, Statistic};
use limpid_scenes::{Aov, Camera, Crop, Scene};

/// Point sets for the random decisions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampler {
    /// Counter-based uniform numbers.
    Independent,
    /// Owen-scrambled Sobol sets, one per decision.
    Sobol,
}

/// Everything but the scene that a picture depends on, and the number of threads, on which it doesn't.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Of the whole film, in pixels.
    pub width: u32,
    /// Of the whole film, in pixels.
    pub height: u32,
    /// The part to render; the whole film where absent.
    pub crop: Option<Crop>,
    /// Samples per pixel, at least 1.
    pub spp: u32,
    /// Different seeds give independent pictures.
    pub seed: u64,
    /// Frame number of a sequence: another one gives independent noise.
    pub frame: u32,
    /// Where the random decisions come from.
    pub sampler: Sampler,
    /// Longest path in edges (0: black, 1: lights only, 2: direct light); unlimited where absent.
    pub max_depth: Option<u32>,
    /// Depth from which Russian roulette may end a path.
    pub rr_depth: u32,
    /// Upper bound for a sample's radiance per channel: biased, and off by default.
    pub clamp: Option<f32>,
    /// Lights and background are not seen directly.
    pub hide_emitters: bool,
    /// What the frame is to hold beside the beauty.
    pub layers: LayerRequest,
    /// Number of threads; all cores where absent.
    pub threads: Option<usize>,
    /// Side of a tile in pixels: for tests, since no picture depends on it.
    pub tile: u32,
}

impl Settings {
    /// What the scene's file says for its camera number `camera`, and the defaults for what it leaves open: the Sobol
    /// sampler whatever the file names, all cores.
    ///
    /// # Panics
    ///
    /// If there is no such camera.
    pub fn for_camera(scene: &Scene, camera: usize) -> Self {
        let camera = &scene.cameras[camera];
        Self {
            width: camera.film.width,
            height: camera.film.height,
            crop: camera.film.crop,
            spp: camera.sampler.sample_count,
            seed: 0,
            frame: 0,
            sampler: Sampler::Sobol,
            max_depth: scene.integrator.max_depth,
            rr_depth: scene.integrator.rr_depth,
            clamp: None,
            hide_emitters: scene.integrator.hide_emitters,
            layers: layers(scene, camera),
            threads: None,
            tile: 32,
        }
    }
}

/// The layers that a file asks for beside the beauty.
fn layers(scene: &Scene, camera: &Camera) -> LayerRequest {
    let layer_of = |aov: &Aov| match aov {
        Aov::Albedo => Layer::Albedo,
        Aov::Depth => Layer::Depth,
        Aov::Position => Layer::Position,
        Aov::ShadingNormal => Layer::Normal,
        Aov::ShapeIndex => Layer::Id,
    };
    let alpha = camera.film.alpha.then_some(Layer::Alpha);
    let layers = scene.integrator.aovs.iter().map(layer_of).chain(alpha);
    layers.fold(LayerRequest::beauty(), |all, layer| all.with(layer, Statistic::Mean))
}
