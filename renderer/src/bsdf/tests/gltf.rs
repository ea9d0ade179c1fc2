//! Rows for glTF's material, and what holds of it alone.

use super::burley::SUM;
use super::*;

const PLASTIC: GltfDials = GltfDials {
    base_color: Rgb::new(0.7, 0.4, 0.1),
    metallic: 0.0,
    roughness: 0.5,
    ior: 1.5,
    specular: 1.0,
    specular_color: Rgb::ONE,
    clearcoat: 0.0,
    clearcoat_roughness: 0.3,
    sheen_color: Rgb::ZERO,
    sheen_roughness: 0.5,
    transmission: 0.0,
    thin: true,
};

fn gltf(dials: GltfDials) -> Bsdf<'static> {
    Bsdf::Gltf(Gltf::new(&dials))
}

/// In a name: has a coat, which is not reciprocal.
pub const COAT: &str = "coat";

pub fn cases() -> Vec<Case> {
    let metal = GltfDials { metallic: 1.0, ..PLASTIC };
    let glass = GltfDials { transmission: 1.0, thin: false, ..PLASTIC };
    let pane = GltfDials { transmission: 1.0, ..PLASTIC };
    let sheen = GltfDials { sheen_color: Rgb::new(0.2, 0.5, 0.8), ..PLASTIC };
    vec![
        ("glTF plastic", gltf(PLASTIC)),
        (
            "glTF plastic, white and rough",
            gltf(GltfDials { base_color: Rgb::ONE, roughness: 1.0, ..PLASTIC }),
        ),
        (
            "glTF plastic, specular",
            gltf(GltfDials { specular: 0.6, specular_color: Rgb::new(2.0, 20.0, 50.0), ior: 1.8, ..PLASTIC }),
        ),
        ("glTF metal", gltf(metal)),
        ("glTF half metal", gltf(GltfDials { metallic: 0.5, roughness: 0.3, ..PLASTIC })),
        ("glTF coat", gltf(GltfDials { clearcoat: 1.0, ..PLASTIC })),
        ("glTF coat on metal", gltf(GltfDials { clearcoat: 0.7, roughness: 0.8, ..metal })),
        ("glTF sheen sum", gltf(sheen)),
        ("glTF sheen sum, narrow", gltf(GltfDials { sheen_roughness: 0.2, ..sheen })),
        ("glTF glass, both sides", gltf(glass)),
        ("glTF glass, both sides, rough", gltf(GltfDials { roughness: 0.9, ior: 1.33, ..glass })),
        ("glTF pane, both sides", gltf(pane)),
        ("glTF pane, both sides, rough", gltf(GltfDials { roughness: 1.0, ..pane })),
        (
            "glTF all with coat sum, both sides",
            gltf(GltfDials { metallic: 0.3, transmission: 0.5, clearcoat: 0.5, thin: false, ..sheen }),
        ),
        (
            "glTF sheet with coat sum, both sides",
            gltf(GltfDials { metallic: 0.3, transmission: 0.5, clearcoat: 0.5, ..sheen }),
        ),
    ]
}

pub fn needles() -> Vec<Case> {
    vec![
        ("glTF needle", gltf(GltfDials { metallic: 1.0, roughness: 0.0, ..PLASTIC })),
        (
            "glTF glass needle, both sides",
            gltf(GltfDials { transmission: 1.0, thin: false, roughness: 0.03, ..PLASTIC }),
        ),
        ("glTF pane needle, both sides", gltf(GltfDials { transmission: 1.0, roughness: 0.0, ..PLASTIC })),
        ("glTF needle coat", gltf(GltfDials { clearcoat: 1.0, clearcoat_roughness: 0.01, ..PLASTIC })),
        ("glTF black", gltf(GltfDials { base_color: Rgb::ZERO, specular: 0.0, ..PLASTIC })),
    ]
}

#[test]
fn layers_have_the_values_of_the_specification() {
    // At normal incidence from above: D = 1 / (π α²), G = 1, F = f0.
    let value = |dials| gltf(dials).eval(Vec3::Z, Vec3::Z).f_cos;
    let d = |roughness: f32| 1.0 / (std::f32::consts::PI * roughness.powi(4));
    let close = |a: Rgb, b: Rgb| assert!((a - b).abs().max_element() < 1e-5 * b.max_element(), "{a} {b}");
    let plastic = value(PLASTIC);
    close(plastic.diffuse, PLASTIC.base_color * (0.96 / std::f32::consts::PI));
    close(plastic.specular, Rgb::splat(0.04 * d(0.5) / 4.0));
    close(value(GltfDials { metallic: 1.0, ..PLASTIC }).total(), PLASTIC.base_color * (d(0.5) / 4.0));
    // The coat takes 0.04 of what is below and adds as much of its own lobe.
    let coated = value(GltfDials { clearcoat: 1.0, ..PLASTIC });
    close(coated.total(), plastic.total() * 0.96 + Rgb::splat(0.04 * d(0.3) / 4.0));
    // A tinted reflection takes the share of its strongest channel from the base.
    let tinted = value(GltfDials { specular: 0.5, specular_color: Rgb::new(1.0, 2.0, 0.0), ..PLASTIC });
    close(tinted.diffuse, PLASTIC.base_color * (0.96 / std::f32::consts::PI));
    close(tinted.specular, Rgb::new(0.02, 0.04, 0.0) * (d(0.5) / 4.0));
}

#[test]
fn a_pane_looks_alike_from_both_sides() {
    let pane = gltf(GltfDials { transmission: 0.7, ..PLASTIC });
    for (wo, wi) in [(0.8, 0.5), (0.3, -0.9)].map(|(a, b)| (direction(a), direction(b))) {
        assert_eq!(pane.eval(wo, wi), pane.eval(-wo, -wi));
    }
}

#[test]
fn sheen_gains_little() {
    // The tables and the fit are not exact, nor is the share of the largest channel that of each.
    for (name, bsdf) in cases().into_iter().filter(|(name, _)| name.contains(SUM)) {
        for cos in COSINES {
            let total = albedo(&bsdf, direction(cos)).total();
            assert!(total.max_element() < 1.02, "{name}, cos {cos}: {total}");
        }
    }
}
