//! Lights of the table: all that shines in a scene.

use super::Named;

/// What lights the rows of other lists.
pub const LAMP: &str = r#"<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="180"/><translate x="-1" y="-1" z="4"/></transform><emitter type="area"><rgb name="radiance" value="9 8 7"/></emitter></shape>
<emitter type="constant"><rgb name="radiance" value="0.2 0.25 0.3"/></emitter>"#;

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
        r#"<shape type="ply"><string name="filename" value="lamp.ply"/><transform name="to_world"><scale value="0.7"/><translate z="3"/></transform><emitter type="area"><rgb name="radiance" value="12 10 9"/></emitter></shape>"#,
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
];
