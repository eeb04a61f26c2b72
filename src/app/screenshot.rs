//! Pictures of the viewport as PNG files, drawn and written in the background.

use std::path::{Path, PathBuf};

use image::RgbaImage;

use crate::document::Document;
use crate::export::{ExportError, save_png};
use crate::gpu::readback::Readback;
use crate::gpu::{Gpu, GpuError, Target};
use crate::import::Progress;
use crate::render::{RenderError, Renderer, Reported, Request};

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
    /// It was not wanted any more.
    #[error("no picture was saved")]
    Canceled,
    /// The picture could not be drawn.
    #[error("the picture could not be drawn: {0}")]
    Render(#[from] RenderError),
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

/// A picture that is to be taken.
pub struct Shot {
    /// What draws it; nobody else uses it.
    pub renderer: Renderer,
    /// What it shows.
    pub document: Document,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Whether the paper is left out.
    pub transparent: bool,
    /// Samples per pixel.
    pub samples: u32,
}

impl Shot {
    /// Draws the picture, one sample after the other, so that the window gets its turn between them.
    ///
    /// # Errors
    /// [`ScreenshotError::Render`] or [`ScreenshotError::Canceled`].
    pub fn take(mut self, progress: &Progress) -> Result<RgbaImage, ScreenshotError> {
        let camera = self.document.camera.unwrap_or_default();
        let request = Request {
            document: &self.document,
            camera: &camera,
            size: self.size,
            transparent: self.transparent,
            selected: &[],
            samples: self.samples,
        };
        loop {
            let picture = self.renderer.render(&request)?;
            self.renderer.gpu().submitted().wait(|| progress.is_canceled());
            if progress.is_canceled() {
                return Err(ScreenshotError::Canceled);
            }
            progress.report((picture.sample.index + 1) as f32 / picture.sample.of as f32);
            if self.renderer.take_reports() != Reported::Incomplete && picture.sample.is_last() {
                return Ok(read(self.renderer.gpu(), &picture.image, progress)?);
            }
        }
    }
}

fn read(gpu: &Gpu, image: &Target, progress: &Progress) -> Result<RgbaImage, RenderError> {
    let [width, height] = image.size();
    let readback = Readback::start(gpu, image, [0, 0], [width, height])?;
    gpu.submitted().wait(|| progress.is_canceled());
    let image = RgbaImage::from_raw(width, height, readback.wait(gpu)?);
    Ok(image.ok_or_else(|| GpuError::Lost("the picture came back incomplete".to_owned()))?)
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

/// Writes a picture as a PNG; returns the file.
///
/// # Errors
/// [`ScreenshotError`]; a file that was there is then untouched.
pub fn save(image: &RgbaImage, destination: &Destination) -> Result<PathBuf, ScreenshotError> {
    let (model, folders) = match destination {
        Destination::File(path) => {
            save_png(path, image.clone(), None)?;
            return Ok(path.clone());
        }
        Destination::Numbered { model, folders } => (model, folders),
    };
    let mut result = Err(ScreenshotError::NoFolder);
    for folder in folders {
        result = save_numbered(folder, model, image);
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
    save_png(&path, image.clone(), None)?;
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
        let shoot =
            |alpha| save(&RgbaImage::from_pixel(2, 2, image::Rgba([7, 7, 7, alpha])), &destination).unwrap();
        let (first, second) = (shoot(255), shoot(7));
        assert_eq!(first.file_name().unwrap(), "crank_1.png");
        assert_eq!(second.file_name().unwrap(), "crank_2.png");
        assert_eq!(image::open(first).unwrap().color(), image::ColorType::Rgb8);
        let transparent = image::open(second).unwrap().to_rgba8();
        assert_eq!(transparent.get_pixel(1, 1).0, [7; 4]);
    }
}
