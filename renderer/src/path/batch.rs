//! The stages over a batch of paths.

use limpid_frame::Layer;

use super::absorb::absorb;
use super::connect::{connect, through_holes};
use super::emit::{emit_background, emit_surface};
use super::generate::generate;
use super::shade::shade;
use super::survive::survive;
use super::{Connection, Context, Path};
use crate::accel::{Hit, NONE, Ray};
use crate::color::Rgb;
use crate::effects::Counters;
use crate::film::Sample;
use crate::geometry::Surface;

/// The paths of a tile and a slice of samples, with the queues between the stages. Reused from slice to slice.
#[derive(Default)]
pub struct Batch {
    /// Pixel by pixel, the samples of a pixel in their order.
    pub paths: Vec<Path>,
    /// What the feature layers hold of each path.
    pub samples: Vec<Sample>,
    /// Paths that go on, in order; `rays`, `hits` and `surfaces` run along.
    active: Vec<u32>,
    rays: Vec<Ray>,
    hits: Vec<Hit>,
    surfaces: Vec<Option<Surface>>,
    connections: Vec<Connection>,
    connected: Vec<u32>,
    shadow_rays: Vec<Ray>,
    blocked: Vec<bool>,
    /// Of the light along each connection.
    shares: Vec<f32>,
    /// What was done.
    pub counters: Counters,
}

/// Traces `samples` of each of `pixels` to the end.
pub fn trace(cx: &Context, batch: &mut Batch, pixels: &[[u32; 2]], samples: std::ops::Range<u32>) {
    batch.generate(cx, pixels, samples);
    while !batch.active.is_empty() {
        batch.extend(cx);
        batch.emit(cx);
        batch.shade(cx);
        batch.connect(cx);
        batch.survive(cx);
    }
}

impl Batch {
    fn generate(&mut self, cx: &Context, pixels: &[[u32; 2]], samples: std::ops::Range<u32>) {
        self.paths.clear();
        self.samples.clear();
        self.rays.clear();
        for &pixel in pixels {
            for index in samples.clone() {
                let mut sample = Sample::ZERO;
                let (path, ray) = generate(cx, pixel, index, &mut sample);
                self.paths.push(path);
                self.samples.push(sample);
                self.rays.push(ray);
            }
        }
        self.active.clear();
        self.active.extend(0..self.paths.len() as u32);
        self.counters.paths += self.paths.len() as u64;
        self.counters.depth_of_field += if cx.camera.has_lens() { self.paths.len() as u64 } else { 0 };
    }

    fn extend(&mut self, cx: &Context) {
        self.hits.resize(self.rays.len(), Hit::MISS);
        cx.scene.accel.closest(&self.rays, &mut self.hits);
        self.counters.rays += self.rays.len() as u64;
        self.surfaces.clear();
        self.surfaces.extend(self.rays.iter().zip(&self.hits).map(|(ray, hit)| surface(cx, ray, hit)));
    }

    fn emit(&mut self, cx: &Context) {
        for ((&i, ray), surface) in self.active.iter().zip(&self.rays).zip(&self.surfaces) {
            emit(cx, &mut self.paths[i as usize], ray, surface.as_ref(), &mut self.counters);
        }
    }

    fn shade(&mut self, cx: &Context) {
        self.connections.clear();
        self.connected.clear();
        let mut kept = 0;
        for k in 0..self.active.len() {
            let (i, Some(surface)) = (self.active[k], &self.surfaces[k]) else { continue };
            let (path, sample) = (&mut self.paths[i as usize], &mut self.samples[i as usize]);
            let scattered = shade(cx, path, &self.rays[k], surface, sample, &mut self.counters);
            if let Some(connection) = scattered.connection {
                self.connections.push(connection);
                self.connected.push(i);
            }
            if let Some(next) = scattered.next {
                (self.active[kept], self.rays[kept]) = (i, next);
                kept += 1;
            }
        }
        self.active.truncate(kept);
        self.rays.truncate(kept);
    }

    fn connect(&mut self, cx: &Context) {
        self.shares.resize(self.connections.len(), 1.0);
        if cx.scene.has_holes {
            through_holes(cx, &mut self.connections, &mut self.shares, &mut self.counters);
        } else {
            self.shadow_rays.clear();
            self.shadow_rays.extend(self.connections.iter().map(|c| c.ray));
            self.blocked.resize(self.shadow_rays.len(), false);
            cx.scene.accel.occluded(&self.shadow_rays, &mut self.blocked);
            self.counters.shadow_rays += self.shadow_rays.len() as u64;
            for (share, &blocked) in self.shares.iter_mut().zip(&self.blocked) {
                *share = if blocked { 0.0 } else { 1.0 };
            }
        }
        for ((&i, connection), &share) in self.connected.iter().zip(&self.connections).zip(&self.shares) {
            connect(cx, &mut self.paths[i as usize], connection, share, &mut self.samples[i as usize]);
        }
    }

    fn survive(&mut self, cx: &Context) {
        let mut kept = 0;
        for k in 0..self.active.len() {
            let i = self.active[k];
            if survive(cx, &mut self.paths[i as usize]) {
                (self.active[kept], self.rays[kept]) = (i, self.rays[k]);
                kept += 1;
            }
        }
        self.active.truncate(kept);
        self.rays.truncate(kept);
    }
}

/// The surface that a ray hit, if any.
#[inline]
fn surface(cx: &Context, ray: &Ray, hit: &Hit) -> Option<Surface> {
    (hit.prim != NONE).then(|| cx.scene.geometry.surface(ray, hit))
}

#[inline]
fn emit(cx: &Context, path: &mut Path, ray: &Ray, surface: Option<&Surface>, counters: &mut Counters) {
    if cx.scene.has_absorption {
        absorb(cx, path, ray, surface, counters);
    }
    match surface {
        Some(surface) => emit_surface(cx, path, ray, surface),
        None => emit_background(cx, path, ray, counters),
    }
}

/// Completes the sample of a finished path with its radiance; whether any of it was not finite and counts as 0.
#[inline]
pub fn accumulate(cx: &Context, path: &Path, sample: &mut Sample) -> bool {
    let mut rejected = path.rejected;
    let mut parts = [path.scattered.diffuse, path.scattered.specular, path.emission];
    if let Some(limit) = cx.settings.clamp {
        let total = parts[0] + parts[1] + parts[2];
        let factor = total.map(|x| if x > limit { limit / x } else { 1.0 });
        parts = parts.map(|part| part * factor);
    }
    parts = parts.map(|part| part * path.weight);
    if !(parts[0] + parts[1] + parts[2]).is_finite() {
        parts = [Rgb::ZERO; 3]; // finite contributions, but not their sum
        rejected = true;
    }
    if cx.features {
        for value in sample.values.iter_mut().filter(|value| !value.is_finite()) {
            *value = 0.0; // a bad texel in an albedo; not counted, since the count must not hang on the layers
        }
    }
    let [diffuse, specular, emission] = parts;
    sample.set(Layer::Alpha, [if path.present { path.weight } else { 0.0 }]);
    sample.set(Layer::Beauty, (diffuse + specular + emission).to_array());
    sample.set(Layer::Diffuse, diffuse.to_array());
    sample.set(Layer::Specular, specular.to_array());
    sample.set(Layer::Emission, emission.to_array());
    rejected
}

/// The same cores, one path at a time: the reference for the batch.
#[cfg(test)]
pub fn depth_first(cx: &Context, pixel: [u32; 2], index: u32) -> Sample {
    let (mut counters, mut sample) = (Counters::default(), Sample::ZERO);
    let (mut path, mut ray) = generate(cx, pixel, index, &mut sample);
    loop {
        let (mut hit, mut blocked) = ([Hit::MISS], [false]);
        cx.scene.accel.closest(&[ray], &mut hit);
        let surface = surface(cx, &ray, &hit[0]);
        emit(cx, &mut path, &ray, surface.as_ref(), &mut counters);
        let Some(surface) = surface else { break };
        let scattered = shade(cx, &mut path, &ray, &surface, &mut sample, &mut counters);
        if let Some(mut connection) = scattered.connection {
            let mut share = [1.0];
            if cx.scene.has_holes {
                through_holes(cx, std::slice::from_mut(&mut connection), &mut share, &mut counters);
            } else {
                cx.scene.accel.occluded(&[connection.ray], &mut blocked);
                share[0] = if blocked[0] { 0.0 } else { 1.0 };
            }
            connect(cx, &mut path, &connection, share[0], &mut sample);
        }
        match scattered.next {
            Some(next) if survive(cx, &mut path) => ray = next,
            _ => break,
        }
    }
    accumulate(cx, &path, &mut sample);
    sample
}
