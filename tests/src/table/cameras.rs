//! Cameras of the table.

use super::Named;

/// All of them; film and place stand at `{}`.
pub const CAMERAS: &[Named] = &[
    (
        "perspective, fov along y, shifted",
        true,
        r#"<sensor type="perspective"><float name="fov" value="35"/><string name="fov_axis" value="y"/><float name="principal_point_offset_x" value="0.1"/>{}</sensor>"#,
    ),
    (
        "perspective by focal length",
        false,
        r#"<sensor type="perspective"><string name="focal_length" value="60mm"/>{}</sensor>"#,
    ),
];
