//! Shapes of the table.

use super::Named;

/// Shapes, as what takes the place of the ball; the material stands at `{}`.
pub const SHAPES: &[Named] = &[
    (
        "rectangle",
        false,
        r#"<shape type="rectangle"><transform name="to_world"><scale value="0.6"/><rotate x="1" angle="-60"/><translate z="0.7"/></transform>{}</shape>"#,
    ),
    (
        "cube, flipped",
        false,
        r#"<shape type="cube"><boolean name="flip_normals" value="true"/><transform name="to_world"><scale value="0.5"/><rotate z="1" angle="30"/><translate z="0.8"/></transform>{}</shape>"#,
    ),
    (
        "cylinder",
        false,
        r#"<shape type="cylinder"><point name="p0" x="-0.6" y="0.2" z="0.5"/><point name="p1" x="0.5" y="-0.1" z="1.1"/><float name="radius" value="0.45"/>{}</shape>"#,
    ),
    (
        "instances, one of them mirrored",
        true,
        r#"<shape type="shapegroup" id="two"><shape type="ply"><string name="filename" value="ball.ply"/>{}</shape><shape type="cylinder"><point name="p1" x="0.5" y="0" z="1.2"/><float name="radius" value="0.3"/><bsdf type="twosided"><bsdf type="diffuse"/></bsdf></shape></shape>
<shape type="instance"><ref id="two"/><transform name="to_world"><scale x="0.7" y="0.5" z="0.6"/><translate x="-0.5" z="0.8"/></transform></shape>
<shape type="instance"><ref id="two"/><transform name="to_world"><scale x="-0.4" y="0.4" z="0.4"/><rotate x="1" angle="40"/><translate x="0.9" y="-0.3" z="0.7"/></transform></shape>"#,
    ),
    (
        "disk",
        false,
        r#"<shape type="disk"><transform name="to_world"><rotate x="1" angle="-50"/><translate z="0.8"/></transform>{}</shape>"#,
    ),
    (
        "ply with normals",
        true,
        r#"<shape type="ply"><string name="filename" value="ball.ply"/><transform name="to_world"><scale x="0.7" y="0.5" z="0.6"/><translate z="0.8"/></transform>{}</shape>"#,
    ),
    (
        "ply of flat faces",
        false,
        r#"<shape type="ply"><string name="filename" value="ball.ply"/><boolean name="face_normals" value="true"/><transform name="to_world"><scale value="0.7"/><translate z="0.8"/></transform>{}</shape>"#,
    ),
    (
        "sphere far from the origin",
        false,
        r#"<shape type="sphere"><float name="radius" value="0.1"/><point name="center" x="10" y="0" z="0"/><transform name="to_world"><translate x="-10"/><scale value="7"/><translate z="0.8"/></transform>{}</shape>"#,
    ),
    (
        "ply with colours of vertices",
        false,
        r#"<shape type="ply"><string name="filename" value="painted.ply"/><transform name="to_world"><scale value="0.7"/><rotate z="1" angle="25"/><translate z="0.8"/></transform><bsdf type="twosided"><bsdf type="diffuse"><texture name="reflectance" type="mesh_attribute"><string name="name" value="vertex_color"/></texture></bsdf></bsdf></shape>"#,
    ),
    (
        "ply with colours of faces",
        false,
        r#"<shape type="ply"><string name="filename" value="painted.ply"/><transform name="to_world"><scale value="0.7"/><rotate z="1" angle="25"/><translate z="0.8"/></transform><bsdf type="twosided"><bsdf type="roughconductor"><float name="alpha" value="0.4"/><texture name="specular_reflectance" type="mesh_attribute"><string name="name" value="face_color"/></texture></bsdf></bsdf></shape>"#,
    ),
];
