use super::*;

/// Horizontal irradiance by a picture of the sky.
fn irradiance(image: &Image) -> [f64; 3] {
    let Texels::Linear32(texels) = &image.texels else { panic!("{:?}", image.texels) };
    let (w, h) = (f64::from(image.width), f64::from(image.height - 1));
    let mut sum = [0.0; 3];
    for (i, texel) in texels.chunks(3).enumerate() {
        let theta = PI * (i / image.width as usize) as f64 / h;
        let weight = theta.sin() * theta.cos().max(0.0) * PI / h * 2.0 * PI / w;
        sum.iter_mut().zip(texel).for_each(|(s, &t)| *s += weight * f64::from(t));
    }
    sum
}

fn sun_at(elevation_deg: f64) -> DVec3 {
    let (sin, cos) = elevation_deg.to_radians().sin_cos();
    DVec3::new(cos, sin, 0.0)
}

/// Elevation, and for the turbidities 1.5, 3.5, 5.5 and 9 the irradiance of sky (level) and sun (across) in Mitsuba 3.9.1.
type Row = (f64, [([f64; 3], [f64; 3]); 4]);

#[rustfmt::skip]
const MITSUBA: [Row; 4] = [
    (7.0, [
        ([0.0690, 0.1031, 0.1322], [0.9549, 0.5094, 0.1240]),
        ([0.0953, 0.1190, 0.1347], [0.7323, 0.3835, 0.0959]),
        ([0.1225, 0.1350, 0.1372], [0.4860, 0.2472, 0.0643]),
        ([0.1577, 0.1474, 0.1326], [0.1123, 0.0513, 0.0151]),
    ]),
    (19.0, [
        ([0.0896, 0.1588, 0.2508], [1.3455, 0.9849, 0.5445]),
        ([0.1424, 0.1974, 0.2652], [1.2168, 0.8820, 0.4903]),
        ([0.2068, 0.2426, 0.2805], [1.0425, 0.7442, 0.4173]),
        ([0.3121, 0.3070, 0.3039], [0.5898, 0.3980, 0.2306]),
    ]),
    (35.0, [
        ([0.1065, 0.1948, 0.3507], [1.4760, 1.1878, 0.8251]),
        ([0.1777, 0.2545, 0.3839], [1.3946, 1.1154, 0.7774]),
        ([0.2739, 0.3345, 0.4282], [1.2779, 1.0130, 0.7093]),
        ([0.5108, 0.5195, 0.5350], [0.9262, 0.7101, 0.5064]),
    ]),
    (65.0, [
        ([0.1247, 0.2260, 0.4353], [1.5431, 1.3001, 1.0090]),
        ([0.2034, 0.2986, 0.4980], [1.4885, 1.2493, 0.9715]),
        ([0.3123, 0.4041, 0.5779], [1.4088, 1.1754, 0.9169]),
        ([0.6728, 0.7532, 0.8184], [1.1497, 0.9385, 0.7407]),
    ]),
];

/// Elevation and azimuth of a direction, the latter from the sun, and its radiance in Mitsuba 3.9.1 at turbidity 3.
type Seen = (f64, [([f64; 2], [f64; 3]); 4]);

#[rustfmt::skip]
const SEEN: [Seen; 3] = [
    (15.0, [
        ([90.0, 0.0], [0.0101, 0.0209, 0.0391]), ([25.0, 0.0], [0.1867, 0.1915, 0.1724]),
        ([5.0, 180.0], [0.1259, 0.1645, 0.1597]), ([30.0, 90.0], [0.0284, 0.0485, 0.0731]),
    ]),
    (45.0, [
        ([90.0, 0.0], [0.0237, 0.0415, 0.0841]), ([55.0, 0.0], [0.1119, 0.1348, 0.1763]),
        ([5.0, 180.0], [0.1381, 0.2018, 0.2676]), ([30.0, 90.0], [0.0401, 0.0722, 0.1337]),
    ]),
    (75.0, [
        ([90.0, 0.0], [0.0806, 0.1023, 0.1491]), ([85.0, 0.0], [0.1036, 0.1271, 0.1693]),
        ([5.0, 180.0], [0.1292, 0.1894, 0.2656]), ([30.0, 90.0], [0.0465, 0.0831, 0.1532]),
    ]),
];

#[test]
fn irradiance_is_that_of_mitsuba_between_the_knots_of_the_table() {
    let mut largest: f64 = 0.0;
    for (elevation, row) in MITSUBA {
        for (turbidity, (of_sky, of_sun)) in [1.5, 3.5, 5.5, 9.0].into_iter().zip(row) {
            let sun = sun_at(elevation);
            let ours = [irradiance(&sky(sun, turbidity)), sun_irradiance(sun, turbidity)];
            for (ours, theirs) in ours.as_flattened().iter().zip([of_sky, of_sun].as_flattened()) {
                largest = largest.max((ours / theirs - 1.0).abs());
            }
        }
    }
    assert!(largest < 0.02, "{largest}");
}

/// Prints the table in this module's documentation: `cargo test -p limpid-scenes daylight -- --nocapture`.
#[test]
fn the_sky_differs_from_mitsubas_where_the_documentation_says() {
    for (elevation, row) in SEEN {
        let image = sky(sun_at(elevation), 3.0);
        let Texels::Linear32(texels) = &image.texels else { panic!() };
        let mut line = format!("//! {elevation:>4}°");
        for ([altitude, azimuth], theirs) in row {
            // the sun is at +x, a quarter of a turn from the middle of the row
            let column = (0.5 - (90.0 + azimuth) / 360.0).rem_euclid(1.0) * f64::from(image.width);
            let row = (90.0 - altitude) / 180.0 * f64::from(image.height - 1);
            let at = 3 * (row.round() as usize * image.width as usize + column as usize);
            let ratio = [0, 1, 2].map(|c| f64::from(texels[at + c]) / theirs[c]);
            line += &format!("    {:.2} {:.2}", ratio[0], ratio[2]);
            assert!(
                ratio.iter().all(|r| (0.2..4.5).contains(r)),
                "{elevation} {altitude} {azimuth}: {ratio:?}"
            );
        }
        println!("{line}");
    }
}

#[test]
fn skies_are_finite_and_black_below_the_horizon() {
    for elevation in [1e-9, 0.3, 45.0, 90.0] {
        for turbidity in [1.0, 2.0, 10.0] {
            let image = sky(sun_at(elevation), turbidity);
            let Texels::Linear32(texels) = &image.texels else { panic!() };
            assert_eq!(texels.len(), (image.width * image.height * 3) as usize);
            assert!(texels.iter().all(|t| t.is_finite() && *t >= 0.0));
            let below = (image.height / 2 + 1) as usize * image.width as usize * 3;
            assert!(texels[below..].iter().all(|t| *t == 0.0));
            assert!(texels[..below].iter().any(|t| *t > 0.0));
        }
    }
}

#[test]
fn the_sky_is_brightest_around_the_sun() {
    // +x is at three quarters of a row
    let image = sky(sun_at(45.0), 3.0);
    let Texels::Linear32(texels) = &image.texels else { panic!() };
    let brightest =
        (0..texels.len() / 3).max_by(|a, b| texels[3 * a + 1].total_cmp(&texels[3 * b + 1])).unwrap();
    let (column, row) = (brightest % image.width as usize, brightest / image.width as usize);
    let longitude = 0.5 - (column as f64 + 0.5) / f64::from(image.width);
    assert!((longitude - 0.25).abs() < 0.02, "column {column}");
    assert!((row as f64 / f64::from(image.height - 1) - 0.25).abs() < 0.02, "row {row}");
}
