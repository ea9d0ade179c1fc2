//! Camera rays.

use glam::{DVec2, Vec2};
use limpid_frame::Layer;

use super::absorb::Inside;
use super::{Context, Path};
use crate::accel::Ray;
use crate::color::{Rgb, Split};
use crate::film::Sample;
use crate::sampling::{Dim, PixelSampler};

/// Begins sample number `index` of a pixel of the whole film.
#[inline]
pub fn generate(cx: &Context, pixel: [u32; 2], index: u32, features: &mut Sample) -> (Path, Ray) {
    let settings = cx.settings;
    let sampler = PixelSampler::new(settings.sampler, settings.seed, settings.frame, pixel, index);
    let (offset, weight) = cx.filter.sample(sampler.draw2(Dim::Pixel));
    let center = DVec2::new(f64::from(pixel[0]) + 0.5, f64::from(pixel[1]) + 0.5);
    let lens = if cx.camera.has_lens() { sampler.draw2(Dim::Lens) } else { Vec2::ZERO };
    let ray = cx.camera.ray(center + offset.as_dvec2(), lens);
    let path = Path {
        sampler,
        beta: Split::specular(Rgb::ONE),
        scattered: Split::ZERO,
        emission: Rgb::ZERO,
        p: ray.o,
        pdf: 1.0,
        edges: 1,
        eta_scale: 1.0,
        delta: true,
        inside: Inside::default(),
        split: false,
        straight: false,
        present: false,
        met: false,
        feature_done: false,
        rejected: false,
        weight,
    };
    *features = Sample::ZERO;
    // What a path that meets nothing keeps.
    features.set(Layer::Albedo, [1.0; 3]);
    features.set(Layer::DiffuseAlbedo, [1.0; 3]);
    features.set(Layer::Offset, offset.to_array());
    (path, ray)
}
