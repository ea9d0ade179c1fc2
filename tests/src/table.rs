//! The table of small scenes that limpid and Mitsuba must agree on: material × light × shape × camera.
//!
//! A new plugin gets its check by its row in one of the lists. Every scene shows a ball and a tilted plate of the
//! material in question on a grey floor; the lists change one thing at a time, and some rows of them two.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use limpid_frame::{Frame, write_exr, write_png};

/// A scene of the table.
#[derive(Clone, Debug)]
pub struct Row {
    /// `roughplastic, alpha 0.3`.
    pub name: String,
    /// The scene file's text.
    pub xml: String,
    /// Among the few that stand for all where time is short.
    pub in_subset: bool,
}

/// A material and its `<bsdf>`; those marked are in the subset.
type Named = (&'static str, bool, &'static str);

const MATERIALS: &[Named] = &[
    ("diffuse", true, r#"<bsdf type="diffuse"><rgb name="reflectance" value="0.7 0.4 0.2"/></bsdf>"#),
    (
        "diffuse, bitmap",
        false,
        r#"<bsdf type="diffuse"><texture name="reflectance" type="bitmap"><string name="filename" value="color.png"/></texture></bsdf>"#,
    ),
    (
        "diffuse, bitmap nearest, mirrored",
        false,
        r#"<bsdf type="diffuse"><texture name="reflectance" type="bitmap"><string name="filename" value="color.png"/><string name="filter_type" value="nearest"/><string name="wrap_mode" value="mirror"/><transform name="to_uv"><scale value="2.5"/></transform></texture></bsdf>"#,
    ),
    (
        "diffuse, checkerboard",
        false,
        r#"<bsdf type="diffuse"><texture name="reflectance" type="checkerboard"><transform name="to_uv"><scale x="6" y="4"/></transform></texture></bsdf>"#,
    ),
    (
        "twosided of two",
        false,
        r#"<bsdf type="twosided"><bsdf type="diffuse"/><bsdf type="roughconductor"><float name="alpha" value="0.4"/></bsdf></bsdf>"#,
    ),
    ("conductor, none", false, r#"<bsdf type="conductor"/>"#),
    ("conductor, Au", false, r#"<bsdf type="conductor"><string name="material" value="Au"/></bsdf>"#),
    (
        "conductor, eta and k",
        false,
        r#"<bsdf type="conductor"><rgb name="eta" value="0.2 0.9 1.1"/><rgb name="k" value="3.9 2.4 2.2"/></bsdf>"#,
    ),
    (
        "roughconductor, ggx 0.001",
        false,
        r#"<bsdf type="roughconductor"><string name="distribution" value="ggx"/><float name="alpha" value="0.001"/></bsdf>"#,
    ),
    (
        "roughconductor, ggx 0.05",
        false,
        r#"<bsdf type="roughconductor"><string name="distribution" value="ggx"/><string name="material" value="Cu"/><float name="alpha" value="0.05"/></bsdf>"#,
    ),
    (
        "roughconductor, ggx 0.3",
        true,
        r#"<bsdf type="roughconductor"><string name="distribution" value="ggx"/><string name="material" value="Au"/><float name="alpha" value="0.3"/></bsdf>"#,
    ),
    (
        "roughconductor, ggx 1",
        false,
        r#"<bsdf type="roughconductor"><string name="distribution" value="ggx"/><float name="alpha" value="1"/></bsdf>"#,
    ),
    (
        "roughconductor, beckmann 0.01",
        false,
        r#"<bsdf type="roughconductor"><float name="alpha" value="0.01"/></bsdf>"#,
    ),
    (
        "roughconductor, beckmann 0.5",
        false,
        r#"<bsdf type="roughconductor"><string name="material" value="Al"/><float name="alpha" value="0.5"/></bsdf>"#,
    ),
    (
        "roughconductor, anisotropic",
        false,
        r#"<bsdf type="roughconductor"><string name="distribution" value="ggx"/><float name="alpha_u" value="0.4"/><float name="alpha_v" value="0.05"/></bsdf>"#,
    ),
    (
        "roughconductor, textured",
        false,
        r#"<bsdf type="roughconductor"><texture name="alpha" type="bitmap"><string name="filename" value="share.exr"/></texture><texture name="specular_reflectance" type="bitmap"><string name="filename" value="color.png"/></texture></bsdf>"#,
    ),
    ("dielectric", true, r#"<bsdf type="dielectric"/>"#),
    (
        "dielectric, tinted, 1.8",
        false,
        r#"<bsdf type="dielectric"><float name="int_ior" value="1.8"/><float name="ext_ior" value="1"/><rgb name="specular_transmittance" value="0.5 0.9 0.7"/></bsdf>"#,
    ),
    (
        "plastic",
        false,
        r#"<bsdf type="plastic"><rgb name="diffuse_reflectance" value="0.6 0.2 0.1"/></bsdf>"#,
    ),
    (
        "plastic, nonlinear",
        false,
        r#"<bsdf type="plastic"><rgb name="diffuse_reflectance" value="0.8 0.4 0.1"/><boolean name="nonlinear" value="true"/><float name="int_ior" value="1.9"/></bsdf>"#,
    ),
    (
        "roughplastic, beckmann 0.1",
        true,
        r#"<bsdf type="roughplastic"><rgb name="diffuse_reflectance" value="0.1 0.3 0.6"/></bsdf>"#,
    ),
    (
        "roughplastic, ggx 0.3, nonlinear",
        false,
        r#"<bsdf type="roughplastic"><string name="distribution" value="ggx"/><float name="alpha" value="0.3"/><boolean name="nonlinear" value="true"/><texture name="diffuse_reflectance" type="bitmap"><string name="filename" value="color.png"/></texture></bsdf>"#,
    ),
    (
        "roughplastic, ggx 0.02",
        false,
        r#"<bsdf type="roughplastic"><string name="distribution" value="ggx"/><float name="alpha" value="0.02"/></bsdf>"#,
    ),
    (
        "mask",
        true,
        r#"<bsdf type="mask"><texture name="opacity" type="bitmap"><string name="filename" value="share.exr"/></texture><bsdf type="twosided"><bsdf type="diffuse"/></bsdf></bsdf>"#,
    ),
    (
        "mask 0.3 around metal",
        false,
        r#"<bsdf type="mask"><float name="opacity" value="0.3"/><bsdf type="roughconductor"><float name="alpha" value="0.2"/></bsdf></bsdf>"#,
    ),
    ("null", false, r#"<bsdf type="null"/>"#),
    (
        "blendbsdf",
        false,
        r#"<bsdf type="blendbsdf"><texture name="weight" type="bitmap"><string name="filename" value="share.exr"/></texture><bsdf type="diffuse"><rgb name="reflectance" value="0.7 0.2 0.1"/></bsdf><bsdf type="roughconductor"><float name="alpha" value="0.2"/></bsdf></bsdf>"#,
    ),
    (
        "blendbsdf of mirror and glass",
        false,
        r#"<bsdf type="blendbsdf"><float name="weight" value="0.4"/><bsdf type="conductor"><rgb name="specular_reflectance" value="0.9 0.6 0.3"/></bsdf><bsdf type="dielectric"/></bsdf>"#,
    ),
    (
        "blendbsdf, nested",
        false,
        r#"<bsdf type="blendbsdf"><float name="weight" value="0.4"/><bsdf type="mask"><float name="opacity" value="0.5"/><bsdf type="diffuse"/></bsdf><bsdf type="twosided"><bsdf type="blendbsdf"><float name="weight" value="0.7"/><bsdf type="plastic"/><bsdf type="roughconductor"/></bsdf></bsdf></bsdf>"#,
    ),
    (
        "normalmap",
        true,
        r#"<bsdf type="twosided"><bsdf type="normalmap"><texture name="normalmap" type="bitmap"><string name="filename" value="normal.exr"/><boolean name="raw" value="true"/></texture><bsdf type="roughplastic"/></bsdf></bsdf>"#,
    ),
    (
        "normalmap without shadowing",
        false,
        r#"<bsdf type="normalmap"><texture name="normalmap" type="bitmap"><string name="filename" value="normal.exr"/><boolean name="raw" value="true"/></texture><boolean name="use_shadowing_function" value="false"/><bsdf type="roughconductor"><float name="alpha_u" value="0.3"/><float name="alpha_v" value="0.1"/></bsdf></bsdf>"#,
    ),
    (
        "bumpmap",
        false,
        r#"<bsdf type="bumpmap"><texture type="bitmap"><string name="filename" value="height.exr"/><boolean name="raw" value="true"/></texture><float name="scale" value="0.3"/><bsdf type="twosided"><bsdf type="roughplastic"/></bsdf></bsdf>"#,
    ),
    (
        "bumpmap around glass",
        false,
        r#"<bsdf type="bumpmap"><texture type="bitmap"><string name="filename" value="height.exr"/><boolean name="raw" value="true"/></texture><float name="scale" value="0.1"/><bsdf type="dielectric"/></bsdf>"#,
    ),
];

const LAMP: &str = r#"<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="180"/><translate x="-1" y="-1" z="4"/></transform><emitter type="area"><rgb name="radiance" value="9 8 7"/></emitter></shape>
<emitter type="constant"><rgb name="radiance" value="0.2 0.25 0.3"/></emitter>"#;

const LIGHTS: &[Named] = &[
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

/// Shapes, as what takes the place of the ball; the material stands at `{}`.
const SHAPES: &[Named] = &[
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
];

const CAMERAS: &[Named] = &[
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

const VIEW: &str = r#"<transform name="to_world"><lookat origin="0.5 -5 3" target="0.3 0 0.6" up="0 0 1"/></transform>
<film type="hdrfilm"><integer name="width" value="64"/><integer name="height" value="48"/><rfilter type="box"/></film>
<sampler type="independent"><integer name="sample_count" value="256"/></sampler>"#;

const PINHOLE: &str = r#"<sensor type="perspective"><float name="fov" value="40"/>{}</sensor>"#;
const BALL: &str = r#"<shape type="sphere"><float name="radius" value="0.7"/><point name="center" x="0" y="0" z="0.75"/>{}</shape>"#;
const TEXTURED: &str = r#"<bsdf type="twosided"><bsdf type="diffuse"><texture name="reflectance" type="bitmap"><string name="filename" value="color.png"/></texture></bsdf></bsdf>"#;

/// The scene of a row.
fn scene(camera: &str, shape: &str, material: &str, light: &str) -> String {
    let camera = camera.replace("{}", VIEW);
    let shape = shape.replace("{}", material);
    format!(
        r#"<scene version="3.0.0">
<integrator type="path"><integer name="max_depth" value="6"/></integrator>
{camera}
<shape type="rectangle"><transform name="to_world"><scale value="3"/></transform><bsdf type="twosided"><bsdf type="diffuse"/></bsdf></shape>
{shape}
<shape type="rectangle"><transform name="to_world"><scale value="0.5"/><rotate x="1" angle="60"/><rotate z="1" angle="20"/><translate x="1.4" y="0.3" z="0.7"/></transform>{material}</shape>
{light}
</scene>
"#
    )
}

/// All scenes of the table. The files that they refer to are written by [`write_files`].
pub fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    let mut add = |name: String, in_subset, xml| rows.push(Row { name, xml, in_subset });
    for &(name, in_subset, material) in MATERIALS {
        add(name.into(), in_subset, scene(PINHOLE, BALL, material, LAMP));
    }
    let rough = MATERIALS.iter().find(|m| m.0 == "roughconductor, ggx 0.3").expect("is in the list").2;
    for &(name, in_subset, light) in LIGHTS {
        add(format!("light: {name}"), in_subset, scene(PINHOLE, BALL, TEXTURED, light));
        add(format!("light: {name}, on metal"), false, scene(PINHOLE, BALL, rough, light));
    }
    for &(name, in_subset, shape) in SHAPES {
        add(format!("shape: {name}"), in_subset, scene(PINHOLE, shape, TEXTURED, LAMP));
    }
    for &(name, in_subset, camera) in CAMERAS {
        add(format!("camera: {name}"), in_subset, scene(camera, BALL, TEXTURED, LAMP));
    }
    rows
}

/// Writes the pictures and meshes that the scenes refer to into `folder`.
///
/// # Errors
///
/// What the system says.
pub fn write_files(folder: &Path) -> io::Result<()> {
    let picture = |value: &dyn Fn(f32, f32) -> [f32; 3], width: usize, height: usize| {
        let mut planes = [Vec::new(), Vec::new(), Vec::new()];
        for y in 0..height {
            for x in 0..width {
                let rgb = value((x as f32 + 0.5) / width as f32, (y as f32 + 0.5) / height as f32);
                planes.iter_mut().zip(rgb).for_each(|(plane, v)| plane.push(v));
            }
        }
        planes
    };
    let exr = |name: &str, value: &dyn Fn(f32, f32) -> [f32; 3], width, height| {
        let mut frame = Frame::new(width, height);
        for (channel, plane) in ["R", "G", "B"].into_iter().zip(picture(value, width, height)) {
            frame.insert(channel, plane);
        }
        write_exr(&frame, &folder.join(name)).map_err(io::Error::other)
    };
    let wave = |u: f32, v: f32| {
        let (a, b) = (u * std::f32::consts::TAU, v * std::f32::consts::TAU);
        ((3.0 * a).sin() * (2.0 * b).cos(), (2.0 * a).cos() * (4.0 * b).sin())
    };
    let color = picture(&|u, v| [0.1 + 0.8 * u, 0.9 - 0.7 * v, 0.3 + 0.3 * wave(u, v).0], 24, 16);
    write_png(color.each_ref().map(Vec::as_slice), 24, 16, 0.0, &folder.join("color.png"))
        .map_err(io::Error::other)?;
    exr("share.exr", &|u, v| [0.5 + 0.45 * wave(u, v).0; 3], 32, 32)?;
    exr("height.exr", &|u, v| [0.2 * wave(u, v).0 + 0.1 * wave(u, v).1; 3], 64, 64)?;
    exr("normal.exr", &|u, v| [0.5 + 0.2 * wave(u, v).0, 0.5 + 0.25 * wave(u, v).1, 0.9], 32, 32)?;
    exr("glow.exr", &|u, v| if u > 0.5 && v < 0.5 { [30.0, 20.0, 10.0] } else { [1.0, 2.0, 4.0] }, 16, 16)?;
    let sun = |u: f32, v: f32| if (u - 0.3).abs() < 0.02 && (v - 0.3).abs() < 0.04 { 60.0 } else { 0.0 };
    exr(
        "sky.exr",
        &|u, v| [0.3 + 0.5 * v + sun(u, v), 0.4 + sun(u, v), 0.7 - 0.3 * v + 0.8 * sun(u, v)],
        64,
        32,
    )?;
    fs::write(folder.join("ball.ply"), ball(24, 12, true))?;
    fs::write(folder.join("lamp.ply"), ball(6, 4, false))
}

/// Writes every row's scene into `folder`, with its files; gives the rows with their paths.
///
/// # Errors
///
/// What the system says.
pub fn write(folder: &Path) -> io::Result<Vec<(Row, PathBuf)>> {
    write_files(folder)?;
    let rows = rows().into_iter().enumerate().map(|(i, row)| {
        let path = folder.join(format!("{i:03}.xml"));
        fs::write(&path, &row.xml)?;
        Ok((row, path))
    });
    rows.collect()
}

/// An ASCII PLY of a unit ball of few faces.
fn ball(around: u32, down: u32, normals: bool) -> String {
    let (mut vertices, mut faces) = (String::new(), String::new());
    for j in 0..=down {
        for i in 0..=around {
            let (u, v) = (f64::from(i) / f64::from(around), f64::from(j) / f64::from(down));
            let (phi, theta) = (u * std::f64::consts::TAU, v * std::f64::consts::PI);
            let p = [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()];
            let p = p.map(|x| format!("{x:.7}")).join(" ");
            vertices +=
                &if normals { format!("{p} {p} {u:.6} {v:.6}\n") } else { format!("{p} {u:.6} {v:.6}\n") };
        }
    }
    let mut count = 0;
    for j in 0..down {
        for i in 0..around {
            let at = |i, j| j * (around + 1) + i;
            let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
            if j + 1 < down {
                faces += &format!("3 {a} {b} {c}\n");
                count += 1;
            }
            if j > 0 {
                faces += &format!("3 {a} {c} {d}\n");
                count += 1;
            }
        }
    }
    let properties = if normals { "x y z nx ny nz u v" } else { "x y z u v" };
    let properties: String = properties.split(' ').map(|p| format!("property float {p}\n")).collect();
    format!(
        "ply\nformat ascii 1.0\nelement vertex {}\n{properties}element face {count}\nproperty list uchar int vertex_indices\nend_header\n{vertices}{faces}",
        (around + 1) * (down + 1)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_loads_without_a_warning_and_renders() {
        let folder = tempfile::tempdir().unwrap();
        for (row, path) in write(folder.path()).unwrap() {
            let scene = limpid_scenes::load(&path, &Default::default())
                .unwrap_or_else(|e| panic!("{}: {e}", row.name));
            assert!(scene.warnings.is_empty(), "{}: {:?}", row.name, scene.warnings);
            let seen = crate::rendered(&scene, |s| (s.spp, s.width, s.height) = (2, 16, 12));
            assert!(crate::mean(&seen) > 0.0 && seen.rejected == 0, "{}", row.name);
        }
    }

    #[test]
    fn names_are_unique_and_the_subset_is_small() {
        let rows = rows();
        let mut names: Vec<&str> = rows.iter().map(|row| row.name.as_str()).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), rows.len());
        let few = rows.iter().filter(|row| row.in_subset).count();
        assert!((5..=20).contains(&few), "{few} rows in the subset");
    }
}
