//! Pictures of the viewport as PNG files.

use std::path::{Path, PathBuf};

use image::RgbaImage;

use crate::export::{ExportError, save_png};

/// Where screenshots go if this variable is set.
pub const FOLDER_VARIABLE: &str = "HACHURE_PICTURES";

/// Where a screenshot is to be written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Destination {
    /// The next free number in the folder of screenshots.
    Numbered {
        /// The first part of the name.
        model: String,
        /// Folders to try, in order.
        folders: Vec<PathBuf>,
    },
    /// This file.
    File(PathBuf),
}

/// Why a screenshot could not be saved.
#[derive(Debug, thiserror::Error)]
pub enum ScreenshotError {
    /// The device gave fewer pixels than the picture has.
    #[error("the picture came back incomplete; try again")]
    Incomplete,
    /// No folder is known.
    #[error("there is no folder for pictures; set {FOLDER_VARIABLE} to one")]
    NoFolder,
    /// The folder could not be made.
    #[error("cannot make the folder {}: {source}", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The file could not be written.
    #[error(transparent)]
    Export(#[from] ExportError),
}

/// The folders where screenshots may go: the person's pictures, else beside the model.
pub fn folders(model: Option<&Path>) -> Vec<PathBuf> {
    let set = |name: &str| std::env::var_os(name).filter(|v| !v.is_empty()).map(PathBuf::from);
    if let Some(folder) = set(FOLDER_VARIABLE) {
        return vec![folder];
    }
    let pictures = set("XDG_PICTURES_DIR")
        .or_else(pictures_of_user_dirs)
        .or_else(|| Some(std::env::home_dir()?.join("Pictures")));
    let beside = model.and_then(Path::parent).map(Path::to_owned);
    pictures.map(|p| p.join("Hachure")).into_iter().chain(beside).collect()
}

/// The pictures folder of the desktop's `user-dirs.dirs`.
fn pictures_of_user_dirs() -> Option<PathBuf> {
    let home = std::env::home_dir()?;
    let config = std::env::var_os("XDG_CONFIG_HOME").map_or_else(|| home.join(".config"), PathBuf::from);
    let text = std::fs::read_to_string(config.join("user-dirs.dirs")).ok()?;
    let line = text.lines().find_map(|l| l.trim().strip_prefix("XDG_PICTURES_DIR="))?;
    let value = line.trim().trim_matches('"');
    match value.strip_prefix("$HOME") {
        Some(rest) => Some(home.join(rest.trim_start_matches('/'))),
        None => Some(PathBuf::from(value)).filter(|p| p.is_absolute()),
    }
}

/// Writes straight RGBA bytes as a PNG; returns the file.
///
/// # Errors
/// [`ScreenshotError`]; a file that was there is then untouched.
pub fn save(rgba: Vec<u8>, size: [u32; 2], destination: &Destination) -> Result<PathBuf, ScreenshotError> {
    let image = RgbaImage::from_raw(size[0], size[1], rgba).ok_or(ScreenshotError::Incomplete)?;
    let (model, folders) = match destination {
        Destination::File(path) => {
            save_png(path, image)?;
            return Ok(path.clone());
        }
        Destination::Numbered { model, folders } => (model, folders),
    };
    let mut result = Err(ScreenshotError::NoFolder);
    for folder in folders {
        result = save_numbered(folder, model, &image);
        if result.is_ok() {
            break;
        }
    }
    result
}

fn save_numbered(folder: &Path, model: &str, image: &RgbaImage) -> Result<PathBuf, ScreenshotError> {
    std::fs::create_dir_all(folder)
        .map_err(|source| ScreenshotError::Folder { path: folder.into(), source })?;
    let mut number = 1;
    let mut path = folder.join(format!("{model}_{number}.png"));
    while path.exists() {
        number += 1;
        path = folder.join(format!("{model}_{number}.png"));
    }
    save_png(&path, image.clone())?;
    Ok(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn screenshots_are_numbered_and_never_overwrite() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("file"), "").unwrap();
        let destination = Destination::Numbered {
            model: "crank".to_owned(),
            // The first one cannot be made, because a file is in its way.
            folders: vec![folder.path().join("file/Hachure"), folder.path().join("Hachure")],
        };
        let shoot = |alpha| save([7, 7, 7, alpha].repeat(4), [2, 2], &destination).unwrap();
        let (first, second) = (shoot(255), shoot(7));
        assert_eq!(first.file_name().unwrap(), "crank_1.png");
        assert_eq!(second.file_name().unwrap(), "crank_2.png");
        assert_eq!(image::open(first).unwrap().color(), image::ColorType::Rgb8);
        let transparent = image::open(second).unwrap().to_rgba8();
        assert_eq!(transparent.get_pixel(1, 1).0, [7; 4]);
    }
}
