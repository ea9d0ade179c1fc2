//! Pictures and meshes that the scenes of the table refer to.

use std::{fs, io, path::Path};

use limpid_frame::{Frame, write_exr, write_png};

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
    fs::write(folder.join("painted.ply"), PAINTED)?;
    fs::write(folder.join("lamp.ply"), ball(6, 4, false))
}

/// An octahedron whose vertices and faces have colours.
const PAINTED: &str = "ply
format ascii 1.0
element vertex 6
property float x
property float y
property float z
property float r
property float g
property float b
element face 8
property list uchar int vertex_indices
property float r
property float g
property float b
end_header
1 0 0 0.9 0.2 0.1
-1 0 0 0.1 0.8 0.9
0 1 0 0.2 0.9 0.1
0 -1 0 0.8 0.1 0.9
0 0 1 0.9 0.9 0.9
0 0 -1 0.1 0.1 0.1
3 0 2 4 0.8 0.1 0.1
3 2 1 4 0.1 0.8 0.1
3 1 3 4 0.1 0.1 0.8
3 3 0 4 0.8 0.8 0.1
3 2 0 5 0.1 0.8 0.8
3 1 2 5 0.8 0.1 0.8
3 3 1 5 0.5 0.5 0.5
3 0 3 5 0.9 0.9 0.9
";

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
