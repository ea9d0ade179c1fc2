//! Laws of the frames that the renderer makes, on the Cornell box of the library.

use std::path::Path;
use std::sync::Mutex;

use limpid_frame::{Layer, LayerRequest, Statistic};
use limpid_renderer::{Prepared, Progress, Sampler, Settings, TileSamples, render};
use limpid_scenes::{LoadOptions, Scene, load};

fn cornell_box() -> Scene {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/library/cornell-box/scene.xml");
    load(&file, &LoadOptions::default()).expect("a scene of the library")
}

fn settings(scene: &Scene, side: u32, spp: u32) -> Settings {
    let mut settings = Settings::for_camera(scene, 0);
    (settings.width, settings.height, settings.spp) = (side, side, spp);
    settings
}

/// Mean over the pixels of sgn(a₁ − a₂) · sgn(b₁ − b₂), ties left out.
fn sign_correlation(first: [&[f32]; 2], second: [&[f32]; 2]) -> f64 {
    let (mut sum, mut count) = (0.0, 0u32);
    for i in 0..first[0].len() {
        let (a, b) = (first[0][i] - second[0][i], first[1][i] - second[1][i]);
        if a != 0.0 && b != 0.0 {
            sum += f64::from(a.signum() * b.signum());
            count += 1;
        }
    }
    assert!(count > 20_000, "{count} pixels to compare");
    sum / f64::from(count)
}

/// Signs do not hang on the few pixels at the light's edge as products do. With n = 65536 pixels the standard error is
/// 0.004, so that ±0.015 is left by chance once in 5000 seeds, and a correlation of 0.05, which
/// has a sign correlation of (2/π) asin 0.05 = 0.032, is found with a power above 0.999.
#[test]
fn halves_of_a_sobol_render_are_uncorrelated() {
    let scene = cornell_box();
    let prepared = Prepared::new(&scene, 0).expect("no media");
    let frame = |seed| {
        let mut settings = settings(&scene, 256, 64);
        (settings.seed, settings.sampler) = (seed, Sampler::Sobol);
        settings.layers = LayerRequest::beauty().with_statistics(Layer::Beauty);
        render(&prepared, &settings, &Progress::default(), None).frame
    };
    let (first, second) = (frame(1), frame(2));
    let green =
        |frame: &limpid_frame::Frame, half| frame.layer(Layer::Beauty, half).expect("asked for")[1].to_vec();
    let (a1, b1) = (green(&first, Statistic::A), green(&first, Statistic::B));
    let (a2, b2) = (green(&second, Statistic::A), green(&second, Statistic::B));
    let correlation = sign_correlation([&a1, &b1], [&a2, &b2]);
    println!("sign correlation of the halves: {correlation:.4}");
    assert!(correlation.abs() < 0.015, "{correlation}");

    // The same test sees a planted correlation of 0.05: b takes over a share of a's deviation.
    let share = 0.05 / (1.0f32 - 0.05 * 0.05).sqrt();
    let planted: Vec<f32> =
        b1.iter().zip(&a1).zip(&a2).map(|((b, a), other)| b + share * (a - other)).collect();
    let planted = sign_correlation([&a1, &planted], [&a2, &b2]);
    println!("with a planted correlation of 0.05: {planted:.4}");
    assert!(planted > 0.015, "{planted}");
}

#[test]
fn records_add_up_to_the_layers() {
    let scene = cornell_box();
    let prepared = Prepared::new(&scene, 0).expect("no media");
    let mut settings = settings(&scene, 48, 24);
    settings.layers = LayerRequest::all();
    let layers = [
        Layer::Beauty,
        Layer::Diffuse,
        Layer::Specular,
        Layer::Emission,
        Layer::Albedo,
        Layer::Normal,
        Layer::Position,
        Layer::Depth,
        Layer::Offset,
    ];
    // By layer and channel: sums over the samples that count, and their number.
    let sums = Mutex::new(vec![[[(0.0f64, 0u32); 3]; 9]; 48 * 48]);
    let recorder = |tile: TileSamples| {
        let mut sums = sums.lock().expect("no test thread panics");
        for (k, sample) in tile.samples.iter().enumerate() {
            let pixel = k as u32 / tile.spp;
            let (x, y) = (tile.x + pixel % tile.width, tile.y + pixel / tile.width);
            for (l, &layer) in layers.iter().enumerate() {
                if layer == Layer::Depth && sample.get(Layer::Hit, 0) == 0.0 {
                    continue;
                }
                for c in 0..layer.channels().len() {
                    let (sum, count) = &mut sums[(y * 48 + x) as usize][l][c];
                    *sum += f64::from(sample.get(layer, c));
                    *count += 1;
                }
            }
        }
    };
    let recorded = render(&prepared, &settings, &Progress::default(), Some(&recorder)).frame;
    assert_eq!(
        recorded,
        render(&prepared, &settings, &Progress::default(), None).frame,
        "records change no bit"
    );
    let sums = sums.into_inner().expect("no test thread panics");
    for (l, &layer) in layers.iter().enumerate() {
        for (c, plane) in recorded.layer(layer, Statistic::Mean).expect("asked for").iter().enumerate() {
            for (pixel, &value) in plane.iter().enumerate() {
                let (sum, count) = sums[pixel][l][c];
                let mean = if count == 0 { 0.0 } else { (sum / f64::from(count)) as f32 };
                let near = mean.next_down() <= value && value <= mean.next_up();
                assert!(near, "{} {c}, pixel {pixel}: {value}, records {mean}", layer.name());
            }
        }
    }
}
