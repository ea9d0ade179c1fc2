use limpid_frame::{Layer, Statistic};

use super::*;

fn film_of(values: &[f32]) -> Film {
    let mut film = Film::new([0, 0], 1, 1, 16, &LayerRequest::all());
    let (plan, tiles) = film.parts();
    for (i, &value) in values.iter().enumerate() {
        let mut sample = Sample::ZERO;
        sample.set(Layer::Beauty, [value, 2.0 * value, 0.0]);
        if value > 0.0 {
            sample.set(Layer::Hit, [1.0]);
            sample.set(Layer::Depth, [value]);
        }
        tiles[0].add(plan, 0, i as u32, &sample);
        tiles[0].samples += 1;
    }
    film
}

fn value(film: &Film, layer: Layer, statistic: Statistic) -> f32 {
    film.develop().layer(layer, statistic).unwrap()[0][0]
}

#[test]
fn mean_variance_and_halves_are_those_of_the_samples() {
    let film = film_of(&[4.0, 7.0, 13.0, 16.0]);
    assert_eq!(value(&film, Layer::Beauty, Statistic::Mean), 10.0);
    assert_eq!(value(&film, Layer::Beauty, Statistic::Variance), 30.0 / 4.0);
    assert_eq!(value(&film, Layer::Beauty, Statistic::A), 8.5);
    assert_eq!(value(&film, Layer::Beauty, Statistic::B), 11.5);
}

#[test]
fn variance_survives_a_large_mean() {
    let film = film_of(&[4.0, 7.0, 13.0, 16.0].map(|x| x + 1e6));
    assert_eq!(value(&film, Layer::Beauty, Statistic::Variance), 30.0 / 4.0);
}

#[test]
fn variance_of_one_sample_is_unknown_and_it_has_no_halves() {
    let film = film_of(&[3.0]);
    assert_eq!(value(&film, Layer::Beauty, Statistic::Variance), -1.0);
    assert!(film.develop().layer(Layer::Beauty, Statistic::A).is_none());
    assert!(film.beauty_halves().is_none());
}

#[test]
fn depth_is_averaged_over_the_samples_that_hit() {
    let film = film_of(&[0.0, 4.0, 0.0, 7.0, 13.0, 16.0]);
    assert_eq!(value(&film, Layer::Depth, Statistic::Mean), 10.0);
    assert_eq!(value(&film, Layer::Depth, Statistic::Variance), 30.0 / 4.0);
    assert_eq!(value(&film, Layer::Depth, Statistic::A), 13.0);
    assert_eq!(value(&film, Layer::Hit, Statistic::Mean), 4.0 / 6.0);
}

#[test]
fn sixteen_million_equal_samples_have_their_value_as_mean() {
    let mut film = Film::new([0, 0], 1, 1, 1, &LayerRequest::beauty());
    let (plan, tiles) = film.parts();
    let mut sample = Sample::ZERO;
    sample.set(Layer::Beauty, [0.1; 3]);
    for i in 0..1 << 24 {
        tiles[0].add(plan, 0, i, &sample);
    }
    tiles[0].samples = 1 << 24;
    assert_eq!(value(&film, Layer::Beauty, Statistic::Mean), 0.1);
}
