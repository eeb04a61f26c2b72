//! Pictures of strokes.

/// A picture of one stroke, drawn from left to right.
#[derive(Debug, Clone, PartialEq)]
pub struct StrokeImage {
    width: usize,
    height: usize,
    /// 0 is paper, 1 full ink.
    ink: Vec<f32>,
}

/// Why an image is no stroke.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StrokeImageError {
    /// It has no texels, or more than can be sensible.
    #[error(
        "the stroke image is {width} × {height} texels: it must have between 1 and {MAX_SIDE} in each direction; \
         draw one stroke from left to right, about 256 × 16"
    )]
    Size {
        /// Texels from left to right.
        width: usize,
        /// Texels from top to bottom.
        height: usize,
    },
    /// The number of values is not that of the texels.
    #[error(
        "the stroke image has {found} values for {width} × {height} texels: give one gray value for each texel, \
         row by row"
    )]
    Count {
        /// Texels from left to right.
        width: usize,
        /// Texels from top to bottom.
        height: usize,
        /// Values that are there.
        found: usize,
    },
    /// A value is no shade of gray.
    #[error(
        "the stroke image has the value {value} in column {column} of row {row}: values must be between 0 (black) and 1 \
         (white)"
    )]
    Value {
        /// Counted from 0, from the left.
        column: usize,
        /// Counted from 0, from the top.
        row: usize,
        /// What is there.
        value: f32,
    },
    /// It is white all over.
    #[error(
        "the stroke image has hardly any ink: its mean is {mean}; draw a dark stroke that fills the image's height, on white"
    )]
    Blank {
        /// Mean ink, 0 to 1.
        mean: f32,
    },
}

/// More texels than this in one direction are refused.
pub const MAX_SIDE: usize = 8192;
/// An image with less mean ink than this is blank: no tone could be reached with it.
const MIN_MEAN: f32 = 0.02;

impl StrokeImage {
    /// From shades of gray, row by row, 0 is black (ink) and 1 white (paper).
    ///
    /// # Errors
    /// When there are no texels, not one value for each, a value is none, or there is no ink.
    pub fn new(width: usize, height: usize, gray: &[f32]) -> Result<Self, StrokeImageError> {
        if !(1..=MAX_SIDE).contains(&width) || !(1..=MAX_SIDE).contains(&height) {
            return Err(StrokeImageError::Size { width, height });
        }
        if gray.len() != width * height {
            return Err(StrokeImageError::Count { width, height, found: gray.len() });
        }
        // NaN is in no range.
        if let Some(at) = gray.iter().position(|value| !(0.0..=1.0).contains(value)) {
            let value = gray.get(at).copied().unwrap_or_default();
            return Err(StrokeImageError::Value { column: at % width, row: at / width, value });
        }
        let ink: Vec<f32> = gray.iter().map(|gray| 1.0 - gray).collect();
        let mean = ink.iter().sum::<f32>() / ink.len() as f32;
        if mean < MIN_MEAN {
            return Err(StrokeImageError::Blank { mean });
        }
        Ok(Self { width, height, ink })
    }

    /// Texels from left to right and from top to bottom.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// Ink of the texels, row by row, 0 is paper and 1 full ink.
    pub fn inks(&self) -> &[f32] {
        &self.ink
    }

    /// The same in about the size in which it is drawn, in texels, so that none of its own is passed over.
    pub(super) fn scaled(&self, columns: usize, rows: usize) -> Scaled {
        let (columns, rows) = (columns.clamp(1, self.width), rows.clamp(1, self.height));
        let range =
            |i: usize, of: usize, from: usize| i * from / of..((i + 1) * from / of).max(i * from / of + 1);
        let mean = |i: usize| {
            let (xs, ys) = (range(i % columns, columns, self.width), range(i / columns, rows, self.height));
            let count = (xs.len() * ys.len()) as f32;
            let texels = ys.flat_map(|y| xs.clone().map(move |x| y * self.width + x));
            texels.filter_map(|i| self.ink.get(i)).sum::<f32>() / count
        };
        let inked = (0..columns * rows).map(mean);
        let empty = || std::iter::repeat_n(0.0, columns);
        Scaled { columns, rows, ink: empty().chain(inked).chain(empty()).collect() }
    }
}

/// A stroke image of another size.
#[derive(Debug)]
pub(super) struct Scaled {
    columns: usize,
    rows: usize,
    /// With an empty row above and below.
    ink: Vec<f32>,
}

/// Where a place along the stroke is between two columns.
#[derive(Debug, Clone, Copy)]
pub(super) struct Columns {
    left: usize,
    right: usize,
    share: f32,
}

impl Scaled {
    /// A place along the stroke, 0 to 1.
    pub(super) fn along(&self, u: f32) -> Columns {
        let x = (u * self.columns as f32 - 0.5).clamp(0.0, (self.columns - 1) as f32);
        let left = x as usize;
        Columns { left, right: (left + 1).min(self.columns - 1), share: x - left as f32 }
    }

    /// Ink between texels; there is none above and below. `v` across the stroke, 0 to 1.
    pub(super) fn ink(&self, along: Columns, v: f32) -> f32 {
        // The empty row above is number 0.
        let y = (v * self.rows as f32 + 0.5).clamp(0.0, (self.rows + 1) as f32);
        let above = (y as usize).min(self.rows);
        let at = |i: usize| self.ink.get(i).copied().unwrap_or_default();
        let row = |row: usize| {
            let (a, b) = (at(row * self.columns + along.left), at(row * self.columns + along.right));
            a + (b - a) * along.share
        };
        let (first, second) = (row(above), row(above + 1));
        first + (second - first) * (y - above as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_images_say_what_is_wrong() {
        let size = |width, height| StrokeImageError::Size { width, height };
        assert_eq!(StrokeImage::new(0, 3, &[]), Err(size(0, 3)));
        assert_eq!(StrokeImage::new(MAX_SIDE + 1, 1, &[]), Err(size(MAX_SIDE + 1, 1)));
        assert_eq!(
            StrokeImage::new(2, 3, &[0.0; 5]),
            Err(StrokeImageError::Count { width: 2, height: 3, found: 5 })
        );
        for bad in [f32::NAN, f32::INFINITY, -0.1, 1.1] {
            let error = StrokeImage::new(2, 2, &[0.0, 0.0, 0.0, bad]).unwrap_err();
            assert!(matches!(error, StrokeImageError::Value { column: 1, row: 1, .. }), "{error}");
        }
        assert_eq!(StrokeImage::new(4, 4, &[1.0; 16]), Err(StrokeImageError::Blank { mean: 0.0 }));
    }

    #[test]
    fn scaling_keeps_the_ink_and_its_place() {
        let gray: Vec<f32> = (0..64 * 8).map(|i| if i % 64 < 32 { 0.0 } else { 1.0 }).collect();
        let image = StrokeImage::new(64, 8, &gray).unwrap();
        for (columns, rows) in [(16, 2), (64, 8), (500, 90)] {
            let scaled = image.scaled(columns, rows);
            let texels = (scaled.columns * scaled.rows) as f32;
            assert!((scaled.ink.iter().sum::<f32>() / texels - 0.5).abs() < 1e-6);
            let ink = |u, v| scaled.ink(scaled.along(u), v);
            assert_eq!([ink(0.1, 0.5), ink(0.9, 0.5), ink(0.1, -1.0), ink(0.1, 2.0)], [1.0, 0.0, 0.0, 0.0]);
        }
    }
}
