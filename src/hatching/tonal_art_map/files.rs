//! Tonal art maps as images: one gray image, with levels below each other and, from left to right, their tones and their
//! priorities. Each level begins at the left of its column; what it does not fill is white.
//!
//! | column | holds |
//! | --- | --- |
//! | one for each tone, light to dark | 255 − ink |
//! | four more | threshold and ink of the first step, threshold and ink of the second one |

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, GrayImage, ImageEncoder, ImageReader, Limits};

use super::{Level, Priority, TonalArtMap};

/// Columns after those of the tones.
const PRIORITIES: usize = 4;
/// No level has less texels along a side.
const SMALLEST: usize = 16;
/// An image with more texels in a direction is refused.
const MAX_SIDE: u32 = 1 << 15;
/// An image that takes more memory is refused, in bytes.
const MAX_BYTES: u64 = 1 << 27;

/// Why an image is no tonal art map.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// It cannot be decoded, or is far too large.
    #[error("the stroke set cannot be read as an image: {0}; save it as a gray PNG")]
    Image(#[from] image::ImageError),
    /// It has a size that no map has.
    #[error(
        "the stroke set is {width} × {height} texels: its height must be that of all levels, such as 256 + 128 + 64 + 32, and \
         its width so many times the first one as there are tones, and four times more"
    )]
    Layout {
        /// Texels from left to right.
        width: u32,
        /// Texels from top to bottom.
        height: u32,
    },
    /// A tone lacks ink that a lighter one has.
    #[error(
        "tone {tone} of level {level} has less ink than the tone before it in column {column} of row {row}: all strokes of a \
         tone must be in the darker ones too"
    )]
    NotNested {
        /// From 0, the finest one.
        level: usize,
        /// From 0, the lightest one.
        tone: usize,
        /// From the left of the tile, counted from 0.
        column: usize,
        /// From its top, counted from 0.
        row: usize,
    },
    /// A tone is no darker than the one before it.
    #[error(
        "tone {tone} has the mean ink {ink}, the one before it {before}: each must be darker, and the first one not be blank"
    )]
    Order {
        /// From 0, the lightest one.
        tone: usize,
        /// Its mean ink, 0 to 1.
        ink: f32,
        /// That of the tone before it.
        before: f32,
    },
}

impl TonalArtMap {
    /// The map as a PNG file.
    ///
    /// # Errors
    /// When it is too large for one.
    pub fn to_png(&self) -> Result<Vec<u8>, FileError> {
        let side = self.levels.first().map_or(0, |level| level.side);
        let width = (side * (self.inks.len() + PRIORITIES)) as u32;
        let height = self.levels.iter().map(|level| level.side).sum::<usize>() as u32;
        let mut image = GrayImage::from_pixel(width, height, image::Luma([255]));
        let mut top = 0;
        for level in &self.levels {
            let tones = level.tones.iter().map(|tone| tone.iter().map(|ink| 255 - ink).collect());
            let of = |part: fn(&Priority) -> u8| level.priorities.iter().map(part).collect();
            let parts: [Vec<u8>; PRIORITIES] =
                [of(|p| p.thresholds[0]), of(|p| p.inks[0]), of(|p| p.thresholds[1]), of(|p| p.inks[1])];
            for (column, texels) in tones.chain(parts).enumerate() {
                for (i, value) in texels.iter().enumerate() {
                    let (x, y) = (column * side + i % level.side, top + i / level.side);
                    if let Some(texel) = image.get_pixel_mut_checked(x as u32, y as u32) {
                        texel.0 = [*value];
                    }
                }
            }
            top += level.side;
        }
        let mut png = Vec::new();
        PngEncoder::new_with_quality(&mut png, CompressionType::Best, FilterType::NoFilter).write_image(
            &image,
            width,
            height,
            ExtendedColorType::L8,
        )?;
        Ok(png)
    }

    /// The map of an image file that [`TonalArtMap::to_png`] made, or a person in the same layout. Inks of tones are measured.
    ///
    /// # Errors
    /// When it is none.
    pub fn from_png(bytes: &[u8]) -> Result<Self, FileError> {
        let mut reader = ImageReader::new(std::io::Cursor::new(bytes))
            .with_guessed_format()
            .map_err(image::ImageError::IoError)?;
        let mut limits = Limits::default();
        limits.max_image_width = Some(MAX_SIDE);
        limits.max_image_height = Some(MAX_SIDE);
        limits.max_alloc = Some(MAX_BYTES);
        reader.limits(limits);
        let image = reader.decode()?.into_luma8();
        let (width, height) = image.dimensions();
        let Layout { side, levels, tones } =
            Layout::of(width, height).ok_or(FileError::Layout { width, height })?;
        let mut top = 0;
        let levels: Vec<Level> = (0..levels)
            .map(|level| {
                let level = side >> level;
                let texels = |column: usize| -> Vec<u8> {
                    let at = |i: usize| ((column * side + i % level) as u32, (top + i / level) as u32);
                    (0..level * level)
                        .map(|i| image.get_pixel_checked(at(i).0, at(i).1).map_or(255, |texel| texel.0[0]))
                        .collect()
                };
                let priorities = priorities([0, 1, 2, 3].map(|i| texels(tones + i)));
                let ink = |tone| texels(tone).iter().map(|paper| 255 - paper).collect();
                let level = Level { side: level, tones: (0..tones).map(ink).collect(), priorities };
                top += level.side;
                level
            })
            .collect();
        for (number, level) in levels.iter().enumerate() {
            check_nesting(number, level)?;
        }
        Ok(Self { inks: inks(&levels)?, levels })
    }
}

/// What the size of an image says.
struct Layout {
    side: usize,
    levels: usize,
    tones: usize,
}

impl Layout {
    fn of(width: u32, height: u32) -> Option<Self> {
        // L levels make up a height of s / 2ᴸ⁻¹ · (2ᴸ − 1), of which the last factor is the odd one.
        let odd = height.checked_shr(height.trailing_zeros())?;
        let levels = (odd + 1).checked_ilog2()? as usize;
        let side = ((height / odd) << (levels - 1)) as usize;
        let columns = width as usize / side;
        let is_whole = (odd + 1).is_power_of_two()
            && levels <= 8
            && columns * side == width as usize
            && side >> (levels - 1) >= SMALLEST;
        (is_whole && columns > PRIORITIES).then(|| Self { side, levels, tones: columns - PRIORITIES })
    }
}

fn priorities([first, first_ink, second, second_ink]: [Vec<u8>; PRIORITIES]) -> Vec<Priority> {
    let thresholds = first.into_iter().zip(second).map(|(a, b)| [a, b.max(a)]);
    let inks = first_ink.into_iter().zip(second_ink).map(|(a, b)| [a, b.max(a)]);
    thresholds.zip(inks).map(|(thresholds, inks)| Priority { thresholds, inks }).collect()
}

fn check_nesting(number: usize, level: &Level) -> Result<(), FileError> {
    for (tone, (before, texels)) in level.tones.iter().zip(level.tones.iter().skip(1)).enumerate() {
        if let Some(i) = before.iter().zip(texels).position(|(before, ink)| before > ink) {
            let (column, row) = (i % level.side, i / level.side);
            return Err(FileError::NotNested { level: number, tone: tone + 1, column, row });
        }
    }
    Ok(())
}

/// Mean ink of the tones of the finest level.
fn inks(levels: &[Level]) -> Result<Vec<f32>, FileError> {
    let mut before = 0.0;
    let tones = levels.first().map(|level| level.tones.as_slice()).unwrap_or_default();
    let mean = |texels: &[u8]| {
        texels.iter().map(|ink| f64::from(*ink)).sum::<f64>() / (255 * texels.len().max(1)) as f64
    };
    tones
        .iter()
        .enumerate()
        .map(|(tone, texels)| {
            let ink = mean(texels) as f32;
            if ink <= before {
                return Err(FileError::Order { tone, ink, before });
            }
            before = ink;
            Ok(ink)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hatching::tonal_art_map::generator::Recipe;

    fn map() -> TonalArtMap {
        let recipe =
            Recipe { side: 64, levels: 3, inks: vec![0.2, 0.5], candidates: 20, ..Recipe::default() };
        recipe.draw(&|_| true).unwrap().map
    }

    #[test]
    fn a_map_comes_back_from_its_file() {
        let map = map();
        let read = TonalArtMap::from_png(&map.to_png().unwrap()).unwrap();
        assert!(read.levels == map.levels);
        for (read, drawn) in read.inks.iter().zip(&map.inks) {
            assert!((read - drawn).abs() < 0.01, "{read} {drawn}");
        }
    }

    #[test]
    fn what_is_no_map_is_refused() {
        let png = |width, height, gray: fn(u32, u32) -> u8| {
            let image = GrayImage::from_fn(width, height, |x, y| image::Luma([gray(x, y)]));
            let mut png = std::io::Cursor::new(Vec::new());
            image.write_to(&mut png, image::ImageFormat::Png).unwrap();
            TonalArtMap::from_png(&png.into_inner())
        };
        assert!(matches!(TonalArtMap::from_png(b""), Err(FileError::Image(_))));
        assert!(matches!(TonalArtMap::from_png(&map().to_png().unwrap()[..300]), Err(FileError::Image(_))));
        for (width, height) in [(64 * 6 + 1, 112), (64 * 4, 112), (64 * 6, 100), (1, 1), (64 * 6, 1)] {
            let found = png(width, height, |_, _| 0);
            assert!(matches!(found, Err(FileError::Layout { .. })), "{width} × {height}: {found:?}");
        }
        let found = png(64 * 6, 112, |_, _| 255);
        assert!(matches!(found, Err(FileError::Order { tone: 0, .. })), "{found:?}");
        let found = png(64 * 6, 112, |x, _| if x < 64 || x == 70 { 0 } else { 255 });
        assert!(
            matches!(found, Err(FileError::NotNested { level: 0, tone: 1, column: 0, row: 0 })),
            "{found:?}"
        );
        let found = png(64 * 6, 112, |x, y| if x == 3 && y == 5 { 99 } else { 100 + (y / 64) as u8 });
        assert!(matches!(found, Err(FileError::NotNested { column: 3, row: 5, .. })), "{found:?}");
    }
}
