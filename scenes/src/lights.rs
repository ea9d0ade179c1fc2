//! Lights without a surface. Those of a surface are its [`Emission`](crate::Emission).

use std::sync::Arc;

use glam::{DMat4, DVec3};

use crate::{Color, Daylight, IesProfile, Image, Place, Rgb};

/// A light that is not the surface of a shape.
#[derive(Clone, Debug)]
pub struct Light {
    /// The file's id, or its kind and a number.
    pub name: String,
    /// What it sends.
    pub kind: LightKind,
    /// Where it stands.
    pub place: Place,
}

/// Lights without a surface.
#[derive(Clone, Debug)]
pub enum LightKind {
    /// The same radiance from everywhere.
    Constant {
        /// W·sr⁻¹·m⁻² per channel.
        radiance: Rgb,
    },
    /// A lat-long picture at infinity, +y up in light space; its centre column is seen along +z.
    EnvMap {
        /// Row 0 at the zenith.
        image: Arc<Image>,
        /// Factor on the texels.
        scale: f32,
        /// Only its linear part counts.
        world_from_light: DMat4,
    },
    /// A point that shines into all directions alike.
    Point {
        /// In world space.
        position: DVec3,
        /// W·sr⁻¹ per channel.
        intensity: Rgb,
    },
    /// A point that shines into a cone around the +z of light space: fully within the beam, then less, to nothing at the
    /// cutoff.
    Spot {
        /// The light stands at its origin.
        world_from_light: DMat4,
        /// Along the axis, in W·sr⁻¹ per channel.
        intensity: Rgb,
        /// Half angle of the cone, in degrees, in (0, 180].
        cutoff_deg: f64,
        /// Half angle of the beam, in degrees, at most the cutoff.
        beam_deg: f64,
        /// How it gets less.
        falloff: SpotFalloff,
        /// A factor: a picture over the square around the cone, u along +x, v along +y.
        texture: Color,
    },
    /// A point that shines as a photometric file says.
    Ies {
        /// The light stands at its origin; vertical angles are from +z, horizontal ones from +x towards +y.
        world_from_light: DMat4,
        /// Factor on the profile, whose candelas count as W·sr⁻¹.
        intensity: Rgb,
        /// What goes where.
        profile: Arc<IesProfile>,
    },
    /// Parallel light from infinity.
    Directional {
        /// The way it travels, unit, in world space.
        direction: DVec3,
        /// W·m⁻² per channel, on a surface across it.
        irradiance: Rgb,
    },
    /// The sky of a clear day, without its sun: black below the horizon.
    Sky {
        /// Which day.
        daylight: Daylight,
        /// Factor on its radiance.
        scale: f32,
    },
    /// The sun of a clear day: a round disk at infinity of the same radiance all over. What is below the horizon is cut off.
    Sun {
        /// Which day.
        daylight: Daylight,
        /// Half of the angle under which it is seen, in degrees, in (0, 90\].
        half_deg: f64,
        /// Factor on its radiance.
        scale: f32,
    },
    /// A picture thrown through a pinhole, as a perspective camera takes one: its upper left corner has +x, +y.
    Projector {
        /// The pinhole stands at its origin, the picture lies towards +z.
        world_from_light: DMat4,
        /// Over the picture, from the upper left corner: 1/π of the irradiance in W·m⁻² of the plane z = 1.
        irradiance: Color,
        /// A factor on it.
        scale: f32,
        /// Half of the picture's width and height at z = 1.
        half_size: [f64; 2],
    },
}

/// How a spot's intensity goes from 1 at the beam's angle to 0 at the cutoff's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpotFalloff {
    /// In proportion to the angle, as in Mitsuba 3.
    Angle,
    /// With the square of a share that is linear in the cosine, as glTF's KHR_lights_punctual has it.
    CosineSquared,
}

impl SpotFalloff {
    /// The factor at the angle `theta` from the axis; all in radians. NaN gives 0.
    #[inline]
    pub fn at(self, theta: f64, beam: f64, cutoff: f64) -> f64 {
        match self {
            Self::Angle if theta <= beam => 1.0,
            Self::Angle if theta < cutoff => (cutoff - theta) / (cutoff - beam),
            Self::Angle => 0.0,
            Self::CosineSquared => {
                // the extension's own guard against a division by 0
                let width = (beam.cos() - cutoff.cos()).max(1e-3);
                let share = (theta.cos() - cutoff.cos()) / width;
                if share > 0.0 { share.min(1.0).powi(2) } else { 0.0 }
            }
        }
    }

    /// Integral of the factor over all directions, in steradians.
    pub fn integral(self, beam: f64, cutoff: f64) -> f64 {
        let mean = match self {
            Self::Angle if cutoff > beam => 1.0 - (cutoff.sin() - beam.sin()) / (cutoff - beam),
            Self::Angle => 1.0 - cutoff.cos(),
            Self::CosineSquared => {
                let width = (beam.cos() - cutoff.cos()).max(1e-3);
                let whole = (1.0 - cutoff.cos() - width).max(0.0);
                let edge = 1.0 - cutoff.cos() - whole;
                whole + edge.powi(3) / (3.0 * width * width)
            }
        };
        2.0 * std::f64::consts::PI * mean
    }
}

/// Half angle in degrees of the beam with which a spot of [`SpotFalloff::Angle`] has the power of one of
/// [`SpotFalloff::CosineSquared`], or as nearly as may be: what stands for it where nothing else is known.
pub fn linear_beam_deg(beam_deg: f64, cutoff_deg: f64) -> f64 {
    let (beam, cutoff) = (beam_deg.to_radians(), cutoff_deg.to_radians());
    let power = SpotFalloff::CosineSquared.integral(beam, cutoff);
    let (mut low, mut high) = (0.0, cutoff);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let is_less = SpotFalloff::Angle.integral(middle, cutoff) < power;
        *(if is_less { &mut low } else { &mut high }) = middle;
    }
    low.to_degrees()
}

impl LightKind {
    /// Whether rays that leave the scene find it.
    pub fn is_at_infinity(&self) -> bool {
        self.is_background() || matches!(self, Self::Sun { .. })
    }

    /// Whether it surrounds the scene. A file may have one that does.
    pub fn is_background(&self) -> bool {
        match self {
            Self::Constant { .. } | Self::EnvMap { .. } | Self::Sky { .. } => true,
            Self::Sun { .. }
            | Self::Point { .. }
            | Self::Spot { .. }
            | Self::Ies { .. }
            | Self::Directional { .. }
            | Self::Projector { .. } => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Both falloffs, integrated numerically over θ.
    #[test]
    fn falloffs_have_their_integral() {
        for falloff in [SpotFalloff::Angle, SpotFalloff::CosineSquared] {
            for (beam, cutoff) in [(0.0, 0.5), (0.25, 0.5), (0.5, 0.5), (0.499, 0.5), (0.3, 1.5), (0.0, 0.02)]
            {
                let n = 20_000;
                let step = cutoff / f64::from(n);
                let at = |i: i32| (f64::from(i) + 0.5) * step;
                let sum: f64 = (0..n).map(|i| falloff.at(at(i), beam, cutoff) * at(i).sin()).sum();
                let (sum, truth) = (2.0 * std::f64::consts::PI * sum * step, falloff.integral(beam, cutoff));
                assert!((sum / truth - 1.0).abs() < 1e-3, "{falloff:?} {beam} {cutoff}: {sum} {truth}");
            }
        }
    }

    /// Prints the table in `docs/mitsuba.md`: `cargo test -p limpid-scenes linear_spots -- --nocapture`.
    #[test]
    fn linear_spots_stand_for_those_of_gltf() {
        for (inner_deg, outer_deg) in [(0.0, 45.0), (15.0, 30.0), (25.0, 30.0), (0.0, 90.0)] {
            let beam_deg = linear_beam_deg(inner_deg, outer_deg);
            let [inner, outer, beam] = [inner_deg, outer_deg, beam_deg].map(f64::to_radians);
            let [linear, squared] = [SpotFalloff::Angle, SpotFalloff::CosineSquared];
            let power = linear.integral(beam, outer) / squared.integral(inner, outer);
            let off = |i: i32| {
                let theta = outer * f64::from(i) / 1000.0;
                linear.at(theta, beam, outer) - squared.at(theta, inner, outer)
            };
            let largest = (0..1000).map(off).fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
            println!("| {inner_deg} | {outer_deg} | {beam_deg:.2} | {power:.3} | {largest:+.3} |");
            assert!((power - 1.0).abs() < 0.1 && largest.abs() < 0.25, "{inner_deg} {outer_deg}");
            assert!(beam_deg == 0.0 || outer_deg == 90.0 || (power - 1.0).abs() < 0.02, "{beam_deg} {power}");
        }
    }

    #[test]
    fn gltf_spots_fade_as_the_extension_says() {
        let (inner, outer) = (0.25f64, 0.5f64);
        let scale = 1.0 / (inner.cos() - outer.cos());
        for theta in [0.0, 0.2, 0.3, 0.45, 0.5, 0.6, 3.0] {
            let share = (f64::cos(theta) * scale - outer.cos() * scale).clamp(0.0, 1.0);
            let got = SpotFalloff::CosineSquared.at(theta, inner, outer);
            assert!((got - share * share).abs() < 1e-12, "{theta}: {got}");
        }
        assert_eq!(SpotFalloff::CosineSquared.at(f64::NAN, inner, outer), 0.0);
        assert_eq!(SpotFalloff::Angle.at(f64::NAN, inner, outer), 0.0);
    }
}
