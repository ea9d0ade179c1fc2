//! The surface at a hit, and where rays leave it.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec3, Vec2, Vec3};

use super::Geometry;
use crate::accel::{AnalyticKind, Frame64, Hit, NONE, Ray};

/// A point on a surface.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// In render space.
    pub p: Vec3,
    /// Geometric normal, unit, on the side that the scene's author gave it.
    pub ng: Vec3,
    /// Shading normal, unit.
    pub ns: Vec3,
    /// Texture coordinates.
    pub uv: Vec2,
    /// Upper bound of the distance of `p` from the true surface.
    pub(super) bound: f32,
    /// The shape: index into [`Geometry::shapes`].
    pub shape: u32,
    /// What the scene shows there: the shape, or the instance of its group; index into the scene's shapes.
    pub object: u32,
    /// The primitive.
    pub prim: u32,
    /// The instance through which it was hit, or [`NONE`].
    pub instance: u32,
    /// Barycentric coordinates of the second and third vertex of a triangle.
    pub bary: Vec2,
}

/// f32 rounding of one coordinate, relative.
pub(super) const ROUND: f32 = f32::EPSILON / 2.0;
/// Slack for the `f64` arithmetic behind a hit point, relative to the largest coordinate: a few dozen roundings.
pub(super) const SLACK: f32 = 1.0 / (1u64 << 48) as f32;

impl Surface {
    /// A ray from here along the unit vector `d`. Its origin is moved to `d`'s side of the geometric surface by twice
    /// the bound of the hit point's error, and then to the next number, so that it never lies on or beneath it.
    #[inline]
    pub fn spawn(&self, d: Vec3) -> Ray {
        let side = if d.dot(self.ng) < 0.0 { -self.ng } else { self.ng };
        let offset = side * (2.0 * self.bound);
        let away = |p: f32, offset: f32| {
            let moved = p + offset;
            if offset > 0.0 {
                moved.next_up()
            } else if offset < 0.0 {
                moved.next_down()
            } else {
                moved
            }
        };
        let o = Vec3::new(away(self.p.x, offset.x), away(self.p.y, offset.y), away(self.p.z, offset.z));
        Ray::new(o, d)
    }
}

impl Geometry {
    /// The surface that `ray` hit.
    #[inline]
    pub fn surface(&self, ray: &Ray, hit: &Hit) -> Surface {
        if hit.instance != NONE {
            self.instance_surface(ray, hit)
        } else {
            self.local_surface(ray.o.as_dvec3(), ray.d.as_dvec3(), hit).0
        }
    }

    /// The surface in the space of its primitive, which the ray from `o` along `d` hit there, and the point before
    /// rounding.
    #[inline]
    pub(super) fn local_surface(&self, o: DVec3, d: DVec3, hit: &Hit) -> (Surface, DVec3) {
        if (hit.prim as usize) < self.triangles.len() {
            self.triangle_surface(o, d, hit)
        } else {
            self.analytic_surface(o, d, hit)
        }
    }

    /// The point lies on the plane through the corners to the last digit of `f32`: barycentric interpolation would
    /// be off by 0.1 units in the middle of a triangle of side 1e6, a point along the ray by the error of `t`.
    fn triangle_surface(&self, o: DVec3, d: DVec3, hit: &Hit) -> (Surface, DVec3) {
        let shape_index = self.shape_of(hit.prim);
        let shape = &self.shapes[shape_index as usize];
        let [a, b, c] = self.corners(hit.prim).map(Vec3::as_dvec3);
        let cross = (b - a).cross(c - a);
        let cos = cross.dot(d);
        let t = if cos != 0.0 { cross.dot(a - o) / cos } else { f64::from(hit.t) };
        let p64 = o + t * d;
        let p = p64.as_vec3();

        let winding = cross.normalize_or_zero().as_vec3();
        let (w, u, v) = (1.0 - hit.u - hit.v, hit.u, hit.v);
        let normals = self.corner_normals(hit.prim, shape);
        let ng = if super::turned(cross, normals, shape) { -winding } else { winding };
        let ns = match normals {
            Some([na, nb, nc]) => (w * na + u * nb + v * nc).try_normalize().unwrap_or(ng),
            None => ng,
        };
        let [uv_a, uv_b, uv_c] = self.corner_uvs(hit.prim);
        let largest = a.abs().max_element().max(p.abs().max_element().into()) as f32;
        let surface = Surface {
            p,
            ng,
            ns,
            uv: w * uv_a + u * uv_b + v * uv_c,
            bound: ROUND * ng.abs().dot(p.abs()) + SLACK * largest,
            shape: shape_index,
            object: shape_index,
            prim: hit.prim,
            instance: NONE,
            bary: Vec2::new(u, v),
        };
        (surface, p64)
    }

    fn analytic_surface(&self, o: DVec3, d: DVec3, hit: &Hit) -> (Surface, DVec3) {
        let index = hit.prim as usize - self.triangles.len();
        let shape_index = self.analytic_shapes[index];
        let analytic = &self.analytics[index];
        let frame = &analytic.frame;
        let q = frame.object_from_render.transform_point3(o + f64::from(hit.t) * d);
        let (q, n) = match analytic.kind {
            AnalyticKind::Sphere => (q.normalize_or(DVec3::Z), q.normalize_or(DVec3::Z)),
            AnalyticKind::Cylinder => {
                let n = DVec3::new(q.x, q.y, 0.0).normalize_or(DVec3::X);
                (DVec3::new(n.x, n.y, q.z.clamp(0.0, 1.0)), n)
            }
            AnalyticKind::Disk => (DVec3::new(q.x, q.y, 0.0), DVec3::Z),
        };
        let p64 = frame.render_from_object.transform_point3(q);
        let p = p64.as_vec3();
        let normal = super::normal_matrix(frame.render_from_object.matrix3) * n;
        let ng = normal.normalize_or(DVec3::Z).as_vec3() * self.shapes[shape_index as usize].orientation;
        let phi = q.y.atan2(q.x);
        let turn = if phi < 0.0 { phi / TAU + 1.0 } else { phi / TAU };
        let uv = match analytic.kind {
            AnalyticKind::Sphere => Vec2::new(turn as f32, (q.z.clamp(-1.0, 1.0).acos() / PI) as f32),
            AnalyticKind::Cylinder => Vec2::new(turn as f32, q.z as f32),
            AnalyticKind::Disk => Vec2::new(q.x.hypot(q.y) as f32, turn as f32),
        };
        let m = frame.render_from_object;
        let largest = m.translation.abs().max_element()
            + m.matrix3.to_cols_array().iter().fold(0.0f64, |m, x| m.max(x.abs()));
        let surface = Surface {
            p,
            ng,
            ns: ng,
            uv,
            bound: ROUND * ng.abs().dot(p.abs()) + SLACK * largest as f32,
            shape: shape_index,
            object: shape_index,
            prim: hit.prim,
            instance: NONE,
            bary: Vec2::ZERO,
        };
        (surface, p64)
    }

    /// ∂p/∂u and ∂p/∂v: the directions that anisotropy and normal maps refer to. Zero where they are undefined.
    pub fn dp_duv(&self, surface: &Surface) -> [Vec3; 2] {
        if surface.instance == NONE {
            return self.local_dp_duv(surface.prim, surface.p.as_dvec3()).map(finite);
        }
        let Frame64 { render_from_object, object_from_render } =
            self.instances[surface.instance as usize].frame;
        let p = object_from_render.transform_point3(surface.p.as_dvec3());
        self.local_dp_duv(surface.prim, p).map(|d| finite(render_from_object.transform_vector3(d)))
    }

    /// Of a primitive in its own space, at the point `p`.
    fn local_dp_duv(&self, prim: u32, p: DVec3) -> [DVec3; 2] {
        if (prim as usize) < self.triangles.len() {
            let [a, b, c] = self.corners(prim).map(Vec3::as_dvec3);
            let [uv_a, uv_b, uv_c] = self.corner_uvs(prim).map(Vec2::as_dvec2);
            let (e, f, du, dv) = (b - a, c - a, uv_b - uv_a, uv_c - uv_a);
            let det = du.x * dv.y - du.y * dv.x;
            return [(e * dv.y - f * du.y) / det, (f * du.x - e * dv.x) / det];
        }
        let analytic = &self.analytics[prim as usize - self.triangles.len()];
        let q = analytic.frame.object_from_render.transform_point3(p);
        let r = q.x.hypot(q.y);
        let around = DVec3::new(-q.y, q.x, 0.0) * TAU;
        let outwards = DVec3::new(q.x, q.y, 0.0) / r;
        let [du, dv] = match analytic.kind {
            AnalyticKind::Sphere => [around, (outwards * q.z - DVec3::Z * r) * PI],
            AnalyticKind::Cylinder => [around, DVec3::Z],
            AnalyticKind::Disk => [outwards, around],
        };
        let linear: DMat3 = analytic.frame.render_from_object.matrix3;
        [linear * du, linear * dv]
    }
}

/// In `f32`; 0 where it is not finite there.
fn finite(v: DVec3) -> Vec3 {
    let v = v.as_vec3();
    if v.is_finite() { v } else { Vec3::ZERO }
}

/// An orthonormal frame whose z axis is a shading normal.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    x: Vec3,
    y: Vec3,
    z: Vec3,
}

impl Frame {
    /// Any frame around the unit vector `z` (Duff et al. 2017).
    #[inline]
    pub fn around(z: Vec3) -> Self {
        let sign = 1.0f32.copysign(z.z);
        let a = -1.0 / (sign + z.z);
        let b = z.x * z.y * a;
        Self {
            x: Vec3::new(1.0 + sign * z.x * z.x * a, sign * b, -sign * z.x),
            y: Vec3::new(b, sign + z.y * z.y * a, -z.y),
            z,
        }
    }

    /// The frame around `z` whose x axis leans towards `x`.
    pub fn with_tangent(z: Vec3, x: Vec3) -> Self {
        match (x - z * z.dot(x)).try_normalize() {
            Some(x) => Self { x, y: z.cross(x), z },
            None => Self::around(z),
        }
    }

    /// Into the frame.
    #[inline]
    pub fn to_local(self, v: Vec3) -> Vec3 {
        Vec3::new(self.x.dot(v), self.y.dot(v), self.z.dot(v))
    }

    /// Out of the frame.
    #[inline]
    pub fn to_render(self, v: Vec3) -> Vec3 {
        self.x * v.x + self.y * v.y + self.z * v.z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_orthonormal_and_right_handed() {
        for z in [
            Vec3::Z,
            Vec3::NEG_Z,
            Vec3::X,
            Vec3::new(0.6, -0.64, 0.48),
            Vec3::new(1e-6, 0.0, -1.0).normalize(),
        ] {
            for f in [
                Frame::around(z),
                Frame::with_tangent(z, Vec3::new(0.3, 0.9, 0.1)),
                Frame::with_tangent(z, z),
            ] {
                assert!((f.x.cross(f.y) - f.z).length() < 1e-6, "{f:?}");
                assert!(f.x.dot(f.y).abs() < 1e-6 && (f.x.length() - 1.0).abs() < 1e-6, "{f:?}");
                let v = Vec3::new(0.2, -0.5, 0.7);
                assert!((f.to_render(f.to_local(v)) - v).length() < 1e-6);
            }
        }
    }
}
