//! PNG files.

use std::path::{Path, PathBuf};

use image::{DynamicImage, RgbaImage};

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
        source: png::EncodingError,
    },
}

/// Saves a picture as PNG (sRGB, straight alpha); without an alpha channel where it is opaque everywhere. `dpi`: pixels per
/// inch of paper, for whoever prints it.
///
/// # Errors
/// [`ExportError`]; an existing file is then untouched.
pub fn save_png(path: &Path, image: RgbaImage, dpi: Option<f64>) -> Result<(), ExportError> {
    if !path.extension().is_some_and(|e| e.eq_ignore_ascii_case("png")) {
        return Err(ExportError::UnknownFormat { path: path.into() });
    }
    let bytes = encode(image, dpi).map_err(|source| ExportError::Encode { path: path.into(), source })?;
    write_atomically(path, &bytes).map_err(|source| ExportError::Write { path: path.into(), source })
}

fn encode(image: RgbaImage, dpi: Option<f64>) -> Result<Vec<u8>, png::EncodingError> {
    let (width, height) = image.dimensions();
    let is_opaque = image.pixels().all(|p| p.0[3] == 255);
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(if is_opaque { png::ColorType::Rgb } else { png::ColorType::Rgba });
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Fast);
    encoder.set_filter(png::Filter::Adaptive);
    encoder.set_pixel_dims(dpi.map(|dpi| {
        let per_meter = (dpi / 0.0254).round().clamp(1.0, f64::from(u32::MAX)) as u32;
        png::PixelDimensions { xppu: per_meter, yppu: per_meter, unit: png::Unit::Meter }
    }));
    let mut writer = encoder.write_header()?;
    if is_opaque {
        writer.write_image_data(&DynamicImage::ImageRgba8(image).into_rgb8())?;
    } else {
        writer.write_image_data(&image)?;
    }
    writer.finish()?;
    Ok(bytes)
}
