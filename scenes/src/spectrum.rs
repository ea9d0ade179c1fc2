//! Spectra as linear Rec. 709 colours, with the numbers of Mitsuba 3's RGB mode.

mod cie;
mod metals;

use crate::Rgb;

/// CIE XYZ to linear Rec. 709 (IEC 61966-2-1 with the digits that Mitsuba uses), row by row.
const RGB_FROM_XYZ: [[f64; 3]; 3] =
    [[3.240479, -1.537150, -0.498535], [-0.969256, 1.875991, 0.041556], [0.055648, -0.204043, 1.057311]];

/// First and last wavelength of the colour-matching table, in nm.
const RANGE: [f64; 2] = [360.0, 830.0];
/// ∫ ȳ dλ over the table, in nm.
const Y_INTEGRAL: f64 = 106.750_259_399_414_06;
/// Points of the quadrature: as many as Mitsuba takes, so that its numbers come out.
const STEPS: usize = 1000;

/// What a spectrum is a property of, which decides how it becomes a colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Quantity {
    /// A fraction of the light: seen under D65, kept in \[0, 1\].
    Reflectance,
    /// A ratio such as an index of refraction: seen under D65, not negative.
    Ratio,
    /// Light itself: W·sr⁻¹·m⁻² per channel, not negative.
    Radiance,
}

/// Linear grey to a colour: a constant reflectance stays grey, constant radiance has the colour of illuminant E.
pub(crate) fn constant(value: f64, quantity: Quantity) -> Rgb {
    match quantity {
        Quantity::Reflectance | Quantity::Ratio => [value as f32; 3],
        Quantity::Radiance => rgb_from_xyz([value; 3]),
    }
}

/// A spectrum that is linear between `(nm, value)` points and zero outside them, as a colour:
///
/// ```text
/// XYZ = Σ s(λ) · x̄ȳz̄(λ) [· D65(λ)] · Δλ / ∫ ȳ dλ
/// ```
///
/// The points must be in order of their wavelength.
pub(crate) fn integrate(points: &[[f64; 2]], quantity: Quantity) -> Rgb {
    let mut xyz = [0.0; 3];
    let mut next = 0; // the first point at or beyond the wavelength: both run upwards together
    for step in 0..STEPS {
        let wavelength = RANGE[0] + (RANGE[1] - RANGE[0]) * step as f64 / (STEPS - 1) as f64;
        while next < points.len() && points[next][0] < wavelength {
            next += 1;
        }
        let Some(&[after, value_after]) = points.get(next) else { break };
        let value = if after == wavelength {
            value_after
        } else if next == 0 {
            continue;
        } else {
            let [before, value_before] = points[next - 1];
            let t = (wavelength - before) / (after - before);
            value_before * (1.0 - t) + value_after * t
        };
        let [x, y, z, d65] = observer(wavelength);
        let light = if quantity == Quantity::Radiance { 1.0 } else { d65 };
        for (sum, matching) in xyz.iter_mut().zip([x, y, z]) {
            *sum += value * light * matching;
        }
    }
    let step_width = (RANGE[1] - RANGE[0]) / STEPS as f64;
    let rgb = rgb_from_xyz(xyz.map(|sum| sum * step_width / Y_INTEGRAL));
    let ceiling = if quantity == Quantity::Reflectance { 1.0 } else { f32::MAX };
    rgb.map(|channel| channel.clamp(0.0, ceiling))
}

/// Radiance of a black body in W·sr⁻¹·m⁻²·nm⁻¹ (Planck 1901), as a colour. `temperature` in kelvins.
pub(crate) fn blackbody(temperature: f64) -> Rgb {
    const C1: f64 = 1.191_042_972e-16; // 2 h c², W·m²·sr⁻¹
    const C2: f64 = 1.438_776_877e-2; // h c / k, m·K
    let points: Vec<_> = (0..95)
        .map(|i| {
            let nm = RANGE[0] + 5.0 * i as f64;
            let metres = nm * 1e-9;
            let radiance = C1 / metres.powi(5) / (C2 / (metres * temperature)).exp_m1();
            [nm, radiance * 1e-9]
        })
        .collect();
    integrate(&points, Quantity::Radiance)
}

/// The IEC 61966-2-1 decoding of one channel.
pub(crate) fn linear_from_srgb(encoded: f32) -> f32 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// η and k of a metal by its name (`Cu`, `Al`, …), for linear Rec. 709.
pub(crate) fn metal(name: &str) -> Option<[Rgb; 2]> {
    metals::METALS.iter().find(|(known, ..)| *known == name).map(|&(_, eta, k)| [eta, k])
}

/// The names that [`metal`] knows.
pub(crate) fn metal_names() -> impl Iterator<Item = &'static str> {
    metals::METALS.iter().map(|(name, ..)| *name)
}

/// CIE XYZ as linear Rec. 709.
pub(crate) fn rgb_from_xyz(xyz: [f64; 3]) -> Rgb {
    RGB_FROM_XYZ.map(|row| (row[0] * xyz[0] + row[1] * xyz[1] + row[2] * xyz[2]) as f32)
}

/// x̄, ȳ, z̄ and D65 at a wavelength within the table, linear between its rows.
fn observer(wavelength: f64) -> [f64; 4] {
    let table = &cie::XYZ_AND_D65;
    let position = (wavelength - RANGE[0]) / (RANGE[1] - RANGE[0]) * (table.len() - 1) as f64;
    let below = (position as usize).min(table.len() - 2);
    let t = position - below as f64;
    std::array::from_fn(|i| f64::from(table[below][i]) * (1.0 - t) + f64::from(table[below + 1][i]) * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values printed by Mitsuba 3.9.1, variant `scalar_rgb`: the radiance of an area light and the
    /// reflectance of a diffuse surface with these spectra.
    #[test]
    fn spectra_have_the_colours_of_mitsuba() {
        let luminaire = [[400.0, 0.0], [500.0, 8.0], [600.0, 15.6], [700.0, 18.4]];
        let cases: [(&[[f64; 2]], Quantity, Rgb); 6] = [
            (&luminaire, Quantity::Radiance, [20.710836, 10.854634, 2.771152]),
            (&[[400.0, 1.0], [700.0, 1.0]], Quantity::Radiance, [1.1996936, 0.94952035, 0.90344334]),
            (&[[500.0, 1.0], [600.0, 2.0]], Quantity::Radiance, [0.7073104, 1.4274942, 0.0]),
            (&[[400.0, 1.0], [700.0, 1.0]], Quantity::Reflectance, [0.995342, 0.9997564, 0.9949091]),
            (&[[500.0, 1.0], [600.0, 1.0]], Quantity::Reflectance, [0.20980342, 1.0, 0.0]),
            (&[[400.0, 1.0], [700.0, 3.0]], Quantity::Ratio, [2.6036384, 1.9526675, 1.2669932]),
        ];
        for (points, quantity, expected) in cases {
            let got = integrate(points, quantity);
            for (g, e) in got.iter().zip(expected) {
                assert!(
                    (g - e).abs() <= 2e-5 * e.max(1.0),
                    "{points:?} {quantity:?}: {got:?}, Mitsuba {expected:?}"
                );
            }
        }
    }

    #[test]
    fn constant_radiance_has_the_colour_of_illuminant_e() {
        assert_eq!(constant(1.0, Quantity::Reflectance), [1.0; 3]);
        let light = constant(0.5, Quantity::Radiance);
        for (got, mitsuba) in light.iter().zip([0.60239697, 0.4741455, 0.45445803]) {
            assert!((got - mitsuba).abs() < 1e-6, "{light:?}");
        }
    }

    #[test]
    fn black_bodies_have_the_colour_of_plancks_law() {
        // integrated in steps of ½ nm with Mitsuba 3.9.1's observer
        for (kelvins, expected) in
            [(3000.0, [733.113, 349.570, 112.710]), (6500.0, [43918.7, 41407.3, 43582.7])]
        {
            let got = blackbody(kelvins);
            assert!(
                got.iter().zip(expected).all(|(g, e)| (g / e - 1.0).abs() < 1e-3),
                "{kelvins} K: {got:?}"
            );
        }
    }

    /// Copper's measured reflectance is about 0.95, 0.64, 0.54; Fresnel's formula at normal incidence must give it back.
    #[test]
    fn copper_is_reddish() {
        let [eta, k] = metal("Cu").unwrap();
        let reflectance: [f32; 3] = std::array::from_fn(|c| {
            ((eta[c] - 1.0).powi(2) + k[c] * k[c]) / ((eta[c] + 1.0).powi(2) + k[c] * k[c])
        });
        assert!(reflectance[0] > 0.9 && reflectance[2] < 0.6, "{reflectance:?}");
    }

    #[test]
    fn points_at_equal_wavelengths_make_a_step_and_no_division_by_zero() {
        let step =
            integrate(&[[400.0, 0.0], [560.0, 0.0], [560.0, 1.0], [700.0, 1.0]], Quantity::Reflectance);
        assert!(step.iter().all(|c| c.is_finite()) && step[0] > 0.9, "{step:?}");
    }
}
