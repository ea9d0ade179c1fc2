//! From the bytes of a file to its JSON text and its binary chunk.

use std::ops::Range;
use std::path::Path;

use serde_json::Value;

use super::json::{Document, EXPORT_AGAIN, error};
use crate::SceneError;

/// How a binary glTF file begins.
const MAGIC: &[u8] = b"glTF";
/// Types of chunks.
const JSON: u32 = 0x4e4f_534a;
const BIN: u32 = 0x004e_4942;

/// Extensions that are read; others change what is seen less than a refusal would.
const READ: [&str; 15] = [
    "EXT_mesh_gpu_instancing",
    "KHR_lights_punctual",
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "KHR_xmp_json_ld",
];

/// Parses the JSON text; of a binary file, also says where its binary chunk lies.
pub(super) fn open(bytes: &[u8], file: &Path) -> Result<(Document, Option<Range<usize>>), SceneError> {
    let (text, binary) = if bytes.starts_with(MAGIC) {
        chunks(bytes).map_err(|(offset, problem)| {
            let offset = u32::try_from(offset).unwrap_or(u32::MAX);
            let help = "copy the file again: it may be cut off";
            SceneError { column: offset, ..error(file, "container", problem, help) }
        })?
    } else {
        (0..bytes.len(), None)
    };
    let start = text.start;
    let json = &bytes[text];
    let json = json.strip_prefix(b"\xef\xbb\xbf").unwrap_or(json);
    let root = serde_json::from_slice(json).map_err(|e| {
        let message = e.to_string();
        let clause = message.split(" at line ").next().unwrap_or_default();
        let problem = format!("not JSON: {clause}");
        let (line, column) = match (start, e.line()) {
            (0, line) => (line, e.column()),
            // of one long line, the byte says more
            (start, 1) => (0, start + e.column()),
            (start, _) => (0, start),
        };
        let [line, column] = [line, column].map(|n| u32::try_from(n).unwrap_or(u32::MAX));
        SceneError { line, column, ..error(file, "file", problem, EXPORT_AGAIN) }
    })?;
    let Value::Object(root) = root else {
        return Err(error(file, "", "not a glTF file: its JSON text is no object", "name a glTF file"));
    };
    let document = Document { file: file.into(), root };
    check_version(&document)?;
    Ok((document, binary))
}

/// Where the JSON text and the binary chunk of a binary file lie; else the offset and what is wrong there.
#[expect(clippy::type_complexity, reason = "used once, right above")]
fn chunks(bytes: &[u8]) -> Result<(Range<usize>, Option<Range<usize>>), (usize, String)> {
    let word = |at: usize| {
        let word = bytes.get(at..at + 4).ok_or_else(|| (at, "the file ends within a header".to_string()))?;
        Ok(u32::from_le_bytes([word[0], word[1], word[2], word[3]]))
    };
    let version = word(4)?;
    if version != 2 {
        return Err((4, format!("binary glTF of version {version}; 2 is read")));
    }
    let end = word(8)? as usize;
    if end > bytes.len() {
        return Err((8, format!("{end} bytes are announced, but the file has {}", bytes.len())));
    }
    let (mut text, mut binary) = (None, None);
    let mut at = 12;
    while at + 8 <= end {
        let (length, kind) = (word(at)? as usize, word(at + 4)?);
        let chunk = at + 8..at + 8 + length;
        if chunk.end > end {
            return Err((at, format!("a chunk of {length} bytes goes beyond the end")));
        }
        match kind {
            JSON if text.is_none() => text = Some(chunk.clone()),
            BIN if binary.is_none() => binary = Some(chunk.clone()),
            _ => {} // readers shall pass over what they do not know
        }
        at = chunk.end;
    }
    text.map(|text| (text, binary)).ok_or((12, "no JSON chunk".into()))
}

fn check_version(document: &Document) -> Result<(), SceneError> {
    let root = document.root();
    let asset = root.object("asset")?;
    let Some(asset) = asset else {
        return Err(root.error("asset", "not there, so this is no glTF 2 file", "name a glTF 2.0 file"));
    };
    // the version that is needed counts, where it is said
    let version = match asset.string("minVersion")? {
        Some(version) => Some(version),
        None => asset.string("version")?,
    };
    match version {
        Some(version) if version.starts_with("2.") || version == "2" => Ok(()),
        Some(other) => {
            let version: String = other.chars().take(40).collect();
            let problem = format!("glTF {version}; 2.0 is read");
            Err(asset.error("version", problem, "convert the file to glTF 2.0"))
        }
        None => Err(asset.error("version", "not there", "name a glTF 2.0 file")),
    }
}

/// Extensions that are not read, each with what that means.
///
/// # Errors
///
/// Where the file cannot be shown without one of them.
pub(super) fn unknown_extensions(document: &Document) -> Result<Vec<String>, SceneError> {
    let root = document.root();
    let names = |key| -> Result<Vec<&str>, SceneError> {
        let list = root.get(key).and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
        Ok(list.iter().filter_map(Value::as_str).filter(|name| !READ.contains(name)).collect())
    };
    if let Some(name) = names("extensionsRequired")?.first() {
        let help = match *name {
            "KHR_draco_mesh_compression" | "EXT_meshopt_compression" | "KHR_meshopt_compression" => {
                "export the model without mesh compression, or unpack it (gltf-transform copy)"
            }
            "KHR_texture_basisu" | "EXT_texture_webp" | "EXT_texture_avif" | "MSFT_texture_dds" => {
                "export the model with PNG or JPEG pictures"
            }
            _ => "export the model without this extension",
        };
        return Err(root.error("extensionsRequired", format!("{name} is not read"), help));
    }
    let mut unknown: Vec<String> = names("extensionsUsed")?.into_iter().map(String::from).collect();
    unknown.sort();
    unknown.dedup();
    Ok(unknown)
}
