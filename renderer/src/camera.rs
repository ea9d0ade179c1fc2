//! From film positions to rays in render space, whose origin is the camera.

use glam::{DMat3, DVec2, DVec3, Vec3};
use limpid_scenes::{Camera as SceneCamera, FovAxis, Projection};

use crate::accel::Ray;

/// A camera for a film of a given size.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    world_from_camera: DMat3,
    /// The film in camera space at distance 1: its corner and the steps of one pixel.
    corner: DVec2,
    step: DVec2,
    near: f64,
    far: f64,
}

impl Camera {
    /// `width` and `height` of the whole film in pixels, which need not be those of the file: the field of view then
    /// holds along the axis that the file names.
    pub fn new(camera: &SceneCamera, width: u32, height: u32) -> Self {
        let Projection::Perspective { fov_deg, fov_axis, principal_point_offset } = &camera.projection;
        let (w, h) = (f64::from(width), f64::from(height));
        let along = match fov_axis {
            FovAxis::X => w,
            FovAxis::Y => h,
            FovAxis::Diagonal => w.hypot(h),
            FovAxis::Smaller => w.min(h),
            FovAxis::Larger => w.max(h),
        };
        // Half the film's size at distance 1. +x points to the left of the picture, +y up.
        let half = DVec2::new(w, h) / along * (0.5 * fov_deg.to_radians()).tan();
        let shift = 2.0 * DVec2::from_array(*principal_point_offset) * half;
        Self {
            world_from_camera: DMat3::from_mat4(camera.world_from_camera),
            corner: half - shift,
            step: -2.0 * half / DVec2::new(w, h),
            near: camera.near_clip.unwrap_or(0.0),
            far: camera.far_clip.unwrap_or(f64::INFINITY),
        }
    }

    /// The ray through a film position in pixels from the top left corner of the whole film.
    pub fn ray(&self, film: DVec2) -> Ray {
        let local = (self.corner + self.step * film).extend(1.0);
        // Lengths along the view axis become lengths along the ray.
        let stretch = local.length();
        let d: DVec3 = (self.world_from_camera * local).normalize();
        let o = if self.near > 0.0 { d * (self.near * stretch) } else { DVec3::ZERO };
        let mut ray = Ray::new(o.as_vec3(), d.as_vec3().normalize_or(Vec3::Z));
        ray.t_max = ((self.far - self.near) * stretch) as f32;
        ray
    }
}

#[cfg(test)]
mod tests {
    use glam::DMat4;
    use limpid_scenes::{Film, PixelFilter, Place, Sampler};

    use super::*;

    fn camera(fov_axis: FovAxis, offset: [f64; 2]) -> SceneCamera {
        SceneCamera {
            name: "camera".into(),
            world_from_camera: DMat4::IDENTITY,
            projection: Projection::Perspective { fov_deg: 90.0, fov_axis, principal_point_offset: offset },
            near_clip: None,
            far_clip: None,
            film: Film { width: 100, height: 50, crop: None, filter: PixelFilter::Box },
            sampler: Sampler { kind: "independent".into(), sample_count: 1 },
            place: Place::default(),
        }
    }

    fn slopes(c: &SceneCamera, x: f64, y: f64) -> (f32, f32) {
        let d = Camera::new(c, 100, 50).ray(DVec2::new(x, y)).d;
        (d.x / d.z, d.y / d.z)
    }

    fn assert_near((x, y): (f32, f32), truth: (f32, f32)) {
        assert!((x - truth.0).abs() < 1e-6 && (y - truth.1).abs() < 1e-6, "({x}, {y}), not {truth:?}");
    }

    // The truths are what Mitsuba 3.9.1 gives for the same camera.
    #[test]
    fn field_of_view_belongs_to_its_axis() {
        assert_near(slopes(&camera(FovAxis::X, [0.0; 2]), 25.0, 12.5), (0.5, 0.25));
        assert_near(slopes(&camera(FovAxis::Y, [0.0; 2]), 20.0, 10.0), (1.2, 0.6));
        assert_near(slopes(&camera(FovAxis::Smaller, [0.0; 2]), 20.0, 10.0), (1.2, 0.6));
        assert_near(slopes(&camera(FovAxis::Larger, [0.0; 2]), 25.0, 12.5), (0.5, 0.25));
    }

    #[test]
    fn principal_point_shifts_the_picture() {
        assert_near(slopes(&camera(FovAxis::X, [0.1, 0.1]), 25.0, 12.5), (0.3, 0.15));
    }

    #[test]
    fn clip_distances_lie_along_the_view_axis() {
        let mut c = camera(FovAxis::X, [0.0; 2]);
        (c.near_clip, c.far_clip) = (Some(0.01), Some(10.01));
        let ray = Camera::new(&c, 100, 50).ray(DVec2::new(25.0, 12.5));
        assert!((ray.o.z - 0.01).abs() < 1e-8 && (ray.o.x - 0.005).abs() < 1e-8, "{}", ray.o);
        assert!((ray.t_max * ray.d.z - 10.0).abs() < 1e-5);
    }
}
