//! `<sensor>`, `<film>`, `<rfilter>` and `<sampler>`.

use std::collections::HashMap;
use std::sync::Arc;

use glam::{DMat4, DVec3};

use super::document::ElementId;
use super::object::Object;
use super::survey::{FILMS, FILTERS, SAMPLERS, SENSORS, Standing};
use super::{Reader, value};
use crate::{
    Camera, Crop, Film, FovAxis, Lens, PixelFilter, Place, Projection, Sampler, Scene, SceneError, Shape,
    ShapeKind, Warning,
};

/// Pixels of a side: more than any picture has, and far from where areas overflow.
const MAX_SIDE: i64 = 1 << 20;
/// Pixels that are rendered at once: layers of so many take hundreds of gigabytes.
const MAX_PIXELS: i64 = 1 << 30;
/// Diagonal of a 36 × 24 mm negative, to which focal lengths refer.
const DIAGONAL_MM: f64 = 43.266_615_305_567_875;

/// Where Mitsuba's view ends, and where a lens focuses, if the file says nothing.
const DEFAULT_FAR_CLIP: f64 = 1e4;

/// What Mitsuba renders where the file says nothing.
const DEFAULT_FILM: Film = Film {
    width: 768,
    height: 576,
    crop: None,
    filter: PixelFilter::Gaussian { stddev: 0.5 },
    filter_steps: None,
    alpha: false,
};

fn default_sampler() -> Sampler {
    Sampler { kind: "independent".into(), sample_count: 4 }
}

impl Reader<'_> {
    pub(super) fn camera(&mut self, id: ElementId) -> Result<(), SceneError> {
        let object = Object::new(self.document, id);
        let kind = object.kind()?;
        SENSORS.standing(kind, object.element)?;
        let projection = match kind {
            "orthographic" => Projection::Orthographic,
            _ => perspective(&object)?,
        };
        let world_from_camera = object.transform("to_world")?;
        if !is_invertible(world_from_camera) {
            return Err(object.error("to_world flattens space", "use scales other than 0"));
        }
        let (near_clip, far_clip) = (clip(&object, "near_clip")?, clip(&object, "far_clip")?);
        let lens = if kind == "thinlens" { self.lens(&object, far_clip)? } else { None };
        object.without_effect(&["focus_distance", "shutter_open", "shutter_close", "srf"]);

        let film = match object.nested("film")?[..] {
            [] => DEFAULT_FILM,
            [(film, _), ..] => self.film(film)?,
        };
        let sampler = match object.nested("sampler")?[..] {
            [] => default_sampler(),
            [(sampler, _), ..] => self.sampler(sampler)?,
        };
        let interior = object.nested("medium")?;
        if let Some(&(medium, _)) = interior.first() {
            self.medium(medium)?; // the camera is in it: enough for the renderer to refuse
        }
        let name = self.name(&object, "camera", self.scene.cameras.len());
        let place = object.place();
        self.scene.cameras.push(Camera {
            name,
            world_from_camera,
            projection,
            lens,
            near_clip,
            far_clip,
            film,
            sampler,
            place,
        });
        object.finish(&mut self.warnings);
        Ok(())
    }

    /// What `thinlens` adds to a pinhole.
    fn lens(&mut self, object: &Object<'_>, far_clip: Option<f64>) -> Result<Option<Lens>, SceneError> {
        object.without_effect(&["aperture_blades", "aperture_rotation"]);
        let aperture_radius = object.float_where("aperture_radius", 0.0, "at least 0", |r| r >= 0.0)?;
        let far = far_clip.filter(|far| *far > 0.0).unwrap_or(DEFAULT_FAR_CLIP);
        let focus_distance = object.float_where("focus_distance", far, "above 0", |d| d > 0.0)?;
        if aperture_radius == 0.0 {
            self.warn(object.id, "thinlens: the aperture has no radius; a pinhole stands in");
            return Ok(None);
        }
        Ok(Some(Lens { aperture_radius, focus_distance }))
    }

    fn film(&mut self, id: ElementId) -> Result<Film, SceneError> {
        let object = Object::new(self.document, id);
        let kind = object.kind()?;
        FILMS.standing(kind, object.element)?;
        if kind == "ldrfilm" {
            self.warn(
                id,
                "ldrfilm: its size counts; the picture is linear, --png and --exposure make it displayable",
            );
            object.without_effect(&["exposure", "tonemap_method", "key", "burn"]);
        }
        object.without_effect(&[
            "file_format",
            "component_format",
            "filename",
            "gamma",
            "banner",
            "attach_log",
            "high_quality_edges",
            "sample_border",
            "compensate",
        ]);
        let width = object.integer("width", [1, MAX_SIDE])?.unwrap_or(i64::from(DEFAULT_FILM.width));
        let height = object.integer("height", [1, MAX_SIDE])?.unwrap_or(i64::from(DEFAULT_FILM.height));
        let crop = crop(&object, [width, height])?;
        let pixels = crop.map_or(width * height, |crop| i64::from(crop.width) * i64::from(crop.height));
        if pixels > MAX_PIXELS {
            return Err(object.error(
                format!("{width}x{height} pixels"),
                format!("render at most {MAX_PIXELS}: use a crop"),
            ));
        }
        let filter = match object.nested("rfilter")?[..] {
            [] => DEFAULT_FILM.filter,
            [(filter, _), ..] => self.filter(filter)?,
        };
        // rgba, xyza, luminance_alpha, and luminanceAlpha of 0.x
        let format =
            object.string("pixel_format")?.map_or(String::new(), |(word, _)| word.trim().to_lowercase());
        let alpha = matches!(format.as_str(), "rgba" | "xyza") || format.ends_with("alpha");
        object.finish(&mut self.warnings);
        Ok(Film { width: width as u32, height: height as u32, crop, filter, filter_steps: None, alpha })
    }

    fn filter(&mut self, id: ElementId) -> Result<PixelFilter, SceneError> {
        let object = Object::new(self.document, id);
        let kind = object.kind()?;
        FILTERS.standing(kind, object.element)?;
        let third = 1.0 / 3.0;
        // a radius of a thousand pixels is no filter any more
        let width = |key, default| {
            object.float_where(key, default, "above 0 and at most 1000 pixels", |v| v > 1e-3 && v <= 1e3)
        };
        let share =
            |key, default| object.float_where(key, default, "between -10 and 10", |v| v.abs() <= 10.0);
        let filter = match kind {
            "box" => PixelFilter::Box,
            "tent" => PixelFilter::Tent { radius: width("radius", 1.0)? as f32 },
            "mitchell" => {
                // A and B in some files, B and C in others; Mitsuba 3.9 takes the latter
                let (b, c) = if object.element.is_old { ("b", "c") } else { ("B", "C") };
                PixelFilter::Mitchell { b: share(b, third)? as f32, c: share(c, third)? as f32 }
            }
            "catmullrom" => PixelFilter::CatmullRom,
            "lanczos" => {
                let lobes = object.integer("lobes", [1, 100])?.unwrap_or(3);
                PixelFilter::Lanczos { lobes: lobes as f32 }
            }
            _ => PixelFilter::Gaussian { stddev: width("stddev", 0.5)? as f32 },
        };
        object.finish(&mut self.warnings);
        Ok(filter)
    }

    fn sampler(&mut self, id: ElementId) -> Result<Sampler, SceneError> {
        let object = Object::new(self.document, id);
        let kind = object.kind()?;
        if SAMPLERS.standing(kind, object.element)? == Standing::Later {
            self.warn(id, format!("{kind}: not read; the renderer's own sampler stands in"));
        }
        object.without_effect(&["seed", "dimension", "scramble", "jitter", "strength"]);
        let sample_count = object.integer("sample_count", [1, i64::from(u32::MAX)])?;
        object.finish(&mut self.warnings);
        let sample_count = sample_count.map_or(default_sampler().sample_count, |count| count as u32);
        Ok(Sampler { kind: kind.into(), sample_count })
    }

    /// A camera for a file without one, as Mitsuba places it: 45° wide, looking along +z at the middle of all shapes.
    pub(super) fn default_camera(&mut self) {
        let (low, high) = bounds(&self.scene);
        let world_from_camera = if low.cmple(high).all() {
            let centre = 0.5 * low + 0.5 * high;
            let distance = (high - low).max_element() / (2.0 * 22.5f64.to_radians().tan());
            DMat4::from_translation(DVec3::new(centre.x, centre.y, low.z - distance))
        } else {
            DMat4::IDENTITY
        };
        let world_from_camera =
            if world_from_camera.is_finite() { world_from_camera } else { DMat4::IDENTITY };
        let place = Place { file: Arc::clone(&self.file), line: 1, column: 1 };
        self.warnings.push((
            ElementId(usize::MAX),
            Warning {
                place: place.clone(),
                element: "scene".into(),
                message:
                    "no sensor; a camera with a view of 45 degrees along +z that sees all shapes stands in"
                        .into(),
                unused_parameter: false,
            },
        ));
        self.scene.cameras.push(Camera {
            name: "camera 1".into(),
            world_from_camera,
            projection: Projection::Perspective {
                fov_deg: 45.0,
                fov_axis: FovAxis::X,
                principal_point_offset: [0.0; 2],
            },
            lens: None,
            near_clip: None,
            far_clip: None,
            film: DEFAULT_FILM,
            sampler: default_sampler(),
            place,
        });
    }
}

/// The pinhole of `perspective` and `thinlens`.
fn perspective(object: &Object<'_>) -> Result<Projection, SceneError> {
    let (fov_deg, fov_axis) = field_of_view(object)?;
    let x = object.float("principal_point_offset_x", 0.0)?;
    let y = object.float("principal_point_offset_y", 0.0)?;
    Ok(Projection::Perspective { fov_deg, fov_axis, principal_point_offset: [x, y] })
}

/// `fov` in degrees along `fov_axis`, or what the focal length makes of the diagonal.
pub(super) fn field_of_view(object: &Object<'_>) -> Result<(f64, FovAxis), SceneError> {
    let axes = [
        ("x", FovAxis::X),
        ("y", FovAxis::Y),
        ("diagonal", FovAxis::Diagonal),
        ("smaller", FovAxis::Smaller),
        ("larger", FovAxis::Larger),
    ];
    let fov_axis = object.choice("fov_axis", &axes)?;
    let is_angle = |angle| angle > 0.0 && angle < 180.0;
    match object.maybe_float("fov")? {
        Some(_) => Ok((object.float_where("fov", 0.0, "between 0 and 180 degrees", is_angle)?, fov_axis)),
        None => {
            let angle = 2.0 * (DIAGONAL_MM / (2.0 * focal_length_mm(object)?)).atan();
            Ok((angle.to_degrees(), FovAxis::Diagonal))
        }
    }
}

/// Whether a transform keeps volumes: its linear part has an inverse.
pub(super) fn is_invertible(transform: DMat4) -> bool {
    transform.inverse().is_finite() && transform.determinant() != 0.0
}

fn clip(object: &Object<'_>, key: &'static str) -> Result<Option<f64>, SceneError> {
    let given = object.maybe_float(key)?;
    given.map(|value| object.float_where(key, value, "at least 0", |v| v >= 0.0)).transpose()
}

/// `50mm`, as a text; or a number.
fn focal_length_mm(object: &Object<'_>) -> Result<f64, SceneError> {
    let Some((_, parameter)) = object.find("focal_length") else { return Ok(50.0) };
    let text = parameter.attribute("value").unwrap_or_default();
    let number = text.trim().trim_end_matches("mm").trim_end().parse::<f64>();
    match number {
        Ok(length) if length > 0.0 && length.is_finite() => Ok(length),
        _ => {
            let problem = format!("\"{}\" is no focal length", value::shorten(text));
            Err(object.value_error(parameter, problem, "write a length in millimetres, such as 50mm"))
        }
    }
}

/// The part of a film of this `size` that is to be rendered.
fn crop(object: &Object<'_>, size: [i64; 2]) -> Result<Option<Crop>, SceneError> {
    let x = object.integer("crop_offset_x", [0, size[0] - 1])?.unwrap_or(0);
    let y = object.integer("crop_offset_y", [0, size[1] - 1])?.unwrap_or(0);
    let width = object.integer("crop_width", [1, size[0] - x])?.unwrap_or(size[0] - x);
    let height = object.integer("crop_height", [1, size[1] - y])?.unwrap_or(size[1] - y);
    let is_whole = [x, y, width, height] == [0, 0, size[0], size[1]];
    let crop = Crop { x: x as u32, y: y as u32, width: width as u32, height: height as u32 };
    Ok((!is_whole).then_some(crop))
}

/// The box around all shapes; its low end above its high end where there are none.
fn bounds(scene: &Scene) -> (DVec3, DVec3) {
    let groups: Vec<_> = scene.groups.iter().map(|group| bounds_of(&group.shapes, &[])).collect();
    bounds_of(&scene.shapes, &groups)
}

/// Of shapes, given the boxes of the groups.
fn bounds_of(shapes: &[Shape], groups: &[(DVec3, DVec3)]) -> (DVec3, DVec3) {
    let mut bounds = (DVec3::MAX, DVec3::MIN);
    let mut meshes = HashMap::new(); // by address: many shapes may share a mesh
    for shape in shapes {
        let (low, high) = match &shape.kind {
            ShapeKind::Mesh(mesh) => *meshes.entry(Arc::as_ptr(mesh)).or_insert_with(|| {
                let points = mesh.positions.iter().map(|p| DVec3::from(p.map(f64::from)));
                points.fold((DVec3::MAX, DVec3::MIN), |(low, high), p| (low.min(p), high.max(p)))
            }),
            ShapeKind::Sphere { center, radius } => (*center - *radius, *center + *radius),
            ShapeKind::Cylinder { p0, p1, radius } => (p0.min(*p1) - *radius, p0.max(*p1) + *radius),
            ShapeKind::Instance { group } => match groups.get(group.0 as usize) {
                Some(&bounds) => bounds,
                None => continue,
            },
            ShapeKind::Disk | ShapeKind::Rectangle => {
                (DVec3::new(-1.0, -1.0, 0.0), DVec3::new(1.0, 1.0, 0.0))
            }
            ShapeKind::Cube => (-DVec3::ONE, DVec3::ONE),
        };
        for corner in 0..8 {
            let pick = |axis: usize| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] };
            let p = shape.world_from_object.transform_point3(DVec3::new(pick(0), pick(1), pick(2)));
            bounds = (bounds.0.min(p), bounds.1.max(p));
        }
    }
    bounds
}
