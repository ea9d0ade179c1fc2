//! `<sensor>` with film, pixel filter and sampler.

use super::{ExportError, Writer};
use crate::{Camera, FovAxis, PixelFilter, Projection};

/// The samplers that Mitsuba 3 has.
const SAMPLERS: [&str; 5] = ["independent", "ldsampler", "multijitter", "orthogonal", "stratified"];

impl Writer<'_> {
    pub(super) fn camera(&mut self, camera: &Camera) -> Result<(), ExportError> {
        let id = self.id(&camera.name);
        let kind = match (&camera.projection, &camera.lens) {
            (Projection::Orthographic, _) => "orthographic",
            (Projection::Perspective { .. }, None) => "perspective",
            (Projection::Perspective { .. }, Some(_)) => "thinlens",
        };
        let xml = &mut self.xml;
        xml.open("sensor", &[("type", kind), ("id", &id)]);
        if let Projection::Perspective { fov_deg, fov_axis, principal_point_offset: [x, y] } =
            camera.projection
        {
            xml.float("fov", fov_deg);
            let axis = match fov_axis {
                FovAxis::X => "x",
                FovAxis::Y => "y",
                FovAxis::Diagonal => "diagonal",
                FovAxis::Smaller => "smaller",
                FovAxis::Larger => "larger",
            };
            xml.value("string", "fov_axis", axis);
            if [x, y] != [0.0; 2] {
                xml.float("principal_point_offset_x", x);
                xml.float("principal_point_offset_y", y);
            }
            if let Some(lens) = camera.lens {
                xml.float("aperture_radius", lens.aperture_radius);
                xml.float("focus_distance", lens.focus_distance);
            }
        }
        // Where nothing is said Mitsuba clips at 0.01 and 10,000. Planes far from these cost its camera rays their digits.
        if let Some(near) = camera.near_clip.filter(|&near| near > 0.0) {
            xml.float("near_clip", near);
        }
        if let Some(far) = camera.far_clip {
            xml.float("far_clip", far);
        }
        xml.transform("to_world", camera.world_from_camera);

        let film = &camera.film;
        xml.open("film", &[("type", "hdrfilm")]);
        xml.value("integer", "width", &film.width.to_string());
        xml.value("integer", "height", &film.height.to_string());
        if let Some(crop) = film.crop {
            xml.value("integer", "crop_offset_x", &crop.x.to_string());
            xml.value("integer", "crop_offset_y", &crop.y.to_string());
            xml.value("integer", "crop_width", &crop.width.to_string());
            xml.value("integer", "crop_height", &crop.height.to_string());
        }
        if film.alpha {
            xml.value("string", "pixel_format", "rgba");
        }
        xml.value("string", "component_format", "float32");
        let (kind, parameters): (&str, &[(&str, f32)]) = match film.filter {
            PixelFilter::Box => ("box", &[]),
            PixelFilter::Tent { radius } => ("tent", &[("radius", radius)]),
            PixelFilter::Gaussian { stddev } => ("gaussian", &[("stddev", stddev)]),
            PixelFilter::Mitchell { b, c } => ("mitchell", &[("B", b), ("C", c)]),
            PixelFilter::CatmullRom => ("catmullrom", &[]),
            PixelFilter::Lanczos { lobes } => ("lanczos", &[("lobes", lobes)]),
        };
        xml.open("rfilter", &[("type", kind)]);
        for &(name, value) in parameters {
            if name == "lobes" {
                xml.value("integer", name, &value.to_string());
            } else {
                xml.float(name, value);
            }
        }
        xml.close("rfilter");
        xml.close("film");

        let sampler = SAMPLERS.into_iter().find(|kind| *kind == camera.sampler.kind).unwrap_or("independent");
        xml.open("sampler", &[("type", sampler)]);
        xml.value("integer", "sample_count", &camera.sampler.sample_count.to_string());
        xml.close("sampler");
        xml.close("sensor");
        Ok(())
    }
}
