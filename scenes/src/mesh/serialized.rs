//! Mitsuba's `.serialized` files: several meshes, each a zlib stream, with a table of their offsets at the end.
//!
//! ```text
//! mesh        u16 0x041C, u16 version (3 or 4), then compressed:
//!             u32 flags, in version 4 a name that ends with a zero, u64 vertices, u64 triangles,
//!             positions, normals?, texture coordinates?, colours?   (f32 or f64), triangles (u32)
//! table       an offset for each mesh (u32 in version 3, u64 in version 4), u32 number of meshes
//! ```
//!
//! All numbers are little-endian. What a mesh will take is known from its counts before it is decompressed, and is
//! refused where the file is too short for it.

use std::io::Read;
use std::path::Path;

use flate2::read::ZlibDecoder;

use super::raw::{Positions, RawMesh};
use super::{LoadedMesh, MeshOptions, mesh_error};
use crate::{AttributeDomain, MeshAttribute, SceneError};

const MAGIC: u16 = 0x041c;
const HAS_NORMALS: u32 = 0x0001;
const HAS_UVS: u32 = 0x0002;
const HAS_COLORS: u32 = 0x0008;
const FACE_NORMALS: u32 = 0x0010;
const DOUBLE: u32 = 0x2000;

/// Bytes that a mesh may have, whatever the size of its file.
const ALWAYS: u64 = 64 << 20;
/// Beyond that, bytes for each compressed one. Real meshes have about 3, a flat grid about 20; deflate can reach 1032.
const EXPANSION: u64 = 100;
/// Bytes of a name.
const MAX_NAME: usize = 1 << 16;

const DAMAGED: &str = "the file is damaged, or no .serialized file";
const CUT_OFF: &str = "the file is cut off or damaged";

/// What is wrong, and how to mend it.
type Bad = (String, &'static str);

/// Reads mesh number `index`, from 0, of a file.
///
/// # Errors
///
/// What is no such file or is damaged, an index that it does not have, and counts that its data do not bear out; with
/// the byte offset of the mesh.
pub(crate) fn read(
    bytes: &[u8],
    file: &Path,
    options: MeshOptions,
    index: u32,
) -> Result<LoadedMesh, SceneError> {
    let at = |offset: usize| {
        move |(problem, help): Bad| {
            mesh_error(file, 0, u32::try_from(offset).unwrap_or(u32::MAX), problem, help)
        }
    };
    let version = version(bytes).map_err(at(0))?;
    let offset = offset_of(bytes, version, index).map_err(at(bytes.len().saturating_sub(4)))?;
    let (raw, flags) = read_mesh(&bytes[offset..], version).map_err(at(offset))?;
    let face_normals = options.face_normals || flags & FACE_NORMALS != 0;
    Ok(raw.finish(MeshOptions { face_normals, ..options }))
}

/// The version that stands before a mesh.
fn version(mesh: &[u8]) -> Result<u16, Bad> {
    let [a, b, c, d, ..] = *mesh else {
        return Err(("fewer bytes than a header has".into(), CUT_OFF));
    };
    let (magic, version) = (u16::from_le_bytes([a, b]), u16::from_le_bytes([c, d]));
    if magic != MAGIC {
        return Err((format!("begins with {magic:#06x}, not with {MAGIC:#06x}"), DAMAGED));
    }
    if !(3..=4).contains(&version) {
        return Err((format!("version {version}"), "save the mesh in version 3 or 4"));
    }
    Ok(version)
}

/// Where a mesh begins. The first one needs no table.
fn offset_of(bytes: &[u8], version: u16, index: u32) -> Result<usize, Bad> {
    if index == 0 {
        return Ok(0);
    }
    let (table, count) = bytes.split_last_chunk::<4>().ok_or(("no table of meshes".into(), CUT_OFF))?;
    let count = u32::from_le_bytes(*count);
    if index >= count {
        let problem = format!("shape_index {index} of a file with {count} meshes");
        return Err((problem, "count the meshes of the file from 0"));
    }
    let width = if version == 3 { 4 } else { 8 };
    let from_end = u64::from(count - index) * width;
    let entry = (table.len() as u64).checked_sub(from_end).map(|start| &table[start as usize..]);
    let offset = entry.and_then(|entry| {
        let mut value = [0; 8];
        value[..width as usize].copy_from_slice(entry.get(..width as usize)?);
        usize::try_from(u64::from_le_bytes(value)).ok()
    });
    let within = offset.filter(|&offset| offset < bytes.len());
    within.ok_or_else(|| (format!("a table of {count} meshes that the file does not hold"), CUT_OFF))
}

/// A mesh with its flags.
fn read_mesh(mesh: &[u8], version_of_file: u16) -> Result<(RawMesh, u32), Bad> {
    version(mesh)?;
    let compressed = &mesh[4..];
    let mut stream = ZlibDecoder::new(compressed);
    let flags = u32::from_le_bytes(take(&mut stream)?);
    if version_of_file == 4 {
        skip_name(&mut stream)?;
    }
    let vertices = u64::from_le_bytes(take(&mut stream)?);
    let triangles = u64::from_le_bytes(take(&mut stream)?);
    let has = |flag: u32| flags & flag != 0;
    let scalar = if has(DOUBLE) { 8 } else { 4 };
    let columns = [(HAS_NORMALS, 3), (HAS_UVS, 2), (HAS_COLORS, 3)];
    let row: u64 = 3 + columns.iter().filter(|(flag, _)| has(*flag)).map(|(_, n)| n).sum::<u64>();
    let size = (vertices.checked_mul(row * scalar))
        .and_then(|size| size.checked_add(triangles.checked_mul(12)?))
        .filter(|&size| size <= ALWAYS.saturating_add(EXPANSION.saturating_mul(compressed.len() as u64)))
        .filter(|_| vertices <= u64::from(u32::MAX) && triangles <= u64::from(u32::MAX));
    let Some(size) = size else {
        let problem = format!("{vertices} vertices and {triangles} triangles in {} bytes", compressed.len());
        return Err((problem, "the counts are wrong: the file is damaged"));
    };
    // grows with what is there: nothing is set aside for what is only announced
    let mut body = Vec::new();
    stream.take(size).read_to_end(&mut body).map_err(damaged)?;
    if (body.len() as u64) < size {
        let problem = format!("{} bytes of the {size} that its counts call for", body.len());
        return Err((problem, CUT_OFF));
    }
    Ok((decode(&body, has, vertices as usize)?, flags))
}

/// The arrays of a mesh, whose length is right.
fn decode(body: &[u8], has: impl Fn(u32) -> bool, vertices: usize) -> Result<RawMesh, Bad> {
    let mut rest = body;
    let mut raw = RawMesh::default();
    if has(DOUBLE) {
        raw.positions = Positions::Double(rows(&mut rest, vertices, f64::from_le_bytes));
    } else {
        raw.positions = Positions::Single(rows(&mut rest, vertices, f32::from_le_bytes));
    }
    let double = has(DOUBLE);
    if has(HAS_NORMALS) {
        raw.normals = single_rows(&mut rest, vertices, double);
    }
    if has(HAS_UVS) {
        raw.uvs = single_rows(&mut rest, vertices, double);
    }
    if has(HAS_COLORS) {
        let colors: Vec<[f32; 3]> = single_rows(&mut rest, vertices, double);
        let (name, domain) = ("vertex_color".into(), AttributeDomain::Vertex);
        let values = colors.as_flattened().to_vec();
        raw.attributes.push(MeshAttribute { name, domain, channels: 3, values });
    }
    let triangles = rest.len() / 12;
    raw.triangles = rows(&mut rest, triangles, u32::from_le_bytes);
    let beyond = |t: &[u32; 3]| t.iter().copied().find(|&i| i as usize >= vertices);
    if let Some((number, index)) =
        raw.triangles.iter().zip(1..).find_map(|(t, number)| Some((number, beyond(t)?)))
    {
        return Err((format!("triangle {number} names vertex {index} of {vertices}"), DAMAGED));
    }
    Ok(raw)
}

/// Takes `count` rows of `N` numbers of `B` bytes from the front of `rest`.
fn rows<T, const N: usize, const B: usize>(
    rest: &mut &[u8],
    count: usize,
    number: impl Fn([u8; B]) -> T,
) -> Vec<[T; N]> {
    let (front, back) = rest.split_at(count * N * B);
    *rest = back;
    let (numbers, _) = front.as_chunks::<B>();
    let (rows, _) = numbers.as_chunks::<N>();
    rows.iter().map(|row| row.map(&number)).collect()
}

/// As [`rows`], rounded to `f32` from either precision.
fn single_rows<const N: usize>(rest: &mut &[u8], count: usize, double: bool) -> Vec<[f32; N]> {
    if double {
        rows(rest, count, |bytes| f64::from_le_bytes(bytes) as f32)
    } else {
        rows(rest, count, f32::from_le_bytes)
    }
}

/// The next bytes of a stream.
fn take<const N: usize>(stream: &mut impl Read) -> Result<[u8; N], Bad> {
    let mut bytes = [0; N];
    stream.read_exact(&mut bytes).map_err(damaged)?;
    Ok(bytes)
}

fn skip_name(stream: &mut impl Read) -> Result<(), Bad> {
    for _ in 0..MAX_NAME {
        if take::<1>(stream)? == [0] {
            return Ok(());
        }
    }
    Err((format!("a name of more than {MAX_NAME} bytes"), DAMAGED))
}

fn damaged(error: std::io::Error) -> Bad {
    let problem = if error.kind() == std::io::ErrorKind::UnexpectedEof {
        "the compressed data end early".into()
    } else {
        format!("the compressed data are no zlib stream ({error})")
    };
    (problem, CUT_OFF)
}

#[cfg(test)]
mod tests;
