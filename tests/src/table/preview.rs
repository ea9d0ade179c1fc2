//! The materials of the table on one object, for the eye.

use std::io;
use std::path::{Path, PathBuf};

use super::{Row, materials, write_files};

/// A ball with a girdle of grey plastic on a checkered floor, under a lamp and the sky; the material stands at `{}`.
const SCENE: &str = r#"<scene version="3.0.0">
<integrator type="path"><integer name="max_depth" value="12"/></integrator>
<sensor type="perspective"><float name="fov" value="30"/>
<transform name="to_world"><lookat origin="0.6 -4.6 2.6" target="0 0 0.85" up="0 0 1"/></transform>
<film type="hdrfilm"><integer name="width" value="144"/><integer name="height" value="144"/><rfilter type="box"/></film>
<sampler type="independent"><integer name="sample_count" value="256"/></sampler></sensor>
<shape type="rectangle"><transform name="to_world"><scale value="5"/></transform><bsdf type="diffuse"><texture name="reflectance" type="checkerboard"><rgb name="color0" value="0.45"/><rgb name="color1" value="0.25"/><transform name="to_uv"><scale value="8"/></transform></texture></bsdf></shape>
<shape type="sphere"><float name="radius" value="0.8"/><point name="center" x="0" y="0" z="1"/>{}</shape>
<shape type="cylinder"><point name="p0" x="0" y="0" z="0"/><point name="p1" x="0" y="0" z="0.42"/><float name="radius" value="0.6"/><bsdf type="twosided"><bsdf type="plastic"><rgb name="diffuse_reflectance" value="0.15"/></bsdf></bsdf></shape>
<shape type="rectangle"><transform name="to_world"><scale x="0.35" y="0.7"/><rotate x="1" angle="75"/><rotate z="1" angle="-35"/><translate x="1.25" y="0.3" z="0.72"/></transform>{}</shape>
<shape type="rectangle"><transform name="to_world"><scale value="0.9"/><rotate x="1" angle="150"/><translate x="-1.6" y="-1.8" z="3.2"/></transform><emitter type="area"><rgb name="radiance" value="7 6.5 6"/></emitter></shape>
<emitter type="envmap"><string name="filename" value="sky.exr"/><float name="scale" value="0.6"/><transform name="to_world"><rotate x="1" angle="90"/><rotate z="1" angle="120"/></transform></emitter>
</scene>
"#;

/// Writes the scene once for each material into `folder`, with its files; gives the rows with their paths.
///
/// # Errors
///
/// What the system says.
pub fn write_previews(folder: &Path) -> io::Result<Vec<(Row, PathBuf)>> {
    write_files(folder)?;
    let rows = materials().enumerate().map(|(i, &(name, in_subset, material))| {
        let path = folder.join(format!("preview-{i:03}.xml"));
        let xml = SCENE.replace("{}", material);
        std::fs::write(&path, &xml)?;
        Ok((Row { name: name.into(), xml, in_subset }, path))
    });
    rows.collect()
}
