use limpid_frame::Statistic;

use super::*;
use crate::plane::Plane;
use crate::{Buffers, denoise_buffers};

/// Uniform in [0, 1).
fn random(n: usize, seed: u64) -> Plane {
    let mut state = seed;
    (0..n)
        .map(|_| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 40) as f32 / 16_777_216.0
        })
        .collect()
}

/// Two walls that meet at x = width / 2 under a gradient of light, with noise; everything that a renderer
/// writes. The second wall has a specular part. `exposure` multiplies radiance.
fn room(width: usize, height: usize, exposure: f32) -> Frame {
    let n = width * height;
    let mut frame = Frame::new(width, height);
    let left = |p: usize| p % width < width / 2;
    let mut beauty = [vec![vec![0.0; n]; 3], vec![vec![0.0; n]; 3]];
    for (layer, seed, level) in [(Layer::Diffuse, 1, 0.6), (Layer::Specular, 50, 0.2)] {
        let mut halves = Vec::new();
        for half in 0..2 {
            let mut planes = Vec::new();
            for c in 0..3 {
                let noise = random(n, seed + 10 * half + c);
                let value = |p: usize| {
                    let wall = match layer {
                        Layer::Diffuse => {
                            if left(p) {
                                0.8
                            } else {
                                0.3
                            }
                        }
                        _ => {
                            if left(p) {
                                0.0
                            } else {
                                1.0
                            }
                        }
                    };
                    exposure * level * wall * (0.5 + 0.01 * (p / width) as f32) * (0.5 + noise[p])
                };
                planes.push((0..n).map(value).collect::<Plane>());
            }
            for (sum, plane) in beauty[half as usize].iter_mut().zip(&planes) {
                sum.iter_mut().zip(plane).for_each(|(sum, value)| *sum += value);
            }
            halves.push(planes);
        }
        insert(&mut frame, layer, halves.remove(0), halves.remove(0));
    }
    let [a, b] = beauty;
    insert(&mut frame, Layer::Beauty, a, b);
    for (layer, of_left, of_right) in [
        (Layer::Albedo, [0.8; 3], [0.5; 3]),
        (Layer::DiffuseAlbedo, [0.8; 3], [0.3; 3]),
        (Layer::Normal, [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
        (Layer::Emission, [0.0; 3], [0.0; 3]),
    ] {
        let planes: Vec<Plane> = (0..3)
            .map(|c| (0..n).map(|p| if left(p) { of_left[c] } else { of_right[c] }).collect())
            .collect();
        for statistic in [Statistic::Mean, Statistic::A, Statistic::B] {
            frame.insert_layer(layer, statistic, planes.clone());
        }
        frame.insert_layer(layer, Statistic::Variance, vec![vec![0.0; n]; 3]);
    }
    frame
}

fn insert(frame: &mut Frame, layer: Layer, a: Vec<Plane>, b: Vec<Plane>) {
    let both = |f: fn(f32, f32) -> f32| a.iter().zip(&b).map(|(a, b)| map2(a, b, f)).collect();
    frame.insert_layer(layer, Statistic::Mean, both(|a, b| 0.5 * (a + b)));
    // Uniform noise of relative width 1 has variance 1/12, its mean of two half of that.
    frame.insert_layer(layer, Statistic::Variance, both(|a, b| (0.5 * (a + b)).powi(2) / 24.0));
    frame.insert_layer(layer, Statistic::A, a);
    frame.insert_layer(layer, Statistic::B, b);
}

fn denoise(frame: &Frame) -> Frame {
    JointNlm::default().denoise(frame).expect("the frame has a beauty")
}

fn values(frame: &Frame) -> Vec<f32> {
    frame.rgb().expect("is there").concat()
}

/// The frame with all its means replaced, halves alike and without variance: a picture without noise.
fn noise_free(width: usize, height: usize, color: &[Plane]) -> Frame {
    let mut frame = room(width, height, 1.0);
    for (layer, share) in [(Layer::Beauty, 1.0), (Layer::Diffuse, 1.0), (Layer::Specular, 0.0)] {
        let planes: Vec<Plane> =
            color.iter().map(|plane| plane.iter().map(|v| share * v).collect()).collect();
        for statistic in [Statistic::Mean, Statistic::A, Statistic::B] {
            frame.insert_layer(layer, statistic, planes.clone());
        }
        frame.insert_layer(layer, Statistic::Variance, vec![vec![0.0; width * height]; 3]);
    }
    frame
}

fn assert_close(actual: &[f32], expected: &[f32], tolerance: f32) {
    for (p, (a, e)) in actual.iter().zip(expected).enumerate() {
        assert!((a - e).abs() <= tolerance * e.abs(), "value {p}: {a} for {e}");
    }
}

#[test]
fn noise_shrinks_and_the_edge_stays() {
    let (noisy, clean) = (room(64, 64, 1.0), denoise(&room(64, 64, 1.0)));
    let error = |frame: &Frame| {
        let truth = |p: usize| {
            let wall = if p % 64 < 32 { 0.48 } else { 0.18 + 0.2 };
            wall * (0.5 + 0.01 * (p / 64) as f32)
        };
        let green = frame.channel("G").expect("is there");
        (0..green.len()).map(|p| (green[p] - truth(p)).powi(2)).sum::<f32>()
    };
    assert!(error(&clean) < error(&noisy) / 20.0, "{} of {}", error(&clean), error(&noisy));
}

#[test]
fn the_answer_keeps_what_it_was_made_from() {
    let noisy = room(20, 10, 1.0);
    let clean = denoise(&noisy);
    for (name, plane) in noisy.channels() {
        let replaced = ["R", "G", "B"].contains(&name);
        let component =
            ["diffuse.", "specular."].iter().any(|l| name.starts_with(l) && name.matches('.').count() == 1);
        let kept = if replaced { format!("noisy.{name}") } else { name.to_owned() };
        assert_eq!(clean.channel(&kept) == Some(plane), !component, "{name}");
    }
    let sum = |c: &str| {
        clean.channel(&format!("diffuse.{c}")).expect("is there")[7]
            + clean.channel(&format!("specular.{c}")).expect("is there")[7]
    };
    assert_eq!(clean.channel("G").expect("is there")[7], sum("G"));
    let record = &clean.metadata["limpid:denoise"];
    assert!(record.starts_with("joint-nlm radius=10 patch=3 "), "{record}");
    assert!(record.ends_with("; features normal albedo"), "{record}");
}

#[test]
fn the_edge_of_a_lamp_is_filtered_and_its_inside_passes_through() {
    let (width, n) = (40, 40 * 40);
    let mut frame = room(width, width, 1.0);
    // 50 on the left, 0 on the right, and a column between whose pixels see the lamp with half their samples.
    let lamp = |noise: Plane| -> Plane {
        let value = |p: usize| match (p % width).cmp(&20) {
            std::cmp::Ordering::Less => 50.0,
            std::cmp::Ordering::Equal => 25.0 + 20.0 * (noise[p] - 0.5),
            std::cmp::Ordering::Greater => 0.0,
        };
        (0..n).map(value).collect()
    };
    let (a, b) = (lamp(random(n, 7)), lamp(random(n, 8)));
    let mean = map2(&a, &b, |a, b| 0.5 * (a + b));
    // A half has variance 400/12 on the column.
    let variance: Plane = (0..n).map(|p| if p % width == 20 { 400.0 / 24.0 } else { 0.0 }).collect();
    for (statistic, plane) in
        [(Statistic::Mean, &mean), (Statistic::A, &a), (Statistic::B, &b), (Statistic::Variance, &variance)]
    {
        frame.insert_layer(Layer::Emission, statistic, vec![plane.clone(); 3]);
        if statistic == Statistic::Variance {
            continue;
        }
        let beauty = frame.layer(Layer::Beauty, statistic).expect("is there");
        let beauty = beauty.into_iter().map(|own| map2(own, plane, |own, lamp| own + lamp)).collect();
        frame.insert_layer(Layer::Beauty, statistic, beauty);
    }
    let clean = denoise(&frame);
    let clean = clean.channel("emission.R").expect("is there");
    let error = |plane: &[f32]| (0..width).map(|y| (plane[y * width + 20] - 25.0).powi(2)).sum::<f32>();
    assert!(error(clean) < 0.3 * error(&mean), "{} of {}", error(clean), error(&mean));
    // Each pass reaches one pixel further than noise does.
    assert!((0..n).filter(|p| (p % width).abs_diff(20) > 2).all(|p| clean[p] == mean[p]));
}

#[test]
fn the_same_bits_for_any_number_of_threads() {
    let frame = room(150, 70, 1.0);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be had");
        pool.install(|| denoise(&frame))
    };
    let one = with(1);
    assert!(one == with(2) && one == with(7));
}

#[test]
fn hc25_hc26_a_pixel_that_is_not_finite_is_filled_and_spoils_no_other() {
    let frame = room(70, 40, 1.0);
    let without = values(&denoise(&frame));
    let bad = 20 * 70 + 30;
    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let mut spoiled = frame.clone();
        for name in ["R", "a.R", "diffuse.R", "diffuse.a.R", "diffuse.variance.R"] {
            let mut plane = spoiled.channel(name).expect("is there").to_vec();
            plane[bad] = value;
            spoiled.insert(name, plane);
        }
        let clean = denoise(&spoiled);
        let out = values(&clean);
        assert!(out.iter().all(|v| v.is_finite()));
        assert!((out[bad] - without[bad]).abs() < 0.05 * without[bad], "{} for {}", out[bad], without[bad]);
        for (p, (a, e)) in out.iter().zip(&without).enumerate() {
            let far = (p % 70).abs_diff(30).max((p / 70 % 40).abs_diff(20)) > 30;
            assert!(!far || (a - e).abs() <= 0.01 * e, "value {p}: {a} for {e}");
        }
        let record = &clean.metadata["limpid:denoise"];
        assert!(record.ends_with("; pixels filled 1"), "{record}");
    }
}

#[test]
fn hc25_a_channel_without_a_finite_value_leaves_the_answer_finite() {
    for name in
        ["R", "diffuse.G", "diffuse.a.G", "specular.variance.B", "emission.R", "albedo.G", "normal.a.X"]
    {
        let mut frame = room(20, 20, 1.0);
        frame.insert(name, vec![f32::NAN; 400]);
        assert!(values(&denoise(&frame)).iter().all(|v| v.is_finite()), "{name}");
    }
}

#[test]
fn hc27_a_firefly_stays_where_it_is() {
    let frame = room(110, 30, 1.0);
    let without = values(&denoise(&frame));
    for value in [1e3, 1e5, 1e10, 1e30] {
        let mut spoiled = frame.clone();
        for name in ["R", "a.R", "diffuse.R", "diffuse.a.R"] {
            let mut plane = spoiled.channel(name).expect("is there").to_vec();
            plane[15 * 110 + 10] = value;
            spoiled.insert(name, plane);
        }
        let mut variance = spoiled.channel("diffuse.variance.R").expect("is there").to_vec();
        variance[15 * 110 + 10] = value * value;
        spoiled.insert("diffuse.variance.R", variance);
        for (p, (a, e)) in values(&denoise(&spoiled)).iter().zip(&without).enumerate() {
            assert!(a.is_finite());
            assert!(p % 110 < 60 || (a - e).abs() <= 0.05 * e, "{value}, value {p}: {a} for {e}");
        }
    }
}

#[test]
fn hc28_negative_radiance_keeps_its_mean() {
    let n = 128 * 128;
    // Sums of twelve uniform numbers: standard deviation 0.5 · √2 in a half.
    let half = |seed: u64| -> Vec<f32> {
        let draws: Vec<Plane> = (0..12).map(|i| random(3 * n, 100 * seed + i)).collect();
        let sum = |i: usize| draws.iter().map(|draw| draw[i]).sum::<f32>();
        (0..3 * n).map(|i| std::f32::consts::FRAC_1_SQRT_2 * (sum(i) - 6.0)).collect()
    };
    let (a, b) = (half(1), half(2));
    let color: Vec<f32> = a.iter().zip(&b).map(|(a, b)| 0.5 * (a + b)).collect();
    let buffers =
        Buffers { width: 128, height: 128, color: &color, halves: Some([&a, &b]), ..Default::default() };
    let clean = denoise_buffers(&JointNlm::default(), &buffers).expect("fits");
    let mean = |x: &[f32]| x.iter().map(|v| f64::from(*v)).sum::<f64>() / x.len() as f64;
    // The mean's standard deviation is 0.002; what is allowed is a tenth of a cut-off at zero's bias.
    assert!((mean(&clean) - mean(&color)).abs() < 0.02, "{} for {}", mean(&clean), mean(&color));
}

#[test]
fn hc29_hc30_constants_are_fixpoints() {
    for color in [[0.0; 3], [1e-3; 3], [0.18; 3], [1.0, 0.1, 0.01], [1e3; 3], [-0.25; 3]] {
        let planes = color.map(|v| vec![v; 40 * 30]);
        assert_close(&values(&denoise(&noise_free(40, 30, &planes))), &planes.concat(), 1e-6);
        let buffer: Vec<f32> = color.repeat(40 * 30);
        let alone = Buffers { width: 40, height: 30, color: &buffer, ..Buffers::default() };
        assert_close(&denoise_buffers(&JointNlm::default(), &alone).expect("fits"), &buffer, 1e-6);
    }
}

#[test]
fn hc31_constant_features_carry_nothing() {
    let plain = room(48, 48, 1.0);
    let color = plain.rgb().expect("is there");
    let color: Vec<f32> = (0..48 * 48).flat_map(|p| color.map(|plane| plane[p])).collect();
    let without = Buffers { width: 48, height: 48, color: &color, ..Buffers::default() };
    let normal = [0.0, 0.0, 1.0].repeat(48 * 48);
    let with = Buffers { normal: Some(&normal), ..without };
    let [a, b] = [without, with].map(|b| denoise_buffers(&JointNlm::default(), &b).expect("fits"));
    assert_close(&a, &b, 1e-6);
}

#[test]
fn hc32_a_picture_without_noise_comes_back() {
    for side in [1, 4, 16] {
        let texture: Plane = (0..64 * 64)
            .map(|p| ((p % 64) / side * 7 + p / 64 / side * 13) as f32 % 5.0 / 4.0 + 0.1)
            .collect();
        let frame = noise_free(64, 64, &vec![texture; 3]);
        assert_close(&values(&denoise(&frame)), &values(&frame), 1e-6);
    }
}

#[test]
fn hc33_one_sample_is_filtered_by_a_level_found_in_the_picture() {
    let mut frame = room(64, 64, 1.0);
    let all: Vec<String> = frame.channels().map(|(name, _)| name.to_owned()).collect();
    for name in all {
        if name.contains("a.") || name.contains("b.") {
            frame.remove(&name);
        } else if name.contains("variance.") {
            frame.insert(name, vec![-1.0; 64 * 64]);
        }
    }
    let clean = denoise(&frame);
    let spread = |frame: &Frame| {
        // Along a column the light is straight but for the noise.
        let plane = frame.channel("G").expect("is there");
        (64..63 * 64).map(|p| (plane[p - 64] - 2.0 * plane[p] + plane[p + 64]).powi(2)).sum::<f32>()
    };
    assert!(spread(&clean) < 0.2 * spread(&frame), "{} of {}", spread(&clean), spread(&frame));
    let record = &clean.metadata["limpid:denoise"];
    assert!(record.contains("; no halves: one pass"), "{record}");
}

#[test]
fn hc34_an_albedo_of_zero_neither_kills_nor_blows_up() {
    for albedo in [0.0, 1e-40, 1e-6] {
        let planes = vec![vec![5.0; 30 * 20]; 3];
        let mut frame = noise_free(30, 20, &planes);
        for layer in [Layer::Albedo, Layer::DiffuseAlbedo] {
            for statistic in [Statistic::Mean, Statistic::A, Statistic::B] {
                frame.insert_layer(layer, statistic, vec![vec![albedo; 30 * 20]; 3]);
            }
        }
        assert_close(&values(&denoise(&frame)), &planes.concat(), 1e-6);
    }
}

#[test]
fn hc35_hc42_exposure_times_two_to_the_k_gives_the_same_bits() {
    let base = values(&denoise(&room(40, 30, 1.0)));
    for k in [1, 10, -10, 20, -20, 40, -40, 50, -50] {
        let factor = 2.0_f32.powi(k);
        let scaled = values(&denoise(&room(40, 30, factor)));
        let expected: Vec<f32> = base.iter().map(|v| factor * v).collect();
        assert_eq!(scaled, expected, "2^{k}");
    }
}

#[test]
fn hc35_at_extreme_exposures_where_variances_leave_the_range_noise_still_shrinks() {
    for k in [100, -100] {
        let frame = room(40, 30, 2.0_f32.powi(k));
        let (noisy, clean) = (frame.channel("G").expect("is there"), denoise(&frame));
        let clean = clean.channel("G").expect("is there");
        let spread = |plane: &[f32]| {
            let change = |p: usize| (2.0_f32.powi(-k) * (plane[p] - plane[p + 1])).powi(2);
            (0..39 * 30).filter(|p| p % 40 < 18).map(change).sum::<f32>()
        };
        assert!(spread(clean) < 0.1 * spread(noisy), "2^{k}: {} of {}", spread(clean), spread(noisy));
    }
}

#[test]
fn hc36_denormals_come_back() {
    for value in [1e-36, 1e-39, 1e-44] {
        let planes = vec![vec![value; 12 * 9]; 3];
        let out = values(&denoise(&noise_free(12, 9, &planes)));
        assert!(
            out.iter().all(|v| v.to_bits().abs_diff(value.to_bits()) <= 1 || (v / value - 1.0).abs() < 1e-6)
        );
    }
}

#[test]
fn hc37_features_that_are_not_finite_matter_only_where_they_are() {
    let frame = room(40, 90, 1.0);
    let without = values(&denoise(&frame));
    for name in ["albedo.R", "normal.Y"] {
        for value in [f32::NAN, f32::INFINITY, 1e30] {
            let mut spoiled = frame.clone();
            for prefix in ["", "a.", "b."] {
                let name = name.replace('.', &format!(".{prefix}"));
                let mut plane = spoiled.channel(&name).expect("is there").to_vec();
                plane[..16 * 40].fill(value);
                spoiled.insert(name, plane);
            }
            for (p, (a, e)) in values(&denoise(&spoiled)).iter().zip(&without).enumerate() {
                assert!(a.is_finite());
                let far = p % (40 * 90) >= 48 * 40;
                assert!(!far || (a - e).abs() <= 0.01 * e, "{name} {value}, value {p}: {a} for {e}");
            }
        }
    }
}

#[test]
fn hc38_pictures_smaller_than_the_window_are_no_matter() {
    for (width, height) in [(1, 1), (2, 1), (3, 3), (97, 1), (13, 17), (31, 33)] {
        let planes = vec![vec![0.5; width * height]; 3];
        assert_close(&values(&denoise(&noise_free(width, height, &planes))), &planes.concat(), 1e-6);
        assert!(values(&denoise(&room(width, height, 1.0))).iter().all(|v| v.is_finite()));
    }
    let mut empty = Frame::default();
    empty.insert_layer(Layer::Beauty, Statistic::Mean, vec![Vec::new(); 3]);
    assert!(values(&denoise(&empty)).is_empty());
}

#[test]
fn without_a_beauty_the_missing_channel_is_named() {
    let error = JointNlm::default().denoise(&Frame::new(2, 2)).expect_err("nothing is there");
    assert_eq!(error.to_string(), "the frame has no channel `R`");
}

#[test]
fn components_that_do_not_add_up_lose_nothing() {
    let mut frame = room(30, 30, 1.0);
    for name in ["R", "G", "B", "a.R", "a.G", "a.B", "b.R", "b.G", "b.B"] {
        let fog: Plane = frame.channel(name).expect("is there").iter().map(|v| v + 0.5).collect();
        frame.insert(name, fog);
    }
    let clean = denoise(&frame);
    let mean = |frame: &Frame| values(frame).iter().sum::<f32>() / 2700.0;
    assert!((mean(&clean) - mean(&frame)).abs() < 0.01, "{} for {}", mean(&clean), mean(&frame));
    assert!(clean.metadata["limpid:denoise"].contains("; filtered as a whole: its components do not add up"));
}
