//! Cameras. Theirs look along −z with +x to the right; ours along +z with +x to the left.

use glam::{DMat4, DVec3};

use super::Reader;
use super::json::{EXPORT_AGAIN, Item};
use crate::{FovAxis, Projection, SceneError, standins};

impl Reader<'_> {
    pub(super) fn camera(&mut self, node: &Item<'_>, index: usize, world: DMat4) -> Result<(), SceneError> {
        let item = self.document.entry("cameras", index)?;
        let Some(mut world_from_camera) = upright(world) else {
            self.warn(&node.path, "its transform leaves the camera no direction; the camera is left out");
            return Ok(());
        };
        let (lens, size, projection);
        match item.string("type")? {
            Some("perspective") => {
                lens = part(&item, "perspective")?;
                let yfov = required(&lens, "yfov")?;
                if !(yfov > 0.0 && yfov < std::f64::consts::PI) {
                    let problem = format!("an angle of {yfov} radians");
                    return Err(lens.error("yfov", problem, "give an angle between 0 and 3.14"));
                }
                size = film(lens.number("aspectRatio")?);
                projection = Projection::Perspective {
                    fov_deg: yfov.to_degrees(),
                    fov_axis: FovAxis::Y,
                    principal_point_offset: [0.0; 2],
                };
            }
            Some("orthographic") => {
                lens = part(&item, "orthographic")?;
                let [x, y] = [required(&lens, "xmag")?.abs(), required(&lens, "ymag")?.abs()];
                if !(x > 0.0 && y > 0.0 && (x as f32).is_normal()) {
                    return Err(lens.error("xmag", "nothing to see", "give half of what the picture shows"));
                }
                size = film(Some(x / y));
                projection = Projection::Orthographic;
                world_from_camera *= DMat4::from_scale(DVec3::new(x, x, 1.0));
            }
            other => {
                let problem = format!("unknown type \"{}\"", other.unwrap_or_default());
                return Err(item.error("type", problem, "perspective and orthographic are known"));
            }
        }
        let name = match (item.get("name"), node.get("name")) {
            (None, Some(_)) => node.name_or("camera", 0),
            _ => item.name_or("camera", self.scene.cameras.len()),
        };
        let name = self.unique_camera(name);
        let mut camera = standins::camera(name, world_from_camera, projection, size, self.place());
        camera.near_clip = lens.number("znear")?.filter(|near| *near > 0.0);
        camera.far_clip = lens.number("zfar")?.filter(|far| *far > camera.near_clip.unwrap_or(0.0));
        self.scene.cameras.push(camera);
        Ok(())
    }

    /// `name`, or with a number where an earlier camera has it: `--camera` must find each.
    fn unique_camera(&mut self, name: String) -> String {
        let mut unique = name.clone();
        loop {
            let count = self.camera_names.entry(name.clone()).or_default();
            *count += 1;
            if *count > 1 {
                unique = format!("{name} {count}");
            }
            if unique == name || !self.camera_names.contains_key(&unique) {
                self.camera_names.entry(unique.clone()).or_insert(1);
                return unique;
            }
        }
    }
}

fn part<'a>(item: &Item<'a>, key: &str) -> Result<Item<'a>, SceneError> {
    item.object(key)?.ok_or_else(|| item.error(key, "not there", EXPORT_AGAIN))
}

fn required(item: &Item<'_>, key: &str) -> Result<f64, SceneError> {
    item.number(key)?.ok_or_else(|| item.error(key, "not there", EXPORT_AGAIN))
}

/// The place and the view of a camera or a light, whose scale does not count; half round its y axis from theirs to ours.
pub(super) fn upright(world: DMat4) -> Option<DMat4> {
    let z = -world.z_axis.truncate().try_normalize()?;
    let y = world.y_axis.truncate();
    let y = (y - z * z.dot(y)).try_normalize()?;
    let matrix = DMat4::from_cols(y.cross(z).extend(0.0), y.extend(0.0), z.extend(0.0), world.w_axis);
    matrix.is_finite().then_some(matrix)
}

/// The largest picture within the default one that has an aspect ratio; the default where it has none.
fn film(aspect: Option<f64>) -> [u32; 2] {
    let [width, height] = standins::SIZE;
    let Some(aspect) = aspect.filter(|aspect| aspect.is_finite() && *aspect > 0.0) else {
        return standins::SIZE;
    };
    let pixels = |length: f64, most: u32| (length.round() as u32).clamp(1, most);
    if aspect * f64::from(height) > f64::from(width) {
        [width, pixels(f64::from(width) / aspect, height)]
    } else {
        [pixels(f64::from(height) * aspect, width), height]
    }
}
