use super::*;

/// Turbidity, elevation and albedo; radiance of the sun, and that of the sky at some elevations and azimuths from the sun.
type Row = (f64, f64, Rgb, Rgb, [([f64; 2], Rgb); 7]);

/// What `eval` of Mitsuba 3.9.1's `sunsky` gives (`scalar_rgb`, one of `sun_scale` and `sky_scale` 0).
#[rustfmt::skip]
const MITSUBA: [Row; 6] = [
    (1.0, 90.0, [0.3, 0.3, 0.3], [22733.3, 19302.8, 15250.1], [
        ([0.01, 180.0], [0.13069, 0.17373, 0.18174]),
        ([0.5, 90.0], [0.1386, 0.20536, 0.22358]),
        ([90.0, 0.0], [0.034204, 0.078579, 0.1168]),
        ([5.0, 180.0], [0.12941, 0.20536, 0.27984]),
        ([30.0, 90.0], [0.041623, 0.082577, 0.15319]),
        ([89.9, 0.0], [0.034121, 0.078362, 0.11677]),
        ([87.0, 2.0], [0.03192, 0.072716, 0.11604])]),
    (3.0, 45.0, [0.3, 0.3, 0.3], [21369.2, 17551.5, 12928.0], [
        ([0.01, 180.0], [0.16579, 0.19863, 0.18675]),
        ([0.5, 90.0], [0.1323, 0.16398, 0.1702]),
        ([45.0, 0.0], [0.18319, 0.20748, 0.23258]),
        ([5.0, 180.0], [0.13807, 0.20178, 0.26764]),
        ([30.0, 90.0], [0.040119, 0.072196, 0.13374]),
        ([89.9, 0.0], [0.023794, 0.041567, 0.084153]),
        ([42.0, 2.0], [0.18651, 0.21136, 0.24203])]),
    (2.5, 4.0, [0.8, 0.5, 0.2], [8400.67, 3505.21, 389.226], [
        ([0.01, 180.0], [0.095604, 0.063117, 0.018539]),
        ([0.5, 90.0], [0.057166, 0.039773, 0.012653]),
        ([4.0, 0.0], [0.39292, 0.2287, 0.068655]),
        ([5.0, 180.0], [0.094039, 0.08477, 0.046535]),
        ([30.0, 90.0], [0.020805, 0.028091, 0.032025]),
        ([89.9, 0.0], [0.0067922, 0.011242, 0.015469]),
        ([1.0, 2.0], [0.43538, 0.22864, 0.05484])]),
    (7.3, 20.0, [0.1, 0.4, 0.9], [13135.1, 9326.35, 5410.19], [
        ([0.01, 180.0], [0.076252, 0.087355, 0.094043]),
        ([0.5, 90.0], [0.069802, 0.079214, 0.086342]),
        ([20.0, 0.0], [1.1524, 1.0009, 0.63715]),
        ([5.0, 180.0], [0.093014, 0.12426, 0.16024]),
        ([30.0, 90.0], [0.041371, 0.062666, 0.098044]),
        ([89.9, 0.0], [0.022863, 0.03484, 0.060015]),
        ([17.0, 2.0], [1.2415, 1.0449, 0.6856])]),
    (10.0, 1.0, [0.0, 0.0, 0.0], [0.0903236, 0.00722592, -0.00142767], [
        ([0.01, 180.0], [0.0027075, 0.0020781, 0.0006398]),
        ([0.5, 90.0], [0.00020234, 0.00052994, 0.00057101]),
        ([1.0, 0.0], [0.030367, 0.01271, 0.005062]),
        ([5.0, 180.0], [0.0098831, 0.0085674, 0.0059056]),
        ([30.0, 90.0], [0.012083, 0.011776, 0.010473]),
        ([89.9, 0.0], [0.0046268, 0.0060073, 0.0071367]),
        ([0.1, 2.0], [0.027905, 0.010526, 0.0033547])]),
    (3.0, 0.01, [1.0, 1.0, 1.0], [3818.7, 1031.54, -58.1376], [
        ([0.01, 180.0], [0.017222, 0.0049152, 0.0021396]),
        ([0.5, 90.0], [0.016491, 0.0082575, 0.004223]),
        ([0.01, 0.0], [0.12574, 0.043626, 0.011685]),
        ([5.0, 180.0], [0.032779, 0.021943, 0.010201]),
        ([30.0, 90.0], [0.012358, 0.013151, 0.011777]),
        ([89.9, 0.0], [0.0034769, 0.0050505, 0.0058077]),
        ([0.1, 2.0], [0.12692, 0.045195, 0.012373])]),
];

fn direction([elevation, azimuth]: [f64; 2]) -> DVec3 {
    let (sin, cos) = elevation.to_radians().sin_cos();
    let (sin_phi, cos_phi) = azimuth.to_radians().sin_cos();
    DVec3::new(cos * cos_phi, sin, cos * sin_phi)
}

fn day(turbidity: f64, elevation: f64, albedo: Rgb) -> Daylight {
    Daylight { sun: direction([elevation, 0.0]), turbidity, albedo, world_from_light: DMat4::IDENTITY }
}

#[test]
fn sky_and_sun_are_those_of_mitsuba() {
    for (turbidity, elevation, albedo, sun, seen) in MITSUBA {
        let day = day(turbidity, elevation, albedo);
        // In Mitsuba 1 − cos of so small an angle is a multiple of 2⁻²⁴, which makes the disk smaller and brighter.
        let cosine = ((0.5 * APERTURE_DEG) as f32).to_radians().cos();
        let half_deg = 2.0 * (0.5 * f64::from(1.0 - cosine)).sqrt().asin().to_degrees();
        let ours = day.sun(half_deg);
        // the table has five digits
        let is_near = |(a, b): (&f32, f32)| (a - b).abs() < 1e-4 * b.abs();
        assert!(ours.iter().zip(sun).all(is_near), "{day:?}: {ours:?} {sun:?}");
        let sky = day.sky();
        for (at, theirs) in seen {
            let ours = sky.arriving_from(direction(at));
            for (a, b) in ours.iter().zip(theirs) {
                assert!(
                    (a - b).abs() < 2e-4 * b.abs(),
                    "{turbidity} {elevation} {at:?}: {ours:?} {theirs:?}"
                );
            }
        }
    }
}

#[test]
fn a_sun_of_any_size_sends_the_same() {
    let day = day(3.0, 30.0, [0.3; 3]);
    let sent = |half_deg: f64| {
        let solid = 2.0 * std::f64::consts::PI * (1.0 - half_deg.to_radians().cos());
        f64::from(day.sun(half_deg)[1]) * solid
    };
    for half_deg in [0.01, 6.0, 90.0] {
        assert!((sent(half_deg) / sent(0.5 * APERTURE_DEG) - 1.0).abs() < 1e-5, "{half_deg}");
    }
}

#[test]
fn skies_are_finite_and_black_below_the_horizon() {
    for elevation in [0.0, 1e-9, 0.3, 45.0, 90.0] {
        for turbidity in [1.0, 9.999, 10.0] {
            for albedo in [0.0, 1.0] {
                let day = day(turbidity, elevation, [albedo; 3]);
                let sky = day.sky();
                for at in [[0.0, 0.0], [1e-7, 180.0], [elevation, 0.0], [40.0, 70.0], [90.0, 0.0]] {
                    let seen = sky.arriving_from(direction(at));
                    assert!(seen.iter().all(|l| l.is_finite()) && seen[0] > 0.0, "{day:?} {at:?}: {seen:?}");
                }
                assert_eq!(sky.arriving_from(direction([-1e-6, 0.0])), [0.0; 3]);
                assert!(day.sun(1e-3).iter().all(|l| l.is_finite()), "{day:?}");
            }
        }
    }
}
