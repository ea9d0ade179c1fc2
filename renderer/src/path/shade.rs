//! Scattering at a surface: the features, a light sample, and the direction in which the path goes on.

use glam::Vec3;
use limpid_frame::Layer;
use limpid_scenes::NormalMap;

use super::absorb::material;
use super::{Connection, Context, Path, mis_weight};
use crate::accel::{NONE, Ray};
use crate::bsdf::Lobes;
use crate::color::{Rgb, Split};
use crate::effects::Counters;
use crate::film::Sample;
use crate::geometry::{Frame, Surface};
use crate::material::{At, Map, Perturbed};
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
    if cx.settings.hide_emitters && path.edges == 1 && cx.scene.lights.of_shape(surface.shape).is_some() {
        return past_hidden(path, ray, surface);
    }
    let last = cx.settings.max_depth.is_some_and(|max| path.edges >= max);
    if last && path.feature_done {
        return nothing;
    }
    let scene = cx.scene;
    counters.instancing += u64::from(surface.instance != NONE);
    let scattering = Scattering::new(scene, ray, surface);
    let Scattering { frame, wo, hole, .. } = scattering;
    let bounce = path.edges - 1;
    path.straight = hole > 0.0 && path.sampler.draw3(Dim::Bsdf(bounce))[0] < hole;
    if path.straight {
        counters.alpha += 1;
        if last {
            return nothing;
        }
        path.edges += 1;
        if scene.has_absorption && surface.ng.dot(ray.d) > 0.0 {
            path.inside.leave(material(cx, surface));
        }
        return Scattered { connection: None, next: Some(surface.spawn(ray.d)) };
    }
    path.present = true;
    let mut bsdf = Lobes::default();
    scattering.add_lobes(scene, surface, counters, &mut bsdf);

    let at_feature = !path.feature_done && !bsdf.near_delta();
    if cx.features && !path.feature_done {
        let normal = frame.to_render(bsdf.normal());
        if !path.met {
            features.set(Layer::Depth, [cx.camera.distance(surface.p)]);
        }
        record_features(path, surface, &bsdf, wo, normal, scattering.at.material.0, features);
    }
    path.feature_done |= at_feature;

    if last {
        return nothing;
    }
    // Before the first non-delta vertex the throughput is whole; there it is split by the lobe.
    let whole = path.beta.specular;
    let through = |path: &Path, scattered: Split| {
        if path.split { path.beta * scattered.total() } else { scattered * whole }
    };

    let mut connection = None;
    if bsdf.has_non_delta() {
        let [choice, u, v] = path.sampler.draw3(Dim::Light(bounce));
        if let Some(light) = scene.lights.sample(surface.p, choice, glam::Vec2::new(u, v), &scene.textures) {
            let wi = frame.to_local(light.wi);
            let value = bsdf.eval(wo, wi);
            if !value.f_cos.is_zero() && light.radiance != Rgb::ZERO {
                let partner = if light.delta { 0.0 } else { value.pdf };
                let weight = mis_weight(light.pdf, partner) / light.pdf;
                let mut inside = path.inside;
                if scene.has_absorption && wi.z * wo.z < 0.0 {
                    inside.cross(cx, material(cx, surface), wo.z > 0.0);
                }
                connection = Some(Connection {
                    ray: Ray { t_max: light.t_max, skip: light.skip, ..surface.spawn(light.wi) },
                    through: through(path, value.f_cos * weight),
                    radiance: light.radiance,
                    inside,
                    from: 0.0,
                    edges: path.edges + 1,
                    at_feature,
                });
            }
        }
    }

    let [mut lobe, u, v] = path.sampler.draw3(Dim::Bsdf(bounce));
    if hole > 0.0 {
        lobe = ((lobe - hole) / (1.0 - hole)).clamp(0.0, 1.0f32.next_down()); // what the hole left of it
    }
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
    if sample.wi.z * wo.z < 0.0 {
        counters.transmission += 1;
        if scene.has_absorption {
            path.inside.cross(cx, material(cx, surface), wo.z > 0.0);
        }
    }
    Scattered { connection, next: Some(surface.spawn(frame.to_render(sample.wi).normalize())) }
}

/// The camera does not see this surface, and looks past it.
fn past_hidden(path: &mut Path, ray: &Ray, surface: &Surface) -> Scattered {
    path.straight = true;
    let t_max = ray.t_max - (surface.p - ray.o).dot(ray.d);
    let next = Ray { t_max, skip: surface.prim, ..surface.spawn(ray.d) };
    Scattered { connection: None, next: Some(next) }
}

/// What a hit is made of, before its BSDFs are asked for.
pub struct Scattering {
    /// Around the shading normal.
    pub frame: Frame,
    /// In that frame.
    pub wo: Vec3,
    /// Share of the light that goes straight through.
    pub hole: f32,
    at: At,
}

impl Scattering {
    /// Looks at the surface that `ray` hit.
    #[inline]
    pub fn new(scene: &Prepared, ray: &Ray, surface: &Surface) -> Self {
        let material = scene.geometry.shapes[surface.shape as usize].material;
        let frame = if scene.materials.needs_tangent(material) {
            let [du, _] = scene.geometry.dp_duv(surface);
            Frame::with_tangent(surface.ns, du.as_dvec3().normalize_or_zero().as_vec3())
        } else {
            Frame::around(surface.ns)
        };
        let wo = frame.to_local(-ray.d);
        let at = At { material, uv: surface.into(), behind: wo.z < 0.0 };
        let hole = scene.materials.hole(at, &scene.textures);
        Self { frame, wo, hole, at }
    }

    /// Adds the BSDFs of what is there. (A list that is returned is copied: 3 % of the time of a small scene.)
    #[inline]
    pub fn add_lobes<'a>(
        &self,
        scene: &'a Prepared,
        surface: &Surface,
        counters: &mut Counters,
        lobes: &mut Lobes<'a>,
    ) {
        let Self { frame, wo, hole, at } = *self;
        let perturbed = |map: &Map, over| {
            match map.map {
                NormalMap::Normal(_) | NormalMap::Tangent { .. } => counters.normal_maps += 1,
                NormalMap::Bump { .. } => counters.bump_maps += 1,
            }
            let dp_duv = scene.geometry.dp_duv(surface).map(|d| frame.to_local(d));
            let hit = Perturbed { uv: surface.into(), wo, ng: frame.to_local(surface.ng), dp_duv };
            hit.by(map, over, &scene.textures)
        };
        scene.materials.add_lobes(at, wo, hole, &scene.textures, perturbed, lobes);
    }
}

/// Writes what the feature layers hold of this vertex: at the first hit, and again at each later one until the
/// feature hit, so that a chain of mirrors that never ends keeps its first.
fn record_features(
    path: &mut Path,
    surface: &Surface,
    bsdf: &Lobes,
    wo: Vec3,
    normal: Vec3,
    material: u32,
    features: &mut Sample,
) {
    if !path.met {
        path.met = true;
        features.set(Layer::Hit, [1.0]);
        features.ids = [surface.object as f32, material as f32];
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
