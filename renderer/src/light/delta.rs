//! Lights that are seen from a point in one direction only: no ray finds them, so that a light sample is all there is
//! and counts in full, without a partner for multiple importance sampling.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DMat3, DMat4, DVec3};
use limpid_scenes::{Color, LightKind};

use super::choice::Weigh;
use super::directional::Directional;
use super::ies::Ies;
use super::point::Point;
use super::projector::Projector;
use super::spot::Spot;
use crate::color::Rgb;
use crate::texture::Textures;

/// Light that arrives at a point.
#[derive(Clone, Copy, Debug)]
pub struct Arriving {
    /// Towards the light, unit.
    pub wi: DVec3,
    /// Of the light; infinite where it is at infinity.
    pub distance: f64,
    /// On a surface across `wi`, in W·m⁻².
    pub irradiance: Rgb,
}

/// One of them.
pub enum Delta {
    Point(Point),
    Spot(Spot),
    Ies(Ies),
    Directional(Directional),
    Projector(Projector),
}

impl Delta {
    /// `None` if the light is of another kind. `origin` is that of render space, in world space.
    pub fn new(kind: &LightKind, origin: DVec3) -> Option<Self> {
        let place = |world_from_light: &DMat4| Place::new(*world_from_light, origin);
        Some(match kind {
            LightKind::Constant { .. }
            | LightKind::EnvMap { .. }
            | LightKind::Sky { .. }
            | LightKind::Sun { .. } => return None,
            LightKind::Point { position, intensity } => {
                Self::Point(Point { position: *position - origin, intensity: (*intensity).into() })
            }
            LightKind::Spot { world_from_light, intensity, cutoff_deg, beam_deg, falloff, texture } => {
                Self::Spot(Spot {
                    place: place(world_from_light),
                    intensity: (*intensity).into(),
                    cutoff: cutoff_deg.to_radians(),
                    beam: beam_deg.to_radians(),
                    falloff: *falloff,
                    texture: *texture,
                })
            }
            LightKind::Ies { world_from_light, intensity, profile } => Self::Ies(Ies {
                place: place(world_from_light),
                intensity: (*intensity).into(),
                profile: Arc::clone(profile),
            }),
            LightKind::Directional { direction, irradiance } => {
                Self::Directional(Directional { wi: -*direction, irradiance: (*irradiance).into() })
            }
            LightKind::Projector { world_from_light, irradiance, scale, half_size } => {
                Self::Projector(Projector {
                    place: place(world_from_light),
                    irradiance: *irradiance,
                    scale: *scale,
                    half_size: (*half_size).into(),
                })
            }
        })
    }

    /// What arrives at the point `p`; `None` where there is nothing.
    #[inline]
    pub fn at(&self, p: DVec3, textures: &Textures) -> Option<Arriving> {
        match self {
            Self::Point(light) => light.at(p),
            Self::Spot(light) => light.at(p, textures),
            Self::Ies(light) => light.at(p),
            Self::Directional(light) => Some(light.at()),
            Self::Projector(light) => light.at(p, textures),
        }
    }

    /// Emitted power as a luminance; what enters a sphere of `scene_radius` where it comes from infinity. The power of a
    /// picture is an estimate, which may miss what is bright in it: only what cannot emit is never chosen.
    pub fn weigh(&self, scene_radius: f64, textures: &Textures) -> Weigh {
        if self.is_black() {
            return Weigh::Never;
        }
        Weigh::Power(match self {
            Self::Point(light) => light.power(),
            Self::Spot(light) => light.power(textures),
            Self::Ies(light) => light.power(),
            Self::Directional(light) => PI * scene_radius * scene_radius * light.irradiance(),
            Self::Projector(light) => light.power(textures),
        })
    }

    fn is_black(&self) -> bool {
        let is_black = |color: Color| color == Color::Constant([0.0; 3]);
        match self {
            Self::Point(light) => light.intensity == Rgb::ZERO,
            Self::Spot(light) => light.intensity == Rgb::ZERO || is_black(light.texture),
            Self::Ies(light) => light.intensity == Rgb::ZERO || light.profile.is_dark(),
            Self::Directional(light) => light.irradiance == Rgb::ZERO,
            Self::Projector(light) => light.scale == 0.0 || is_black(light.irradiance),
        }
    }
}

/// Where a light stands that shines along the +z of its own space.
pub struct Place {
    /// In render space.
    pub position: DVec3,
    /// The image of +z: not unit where there is a scale.
    pub axis: DVec3,
    light_from_render: DMat3,
}

impl Place {
    /// `origin` is that of render space, in world space.
    pub fn new(world_from_light: DMat4, origin: DVec3) -> Self {
        let matrix = DMat3::from_mat4(world_from_light);
        Self {
            position: world_from_light.w_axis.truncate() - origin,
            axis: matrix.z_axis,
            light_from_render: matrix.inverse(),
        }
    }

    /// The point `p` of render space in the light's own.
    #[inline]
    pub fn local(&self, p: DVec3) -> DVec3 {
        self.light_from_render * (p - self.position)
    }
}

/// A colour times a number that may be beyond `f32`.
#[inline]
pub fn scaled(color: Rgb, factor: f64) -> Rgb {
    (color.as_dvec3() * factor).as_vec3()
}
