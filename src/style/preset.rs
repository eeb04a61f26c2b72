//! Styles with a name: the built-in ones of `assets/styles/` and the user's own files.

use std::path::Path;

use include_dir::{Dir, include_dir};

use super::param::{Renamed, map_paths};
use super::{Style, StyleError, nearest, set_from_toml};

/// The preset that a style was made from, by its id; a parameter that is reset has its value there. Styles that differ in nothing
/// else are equal.
#[derive(Debug, Clone, Default)]
pub struct MadeFrom(pub Option<String>);

impl PartialEq for MadeFrom {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

static STYLES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/assets/styles");

/// Style files are small texts; anything larger is a mistake.
const MAX_FILE_BYTES: u64 = 1 << 20;

/// A style with a name.
#[derive(Debug, Clone, PartialEq)]
pub struct Preset {
    /// By what files and the command line call it: the file's stem.
    pub id: String,
    /// Its name for people; the id where the file has none.
    pub name: String,
    /// One line that says what it is good for.
    pub description: String,
    /// The look.
    pub style: Style,
    /// Keys of earlier versions that it was written with.
    pub renamed: Vec<Renamed>,
}

/// The built-in presets, by id.
pub fn all() -> Vec<Preset> {
    let mut presets: Vec<_> = STYLES
        .files()
        .filter_map(|file| {
            let id = file.path().file_stem()?.to_str()?;
            let mut preset = read(id, file.contents_utf8()?, id).ok()?;
            preset.style.made_from = MadeFrom(Some(id.to_owned()));
            Some(preset)
        })
        .collect();
    presets.sort_by(|a, b| a.id.cmp(&b.id));
    presets
}

/// The preset of that id, or the style file at that path. Its images are sought beside it.
///
/// # Errors
/// [`StyleError::UnknownPreset`] when there is neither, otherwise what is wrong in the file.
pub fn load(id_or_path: &str) -> Result<Preset, StyleError> {
    if let Some(preset) = all().into_iter().find(|p| p.id == id_or_path) {
        return Ok(preset);
    }
    let path = Path::new(id_or_path);
    if path.extension().is_none() && !path.exists() {
        return Err(StyleError::UnknownPreset {
            id: id_or_path.to_owned(),
            nearest: nearest(id_or_path, all().iter().map(|p| p.id.as_str())),
        });
    }
    let unreadable = |reason: String| StyleError::Read { path: id_or_path.to_owned(), reason };
    let size = std::fs::metadata(path).map_err(|e| unreadable(e.to_string()))?.len();
    if size > MAX_FILE_BYTES {
        return Err(unreadable(format!("it has {size} bytes, a style file has at most {MAX_FILE_BYTES}")));
    }
    let text = std::fs::read_to_string(path).map_err(|e| unreadable(e.to_string()))?;
    let stem = path.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned());
    let mut preset = read(&stem, &text, id_or_path)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    map_paths(&mut preset.style.params(), |image| folder.join(image));
    Ok(preset)
}

fn read(id: &str, text: &str, place: &str) -> Result<Preset, StyleError> {
    let mut style = Style::default();
    let renamed = set_from_toml(&mut style.params(), text, place)?;
    let table = text.parse::<toml::Table>().unwrap_or_default();
    let said = |key: &str| table.get(key).and_then(toml::Value::as_str).map(str::to_owned);
    let name = said("name").unwrap_or_else(|| id.to_owned());
    Ok(Preset {
        id: id.to_owned(),
        name,
        description: said("description").unwrap_or_default(),
        style,
        renamed,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_built_in_preset_is_valid_and_described() {
        let presets = all();
        assert_eq!(presets.len(), STYLES.files().count());
        assert!(presets.iter().all(|p| !p.description.is_empty() && p.name != p.id));
    }

    #[test]
    fn an_unknown_name_suggests_the_nearest() {
        let message = load("goch").unwrap_err().to_string();
        assert!(message.contains("did you mean `gooch`?"), "{message}");
    }
}
