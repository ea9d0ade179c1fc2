//! Ray against triangle: watertight, and with a distance that keeps its digits.
//!
//! After Woop, Benthin and Wald (2013) the vertices are moved to the ray's origin and sheared so that the
//! ray becomes the z axis; what remains is a point-in-triangle test in the plane. Each sheared vertex is
//! rounded once and alike for all triangles that share it, and the three edge functions are evaluated in `f64`, where a
//! difference of two products of `f32` numbers has its exact sign: the projected mesh is a consistent plane figure, and a ray
//! cannot slip between its triangles. Four triangles in `f64` fill an AVX2 register; a pass in `f32` before, to
//! discard what is certainly outside, would be more instructions than that.
//!
//! The distance comes from the plane through the vertices in `f64`, not from the interpolated z of the
//! sheared vertices: on a triangle of side 1e6 seen from 1 unit the latter is off by tenths of a unit.

use arrayvec::ArrayVec;
use glam::{DVec3, Vec3};

use super::kernel::{Blocks, CORNERS, Corners, Isa, LANES, ShearedRay, Stack};
use super::{Hit, NONE, Ray};

/// Up to four triangles, in two cache lines.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(128))]
pub struct TriangleBlock {
    corners: Corners,
    prim: [u32; LANES],
    /// Bit mask of the lanes that hold a triangle.
    present: u32,
}

impl TriangleBlock {
    /// Whether the corners of these triangles, at most four, are few enough.
    pub fn fits(triangles: &[[Vec3; 3]], prims: &[u32]) -> bool {
        if prims.len() <= 2 {
            return true;
        }
        let mut corners = ArrayVec::<[u32; 3], { 3 * LANES }>::new();
        for corner in prims.iter().flat_map(|&prim| triangles[prim as usize]) {
            let bits = corner.to_array().map(f32::to_bits);
            if !corners.contains(&bits) {
                corners.push(bits);
            }
        }
        corners.len() <= CORNERS
    }

    /// Gathers the triangles with these indices, which fit; `first` is the primitive id of triangle 0.
    pub fn new(triangles: &[[Vec3; 3]], first: u32, prims: &[u32]) -> Self {
        let mut corners = ArrayVec::<Vec3, CORNERS>::new();
        let mut block = Self {
            corners: Corners { v: [[0.0; CORNERS]; 3], index: [[0; LANES]; 3] },
            prim: [NONE; LANES],
            present: (1 << prims.len()) - 1,
        };
        for (lane, &prim) in prims.iter().enumerate() {
            block.prim[lane] = first + prim;
            for (vertex, &p) in triangles[prim as usize].iter().enumerate() {
                let bits = |p: Vec3| p.to_array().map(f32::to_bits); // zeros of either sign stay what they are
                let at = corners.iter().position(|&q| bits(p) == bits(q)).unwrap_or_else(|| {
                    corners.push(p);
                    corners.len() - 1
                });
                block.corners.index[vertex][lane] = at as u8;
            }
        }
        for at in 0..CORNERS {
            let p = corners.get(at).unwrap_or(&corners[0]);
            for axis in 0..3 {
                block.corners.v[axis][at] = p[axis];
            }
        }
        block
    }

    /// Distance and barycentric coordinates of the second and third vertex of a triangle that the ray is not outside of.
    #[inline(always)]
    fn hit(&self, sheared: &ShearedRay, edges: &[[f64; LANES]; 3], lane: usize) -> Option<(f32, f32, f32)> {
        let [u, v, w] = edges.map(|e| e[lane]);
        let det = u + v + w;
        if det == 0.0 || det.is_nan() {
            return None; // seen exactly edge-on: a neighbour on either side of it is hit
        }
        let vertex = |number: usize| {
            let at = usize::from(self.corners.index[number][lane]) % CORNERS;
            let p = |axis: usize| f64::from(self.corners.v[axis][at]);
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
            let z = |p: DVec3| f64::from(p[sheared.k[2]] as f32 - sheared.o[2]);
            start + unit * ((u * z(a) + v * z(b) + w * z(c)) * f64::from(sheared.s[2]) / det)
        };
        (t > 0.0).then_some((t as f32, (v / det) as f32, (w / det) as f32))
    }
}

impl TriangleBlock {
    /// Bit mask of the triangles that the ray is not outside of, and all edge functions.
    #[inline(always)]
    pub fn candidates<I: Isa>(&self, isa: I, sheared: &ShearedRay, edges: &mut [[f64; LANES]; 3]) -> u32 {
        isa.inside(&self.corners, sheared, edges) & self.present
    }

    /// Replaces `hit` by a nearer one of the candidates.
    #[inline(always)]
    pub fn nearest(
        &self,
        mut candidates: u32,
        edges: &[[f64; LANES]; 3],
        ray: &Ray,
        sheared: &ShearedRay,
        hit: &mut Hit,
    ) {
        while candidates != 0 {
            let lane = candidates.trailing_zeros() as usize % LANES;
            candidates &= candidates - 1;
            let prim = self.prim[lane];
            if let Some((t, u, v)) = self.hit(sheared, edges, lane)
                && prim != ray.skip
                && hit.beaten_by(t, prim)
                && t < ray.t_max
            {
                *hit = Hit { t, prim, u, v, instance: NONE };
            }
        }
    }

    /// Whether one of the candidates lies before `ray.t_max`.
    #[inline(always)]
    pub fn any(
        &self,
        mut candidates: u32,
        edges: &[[f64; LANES]; 3],
        ray: &Ray,
        sheared: &ShearedRay,
    ) -> bool {
        while candidates != 0 {
            let lane = candidates.trailing_zeros() as usize % LANES;
            candidates &= candidates - 1;
            if self.prim[lane] != ray.skip
                && self.hit(sheared, edges, lane).is_some_and(|(t, ..)| t < ray.t_max)
            {
                return true;
            }
        }
        false
    }
}

impl Blocks for TriangleBlock {
    const MOST: usize = LANES;

    #[inline(always)]
    fn closest<I: Isa>(
        &self,
        isa: I,
        ray: &Ray,
        sheared: &ShearedRay,
        _: &mut Stack,
        _: usize,
        hit: &mut Hit,
    ) {
        let mut edges = [[0.0; LANES]; 3];
        let candidates = self.candidates(isa, sheared, &mut edges);
        self.nearest(candidates, &edges, ray, sheared, hit);
    }

    #[inline(always)]
    fn occluded<I: Isa>(&self, isa: I, ray: &Ray, sheared: &ShearedRay, _: &mut Stack, _: usize) -> bool {
        let mut edges = [[0.0; LANES]; 3];
        let candidates = self.candidates(isa, sheared, &mut edges);
        self.any(candidates, &edges, ray, sheared)
    }
}
