//! The sky of a clear day.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::{DMat3, DVec2, DVec3, Vec3};
use limpid_scenes::{Daylight, Image, SkyRadiance, Texels};

use super::environment::EnvMap;
use crate::color::Rgb;

/// Texels of the picture by which directions are drawn. Its middle row is the horizon.
const SIZE: [u32; 2] = [512, 257];

/// A sky whose radiance is that of the formula in every direction; a picture of it serves to draw directions only.
///
/// (As a picture it would be bright below the horizon, by half a row, and wrong just above, where its brightness changes within
/// a hundredth of cos θ.)
pub struct Sky {
    radiance: SkyRadiance,
    scale: f32,
    light_from_world: DMat3,
    picture: EnvMap,
}

impl Sky {
    pub fn new(daylight: &Daylight, scale: f32) -> Self {
        let radiance = daylight.sky();
        let picture = Arc::new(picture(&radiance));
        let linear = DMat3::from_mat4(daylight.world_from_light);
        let inverse = linear.inverse();
        let light_from_world =
            if linear.is_finite() && inverse.is_finite() { inverse } else { DMat3::IDENTITY };
        let picture = EnvMap::new(picture, scale, daylight.world_from_light);
        Self { radiance, scale, light_from_world, picture }
    }

    /// Luminance over the sphere, and whether there is no light at all.
    pub fn integral(&self) -> (f64, bool) {
        self.picture.integral()
    }

    /// A direction in world space, with the density that [`eval`](Self::eval) gives.
    pub fn sample(&self, u: DVec2) -> Option<DVec3> {
        self.picture.sample(u)
    }

    /// Radiance against the direction `wi`, and the density per steradian of drawing it.
    pub fn eval(&self, wi: Vec3) -> (Rgb, f64) {
        let Some(direction) = (self.light_from_world * wi.as_dvec3()).try_normalize() else {
            return (Rgb::ZERO, 0.0);
        };
        let (_, pdf) = self.picture.eval(wi);
        (Rgb::from(self.radiance.arriving_from(direction)) * self.scale, pdf)
    }
}

/// Lat-long, black below the horizon. Signs are left out: what is not grey must be drawn, too.
fn picture(sky: &SkyRadiance) -> Image {
    let [width, height] = SIZE;
    let half = height / 2;
    let mut texels = Vec::with_capacity((width * height * 3) as usize);
    for row in 0..=half {
        let (sin, cos) = (0.5 * PI * f64::from(row) / f64::from(half)).sin_cos();
        // the cosine is 0 at the horizon
        let cos = if row == half { 0.0 } else { cos };
        for column in 0..width {
            let phi = TAU * (0.5 - (f64::from(column) + 0.5) / f64::from(width));
            let direction = DVec3::new(sin * phi.sin(), cos, sin * phi.cos());
            texels.extend(sky.arriving_from(direction).map(f32::abs));
        }
    }
    texels.resize((width * height * 3) as usize, 0.0);
    Image { width, height, texels: Texels::Linear32(texels) }
}
