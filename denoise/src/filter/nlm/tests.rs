use super::*;

/// Uniform in [0, 1).
pub(crate) fn random(n: usize, seed: u64) -> Plane {
    let mut state = seed;
    (0..n)
        .map(|_| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 40) as f32 / 16_777_216.0
        })
        .collect()
}

fn planes(size: Size, count: u64, seed: u64) -> Vec<Plane> {
    (0..count).map(|c| random(size.len(), 100 * seed + c)).collect()
}

/// [(u_p − u_q)² − (V_p + min(V_p, V_q))] / (D_p + D_q), mean over channels, at pixels inside the image.
fn distance(mean: &[Plane], variance: &[Plane], denominator: &[Plane], k2: f64, p: usize, q: usize) -> f64 {
    let at = |planes: &[Plane], c: usize, p: usize| f64::from(planes[c][p]);
    let sum: f64 = (0..mean.len())
        .map(|c| {
            let difference = at(mean, c, p) - at(mean, c, q);
            let (v_p, v_q) = (at(variance, c, p), at(variance, c, q));
            (difference * difference - (v_p + v_p.min(v_q)))
                / (k2 * (at(denominator, c, p) + at(denominator, c, q)))
        })
        .sum();
    sum / mean.len() as f64
}

/// The formula as the module states it, pixel by pixel, in double precision.
struct Slow<'a> {
    size: Size,
    window: &'a Window,
    guide: &'a Guide<'a>,
    buffer: &'a Buffer<'a>,
    features: &'a [Feature],
}

impl Slow<'_> {
    fn at(&self, x: i64, y: i64) -> Option<usize> {
        let inside = (0..self.size.width as i64).contains(&x) && (0..self.size.height as i64).contains(&y);
        inside.then(|| y as usize * self.size.width + x as usize)
    }

    /// Mean of a value of pixel pairs over the patch around (x, y) and its counterpart at the offset.
    fn over_patch(&self, (x, y): (i64, i64), (dx, dy): (i64, i64), value: &dyn Fn(i64, i64) -> f64) -> f64 {
        let f = self.window.patch as i64;
        let (mut sum, mut count) = (0.0, 0.0);
        for j in y - f..=y + f {
            for i in x - f..=x + f {
                if self.at(i, j).is_some() && self.at(i + dx, j + dy).is_some() {
                    sum += value(i, j);
                    count += 1.0;
                }
            }
        }
        sum / count
    }

    fn weight(&self, (x, y): (i64, i64), (dx, dy): (i64, i64)) -> f64 {
        let (mean, variance) = (self.buffer.mean, self.guide.variance);
        let pair = |i, j| {
            let q = self.at(i + dx, j + dy).expect("both ends are inside");
            (self.at(i, j).expect("both ends are inside"), q)
        };
        let k2 = f64::from(self.guide.k).powi(2);
        let pixel = |i, j| {
            let (p, q) = pair(i, j);
            distance(mean, variance, variance, k2, p, q)
        };
        let patch = |i, j| self.over_patch((i, j), (dx, dy), &pixel);
        let color = |i, j| (-patch(i, j).max(0.0)).exp();
        let color = if self.window.average { self.over_patch((x, y), (dx, dy), &color) } else { color(x, y) };
        let (p, q) = pair(x, y);
        let mut exponent = (dx * dx + dy * dy) as f64 / (2.0 * f64::from(self.guide.sigma_spatial).powi(2));
        for f in self.features {
            exponent = exponent.max(distance(&f.mean, &f.variance, &f.denominator, 1.0, p, q));
        }
        color.min((-exponent).exp())
    }

    fn filtered(&self, target: &Plane, x: usize, y: usize) -> f64 {
        let r = self.window.radius as i64;
        let (x, y) = (x as i64, y as i64);
        let (mut sum, mut weights) = (0.0, 0.0);
        for dy in -r..=r {
            for dx in -r..=r {
                let Some(q) = self.at(x + dx, y + dy) else { continue };
                let weight = if (dx, dy) == (0, 0) { 1.0 } else { self.weight((x, y), (dx, dy)) };
                sum += weight * f64::from(target[q]);
                weights += weight;
            }
        }
        sum / weights
    }
}

#[test]
fn the_filter_is_its_formula_in_double_precision() {
    let size = Size { width: 69, height: 11 }; // more than one tile, and smaller than the window
    let small = |planes: Vec<Plane>, scale: f32| -> Vec<Plane> {
        planes.into_iter().map(|plane| plane.iter().map(|v| scale * v).collect()).collect()
    };
    let feature = |channels, seed| {
        let variance = small(planes(size, channels, seed + 1), 0.05);
        let denominator = variance.iter().map(|plane| plane.iter().map(|v| v.max(0.01)).collect()).collect();
        Feature { mean: planes(size, channels, seed), variance, denominator }
    };
    let features = [feature(3, 10), feature(1, 20)];
    let (a, b) = (planes(size, 3, 1), planes(size, 3, 2));
    let variance = small(planes(size, 3, 3), 0.2);
    for (patch, average, sigma_spatial, k) in
        [(1, false, f32::INFINITY, 0.45), (2, true, 2.5, 1.0), (0, true, 4.0, 0.7)]
    {
        let window = Window { radius: 4, patch, average };
        let buffers = vec![Buffer { mean: &a, targets: &b }, Buffer { mean: &b, targets: &a }];
        let guides = [Guide { k, sigma_spatial, variance: &variance, buffers }];
        let fast = filter(size, &window, &guides, &features);
        for (buffer, fast) in guides[0].buffers.iter().zip(&fast) {
            let slow = Slow { size, window: &window, guide: &guides[0], buffer, features: &features };
            for (target, fast) in buffer.targets.iter().zip(fast) {
                for (p, &value) in fast.iter().enumerate() {
                    let expected = slow.filtered(target, p % size.width, p / size.width);
                    let error = (f64::from(value) - expected).abs();
                    assert!(error <= 1e-5, "{window:?}, pixel {p}: {value} for {expected}");
                }
            }
        }
    }
}

/// Planes that filter themselves.
fn alone<'a>(mean: &'a [Plane], variance: &'a [Plane]) -> Guide<'a> {
    Guide { k: 0.7, sigma_spatial: 3.0, variance, buffers: vec![Buffer { mean, targets: mean }] }
}

#[test]
fn a_pixel_without_noise_stays_as_it_is() {
    let size = Size { width: 80, height: 40 };
    let mean = planes(size, 2, 6);
    // The left half is free of noise in both channels, the middle in one.
    let noise = |end: usize| -> Plane {
        (0..size.len()).map(|p| if p % size.width < end { 0.0 } else { 0.3 }).collect()
    };
    let variance = [noise(40), noise(50)];
    let window = Window { radius: 3, patch: 1, average: true };
    let filtered = filter(size, &window, &[alone(&mean, &variance)], &[]);
    for (mean, filtered) in mean.iter().zip(&filtered[0]) {
        for (p, (mean, filtered)) in mean.iter().zip(filtered).enumerate() {
            match p % size.width {
                0..40 => assert_eq!(filtered, mean, "pixel {p}"),
                50..80 => assert_ne!(filtered, mean, "pixel {p}"),
                _ => {}
            }
        }
    }
}

#[test]
fn hc39_weights_that_underflow_leave_the_centre() {
    let size = Size { width: 9, height: 9 };
    let mut mean = vec![1e6; size.len()];
    mean[4 * 9 + 4] = 1.0;
    let variance = [vec![1e-6; size.len()]];
    let window = Window { radius: 3, patch: 0, average: false };
    let mean = [mean];
    let guide = alone(&mean, &variance);
    assert_eq!(filter(size, &window, &[guide], &[])[0][0][4 * 9 + 4], 1.0);
}

#[test]
fn a_window_filter_does_not_depend_on_where_its_tiles_begin() {
    let whole = Size { width: 150, height: 40 };
    let part = Size { width: 149, height: 39 };
    let cut = |plane: &Plane| -> Plane {
        plane.chunks(whole.width).skip(1).flat_map(|row| row[1..].to_vec()).collect()
    };
    let mean = planes(whole, 1, 5);
    let variance = [vec![0.02; whole.len()]];
    let window = Window { radius: 5, patch: 2, average: true };
    let filtered = filter(whole, &window, &[alone(&mean, &variance)], &[]);
    let (cut_mean, cut_variance) = ([cut(&mean[0])], [cut(&variance[0])]);
    let guide = alone(&cut_mean, &cut_variance);
    let shifted = filter(part, &window, &[guide], &[]);
    let expected = cut(&filtered[0][0]);
    let reach = window.radius + 2 * window.patch; // of the border that was cut off
    for y in reach..part.height {
        for x in reach..part.width {
            let p = y * part.width + x;
            assert_eq!(shifted[0][0][p], expected[p], "pixel {x}, {y}");
        }
    }
}
