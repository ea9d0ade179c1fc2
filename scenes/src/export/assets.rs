//! Meshes as PLY, pictures as PNG and EXR.

use std::io::Cursor;
use std::sync::Arc;

use ::image::ImageEncoder;

use super::{ExportError, Writer};
use crate::{AttributeDomain, Image, Mesh, MeshAttribute, Texels};

impl Writer<'_> {
    /// The file of a mesh; with `turned` its triangles run the other way round.
    pub(super) fn mesh(&mut self, mesh: &Arc<Mesh>, turned: bool) -> Result<String, ExportError> {
        let key = (Arc::as_ptr(mesh), turned);
        if let Some(known) = self.meshes.get(&key) {
            return Ok(known.clone());
        }
        let name = self.file(&format!("mesh_{:04}.ply", self.meshes.len()), &ply(mesh, turned))?;
        self.meshes.insert(key, name.clone());
        Ok(name)
    }

    /// The file of a picture, and whether its bytes are linear (`raw`).
    pub(super) fn image(&mut self, image: &Arc<Image>) -> Result<(String, bool), ExportError> {
        let raw = matches!(image.texels, Texels::Linear8(_));
        if let Some(known) = self.images.get(&Arc::as_ptr(image)) {
            return Ok((known.clone(), raw));
        }
        let stem = format!("image_{:04}", self.images.len());
        let (extension, bytes) = match &image.texels {
            Texels::Srgb8(bytes) | Texels::Linear8(bytes) => ("png", png(image, bytes)),
            Texels::Linear32(values) => ("exr", exr(image, values)),
        };
        let name = format!("{stem}.{extension}");
        let bytes = bytes.map_err(|source| ExportError::Write { name: name.clone(), source })?;
        let name = self.file(&name, &bytes)?;
        self.images.insert(Arc::as_ptr(image), name.clone());
        Ok((name, raw))
    }
}

/// Binary little-endian PLY.
fn ply(mesh: &Mesh, turned: bool) -> Vec<u8> {
    let (has_normals, has_uvs) = (!mesh.normals.is_empty(), !mesh.uvs.is_empty());
    let mut properties: Vec<&str> = vec!["x", "y", "z"];
    if has_normals {
        properties.extend(["nx", "ny", "nz"]);
    }
    if has_uvs {
        properties.extend(["u", "v"]);
    }
    let columns = |domain: AttributeDomain| {
        let of_domain: Vec<&MeshAttribute> = mesh.attributes.iter().filter(|a| a.domain == domain).collect();
        let names = of_domain.iter().flat_map(|attribute| {
            let stem = attribute.name.split_once('_').map_or("", |(_, stem)| stem);
            (0..attribute.channels).map(move |i| format!("property float {stem}_{i}\n"))
        });
        (names.collect::<String>(), of_domain)
    };
    let (of_vertices, vertex_attributes) = columns(AttributeDomain::Vertex);
    let (of_faces, face_attributes) = columns(AttributeDomain::Face);
    let row = |attribute: &MeshAttribute, i: usize| {
        let channels = attribute.channels as usize;
        i * channels..(i + 1) * channels
    };
    let mut header =
        format!("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", mesh.positions.len());
    for property in &properties {
        header += &format!("property float {property}\n");
    }
    header += &of_vertices;
    header += &format!(
        "element face {}\nproperty list uchar int vertex_indices\n{of_faces}end_header\n",
        mesh.triangles.len()
    );
    let mut bytes = header.into_bytes();
    bytes.reserve(4 * properties.len() * mesh.positions.len() + 13 * mesh.triangles.len());
    let mut put = |values: &[f32]| values.iter().for_each(|v| bytes.extend(v.to_le_bytes()));
    for (i, position) in mesh.positions.iter().enumerate() {
        put(position);
        if has_normals {
            put(&mesh.normals[i]);
        }
        if has_uvs {
            put(&mesh.uvs[i]);
        }
        vertex_attributes.iter().for_each(|a| put(&a.values[row(a, i)]));
    }
    for (i, &[a, b, c]) in mesh.triangles.iter().enumerate() {
        bytes.push(3);
        for index in if turned { [a, c, b] } else { [a, b, c] } {
            bytes.extend((index as i32).to_le_bytes());
        }
        let values = face_attributes.iter().flat_map(|a| &a.values[row(a, i)]);
        values.for_each(|v| bytes.extend(v.to_le_bytes()));
    }
    bytes
}

fn png(image: &Image, bytes: &[u8]) -> std::io::Result<Vec<u8>> {
    let mut out = Vec::new();
    ::image::codecs::png::PngEncoder::new(&mut out)
        .write_image(bytes, image.width, image.height, ::image::ExtendedColorType::Rgb8)
        .map_err(std::io::Error::other)?;
    Ok(out)
}

fn exr(image: &Image, values: &[f32]) -> std::io::Result<Vec<u8>> {
    use exr::prelude::*;
    let width = image.width as usize;
    let pixel = |at: Vec2<usize>| {
        let first = 3 * (at.y() * width + at.x());
        (values[first], values[first + 1], values[first + 2])
    };
    let channels = SpecificChannels::rgb(pixel);
    let mut out = Cursor::new(Vec::new());
    exr::prelude::Image::from_channels((width, image.height as usize), channels)
        .write()
        .to_buffered(&mut out)
        .map_err(std::io::Error::other)?;
    Ok(out.into_inner())
}
