//! The table of small scenes that limpid and Mitsuba must agree on: material × light × shape × camera.
//!
//! A new plugin gets its check by its row in one of the lists. Every scene shows a ball and a tilted plate of the
//! material in question on a grey floor; the lists change one thing at a time, and some rows of them two.

mod cameras;
mod files;
mod glass;
mod lights;
mod materials;
mod nested;
mod preview;
mod principled;
mod shapes;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

pub use files::write_files;
pub use preview::write_previews;

use cameras::CAMERAS;
use glass::GLASS;
use lights::{LAMP, LAMPS_IN_VIEW, LIGHTS};
use materials::MATERIALS;
use nested::{NESTED, SHEETS};
use principled::PRINCIPLED;
use shapes::SHAPES;

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

const PLACE: &str =
    r#"<transform name="to_world"><lookat origin="0.5 -5 3" target="0.3 0 0.6" up="0 0 1"/></transform>"#;
const FILM: &str = r#"<film type="hdrfilm"><integer name="width" value="64"/><integer name="height" value="48"/><rfilter type="box"/></film>
<sampler type="independent"><integer name="sample_count" value="256"/></sampler>"#;

const PINHOLE: &str = r#"<sensor type="perspective"><float name="fov" value="40"/>{}</sensor>"#;
const BALL: &str = r#"<shape type="sphere"><float name="radius" value="0.7"/><point name="center" x="0" y="0" z="0.75"/>{}</shape>"#;
const TEXTURED: &str = r#"<bsdf type="twosided"><bsdf type="diffuse"><texture name="reflectance" type="bitmap"><string name="filename" value="color.png"/></texture></bsdf></bsdf>"#;

/// The scene of a row.
fn scene(camera: &str, shape: &str, material: &str, light: &str) -> String {
    let camera = camera.replace("{}", &format!("{PLACE}\n{FILM}")).replace("{film}", FILM);
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

/// The lists of materials, one after the other.
fn materials() -> impl Iterator<Item = &'static Named> {
    [MATERIALS, GLASS, PRINCIPLED, NESTED].into_iter().flatten()
}

/// All scenes of the table. The files that they refer to are written by [`write_files`].
pub fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    let mut add = |name: String, in_subset, xml| rows.push(Row { name, xml, in_subset });
    for &(name, in_subset, material) in materials() {
        add(name.into(), in_subset, scene(PINHOLE, BALL, material, LAMP));
    }
    for &(name, in_subset, material) in SHEETS {
        let grey = BALL.replace("{}", r#"<bsdf type="diffuse"/>"#);
        add(format!("sheet: {name}"), in_subset, scene(PINHOLE, &grey, material, LAMP));
    }
    let rough = materials().find(|m| m.0 == "roughconductor, ggx 0.3").expect("is in the list").2;
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
    let visible = scene(PINHOLE, BALL, TEXTURED, LAMPS_IN_VIEW);
    let hidden =
        visible.replace(r#"type="path">"#, r#"type="path"><boolean name="hide_emitters" value="true"/>"#);
    add("light: lamps in view".into(), false, visible);
    add("light: lamps in view, hidden".into(), false, hidden);
    rows
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
