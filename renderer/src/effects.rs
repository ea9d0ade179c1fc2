//! Which effects a scene calls for, and what was done for each.

use limpid_scenes::{LightKind, MaterialKind, Scene};

/// Something that costs time only in scenes that have it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Effect {
    /// Light from infinity.
    Environment,
    /// Light through surfaces.
    Transmission,
    /// Participating media: read, and refused by [`prepare`](crate::Prepared::new).
    Media,
}

impl Effect {
    /// All effects that there are.
    pub const ALL: [Self; 3] = [Self::Environment, Self::Transmission, Self::Media];

    /// As `limpid info` prints it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Environment => "environment",
            Self::Transmission => "transmission",
            Self::Media => "media",
        }
    }
}

/// An effect that a scene calls for, and the element that does.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Called {
    /// The effect.
    pub effect: Effect,
    /// `emitter "sky"`.
    pub because: String,
}

/// The effects that `scene` calls for, each with the first element that does.
pub fn effects(scene: &Scene) -> Vec<Called> {
    let environment = scene.lights.iter().find(|light| match light.kind {
        LightKind::Constant { .. } | LightKind::EnvMap { .. } => true,
    });
    let transmission = scene.shapes.iter().find_map(|shape| {
        let material = &scene.materials[shape.material.0 as usize];
        transmits(&material.kind).then_some(&material.name)
    });
    let because = |what: &str, name: &String| format!("{what} \"{name}\"");
    [
        (Effect::Environment, environment.map(|l| because("emitter", &l.name))),
        (Effect::Transmission, transmission.map(|name| because("bsdf", name))),
        (Effect::Media, scene.media.first().map(|m| because("medium", &m.name))),
    ]
    .into_iter()
    .filter_map(|(effect, because)| because.map(|because| Called { effect, because }))
    .collect()
}

fn transmits(kind: &MaterialKind) -> bool {
    match kind {
        MaterialKind::Dielectric { .. } => true,
        MaterialKind::Diffuse { .. }
        | MaterialKind::Conductor { .. }
        | MaterialKind::RoughConductor { .. }
        | MaterialKind::Plastic { .. }
        | MaterialKind::RoughPlastic { .. }
        | MaterialKind::TwoSided { .. } => false,
    }
}

/// What a render did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Paths begun.
    pub paths: u64,
    /// Rays for the nearest hit.
    pub rays: u64,
    /// Rays towards lights.
    pub shadow_rays: u64,
    /// Rays that left the scene and looked up its environment.
    pub environment: u64,
    /// Directions sampled through a surface.
    pub transmission: u64,
}

impl Counters {
    /// Adds another thread's.
    pub fn add(&mut self, other: &Self) {
        self.paths += other.paths;
        self.rays += other.rays;
        self.shadow_rays += other.shadow_rays;
        self.environment += other.environment;
        self.transmission += other.transmission;
    }

    /// What was done for an effect.
    pub fn of(&self, effect: Effect) -> u64 {
        match effect {
            Effect::Environment => self.environment,
            Effect::Transmission => self.transmission,
            Effect::Media => 0,
        }
    }
}
