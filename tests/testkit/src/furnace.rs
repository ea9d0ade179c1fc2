//! Energy: the mean of a sample's weight.

use glam::{DVec3, Vec2, Vec3};

/// Mean of `weight(u_lobe, u)` over `n` points of an additive recurrence in the unit cube (Roberts 2018), whose error
/// falls nearly as 1/n for smooth integrands. A sampler that gives `f · cos / pdf`, or zero where it draws nothing,
/// has its albedo as mean: 1 for a white surface that loses nothing.
pub fn furnace(n: u32, weight: impl Fn(f32, Vec2) -> Vec3) -> DVec3 {
    // Powers of 1/g, with g the positive root of g⁴ = g + 1.
    const STEP: [f64; 3] = [0.819_172_513_396_164_4, 0.671_043_606_703_789_2, 0.549_700_477_901_970_3];
    let mut sum = DVec3::ZERO;
    for i in 0..n {
        // Truncated to 24 bits: rounding could give 1.
        let u = STEP.map(|s| {
            ((0.5 + f64::from(i) * s).fract() * f64::from(1 << 24)).floor() as f32 / (1 << 24) as f32
        });
        sum += weight(u[0], Vec2::new(u[1], u[2])).as_dvec3();
    }
    sum / f64::from(n)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn furnace_gives_the_mean_to_four_digits() {
        let mean = furnace(1 << 16, |lobe, u| Vec3::new(lobe, u.x * u.x, (u.y * 3.0).sin()));
        let truth = DVec3::new(0.5, 1.0 / 3.0, (1.0 - 3f64.cos()) / 3.0);
        assert!((mean - truth).abs().max_element() < 1e-4, "{mean}, truth {truth}");
    }
}
