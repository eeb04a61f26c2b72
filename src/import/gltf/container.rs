//! From bytes to the typed JSON root: the GLB container, JSON, and the extensions that a file requires.

use ::gltf::json::Root;

use super::fault::{Fault, Result, malformed};

/// Extensions that may be required because the importer understands them.
const SUPPORTED: &[&str] = &[
    "KHR_lights_punctual",
    "KHR_materials_unlit",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_mesh_quantization",
    "KHR_meshopt_compression",
    "KHR_texture_transform",
    "EXT_meshopt_compression",
];

/// The mark that some programs put before UTF-8 text.
const BOM: &[u8] = b"\xEF\xBB\xBF";

/// The two chunks of a GLB, or a bare JSON file.
#[derive(Debug)]
pub(super) struct Chunks<'a> {
    /// The JSON text.
    pub(super) json: &'a [u8],
    /// The binary chunk, for the buffer without a URI.
    pub(super) bin: Option<&'a [u8]>,
}

/// Splits a GLB into its chunks; anything that does not begin with the GLB magic is JSON as a whole.
///
/// # Errors
/// When the container is damaged or of another version.
pub(super) fn split(data: &[u8]) -> Result<Chunks<'_>> {
    if !data.starts_with(b"glTF") {
        let text = data.strip_prefix(BOM).unwrap_or(data);
        if text.iter().find(|b| !b.is_ascii_whitespace()) != Some(&b'{') {
            return malformed(
                "it is neither a GLB, which begins with `glTF`, nor glTF JSON, which begins with `{`",
            );
        }
        return Ok(Chunks { json: data, bin: None });
    }
    let (Some(version), Some(length)) = (u32_at(data, 4), u32_at(data, 8)) else {
        return malformed("the GLB header is cut off; the file is incomplete");
    };
    if version != 2 {
        return Err(Fault::Unsupported(format!("version {version} of the GLB container")));
    }
    if u64::from(length) > data.len() as u64 {
        return malformed(format!(
            "the GLB header declares {length} bytes but the file has {}; it is incomplete",
            data.len()
        ));
    }
    let mut at = 12;
    let mut json = None;
    let mut bin = None;
    while at < data.len() && (json.is_none() || bin.is_none()) {
        let (Some(size), Some(kind)) = (u32_at(data, at), data.get(at + 4..at + 8)) else {
            break;
        };
        let start = at + 8;
        let Some(content) = start.checked_add(size as usize).and_then(|end| data.get(start..end)) else {
            return malformed(format!(
                "the GLB chunk at byte {at} declares {size} bytes but only {} follow; the file is incomplete",
                data.len() - start
            ));
        };
        match kind {
            b"JSON" if json.is_none() => json = Some(content),
            b"BIN\0" if bin.is_none() => bin = Some(content),
            _ => {}
        }
        at = start + content.len().next_multiple_of(4);
    }
    match json {
        Some(json) => Ok(Chunks { json, bin }),
        None => malformed("the GLB holds no JSON chunk"),
    }
}

fn u32_at(data: &[u8], at: usize) -> Option<u32> {
    let bytes = data.get(at..at.checked_add(4)?)?;
    Some(u32::from_le_bytes(bytes.try_into().ok()?))
}

/// Parses the JSON and checks version and required extensions. The flag says whether text had to be repaired.
///
/// # Errors
/// When it is no glTF 2 or requires an extension that is not supported.
pub(super) fn parse(json: &[u8]) -> Result<(Root, bool)> {
    let json = json.strip_prefix(BOM).unwrap_or(json);
    check_expansion(json)?;
    let (root, repaired) = match std::str::from_utf8(json) {
        Ok(text) => (Root::from_str(text), false),
        Err(_) => (Root::from_str(&String::from_utf8_lossy(json)), true),
    };
    let root = root.map_err(|e| {
        Fault::Malformed(if repaired {
            format!("the glTF JSON is not UTF-8 and cannot be read: {e}")
        } else {
            format!("the glTF JSON cannot be read: {e}")
        })
    })?;
    if !root.asset.version.starts_with("2.") {
        return Err(Fault::Unsupported(format!(
            "glTF version {}",
            crate::import::source::shorten(&root.asset.version)
        )));
    }
    for name in &root.extensions_required {
        if !SUPPORTED.contains(&name.as_str()) {
            return Err(Fault::Unsupported(format!(
                "the glTF extension {}",
                crate::import::source::shorten(name)
            )));
        }
    }
    Ok((root, repaired))
}

/// Refuses JSON whose parsed form would be out of all proportion to the text (`[{},{},{},…`).
fn check_expansion(json: &[u8]) -> Result<()> {
    const BYTES_PER_OBJECT: u64 = 600;
    const BYTES_PER_ITEM: u64 = 64;
    const ALWAYS_FINE: u64 = 256 << 20;
    let (objects, items) = json.iter().fold((0_u64, 0_u64), |(objects, items), &byte| {
        (objects + u64::from(byte == b'{'), items + u64::from(byte == b','))
    });
    let parsed = objects * BYTES_PER_OBJECT + items * BYTES_PER_ITEM;
    if parsed > ALWAYS_FINE + 16 * json.len() as u64 {
        return malformed(format!(
            "the glTF JSON holds {objects} objects in {} bytes; this is no sensible model",
            json.len()
        ));
    }
    Ok(())
}
