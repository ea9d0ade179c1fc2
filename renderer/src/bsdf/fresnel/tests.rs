use super::*;

#[test]
fn dielectric_has_the_digits_of_the_exact_value() {
    // Values for the f32 inputs, computed with 50 digits.
    let step = 1.0 + f32::EPSILON;
    for (cos, eta, truth) in [
        (1.0, step, 3.55271e-15),
        (1e-3, step, 2.85240e-3),
        (0.01, 1.0 + 1e-6, 2.23063e-5),
        (1.0, 1.5, 0.04),
        (1.0, 1.0 / 1.5, 0.04),
    ] {
        let f = dielectric(cos, eta).reflectance;
        assert!((f / truth - 1.0).abs() < 1e-3, "cos {cos} eta {eta}: {f} {truth}");
    }
    for cos in [0.0, 1e-30, 0.5, 1.0] {
        assert_eq!(dielectric(cos, 1.0).reflectance, 0.0);
    }
}

/// The textbook's form in f64.
fn dielectric_f64(cos: f64, eta: f64) -> f64 {
    let cos_t2 = 1.0 - (1.0 - cos * cos) / (eta * eta);
    if cos_t2 <= 0.0 {
        return 1.0;
    }
    let cos_t = cos_t2.sqrt();
    let r_s = (cos - eta * cos_t) / (cos + eta * cos_t);
    let r_p = (eta * cos - cos_t) / (eta * cos + cos_t);
    0.5 * (r_s * r_s + r_p * r_p)
}

#[test]
fn dielectric_agrees_with_the_textbook_to_the_critical_angle() {
    for eta in [1.0 / 1.5, 0.1, 0.9, 1.33, 2.4, 40.0f32] {
        for i in 0..=1000 {
            let cos = i as f32 / 1000.0;
            let (f, truth) = (dielectric(cos, eta).reflectance, dielectric_f64(cos.into(), eta.into()));
            assert!((f64::from(f) - truth).abs() < 1e-6 + 1e-5 * truth, "cos {cos} eta {eta}: {f} {truth}");
        }
    }
    let mut cos = 0.745_356_f32;
    for _ in 0..20 {
        cos = cos.next_up();
        let (f, truth) =
            (dielectric(cos, 1.0 / 1.5).reflectance, dielectric_f64(cos.into(), (1.0f32 / 1.5).into()));
        assert!((f64::from(f) / truth - 1.0).abs() < 1e-3, "cos {cos}: {f} {truth}");
    }
}

#[test]
fn refracted_direction_obeys_snell() {
    for (cos, eta) in [(0.3f32, 1.5f32), (0.9, 1.0 / 1.5), (1.0, 1.5), (0.0, 1.1)] {
        let (sin, sin_t) = ((1.0 - cos * cos).sqrt(), (1.0 - dielectric(cos, eta).cos_t.powi(2)).sqrt());
        assert!((sin - eta * sin_t).abs() < 1e-6, "cos {cos} eta {eta}");
    }
}

#[test]
fn conductor_stands_any_index() {
    for (n, k, cos, truth) in [
        (0.0, 0.0, 1.0, 1.0),
        (0.0, 0.0, 0.5, 1.0),
        (1.0, 0.0, 1.0, 0.0),
        (1.0, 0.0, 0.2, 0.0),
        (1.5, 0.0, 1.0, 0.04),
        (1.5, 0.0, 0.2, 0.338_894),
        (1e10, 1e10, 0.5, 1.0),
        (1e-3, 1e10, 0.5, 1.0),
        (1e38, 1e38, 1.0, 1.0),
    ] {
        let f = conductor(cos, Rgb::splat(n), Rgb::splat(k)).x;
        assert!((f - truth).abs() < 1e-4, "{n} {k} cos {cos}: {f} {truth}");
    }
    for n in [0.0, 1e-38, 1e-20, 1e-8, 1e-3, 1.0, 1.5, 1e4, 1e10, f32::MAX] {
        for k in [0.0, 1e-38, 1e-20, 1e-8, 1e-3, 1.0, 1e4, 1e10, f32::MAX] {
            for cos in [0.0, 1e-30, 1e-4, 0.2, 0.5, 1.0] {
                let f = conductor(cos, Rgb::splat(n), Rgb::splat(k)).x;
                assert!((0.0..=1.0 + 1e-6).contains(&f), "{n} {k} cos {cos}: {f}");
                assert!(cos > 0.0 || (f - 1.0).abs() < 1e-6, "grazing {n} {k}: {f}");
            }
        }
    }
}

/// Complex arithmetic in f64, written out.
fn conductor_f64(cos: f64, n: f64, k: f64) -> f64 {
    let sin2 = 1.0 - cos * cos;
    let (re, im) = (n * n - k * k - sin2, 2.0 * n * k);
    let modulus = re.hypot(im);
    let (p, q) = (((modulus + re) / 2.0).max(0.0).sqrt(), ((modulus - re) / 2.0).max(0.0).sqrt());
    let r_s = ((cos - p).powi(2) + q * q) / ((cos + p).powi(2) + q * q);
    // r_p = (ε cos − w) / (ε cos + w) with ε = (n + ik)²
    let (er, ei) = (n * n - k * k, 2.0 * n * k);
    let r_p =
        ((er * cos - p).powi(2) + (ei * cos - q).powi(2)) / ((er * cos + p).powi(2) + (ei * cos + q).powi(2));
    0.5 * (r_s + r_p)
}

#[test]
fn conductor_agrees_with_complex_arithmetic() {
    for n in [0.05, 0.2, 1.1, 1.66, 4.0] {
        for k in [0.01, 0.5, 3.9, 9.2] {
            for i in 1..=100 {
                let cos = i as f32 / 100.0;
                let f = conductor(cos, Rgb::splat(n), Rgb::splat(k)).x;
                let truth = conductor_f64(cos.into(), n.into(), k.into());
                assert!((f64::from(f) - truth).abs() < 2e-6, "{n} {k} cos {cos}: {f} {truth}");
            }
        }
    }
}

#[test]
fn diffuse_reflectance_is_the_integral() {
    for eta in [1.0 / 5.0, 1.0 / 3.9, 1.0 / 2.4, 1.0 / 1.5, 1.0 / 1.9, 0.75, 1.33, 1.5, 1.9, 3.9f32] {
        let n = 100_000;
        let integral: f64 = (0..n)
            .map(|i| {
                let cos = (f64::from(i) + 0.5) / f64::from(n);
                2.0 * cos * dielectric_f64(cos, eta.into()) / f64::from(n)
            })
            .sum();
        let fit = f64::from(diffuse_reflectance(eta));
        assert!((fit - integral).abs() < 0.005, "eta {eta}: {fit} {integral}");
    }
}
