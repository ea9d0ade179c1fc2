use super::*;
use crate::Frame;
use crate::testing::Random;

/// A grey picture of 64x64 pixels whose right half is twice as bright. Each pixel of a pass is its brightness with
/// even noise, and now and then a firefly.
#[derive(Clone, Copy)]
struct Scene {
    brightness: f64,
    /// Standard deviation of a pass, as a fraction of the brightness.
    noise: f64,
    /// Where fireflies fall: the first rows. They carry the same light however rare they are.
    rows: usize,
    /// Light that they carry, on average, as a fraction of the brightness.
    light: f64,
    /// Chance of one, a pixel and pass; 0 where the same light comes without any.
    rate: f64,
}

const SIDE: usize = 64;
const TAME: Scene = Scene { brightness: 1.0, noise: 0.3, rows: 0, light: 0.0, rate: 0.0 };

fn rendered(scene: Scene, passes: usize, random: &mut Random) -> Halves {
    let halves = [0, 1].map(|_| {
        let mut half = Passes::new([SIDE, SIDE]);
        for _ in 0..passes / 2 {
            let plane = |_| -> Vec<f32> { (0..SIDE * SIDE).map(|p| scene.draw(p, random) as f32).collect() };
            let planes: [Vec<f32>; 3] = std::array::from_fn(plane);
            half.push(planes.each_ref().map(Vec::as_slice), 4);
        }
        half.estimate().expect("enough passes")
    });
    Halves::Two(Box::new(halves))
}

impl Scene {
    fn draw(&self, p: usize, random: &mut Random) -> f64 {
        let base = if p % SIDE < SIDE / 2 { self.brightness } else { 2.0 * self.brightness };
        let tame = base * (1.0 + self.noise * 12.0_f64.sqrt() * (random.uniform() - 0.5));
        if p / SIDE >= self.rows {
            return tame;
        }
        let carried = base * self.light;
        if self.rate == 0.0 {
            return tame + carried;
        }
        tame + if random.uniform() < self.rate { carried / self.rate } else { 0.0 }
    }
}

/// The same picture as another renderer would hand it over: means and variances.
fn in_one_piece(picture: &Halves) -> Halves {
    let plane =
        |i: usize, channel: usize| (0..SIDE * SIDE).map(|p| picture.pixel(channel, p)[i] as f32).collect();
    let [mean, var] = [0, 1].map(|i| {
        let mut frame = Frame::new(SIDE, SIDE);
        ["R", "G", "B"].into_iter().enumerate().for_each(|(c, name)| frame.insert(name, plane(i, c)));
        frame
    });
    Halves::One(Box::new(Estimate::of_frames(&mean, &var).expect("fits")))
}

/// Comparisons of so many with an alarm, be it against halves or against one piece.
fn alarms(a: Scene, b: Scene, trials: usize, seed: u64) -> usize {
    let mut random = Random::new(seed);
    (0..trials)
        .filter(|_| {
            let (a, b) = (rendered(a, 16, &mut random), rendered(b, 16, &mut random));
            let whole = compare(&a, &in_one_piece(&b)).p < FALSE_ALARMS;
            compare(&a, &b).p < FALSE_ALARMS || whole
        })
        .count()
}

#[test]
fn equal_pictures_raise_no_more_alarms_than_promised() {
    // 200 comparisons at 1 %: eight or more by chance in 0.1 % of all seeds.
    let found = alarms(TAME, TAME, 200, 1);
    println!("no fireflies: {found} alarms in 200");
    assert!(found < 8, "{found} of 200");
}

#[test]
fn fireflies_of_one_picture_raise_no_false_alarms() {
    // The same light: on one side evenly, on the other in bright events, from frequent to a handful in the picture.
    // Most blocks have none of them, and would swear that it is darker there.
    let smooth = Scene { rows: SIDE, light: 0.5, ..TAME };
    for (i, rate) in [1e-1, 1e-2, 1e-3, 3e-4].into_iter().enumerate() {
        let found = alarms(Scene { rate, ..smooth }, smooth, 100, 10 + i as u64);
        println!("fireflies in one picture, rate {rate}: {found} alarms in 100");
        // 100 comparisons at 1 %: six or more by chance in 0.05 % of all seeds.
        assert!(found < 6, "rate {rate}: {found} of 100");
    }
    // The trap must be one: blocks that know no other noise than their own raise alarms.
    let mut random = Random::new(19);
    let naive = (0..20).filter(|_| {
        let a = rendered(Scene { rate: 3e-4, ..smooth }, 16, &mut random);
        let b = rendered(smooth, 16, &mut random);
        let units = Units::of(Grid::of_blocks([SIDE; 2], 8), [View::All(&a), View::All(&b)], None);
        let level = sidak_level(FALSE_ALARMS, 3 * units.grid.len());
        units.findings(level, ROUNDING).iter().any(|finding| finding.p < level)
    });
    assert_eq!(naive.count(), 20);
}

#[test]
fn fireflies_of_both_pictures_raise_no_false_alarms() {
    for (i, rate) in [1e-2, 1e-3, 1e-4].into_iter().enumerate() {
        let scene = Scene { rows: SIDE / 4, light: 1.0, rate, ..TAME };
        let found = alarms(scene, scene, 100, 20 + i as u64);
        println!("fireflies in both pictures, rate {rate}: {found} alarms in 100");
        assert!(found < 6, "rate {rate}: {found} of 100");
    }
}

#[test]
fn fireflies_do_not_hide_what_is_wrong_elsewhere() {
    // One per cent in all that is not a firefly; the rows with fireflies make the mean of the picture useless.
    let noisy = Scene { rows: SIDE / 4, light: 1.0, rate: 1e-3, ..TAME };
    let wrong = Scene { brightness: 1.01, ..noisy };
    let mut random = Random::new(30);
    let mut found = [0; 2];
    for _ in 0..20 {
        let (wrong, sound) = (rendered(wrong, 32, &mut random), rendered(noisy, 32, &mut random));
        for (found, sound) in found.iter_mut().zip([sound.clone(), in_one_piece(&sound)]) {
            let comparison = compare(&wrong, &sound);
            assert!(
                comparison.detectable_bias > 0.05,
                "the trap must be one: {}",
                comparison.detectable_bias
            );
            *found += usize::from(comparison.p < FALSE_ALARMS);
        }
    }
    assert_eq!(found, [20, 20]);
}

#[test]
fn noise_without_a_tail_stays_where_it_is() {
    // A stripe that is very noisy, as the edge of a lamp is, and evenly so: blocks elsewhere keep their own noise.
    let mut random = Random::new(35);
    let reach = |rows, noise, random: &mut Random| {
        let stripe = Scene { noise, ..TAME };
        let mut draw = || {
            let halves = [0, 1].map(|_| {
                let mut half = Passes::new([SIDE; 2]);
                for _ in 0..8 {
                    let of = |p: usize, random: &mut Random| {
                        if p / SIDE < rows { stripe } else { TAME }.draw(p, random)
                    };
                    let plane: Vec<f32> = (0..SIDE * SIDE).map(|p| of(p, random) as f32).collect();
                    half.push([&plane; 3], 4);
                }
                half.estimate().expect("enough passes")
            });
            Halves::Two(Box::new(halves))
        };
        let comparison = compare(&draw(), &draw());
        comparison.family(Parts::Blocks(8)).expect("is tested").findings.last().expect("has some").detectable
    };
    let (quiet, striped) = (reach(0, 0.0, &mut random), reach(2, 30.0, &mut random));
    assert!((striped / quiet - 1.0).abs() < 0.3, "{striped} with the stripe, {quiet} without");
}

#[test]
fn the_detectable_bias_is_found_with_its_power_and_not_less() {
    // A uniform bias of just that size, seen by the mean of the whole picture in one channel: 300 trials at 90 %, a
    // standard error of 1.7 %; three of them.
    let mut random = Random::new(40);
    let reach = compare(&rendered(TAME, 16, &mut random), &rendered(TAME, 16, &mut random)).detectable_bias;
    let biased = Scene { brightness: 1.0 + reach, ..TAME };
    let found = (0..300)
        .filter(|_| {
            let comparison = compare(&rendered(biased, 16, &mut random), &rendered(TAME, 16, &mut random));
            let whole = &comparison.families[0];
            whole.findings[0].p < whole.level
        })
        .count();
    assert!((found as f64 / 300.0 - 0.9).abs() < 0.052, "{found} of 300");
}

#[test]
fn a_difference_in_one_place_is_found_there() {
    let mut random = Random::new(50);
    let sound = rendered(TAME, 16, &mut random);
    let mut wrong = rendered(TAME, 16, &mut random);
    let Halves::Two(halves) = &mut wrong else { unreachable!("rendered in halves") };
    for half in halves.iter_mut() {
        for y in 40..48 {
            half.mean[1][y * SIDE + 16..y * SIDE + 24].iter_mut().for_each(|v| *v *= 1.2);
        }
    }
    let comparison = compare(&wrong, &sound);
    assert!(comparison.p < FALSE_ALARMS);
    let blocks = comparison.family(Parts::Blocks(8)).expect("is tested");
    let worst = blocks.findings.iter().min_by(|a, b| a.p.total_cmp(&b.p)).expect("has findings");
    assert_eq!((worst.area, worst.channel), (Area { x: 16, y: 40, width: 8, height: 8 }, 1));
    assert!((worst.bias() - 0.2).abs() < 0.1, "{}", worst.bias());
}

#[test]
fn pictures_without_noise_are_told_apart_beyond_rounding() {
    let flat = |value: f64| {
        let half = || Estimate {
            size: [9, 5],
            rounding: ROUNDING,
            spp: 8.0,
            mean: std::array::from_fn(|_| vec![value; 45]),
            var: std::array::from_fn(|_| vec![0.0; 45]),
            third: std::array::from_fn(|_| vec![0.0; 45]),
        };
        Halves::Two(Box::new([half(), half()]))
    };
    for (other, p) in [(1.0, 1.0), (1.00005, 1.0), (1.001, 0.0)] {
        let comparison = compare(&flat(other), &flat(1.0));
        assert_eq!((comparison.p, comparison.detectable_bias), (p, ROUNDING), "{other}");
    }
    let black = compare(&flat(0.0), &flat(0.0));
    // Nothing is to be seen there, and so nothing would show.
    assert_eq!((black.p, black.mean_ratio, black.detectable_bias), (1.0, 1.0, f64::INFINITY));
}

#[test]
fn pixels_that_are_not_finite_are_left_out_and_counted() {
    let mut random = Random::new(60);
    let sound = rendered(TAME, 16, &mut random);
    let mut wrong = rendered(TAME, 16, &mut random);
    let Halves::Two(halves) = &mut wrong else { unreachable!("rendered in halves") };
    halves[0].mean[2][77] = f64::NAN;
    halves[1].mean[0][99] = f64::INFINITY;
    let comparison = compare(&wrong, &sound);
    assert_eq!(comparison.left_out, 2);
    assert!(comparison.p > FALSE_ALARMS && comparison.p.is_finite());
    assert!(comparison.detectable_bias.is_finite());
}

#[test]
fn halves_and_more_passes_add_up_to_one_picture() {
    // Against all passes at once: the mean to rounding, the variance and its standard error of about 10 % a pixel.
    let mut random = Random::new(70);
    let mut merged = rendered(TAME, 16, &mut random);
    merged.merge(&rendered(TAME, 16, &mut random));
    assert_eq!(merged.spp(), 128.0);
    let pixels = 0..SIDE * SIDE;
    let var: f64 = pixels.clone().map(|p| merged.pixel(0, p)[1]).sum::<f64>() / pixels.len() as f64;
    let truth = 0.5 * (1.0 + 4.0) * 0.09 / 32.0;
    assert!((var / truth - 1.0).abs() < 0.02, "{var} for {truth}");
}

#[test]
fn grids_cover_every_pixel_once() {
    for (size, side) in [([24, 16], 8), ([33, 7], 8), ([5, 100], 32), ([1, 1], 8), ([257, 255], 32)] {
        let grid = units::Grid::of_blocks(size, side);
        let mut seen = vec![0; grid.len()];
        (0..size[0] * size[1]).for_each(|p| seen[grid.of_pixel(p)] += 1);
        for (unit, seen) in seen.into_iter().enumerate() {
            let area = grid.area(unit);
            assert_eq!(seen, area.width * area.height, "{size:?} {side} unit {unit}");
            assert_eq!(grid.of_pixel(area.y * size[0] + area.x), unit);
        }
    }
}

#[test]
fn a_difference_within_the_rounding_that_is_stated_is_none() {
    let picture = |grey: f32| {
        let mut frame = Frame::new(SIDE, SIDE);
        ["R", "G", "B"].into_iter().for_each(|name| frame.insert(name, vec![grey; SIDE * SIDE]));
        frame
    };
    let variance = picture(1e-12);
    let of = |grey: f32, rounding: f64| {
        let mut estimate = Estimate::of_frames(&picture(grey), &variance).expect("fits");
        estimate.set_rounding(rounding);
        Halves::One(Box::new(estimate))
    };
    let p = |rounding: f64| compare(&of(1.0, 0.0), &of(1.0005, rounding)).p;
    assert!(p(1e-3) > 0.5 && p(4e-4) < FALSE_ALARMS, "{} {}", p(1e-3), p(4e-4));
    assert!(compare(&of(1.0, 0.0), &of(1.0005, 1e-3)).detectable_bias >= 1e-3);
}
