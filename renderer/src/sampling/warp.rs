//! Warps from the unit square: how every random choice is written: draw, density, test.

use std::f32::consts::{FRAC_1_PI, FRAC_PI_2, FRAC_PI_4};

use glam::{Vec2, Vec3};

/// Point in the unit disk, uniform in area, by the concentric map (Shirley and Chiu 1997), as its signed radius and a unit
/// direction. `u` is uniform in `[0, 1)²`.
fn concentric_disk(u: Vec2) -> (f32, Vec2) {
    let p = 2.0 * u - Vec2::ONE;
    if p == Vec2::ZERO {
        return (0.0, Vec2::X);
    }
    let (r, theta) = if p.x.abs() > p.y.abs() {
        (p.x, FRAC_PI_4 * (p.y / p.x))
    } else {
        (p.y, FRAC_PI_2 - FRAC_PI_4 * (p.x / p.y))
    };
    let (sin, cos) = theta.sin_cos();
    (r, Vec2::new(cos, sin))
}

/// Point in the unit disk, uniform in area: density 1 / π. `u` is uniform in `[0, 1)²`.
pub fn uniform_disk(u: Vec2) -> Vec2 {
    let (r, direction) = concentric_disk(u);
    r * direction
}

/// Direction in the hemisphere around +z with density `cos θ / π`.
pub fn cosine_hemisphere(u: Vec2) -> Vec3 {
    let (r, direction) = concentric_disk(u);
    // 1 − r² by factors: the square of a rounded point would send directions near the horizon below it.
    (r * direction).extend(((1.0 - r) * (1.0 + r)).sqrt())
}

/// Density of [`cosine_hemisphere`] per steradian.
pub fn cosine_hemisphere_pdf(w: Vec3) -> f32 {
    w.z.max(0.0) * FRAC_1_PI
}

#[cfg(test)]
mod tests {
    use limpid_testkit::{assert_chi2, assert_chi2_2d};

    use super::*;

    /// Where a warp is most likely to go wrong: the edges of the square, its middle and the diagonals.
    fn extremes() -> impl Iterator<Item = Vec2> {
        let edges =
            [0.0, 1.0 / (1 << 24) as f32, 0.25, 0.5, 0.75, 1.0 - 1.0 / (1 << 23) as f32, 1.0f32.next_down()];
        edges.into_iter().flat_map(move |x| edges.into_iter().map(move |y| Vec2::new(x, y)))
    }

    #[test]
    fn disk_points_are_uniform() {
        let inside = |p: Vec2| if p.length_squared() <= 1.0 { std::f64::consts::FRAC_1_PI } else { 0.0 };
        // rounding can put a point of the rim 1e-7 outside
        let draw = |u| Some((1.0 - 1e-6) * uniform_disk(u));
        assert_chi2_2d(draw, inside, Vec2::NEG_ONE, Vec2::ONE);
    }

    #[test]
    fn cosine_directions_follow_their_density() {
        assert_chi2(|_, u| Some(cosine_hemisphere(u)), cosine_hemisphere_pdf);
    }

    #[test]
    fn cosine_directions_are_unit_and_not_below_the_horizon_at_the_extremes() {
        for u in extremes() {
            let w = cosine_hemisphere(u);
            assert!((w.length() - 1.0).abs() < 1e-6 && w.z >= 0.0, "{u}: {w}");
            // Only the edge u = 0 itself is on the horizon.
            assert!(w.z > 0.0 || u.min_element() == 0.0, "{u}: {w}");
        }
    }
}
