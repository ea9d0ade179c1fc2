//! Daylight: where the sky is bright by Preetham, Shirley and Smits 1999, "A Practical Analytic Model for Daylight"; how
//! bright sky and sun are as a whole by a table.
//!
//! Mitsuba 3.9 has the model of Hošek and Wilkie 2012, whose data are large. Preetham's own sky is 1.3 to 2.5 times as
//! bright (compare Zotti et al. 2007), so that each channel is scaled to the irradiance of a level ground in Mitsuba 3.9.1
//! (`table`): between the knots of the table the two differ by less than 2 %, as a test here shows. What remains different
//! is where the light comes from. Radiance over that of Mitsuba 3.9.1 at turbidity 3, red and blue:
//!
//! ```text
//!  sun     zenith       10° above the sun   5° opposite    30° at its side
//!   15°    1.79 1.43    0.84 1.01           0.41 0.30      0.96 0.90
//!   45°    1.51 1.45    1.10 1.44           0.43 0.29      0.89 0.84
//!   75°    1.14 1.46    1.05 1.43           0.47 0.31      0.91 0.83
//! ```
//!
//! All in the space of a sky with +y up and in W·sr⁻¹·m⁻²·nm⁻¹ weighted by the observer, the unit of Mitsuba 3.

mod position;
mod table;

use std::f64::consts::PI;
use std::sync::Arc;

use glam::DVec3;

pub(crate) use position::{Moment, sun_position};

use crate::spectrum::rgb_from_xyz;
use crate::{Image, Rgb, Texels};

/// Angle under which the sun is seen, in degrees, as Mitsuba 3 has it.
pub(crate) const APERTURE_DEG: f64 = 0.5358;

/// Texels of the sky. The middle row is the horizon.
const SIZE: [u32; 2] = [512, 257];

/// Turbidities within which the model's zenith is positive and rises with the sun.
const TURBIDITY: [f64; 2] = [2.0, 10.0];

/// Whether the sun is up.
pub(crate) fn is_up(sun: DVec3) -> bool {
    sun.y > 0.0
}

/// Irradiance by the sun across its direction `sun`, unit and not below the horizon.
pub(crate) fn sun_irradiance(sun: DVec3, turbidity: f64) -> [f64; 3] {
    table::irradiance(turbidity, elevation_deg(sun))[1]
}

/// The sky around the sun, as a lat-long picture for [`LightKind::EnvMap`](crate::LightKind::EnvMap): black below the
/// horizon.
pub(crate) fn sky(sun: DVec3, turbidity: f64) -> Arc<Image> {
    let sky = Sky::new(sun, turbidity);
    let [width, height] = SIZE;
    let half = height / 2;
    let mut texels = Vec::with_capacity((width * height * 3) as usize);
    let mut irradiance = [0.0; 3];
    for row in 0..=half {
        // the angle from the zenith; its cosine is 0 at the horizon
        let (sin, cos) = (0.5 * PI * f64::from(row) / f64::from(half)).sin_cos();
        let cos = if row == half { 0.0 } else { cos };
        for column in 0..width {
            let phi = 2.0 * PI * (0.5 - (f64::from(column) + 0.5) / f64::from(width));
            let radiance = sky.radiance(DVec3::new(sin * phi.sin(), cos, sin * phi.cos()));
            texels.extend(radiance);
            irradiance.iter_mut().zip(radiance).for_each(|(sum, l)| *sum += f64::from(l) * sin * cos);
        }
    }
    let solid = 0.5 * PI / f64::from(half) * 2.0 * PI / f64::from(width);
    let truth = table::irradiance(turbidity, elevation_deg(sun))[0];
    let scale: [f32; 3] = std::array::from_fn(|c| {
        if irradiance[c] > 0.0 { (truth[c] / (irradiance[c] * solid)) as f32 } else { 0.0 }
    });
    texels.iter_mut().enumerate().for_each(|(i, texel)| *texel *= scale[i % 3]);
    texels.resize((width * height * 3) as usize, 0.0);
    Arc::new(Image { width, height, texels: Texels::Linear32(texels) })
}

fn elevation_deg(sun: DVec3) -> f64 {
    sun.y.clamp(-1.0, 1.0).asin().to_degrees()
}

/// The five coefficients of Perez et al. 1993.
type Perez = [f64; 5];

/// Luminance in kcd·m⁻² and the chromaticities x and y, each with its value at the zenith and its distribution.
struct Sky {
    sun: DVec3,
    channels: [(f64, Perez); 3],
}

impl Sky {
    fn new(sun: DVec3, turbidity: f64) -> Self {
        let t = turbidity.clamp(TURBIDITY[0], TURBIDITY[1]);
        let theta = sun.y.clamp(0.0, 1.0).acos();
        // Appendix A.2: the zenith.
        let chi = (4.0 / 9.0 - t / 120.0) * (PI - 2.0 * theta);
        let luminance = (4.0453 * t - 4.9710) * chi.tan() - 0.2155 * t + 2.4192;
        let cubic = |rows: [[f64; 4]; 3]| {
            let of = |[a, b, c, d]: [f64; 4]| ((a * theta + b) * theta + c) * theta + d;
            (of(rows[0]) * t + of(rows[1])) * t + of(rows[2])
        };
        let x = cubic([
            [0.00166, -0.00375, 0.00209, 0.0],
            [-0.02903, 0.06377, -0.03202, 0.00394],
            [0.11693, -0.21196, 0.06052, 0.25886],
        ]);
        let y = cubic([
            [0.00275, -0.00610, 0.00317, 0.0],
            [-0.04214, 0.08970, -0.04153, 0.00516],
            [0.15346, -0.26756, 0.06670, 0.26688],
        ]);
        let line = |a: f64, b: f64| a * t + b;
        let perez = |c: [[f64; 2]; 5]| c.map(|[a, b]| line(a, b));
        let channels = [
            (
                luminance.max(0.0),
                perez([
                    [0.1787, -1.4630],
                    [-0.3554, 0.4275],
                    [-0.0227, 5.3251],
                    [0.1206, -2.5771],
                    [-0.0670, 0.3703],
                ]),
            ),
            (
                x,
                perez([
                    [-0.0193, -0.2592],
                    [-0.0665, 0.0008],
                    [-0.0004, 0.2125],
                    [-0.0641, -0.8989],
                    [-0.0033, 0.0452],
                ]),
            ),
            (
                y,
                perez([
                    [-0.0167, -0.2608],
                    [-0.0950, 0.0092],
                    [-0.0079, 0.2102],
                    [-0.0441, -1.6537],
                    [-0.0109, 0.0529],
                ]),
            ),
        ];
        Self { sun, channels }
    }

    /// From a direction that is not below the horizon, in kcd·m⁻² of luminance.
    fn radiance(&self, direction: DVec3) -> Rgb {
        let gamma = self.sun.dot(direction).clamp(-1.0, 1.0).acos();
        let theta_sun = self.sun.y.clamp(0.0, 1.0).acos();
        let [luminance, x, y] = self.channels.map(|(zenith, c)| {
            zenith * distribution(&c, direction.y, gamma) / distribution(&c, 1.0, theta_sun)
        });
        let xyz = [x / y, 1.0, (1.0 - x - y) / y].map(|v| v * luminance.max(0.0));
        rgb_from_xyz(xyz).map(|channel| if channel.is_finite() { channel.max(0.0) } else { 0.0 })
    }
}

/// Equation 3: of the cosine to the zenith and the angle to the sun.
fn distribution(&[a, b, c, d, e]: &Perez, cos_theta: f64, gamma: f64) -> f64 {
    let horizon = if cos_theta > 0.0 { (b / cos_theta).exp() } else { 0.0 };
    (1.0 + a * horizon) * (1.0 + c * (d * gamma).exp() + e * gamma.cos().powi(2))
}

#[cfg(test)]
mod tests;
