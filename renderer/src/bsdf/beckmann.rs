//! Beckmann's distribution at width 1: masking, and sampling of its visible normals.

use glam::{Vec2, Vec3};

const INV_SQRT_PI: f32 = 0.564_189_6;

/// Masking G1 as Walter et al. 2007 fit it, for a direction of cosine `cos` whose stretched sine is `slope`.
#[inline]
pub fn g1(cos: f32, slope: f32) -> f32 {
    let a = cos / slope; // 1 / (alpha tan θ); infinite from straight above
    if a < 1.6 { a * (3.535 + 2.181 * a) / (1.0 + a * (2.276 + 2.577 * a)) } else { 1.0 }
}

/// Smith's G1 / cos θ, exactly: 1 over the projected area of the visible facets (Walter et al. 2007),
///
/// ```text
/// cos (1 + erf a) / 2 + slope exp(−a²) / (2 √π),   a = cos / slope
/// ```
#[inline]
pub fn visible_share(cos: f32, slope: f32) -> f32 {
    2.0 / visible_area(cos, slope, cos / slope).1
}

/// 1 + erf(cot), and cos (1 + erf(cot)) + sin exp(−cot²) / √π.
#[inline]
fn visible_area(cos: f32, sin: f32, cot: f32) -> (f32, f32) {
    let tail = (-cot * cot).exp();
    let erf1 = 2.0 - erfc_over_exp(cot) * tail;
    (erf1, cos * erf1 + sin * tail * INV_SQRT_PI)
}

/// A visible normal, not normalised; `wo` is unit and above the surface (Heitz and d'Eon 2014; solved in the variable
/// q = 1 + erf(slope), as in Mitsuba).
pub fn visible_normal(wo: Vec3, u: Vec2) -> Vec3 {
    let (cos, sin) = (wo.z, Vec2::new(wo.x, wo.y).length());
    let along = visible_slope(cos, sin, u.x);
    let across = slope_from_erf1(2.0 * u.y);
    // From straight above all directions are alike.
    let (cos_phi, sin_phi) = if sin > 0.0 { (wo.x / sin, wo.y / sin) } else { (1.0, 0.0) };
    Vec3::new(-(cos_phi * along - sin_phi * across), -(sin_phi * along + cos_phi * across), 1.0)
}

/// Slope along the view, away from the viewer, with a density in proportion to (cos − x sin) exp(−x²) where that is
/// positive. In q its distribution function is
///
/// ```text
/// C(q) = cos q + sin exp(−x²) / √π,   x = erf⁻¹(q − 1),   dC/dq = cos − x sin
/// ```
///
/// which is concave: Newton's steps from the left never pass the root. The start is the solution at grazing incidence,
/// which lies on the left and is exact in the hard case; where the cosine rules C is nearly linear. (Steps in x save the
/// inverse error function, but do not always converge.)
fn visible_slope(cos: f32, sin: f32, u: f32) -> f32 {
    let (q_max, area) = visible_area(cos, sin, cos / sin);
    let u = u.max(SMALLEST_ERF1);
    let target = u * area;
    let grazing = (-u.ln()).sqrt();
    let mut q = q_max * (erfc_over_exp(grazing) * u);
    let mut slope = slope_from_erf1(q);
    // Two to four steps do, since each squares the error; the bound is for what rounding may do.
    for _ in 0..8 {
        let derivative = cos - slope * sin;
        if derivative <= 0.0 {
            break; // the end of the range, within rounding
        }
        let step = (target - cos * q - sin * INV_SQRT_PI * (-slope * slope).exp()) / derivative;
        q = (q + step).min(q_max);
        slope = slope_from_erf1(q);
        if step.abs() <= 1e-4 * q {
            break;
        }
    }
    slope
}

/// exp(x²) erfc(x) for x ≥ 0, to 1.5e-7 of erfc (Abramowitz and Stegun 7.1.26).
#[inline]
fn erfc_over_exp(x: f32) -> f32 {
    let t = 1.0 / (1.0 + 0.327_591_1 * x);
    let tail = -1.453_152_1 + t * 1.061_405_4;
    t * (0.254_829_6 + t * (-0.284_496_72 + t * (1.421_413_8 + t * tail)))
}

/// Keeps slopes at ±4.2, beyond which there is 2e-8 of the distribution.
const SMALLEST_ERF1: f32 = 3e-8;

/// The x with 1 + erf(x) = q, to 1e-6 (Giles 2010). Taking q in place of erf keeps its digits in the left tail.
#[inline]
fn slope_from_erf1(q: f32) -> f32 {
    let q = q.clamp(SMALLEST_ERF1, 2.0 - f32::EPSILON);
    let w = -(q * (2.0 - q)).ln();
    #[rustfmt::skip]
    const CENTER: [f32; 9] = [
        2.810_226_4e-8, 3.432_739_4e-7, -3.523_387_7e-6, -4.391_506_5e-6, 2.185_808_7e-4, -1.253_725e-3,
        -4.177_681_6e-3, 0.246_640_73, 1.501_409_4,
    ];
    #[rustfmt::skip]
    const TAIL: [f32; 9] = [
        -2.002_142_6e-4, 1.009_505_6e-4, 1.349_343_2e-3, -3.673_428_4e-3, 5.739_507_7e-3, -7.622_461_3e-3,
        9.438_870_5e-3, 1.001_674, 2.832_976_8,
    ];
    // Even and odd terms apart: a chain of dependent operations half as long.
    let fit = |t: &[f32; 9], w: f32| {
        let v = w * w;
        let even = (((t[0] * v + t[2]) * v + t[4]) * v + t[6]) * v + t[8];
        let odd = ((t[1] * v + t[3]) * v + t[5]) * v + t[7];
        even + odd * w
    };
    (q - 1.0) * if w < 5.0 { fit(&CENTER, w - 2.5) } else { fit(&TAIL, w.sqrt() - 3.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// erf by its series, in f64; good to 1e-7 up to 4.5.
    fn erf(x: f64) -> f64 {
        let mut term = x;
        let mut sum = 0.0;
        for n in 0..200 {
            sum += term / f64::from(2 * n + 1);
            term *= -x * x / f64::from(n + 1);
        }
        sum * 2.0 / std::f64::consts::PI.sqrt()
    }

    #[test]
    fn error_function_and_its_inverse_are_precise() {
        for i in 0..=35 {
            let x = i as f32 / 10.0;
            let erfc = f64::from(erfc_over_exp(x)) * f64::from(-x * x).exp();
            assert!((erfc - (1.0 - erf(x.into()))).abs() < 3e-7, "erfc({x}) = {erfc}");
            for x in [x, -x] {
                let q = (1.0 + erf(x.into())) as f32;
                let back = slope_from_erf1(q);
                // On the right, one step of q is worth more and more.
                let step = f32::EPSILON * (x.max(0.0) * x).exp();
                assert!((back - x).abs() < 3e-6 + step, "{x} came back as {back}");
            }
        }
    }

    #[test]
    fn masking_fit_is_within_its_bound() {
        for i in 1..400 {
            let (cos, slope) = (i as f32 / 100.0, 1.0);
            let exact = visible_share(cos, slope) * cos;
            assert!((g1(cos, slope) / exact - 1.0).abs() < 0.0036, "a = {cos}: {} {exact}", g1(cos, slope));
        }
    }

    #[test]
    fn slope_solves_the_distribution_function() {
        for cos in [1.0, 0.999, 0.7, 0.3, 0.05, 1e-3, 1e-6f64] {
            let sin = (1.0 - cos * cos).sqrt();
            let function = |x: f64| cos * (1.0 + erf(x)) + sin * (-x * x).exp() * f64::from(INV_SQRT_PI);
            let total = function((cos / sin).min(4.5));
            for i in 1..200 {
                let u = f64::from(i) / 200.0;
                let x = visible_slope(cos as f32, sin as f32, u as f32);
                let reached = function(x.into()) / total;
                assert!((reached - u).abs() < 2e-6, "cos {cos}, u {u}: slope {x} has {reached}");
            }
        }
    }
}
