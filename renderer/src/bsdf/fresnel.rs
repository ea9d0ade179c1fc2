//! Fresnel reflectance of dielectrics and conductors, in forms that keep their digits.

use glam::Vec3;

use crate::color::Rgb;

/// What happens at a smooth boundary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DielectricFresnel {
    /// Reflected fraction of unpolarised light.
    pub reflectance: f32,
    /// Cosine of the transmitted direction, on the other side: its sign is opposite to that of the incident one; 0
    /// under total internal reflection.
    pub cos_t: f32,
    /// Index on the far side over that on the near side.
    pub eta: f32,
}

/// Fresnel's equations for a boundary with index `eta` below over above; `cos_i` is positive above.
///
/// The differences in the two amplitudes are formed from η² − 1, which is where they vanish: computed as
/// (a − b)/(a + b) of rounded terms, the reflectance of nearly equal indices would be off by tens of per cent.
pub fn dielectric(cos_i: f32, eta: f32) -> DielectricFresnel {
    let eta = if cos_i < 0.0 { 1.0 / f64::from(eta) } else { f64::from(eta) };
    let cos = f64::from(cos_i.abs()).min(1.0);
    let contrast = (eta - 1.0) * (eta + 1.0);
    // η² cos²_t = η² − sin² = cos² + (η² − 1)
    let q2 = cos * cos + contrast;
    let side = -1.0f32.copysign(cos_i);
    if q2 <= 0.0 {
        let reflectance = if contrast == 0.0 { 0.0 } else { 1.0 };
        return DielectricFresnel { reflectance, cos_t: 0.0, eta: eta as f32 };
    }
    let q = q2.sqrt();
    // r_s = (cos − q)/(cos + q) and cos² − q² = −contrast.
    let s = contrast / ((cos + q) * (cos + q));
    // r_p = (η² cos − q)/(η² cos + q) and η⁴ cos² − q² = contrast (cos² (η² + 1) − 1).
    let d = eta * eta * cos + q;
    let p = contrast * (cos * cos * (eta * eta + 1.0) - 1.0) / (d * d);
    let reflectance = (0.5 * (s * s + p * p)).min(1.0) as f32;
    DielectricFresnel { reflectance, cos_t: side * (q / eta).min(1.0) as f32, eta: eta as f32 }
}

/// Reflectance of a conductor of index η + ik, for each channel; `cos` is not negative.
pub fn conductor(cos: f32, eta: Rgb, k: Rgb) -> Rgb {
    Vec3::new(
        conductor_channel(cos, eta.x, k.x),
        conductor_channel(cos, eta.y, k.y),
        conductor_channel(cos, eta.z, k.z),
    )
}

/// In `f64`: the squares of indices as large as 1e10 stay in range, and no pair of them makes 0/0.
fn conductor_channel(cos: f32, eta: f32, k: f32) -> f32 {
    let (c, n, k) = (f64::from(cos).clamp(0.0, 1.0), f64::from(eta), f64::from(k));
    if n == 1.0 && k == 0.0 {
        return 0.0;
    }
    let (c2, s2) = (c * c, (1.0 - c) * (1.0 + c));
    let t0 = (n - k) * (n + k) - s2;
    let a2b2 = t0.hypot(2.0 * n * k);
    let a = (0.5 * (a2b2 + t0)).max(0.0).sqrt();
    let t1 = a2b2 + c2;
    let t2 = 2.0 * a * c;
    let s = (t1 - t2) / (t1 + t2);
    let t3 = c2 * a2b2 + s2 * s2;
    let t4 = t2 * s2;
    let p = s * (t3 - t4) / (t3 + t4);
    let reflectance = 0.5 * (s + p);
    if reflectance.is_finite() { reflectance.clamp(0.0, 1.0) as f32 } else { 1.0 }
}

/// ∫ F(cos) 2 cos dcos: what a boundary reflects of diffuse light that comes from above.
pub fn diffuse_reflectance(eta: f32) -> f32 {
    const STEPS: u32 = 4096;
    let sum: f64 = (0..STEPS)
        .map(|i| {
            let cos = (f64::from(i) + 0.5) / f64::from(STEPS);
            2.0 * cos * f64::from(dielectric(cos as f32, eta).reflectance)
        })
        .sum();
    (sum / f64::from(STEPS)) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dielectric_reflectance_keeps_its_digits_where_indices_nearly_match() {
        // 50-digit values for these f32 inputs.
        for (cos, eta, truth) in [
            (1.0f32, 1.0f32 + 1.0 / (1 << 23) as f32, 3.55271e-15),
            (1e-3, 1.0 + 1.0 / (1 << 23) as f32, 2.85240e-3),
            (0.01, 1.000001, 2.23063e-5),
        ] {
            let r = f64::from(dielectric(cos, eta).reflectance);
            assert!((r / truth - 1.0).abs() < 1e-3, "{cos} {eta}: {r:e}, truth {truth:e}");
        }
        for cos in [0.0, 1e-3, 0.5, 1.0] {
            assert_eq!(dielectric(cos, 1.0).reflectance, 0.0, "no boundary, cos {cos}");
        }
        assert!((dielectric(1.0, 1.5).reflectance - 0.04).abs() < 1e-7);
    }

    #[test]
    fn total_internal_reflection_begins_at_the_critical_angle() {
        let critical = 0.745_356f32; // sqrt(1 − 1/1.5²)
        assert_eq!(dielectric(-critical * 0.999, 1.5).reflectance, 1.0);
        let below = dielectric(-critical * 1.001, 1.5);
        assert!(below.reflectance < 1.0 && below.cos_t > 0.0, "{below:?}");
    }

    #[test]
    fn transmitted_direction_obeys_snell() {
        for cos in [1.0f32, 0.7, 0.1, -0.9] {
            let f = dielectric(cos, 1.5);
            let sin = |c: f32| (1.0 - c * c).sqrt();
            assert!((sin(cos) - f.eta * sin(f.cos_t)).abs() < 1e-5 && f.cos_t * cos < 0.0, "{cos}: {f:?}");
        }
    }

    #[test]
    fn conductor_reflectance_is_right_for_degenerate_indices() {
        for (cos, eta, k, truth) in [
            (1.0, 0.0, 0.0, 1.0),
            (1.0, 1.0, 0.0, 0.0),
            (1.0, 1.5, 0.0, 0.04),
            (0.2, 1.5, 0.0, 0.338894),
            (1.0, 1e10, 1e10, 1.0),
            (0.5, 1e-3, 1e10, 1.0),
            (0.0, 1.5, 2.0, 1.0),
        ] {
            let f = conductor_channel(cos, eta, k);
            assert!((f - truth).abs() < 1e-4, "cos {cos}, {eta} + {k}i: {f}, truth {truth}");
        }
    }
}
