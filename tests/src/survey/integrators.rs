//! Integrators.

use super::Names::{New, Old};
use super::{Means, Plugin, idle, is, sets};

const FRAME: &str = "{}@eye@things@light";
const WITH_PATH: &str =
    r#"<integrator type="path" name="image"><integer name="max_depth" value="3"/></integrator>"#;

/// All of them.
pub const INTEGRATORS: &[Plugin] = &[
    Plugin::new(
        FRAME,
        "integrator",
        "path",
        Means::Nothing,
        &[
            sets(r#"<integer name="max_depth" value="2"/>"#, "max_depth: Some(2)"),
            idle(r#"<integer name="max_depth" value="-1"/>"#),
            sets(r#"<integer name="rr_depth" value="1"/>"#, "rr_depth: 1,"),
            sets(r#"<boolean name="hide_emitters" value="true"/>"#, "hide_emitters: true"),
            idle(r#"<boolean name="hide_emitters" value="false"/>"#),
            idle(r#"<boolean name="strict_normals" value="false"/>"#).warned("Mitsuba 3 refuses"),
        ],
    ),
    Plugin::new(
        FRAME,
        "integrator",
        "direct",
        Means::Shows("max_depth: Some(2)"),
        &[
            idle(r#"<integer name="emitter_samples" value="4"/>"#),
            idle(r#"<integer name="bsdf_samples" value="4"/>"#),
            idle(r#"<integer name="shading_samples" value="4"/>"#),
            sets(r#"<boolean name="hide_emitters" value="true"/>"#, "hide_emitters: true"),
        ],
    ),
    Plugin::new(
        FRAME,
        "integrator",
        "volpath",
        Means::Keeps("kind: \"volpath\""),
        &[
            sets(r#"<integer name="max_depth" value="2"/>"#, "max_depth: Some(2)"),
            sets(r#"<integer name="rr_depth" value="1"/>"#, "rr_depth: 1,"),
            idle(r#"<boolean name="strict_normals" value="false"/>"#).warned("Mitsuba 3 refuses"),
        ],
    )
    .warned("volpath: rendered with path"),
    Plugin::new(
        FRAME,
        "integrator",
        "aov",
        Means::Shows("max_depth: Some(3)"),
        &[
            sets(
                r#"<string name="aovs" value="albedo:albedo, nn:sh_normal,dd.y:depth"/>"#,
                "aovs: [Albedo, ShadingNormal, Depth]",
            ),
            sets(r#"<string name="aovs" value="p:position,i:shape_index"/>"#, "aovs: [Position, ShapeIndex]"),
            idle(r#"<string name="aovs" value="u:uv"/>"#).warned("no layer is made of uv"),
            idle(r#"<integer name="samples_per_pass" value="4"/>"#),
        ],
    )
    .given(WITH_PATH),
    Plugin::new(FRAME, "integrator", "moment", Means::Shows("max_depth: Some(3)"), &[])
        .given(WITH_PATH)
        .warned("moment: rendered with the integrator inside"),
    Plugin::new(FRAME, "integrator", "stokes", Means::Shows("max_depth: Some(3)"), &[])
        .given(WITH_PATH)
        .warned("stokes: rendered with the integrator inside"),
    Plugin::new(
        FRAME,
        "integrator",
        "bdpt",
        Means::Keeps("kind: \"bdpt\""),
        &[
            sets(r#"<integer name="max_depth" value="2"/>"#, "max_depth: Some(2)"),
            sets(r#"<integer name="rr_depth" value="1"/>"#, "rr_depth: 1,"),
            sets(r#"<boolean name="hide_emitters" value="true"/>"#, "hide_emitters: true"),
            idle(r#"<boolean name="strict_normals" value="false"/>"#).warned("Mitsuba 3 refuses"),
            idle(r#"<integer name="glossy_samples" value="4"/>"#),
            idle(r#"<integer name="direct_samples" value="4"/>"#),
        ],
    )
    .warned("bdpt: rendered with path")
    .only(Old),
    Plugin::new(
        FRAME,
        "integrator",
        "photonmapper",
        Means::Keeps("kind: \"photonmapper\""),
        &[
            sets(r#"<integer name="max_depth" value="2"/>"#, "max_depth: Some(2)"),
            is(
                r#"<integer name="rr_depth" value="1"/><integer name="glossy_samples" value="4"/>"#,
                r#"<integer name="rr_depth" value="1"/>"#,
            ),
        ],
    )
    .warned("photonmapper: rendered with path")
    .only(Old),
    Plugin::new(
        FRAME,
        "integrator",
        "guidedpath",
        Means::Keeps("kind: \"guidedpath\""),
        &[
            idle(r#"<integer name="spp_per_iteration" value="4"/>"#),
            idle(r#"<integer name="max_sample_buffer_size" value="4"/>"#),
            idle(r#"<float name="training_sppfraction" value="0.5"/>"#),
        ],
    )
    .warned("guidedpath: rendered with path"),
    Plugin::new(FRAME, "integrator", "aaf3", Means::Keeps("kind: \"aaf3\""), &[])
        .warned("aaf3: rendered with path"),
    Plugin::new(FRAME, "integrator", "entropy", Means::Keeps("kind: \"entropy\""), &[])
        .warned("entropy: rendered with path"),
    Plugin::new(FRAME, "integrator", "volpathmis", Means::Keeps("kind: \"volpathmis\""), &[])
        .warned("volpathmis: rendered with path")
        .only(New),
];
