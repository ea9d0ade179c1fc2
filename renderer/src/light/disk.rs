//! Disks and their affine images, by area.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3, Vec2};

use super::{Drawn, LightAnalytic, area_pdf};

/// A disk that emits on one side.
pub struct Disk {
    center: DVec3,
    axes: [DVec3; 2],
    /// Towards the side that emits; its length is the area.
    normal: DVec3,
    prim: u32,
}

impl Disk {
    pub fn new(disk: &LightAnalytic) -> Self {
        let m = disk.render_from_unit.matrix3;
        let (x, y) = (m.x_axis, m.y_axis);
        // The normal turns with the determinant, as a surface's does.
        let side = if (m.determinant() < 0.0) != disk.turned { -PI } else { PI };
        Self {
            center: disk.render_from_unit.translation,
            axes: [x, y],
            normal: x.cross(y) * side,
            prim: disk.prim,
        }
    }

    pub fn area(&self) -> f64 {
        self.normal.length()
    }

    pub fn sample(&self, p: DVec3, u: DVec2) -> Option<Drawn> {
        if (p - self.center).dot(self.normal) <= 0.0 {
            return None;
        }
        let (r, phi) = (u.x.sqrt(), TAU * u.y);
        let q = self.center + r * (phi.cos() * self.axes[0] + phi.sin() * self.axes[1]);
        let d = q - p;
        let uv = Vec2::new(r as f32, u.y as f32);
        let wi = d.try_normalize()?;
        Some(Drawn {
            wi,
            distance: d.length(),
            pdf: area_pdf(p, q, self.normal),
            uv: uv.into(),
            prim: self.prim,
        })
    }

    pub fn pdf(&self, p: DVec3, q: DVec3) -> f64 {
        if (p - self.center).dot(self.normal) <= 0.0 { 0.0 } else { area_pdf(p, q, self.normal) }
    }
}
