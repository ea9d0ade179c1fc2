//! Ray against triangle: watertight, and with a distance that keeps its digits.
//!
//! After Woop, Benthin and Wald (2013) the vertices are moved to the ray's origin and sheared so that the
//! ray becomes the z axis; what remains is a point-in-triangle test in the plane. Each sheared vertex is
//! rounded once and alike for all triangles that share it, and the three edge functions of the accepted
//! candidates are evaluated in `f64`, where a difference of two products of `f32` numbers has its exact sign:
//! the projected mesh is a consistent plane figure, and a ray cannot slip between its triangles.
//! A first pass in `f32` discards what is certainly outside.
//!
//! The distance comes from the plane through the vertices in `f64`, not from the interpolated z of the
//! sheared vertices: on a triangle of side 1e6 seen from 1 unit the latter is off by tenths of a unit.

use glam::{DVec3, Vec3};

use super::kernel::{Blocks, Child, Entry, ShearedRay};
use super::{Hit, NONE, Ray};

/// Lanes of a block.
pub const LANES: usize = 4;

/// Up to four triangles in columns: `v[vertex][axis][lane]`. Unused lanes are NaN and are never hit.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub struct TriangleBlock {
    v: [[[f32; LANES]; 3]; 3],
    prim: [u32; LANES],
}

impl TriangleBlock {
    /// Gathers the triangles with these indices; `first` is the primitive id of triangle 0.
    pub fn new(triangles: &[[Vec3; 3]], first: u32, prims: &[u32]) -> Self {
        let mut block = Self { v: [[[f32::NAN; LANES]; 3]; 3], prim: [NONE; LANES] };
        for (lane, &prim) in prims.iter().enumerate() {
            block.prim[lane] = first + prim;
            for (vertex, p) in triangles[prim as usize].iter().enumerate() {
                for axis in 0..3 {
                    block.v[vertex][axis][lane] = p[axis];
                }
            }
        }
        block
    }

    /// Bit mask of the lanes that the ray may hit: all but those certainly missed.
    #[inline(always)]
    fn candidates(&self, ray: &ShearedRay) -> u32 {
        // |error of cx·by − cy·bx| ≤ 2⁻²⁴ (|cx·by| + |cy·bx| + |result|), as long as nothing underflows.
        const ROUNDING: f32 = 1.0 / (1 << 22) as f32;
        let [kx, ky, kz] = ray.k;
        let sheared = |vertex: usize, axis: usize, o: f32, s: f32| {
            let (p, z) = (&self.v[vertex][axis], &self.v[vertex][kz]);
            let mut out = [0.0; LANES];
            for i in 0..LANES {
                out[i] = (p[i] - o) - s * (z[i] - ray.o[2]);
            }
            out
        };
        let (ax, ay) = (sheared(0, kx, ray.o[0], ray.s[0]), sheared(0, ky, ray.o[1], ray.s[1]));
        let (bx, by) = (sheared(1, kx, ray.o[0], ray.s[0]), sheared(1, ky, ray.o[1], ray.s[1]));
        let (cx, cy) = (sheared(2, kx, ray.o[0], ray.s[0]), sheared(2, ky, ray.o[1], ray.s[1]));
        let mut outside = [0u32; LANES];
        for i in 0..LANES {
            let (u0, u1) = (cx[i] * by[i], cy[i] * bx[i]);
            let (v0, v1) = (ax[i] * cy[i], ay[i] * cx[i]);
            let (w0, w1) = (bx[i] * ay[i], by[i] * ax[i]);
            let (u, v, w) = (u0 - u1, v0 - v1, w0 - w1);
            let (eu, ev, ew) = (
                ROUNDING * (u0.abs() + u1.abs()) + f32::MIN_POSITIVE,
                ROUNDING * (v0.abs() + v1.abs()) + f32::MIN_POSITIVE,
                ROUNDING * (w0.abs() + w1.abs()) + f32::MIN_POSITIVE,
            );
            let negative = (u < -eu) | (v < -ev) | (w < -ew);
            let positive = (u > eu) | (v > ev) | (w > ew);
            // Not `eu.is_nan()`: infinite products are left to the exact test, unused lanes (NaN vertices) are not.
            outside[i] = ((negative & positive) | ax[i].is_nan()) as u32;
        }
        let mut mask = 0;
        for (i, outside) in outside.iter().enumerate() {
            mask |= (1 - outside) << i;
        }
        mask
    }

    /// The exact test of one lane: distance and barycentric coordinates of the second and third vertex.
    #[inline(always)]
    fn intersect(&self, sheared: &ShearedRay, lane: usize) -> Option<(f32, f32, f32)> {
        let [kx, ky, kz] = sheared.k;
        let project = |vertex: usize| {
            let p = |axis: usize| self.v[vertex][axis][lane];
            let z = p(kz) - sheared.o[2];
            let x = (p(kx) - sheared.o[0]) - sheared.s[0] * z;
            let y = (p(ky) - sheared.o[1]) - sheared.s[1] * z;
            (f64::from(x), f64::from(y), f64::from(z))
        };
        let ((ax, ay, az), (bx, by, bz), (cx, cy, cz)) = (project(0), project(1), project(2));
        let u = cx * by - cy * bx;
        let v = ax * cy - ay * cx;
        let w = bx * ay - by * ax;
        if (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0) {
            return None;
        }
        let det = u + v + w;
        if det == 0.0 || det.is_nan() {
            return None; // seen exactly edge-on: a neighbour on either side of it is hit
        }
        let vertex = |i: usize| {
            let p = |axis: usize| f64::from(self.v[i][axis][lane]);
            DVec3::new(p(0), p(1), p(2))
        };
        let (o, d) = (sheared.o64, sheared.d64);
        let (a, b, c) = (vertex(0), vertex(1), vertex(2));
        let n = (b - a).cross(c - a);
        let cos = n.dot(d);
        let t = if cos != 0.0 {
            n.dot(a - o) / cos
        } else {
            let [start, unit] = sheared.distances;
            start + unit * ((u * az + v * bz + w * cz) * f64::from(sheared.s[2]) / det)
        };
        (t > 0.0).then_some((t as f32, (v / det) as f32, (w / det) as f32))
    }
}

impl Blocks for TriangleBlock {
    const MOST: usize = LANES;

    #[inline(always)]
    fn closest(&self, ray: &Ray, sheared: &ShearedRay, _: &mut [Entry], hit: &mut Hit) {
        let mut mask = self.candidates(sheared);
        while mask != 0 {
            let lane = mask.trailing_zeros() as usize;
            mask &= mask - 1;
            let prim = self.prim[lane];
            if let Some((t, u, v)) = self.intersect(sheared, lane)
                && prim != ray.skip
                && hit.beaten_by(t, prim)
                && t < ray.t_max
            {
                *hit = Hit { t, prim, u, v, instance: NONE };
            }
        }
    }

    #[inline(always)]
    fn occluded(&self, ray: &Ray, sheared: &ShearedRay, _: &mut [Child]) -> bool {
        let mut mask = self.candidates(sheared);
        while mask != 0 {
            let lane = mask.trailing_zeros() as usize;
            mask &= mask - 1;
            if self.prim[lane] != ray.skip
                && self.intersect(sheared, lane).is_some_and(|(t, ..)| t < ray.t_max)
            {
                return true;
            }
        }
        false
    }
}
