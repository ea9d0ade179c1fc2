//! Scattering at a surface: the features, a light sample, and the direction in which the path goes on.

use limpid_frame::Layer;

use super::{Connection, Context, Path, mis_weight};
use crate::accel::Ray;
use crate::bsdf::Bsdf;
use crate::color::{Rgb, Split};
use crate::effects::Counters;
use crate::film::Sample;
use crate::geometry::{Frame, Surface};
use crate::prepare::Prepared;
use crate::sampling::Dim;

/// What a vertex gives: a light sample, and the ray along which the path goes on.
pub struct Scattered {
    pub connection: Option<Connection>,
    pub next: Option<Ray>,
}

/// One path at one vertex.
#[inline]
pub fn shade(
    cx: &Context,
    path: &mut Path,
    ray: &Ray,
    surface: &Surface,
    features: &mut Sample,
    counters: &mut Counters,
) -> Scattered {
    let nothing = Scattered { connection: None, next: None };
    if cx.settings.max_depth.is_some_and(|max| path.edges >= max) && path.feature_done {
        return nothing;
    }
    let scene = cx.scene;
    let (bsdf, frame) = scattering(scene, ray, surface);
    let wo = frame.to_local(-ray.d);

    let at_feature = !path.feature_done && !bsdf.near_delta();
    if cx.features && !path.feature_done {
        let material = scene.geometry.shapes[surface.shape as usize].material;
        record_features(path, surface, &bsdf, wo, frame.normal(), material.0, features);
    }
    path.feature_done |= at_feature;

    if cx.settings.max_depth.is_some_and(|max| path.edges >= max) {
        return nothing;
    }
    // Before the first non-delta vertex the throughput is whole; there it is split by the lobe.
    let whole = path.beta.specular;
    let through = |path: &Path, scattered: Split| {
        if path.split { path.beta * scattered.total() } else { scattered * whole }
    };
    let bounce = path.edges - 1;

    let mut connection = None;
    if bsdf.has_non_delta() {
        let [choice, u, v] = path.sampler.draw3(Dim::Light(bounce));
        if let Some(light) = scene.lights.sample(surface.p, choice, glam::Vec2::new(u, v), &scene.textures) {
            let value = bsdf.eval(wo, frame.to_local(light.wi));
            if !value.f_cos.is_zero() && light.radiance != Rgb::ZERO {
                let weight = mis_weight(light.pdf, value.pdf) / light.pdf;
                connection = Some(Connection {
                    ray: Ray { t_max: light.t_max, skip: light.skip, ..surface.spawn(light.wi) },
                    through: through(path, value.f_cos * weight),
                    radiance: light.radiance,
                    at_feature,
                });
            }
        }
    }

    let [lobe, u, v] = path.sampler.draw3(Dim::Bsdf(bounce));
    let sampled = bsdf.sample(wo, lobe, glam::Vec2::new(u, v));
    let Some(sample) = sampled.filter(|s| !s.weight.is_zero()) else {
        path.split |= bsdf.has_non_delta();
        return Scattered { connection, next: None };
    };
    if bsdf.has_non_delta() {
        path.beta = through(path, sample.weight);
        path.split = true;
    } else {
        let factor = sample.weight.total();
        path.beta = if path.split { path.beta * factor } else { Split::specular(whole * factor) };
    }
    path.pdf = sample.pdf;
    path.delta = sample.delta;
    path.eta_scale *= sample.eta * sample.eta;
    path.edges += 1;
    path.p = surface.p;
    counters.transmission += u64::from(sample.wi.z * wo.z < 0.0);
    Scattered { connection, next: Some(surface.spawn(frame.to_render(sample.wi).normalize())) }
}

/// The BSDF at a hit, and the frame whose +z is the shading normal on the side that the BSDF refers to.
pub fn scattering<'a>(scene: &'a Prepared, ray: &Ray, surface: &Surface) -> (Bsdf<'a>, Frame) {
    let material = scene.geometry.shapes[surface.shape as usize].material;
    let behind = ray.d.dot(surface.ns) > 0.0;
    let (bsdf, turned) = scene.materials.bsdf(material, surface.uv, &scene.textures, behind);
    let normal = if turned { -surface.ns } else { surface.ns };
    let frame = if scene.materials.is_anisotropic(material) {
        Frame::with_tangent(normal, scene.geometry.dp_du(surface))
    } else {
        Frame::around(normal)
    };
    (bsdf, frame)
}

/// Writes what the feature layers hold of this vertex: at the first hit, and again at each later one until the
/// feature hit, so that a chain of mirrors that never ends keeps its first.
fn record_features(
    path: &Path,
    surface: &Surface,
    bsdf: &Bsdf,
    wo: glam::Vec3,
    normal: glam::Vec3,
    material: u32,
    features: &mut Sample,
) {
    if path.edges == 1 {
        // The camera is the origin of render space.
        features.set(Layer::Depth, [surface.p.as_dvec3().length() as f32]);
        features.set(Layer::Hit, [1.0]);
        features.ids = [surface.shape as f32, material as f32];
    } else if bsdf.near_delta() {
        return;
    }
    let of_bsdf = bsdf.features(wo);
    features.set(Layer::Normal, normal.to_array());
    features.set(Layer::Position, surface.p.to_array());
    features.set(Layer::Roughness, [of_bsdf.roughness]);
    if !bsdf.near_delta() {
        features.set(Layer::Albedo, of_bsdf.albedo.to_array());
        features.set(Layer::DiffuseAlbedo, (path.beta.specular * of_bsdf.diffuse_albedo).to_array());
    }
}
