//! Polygons into triangles.

use glam::{DVec2, DVec3};

/// Ear clipping takes cubic time at worst; a longer polygon is cut into a fan.
const MAX_CLIPPED: usize = 256;
/// Steps of ear clipping for one file: about a second, whatever it holds.
pub(super) const BUDGET: u64 = 1 << 30;

/// Cuts a polygon with the corners `points` into triangles of corner numbers, with the same orientation:
/// a fan from corner 0 where it is convex, else by ear clipping (Meisters 1975) in the plane of its Newell normal.
///
/// `budget` bounds the steps of ear clipping over a whole file; when it is used up, the rest become fans.
pub(super) fn triangulate(points: &[DVec3], budget: &mut u64, mut emit: impl FnMut([usize; 3])) {
    let n = points.len();
    if n <= 3 {
        if n == 3 {
            emit([0, 1, 2]);
        }
        return;
    }
    // a fan around a corner that is no number: all triangles have it, so that the face is dropped whole
    if let Some(bad) = points.iter().position(|p| !p.is_finite()) {
        (1..n - 1).for_each(|i| emit([bad, (bad + i) % n, (bad + i + 1) % n]));
        return;
    }
    let flat = project(points);
    let is_convex = (0..n).all(|i| turn(flat[(i + n - 1) % n], flat[i], flat[(i + 1) % n]) >= 0.0);
    let steps = (n * n * n) as u64;
    if is_convex || n > MAX_CLIPPED || *budget < steps {
        (1..n - 1).for_each(|i| emit([0, i, i + 1]));
        return;
    }
    *budget -= steps;
    clip_ears(&flat, emit);
}

/// Cuts off ears one after the other. Where no corner is an ear, as in a polygon that crosses itself, the next corner goes.
fn clip_ears(flat: &[DVec2], mut emit: impl FnMut([usize; 3])) {
    let mut ring: Vec<usize> = (0..flat.len()).collect();
    let mut at = 0;
    while ring.len() > 3 {
        let n = ring.len();
        let ear = (0..n).map(|k| (at + k) % n).find(|&i| is_ear(flat, &ring, i)).unwrap_or(at % n);
        emit([ring[(ear + n - 1) % n], ring[ear], ring[(ear + 1) % n]]);
        ring.remove(ear);
        at = ear; // go on behind the ear: starting over would make thin fans
    }
    emit([ring[0], ring[1], ring[2]]);
}

/// Whether the triangle at corner `i` of the ring turns left and holds no other corner.
fn is_ear(flat: &[DVec2], ring: &[usize], i: usize) -> bool {
    let n = ring.len();
    let (before, after) = ((i + n - 1) % n, (i + 1) % n);
    let [a, b, c] = [before, i, after].map(|k| flat[ring[k]]);
    if turn(a, b, c) <= 0.0 {
        return false;
    }
    let inside = |p: DVec2| turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
    let others = (0..n).filter(|k| ![before, i, after].contains(k)).map(|k| flat[ring[k]]);
    !others.into_iter().any(|p| p != a && p != b && p != c && inside(p))
}

/// Twice the signed area of a triangle; positive where it turns left.
fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

/// Onto the coordinate plane that the polygon faces most, counter-clockwise.
fn project(points: &[DVec3]) -> Vec<DVec2> {
    let n = points.len();
    let normal: DVec3 = (0..n).map(|i| (points[i] - points[0]).cross(points[(i + 1) % n] - points[0])).sum();
    let size = normal.abs();
    let flat = |p: &DVec3| {
        if size.x > size.y && size.x > size.z {
            DVec2::new(p.y, p.z * normal.x.signum())
        } else if size.y > size.z {
            DVec2::new(p.z, p.x * normal.y.signum())
        } else {
            DVec2::new(p.x, p.y * normal.z.signum())
        }
    };
    points.iter().map(flat).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(points: &[DVec3], mut budget: u64) -> Vec<[usize; 3]> {
        let mut triangles = Vec::new();
        triangulate(points, &mut budget, |t| triangles.push(t));
        triangles
    }

    /// Normals of the triangles times twice their area.
    fn areas(points: &[DVec3], triangles: &[[usize; 3]]) -> Vec<DVec3> {
        let area = |t: &[usize; 3]| (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
        triangles.iter().map(area).collect()
    }

    /// A star with `2 × tips` corners in the plane of the axes `u`, `v`.
    fn star(tips: usize, u: DVec3, v: DVec3) -> Vec<DVec3> {
        let corner = |i: usize| {
            let (sin, cos) = (i as f64 * std::f64::consts::PI / tips as f64).sin_cos();
            (u * cos + v * sin) * if i.is_multiple_of(2) { 1.0 } else { 0.3 }
        };
        (0..2 * tips).map(corner).collect()
    }

    #[test]
    fn a_concave_polygon_is_covered_once_whichever_way_it_faces() {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        for (u, v) in [(0, 1), (1, 0), (1, 2), (2, 1), (2, 0), (0, 2)].map(|(i, j)| (axes[i], axes[j])) {
            let points = star(32, u, v);
            let triangles = cut(&points, u64::MAX);
            assert_eq!(triangles.len(), points.len() - 2);
            let areas = areas(&points, &triangles);
            // none is turned over, so none overlap where the sum is the polygon's area
            assert!(areas.iter().all(|a| a.dot(u.cross(v)) >= 0.0));
            let total: f64 = areas.iter().map(|a| 0.5 * a.length()).sum();
            let exact = 32.0 * 0.3 * (std::f64::consts::PI / 32.0).sin();
            assert!((total - exact).abs() < 1e-12, "{total} for {exact}");
        }
    }

    #[test]
    fn convex_polygons_and_those_beyond_the_budget_become_fans() {
        let square = [DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y];
        assert_eq!(cut(&square, u64::MAX), [[0, 1, 2], [0, 2, 3]]);
        let fan = cut(&star(3, DVec3::X, DVec3::Y), 0);
        assert_eq!(fan, [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]]);
    }

    #[test]
    fn degenerate_polygons_end() {
        for points in [
            vec![DVec3::ONE; 200],
            vec![DVec3::NAN; 200],
            (0..200).map(|i| DVec3::X * f64::from(i % 7)).collect(),
        ] {
            assert_eq!(cut(&points, u64::MAX).len(), 198);
        }
        assert!(cut(&[DVec3::X, DVec3::Y], 0).is_empty());
    }
}
