//! Cameras: how film positions become rays, the film, and what the file says about sampling.

use glam::DMat4;

use crate::Place;

/// A camera with its film and sample count.
#[derive(Clone, Debug)]
pub struct Camera {
    /// The file's id, or `camera` and a number; what `--camera` takes.
    pub name: String,
    /// May hold a scale, also a negative one: handedness is the file's business.
    pub world_from_camera: DMat4,
    /// How film positions become directions.
    pub projection: Projection,
    /// What makes depth of field; a pinhole where absent.
    pub lens: Option<Lens>,
    /// Where the file states them, nothing nearer or farther along the view axis is seen.
    pub near_clip: Option<f64>,
    /// See `near_clip`.
    pub far_clip: Option<f64>,
    /// Size, crop and pixel filter.
    pub film: Film,
    /// What the file says about sampling.
    pub sampler: Sampler,
    /// Where it stands.
    pub place: Place,
}

/// How film positions become rays.
#[derive(Clone, Debug, PartialEq)]
pub enum Projection {
    /// A pinhole.
    Perspective {
        /// Full angle of view along `fov_axis`, in degrees, in (0, 180).
        fov_deg: f64,
        /// Which side of the film the angle belongs to.
        fov_axis: FovAxis,
        /// Shift of the picture as fractions of its width and height.
        principal_point_offset: [f64; 2],
    },
    /// Parallel rays along +z through the film, which spans \[−1, 1\] along the camera's x axis.
    Orthographic,
}

/// A thin lens in the plane z = 0 of a perspective camera; lengths in camera space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Positive.
    pub aperture_radius: f64,
    /// Positive: what lies at this z is sharp.
    pub focus_distance: f64,
}

/// The side of the film that a field of view is measured along; it refers to the whole film, never to the crop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FovAxis {
    /// The width.
    X,
    /// The height.
    Y,
    /// The diagonal.
    Diagonal,
    /// The shorter of width and height.
    Smaller,
    /// The longer of width and height.
    Larger,
}

impl FovAxis {
    /// Half of the width and height at distance 1 of a picture of this shape, seen under the full angle `fov_deg`.
    pub fn half_size(self, fov_deg: f64, width: f64, height: f64) -> [f64; 2] {
        let along = match self {
            Self::X => width,
            Self::Y => height,
            Self::Diagonal => width.hypot(height),
            Self::Smaller => width.min(height),
            Self::Larger => width.max(height),
        };
        let tan = (0.5 * fov_deg.to_radians()).tan();
        [width / along * tan, height / along * tan]
    }
}

/// Size of the picture in pixels, and what a pixel gathers.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    /// In pixels, at least 1.
    pub width: u32,
    /// In pixels, at least 1.
    pub height: u32,
    /// The part to be rendered; the whole film where absent.
    pub crop: Option<Crop>,
    /// The pixel filter.
    pub filter: PixelFilter,
    /// The filter's value is that at the inner end of one of so many steps of its radius, as in Mitsuba 3 (31); `None`:
    /// the filter itself. A box has no steps.
    pub filter_steps: Option<u32>,
    /// The share of what is there is asked for beside the colours.
    pub alpha: bool,
}

/// A rectangle of pixels from the film's top left corner; not empty, within the film.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Crop {
    /// First column.
    pub x: u32,
    /// First row.
    pub y: u32,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

/// Reconstruction filters; lengths in pixels, with Mitsuba's defaults.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PixelFilter {
    /// Radius 0.5.
    Box,
    /// `max(0, 1 − |x| / radius)`.
    Tent {
        /// Where it ends; 1.
        radius: f32,
    },
    /// `exp(−x² / 2σ²)` less its value at the radius 4σ, where it ends.
    Gaussian {
        /// σ; 0.5.
        stddev: f32,
    },
    /// Mitchell and Netravali 1988, radius 2.
    Mitchell {
        /// 1/3.
        b: f32,
        /// 1/3.
        c: f32,
    },
    /// Mitchell with B = 0, C = 1/2, radius 2.
    CatmullRom,
    /// `sinc(x) · sinc(x / lobes)`, radius `lobes`.
    Lanczos {
        /// 3.
        lobes: f32,
    },
}

/// The sampler that a file names and its sample count.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sampler {
    /// The file's word: `independent`, `multijitter`, …
    pub kind: String,
    /// Samples per pixel.
    pub sample_count: u32,
}
