use glam::Vec2Swizzles;

use super::*;

const FILTERS: [PixelFilter; 9] = [
    PixelFilter::Box,
    PixelFilter::Tent { radius: 1.0 },
    PixelFilter::Tent { radius: 2.5 },
    PixelFilter::Gaussian { stddev: 0.5 },
    PixelFilter::Gaussian { stddev: 3.0 },
    PixelFilter::Mitchell { b: 1.0 / 3.0, c: 1.0 / 3.0 },
    PixelFilter::Mitchell { b: 1.0, c: 0.0 },
    PixelFilter::CatmullRom,
    PixelFilter::Lanczos { lobes: 3.0 },
];

/// The filter's own formula, not normalised.
fn value(filter: PixelFilter, x: f64) -> f64 {
    let inside = |radius: f64, f: f64| if x.abs() < radius { f } else { 0.0 };
    match filter {
        PixelFilter::Box => inside(0.5, 1.0),
        PixelFilter::Tent { radius } => (1.0 - x.abs() / f64::from(radius)).max(0.0),
        PixelFilter::Gaussian { stddev } => {
            let s = f64::from(stddev);
            inside(4.0 * s, (-x * x / (2.0 * s * s)).exp() - (-8f64).exp())
        }
        PixelFilter::Mitchell { b, c } => mitchell(x, b.into(), c.into()),
        PixelFilter::CatmullRom => mitchell(x, 0.0, 0.5),
        PixelFilter::Lanczos { lobes } => inside(lobes.into(), sinc(x) * sinc(x / f64::from(lobes))),
    }
}

fn integral(f: impl Fn(f64) -> f64) -> f64 {
    const N: usize = 200_000;
    let (a, b) = (-16.0, 16.0);
    let h = (b - a) / N as f64;
    (0..N).map(|i| f(a + (i as f64 + 0.5) * h)).sum::<f64>() * h
}

#[test]
fn weighted_samples_have_the_moments_of_the_filter() {
    // Midpoints of an even grid in u: no chance is involved.
    const N: usize = 1 << 17;
    for filter in FILTERS {
        let sampler = PixelFilterSampler::new(filter);
        for test in [|_: f64| 1.0, |x: f64| x, |x: f64| x * x, |x: f64| (2.0 * x).cos()] {
            let truth = integral(|x| value(filter, x) * test(x)) / integral(|x| value(filter, x));
            // The y axis is drawn the same way; its weight has mean 1 and is taken out at a fixed place.
            let (_, at_center) = sampler.sample(Vec2::new(0.5, 0.5));
            let weight_y = at_center.abs().sqrt();
            let mean = (0..N)
                .map(|i| {
                    let (p, weight) = sampler.sample(Vec2::new((i as f32 + 0.5) / N as f32, 0.5));
                    f64::from(weight / weight_y) * test(p.x.into())
                })
                .sum::<f64>()
                / N as f64;
            assert!((mean - truth).abs() < 2e-4 * (1.0 + truth.abs()), "{filter:?}: {mean}, not {truth}");
        }
    }
}

#[test]
fn weights_are_one_without_negative_lobes_and_else_a_constant_with_sign() {
    for filter in FILTERS {
        let sampler = PixelFilterSampler::new(filter);
        let absolute = integral(|x| value(filter, x).abs()) / integral(|x| value(filter, x));
        let negative = (absolute - 1.0).abs() > 1e-6;
        for i in 0..4096u32 {
            let u = Vec2::new((i % 64) as f32 / 64.0, (i / 64) as f32 / 64.0);
            let (p, weight) = sampler.sample(u);
            if negative {
                let sign = (value(filter, p.x.into()) * value(filter, p.y.into())).signum();
                let truth = absolute * absolute * sign;
                // Within a bin of a change of sign either will do.
                let near_zero = [p.x, p.y].iter().any(|&x| value(filter, x.into()).abs() < 0.01);
                assert!((f64::from(weight) - truth).abs() < 1e-5 || near_zero, "{filter:?} {p}: {weight}");
            } else {
                assert_eq!(weight, 1.0, "{filter:?}");
            }
        }
    }
}

#[test]
fn both_axes_follow_the_same_profile_and_keep_the_order_of_u() {
    for filter in FILTERS {
        let sampler = PixelFilterSampler::new(filter);
        let mut last = f32::NEG_INFINITY;
        for i in 0..=1000 {
            let u = (i as f32 / 1000.0).min(1.0 - f32::EPSILON / 2.0);
            let (p, weight) = sampler.sample(Vec2::new(u, 0.3));
            let (q, weight_turned) = sampler.sample(Vec2::new(0.3, u));
            assert_eq!((p, weight), (q.yx(), weight_turned));
            assert!(p.x >= last && p.is_finite(), "{filter:?} at {u}");
            last = p.x;
        }
    }
}

#[test]
fn parameters_that_make_no_filter_make_a_box() {
    for bad in [0.0, -1.0, f32::NAN, f32::INFINITY, 1e-40, f32::MAX] {
        for filter in [
            PixelFilter::Tent { radius: bad },
            PixelFilter::Gaussian { stddev: bad },
            PixelFilter::Lanczos { lobes: bad },
            PixelFilter::Mitchell { b: bad, c: bad },
        ] {
            let (p, weight) = PixelFilterSampler::new(filter).sample(Vec2::new(0.7, 0.9));
            assert!(!p.is_nan() && weight.is_finite(), "{filter:?}: {p} {weight}");
        }
    }
}

#[test]
fn splatted_pixels_share_as_much_as_their_filter_says() {
    let of = |filter| Splat::of(filter).correlation;
    assert_eq!(of(PixelFilter::Box), 1.0);
    assert!((of(PixelFilter::Tent { radius: 1.0 }) - 2.25).abs() < 1e-6);
    // A Gaussian: ∫f² = 1/(2 √π σ); Mitsuba's is a little narrower for the value that it takes off.
    let gaussian = of(PixelFilter::Gaussian { stddev: 0.5 });
    assert!((gaussian - std::f64::consts::PI).abs() < 0.02, "{gaussian}");
    for filter in FILTERS {
        // Against the formula, on a grid of its own that the widest of them fits in.
        let steps = (0..64_000).map(|i| -16.0 + (f64::from(i) + 0.5) / 2000.0);
        let (sum, squares) = steps.map(|x| value(filter, x)).fold((0.0, 0.0), |(s, q), f| (s + f, q + f * f));
        let expected = (sum * sum / squares / 2000.0).powi(2).max(1.0);
        let found = of(filter);
        assert!((found / expected - 1.0).abs() < 1e-3, "{filter:?}: {found} for {expected}");
    }
}

/// The share of a bright half-plane that pixels around its edge see in Mitsuba 3.9.1, whose default filter is a Gaussian:
/// `mi.render` of a plane lit by a projector, 4096 samples a pixel; the filter itself gives 0.1348 beside 0.8154.
#[test]
fn steps_blur_as_mitsubas_table_does() {
    const N: usize = 1 << 20;
    let film = |filter_steps| Film {
        filter_steps,
        ..limpid_testkit::scene::camera(Default::default(), glam::DVec3::X, 1, 1).film
    };
    let with = |steps| Film { filter: PixelFilter::Gaussian { stddev: 0.5 }, ..film(steps) };
    let share = |sampler: &PixelFilterSampler, edge: f32| {
        let seen = |i: usize| sampler.sample(Vec2::new((i as f32 + 0.5) / N as f32, 0.5)).0.x < edge;
        (0..N).filter(|&i| seen(i)).count() as f64 / N as f64
    };
    let (exact, stepped) = (PixelFilterSampler::of(&with(None)), PixelFilterSampler::of(&with(Some(31))));
    let found = |sampler| [0.4485, -0.5515].map(|edge| share(sampler, edge));
    let near = |found: [f64; 2], wanted: [f64; 2]| {
        assert!(found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-3), "{found:?}, not {wanted:?}");
    };
    near(found(&exact), [0.8154, 0.1348]);
    near(found(&stepped), [0.8080, 0.1424]);
}
