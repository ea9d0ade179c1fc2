//! Pictures and meshes that the rows name.

use std::fs;
use std::io::{self, Cursor, Write};
use std::path::Path;

use flate2::Compression;
use flate2::write::ZlibEncoder;
use image::{ImageFormat, Rgb, Rgb32FImage, RgbImage};

/// A lamp that shines straight down most.
const LAMP: &str = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0\n1 1 100\n0 45 90\n0\n30 20 0\n";

/// Writes them.
///
/// # Errors
///
/// What the system says.
pub fn write(folder: &Path) -> io::Result<()> {
    crate::table::write_files(folder)?;
    let picture = RgbImage::from_fn(4, 2, |x, y| Rgb([(60 * x + 20) as u8, (100 * y + 60) as u8, 90]));
    for (name, format) in [
        ("p.png", ImageFormat::Png),
        ("p.jpg", ImageFormat::Jpeg),
        ("p.bmp", ImageFormat::Bmp),
        ("Two Words.PNG", ImageFormat::Png),
    ] {
        let mut bytes = Cursor::new(Vec::new());
        picture.write_to(&mut bytes, format).map_err(io::Error::other)?;
        fs::write(folder.join(name), bytes.into_inner())?;
    }
    let sky = Rgb32FImage::from_fn(8, 4, |x, y| Rgb([0.2 + x as f32, 0.5, 1.0 + y as f32]));
    let mut bytes = Cursor::new(Vec::new());
    sky.write_to(&mut bytes, ImageFormat::Hdr).map_err(io::Error::other)?;
    fs::write(folder.join("p.hdr"), bytes.into_inner())?;
    fs::write(folder.join("tent.obj"), TENT)?;
    fs::write(folder.join("lamp.ies"), LAMP)?;
    fs::write(folder.join("colored.ply"), COLORED)?;
    fs::write(folder.join("two.serialized"), serialized()?)?;
    fs::write(folder.join("steps.spd"), "# nm value\n400 0.1\n700 0.9\n")
}

/// Two faces that meet at an angle, with smooth normals and texture coordinates.
const TENT: &str = "v -1 -1 0
v 0 -1 1
v 1 -1 0
v -1 1 0
v 0 1 1
v 1 1 0
vt 0 0
vt 0.5 0.1
vt 1 0
vt 0 0.9
vt 0.5 0.9
vt 1 1
vn -0.6 0 0.8
vn 0 0 1
vn 0.6 0 0.8
f 1/1/1 2/2/2 5/5/2 4/4/1
f 2/2/2 3/3/3 6/6/3 5/5/2
";

/// A square in z = 0, with a colour at each corner and one of its own for each half.
const COLORED: &str = "ply
format ascii 1.0
element vertex 4
property double x
property double y
property double z
property float s
property float t
property float r
property float g
property float b
element face 2
property list uchar int vertex_indices
property float tone_0
property float tone_1
property float tone_2
end_header
-1 -1 0 0 0 1 0.1 0.1
1 -1 0 1 0 0.1 1 0.1
1 1 0 1 1 0.1 0.1 1
-1 1 0 0 1 0.9 0.9 0.9
3 0 1 2 0.9 0.2 0.2
3 0 2 3 0.2 0.2 0.9
";

/// Two meshes of one triangle each, in the format of version 4: 16 bits of magic and version before each mesh, and the
/// offsets of the meshes at the end.
fn serialized() -> io::Result<Vec<u8>> {
    const HAS_NORMALS: u32 = 1;
    const HAS_UVS: u32 = 2;
    const SINGLE: u32 = 0x1000;
    let mut bytes = Vec::new();
    let mut offsets = Vec::new();
    for size in [1.0f32, 0.5] {
        offsets.push(bytes.len() as u64);
        bytes.extend([0x1c, 0x04, 4, 0]);
        let mut packed = ZlibEncoder::new(bytes, Compression::default());
        packed.write_all(&(HAS_NORMALS | HAS_UVS | SINGLE).to_le_bytes())?;
        packed.write_all(b"part\0")?;
        packed.write_all(&3u64.to_le_bytes())?;
        packed.write_all(&1u64.to_le_bytes())?;
        let corners = [[-size, -size, 0.0], [size, -size, 0.0], [0.0, size, 0.0]];
        let normals = [[-0.6f32, 0.0, 0.8], [0.6, 0.0, 0.8], [0.0, 0.0, 1.0]];
        let uvs = [[0.0f32, 0.0], [1.0, 0.0], [0.5, 1.0]];
        let values = corners.as_flattened().iter().chain(normals.as_flattened()).chain(uvs.as_flattened());
        for value in values {
            packed.write_all(&value.to_le_bytes())?;
        }
        for index in [0u32, 1, 2] {
            packed.write_all(&index.to_le_bytes())?;
        }
        bytes = packed.finish()?;
    }
    for offset in &offsets {
        bytes.extend(offset.to_le_bytes());
    }
    bytes.extend((offsets.len() as u32).to_le_bytes());
    Ok(bytes)
}
