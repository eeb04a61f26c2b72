//! Pictures of the viewport as PNG files.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use image::{ImageFormat, RgbaImage};

use crate::document::file::write_atomically;

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
    /// The picture could not be turned into a PNG.
    #[error("cannot encode the screenshot: {0}")]
    Encode(String),
    /// The file could not be written.
    #[error("cannot write the screenshot {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
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

/// Encodes straight RGBA bytes and writes them; returns the file. Opaque pictures are written without alpha.
///
/// # Errors
/// [`ScreenshotError`]; a file that was there is then untouched.
pub fn save(
    rgba: Vec<u8>,
    size: [u32; 2],
    transparent: bool,
    destination: &Destination,
) -> Result<PathBuf, ScreenshotError> {
    let image = RgbaImage::from_raw(size[0], size[1], rgba)
        .ok_or_else(|| ScreenshotError::Encode("the picture has the wrong size".to_owned()))?;
    let image = image::DynamicImage::from(image);
    let image = if transparent { image } else { image.to_rgb8().into() };
    let mut png = Cursor::new(Vec::new());
    image.write_to(&mut png, ImageFormat::Png).map_err(|e| ScreenshotError::Encode(e.to_string()))?;
    let png = png.into_inner();
    match destination {
        Destination::File(path) => write(path, &png),
        Destination::Numbered { model, folders } => {
            let mut result = Err(ScreenshotError::Encode("there is no folder for pictures".to_owned()));
            for folder in folders {
                result = write_numbered(folder, model, &png);
                if result.is_ok() {
                    break;
                }
            }
            result
        }
    }
}

fn write(path: &Path, png: &[u8]) -> Result<PathBuf, ScreenshotError> {
    write_atomically(path, png).map_err(|source| ScreenshotError::Write { path: path.into(), source })?;
    Ok(path.to_owned())
}

fn write_numbered(folder: &Path, model: &str, png: &[u8]) -> Result<PathBuf, ScreenshotError> {
    std::fs::create_dir_all(folder)
        .map_err(|source| ScreenshotError::Write { path: folder.into(), source })?;
    let mut number = 1;
    let mut path = folder.join(format!("{model}_{number}.png"));
    while path.exists() {
        number += 1;
        path = folder.join(format!("{model}_{number}.png"));
    }
    write(&path, png)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn screenshots_are_numbered_and_never_overwrite() {
        let folder = tempfile::tempdir().unwrap();
        let destination = Destination::Numbered {
            model: "crank".to_owned(),
            folders: vec!["/nonexistent/folder".into(), folder.path().join("Hachure")],
        };
        let shoot = |transparent| save(vec![7; 16], [2, 2], transparent, &destination).unwrap();
        let (first, second) = (shoot(false), shoot(true));
        assert_eq!(first.file_name().unwrap(), "crank_1.png");
        assert_eq!(second.file_name().unwrap(), "crank_2.png");
        assert_eq!(image::open(first).unwrap().color(), image::ColorType::Rgb8);
        let transparent = image::open(second).unwrap().to_rgba8();
        assert_eq!(transparent.get_pixel(1, 1).0, [7; 4]);
    }
}
