//! Cameras of the table.

use super::Named;

/// All of them; place and film stand at `{}`, or the film alone at `{film}`.
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
    (
        "thinlens",
        false,
        r#"<sensor type="thinlens"><float name="fov" value="40"/><float name="aperture_radius" value="0.25"/><float name="focus_distance" value="4"/>{}</sensor>"#,
    ),
    (
        "orthographic",
        false,
        r#"<sensor type="orthographic"><transform name="to_world"><scale x="1.8" y="1.8"/><lookat origin="0.5 -5 3" target="0.3 0 0.6" up="0 0 1"/></transform>{film}</sensor>"#,
    ),
    (
        "perspective, mirrored and turned",
        false,
        r#"<sensor type="perspective"><float name="fov" value="40"/><transform name="to_world"><scale x="-1"/><rotate z="1" angle="25"/><lookat origin="0.5 -5 3" target="0.3 0 0.6" up="0 0 1"/></transform>{film}</sensor>"#,
    ),
    (
        "perspective, near and far clip",
        false,
        r#"<sensor type="perspective"><float name="fov" value="40"/><float name="near_clip" value="5.2"/><float name="far_clip" value="6.5"/>{}</sensor>"#,
    ),
    (
        "thinlens, mirrored, clipped",
        false,
        r#"<sensor type="thinlens"><float name="fov" value="35"/><string name="fov_axis" value="y"/><float name="aperture_radius" value="0.1"/><float name="focus_distance" value="6"/><float name="near_clip" value="5"/><transform name="to_world"><scale y="-1"/><lookat origin="0.5 -5 3" target="0.3 0 0.6" up="0 0 1"/></transform>{film}</sensor>"#,
    ),
];
