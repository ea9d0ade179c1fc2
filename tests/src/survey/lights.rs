//! Emitters.

use super::Names::{New, Old};
use super::{Means, Parameter, Plugin, changes, idle, is, sets};

/// On a lamp of its own.
const LAMP: &str = r#"@eye@things<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="180"/><translate x="-0.5" y="-1" z="2.2"/></transform>{}</shape><emitter type="constant"><rgb name="radiance" value="0.01"/></emitter>"#;
/// In a scene that nothing else lights.
const FRAME: &str = "@eye@things{}";
/// Beside a faint sky.
const FAINT: &str = r#"@eye@things{}<emitter type="constant"><rgb name="radiance" value="0.01"/></emitter>"#;

const DOWN: &str =
    r#"<transform name="to_world"><lookat origin="0.5 -2 3" target="0 0 0.5" up="0 0 1"/></transform>"#;
const SCALE: Parameter = sets(r#"<float name="scale" value="2.5"/>"#, "scale: 2.5");
const WEIGHT: Parameter = idle(r#"<float name="sampling_weight" value="2"/>"#);
/// Up in both generations, whose skies have other axes; only the direction counts.
const SUN: Parameter = is(
    r#"<vector name="sun_direction" x="0.3" y="0.4" z="0.8"/>"#,
    r#"<vector name="sun_direction" x="0.6" y="0.8" z="1.6"/>"#,
);

/// All of them.
pub const LIGHTS: &[Plugin] = &[
    Plugin::new(
        LAMP,
        "emitter",
        "area",
        Means::Shows("emission: Some(Emission { name: None, radiance: Constant([1.0, 1.0, 1.0])"),
        &[
            sets(r#"<rgb name="radiance" value="4 5 6"/>"#, "radiance: Constant([4.0, 5.0, 6.0])"),
            sets(
                r#"<texture name="radiance" type="bitmap"><string name="filename" value="glow.exr"/></texture>"#,
                "radiance: Texture(TextureId(0))",
            ),
            WEIGHT,
            // of a private build
            idle(r#"<float name="scale" value="2"/>"#).warned("unused parameter \"scale\""),
            idle(r#"<float name="exponent" value="2"/>"#).warned("unused parameter \"exponent\""),
        ],
    ),
    Plugin::new(
        FRAME,
        "emitter",
        "envmap",
        Means::Shows("EnvMap { image: Image { width: 64, height: 32, texels: Linear32"),
        &[
            SCALE,
            sets(
                r#"<transform name="to_world"><matrix value="0 0 1 0 1 0 0 0 0 1 0 0 0 0 0 1"/></transform>"#,
                "world_from_light: DMat4 { x_axis: DVec4(0.0, 1.0, 0.0, 0.0), y_axis: DVec4(0.0, 0.0, 1.0, 0.0)",
            ),
            WEIGHT,
        ],
    )
    .given(r#"<string name="filename" value="sky.exr"/>"#),
    Plugin::new(FRAME, "emitter", "envmap", Means::Shows("EnvMap { image: Image { width: 8, height: 4, texels: Linear32"), &[])
        .given(r#"<string name="filename" value="p.hdr"/>"#),
    Plugin::new(
        FRAME,
        "emitter",
        "constant",
        Means::Shows("Constant { radiance: [1.0, 1.0, 1.0] }"),
        &[sets(r#"<rgb name="radiance" value="0.3 0.4 0.5"/>"#, "Constant { radiance: [0.3, 0.4, 0.5] }"), WEIGHT],
    ),
    Plugin::new(
        FAINT,
        "emitter",
        "point",
        Means::Shows("Point { position: DVec3(0.0, 0.0, 0.0), intensity: [1.0, 1.0, 1.0] }"),
        &[
            sets(r#"<point name="position" x="0.5" y="-2" z="3"/>"#, "position: DVec3(0.5, -2.0, 3.0)"),
            is(
                r#"<transform name="to_world"><translate x="0.5" y="-2" z="3"/></transform>"#,
                r#"<point name="position" x="0.5" y="-2" z="3"/>"#,
            ),
        ],
    ),
    Plugin::new(
        FAINT,
        "emitter",
        "point",
        Means::Shows("Point"),
        &[sets(r#"<rgb name="intensity" value="20 10 5"/>"#, "intensity: [20.0, 10.0, 5.0]")],
    )
    .given(r#"<point name="position" x="0.5" y="-2" z="3"/>"#),
    Plugin::new(
        FAINT,
        "emitter",
        "spot",
        Means::Shows("intensity: [1.0, 1.0, 1.0], cutoff_deg: 20.0, beam_deg: 15.0"),
        &[
            sets(r#"<rgb name="intensity" value="20 10 5"/>"#, "intensity: [20.0, 10.0, 5.0]"),
            sets(r#"<float name="cutoff_angle" value="40"/>"#, "cutoff_deg: 40.0, beam_deg: 30.0"),
            sets(r#"<float name="beam_width" value="5"/>"#, "cutoff_deg: 20.0, beam_deg: 5.0"),
            sets(
                r#"<texture name="texture" type="bitmap"><string name="filename" value="p.png"/></texture>"#,
                "texture: Texture(TextureId(0))",
            ),
            // of a private build
            idle(r#"<float name="total_angle" value="40"/>"#).warned("unused parameter \"total_angle\""),
            idle(r#"<float name="falloff_angle" value="30"/>"#).warned("unused parameter \"falloff_angle\""),
        ],
    )
    .given(DOWN),
    Plugin::new(
        FAINT,
        "emitter",
        "directional",
        // along +z of its own space: from below the floor
        Means::Keeps("Directional { direction: DVec3(0.0, 0.0, 1.0), irradiance: [1.0, 1.0, 1.0] }"),
        &[
            sets(r#"<vector name="direction" x="0.6" y="0" z="-0.8"/>"#, "direction: DVec3(0.6, 0.0, -0.8)"),
            is(
                r#"<transform name="to_world"><lookat origin="0 0 0" target="0.6 0 -0.8" up="0 1 0"/></transform>"#,
                r#"<vector name="direction" x="0.6" y="0" z="-0.8"/>"#,
            ),
        ],
    ),
    Plugin::new(
        FAINT,
        "emitter",
        "directional",
        Means::Shows("Directional"),
        &[sets(r#"<rgb name="irradiance" value="3 2 1"/>"#, "irradiance: [3.0, 2.0, 1.0]")],
    )
    .given(r#"<vector name="direction" x="0.6" y="0" z="-0.8"/>"#),
    Plugin::new(
        FAINT,
        "emitter",
        "projector",
        Means::Shows("Projector"),
        &[
            // a picture of 4 × 2: tan 20° along its width
            sets(r#"<float name="fov" value="40"/>"#, "half_size: [0.36397023"),
            SCALE,
        ],
    )
    .given(r#"<texture name="irradiance" type="bitmap"><string name="filename" value="p.png"/></texture><transform name="to_world"><lookat origin="0.5 -2 3" target="0 0 0.5" up="0 0 1"/></transform>"#),
    Plugin::new(
        FAINT,
        "emitter",
        "projector",
        Means::Shows("irradiance: Constant([1.0, 1.0, 1.0])"),
        &[sets(r#"<rgb name="irradiance" value="3 2 1"/>"#, "irradiance: Constant([3.0, 2.0, 1.0])")],
    )
    .given(DOWN),
    Plugin::new(
        FRAME,
        "emitter",
        "sunsky",
        Means::Changes,
        &[
            changes(r#"<float name="turbidity" value="6"/>"#),
            SUN,
            changes(r#"<float name="sun_scale" value="0.5"/>"#),
            changes(r#"<float name="sky_scale" value="0.5"/>"#),
            changes(r#"<float name="hour" value="11"/>"#),
            changes(r#"<integer name="year" value="2020"/><integer name="month" value="3"/><integer name="day" value="9"/>"#),
            changes(r#"<float name="minute" value="20"/><float name="second" value="30"/>"#),
            changes(r#"<transform name="to_world"><rotate x="1" angle="40"/></transform>"#),
            changes(r#"<float name="sun_aperture" value="9"/>"#).only(New),
            is(r#"<float name="sun_radius_scale" value="0"/>"#, r#"<float name="sun_aperture" value="0"/>"#)
                .warned("Mitsuba 3 refuses"),
            is(r#"<float name="scale" value="0.5"/>"#, r#"<float name="sun_scale" value="0.5"/><float name="sky_scale" value="0.5"/>"#)
                .warned("Mitsuba 3 refuses"),
        ],
    )
    .warned("*"),
    Plugin::new(
        FRAME,
        "emitter",
        "sun",
        Means::Changes,
        &[
            SUN,
            changes(r#"<float name="sun_radius_scale" value="20"/>"#).warned("Mitsuba 3 refuses"),
            is(r#"<float name="scale" value="0.5"/>"#, r#"<float name="sun_scale" value="0.5"/>"#),
        ],
    )
    .warned("*")
    .only(Old),
    Plugin::new(FRAME, "emitter", "sky", Means::Changes, &[SUN]).warned("*").only(Old),
    Plugin::new(
        FAINT,
        "emitter",
        "ies",
        Means::Shows("Ies {"),
        &[sets(r#"<rgb name="intensity" value="3 2 1"/>"#, "intensity: [3.0, 2.0, 1.0]")],
    )
    .given(r#"<string name="path" value="lamp.ies"/><transform name="to_world"><lookat origin="0.5 -2 3" target="0 0 0.5" up="0 0 1"/></transform>"#)
    .warned("Mitsuba 3 refuses")
    .only(Old),
    Plugin::new(FRAME, "emitter", "difuse", Means::Refused("unknown type \"difuse\""), &[]).only(New),
];
