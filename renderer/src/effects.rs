//! Which effects a scene calls for, and what was done for each.

use limpid_scenes::{MaterialId, MaterialKind, NormalMap, Scene, ShapeKind};

/// Something that costs time only in scenes that have it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Effect {
    /// A lens in front of the film.
    DepthOfField,
    /// Light from infinity.
    Environment,
    /// Light through surfaces.
    Transmission,
    /// Insides of glass that take some of the light.
    Absorption,
    /// Surfaces that are there in part only.
    Alpha,
    /// Shading normals turned by a picture of normals.
    NormalMaps,
    /// Shading normals turned by a picture of heights.
    BumpMaps,
    /// Groups of shapes shown by instances.
    Instancing,
    /// Participating media: read, and refused by [`prepare`](crate::Prepared::new).
    Media,
}

impl Effect {
    /// All effects that there are.
    pub const ALL: [Self; 9] = [
        Self::DepthOfField,
        Self::Environment,
        Self::Transmission,
        Self::Absorption,
        Self::Alpha,
        Self::NormalMaps,
        Self::BumpMaps,
        Self::Instancing,
        Self::Media,
    ];

    /// As `limpid info` prints it.
    pub fn name(self) -> &'static str {
        match self {
            Self::DepthOfField => "depth of field",
            Self::Environment => "environment",
            Self::Transmission => "transmission",
            Self::Absorption => "absorption",
            Self::Alpha => "alpha",
            Self::NormalMaps => "normal maps",
            Self::BumpMaps => "bump maps",
            Self::Instancing => "instancing",
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
    let lens = scene.cameras.iter().find(|camera| camera.lens.is_some());
    let environment = scene.lights.iter().find(|light| light.kind.is_at_infinity());
    let in_groups = scene.groups.iter().flat_map(|group| &group.shapes);
    let mut used: Vec<MaterialId> =
        scene.shapes.iter().chain(in_groups).map(|shape| shape.material).collect();
    used.sort_unstable();
    used.dedup();
    let material = |test: fn(&MaterialKind) -> bool| {
        let called = used.iter().find(|&&id| scene.any_material(id, test));
        called.map(|id| &scene.materials[id.0 as usize].name)
    };
    let alpha = material(|kind| matches!(kind, MaterialKind::Mask { .. } | MaterialKind::Null));
    let normal_map = material(|kind| {
        matches!(kind, MaterialKind::Perturbed { map: NormalMap::Normal(_) | NormalMap::Tangent { .. }, .. })
    });
    let bump_map =
        material(|kind| matches!(kind, MaterialKind::Perturbed { map: NormalMap::Bump { .. }, .. }));
    let transmission = material(MaterialKind::transmits);
    let absorption = material(MaterialKind::absorbs);
    let instance = scene.shapes.iter().find(|shape| matches!(shape.kind, ShapeKind::Instance { .. }));
    let because = |what: &str, name: &String| format!("{what} \"{name}\"");
    [
        (Effect::DepthOfField, lens.map(|c| because("sensor", &c.name))),
        (Effect::Environment, environment.map(|l| because("emitter", &l.name))),
        (Effect::Transmission, transmission.map(|name| because("bsdf", name))),
        (Effect::Absorption, absorption.map(|name| because("bsdf", name))),
        (Effect::Alpha, alpha.map(|name| because("bsdf", name))),
        (Effect::NormalMaps, normal_map.map(|name| because("bsdf", name))),
        (Effect::BumpMaps, bump_map.map(|name| because("bsdf", name))),
        (Effect::Instancing, instance.map(|s| because("shape", &s.name))),
        (Effect::Media, scene.media.first().map(|m| because("medium", &m.name))),
    ]
    .into_iter()
    .filter_map(|(effect, because)| because.map(|because| Called { effect, because }))
    .collect()
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
    /// Paths begun through a lens.
    pub depth_of_field: u64,
    /// Rays that left the scene and looked up its environment.
    pub environment: u64,
    /// Directions sampled through a surface.
    pub transmission: u64,
    /// Ways of paths through insides that absorb.
    pub absorption: u64,
    /// Paths and light samples that went straight through a hole.
    pub alpha: u64,
    /// Shading normals turned by a picture of normals.
    pub normal_maps: u64,
    /// Shading normals turned by a picture of heights.
    pub bump_maps: u64,
    /// Hits through instances.
    pub instancing: u64,
}

impl Counters {
    /// Adds another thread's.
    pub fn add(&mut self, other: &Self) {
        self.paths += other.paths;
        self.rays += other.rays;
        self.shadow_rays += other.shadow_rays;
        self.depth_of_field += other.depth_of_field;
        self.environment += other.environment;
        self.transmission += other.transmission;
        self.absorption += other.absorption;
        self.alpha += other.alpha;
        self.normal_maps += other.normal_maps;
        self.bump_maps += other.bump_maps;
        self.instancing += other.instancing;
    }

    /// What was done for an effect.
    pub fn of(&self, effect: Effect) -> u64 {
        match effect {
            Effect::DepthOfField => self.depth_of_field,
            Effect::Environment => self.environment,
            Effect::Transmission => self.transmission,
            Effect::Absorption => self.absorption,
            Effect::Alpha => self.alpha,
            Effect::NormalMaps => self.normal_maps,
            Effect::BumpMaps => self.bump_maps,
            Effect::Instancing => self.instancing,
            Effect::Media => 0,
        }
    }
}
