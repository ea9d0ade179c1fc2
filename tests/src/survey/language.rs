//! The language: what stands between and inside the elements, each with the same in plain words.

use super::Construct;

const fn construct(name: &'static str, xml: &'static str, plain: &'static str) -> Construct {
    Construct { name, xml, plain, warned: &[], files: &[], defines: &[] }
}

const fn refused(name: &'static str, xml: &'static str, words: &'static [&'static str]) -> Construct {
    Construct { warned: words, ..construct(name, xml, "") }
}

impl Construct {
    const fn warned(self, warned: &'static [&'static str]) -> Self {
        Self { warned, ..self }
    }

    const fn files(self, files: &'static [(&'static str, &'static str)]) -> Self {
        Self { files, ..self }
    }

    const fn defines(self, defines: &'static [(&'static str, &'static str)]) -> Self {
        Self { defines, ..self }
    }
}

const DEPTH_2: &str =
    r#"<integrator type="path"><integer name="max_depth" value="2"/></integrator>@eye@things@light"#;
const BALL_2: &str = r#"@eye@light<shape type="sphere"><float name="radius" value="2"/></shape>"#;
const RED: &str = r#"@eye@light<shape type="sphere"><bsdf type="diffuse"><rgb name="reflectance" value="0.8 0.2 0.1"/></bsdf></shape>"#;
const GREY: &str = r#"@eye@light<shape type="sphere"><bsdf type="diffuse"><rgb name="reflectance" value="0.4 0.4 0.4"/></bsdf></shape>"#;
const GLOW: &str =
    r#"@eye<shape type="sphere"><emitter type="area"><rgb name="radiance" value="3 2 1"/></emitter></shape>"#;
const MOVED: &str = r#"@eye@light<shape type="cube"><transform name="to_world"><matrix value="1 0 0 0.1 0 1 0 0.2 0 0 1 0.3 0 0 0 1"/></transform></shape>"#;
const STRETCHED: &str = r#"@eye@light<shape type="cube"><transform name="to_world"><matrix value="2 0 0 0 0 3 0 0 0 0 0.5 0 0 0 0 1"/></transform></shape>"#;
const GROWN: &str = r#"@eye@light<shape type="cube"><transform name="to_world"><matrix value="2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1"/></transform></shape>"#;
const TURNED: &str = r#"@eye@light<shape type="cube"><transform name="to_world"><matrix value="0 -1 0 0 1 0 0 0 0 0 1 0 0 0 0 1"/></transform></shape>"#;
const MIRRORED: &str = r#"@light@things<sensor type="perspective">@film<float name="fov" value="40"/><transform name="to_world"><matrix value="1 0 0 0.5 0 0 1 -5 0 1 0 1 0 0 0 1"/></transform></sensor>"#;
const ALONG_Y: &str = r#"@light@things<sensor type="perspective">@film<float name="fov" value="40"/><transform name="to_world"><matrix value="-1 0 0 0.5 0 0 1 -5 0 1 0 1 0 0 0 1"/></transform></sensor>"#;

/// All of them.
pub const CONSTRUCTS: &[Construct] = &[
    // parameters
    construct(
        "<default> and $name in an integer",
        r#"<default name="d" value="2"/><integrator type="path"><integer name="max_depth" value="$d"/></integrator>@eye@things@light"#,
        DEPTH_2,
    ),
    construct(
        "-D before <default>",
        r#"<default name="d" value="7"/><integrator type="path"><integer name="max_depth" value="$d"/></integrator>@eye@things@light"#,
        DEPTH_2,
    )
    .defines(&[("d", "2")]),
    construct(
        "$name as the integrator type",
        r#"<default name="integrator" value="path"/><integrator type="$integrator"><integer name="max_depth" value="2"/></integrator>@eye@things@light"#,
        DEPTH_2,
    ),
    construct(
        "$method, which -D makes path",
        r#"<default name="method" value="sppm"/><integrator type="$method"><integer name="max_depth" value="2"/></integrator>@eye@things@light"#,
        DEPTH_2,
    )
    .defines(&[("method", "path")]),
    construct(
        "$name in a boolean",
        r#"<default name="h" value="true"/><integrator type="path"><boolean name="hide_emitters" value="$h"/></integrator>@eye@things@light"#,
        r#"<integrator type="path"><boolean name="hide_emitters" value="true"/></integrator>@eye@things@light"#,
    ),
    construct(
        "$name in a part of a string",
        r#"<default name="kind" value="p"/>@eye@light<shape type="rectangle"><bsdf type="diffuse"><texture type="bitmap" name="reflectance"><string name="filename" value="$kind.png"/></texture></bsdf></shape>"#,
        r#"@eye@light<shape type="rectangle"><bsdf type="diffuse"><texture type="bitmap" name="reflectance"><string name="filename" value="p.png"/></texture></bsdf></shape>"#,
    ),
    construct(
        "$name as a whole matrix",
        r#"<default name="m" value="1 0 0 0.1 0 1 0 0.2 0 0 1 0.3 0 0 0 1"/>@eye@light<shape type="cube"><transform name="to_world"><matrix value="$m"/></transform></shape>"#,
        MOVED,
    ),
    construct(
        "$name in a spectrum",
        r#"<default name="s" value="0.4"/>@eye@light<shape type="sphere"><bsdf type="diffuse"><spectrum name="reflectance" value="$s"/></bsdf></shape>"#,
        GREY,
    ),
    construct(
        "$name in a float",
        r#"<default name="r" value="2"/>@eye@light<shape type="sphere"><float name="radius" value="$r"/></shape>"#,
        BALL_2,
    ),
    refused(
        "a parameter without a value",
        r#"@eye@light<shape type="sphere"><float name="radius" value="$r"/></shape>"#,
        &["the parameter $r has no value"],
    ),
    // references
    construct(
        "<ref id> without a name, before its object",
        r#"@eye@light<shape type="sphere"><ref id="red"/></shape><bsdf type="diffuse" id="red"><rgb name="reflectance" value="0.8 0.2 0.1"/></bsdf>"#,
        RED,
    ),
    construct(
        "<ref name id>, to a bsdf",
        r#"@eye@light<bsdf type="diffuse" id="red"><rgb name="reflectance" value="0.8 0.2 0.1"/></bsdf><shape type="sphere"><ref name="bsdf" id="red"/></shape>"#,
        RED,
    ),
    construct(
        "<ref name id>, to a texture",
        r#"<texture type="checkerboard" id="t"/>@eye@light<shape type="sphere"><bsdf type="diffuse"><ref name="reflectance" id="t"/></bsdf></shape>"#,
        r#"@eye@light<shape type="sphere"><bsdf type="diffuse"><texture name="reflectance" type="checkerboard"/></bsdf></shape>"#,
    ),
    construct(
        "<ref id>, to an emitter at the top",
        r#"@eye<emitter type="area" id="lamp"><rgb name="radiance" value="3 2 1"/></emitter><shape type="sphere"><ref id="lamp"/></shape>"#,
        GLOW,
    ),
    construct(
        "<ref id>, inside twosided",
        r#"@eye@light<bsdf type="diffuse" id="in"/><shape type="sphere"><bsdf type="twosided"><ref id="in"/></bsdf></shape>"#,
        r#"@eye@light<shape type="sphere"><bsdf type="twosided"><bsdf type="diffuse"/></bsdf></shape>"#,
    ),
    construct(
        "<alias>",
        r#"@eye@light<bsdf type="diffuse" id="red"><rgb name="reflectance" value="0.8 0.2 0.1"/></bsdf><alias id="red" as="rouge"/><shape type="sphere"><ref id="rouge"/></shape>"#,
        RED,
    ),
    refused(
        "a <ref> to nothing",
        r#"@eye@light<shape type="sphere"><ref id="red"/></shape>"#,
        &["no object has the id \"red\""],
    ),
    // other files
    construct("<include>", r#"@eye@light<include filename="part.xml"/>"#, BALL_2)
        .files(&[("part.xml", r#"<scene version="3.0.0"><shape type="sphere"><float name="radius" value="2"/></shape></scene>"#)]),
    construct(
        "<include> of a file of 0.x, by its own version",
        r#"@eye@light<include filename="old.xml"/>"#,
        STRETCHED,
    )
    .files(&[(
        "old.xml",
        r#"<scene version="0.5.0"><shape type="cube"><transform name="toWorld"><scale x="2" y="3" z="0.5"/></transform></shape></scene>"#,
    )]),
    construct(
        "an id across included files, before its object",
        r#"@eye@light<shape type="sphere"><ref id="red"/></shape><include filename="red.xml"/>"#,
        RED,
    )
    .files(&[(
        "red.xml",
        r#"<scene version="3.0.0"><bsdf type="diffuse" id="red"><rgb name="reflectance" value="0.8 0.2 0.1"/></bsdf></scene>"#,
    )]),
    construct("<path>", r#"<path value="lib"/>@eye@light<include filename="ball.xml"/>"#, BALL_2)
        .files(&[("lib/ball.xml", r#"<scene version="3.0.0"><shape type="sphere"><float name="radius" value="2"/></shape></scene>"#)]),
    refused("<hide>", r#"@eye@light<hide id="x"/>"#, &["unknown element <hide>"]),
    refused("<mode>", r#"@eye@light<mode name="x"/>"#, &["unknown element <mode>"]),
    // names and numbers
    construct(
        "camelCase names",
        r#"<scene version="0.6.0"><sensor type="perspective"><float name="fov" value="40"/><transform name="toWorld"><lookat origin="0.5 -5 3" target="0.3 0 0.6" up="0 0 1"/></transform>@film</sensor>@light<shape type="sphere"><bsdf type="dielectric"><float name="intIOR" value="1.7"/><float name="extIOR" value="1"/><rgb name="specularTransmittance" value="0.5"/></bsdf></shape></scene>"#,
        r#"@eye@light<shape type="sphere"><bsdf type="dielectric"><float name="int_ior" value="1.7"/><float name="ext_ior" value="1"/><rgb name="specular_transmittance" value="0.5"/></bsdf></shape>"#,
    ),
    construct(
        "exponents, and blanks before commas",
        r#"@eye@light<shape type="cube"><transform name="to_world"><matrix value="1 -4.37114e-008 0 ,1e-1, 0 1.0E+0	0 2e-1 0 0 1 .3 0 0 0 1"/></transform></shape>"#,
        MOVED,
    ),
    // transforms
    construct(
        "translate x y z",
        r#"@eye@light<shape type="cube"><transform name="to_world"><translate x="0.1" y="0.2" z="0.3"/></transform></shape>"#,
        MOVED,
    ),
    construct(
        "translate value",
        r#"@eye@light<shape type="cube"><transform name="to_world"><translate value="0.1, 0.2, 0.3"/></transform></shape>"#,
        MOVED,
    ),
    construct(
        "scale x y z",
        r#"@eye@light<shape type="cube"><transform name="to_world"><scale x="2" y="3" z="0.5"/></transform></shape>"#,
        STRETCHED,
    ),
    construct(
        "scale by three numbers in value",
        r#"@eye@light<shape type="cube"><transform name="to_world"><scale value="2 3 0.5"/></transform></shape>"#,
        STRETCHED,
    ),
    construct(
        "scale by one number in value",
        r#"@eye@light<shape type="cube"><transform name="to_world"><scale value="2"/></transform></shape>"#,
        GROWN,
    ),
    construct(
        "rotate x y z angle",
        r#"@eye@light<shape type="cube"><transform name="to_world"><rotate z="1" angle="90"/></transform></shape>"#,
        TURNED,
    ),
    construct(
        "rotate value angle",
        r#"@eye@light<shape type="cube"><transform name="to_world"><rotate value="0, 0, 1" angle="90"/></transform></shape>"#,
        TURNED,
    ),
    construct(
        "a matrix of nine numbers",
        r#"@eye@light<shape type="cube"><transform name="to_world"><matrix value="2 0 0 0 3 0 0 0 0.5"/></transform></shape>"#,
        STRETCHED,
    ),
    // x is to the left of the picture: looking along +y with +z up it is −x of the world
    construct(
        "lookat",
        r#"@light@things<sensor type="perspective">@film<float name="fov" value="40"/><transform name="to_world"><lookat origin="0.5 -5 1" target="0.5 4 1" up="0 0 1"/></transform></sensor>"#,
        ALONG_Y,
    ),
    construct(
        "lookAt of 0.x",
        r#"@light@things<sensor type="perspective">@film<float name="fov" value="40"/><transform name="to_world"><lookAt origin="0.5, -5, 1" target="0.5, 4, 1" up="0, 0, 1"/></transform></sensor>"#,
        ALONG_Y,
    )
    .warned(&["Mitsuba 3 refuses"]),
    construct(
        "scale x=-1 before lookat: the picture of 0.4",
        r#"@light@things<sensor type="perspective">@film<float name="fov" value="40"/><transform name="to_world"><scale x="-1"/><lookat origin="0.5 -5 1" target="0.5 4 1" up="0 0 1"/></transform></sensor>"#,
        MIRRORED,
    ),
    construct(
        "of several operations the first acts first",
        r#"@eye@light<shape type="cube"><transform name="to_world"><translate x="1"/><rotate z="1" angle="90"/><scale x="2" y="3" z="1"/></transform></shape>"#,
        // (1, 0, 0) is turned to (0, 1, 0), then scaled to (0, 3, 0)
        r#"@eye@light<shape type="cube"><transform name="to_world"><matrix value="0 -2 0 0 3 0 0 3 0 0 1 0 0 0 0 1"/></transform></shape>"#,
    ),
    // colours
    construct(
        "<rgb> with commas",
        r#"@eye@light<shape type="sphere"><bsdf type="diffuse"><rgb name="reflectance" value="0.8, 0.2, 0.1"/></bsdf></shape>"#,
        RED,
    ),
    construct(
        "<rgb> with commas, blanks and tabs",
        r#"@eye@light<shape type="sphere"><bsdf type="diffuse"><rgb name="reflectance" value=" .8 ,0.2	0.1 "/></bsdf></shape>"#,
        RED,
    ),
    construct(
        "<rgb> of one number",
        r#"@eye@light<shape type="sphere"><bsdf type="diffuse"><rgb name="reflectance" value="0.4"/></bsdf></shape>"#,
        GREY,
    ),
    construct(
        "<rgb value=\"#rrggbb\">",
        // 0x80 / 255 decoded
        r##"@eye@light<shape type="sphere"><bsdf type="diffuse"><rgb name="reflectance" value="#ff8000"/></bsdf></shape>"##,
        r#"@eye@light<shape type="sphere"><bsdf type="diffuse"><rgb name="reflectance" value="1 0.2158605 0"/></bsdf></shape>"#,
    )
    .warned(&["Mitsuba 3 refuses"]),
    construct(
        "<srgb>",
        r#"@eye@light<shape type="sphere"><bsdf type="diffuse"><srgb name="reflectance" value="1, 0.5, 0"/></bsdf></shape>"#,
        r#"@eye@light<shape type="sphere"><bsdf type="diffuse"><rgb name="reflectance" value="1 0.2140411 0"/></bsdf></shape>"#,
    )
    .warned(&["Mitsuba 3 refuses"]),
    construct(
        "<spectrum> of one number",
        r#"@eye@light<shape type="sphere"><bsdf type="diffuse"><spectrum name="reflectance" value="0.4"/></bsdf></shape>"#,
        GREY,
    ),
    construct(
        "<spectrum> of one number that shines is white of equal energy",
        r#"@eye<shape type="sphere"><emitter type="area"><spectrum name="radiance" value="0.5"/></emitter></shape>"#,
        r#"@eye<shape type="sphere"><emitter type="area"><rgb name="radiance" value="0.602397 0.4741455 0.454458"/></emitter></shape>"#,
    ),
    construct(
        "<spectrum> of pairs, reflected",
        // what Mitsuba 3.9.1 makes of it
        r#"@eye@light<shape type="sphere"><bsdf type="diffuse"><spectrum name="reflectance" value="400:1, 700:1"/></bsdf></shape>"#,
        r#"@eye@light<shape type="sphere"><bsdf type="diffuse"><rgb name="reflectance" value="0.995342 0.9997564 0.9949091"/></bsdf></shape>"#,
    ),
    construct(
        "<spectrum> of pairs, emitted",
        // likewise
        r#"@eye<shape type="sphere"><emitter type="area"><spectrum name="radiance" value="400:0, 500:8, 600:15.6, 700:18.4"/></emitter></shape>"#,
        r#"@eye<shape type="sphere"><emitter type="area"><rgb name="radiance" value="20.710836 10.854634 2.771152"/></emitter></shape>"#,
    ),
    construct(
        "<spectrum> of three numbers",
        r#"@eye@light<shape type="sphere"><bsdf type="diffuse"><spectrum name="reflectance" value="0.8 0.2 0.1"/></bsdf></shape>"#,
        RED,
    )
    .warned(&["Mitsuba 3 refuses"]),
    construct(
        "<spectrum filename>",
        r#"@eye@light<shape type="sphere"><bsdf type="diffuse"><spectrum name="reflectance" filename="steps.spd"/></bsdf></shape>"#,
        r#"@eye@light<shape type="sphere"><bsdf type="diffuse"><spectrum name="reflectance" value="400:0.1, 700:0.9"/></bsdf></shape>"#,
    ),
    construct(
        "<blackbody>",
        r#"@eye<emitter type="point"><blackbody name="intensity" temperature="6500"/><point name="position" x="1" y="-3" z="4"/></emitter>@things"#,
        r#"@eye<emitter type="point"><blackbody name="intensity" temperature="6500K"/><point name="position" x="1" y="-3" z="4"/></emitter>@things"#,
    ),
    // points and vectors
    construct(
        "<point value>",
        r#"@eye@light<shape type="sphere"><point name="center" value="0.1, 0.2, 0.3"/></shape>"#,
        r#"@eye@light<shape type="sphere"><point name="center" x="0.1" y="0.2" z="0.3"/></shape>"#,
    ),
    construct(
        "<vector value>",
        r#"@eye@things<emitter type="directional"><vector name="direction" value="0.6, 0, -0.8"/></emitter>"#,
        r#"@eye@things<emitter type="directional"><vector name="direction" x="0.6" z="-0.8"/></emitter>"#,
    ),
    construct(
        "a length with its unit",
        r#"@things@light<sensor type="perspective"><string name="focal_length" value="50mm"/><transform name="to_world"><lookat origin="0.5 -5 3" target="0.3 0 0.6" up="0 0 1"/></transform>@film</sensor>"#,
        r#"@things@light<sensor type="perspective"><transform name="to_world"><lookat origin="0.5 -5 3" target="0.3 0 0.6" up="0 0 1"/></transform>@film</sensor>"#,
    ),
    construct(
        "an unknown parameter is passed over",
        r#"@eye@light<shape type="sphere"><float name="radius" value="2"/><float name="shine" value="1"/></shape>"#,
        BALL_2,
    )
    .warned(&["unused parameter \"shine\""]),
    // what is not said
    construct(
        "a shape without a bsdf is grey",
        r#"@eye@light<shape type="sphere"/>"#,
        r#"@eye@light<shape type="sphere"><bsdf type="diffuse"><rgb name="reflectance" value="0.5"/></bsdf></shape>"#,
    ),
    construct(
        "a shape without a bsdf that shines is black",
        r#"@eye<shape type="sphere"><emitter type="area"/></shape>"#,
        r#"@eye<shape type="sphere"><emitter type="area"/><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></shape>"#,
    ),
    construct(
        "a reflectance beyond 1 is clamped, an emission is not",
        r#"@eye<shape type="sphere"><emitter type="area"><rgb name="radiance" value="3 2 1"/></emitter><bsdf type="diffuse"><rgb name="reflectance" value="1.5 0.5 0.5"/></bsdf></shape>"#,
        r#"@eye<shape type="sphere"><emitter type="area"><rgb name="radiance" value="3 2 1"/></emitter><bsdf type="diffuse"><rgb name="reflectance" value="1 0.5 0.5"/></bsdf></shape>"#,
    )
    .warned(&["a reflectance beyond 0 to 1"]),
    // files and where they are found
    construct(
        "blanks, capitals and backslashes in the name of a file",
        r#"@eye@light<shape type="rectangle"><bsdf type="diffuse"><texture type="bitmap" name="reflectance"><string name="filename" value=".\TWO words.png"/></texture></bsdf></shape>"#,
        r#"@eye@light<shape type="rectangle"><bsdf type="diffuse"><texture type="bitmap" name="reflectance"><string name="filename" value="p.png"/></texture></bsdf></shape>"#,
    )
    .warned(&["was found as"]),
];
