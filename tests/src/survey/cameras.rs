//! Cameras, films, pixel filters and samplers.

use super::Names::Old;
use super::{Means, Parameter, Plugin, idle, sets};

const VIEW: &str = r#"<transform name="to_world"><lookat origin="0.5 -5 3" target="0.3 0 0.6" up="0 0 1"/></transform>@film"#;
const LENS: &str = r#"<transform name="to_world"><lookat origin="0.5 -5 3" target="0.3 0 0.6" up="0 0 1"/></transform>@film<float name="aperture_radius" value="0.3"/><float name="fov" value="40"/>"#;
const FLAT: &str = r#"<transform name="to_world"><scale x="2.5" y="2.5"/><lookat origin="0.5 -5 3" target="0.3 0 0.6" up="0 0 1"/></transform>@film"#;

const TURNED: Parameter = sets(
    r#"<transform name="to_world"><scale x="-1"/><lookat origin="0.5 -5 3" target="0.3 0 0.6" up="0 0 1"/></transform>"#,
    // the first column is the x axis: against the other, to the right of the picture
    "world_from_camera: DMat4 { x_axis: DVec4(0.9992",
);
const NEAR: Parameter = sets(r#"<float name="near_clip" value="5"/>"#, "near_clip: Some(5.0)");
const FAR: Parameter = sets(r#"<float name="far_clip" value="5"/>"#, "far_clip: Some(5.0)");

const FILM: &str = r#"<sensor type="perspective"><float name="fov" value="40"/><transform name="to_world"><lookat origin="0.5 -5 3" target="0.3 0 0.6" up="0 0 1"/></transform>{}</sensor>@things@light"#;
const FILTER: &str = r#"<sensor type="perspective"><float name="fov" value="40"/><transform name="to_world"><lookat origin="0.5 -5 3" target="0.3 0 0.6" up="0 0 1"/></transform><film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="12"/>{}</film></sensor>@things@light"#;
const SAMPLER: &str = r#"<sensor type="perspective"><float name="fov" value="40"/><transform name="to_world"><lookat origin="0.5 -5 3" target="0.3 0 0.6" up="0 0 1"/></transform>@film{}</sensor>@things@light"#;
const COUNT: &[Parameter] = &[
    sets(r#"<integer name="sample_count" value="2"/>"#, "sample_count: 2 "),
    idle(r#"<integer name="seed" value="3"/>"#),
];

const SIZE: &str = r#"<integer name="width" value="16"/><integer name="height" value="12"/>"#;
const REFUSED: &str = "Mitsuba 3 refuses";

/// All of them.
pub const CAMERAS: &[Plugin] = &[
    Plugin::new(
        "{}@things@light",
        "sensor",
        "perspective",
        Means::Shows("fov_axis: Diagonal"),
        &[
            sets(r#"<float name="fov" value="40"/>"#, "fov_deg: 40.0, fov_axis: X"),
            sets(r#"<float name="fov" value="40"/><string name="fov_axis" value="y"/>"#, "fov_axis: Y"),
            sets(r#"<float name="fov" value="40"/><string name="fov_axis" value="smaller"/>"#, "fov_axis: Smaller"),
            sets(r#"<float name="fov" value="40"/><string name="fov_axis" value="larger"/>"#, "fov_axis: Larger"),
            sets(r#"<float name="fov" value="40"/><string name="fov_axis" value="diagonal"/>"#, "fov_deg: 40.0, fov_axis: Diagonal"),
            // 2 atan(43.2666 / 60), of the diagonal
            sets(r#"<string name="focal_length" value="30mm"/>"#, "fov_deg: 71.59"),
            NEAR,
            FAR,
            idle(r#"<float name="focus_distance" value="3"/>"#),
            sets(r#"<float name="principal_point_offset_x" value="0.1"/>"#, "principal_point_offset: [0.1, 0.0]"),
            sets(r#"<float name="principal_point_offset_y" value="-0.2"/>"#, "principal_point_offset: [0.0, -0.2]"),
            idle(r#"<float name="shutter_open" value="0"/><float name="shutter_close" value="0"/>"#),
        ],
    )
    .given(VIEW),
    Plugin::new("{}@things@light", "sensor", "perspective", Means::Shows("fov_deg: 40.0"), &[TURNED])
        .given(r#"<float name="fov" value="40"/>@film"#),
    Plugin::new(
        "{}@things@light",
        "sensor",
        "thinlens",
        Means::Shows("aperture_radius: 0.3, focus_distance: 10000.0"),
        &[
            sets(r#"<float name="focus_distance" value="4.5"/>"#, "focus_distance: 4.5"),
            sets(r#"<string name="fov_axis" value="y"/>"#, "fov_axis: Y"),
            NEAR,
            FAR,
        ],
    )
    .given(LENS),
    Plugin::new(
        "{}@things@light",
        "sensor",
        "thinlens",
        Means::Shows("lens: Some"),
        &[sets(r#"<float name="fov" value="25"/>"#, "fov_deg: 25.0")],
    )
    .given(r#"<float name="aperture_radius" value="0.3"/><transform name="to_world"><lookat origin="0.5 -5 3" target="0.3 0 0.6" up="0 0 1"/></transform>@film"#),
    Plugin::new("{}@things@light", "sensor", "orthographic", Means::Shows("projection: Orthographic"), &[NEAR, FAR])
        .given(FLAT),
    Plugin::new("{}@things@light", "sensor", "orthographic", Means::Shows("projection: Orthographic"), &[TURNED])
        .given(r#"@film"#),
    Plugin::new("{}@things@light", "sensor", "thinlens", Means::Shows("fov_deg: 40.0"), &[TURNED])
        .given(r#"<float name="aperture_radius" value="0.3"/><float name="fov" value="40"/>@film"#),
    Plugin::new(
        FILM,
        "film",
        "hdrfilm",
        Means::Nothing,
        &[
            sets(r#"<integer name="width" value="40"/>"#, "width: 40, height: 576"),
            sets(r#"<integer name="height" value="30"/>"#, "width: 768, height: 30"),
        ],
    ),
    Plugin::new(
        FILM,
        "film",
        "hdrfilm",
        Means::Shows("width: 16, height: 12"),
        &[
            sets(r#"<string name="pixel_format" value="rgba"/>"#, "alpha: true"),
            sets(r#"<string name="pixel_format" value="luminance_alpha"/>"#, "alpha: true"),
            idle(r#"<string name="pixel_format" value="rgb"/>"#),
            idle(r#"<string name="file_format" value="openexr"/>"#),
            idle(r#"<string name="component_format" value="float32"/>"#),
            idle(r#"<boolean name="banner" value="false"/>"#),
            idle(r#"<boolean name="high_quality_edges" value="true"/>"#).warned(REFUSED),
            idle(r#"<boolean name="attach_log" value="false"/>"#).warned(REFUSED),
            idle(r#"<float name="gamma" value="2.2"/>"#).warned(REFUSED),
            idle(r#"<string name="filename" value="picture"/>"#).warned(REFUSED),
            sets(r#"<integer name="crop_width" value="8"/>"#, "Crop { x: 0, y: 0, width: 8, height: 12 }"),
            sets(r#"<integer name="crop_height" value="5"/>"#, "Crop { x: 0, y: 0, width: 16, height: 5 }"),
            sets(r#"<integer name="crop_offset_x" value="3"/>"#, "Crop { x: 3, y: 0, width: 13, height: 12 }"),
            sets(r#"<integer name="crop_offset_y" value="4"/>"#, "Crop { x: 0, y: 4, width: 16, height: 8 }"),
        ],
    )
    .given(SIZE),
    Plugin::new(
        FILM,
        "film",
        "ldrfilm",
        Means::Shows("width: 16, height: 12"),
        &[
            idle(r#"<string name="file_format" value="png"/>"#),
            sets(r#"<string name="pixel_format" value="rgba"/>"#, "alpha: true"),
            idle(r#"<float name="gamma" value="2.2"/>"#),
            idle(r#"<boolean name="banner" value="false"/>"#),
            idle(r#"<string name="tonemap_method" value="gamma"/>"#),
            idle(r#"<float name="exposure" value="1"/>"#),
            idle(r#"<string name="filename" value="picture"/>"#),
        ],
    )
    .given(SIZE)
    .warned("ldrfilm: its size counts")
    .only(Old),
    Plugin::new(FILTER, "rfilter", "box", Means::Shows("filter: Box"), &[]),
    Plugin::new(
        FILTER,
        "rfilter",
        "tent",
        Means::Shows("filter: Tent { radius: 1.0 }"),
        &[sets(r#"<float name="radius" value="2"/>"#, "Tent { radius: 2.0 }")],
    ),
    Plugin::new(
        FILTER,
        "rfilter",
        "gaussian",
        Means::Nothing,
        &[sets(r#"<float name="stddev" value="0.7"/>"#, "Gaussian { stddev: 0.7 }")],
    ),
    Plugin::new(
        FILTER,
        "rfilter",
        "mitchell",
        Means::Shows("filter: Mitchell { b: 0.33333334, c: 0.33333334 }"),
        &[
            sets(r#"<float name="B" value="0.5"/>"#, "Mitchell { b: 0.5,"),
            sets(r#"<float name="C" value="0.25"/>"#, "c: 0.25 }"),
        ],
    ),
    Plugin::new(FILTER, "rfilter", "catmullrom", Means::Shows("filter: CatmullRom"), &[]),
    Plugin::new(
        FILTER,
        "rfilter",
        "lanczos",
        Means::Shows("filter: Lanczos { lobes: 3.0 }"),
        &[sets(r#"<integer name="lobes" value="2"/>"#, "Lanczos { lobes: 2.0 }")],
    ),
    Plugin::new(SAMPLER, "sampler", "independent", Means::Nothing, COUNT),
    Plugin::new(SAMPLER, "sampler", "independent", Means::Nothing, &[idle(r#"<integer name="dimension" value="8"/>"#).warned(REFUSED)]),
    Plugin::new(SAMPLER, "sampler", "ldsampler", Means::Keeps("kind: \"ldsampler\""), COUNT),
    Plugin::new(
        SAMPLER,
        "sampler",
        "ldsampler",
        Means::Keeps("kind: \"ldsampler\""),
        &[idle(r#"<integer name="dimension" value="8"/>"#).warned(REFUSED)],
    ),
    Plugin::new(SAMPLER, "sampler", "orthogonal", Means::Keeps("kind: \"orthogonal\""), COUNT),
    Plugin::new(SAMPLER, "sampler", "multijitter", Means::Keeps("kind: \"multijitter\""), COUNT),
    Plugin::new(SAMPLER, "sampler", "stratified", Means::Keeps("kind: \"stratified\""), COUNT),
    Plugin::new(SAMPLER, "sampler", "sobol", Means::Keeps("kind: \"sobol\""), COUNT).warned(REFUSED).only(Old),
    Plugin::new(SAMPLER, "sampler", "halton", Means::Keeps("kind: \"halton\""), COUNT).warned(REFUSED).only(Old),
    Plugin::new(SAMPLER, "sampler", "hammersley", Means::Keeps("kind: \"hammersley\""), COUNT).warned(REFUSED).only(Old),
    Plugin::new(SAMPLER, "sampler", "deterministic", Means::Keeps("kind: \"deterministic\""), COUNT)
        .warned("deterministic: not read; the renderer's own sampler stands in"),
    Plugin::new(SAMPLER, "sampler", "sobl", Means::Refused("unknown type \"sobl\""), &[]),
];
