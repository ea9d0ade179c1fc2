//! What a render is asked for: the scene's own settings, changed by options.

use limpid_frame::{Layer, LayerRequest, Statistic};
use limpid_renderer::{Sample, Sampler, Settings};
use limpid_scenes::{Crop, Scene};

use crate::cli::{Common, Render, SamplerChoice};
use crate::error::CliError;
use crate::values::MAX_SPP;
use crate::{system, words};

/// Memory for the samples of one tile, with `--records`, in bytes.
const RECORD_MEMORY: usize = 64 << 20;

/// The scene's settings for its camera, changed by the options; `needs` are a denoiser's layers.
///
/// # Errors
///
/// Where crop or pixel are not in the film, or the picture does not fit the machine's memory.
pub fn of(
    scene: &Scene,
    camera: usize,
    options: &Render,
    needs: &LayerRequest,
    common: &Common,
) -> Result<Settings, CliError> {
    let mut settings = Settings::for_camera(scene, camera);
    if let Some([width, height]) = options.size {
        if settings.crop.take().is_some() && options.crop.is_none() && options.pixel.is_none() {
            words::note(common, "note: the crop of the file is left out, since --size changes its film");
        }
        (settings.width, settings.height) = (width, height);
    }
    let film = [settings.width, settings.height];
    if let Some(crop) = options.crop {
        settings.crop = Some(inside(crop, film).ok_or_else(|| {
            let Crop { x, y, width, height } = crop;
            let problem = format!("not within the film, which has {}x{} pixels", film[0], film[1]);
            CliError::option("--crop", format_args!("{x},{y},{width},{height}"), problem)
        })?);
    }
    if let Some([x, y]) = options.pixel {
        settings.crop = Some(inside(Crop { x, y, width: 1, height: 1 }, film).ok_or_else(|| {
            let problem = format!("not in the film: pixels go to {},{}", film[0] - 1, film[1] - 1);
            CliError::option("--pixel", format_args!("{x},{y}"), problem)
        })?);
    }
    settings.spp = options.spp.unwrap_or(settings.spp);
    if !(1..=MAX_SPP).contains(&settings.spp) {
        let problem = format!("asks for {} samples; set from 1 to {MAX_SPP} with `--spp`", settings.spp);
        return Err(CliError::File { path: options.scene.clone(), problem });
    }
    settings.seed = options.seed;
    settings.sampler = sampler(&scene.cameras[camera].sampler.kind, options.sampler, common);
    settings.max_depth = options.max_depth.or(settings.max_depth);
    settings.rr_depth = options.rr_depth.unwrap_or(settings.rr_depth);
    settings.clamp = options.clamp;
    let asked = match &options.layers {
        Some(layers) => layers.clone(),
        // Who looks into a pixel wants to see what is there.
        None if options.pixel.is_some() => Layer::ALL
            .into_iter()
            .fold(LayerRequest::default(), |all, layer| all.with(layer, Statistic::Mean)),
        None => LayerRequest::default(),
    };
    settings.layers = settings.layers.union(&asked).union(needs);
    settings.threads = common.threads;
    if options.records.is_some() {
        settings.tile = record_tile(settings.tile, settings.spp);
    }
    check_memory(&settings, options)?;
    Ok(settings)
}

fn inside(crop: Crop, [width, height]: [u32; 2]) -> Option<Crop> {
    let fits = |begin: u32, length: u32, film: u32| begin.checked_add(length).is_some_and(|end| end <= film);
    (fits(crop.x, crop.width, width) && fits(crop.y, crop.height, height)).then_some(crop)
}

/// Ours whatever the file names, unless it is to be obeyed.
fn sampler(of_file: &str, choice: Option<SamplerChoice>, common: &Common) -> Sampler {
    match (choice, of_file) {
        (Some(SamplerChoice::Independent), _) | (Some(SamplerChoice::File), "independent") => {
            Sampler::Independent
        }
        (Some(SamplerChoice::Sobol), _) | (_, "sobol") => Sampler::Sobol,
        (choice, other) => {
            let cure =
                if choice.is_none() && other == "independent" { "; `--sampler file` obeys it" } else { "" };
            words::note(
                common,
                format_args!("note: sobol stands in for the file's sampler \"{other}\"{cure}"),
            );
            Sampler::Sobol
        }
    }
}

/// The side of a tile whose samples fit into memory, for each thread: no picture depends on it.
fn record_tile(mut side: u32, spp: u32) -> u32 {
    let bytes =
        |side: u32| (side as usize * side as usize * spp as usize).saturating_mul(size_of::<Sample>());
    while side > 1 && bytes(side) > RECORD_MEMORY {
        side /= 2;
    }
    side
}

/// Refuses what could only end in swapping or in death by the system's hand.
fn check_memory(settings: &Settings, options: &Render) -> Result<(), CliError> {
    let (Some(free), needed) = (system::available_memory_bytes(), memory_bytes(settings)) else {
        return Ok(());
    };
    if needed <= u128::from(free) {
        return Ok(());
    }
    let gib = |bytes: u128| bytes as f64 / (1u64 << 30) as f64;
    let problem = format!(
        "this many pixels with these layers take {:.1} GiB of memory, and {:.1} are free; ask for fewer, or for a part with `--crop`",
        gib(needed),
        gib(free.into()),
    );
    let [width, height] = [settings.width, settings.height];
    Err(match options.size {
        Some(_) => CliError::option("--size", format_args!("{width}x{height}"), problem),
        None => {
            CliError::File { path: options.scene.clone(), problem: format!("{width}x{height}: {problem}") }
        }
    })
}

/// What the film and its frame take, in bytes: per channel two sums of 8, for a variance 12 more, and 4 a plane.
fn memory_bytes(settings: &Settings) -> u128 {
    let (width, height) = match settings.crop {
        Some(crop) => (crop.width, crop.height),
        None => (settings.width, settings.height),
    };
    let of = |(layer, statistic): (Layer, Statistic)| {
        let sums = match statistic {
            Statistic::Mean => 16,
            Statistic::Variance => 12,
            Statistic::A | Statistic::B => 0,
        };
        (sums + 4) * layer.channels().len() as u128
    };
    // The beauty has its sums, squares and halves in any case.
    let beauty = 3 * (16 + 12 + 3 * 4);
    u128::from(width) * u128::from(height) * (beauty + settings.layers.iter().map(of).sum::<u128>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crop_is_inside_its_film_or_refused() {
        let crop = |x, y, width, height| inside(Crop { x, y, width, height }, [10, 5]).is_some();
        assert!(crop(0, 0, 10, 5) && crop(9, 4, 1, 1));
        assert!(!crop(1, 0, 10, 5) && !crop(0, 5, 1, 1) && !crop(u32::MAX, 0, u32::MAX, 1));
    }

    #[test]
    fn tiles_of_records_shrink_with_their_samples() {
        assert_eq!(record_tile(32, 1), 32);
        assert_eq!(record_tile(32, MAX_SPP), 1);
        let side = record_tile(32, 4096);
        assert!(
            (1..32).contains(&side) && (side * side * 4096) as usize * size_of::<Sample>() <= RECORD_MEMORY
        );
    }
}
