use super::*;

#[test]
fn all_zero_weights_make_no_distribution() {
    assert!(Distribution1d::new([]).is_none());
    assert!(Distribution1d::new([0.0, -1.0, f64::NAN, f64::INFINITY]).is_none());
    assert!(Distribution2d::new(3, 2, |_, _| 0.0).is_none());
    assert!(Distribution2d::new(0, 0, |_, _| 1.0).is_none());
}

#[test]
fn cells_without_weight_are_never_drawn() {
    let weights = [0.0, 1.0, 0.0, 1e-300, f64::NAN, 3.0, 0.0];
    let row = Distribution1d::new(weights).unwrap();
    let grid = Distribution2d::new(7, 7, |x, y| weights[x] * weights[y]).unwrap();
    for u in [0.0, 0.25, 0.249999999, 0.25000000001, 0.5, BELOW_ONE, f64::from(f32::MAX)] {
        assert!([1, 3, 5].contains(&row.sample(u).0), "{u}");
        let ([x, y], _) = grid.sample([u, u]);
        assert!([1, 5].contains(&x) && [1, 5].contains(&y), "{u}: {x} {y}");
    }
}

#[test]
fn equal_steps_of_u_fall_into_cells_as_often_as_their_weights_say() {
    let weights = [1.0, 0.0, 2.0, 5.0, 0.25, 8.0];
    let total: f64 = weights.iter().sum();
    let row = Distribution1d::new(weights).unwrap();
    let grid = Distribution2d::new(6, 6, |x, y| weights[x] * weights[y]).unwrap();
    // The steps are the midpoints of an even grid, so that each count is right to one (no chance is involved).
    let n = 650;
    let mut counts = [0.0; 6];
    let mut counts2 = [[0.0; 6]; 6];
    let at = |i: usize| (i as f64 + 0.5) / n as f64;
    for i in 0..n {
        counts[row.sample(at(i)).0] += 1.0;
        for j in 0..n {
            let ([x, y], _) = grid.sample([at(i), at(j)]);
            counts2[y][x] += 1.0;
        }
    }
    for i in 0..6 {
        let expected = n as f64 * weights[i] / total;
        assert!((counts[i] - expected).abs() <= 1.0, "{i}: {} not {expected}", counts[i]);
        assert!((row.pmf(i) - weights[i] / total).abs() < 1e-15);
        for j in 0..6 {
            let expected = expected * weights[j] / total * n as f64;
            let slack = n as f64 * (weights[i] + weights[j]) / total + 1.0;
            assert!((counts2[j][i] - expected).abs() <= slack, "{i} {j}: {} not {expected}", counts2[j][i]);
        }
    }
    assert_eq!(row.pmf(6), 0.0);
}

#[test]
fn what_is_left_of_u_runs_through_the_cell() {
    let row = Distribution1d::new([1.0, 3.0]).unwrap();
    assert_eq!(row.sample(0.0), (0, 0.0));
    assert_eq!(row.sample(0.125), (0, 0.5));
    assert_eq!(row.sample(0.625), (1, 0.5));
    let grid = Distribution2d::new(2, 2, |x, y| [1.0, 3.0][x] * [1.0, 3.0][y]).unwrap();
    let (cell, rest) = grid.sample([0.4375, 0.0625]);
    assert_eq!((cell, rest), ([1, 0], [0.25, 0.25]));
    for u in [0.2499999999, BELOW_ONE] {
        assert!(row.sample(u).1 < 1.0);
        assert!(grid.sample([u, u]).1.iter().all(|&x| x < 1.0));
    }
}
