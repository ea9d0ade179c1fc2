//! Rows for Burley's models, and what holds of them alone.

use super::*;

const RUST: Rgb = Rgb::new(0.6, 0.3, 0.05);

/// Mitsuba's defaults but for the colour.
const PLAIN: PrincipledDials = PrincipledDials {
    base_color: RUST,
    roughness: 0.5,
    anisotropic: 0.0,
    metallic: 0.0,
    spec_trans: 0.0,
    eta: 1.5,
    spec_tint: 0.0,
    sheen: 0.0,
    sheen_tint: 0.0,
    flatness: 0.0,
    clearcoat: 0.0,
    clearcoat_gloss: 0.0,
};

const SHEET: PrincipledThinDials = PrincipledThinDials {
    base_color: RUST,
    roughness: 0.5,
    anisotropic: 0.0,
    spec_trans: 0.0,
    eta: 1.5,
    spec_tint: 0.0,
    sheen: 0.0,
    sheen_tint: 0.0,
    flatness: 0.0,
    diff_trans: 0.0,
};

fn principled(dials: PrincipledDials) -> Bsdf<'static> {
    Bsdf::Principled(Principled::new(&dials))
}

fn sheet(dials: PrincipledThinDials) -> Bsdf<'static> {
    Bsdf::PrincipledThin(PrincipledThin::new(&dials))
}

/// In a name: the lobes are added, not layered, so that a little more may come back than went in.
pub const SUM: &str = "sum";

pub fn cases() -> Vec<Case> {
    let metal = PrincipledDials { metallic: 1.0, roughness: 0.6, ..PLAIN };
    let glass = PrincipledDials { spec_trans: 1.0, base_color: ORANGE, ..PLAIN };
    let pane = PrincipledThinDials { spec_trans: 1.0, base_color: ORANGE, ..SHEET };
    vec![
        ("principled sum", principled(PLAIN)),
        ("principled sum, rough", principled(PrincipledDials { roughness: 1.0, ..PLAIN })),
        ("principled sum, sharp", principled(PrincipledDials { roughness: 0.2, ..PLAIN })),
        ("principled sum, tinted", principled(PrincipledDials { spec_tint: 1.0, ..PLAIN })),
        ("principled sum, sheen", principled(PrincipledDials { sheen: 1.0, ..PLAIN })),
        (
            "principled sum, tinted sheen",
            principled(PrincipledDials { sheen: 1.0, sheen_tint: 1.0, ..PLAIN }),
        ),
        ("principled sum, flat", principled(PrincipledDials { flatness: 1.0, ..PLAIN })),
        ("principled sum, coat", principled(PrincipledDials { clearcoat: 0.5, ..PLAIN })),
        (
            "principled sum, glossy coat",
            principled(PrincipledDials { clearcoat: 1.0, clearcoat_gloss: 0.6, ..PLAIN }),
        ),
        ("principled sum, thinner", principled(PrincipledDials { eta: 0.7, spec_tint: 0.5, ..PLAIN })),
        (
            "principled sum, all half",
            principled(PrincipledDials {
                anisotropic: 0.5,
                metallic: 0.5,
                spec_tint: 0.5,
                sheen: 0.5,
                sheen_tint: 0.5,
                flatness: 0.5,
                clearcoat: 0.5,
                clearcoat_gloss: 0.5,
                ..PLAIN
            }),
        ),
        ("principled metal", principled(metal)),
        ("principled metal, stretched", principled(PrincipledDials { anisotropic: 1.0, ..metal })),
        ("principled metal sum, coat", principled(PrincipledDials { clearcoat: 1.0, ..metal })),
        ("principled glass, both sides", principled(glass)),
        ("principled glass, both sides, thinner", principled(PrincipledDials { eta: 1.0 / 1.33, ..glass })),
        (
            "principled glass, both sides, stretched",
            principled(PrincipledDials { anisotropic: 0.8, eta: 1.8, ..glass }),
        ),
        ("principled glass, both sides, rough", principled(PrincipledDials { roughness: 1.0, ..glass })),
        (
            "principled glass, both sides, black",
            principled(PrincipledDials { base_color: Rgb::ZERO, ..glass }),
        ),
        (
            "principled glass sum, both sides, mixed",
            principled(PrincipledDials {
                metallic: 0.3,
                spec_trans: 0.6,
                sheen: 0.5,
                spec_tint: 0.4,
                clearcoat: 0.5,
                ..PLAIN
            }),
        ),
        ("sheet sum, both sides", sheet(SHEET)),
        (
            "sheet sum, both sides, flat with sheen",
            sheet(PrincipledThinDials { flatness: 1.0, sheen: 1.0, ..SHEET }),
        ),
        ("sheet, both sides, diffuse through", sheet(PrincipledThinDials { diff_trans: 2.0, ..SHEET })),
        ("sheet, both sides, half through", sheet(PrincipledThinDials { diff_trans: 1.0, ..SHEET })),
        ("pane, both sides", sheet(pane)),
        ("pane, both sides, rough", sheet(PrincipledThinDials { roughness: 1.0, eta: 1.33, ..pane })),
        ("pane, both sides, thinner", sheet(PrincipledThinDials { eta: 0.9, anisotropic: 0.7, ..pane })),
        (
            "sheet sum, both sides, all",
            sheet(PrincipledThinDials {
                anisotropic: 0.5,
                spec_trans: 0.5,
                spec_tint: 0.5,
                sheen: 0.5,
                sheen_tint: 0.5,
                flatness: 0.5,
                diff_trans: 0.6,
                ..SHEET
            }),
        ),
    ]
}

pub fn needles() -> Vec<Case> {
    let coat = PrincipledDials { clearcoat: 1.0, clearcoat_gloss: 1.0, ..PLAIN };
    vec![
        // No needle, but so dark that what it reflects is rounding.
        (
            "principled metal, black",
            principled(PrincipledDials { metallic: 1.0, base_color: Rgb::ZERO, ..PLAIN }),
        ),
        ("principled needle", principled(PrincipledDials { metallic: 1.0, roughness: 0.0, ..PLAIN })),
        (
            "principled blade",
            principled(PrincipledDials { metallic: 1.0, roughness: 0.04, anisotropic: 1.0, ..PLAIN }),
        ),
        ("principled sum, needle coat", principled(coat)),
        (
            "principled metal sum, needle coat",
            principled(PrincipledDials { metallic: 1.0, roughness: 0.001, ..coat }),
        ),
        (
            "principled glass, both sides, needle",
            principled(PrincipledDials { spec_trans: 1.0, roughness: 0.001, ..PLAIN }),
        ),
        (
            "pane, both sides, needle",
            sheet(PrincipledThinDials { spec_trans: 1.0, roughness: 0.001, ..SHEET }),
        ),
    ]
}

/// Mean of the weight, and mean of its square over the squared mean: 1 if drawn in proportion to what is scattered.
fn spread(bsdf: &Bsdf, wo: Vec3) -> (f64, f64) {
    let weight = |lobe: f32, u: Vec2| {
        let weight = bsdf.sample(wo, lobe, u).map_or(0.0, |s| s.weight.total().element_sum() / 3.0);
        Vec3::new(weight, weight * weight, 0.0)
    };
    let mean = furnace(1 << 14, weight);
    (mean.x, mean.y / (mean.x * mean.x))
}

#[test]
fn lobes_are_drawn_by_what_they_scatter() {
    // Black glass keeps total reflection alone, which facets drawn by what is seen of them miss most of the time.
    for (name, bsdf) in cases().into_iter().filter(|(name, _)| !name.contains("black")) {
        for cos in COSINES.iter().flat_map(|&cos| [cos, -cos]).filter(|cos| cos.abs() >= 0.1) {
            let (albedo, spread) = spread(&bsdf, direction(cos));
            assert!(albedo < 0.1 || spread < 2.5, "{name}, cos {cos}: {spread}");
        }
    }
}

#[test]
fn values_are_those_of_mitsuba() {
    // Printed by mitsuba_principled.py beside this file.
    for line in include_str!("mitsuba_principled.txt").lines() {
        let mut numbers = line.split(' ').map(|x| x.parse::<f32>().expect("a number"));
        let mut next = || numbers.next().expect("25 numbers");
        let is_sheet = next() == 1.0;
        let mut color = || Rgb::new(next(), next(), next());
        let base_color = color();
        let mut next = || numbers.next().expect("25 numbers");
        let [roughness, anisotropic, metallic, spec_trans, eta, spec_tint] = std::array::from_fn(|_| next());
        let [sheen, sheen_tint, flatness, clearcoat, clearcoat_gloss, diff_trans] =
            std::array::from_fn(|_| next());
        let mut vector = || Vec3::new(next(), next(), next());
        let (wo, wi, truth) = (vector(), vector(), vector());
        let bsdf = if is_sheet {
            sheet(PrincipledThinDials {
                base_color,
                roughness,
                anisotropic,
                spec_trans,
                eta,
                spec_tint,
                sheen,
                sheen_tint,
                flatness,
                diff_trans,
            })
        } else {
            principled(PrincipledDials {
                base_color,
                roughness,
                anisotropic,
                metallic,
                spec_trans,
                eta,
                spec_tint,
                sheen,
                sheen_tint,
                flatness,
                clearcoat,
                clearcoat_gloss,
            })
        };
        let value = bsdf.eval(wo, wi).f_cos.total();
        let off = (value - truth).abs().max_element();
        assert!(off <= 1e-4 * truth.max_element(), "{line}: {value}");
    }
}

#[test]
fn dials_beyond_their_range_are_brought_there() {
    let beyond =
        PrincipledDials { metallic: 7.0, roughness: -1.0, sheen: f32::NAN, clearcoat: -0.5, ..PLAIN };
    let within = PrincipledDials { metallic: 1.0, roughness: 0.0, ..PLAIN };
    assert_eq!(principled(beyond), principled(within));
}

#[test]
fn an_index_of_one_switches_all_reflection_off() {
    // As Mitsuba does, though metal has no index of refraction.
    let metal = principled(PrincipledDials { metallic: 1.0, eta: 1.0, spec_tint: 1.0, ..PLAIN });
    assert_eq!(metal.eval(direction(0.8), direction(0.6)).f_cos, Split::ZERO);
    assert_eq!(metal.features(direction(0.8)).albedo, Rgb::ZERO);
    // Nor does glass become a hole.
    let glass = principled(PrincipledDials { spec_trans: 1.0, eta: 1.0, base_color: Rgb::ONE, ..PLAIN });
    let through = albedo(&glass, direction(0.8)).total().x;
    assert!(through > 0.9 && through < 1.001, "{through}");
}
