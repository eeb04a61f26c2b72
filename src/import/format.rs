//! The formats of models, and which one a file has.

use std::path::Path;

/// A format that an importer exists for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::VariantArray)]
pub enum Format {
    /// glTF 2.0, JSON or GLB.
    Gltf,
    /// Wavefront OBJ.
    Obj,
    /// STL, text or binary.
    Stl,
    /// PLY, text or binary.
    Ply,
}

impl Format {
    /// All of them, in the order in which people are told.
    pub const ALL: &[Self] = <Self as strum::VariantArray>::VARIANTS;

    /// What people call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Gltf => "glTF",
            Self::Obj => "OBJ",
            Self::Stl => "STL",
            Self::Ply => "PLY",
        }
    }

    /// The endings of its files, in lower case and without dot.
    pub fn endings(self) -> &'static [&'static str] {
        match self {
            Self::Gltf => &["glb", "gltf"],
            Self::Obj => &["obj"],
            Self::Stl => &["stl"],
            Self::Ply => &["ply"],
        }
    }

    /// The names of all, with commas.
    pub fn names() -> String {
        Self::ALL.iter().map(|format| format.name()).collect::<Vec<_>>().join(", ")
    }

    /// The endings of all.
    pub fn all_endings() -> impl Iterator<Item = &'static str> {
        Self::ALL.iter().flat_map(|format| format.endings()).copied()
    }
}

/// The endings of images, in lower case and without dot.
pub const IMAGE_ENDINGS: [&str; 3] = ["png", "jpg", "jpeg"];

/// The format that the content's signature tells, else the one of the name's ending.
pub(super) fn detect(path: &Path, data: &[u8]) -> Option<Format> {
    by_content(data).or_else(|| by_ending(path))
}

fn by_content(data: &[u8]) -> Option<Format> {
    if data.starts_with(b"glTF") {
        Some(Format::Gltf)
    } else if data.starts_with(b"ply\n") || data.starts_with(b"ply\r") {
        Some(Format::Ply)
    } else if is_gltf_json(data) {
        Some(Format::Gltf)
    } else if is_binary_stl(data) || is_text_stl(data) {
        Some(Format::Stl)
    } else {
        None
    }
}

fn by_ending(path: &Path) -> Option<Format> {
    let ending = path.extension()?.to_str()?.to_ascii_lowercase();
    Format::ALL.iter().copied().find(|format| format.endings().contains(&ending.as_str()))
}

/// JSON whose beginning or end names `"asset"`, as every glTF must.
fn is_gltf_json(data: &[u8]) -> bool {
    const LOOK: usize = 4096;
    let data = data.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(data);
    let begins = data.iter().find(|b| !b.is_ascii_whitespace()) == Some(&b'{');
    let names_asset =
        |part: Option<&[u8]>| part.unwrap_or(data).windows(7).any(|window| window == b"\"asset\"");
    begins && (names_asset(data.get(..LOOK)) || names_asset(data.get(data.len().saturating_sub(LOOK)..)))
}

/// A binary STL is exactly as long as its number of triangles says.
fn is_binary_stl(data: &[u8]) -> bool {
    let Some(&[a, b, c, d]) = data.get(80..84) else {
        return false;
    };
    let count = u64::from(u32::from_le_bytes([a, b, c, d]));
    count > 0 && data.len() as u64 == 84 + 50 * count
}

/// A text STL begins with `solid` and soon has a `facet`.
fn is_text_stl(data: &[u8]) -> bool {
    let begin = data.get(..1024).unwrap_or(data).to_ascii_lowercase();
    begin.trim_ascii_start().starts_with(b"solid") && begin.windows(6).any(|window| window == b"facet ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endings_are_of_one_format() {
        for &format in Format::ALL {
            for ending in format.endings() {
                assert_eq!(detect(Path::new(&format!("a.{ending}")), b""), Some(format));
            }
        }
        assert_eq!(Format::names(), "glTF, OBJ, STL, PLY");
    }

    #[test]
    fn content_goes_before_the_ending() {
        let detect = |name: &str, data: &[u8]| detect(Path::new(name), data);
        assert_eq!(detect("a.obj", b"glTF...."), Some(Format::Gltf));
        assert_eq!(detect("a.stl", b"ply\nformat"), Some(Format::Ply));
        assert_eq!(detect("a", b" { \"asset\" : {} }"), Some(Format::Gltf));
        assert_eq!(detect("a.txt", b"solid x\n facet normal 0 0 1"), Some(Format::Stl));
        assert_eq!(detect("a.OBJ", b"v 0 0 0"), Some(Format::Obj));
        assert_eq!(detect("a.fbx", b"Kaydara"), None);
        let mut stl = vec![0; 84 + 50];
        stl[80] = 1;
        assert_eq!(detect("a.bin", &stl), Some(Format::Stl));
    }
}
