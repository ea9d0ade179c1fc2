//! `limpid render`: from a scene file to a frame and a picture.

mod header;
mod pixel;
mod records;
mod report;
mod settings;

use std::sync::Arc;
use std::time::Instant;

use limpid_frame::{ErrorEstimate, Frame, Layer, LayerRequest, Statistic, estimate_relmse};
use limpid_renderer::{Prepared, Progress, Rendered, Settings, render};

use crate::cli::{Common, Render};
use crate::denoise::Denoising;
use crate::error::CliError;
use crate::output::Pictures;
use crate::progress::{with_bar, with_spinner};
use crate::{interrupt, output, scene, system, words};
use records::Records;
use report::{Report, Seconds};

/// Renders a scene; where it is interrupted what is done is written all the same.
pub fn run(options: &Render, common: &Common) -> Result<(), CliError> {
    let pictures = pictures(options);
    pictures.check()?;
    if let Some(folder) = &options.records {
        output::check_records_folder(folder)?;
    }
    let denoising = options.denoise.map(|method| Denoising::new(method, &options.set)).transpose()?;
    let mut seconds = Seconds::default();

    let begin = Instant::now();
    let mut scene = scene::load(&options.scene, &options.reading, common)?;
    if options.as_mitsuba {
        limpid_scenes::as_mitsuba(&mut scene);
    }
    seconds.load = begin.elapsed().as_secs_f64();

    let camera = scene::camera(&scene, options.camera.as_deref(), &options.scene)?;
    let needs = denoising.as_ref().map_or_else(LayerRequest::default, Denoising::needs);
    let settings = settings::of(&scene, camera, options, &needs, common)?;
    let begin = Instant::now();
    let prepared = with_spinner(common, "preparing the scene", || Prepared::new(&scene, camera))?;
    seconds.prepare = begin.elapsed().as_secs_f64();
    if prepared.bad_texels() > 0 {
        let texels = prepared.bad_texels();
        words::note(
            common,
            format_args!("{texels} texels of the environment are negative or not finite and count as 0"),
        );
    }
    let header = header::of(&scene, camera, &settings, options);
    let effects = prepared.effects().to_vec();
    let warnings = scene.warnings.len();
    drop(scene); // the renderer has what it needs: the memory is better spent on samples

    let (begin, user) = (Instant::now(), system::user_seconds());
    let rendered = traced(&prepared, &settings, options, common)?;
    seconds.render = begin.elapsed().as_secs_f64();
    let render_user_s = system::user_seconds().zip(user).map(|(end, begin)| end - begin);
    drop(prepared);

    let Rendered { mut frame, halves, spp, counters, rejected, first_rejected, interrupted } = rendered;
    let error = halves.and_then(|halves| estimate(halves, &settings, interrupted));
    frame.metadata.extend(header);
    if interrupted {
        frame
            .metadata
            .insert("limpid:interrupted".into(), "every pixel has limpid:spp samples, some have more".into());
    }
    let begin = Instant::now();
    if let Some(denoising) = denoising.as_ref().filter(|_| !interrupted) {
        frame = denoising.run(&frame, &options.scene, common)?;
    }
    seconds.denoise = begin.elapsed().as_secs_f64();

    let begin = Instant::now();
    pictures.write(&frame)?;
    seconds.write = begin.elapsed().as_secs_f64();

    let report = Report {
        pictures: &pictures,
        frame: &frame,
        settings: &settings,
        seconds,
        render_user_s,
        error,
        counters,
        rejected,
        first_rejected,
        effects: &effects,
        warnings,
        interrupted,
        spp,
        denoise: options.denoise.map(|method| method.name),
        pixel: options.pixel,
    };
    report.tell(common)?;
    if interrupt::came() {
        return Err(CliError::Interrupted { kept: report.kept() });
    }
    Ok(())
}

/// The error of the noisy picture, from the two halves of its samples.
fn estimate(mut halves: Frame, settings: &Settings, interrupted: bool) -> Option<ErrorEstimate> {
    // The halves of an odd number of samples differ in size. Where a render was interrupted the numbers differ from
    // pixel to pixel, and halves that count as equal are near enough.
    if !interrupted {
        let samples = vec![settings.spp as f32; halves.len()];
        halves.insert_layer(Layer::Samples, Statistic::Mean, vec![samples]);
    }
    estimate_relmse(&halves)
}

/// What is to be written: nothing for a single pixel, unless it is asked for.
fn pictures(options: &Render) -> Pictures {
    let by_default = |extension| {
        let wanted = options.output.is_none() && options.pixel.is_none();
        wanted.then(|| output::named(&output::default_stem(&options.scene), extension))
    };
    Pictures {
        frame: options.output.clone().or_else(|| by_default("exr")),
        png: options.png.clone().or_else(|| by_default("png")),
        exposure: options.exposure,
    }
}

/// Traces the paths behind a bar; Ctrl-C and failing records stop it early.
fn traced(
    prepared: &Prepared,
    settings: &Settings,
    options: &Render,
    common: &Common,
) -> Result<Rendered, CliError> {
    let progress = Arc::new(Progress::default());
    interrupt::stop_gently(&progress);
    let Some(folder) = &options.records else {
        return Ok(with_bar(common, &progress, || render(prepared, settings, &progress, None)));
    };
    let records = Records::new(folder, [settings.width, settings.height], &progress);
    let recorder = |tile: limpid_renderer::TileSamples| records.write(&tile);
    let rendered = with_bar(common, &progress, || render(prepared, settings, &progress, Some(&recorder)));
    records.finish()?;
    Ok(rendered)
}
