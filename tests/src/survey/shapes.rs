//! Shapes.

use super::{Means, Parameter, Plugin, idle, is, sets};

const FRAME: &str = "@eye@light{}";
/// A bsdf that shows texture coordinates, on both sides.
const CHECKS: &str = r#"<bsdf type="twosided"><bsdf type="diffuse"><texture type="checkerboard" name="reflectance"><transform name="to_uv"><scale value="3"/></transform></texture></bsdf></bsdf>"#;

const MOVED: Parameter = sets(
    r#"<transform name="to_world"><rotate x="1" angle="30"/><translate z="0.5"/></transform>"#,
    "DVec4(0.0, 0.0, 0.5, 1.0)",
);
const FLIPPED: Parameter = sets(r#"<boolean name="flip_normals" value="true"/>"#, "flip_normals: true");
const SHINING: Parameter = sets(
    r#"<emitter type="area"><rgb name="radiance" value="4 5 6"/></emitter>"#,
    "emission: Some(Emission { name: None, radiance: Constant([4.0, 5.0, 6.0])",
);
const MATERIAL: Parameter = sets(r#"<bsdf type="plastic"/>"#, "Plastic");
const NAMED_MATERIAL: Parameter = sets(r#"<bsdf type="plastic" name="bsdf"/>"#, "Plastic");
const FLAT: Parameter = sets(r#"<boolean name="face_normals" value="true"/>"#, "normals: [], ");
const SMOOTH: Parameter = idle(r#"<boolean name="face_normals" value="false"/>"#);
const CROSSED: Parameter = Parameter::new(
    r#"<ref name="interior" id="nothing"/>"#,
    Means::Refused("no object has the id \"nothing\""),
);

/// Not the lamp, which is turned.
const RECTANGLE: &str =
    "kind: Rectangle, world_from_object: DMat4 { x_axis: DVec4(1.0, 0.0, 0.0, 0.0), y_axis: DVec4(0.0, 1.0,";

/// All of them.
pub const SHAPES: &[Plugin] = &[
    Plugin::new(
        FRAME,
        "shape",
        "obj",
        // OBJ counts v from the bottom: 0.9 is 0.1
        Means::Shows("uvs: [[0.0, 1.0], [0.5, 0.9], [0.5, 0.1"),
        &[MOVED, FLAT, SMOOTH, SHINING, CROSSED],
    )
    .given(r#"<string name="filename" value="tent.obj"/>"#),
    Plugin::new(
        FRAME,
        "shape",
        "obj",
        Means::Shows("Mesh(Mesh"),
        &[
            sets(r#"<boolean name="flip_tex_coords" value="false"/>"#, "uvs: [[0.0, 0.0], [0.5, 0.1], [0.5, 0.9"),
            FLIPPED,
        ],
    )
    .given(r#"<string name="filename" value="tent.obj"/><bsdf type="diffuse"><texture type="checkerboard" name="reflectance"><transform name="to_uv"><scale value="3"/></transform></texture></bsdf>"#),
    Plugin::new(FRAME, "shape", "obj", Means::Refused("no \"filename\""), &[]),
    Plugin::new(
        FRAME,
        "shape",
        "serialized",
        Means::Shows("positions: [[-1.0, -1.0, 0.0]"),
        &[
            sets(r#"<integer name="shape_index" value="1"/>"#, "positions: [[-0.5, -0.5, 0.0]"),
            idle(r#"<integer name="shape_index" value="0"/>"#),
            Parameter::new(r#"<integer name="shape_index" value="2"/>"#, Means::Refused("two.serialized")),
            MOVED,
            FLAT,
            MATERIAL,
            NAMED_MATERIAL,
            idle(r#"<float name="max_smooth_angle" value="30"/>"#).warned("max_smooth_angle"),
        ],
    )
    .given(r#"<string name="filename" value="two.serialized"/>"#),
    Plugin::new(FRAME, "shape", "rectangle", Means::Shows(RECTANGLE), &[MOVED, SHINING, MATERIAL]),
    Plugin::new(FRAME, "shape", "rectangle", Means::Shows(RECTANGLE), &[MOVED]).given(CHECKS),
    Plugin::new(
        FRAME,
        "shape",
        "sphere",
        Means::Shows("Sphere { center: DVec3(0.0, 0.0, 0.0), radius: 1.0 }"),
        &[
            sets(r#"<float name="radius" value="0.5"/>"#, "radius: 0.5"),
            sets(r#"<point name="center" x="0.2" y="0.1" z="-0.1"/>"#, "center: DVec3(0.2, 0.1, -0.1)"),
            MOVED,
            // both count: the centre is moved, too
            sets(
                r#"<point name="center" x="0.5" y="0" z="0"/><transform name="to_world"><scale value="2"/></transform>"#,
                "center: DVec3(0.5, 0.0, 0.0), radius: 1.0 }, world_from_object: DMat4 { x_axis: DVec4(2.0",
            ),
            FLIPPED,
            NAMED_MATERIAL,
            SHINING,
            idle(r#"<integer name="subdiv" value="4"/>"#).warned("Mitsuba 3 refuses"),
            idle(r#"<boolean name="face_normals" value="true"/>"#),
            CROSSED,
        ],
    ),
    Plugin::new(
        FRAME,
        "shape",
        "ply",
        Means::Shows("Mesh(Mesh"),
        &[
            MOVED,
            FLAT,
            NAMED_MATERIAL,
            is(r#"<boolean name="flip_tex_coords" value="false"/><boolean name="face_normals" value="true"/>"#, r#"<boolean name="face_normals" value="true"/>"#),
            CROSSED,
        ],
    )
    .given(r#"<string name="filename" value="ball.ply"/>"#),
    Plugin::new(
        FRAME,
        "shape",
        "ply",
        // doubles, s and t, and attributes of vertices and faces
        Means::Shows("uvs: [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]"),
        &[sets(r#"<boolean name="flip_tex_coords" value="true"/>"#, "uvs: [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]]")],
    )
    .given(r#"<string name="filename" value="colored.ply"/><bsdf type="diffuse"><texture type="bitmap" name="reflectance"><string name="filename" value="color.png"/></texture></bsdf>"#),
    Plugin::new(
        r#"@eye@light<shape type="shapegroup" id="group"><shape type="sphere"/><shape type="cube"><bsdf type="plastic"/></shape></shape>{}"#,
        "shape",
        "instance",
        Means::Shows("kind: Instance { group: GroupId(0) }"),
        &[MOVED],
    )
    .given(r#"<ref id="group"/>"#),
    Plugin::new(FRAME, "shape", "shapegroup", Means::Keeps("groups: [Group { name"), &[])
        .given(r#"<shape type="sphere"/>"#),
    Plugin::new(FRAME, "shape", "cube", Means::Shows("kind: Cube"), &[MOVED, SHINING]),
    Plugin::new(
        FRAME,
        "shape",
        "cylinder",
        Means::Shows("Cylinder { p0: DVec3(0.0, 0.0, 0.0), p1: DVec3(0.0, 0.0, 1.0), radius: 1.0 }"),
        &[
            sets(r#"<float name="radius" value="0.5"/>"#, "radius: 0.5"),
            sets(r#"<point name="p0" x="0.2" y="0" z="-1"/>"#, "p0: DVec3(0.2, 0.0, -1.0)"),
            sets(r#"<point name="p1" x="0" y="0.3" z="2"/>"#, "p1: DVec3(0.0, 0.3, 2.0)"),
            MOVED,
            FLIPPED,
        ],
    ),
    Plugin::new(FRAME, "shape", "disk", Means::Shows("kind: Disk"), &[MOVED, SHINING]),
    Plugin::new(
        FRAME,
        "shape",
        "merge",
        Means::Shows("kind: Sphere"),
        &[],
    )
    .given(r#"<shape type="sphere"/><shape type="cube"><transform name="to_world"><translate x="1"/></transform></shape>"#),
    // out
    Plugin::new(FRAME, "shape", "Rectangle", Means::Refused("write \"rectangle\""), &[]),
    Plugin::new(FRAME, "shape", "Sphere", Means::Refused("write \"sphere\""), &[]),
    Plugin::new(FRAME, "shape", "bsplinecurve", Means::Refused("out of scope (curves)"), &[]),
    Plugin::new(FRAME, "shape", "linearcurve", Means::Refused("out of scope (curves)"), &[]),
    Plugin::new(FRAME, "shape", "sdfgrid", Means::Refused("out of scope (distance fields)"), &[]),
];
