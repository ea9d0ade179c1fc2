//! From a scene to what paths are traced in.

use std::ops::Range;

use glam::{DVec3, Vec2};
use limpid_scenes::{Camera as SceneCamera, Place, Scene};

use crate::accel::{Accel, Hit, Instance, NONE, Prims, Ray};
use crate::bsdf::Lobes;
use crate::effects::{Called, Counters, Effect, effects};
use crate::geometry::{Geometry, Surface, shape_of};
use crate::light::Lights;
use crate::material::{At, Materials};
use crate::path::Scattering;
use crate::texture::Textures;

/// Why a scene cannot be rendered.
#[derive(Debug, thiserror::Error)]
#[error("{element}: {problem}")]
pub struct PrepareError {
    /// Where the element stands.
    pub place: Place,
    /// What the user would search for: `medium "smoke"`.
    pub element: String,
    /// One clause.
    pub problem: String,
    /// An instruction.
    pub help: String,
}

/// A scene as one of its cameras sees it, ready for rendering.
pub struct Prepared {
    pub(crate) geometry: Geometry,
    pub(crate) accel: Accel,
    pub(crate) materials: Materials,
    pub(crate) textures: Textures,
    pub(crate) lights: Lights,
    pub(crate) camera: SceneCamera,
    /// The camera's position in world space, where the origin of render space is.
    pub(crate) origin: DVec3,
    /// Some surface lets light straight through.
    pub(crate) has_holes: bool,
    /// The inside of some material absorbs.
    pub(crate) has_absorption: bool,
    effects: Vec<Called>,
}

impl Prepared {
    /// Moves the scene into the space of its camera number `camera`, builds the acceleration structure and the
    /// sampling tables. Runs on the current rayon pool.
    ///
    /// # Errors
    ///
    /// Where the scene holds what the renderer lacks.
    ///
    /// # Panics
    ///
    /// If there is no such camera.
    pub fn new(scene: &Scene, camera: usize) -> Result<Self, PrepareError> {
        if let Some(medium) = scene.media.first() {
            return Err(PrepareError {
                place: medium.place.clone(),
                element: format!("medium \"{}\"", medium.name),
                problem: "participating media are not rendered yet".into(),
                help: "remove the medium and the references to it, or render a scene without media".into(),
            });
        }
        let camera = scene.cameras[camera].clone();
        let origin = camera.world_from_camera.w_axis.truncate();
        let geometry = Geometry::new(scene, origin);
        if let Some(shape) = geometry.out_of_range() {
            let shape = shape_of(scene, shape).expect("it is one of the scene's");
            return Err(PrepareError {
                place: shape.place.clone(),
                element: format!("shape \"{}\"", shape.name),
                problem: "a coordinate relative to the camera is beyond 3.4e38".into(),
                help: "check the transforms of the shape and of the camera, or scale the scene down".into(),
            });
        }
        let accel = accelerate(&geometry);
        let textures = Textures::prepare(scene);
        let materials = Materials::prepare(scene)?;
        let lights = Lights::new(scene, &geometry, &textures, origin, accel.radius());
        let has_holes = geometry.shapes.iter().any(|shape| materials.has_holes(shape.material));
        let has_absorption = materials.absorb();
        let mut effects = effects(scene);
        effects.retain(|called| called.effect != Effect::DepthOfField || camera.lens.is_some());
        Ok(Self {
            geometry,
            accel,
            materials,
            textures,
            lights,
            camera,
            origin,
            has_holes,
            has_absorption,
            effects,
        })
    }

    /// The effects that the scene calls for, seen by this camera.
    pub fn effects(&self) -> &[Called] {
        &self.effects
    }

    /// Texels of environment maps that are not finite or are negative and count as 0: worth a warning.
    pub fn bad_texels(&self) -> u64 {
        self.lights.bad_texels()
    }

    /// Number of triangles, built-in shapes included; those of a group count once.
    pub fn triangles(&self) -> usize {
        self.geometry.triangles.len()
    }
}

/// Builds the trees: over the scene's own primitives, over those of each group, and over the instances.
fn accelerate(geometry: &Geometry) -> Accel {
    let corners: Vec<_> = (0..geometry.triangles.len() as u32).map(|prim| geometry.corners(prim)).collect();
    let prims = |triangles: Range<u32>, analytics: Range<u32>| Prims {
        triangles: &corners[triangles.start as usize..triangles.end as usize],
        first_triangle: triangles.start,
        analytics: &geometry.analytics[analytics.start as usize..analytics.end as usize],
        first_analytic: geometry.triangles.len() as u32 + analytics.start,
    };
    let groups: Vec<_> =
        geometry.groups.iter().map(|group| prims(group.triangles.clone(), group.analytics.clone())).collect();
    let (triangles, analytics) = match geometry.groups.first() {
        Some(first) => (first.triangles.start, first.analytics.start),
        None => (geometry.triangles.len() as u32, geometry.analytics.len() as u32),
    };
    let instances: Vec<_> = (geometry.instances.iter())
        .map(|placed| Instance {
            group: placed.group,
            render_from_group: placed.frame.render_from_object,
            after: placed.after,
        })
        .collect();
    Accel::new(&prims(0..triangles, 0..analytics), &groups, &instances)
}

/// A ray in world space, for questions about a scene's geometry.
#[derive(Clone, Copy, Debug)]
pub struct WorldRay {
    /// Origin.
    pub o: DVec3,
    /// Direction, not zero.
    pub d: DVec3,
}

/// What a [`WorldRay`] hits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorldHit {
    /// Distance in world units.
    pub t: f64,
    /// The point on the surface.
    pub p: DVec3,
    /// Geometric normal, unit.
    pub ng: DVec3,
    /// Index into the scene's shapes.
    pub shape: u32,
}

/// One draw of the BSDF where a [`WorldRay`] hits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorldScatter {
    /// Away from the surface, unit.
    pub wi: DVec3,
    /// `f · cos θi / pdf`, linear Rec. 709.
    pub weight: [f32; 3],
    /// Per steradian; 1 for a delta lobe, where it means nothing.
    pub pdf: f32,
}

impl Prepared {
    /// What the surface at the nearest hit of `ray`, where it is there, makes of the draw `u` in `[0, 1)³`: the choice among its lobes, and two
    /// for the direction. `None` where nothing is hit or nothing scattered.
    pub fn scatter(&self, ray: WorldRay, u: [f32; 3]) -> Option<WorldScatter> {
        let ray = self.local_ray(ray);
        let mut hits = [Hit::MISS];
        self.accel.closest(&[ray], &mut hits);
        let surface = (hits[0].prim != NONE).then(|| self.geometry.surface(&ray, &hits[0]))?;
        let scattering = Scattering::new(self, &ray, &surface);
        let mut lobes = Lobes::default();
        scattering.add_lobes(self, &surface, &mut Counters::default(), &mut lobes);
        let sample = lobes.sample(scattering.wo, u[0], Vec2::new(u[1], u[2]))?;
        Some(WorldScatter {
            wi: scattering.frame.to_render(sample.wi).as_dvec3(),
            weight: sample.weight.total().to_array(),
            pdf: sample.pdf,
        })
    }

    /// Share of light that goes straight through where `ray` hits.
    pub(crate) fn hole(&self, ray: &Ray, surface: &Surface) -> f32 {
        let material = self.geometry.shapes[surface.shape as usize].material;
        let at = At { material, uv: surface.into(), behind: ray.d.dot(surface.ns) > 0.0 };
        self.materials.hole(at, &self.textures)
    }

    fn local_ray(&self, ray: WorldRay) -> Ray {
        Ray::new((ray.o - self.origin).as_vec3(), ray.d.normalize().as_vec3().normalize())
    }

    /// The nearest hit of each ray; origin and direction are rounded to `f32` in the space of the camera.
    pub fn cast(&self, rays: &[WorldRay]) -> Vec<Option<WorldHit>> {
        let rays: Vec<Ray> = rays.iter().map(|&ray| self.local_ray(ray)).collect();
        let mut hits = vec![Hit::MISS; rays.len()];
        self.accel.closest(&rays, &mut hits);
        let world = |(ray, hit): (&Ray, &Hit)| {
            (hit.prim != NONE).then(|| {
                let surface = self.geometry.surface(ray, hit);
                WorldHit {
                    t: hit.t.into(),
                    p: surface.p.as_dvec3() + self.origin,
                    ng: surface.ng.as_dvec3(),
                    shape: surface.object,
                }
            })
        };
        rays.iter().zip(&hits).map(world).collect()
    }
}
