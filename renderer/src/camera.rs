//! From film positions to rays in render space, whose origin is the camera.

use glam::{DMat3, DVec2, DVec3, Vec2, Vec3};
use limpid_scenes::{Camera as SceneCamera, Lens, Projection};

use crate::accel::Ray;
use crate::sampling::warp::uniform_disk;

/// A camera for a film of a given size.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    world_from_camera: DMat3,
    /// The film in camera space, at distance 1 of a pinhole: its corner and the steps of one pixel.
    corner: DVec2,
    step: DVec2,
    kind: Kind,
    near: f64,
    far: f64,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    Pinhole,
    ThinLens(Lens),
    Orthographic,
}

impl Camera {
    /// `width` and `height` of the whole film in pixels, which need not be those of the file: the field of view then
    /// holds along the axis that the file names.
    pub fn new(camera: &SceneCamera, width: u32, height: u32) -> Self {
        let size = DVec2::new(width.into(), height.into());
        // Half the film's size and its shift. +x points to the left of the picture, +y up.
        let (half, shift, kind) = match &camera.projection {
            Projection::Perspective { fov_deg, fov_axis, principal_point_offset } => {
                let half = DVec2::from_array(fov_axis.half_size(*fov_deg, size.x, size.y));
                let shift = 2.0 * DVec2::from_array(*principal_point_offset) * half;
                (half, shift, camera.lens.map_or(Kind::Pinhole, Kind::ThinLens))
            }
            Projection::Orthographic => (DVec2::new(1.0, size.y / size.x), DVec2::ZERO, Kind::Orthographic),
        };
        Self {
            world_from_camera: DMat3::from_mat4(camera.world_from_camera),
            corner: half - shift,
            step: -2.0 * half / size,
            kind,
            near: camera.near_clip.unwrap_or(0.0),
            far: camera.far_clip.unwrap_or(f64::INFINITY),
        }
    }

    /// Whether a ray needs a point of the lens.
    #[inline]
    pub fn has_lens(&self) -> bool {
        matches!(self.kind, Kind::ThinLens(_))
    }

    /// The ray through a film position in pixels from the top left corner of the whole film. `lens` is uniform in
    /// \[0, 1)² and chooses a point of the lens, if there is one.
    pub fn ray(&self, film: DVec2, lens: Vec2) -> Ray {
        let film = self.corner + self.step * film;
        let m = self.world_from_camera;
        // Where the ray starts, and where it has come to when it is 1 farther along the view axis.
        let (start, step) = match self.kind {
            Kind::Pinhole => (DVec2::ZERO, film),
            Kind::ThinLens(Lens { aperture_radius, focus_distance }) => {
                let start = aperture_radius * uniform_disk(lens).as_dvec2();
                (start, film - start / focus_distance)
            }
            Kind::Orthographic => return self.parallel(film),
        };
        let step = step.extend(1.0);
        // Lengths along the view axis become lengths along the ray.
        let stretch = step.length();
        let d: DVec3 = (m * step).normalize();
        let o = m * start.extend(0.0) + if self.near > 0.0 { d * (self.near * stretch) } else { DVec3::ZERO };
        let mut ray = Ray::new(o.as_vec3(), d.as_vec3().normalize_or(Vec3::Z));
        ray.t_max = ((self.far - self.near) * stretch) as f32;
        ray
    }

    /// The near clip is a length of camera space, the way to the far clip one of world space: as in Mitsuba 3, if the
    /// camera has a scale along its axis.
    fn parallel(&self, film: DVec2) -> Ray {
        let o = self.world_from_camera * film.extend(self.near);
        let mut ray = Ray::new(o.as_vec3(), self.axis());
        ray.t_max = (self.far - self.near) as f32;
        ray
    }

    /// The view axis, unit.
    fn axis(&self) -> Vec3 {
        self.world_from_camera.z_axis.normalize().as_vec3().normalize_or(Vec3::Z)
    }

    /// Distance of a point of render space: from the pinhole or the lens' centre, or from the film of an orthographic
    /// camera.
    #[inline]
    pub fn distance(&self, p: Vec3) -> f32 {
        match self.kind {
            Kind::Pinhole | Kind::ThinLens(_) => p.as_dvec3().length() as f32,
            Kind::Orthographic => p.dot(self.axis()),
        }
    }
}

#[cfg(test)]
mod tests;
