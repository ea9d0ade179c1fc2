//! Light from infinity by a lat-long picture.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::{DMat3, DMat4, DVec2, DVec3, Vec3};
use limpid_scenes::Image;

use crate::color::{Rgb, luminance};
use crate::sampling::Distribution2d;
use crate::texture::texel;

/// A lat-long picture at infinity: row j lies at the polar angle θ = πj / (height − 1) from +y, column i has its centre
/// at the longitude φ = 2π (½ − (i + ½) / width) from +z towards +x; between them it is bilinear, as in Mitsuba 3.
///
/// Texels are cleaned: a non-finite one counts as 0, and so does a negative channel.
///
/// The density is bilinear as well, between the *same four* texels' luminances, but over (φ, cos θ) in place of (φ, θ):
/// there it needs no sin θ, is positive wherever the radiance is, and is drawn by inversion. In a cell of the picture
/// cos θ is so nearly linear in θ that the two agree within a few per cent, at the poles within a factor.
pub struct EnvMap {
    image: Arc<Image>,
    scale: f32,
    world_from_light: DMat3,
    light_from_world: DMat3,
    /// |det| of `light_from_world`.
    det: f64,
    /// sin² and cos² of θ/2 of each row: heights above the poles, each with its digits near its pole.
    rows: Box<[[f64; 2]]>,
    /// Over the cells between four texels; `None` if the picture is black.
    cells: Option<Distribution2d>,
    bad_texels: u64,
}

/// Where a direction lies: a cell, and where in it.
struct At {
    column: u32,
    row: u32,
    /// In longitude.
    s: f64,
    /// In θ.
    t: f64,
    /// In cos θ.
    q: f64,
}

impl EnvMap {
    pub fn new(image: Arc<Image>, scale: f32, world_from_light: DMat4) -> Self {
        let matrix = DMat3::from_mat4(world_from_light);
        let inverse = matrix.inverse();
        let (world_from_light, light_from_world) = if inverse.is_finite() && matrix.is_finite() {
            (matrix, inverse)
        } else {
            (DMat3::IDENTITY, DMat3::IDENTITY)
        };
        // A picture of one row counts as two equal ones.
        let (width, height) = (image.width, image.height.max(2));
        let rows: Box<[_]> = (0..height)
            .map(|j| {
                let half = 0.5 * PI * f64::from(j) / f64::from(height - 1);
                [half.sin().powi(2), half.cos().powi(2)]
            })
            .collect();
        let mut light = Self {
            image,
            scale,
            world_from_light,
            light_from_world,
            det: light_from_world.determinant().abs(),
            rows,
            cells: None,
            bad_texels: 0,
        };
        let (mut luminances, mut bad_texels) = (Vec::new(), 0);
        for j in 0..light.image.height {
            for i in 0..width {
                let raw = texel(&light.image, i, j);
                bad_texels += u64::from(!raw.is_finite() || raw.min_element() < 0.0);
                luminances.push(luminance(clean(raw)));
            }
        }
        let at = |i: usize, j: usize| {
            let j = j.min(light.image.height as usize - 1);
            f64::from(luminances[j * width as usize + i % width as usize])
        };
        let cells = Distribution2d::new(width as usize, height as usize - 1, |i, j| {
            0.25 * (at(i, j) + at(i + 1, j) + at(i, j + 1) + at(i + 1, j + 1)) * light.height(j)
        });
        (light.cells, light.bad_texels) = (cells, bad_texels);
        light
    }

    /// Texels that are not finite or have a negative channel.
    pub fn bad_texels(&self) -> u64 {
        self.bad_texels
    }

    /// Luminance over the sphere, and whether there is no light at all.
    pub fn integral(&self) -> (f64, bool) {
        let integral = f64::from(self.scale) * self.solid_angle_unit() * self.total();
        (integral, self.cells.is_none() || self.scale == 0.0)
    }

    /// A direction in world space, with the density that [`eval`](Self::eval) gives.
    pub fn sample(&self, u: DVec2) -> Option<DVec3> {
        let ([column, row], [a, b]) = self.cells.as_ref()?.sample(u.to_array());
        let [l00, l10, l01, l11] = self.corners(column as u32, row as u32).map(|c| f64::from(luminance(c)));
        let q = linear(b, l00 + l10, l01 + l11);
        let s = linear(a, l00 + (l01 - l00) * q, l10 + (l11 - l10) * q);
        let [sin2, cos2] =
            [0, 1].map(|k| self.rows[row][k] + (self.rows[row + 1][k] - self.rows[row][k]) * q);
        let phi = TAU * (0.5 - (column as f64 + s + 0.5) / f64::from(self.image.width));
        let r = 2.0 * (sin2 * cos2).sqrt();
        let in_light = DVec3::new(r * phi.sin(), cos2 - sin2, r * phi.cos());
        (self.world_from_light * in_light).try_normalize()
    }

    /// Radiance against the direction `wi`, and the density per steradian of drawing it.
    pub fn eval(&self, wi: Vec3) -> (Rgb, f64) {
        let d = self.light_from_world * wi.as_dvec3();
        let length = d.length();
        let Some(at) = self.locate(d / length) else { return (Rgb::ZERO, 0.0) };
        let corners = self.corners(at.column, at.row);
        let (s, t) = (at.s as f32, at.t as f32);
        let [c00, c10, c01, c11] = corners;
        let radiance = (c00 * (1.0 - s) + c10 * s) * (1.0 - t) + (c01 * (1.0 - s) + c11 * s) * t;
        let total = self.total();
        if total <= 0.0 {
            return (radiance * self.scale, 0.0);
        }
        let [l00, l10, l01, l11] = corners.map(|c| f64::from(luminance(c)));
        let (s, q) = (at.s, at.q);
        let bilinear = (l00 * (1.0 - s) + l10 * s) * (1.0 - q) + (l01 * (1.0 - s) + l11 * s) * q;
        let stretch = self.det / (length * length * length);
        (radiance * self.scale, bilinear / (total * self.solid_angle_unit()) * stretch)
    }

    /// Of a unit direction in light space; `None` if it is no direction.
    fn locate(&self, d: DVec3) -> Option<At> {
        if !d.is_finite() {
            return None;
        }
        let width = self.image.width;
        // Each hemisphere measures from its own pole.
        let r2 = d.x * d.x + d.z * d.z;
        let near = 0.5 * r2 / (1.0 + d.y.abs());
        let y = r2.sqrt().atan2(d.y) / PI * (self.rows.len() - 1) as f64;
        let row = (y as u32).min(self.rows.len() as u32 - 2);
        let [first, second] = [self.rows[row as usize], self.rows[row as usize + 1]];
        let q = if d.y >= 0.0 {
            (near - first[0]) / (second[0] - first[0])
        } else {
            (first[1] - near) / (first[1] - second[1])
        };
        // In [0, width + ½]: one half is added to stay positive.
        let x = (0.5 - d.x.atan2(d.z) / TAU).clamp(0.0, 1.0) * f64::from(width) + 0.5;
        let right = (x as u32).min(width);
        let column = if right == 0 { width - 1 } else { right - 1 };
        Some(At {
            column,
            row,
            s: (x - f64::from(right)).clamp(0.0, 1.0),
            t: (y - f64::from(row)).clamp(0.0, 1.0),
            q: q.clamp(0.0, 1.0),
        })
    }

    /// The texels at a cell's corners, cleaned: the upper two, then the lower two.
    #[inline]
    fn corners(&self, column: u32, row: u32) -> [Rgb; 4] {
        let image = &*self.image;
        let next = if column + 1 < image.width { column + 1 } else { 0 };
        let (upper, lower) = (row.min(image.height - 1), (row + 1).min(image.height - 1));
        [(column, upper), (next, upper), (column, lower), (next, lower)]
            .map(|(i, j)| clean(texel(image, i, j)))
    }

    /// Difference of sin² θ/2 over a row of cells, half of that of cos θ.
    fn height(&self, row: usize) -> f64 {
        let [first, second] = [self.rows[row], self.rows[row + 1]];
        // From the nearer pole.
        if first[0] < first[1] { second[0] - first[0] } else { first[1] - second[1] }
    }

    /// Solid angle for a `height` of 1.
    fn solid_angle_unit(&self) -> f64 {
        2.0 * TAU / f64::from(self.image.width)
    }

    fn total(&self) -> f64 {
        self.cells.as_ref().map_or(0.0, Distribution2d::total)
    }
}

#[inline]
fn clean(texel: Rgb) -> Rgb {
    if texel.is_finite() { texel.max(Rgb::ZERO) } else { Rgb::ZERO }
}

/// Inversion of a density on [0, 1] that runs linearly from ∝ `a` to ∝ `b`.
fn linear(u: f64, a: f64, b: f64) -> f64 {
    let sum = a + (a * a + u * (b * b - a * a)).max(0.0).sqrt();
    if sum > 0.0 { (u * (a + b) / sum).min(1.0) } else { u }
}

#[cfg(test)]
mod tests;
