//! PNG files.

use std::path::{Path, PathBuf};

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{DynamicImage, ImageEncoder as _, RgbaImage};

use crate::document::file::write_atomically;

/// Why a picture could not be saved.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// Only PNG is written.
    #[error("{}: pictures are saved as PNG; give the file a name that ends in .png", path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
    },
    /// The file could not be written; an old one is untouched.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The picture could not be encoded.
    #[error("cannot encode {}: {source}", path.display())]
    Encode {
        /// The file.
        path: PathBuf,
        /// What the encoder said.
        source: image::ImageError,
    },
}

/// Saves a picture as PNG (sRGB, straight alpha); without an alpha channel where it is opaque everywhere.
///
/// # Errors
/// [`ExportError`]; an existing file is then untouched.
pub fn save_png(path: &Path, image: RgbaImage) -> Result<(), ExportError> {
    if !path.extension().is_some_and(|e| e.eq_ignore_ascii_case("png")) {
        return Err(ExportError::UnknownFormat { path: path.into() });
    }
    let opaque = image.pixels().all(|p| p.0[3] == 255);
    let image = DynamicImage::ImageRgba8(image);
    let image = if opaque { DynamicImage::ImageRgb8(image.into_rgb8()) } else { image };
    let mut bytes = Vec::new();
    PngEncoder::new_with_quality(&mut bytes, CompressionType::Fast, FilterType::Adaptive)
        .write_image(image.as_bytes(), image.width(), image.height(), image.color().into())
        .map_err(|source| ExportError::Encode { path: path.into(), source })?;
    write_atomically(path, &bytes).map_err(|source| ExportError::Write { path: path.into(), source })
}
