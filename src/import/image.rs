//! Image files become textures: PNG and JPEG, decoded side by side, refused when they declare an absurd size.

use std::io::Cursor;
use std::path::Path;
use std::sync::Arc;

use ::image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};
use rayon::prelude::*;

use super::{ImportError, Progress, source};
use crate::scene::Texture;

/// An image file's content with its name for messages.
#[derive(Debug, Clone)]
pub(super) struct EncodedImage {
    /// Name for messages.
    pub(super) name: String,
    /// The content of the file.
    pub(super) bytes: Arc<Vec<u8>>,
}

/// An image with at most so many pixels is always accepted: 4096 × 4096.
const ALWAYS_ACCEPTED_PIXELS: u64 = 16 << 20;

/// A larger image must be at least this fraction of its decoded size: 1/20.
const LARGEST_RATIO: u64 = 20;

/// Images are decoded side by side until their working memory reaches this many bytes.
const WORKING_BYTES: u64 = 160 << 20;

/// An image file by itself has at most so many bytes.
const MAX_FILE_BYTES: u64 = 512 << 20;

/// An image file by itself is kept with at most so many texels a side.
const MAX_SIDE: u32 = 4096;

/// Reads an image file by itself, one that a style names. Sides of more than 4096 texels are reduced.
///
/// # Errors
/// [`ImportError::Read`] or [`ImportError::Malformed`].
pub fn load_image(path: &Path) -> Result<Texture, ImportError> {
    let read_error = |source| ImportError::Read { path: path.into(), source };
    let malformed = |message| ImportError::Malformed { path: path.into(), message };
    let size = std::fs::metadata(path).map_err(read_error)?.len();
    if size > MAX_FILE_BYTES {
        return Err(malformed(format!("{size} bytes are too many for an image of a style")));
    }
    let bytes = Arc::new(source::read_regular_file(path).map_err(read_error)?);
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let image = EncodedImage { name, bytes };
    let texture = probe(&image).and_then(|_| decode(&image)).map_err(malformed)?;
    Ok(texture.reduced(MAX_SIDE))
}

/// Decodes images, in their order. Together they may take `budget` bytes; what would go beyond is refused, as is
/// what is damaged or declares an absurd size. The text of an `Err` is for a person.
///
/// # Errors
/// Only when the person stopped it.
pub(super) fn decode_all(
    images: &[EncodedImage],
    mut budget: u64,
    progress: &Progress,
) -> Result<Vec<Result<Texture, String>>, ImportError> {
    let mut sizes: Vec<Result<u64, String>> = images.par_iter().map(probe).collect();
    for size in &mut sizes {
        if let Ok(bytes) = *size {
            if bytes > budget {
                *size = Err(format!(
                    "left out: the model's images would take more memory than its size justifies ({} MB more)",
                    bytes >> 20
                ));
            } else {
                budget -= bytes;
            }
        }
    }
    let mut out = Vec::with_capacity(images.len());
    let mut rest = images.iter().zip(sizes).peekable();
    while rest.peek().is_some() {
        progress.check()?;
        let mut batch = Vec::new();
        let mut working = 0;
        while let Some(job) = rest.next_if(|(_, size)| {
            let need = size.as_ref().map_or(0, |bytes| bytes * 3);
            working == 0 || working + need <= WORKING_BYTES
        }) {
            working += job.1.as_ref().map_or(0, |bytes| bytes * 3);
            batch.push(job);
        }
        out.par_extend(batch.into_par_iter().map(|(image, size)| size.and_then(|_| decode(image))));
    }
    Ok(out)
}

/// The number of bytes that the image will take, from its header alone.
fn probe(image: &EncodedImage) -> Result<u64, String> {
    let (width, height) = open(image)?.dimensions();
    let pixels = u64::from(width) * u64::from(height);
    if pixels == 0 {
        return Err("it has no pixels".into());
    }
    let justified = (image.bytes.len() as u64).saturating_mul(LARGEST_RATIO);
    if pixels > ALWAYS_ACCEPTED_PIXELS && pixels.saturating_mul(4) > justified {
        return Err(format!(
            "it declares {width} × {height} pixels, which its {} bytes cannot justify",
            image.bytes.len()
        ));
    }
    if width.max(height) > 1 << 16 {
        return Err(format!("it declares {width} × {height} pixels; at most 65536 a side are read"));
    }
    Ok(pixels * 4)
}

/// Reads the header.
fn open(image: &EncodedImage) -> Result<impl ImageDecoder + '_, String> {
    let mut reader = ImageReader::new(Cursor::new(image.bytes.as_slice()))
        .with_guessed_format()
        .map_err(|e| e.to_string())?;
    match reader.format() {
        Some(ImageFormat::Png | ImageFormat::Jpeg) => {}
        Some(other) => {
            return Err(format!(
                "it is a {} image; save it as PNG or JPEG",
                other.extensions_str().first().unwrap_or(&"foreign")
            ));
        }
        None if image.bytes.is_empty() => return Err("it is empty".into()),
        None => return Err("it is neither a PNG nor a JPEG image".into()),
    }
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some((image.bytes.len() as u64 * LARGEST_RATIO).max(ALWAYS_ACCEPTED_PIXELS * 8));
    reader.limits(limits);
    reader.into_decoder().map_err(|e| e.to_string())
}

fn decode(image: &EncodedImage) -> Result<Texture, String> {
    let pixels = DynamicImage::from_decoder(open(image)?).map_err(|e| e.to_string())?.into_rgba8();
    Ok(Texture {
        name: image.name.clone(),
        width: pixels.width(),
        height: pixels.height(),
        rgba: pixels.into_raw().into(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn png(width: u32, height: u32) -> Vec<u8> {
        let mut out = Vec::new();
        DynamicImage::new_rgb8(width, height).write_to(&mut Cursor::new(&mut out), ImageFormat::Png).unwrap();
        out
    }

    fn decode_bytes(bytes: Vec<u8>) -> Result<Texture, String> {
        let image = EncodedImage { name: "test".into(), bytes: Arc::new(bytes) };
        decode_all(&[image], 1 << 30, &Progress::default()).unwrap().remove(0)
    }

    #[test]
    fn good_images_decode_and_bad_ones_say_why() {
        let texture = decode_bytes(png(3, 2)).unwrap();
        assert_eq!((texture.width, texture.height, texture.rgba.len()), (3, 2, 24));
        assert!(decode_bytes(Vec::new()).unwrap_err().contains("empty"));
        assert!(decode_bytes(b"hello".to_vec()).unwrap_err().contains("neither"));
        let mut cut = png(64, 64);
        cut.truncate(60);
        assert!(decode_bytes(cut).is_err());
    }

    #[test]
    fn a_tiny_file_that_declares_a_huge_image_is_refused() {
        let mut bytes = png(1, 1);
        // IHDR: width and height at bytes 16..24, its CRC at 29..33.
        bytes[16..20].copy_from_slice(&60000_u32.to_be_bytes());
        bytes[20..24].copy_from_slice(&60000_u32.to_be_bytes());
        let crc = crc32(&bytes[12..29]);
        bytes[29..33].copy_from_slice(&crc.to_be_bytes());
        let message = decode_bytes(bytes).unwrap_err();
        assert!(message.contains("60000 × 60000"), "{message}");
    }

    fn crc32(data: &[u8]) -> u32 {
        !data.iter().fold(!0_u32, |crc, &byte| {
            (0..8).fold(
                crc ^ u32::from(byte),
                |c, _| {
                    if c & 1 == 1 { (c >> 1) ^ 0xEDB8_8320 } else { c >> 1 }
                },
            )
        })
    }

    #[test]
    fn images_beyond_the_budget_are_left_out() {
        let image = EncodedImage { name: "big".into(), bytes: Arc::new(png(64, 64)) };
        let results = decode_all(&[image.clone(), image], 64 * 64 * 4, &Progress::default());
        let results = results.unwrap();
        assert!(results[0].is_ok());
        assert!(results[1].as_ref().unwrap_err().contains("left out"));
    }
}
