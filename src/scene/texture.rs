//! Decoded images.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use glam::Vec4;

use crate::style::color;

/// The images that styles name, by the paths that stand in them.
pub type Images = BTreeMap<PathBuf, Arc<Texture>>;

/// A decoded image: 8-bit RGBA, rows from the top.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Texture {
    /// Name for messages.
    pub name: String,
    /// Width in texels.
    pub width: u32,
    /// Height in texels.
    pub height: u32,
    /// `4 · width · height` bytes.
    pub rgba: Arc<[u8]>,
}

impl Texture {
    /// Linear RGB and alpha of the image with so many texels a side, rows from the top: each is the mean of what it
    /// covers, in linear light. A side that is larger than the image's own is its own.
    pub fn averaged(&self, [width, height]: [u32; 2]) -> Vec<Vec4> {
        let columns = spans(self.width, width);
        let rows = spans(self.height, height);
        let linear: [f32; 256] = std::array::from_fn(|byte| color::linear_from_srgb(byte as u8));
        let texel = |row: &[u8], x: usize| match row.get(4 * x..4 * x + 4) {
            Some(&[r, g, b, a]) => {
                let [r, g, b] = [r, g, b].map(|c| linear[usize::from(c)]);
                Vec4::new(r, g, b, f32::from(a) / 255.0)
            }
            _ => Vec4::ZERO,
        };
        let mut means = Vec::with_capacity(columns.len() * rows.len());
        for row in &rows {
            let mut line = vec![Vec4::ZERO; columns.len()];
            for &(y, height) in row {
                let start = 4 * y * self.width as usize;
                let Some(source) = self.rgba.get(start..start + 4 * self.width as usize) else { continue };
                for (mean, column) in line.iter_mut().zip(&columns) {
                    *mean += height * column.iter().map(|&(x, width)| width * texel(source, x)).sum::<Vec4>();
                }
            }
            means.extend(line);
        }
        means
    }

    /// The same image with at most so many texels a side.
    #[must_use]
    pub fn reduced(self, most: u32) -> Self {
        if self.width.max(self.height) <= most {
            return self;
        }
        let (width, height) = (self.width.min(most), self.height.min(most));
        let rgba = self.averaged([width, height]).into_iter().flat_map(color::rgba_from_linear).collect();
        Self { name: self.name, width, height, rgba }
    }
}

/// Which of `from` texels in a row each of `to` covers, with their shares.
fn spans(from: u32, to: u32) -> Vec<Vec<(usize, f32)>> {
    let to = to.min(from);
    let step = f64::from(from) / f64::from(to.max(1));
    let span = |i: u32| {
        let (start, end) = (f64::from(i) * step, f64::from(i + 1) * step);
        let texels = start.floor() as usize..(end.ceil() as usize).min(from as usize);
        let share = |x: usize| (((x + 1) as f64).min(end) - (x as f64).max(start)) / step;
        texels.map(|x| (x, share(x) as f32)).collect()
    };
    (0..to).map(span).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gray(width: u32, height: u32, values: &[u8]) -> Texture {
        let rgba = values.iter().flat_map(|v| [*v, *v, *v, 255]).collect();
        Texture { name: "test".into(), width, height, rgba }
    }

    #[test]
    fn means_are_taken_in_linear_light() {
        let checker = gray(2, 2, &[0, 255, 255, 0]);
        assert_eq!(checker.averaged([1, 1]), [Vec4::new(0.5, 0.5, 0.5, 1.0)]);
        assert_eq!(checker.averaged([9, 9]).len(), 4, "an image is never enlarged");
        assert_eq!(checker.reduced(1).rgba[..], [188, 188, 188, 255]);
    }

    #[test]
    fn texels_that_are_covered_in_part_count_in_part() {
        let spans = spans(5, 2);
        assert_eq!(spans[0], [(0, 0.4), (1, 0.4), (2, 0.2)]);
        assert_eq!(spans[1], [(2, 0.2), (3, 0.4), (4, 0.4)]);
        let line = gray(5, 1, &[0, 0, 255, 255, 255]);
        let means: Vec<f32> = line.averaged([2, 1]).iter().map(|m| m.x).collect();
        assert!((means[0] - 0.2).abs() < 1e-6 && (means[1] - 1.0).abs() < 1e-6, "{means:?}");
    }

    #[test]
    fn small_images_stay_as_they_are() {
        let image = gray(2, 1, &[7, 200]);
        assert_eq!(image.clone().reduced(2), image);
        let long = gray(4, 1, &[7, 7, 200, 200]).reduced(2);
        assert_eq!((long.width, long.height, &long.rgba[..]), (2, 1, &image.rgba[..]));
    }
}
