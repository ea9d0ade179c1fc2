//! From a scene to what paths are traced in.

use glam::DVec3;
use limpid_scenes::{Camera as SceneCamera, Place, Scene};

use crate::accel::Accel;
use crate::effects::{Called, effects};
use crate::geometry::Geometry;
use crate::light::Lights;
use crate::material::Materials;
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
        let triangles: Vec<_> =
            (0..geometry.triangles.len() as u32).map(|prim| geometry.corners(prim)).collect();
        let accel = Accel::build(&triangles, &geometry.analytics);
        drop(triangles);
        let textures = Textures::prepare(scene);
        let materials = Materials::prepare(scene)?;
        let lights = Lights::new(scene, &geometry, &textures, accel.bounds());
        Ok(Self { geometry, accel, materials, textures, lights, camera, origin, effects: effects(scene) })
    }

    /// The effects that the scene calls for.
    pub fn effects(&self) -> &[Called] {
        &self.effects
    }

    /// Number of triangles, built-in shapes included.
    pub fn triangles(&self) -> usize {
        self.geometry.triangles.len()
    }
}
