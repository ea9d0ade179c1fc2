//! Lights of the table: all that shines in a scene.

use super::Named;

/// What lights the rows of other lists.
pub const LAMP: &str = r#"<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="180"/><translate x="-1" y="-1" z="4"/></transform><emitter type="area"><rgb name="radiance" value="9 8 7"/></emitter></shape>
<emitter type="constant"><rgb name="radiance" value="0.2 0.25 0.3"/></emitter>"#;

/// A ball and a plate of light before a sky, in the picture: what `hide_emitters` is about.
pub const LAMPS_IN_VIEW: &str = r#"<shape type="sphere"><float name="radius" value="0.3"/><point name="center" x="-1" y="-0.5" z="1.2"/><emitter type="area"><rgb name="radiance" value="9 8 7"/></emitter></shape>
<shape type="rectangle"><transform name="to_world"><scale value="0.4"/><rotate x="1" angle="90"/><translate x="1" y="2" z="1.2"/></transform><emitter type="area"><rgb name="radiance" value="2 4 8"/></emitter></shape>
<emitter type="envmap"><string name="filename" value="sky.exr"/><transform name="to_world"><rotate x="1" angle="90"/></transform></emitter>"#;

/// All of them.
pub const LIGHTS: &[Named] = &[
    (
        "area, cylinder",
        false,
        r#"<shape type="cylinder"><point name="p0" x="-2" y="-1.5" z="3.2"/><point name="p1" x="-0.5" y="-1" z="3.5"/><float name="radius" value="0.3"/><emitter type="area"><rgb name="radiance" value="12 10 8"/></emitter></shape>"#,
    ),
    (
        "area, sphere",
        true,
        r#"<shape type="sphere"><float name="radius" value="0.5"/><point name="center" x="-1" y="-1.5" z="3.5"/><emitter type="area"><rgb name="radiance" value="30 25 20"/></emitter></shape>"#,
    ),
    (
        "area, disk, tilted",
        false,
        r#"<shape type="disk"><transform name="to_world"><scale x="1" y="0.5"/><rotate x="1" angle="150"/><translate y="-1.5" z="3.5"/></transform><emitter type="area"><rgb name="radiance" value="30 25 20"/></emitter></shape>"#,
    ),
    (
        "area, mesh",
        false,
        r#"<shape type="ply"><string name="filename" value="lamp.ply"/><boolean name="face_normals" value="true"/><transform name="to_world"><scale value="0.7"/><translate z="3"/></transform><emitter type="area"><rgb name="radiance" value="12 10 9"/></emitter></shape>"#,
    ),
    (
        "area, bitmap",
        false,
        r#"<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="180"/><translate z="3.5"/></transform><emitter type="area"><texture name="radiance" type="bitmap"><string name="filename" value="glow.exr"/></texture></emitter></shape>"#,
    ),
    ("constant", false, r#"<emitter type="constant"/>"#),
    (
        "envmap",
        true,
        r#"<emitter type="envmap"><string name="filename" value="sky.exr"/><float name="scale" value="0.8"/><transform name="to_world"><rotate x="1" angle="90"/><rotate z="1" angle="40"/></transform></emitter>"#,
    ),
    (
        "three at once",
        false,
        r#"<emitter type="constant"><rgb name="radiance" value="0.1"/></emitter><shape type="sphere"><float name="radius" value="0.1"/><point name="center" x="1" y="-1.5" z="2.5"/><emitter type="area"><rgb name="radiance" value="300 100 50"/></emitter></shape><shape type="rectangle"><transform name="to_world"><scale value="0.2"/><rotate x="1" angle="180"/><translate x="-1" z="2"/></transform><emitter type="area"><rgb name="radiance" value="20 60 90"/></emitter></shape>"#,
    ),
    (
        "area, bitmap on a sphere",
        false,
        r#"<shape type="sphere"><float name="radius" value="0.5"/><point name="center" x="-1" y="-1.5" z="3.5"/><emitter type="area"><texture name="radiance" type="bitmap"><string name="filename" value="glow.exr"/></texture></emitter></shape>"#,
    ),
    (
        "area, bitmap on a disk",
        false,
        r#"<shape type="disk"><transform name="to_world"><scale x="1" y="0.5"/><rotate x="1" angle="150"/><translate y="-1.5" z="3.5"/></transform><emitter type="area"><texture name="radiance" type="bitmap"><string name="filename" value="glow.exr"/></texture></emitter></shape>"#,
    ),
    (
        "area, bitmap on a cylinder",
        false,
        r#"<shape type="cylinder"><point name="p0" x="-2" y="-1.5" z="3"/><point name="p1" x="-1" y="-1.5" z="4"/><float name="radius" value="0.3"/><emitter type="area"><texture name="radiance" type="bitmap"><string name="filename" value="glow.exr"/></texture></emitter></shape>"#,
    ),
    (
        "point",
        false,
        r#"<emitter type="point"><point name="position" x="-1" y="-1.5" z="3"/><rgb name="intensity" value="9 8 6"/></emitter>"#,
    ),
    (
        "spot",
        false,
        r#"<emitter type="spot"><transform name="to_world"><lookat origin="-1 -2 4" target="0.3 0 0" up="0 0 1"/></transform><rgb name="intensity" value="40 35 30"/><float name="cutoff_angle" value="30"/><float name="beam_width" value="12"/></emitter>"#,
    ),
    (
        "spot, bitmap",
        false,
        r#"<emitter type="spot"><transform name="to_world"><lookat origin="-1 -2 4" target="0.3 0 0" up="0 0 1"/></transform><rgb name="intensity" value="40 35 30"/><float name="cutoff_angle" value="35"/><texture name="texture" type="bitmap"><string name="filename" value="color.png"/></texture></emitter>"#,
    ),
    (
        "directional",
        false,
        r#"<emitter type="directional"><vector name="direction" x="0.4" y="0.5" z="-1"/><rgb name="irradiance" value="3 2.5 2"/></emitter>"#,
    ),
    (
        "directional by to_world",
        false,
        r#"<emitter type="directional"><transform name="to_world"><lookat origin="0 0 0" target="-0.5 0.5 -1" up="0 0 1"/></transform><rgb name="irradiance" value="3 2.5 2"/></emitter>"#,
    ),
    (
        "projector, bitmap",
        false,
        r#"<emitter type="projector"><transform name="to_world"><lookat origin="-0.5 -2 4" target="0.3 0 0" up="0 0 1"/></transform><texture name="irradiance" type="bitmap"><string name="filename" value="color.png"/></texture><float name="scale" value="20"/><float name="fov" value="60"/></emitter>"#,
    ),
    (
        "sunsky",
        false,
        r#"<emitter type="sunsky"><vector name="sun_direction" x="-0.4" y="-0.5" z="0.8"/></emitter>"#,
    ),
    (
        "sun",
        false,
        r#"<emitter type="sunsky"><vector name="sun_direction" x="-0.4" y="-0.5" z="0.8"/><float name="sky_scale" value="0"/><float name="turbidity" value="5"/></emitter>"#,
    ),
    (
        "sun, wide",
        false,
        r#"<emitter type="sunsky"><vector name="sun_direction" x="-0.4" y="-0.5" z="0.8"/><float name="sky_scale" value="0"/><float name="sun_scale" value="2"/><float name="sun_aperture" value="12"/></emitter>"#,
    ),
    (
        "sky",
        false,
        r#"<emitter type="sunsky"><vector name="sun_direction" x="-0.4" y="-0.5" z="0.8"/><float name="sun_scale" value="0"/></emitter>"#,
    ),
    (
        "sky, low sun in haze",
        false,
        r#"<emitter type="sunsky"><vector name="sun_direction" x="0.6" y="-0.8" z="0.1"/><float name="sun_scale" value="0"/><float name="turbidity" value="7.3"/><rgb name="albedo" value="0.1 0.4 0.9"/><float name="sky_scale" value="3"/></emitter>"#,
    ),
    (
        "sunsky of a low sun",
        false,
        r#"<emitter type="sunsky"><vector name="sun_direction" x="0.6" y="-0.8" z="0.07"/><float name="turbidity" value="2.5"/><rgb name="albedo" value="0.8 0.5 0.2"/></emitter>"#,
    ),
    (
        "sunsky by place and time, tilted",
        false,
        r#"<emitter type="sunsky"><float name="hour" value="10"/><float name="latitude" value="48"/><float name="longitude" value="11"/><float name="timezone" value="1"/><transform name="to_world"><rotate x="1" angle="15"/><rotate z="1" angle="140"/></transform></emitter>"#,
    ),
];
