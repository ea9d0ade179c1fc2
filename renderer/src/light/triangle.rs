//! One triangle: by solid angle where it is wide, else by area.

use glam::DVec3;

/// A light whose squared size over squared distance is below this is drawn by area: the density then follows the
/// solid angle within 10 %, and costs a tenth.
pub const WIDE: f64 = 1e-3;

/// Below it the rounding of a solid angle counts: by area.
const SMALLEST: f64 = 1e-10;

/// A point of a triangle and its density per steradian.
pub struct Point {
    /// Weights of the corners.
    pub bary: [f64; 3],
    pub pdf: f64,
}

/// A triangle as seen from a point.
pub struct Seen {
    /// To the corners.
    to: [DVec3; 3],
    /// Distances of the corners.
    length: [f64; 3],
    /// (Distance of the plane) · 2 · area, positive.
    volume: f64,
    solid: Option<Solid>,
}

/// What drawing by solid angle needs: see [`Solid::draw`].
struct Solid {
    angle: f64,
    g: [f64; 3],
}

impl Seen {
    /// `None` from behind and from within the plane. Counter-clockwise seen from the front.
    #[inline]
    pub fn new(p: DVec3, [a, b, c]: [DVec3; 3]) -> Option<Self> {
        let to = [a - p, b - p, c - p];
        let (ab, ac, bc) = (b - a, c - a, c - b);
        let volume = -to[0].dot(ab.cross(ac));
        if volume.is_nan() || volume <= 0.0 {
            return None;
        }
        let length = to.map(DVec3::length);
        let size2 = ab.length_squared().max(ac.length_squared()).max(bc.length_squared());
        let nearest = length[0].min(length[1]).min(length[2]);
        let solid = (size2 > WIDE * nearest * nearest).then(|| Solid::new(&to, &length, volume));
        Some(Self { to, length, volume, solid: solid.filter(|s| s.angle > SMALLEST) })
    }

    /// A point; `u` and `v` are uniform in [0, 1).
    #[inline]
    pub fn draw(&self, u: f64, v: f64) -> Point {
        if let Some(solid) = &self.solid {
            return Point { bary: solid.draw(&self.to, &self.length, u, v), pdf: 1.0 / solid.angle };
        }
        let s = u.sqrt();
        let bary = [1.0 - s, s * (1.0 - v), s * v];
        let d = bary[0] * self.to[0] + bary[1] * self.to[1] + bary[2] * self.to[2];
        Point { bary, pdf: self.by_area(d.length()) }
    }

    /// Density of a point at `distance`.
    #[inline]
    pub fn pdf(&self, distance: f64) -> f64 {
        match &self.solid {
            Some(solid) => 1.0 / solid.angle,
            None => self.by_area(distance),
        }
    }

    fn by_area(&self, distance: f64) -> f64 {
        2.0 * distance * distance * distance / self.volume
    }
}

impl Solid {
    /// The solid angle by van Oosterom and Strackee 1983, whose numerator keeps its digits since `volume` is taken
    /// from the edges.
    fn new(to: &[DVec3; 3], length: &[f64; 3], volume: f64) -> Self {
        let cos = |i: usize, j: usize| to[i].dot(to[j]) / (length[i] * length[j]);
        let g = [volume / (length[0] * length[1] * length[2]), cos(0, 2) + cos(1, 2), 1.0 + cos(0, 1)];
        Self { angle: 2.0 * g[0].atan2(g[1] + g[2]), g }
    }

    /// A point uniform in solid angle, as weights of the corners: Arvo's map (1995) with one sine and no arc cosine
    /// (Peters 2021, "BRDF importance sampling for polygonal lights").
    ///
    /// With unit vectors v_i to the corners, the part v0 v1 w of the triangle with w on the arc v0 v2 has the
    /// solid angle σ for which tan σ/2 = det(v0, v1, r) / (v0 + v1)·r, where r halves the angle between v0 and w.
    /// With r = α v0 + γ v2 this is linear in α and γ.
    fn draw(&self, to: &[DVec3; 3], length: &[f64; 3], u: f64, v: f64) -> [f64; 3] {
        let [v0, v1, v2] = [to[0] / length[0], to[1] / length[1], to[2] / length[2]];
        let (sin, cos) = (0.5 * u * self.angle).sin_cos();
        let (alpha, gamma) = (self.g[0] * cos - self.g[1] * sin, self.g[2] * sin);
        let r = alpha * v0 + gamma * v2;
        let k = 2.0 * v0.dot(r) / r.length_squared();
        let (w0, w2) = (k * alpha - 1.0, k * gamma);
        let w = w0 * v0 + w2 * v2;
        // On the arc from v1 to w, uniform in 1 − cos.
        let full = 0.5 * (w - v1).length_squared();
        let part = v * full;
        let to_w = if full > 0.0 { (part * (2.0 - part) / (full * (2.0 - full))).max(0.0).sqrt() } else { v };
        let to_v1 = (1.0 - part) - to_w * (1.0 - full);
        // From weights of unit vectors to weights of corners.
        let bary = [to_w * w0 / length[0], to_v1 / length[1], to_w * w2 / length[2]].map(|x| x.max(0.0));
        let sum = bary[0] + bary[1] + bary[2];
        if sum > 0.0 && sum.is_finite() { bary.map(|x| x / sum) } else { [1.0 / 3.0; 3] }
    }
}
