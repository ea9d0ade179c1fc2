//! Lights: the same contract as a BSDF's, seen from a point: draw a direction, give its density.
//!
//! All densities are per steradian and include the choice among the lights. Area lights emit on one side only, that of
//! their geometric normal. Points are drawn and densities computed in `f64`: a lamp may be a billionth of its distance
//! wide, or a million times as wide as it.

mod choice;
mod cylinder;
mod delta;
mod directional;
mod disk;
mod environment;
mod gather;
mod ies;
mod point;
mod projector;
mod rectangle;
mod shape;
mod sky;
mod sphere;
mod spot;
mod sun;
mod surface;
mod texels;
mod triangle;
mod triangles;

use std::f64::consts::PI;

use glam::{DVec2, DVec3, Vec2, Vec3};
use limpid_scenes::{Color, Light as SceneLight, LightKind};

use crate::color::Rgb;
use crate::sampling::Distribution1d;
use crate::texture::{TexturePoint, Textures};
use choice::{Weigh, choose_from};
use delta::Delta;
use environment::EnvMap;
pub use shape::{LightAnalytic, LightForm, LightRectangle, LightShape, LightTriangle};
use sky::Sky;
use sun::Sun;
use surface::SurfaceLight;

/// "No primitive": what the shadow ray of a light at infinity ignores.
const NONE: u32 = u32::MAX;

/// Shadow rays end this much before the light, as a share of the way: room for the rounding of the direction. What
/// lies nearer to the light than that does not shade it.
const SHORTEN: f64 = 1.0 - 1e-5;

/// Index of a light: those with a surface first, then those that surround the scene, then those that no ray finds, each in
/// the order in which they were given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct LightId(pub u32);

/// A direction towards a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSample {
    /// Unit, away from the point.
    pub wi: Vec3,
    /// Length of the shadow ray; infinite for a light at infinity.
    pub t_max: f32,
    /// Emitted towards the point; of a `delta` light, the irradiance on a surface across `wi`.
    pub radiance: Rgb,
    /// No ray finds the light: `pdf` is the probability of its choice, and nothing shares the sample's weight.
    pub delta: bool,
    /// Positive and finite. Where the true density is beyond `f32`, the radiance is scaled with it.
    pub pdf: f32,
    /// The primitive that the shadow ray must not see: the light's own.
    pub skip: u32,
}

/// A point on a light's surface that a ray has hit.
#[derive(Clone, Copy, Debug)]
pub struct LightHit {
    /// In render space.
    pub p: Vec3,
    /// Geometric normal, on the side that the scene's author gave it.
    pub ng: Vec3,
    /// Where its radiance is looked up.
    pub uv: TexturePoint,
    /// The primitive.
    pub prim: u32,
}

/// What a light with a surface draws: a point that emits towards the one it is seen from.
#[derive(Clone, Copy, Debug)]
struct Drawn {
    /// Unit.
    wi: DVec3,
    distance: f64,
    /// Per steradian, without the choice of the light.
    pdf: f64,
    uv: TexturePoint,
    prim: u32,
}

enum Infinite {
    /// The same radiance from everywhere.
    Constant(Rgb),
    EnvMap(Box<EnvMap>),
    Sky(Box<Sky>),
    Sun(Box<Sun>),
}

/// All lights of a scene.
pub struct Lights {
    surfaces: Vec<SurfaceLight>,
    infinite: Vec<Infinite>,
    deltas: Vec<Delta>,
    /// `None` if nothing emits.
    choice: Option<Distribution1d>,
    /// By shape: its light, or [`NONE`].
    of_shape: Vec<u32>,
    bad_texels: u64,
}

impl Lights {
    /// Builds the sampling tables. `others` have no surface; `origin` is that of render space, in world space;
    /// `scene_radius` is that of a sphere around the scene.
    pub fn from_shapes(
        shapes: Vec<LightShape>,
        others: &[SceneLight],
        textures: &Textures,
        origin: DVec3,
        scene_radius: f64,
    ) -> Self {
        let mut of_shape = Vec::new();
        for (light, shape) in shapes.iter().enumerate() {
            let index = shape.shape as usize;
            if of_shape.len() <= index {
                of_shape.resize(index + 1, NONE);
            }
            of_shape[index] = light as u32;
        }
        let surfaces: Vec<_> = shapes
            .into_iter()
            .map(|LightShape { form, emission, .. }| SurfaceLight::new(form, emission, textures))
            .collect();
        let infinite: Vec<_> = others.iter().filter_map(|light| Infinite::new(&light.kind)).collect();
        let deltas: Vec<_> = others.iter().filter_map(|light| Delta::new(&light.kind, origin)).collect();
        let of_surfaces = surfaces.iter().map(|light| light.weigh(textures));
        let of_infinite = infinite.iter().map(|light| light.weigh(scene_radius));
        let of_deltas = deltas.iter().map(|light| light.weigh(scene_radius, textures));
        let weights: Vec<_> = of_surfaces.chain(of_infinite).chain(of_deltas).collect();
        let bad_texels = infinite.iter().map(Infinite::bad_texels).sum();
        Self { surfaces, infinite, deltas, choice: choose_from(&weights), of_shape, bad_texels }
    }

    /// The light that a shape is.
    #[inline]
    pub fn of_shape(&self, shape: u32) -> Option<LightId> {
        self.of_shape.get(shape as usize).filter(|&&light| light != NONE).map(|&light| LightId(light))
    }

    /// Whether light comes from infinity.
    #[inline]
    pub fn has_infinite(&self) -> bool {
        !self.infinite.is_empty()
    }

    /// Texels of environment maps that are not finite or negative and count as 0: worth a warning.
    pub fn bad_texels(&self) -> u64 {
        self.bad_texels
    }

    /// Draws a direction from the point `p` towards a light. `choice` and `u` are uniform in [0, 1). `None` where
    /// nothing is emitted towards `p` from what was drawn.
    #[inline]
    pub fn sample(&self, p: Vec3, choice: f32, u: Vec2, textures: &Textures) -> Option<LightSample> {
        let lights = self.choice.as_ref()?;
        let (light, rest) = lights.sample(choice.into());
        let pmf = lights.pmf(light);
        let u = u.as_dvec2();
        if let Some(light) = self.surfaces.get(light) {
            let drawn = light.form.sample(p.as_dvec3(), rest, u)?;
            let (wi, t_max) = (drawn.wi.as_vec3(), (drawn.distance * SHORTEN) as f32);
            let radiance = textures.color(light.emission, drawn.uv);
            LightSample { wi, t_max, radiance, delta: false, pdf: 0.0, skip: drawn.prim }
                .with_pdf(pmf * drawn.pdf)
        } else if let Some(light) = self.infinite.get(light - self.surfaces.len()) {
            let (wi, radiance, pdf) = light.sample(u)?;
            LightSample { wi, t_max: f32::INFINITY, radiance, delta: false, pdf: 0.0, skip: NONE }
                .with_pdf(pmf * pdf)
        } else {
            let light = &self.deltas[light - self.surfaces.len() - self.infinite.len()];
            let arriving = light.at(p.as_dvec3(), textures)?;
            let (wi, t_max) = (arriving.wi.as_vec3(), (arriving.distance * SHORTEN) as f32);
            LightSample { wi, t_max, radiance: arriving.irradiance, delta: true, pdf: 0.0, skip: NONE }
                .with_pdf(pmf)
        }
    }

    /// What a light emits towards `wo`, unit, from a point on it.
    #[inline]
    pub fn radiance_at(&self, light: LightId, at: &LightHit, wo: Vec3, textures: &Textures) -> Rgb {
        if at.ng.dot(wo) <= 0.0 {
            return Rgb::ZERO;
        }
        textures.color(self.surfaces[light.0 as usize].emission, at.uv)
    }

    /// What a light emits against the unit direction `wi`, in which it was hit from the point `from`, and the density
    /// with which [`sample`](Self::sample) draws that direction and light.
    #[inline]
    pub fn hit_at(
        &self,
        light: LightId,
        from: Vec3,
        at: &LightHit,
        wi: Vec3,
        textures: &Textures,
    ) -> (Rgb, f32) {
        let radiance = self.radiance_at(light, at, -wi, textures);
        let pdf = self.surfaces[light.0 as usize].form.pdf(from.as_dvec3(), at, wi.as_dvec3());
        (radiance, finite(self.pmf(light.0) * pdf))
    }

    /// What each light at infinity sends against the unit direction `wi`, and the density with which
    /// [`sample`](Self::sample) draws that direction and light.
    #[inline]
    pub fn miss(&self, wi: Vec3) -> impl Iterator<Item = (Rgb, f32)> + '_ {
        let first = self.surfaces.len() as u32;
        self.infinite.iter().enumerate().map(move |(i, light)| {
            let (radiance, pdf) = light.eval(wi);
            (radiance, finite(self.pmf(first + i as u32) * pdf))
        })
    }

    /// Probability of choosing a light.
    #[inline]
    fn pmf(&self, light: u32) -> f64 {
        self.choice.as_ref().map_or(0.0, |choice| choice.pmf(light as usize))
    }
}

impl LightSample {
    #[inline]
    fn with_pdf(self, pdf: f64) -> Option<Self> {
        let scale = (f64::from(f32::MAX) / pdf).min(1.0) as f32;
        let pdf = finite(pdf);
        (pdf > 0.0).then_some(Self { pdf, radiance: self.radiance * scale, ..self })
    }
}

/// Rounds a density to `f32`, at most its largest number; NaN becomes 0.
#[inline]
fn finite(pdf: f64) -> f32 {
    pdf.max(0.0).min(f32::MAX.into()) as f32
}

/// Luminance over [0, 1]², from a coarse grid: it steers the choice among lights, no more.
fn mean_luminance(color: Color, textures: &Textures) -> f64 {
    weighted_mean(color, textures, |_| 1.0)
}

/// The same with a weight at each uv.
fn weighted_mean(color: Color, textures: &Textures, weight: impl Fn(Vec2) -> f64) -> f64 {
    const N: u32 = 32;
    let at = |i: u32| (i as f32 + 0.5) / N as f32;
    let (mut sum, mut weights) = (0.0, 0.0);
    for uv in (0..N * N).map(|k| Vec2::new(at(k % N), at(k / N))) {
        let w = weight(uv);
        weights += w;
        sum += w * texels::luminance_at(color, textures, uv);
    }
    sum / weights
}

impl Infinite {
    /// `None` if the light is not one that surrounds the scene.
    fn new(kind: &LightKind) -> Option<Self> {
        match kind {
            LightKind::Constant { radiance } => Some(Self::Constant((*radiance).into())),
            LightKind::EnvMap { image, scale, world_from_light } => {
                Some(Self::EnvMap(Box::new(EnvMap::new(image.clone(), *scale, *world_from_light))))
            }
            LightKind::Sky { daylight, scale } => Some(Self::Sky(Box::new(Sky::new(daylight, *scale)))),
            LightKind::Sun { daylight, half_deg, scale } => {
                Some(Self::Sun(Box::new(Sun::new(daylight, *half_deg, *scale))))
            }
            LightKind::Point { .. }
            | LightKind::Spot { .. }
            | LightKind::Ies { .. }
            | LightKind::Directional { .. }
            | LightKind::Projector { .. } => None,
        }
    }

    /// A direction, what comes from there, and the density of drawing it.
    #[inline]
    fn sample(&self, u: DVec2) -> Option<(Vec3, Rgb, f64)> {
        match self {
            Self::Constant(_) => None, // it is never chosen
            // As it is looked up where a path leaves the scene in this direction.
            Self::EnvMap(light) => {
                let wi = light.sample(u)?.as_vec3();
                let (radiance, pdf) = light.eval(wi);
                Some((wi, radiance, pdf))
            }
            Self::Sky(light) => {
                let wi = light.sample(u)?.as_vec3();
                let (radiance, pdf) = light.eval(wi);
                Some((wi, radiance, pdf))
            }
            Self::Sun(light) => Some(light.sample(u)),
        }
    }

    #[inline]
    fn eval(&self, wi: Vec3) -> (Rgb, f64) {
        match self {
            Self::Constant(radiance) => (*radiance, 0.0),
            Self::EnvMap(light) => light.eval(wi),
            Self::Sky(light) => light.eval(wi),
            Self::Sun(light) => light.eval(wi),
        }
    }

    /// What enters a sphere around the scene: π · radius² · (luminance over all directions). A constant one is never
    /// chosen: nothing about it is better known than a BSDF's own density, so that a light sample would add noise (a
    /// convex Lambertian body under it has none without) and cost a ray (compare Karlík et al. 2019).
    fn weigh(&self, scene_radius: f64) -> Weigh {
        let of = |(integral, is_black): (f64, bool)| {
            if is_black { Weigh::Never } else { Weigh::Power(PI * scene_radius * scene_radius * integral) }
        };
        match self {
            Self::Constant(_) => Weigh::Never,
            Self::EnvMap(light) => of(light.integral()),
            Self::Sky(light) => of(light.integral()),
            Self::Sun(light) => of((light.integral(), light.integral() == 0.0)),
        }
    }

    fn bad_texels(&self) -> u64 {
        match self {
            Self::Constant(_) | Self::Sky(_) | Self::Sun(_) => 0,
            Self::EnvMap(light) => light.bad_texels(),
        }
    }
}

/// Density per steradian, seen from `p`, of the point `q` that is drawn with density 1 / |`n`| per area from a plane with
/// the normal `n`.
#[inline]
fn area_pdf(p: DVec3, q: DVec3, n: DVec3) -> f64 {
    let d = q - p;
    let distance = d.length();
    distance * distance * distance / d.dot(n).abs()
}

#[cfg(test)]
mod tests;
