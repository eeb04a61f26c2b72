//! The scale bar of a parallel view: how long things are, in their own unit.

use encase::ShaderType;
use glam::{Vec3, Vec4};
use tiny_skia::{FillRule, Mask, PathBuilder, Rect, Transform};

use crate::geometry::text::Text;
use crate::scene::{Camera, Projection, Unit};

/// It takes at most this share of the picture's width.
const WIDTH_SHARE: f64 = 0.3;
/// Reference pixels.
const MARGIN: f32 = 36.0;
const HEIGHT: f32 = 9.0;
const TEXT: f32 = 24.0;
const GAP: f32 = 8.0;
const STROKE: f32 = 1.5;

/// What a scale bar says.
#[derive(Debug, Clone, PartialEq)]
pub struct ScaleBar {
    /// Its length, px.
    pub length: f32,
    /// The number of fields in it.
    pub fields: u32,
    /// The length that it stands for, with its unit.
    pub label: String,
    /// Pixels per reference pixel.
    pub scale: f32,
    /// Linear color.
    pub ink: Vec3,
}

/// Twin of `ScaleBar` in `shaders/passes/resolve.wgsl`.
#[derive(Debug, Clone, PartialEq, ShaderType)]
pub struct ScaleBarUniform {
    /// Linear color.
    ink: Vec4,
    /// Width and height of the mask; from the lower left corner of the picture.
    size: glam::UVec2,
    /// Four pixels a word, row by row, each row a whole number of words.
    #[shader(size(runtime))]
    mask: Vec<u32>,
}

impl ScaleBar {
    /// The bar of a camera; none in perspective, where lengths have no scale. `meters_per_unit`: of the model, if known;
    /// `scale`: pixels per reference pixel; `paper`: linear color behind the bar.
    pub fn new(
        camera: &Camera,
        meters_per_unit: Option<f64>,
        [width, height]: [u32; 2],
        scale: f32,
        paper: Vec3,
    ) -> Option<Self> {
        let Projection::Orthographic { view_height } = camera.projection else { return None };
        let longest = view_height * f64::from(width) / f64::from(height) * WIDTH_SHARE;
        // A length that is short in meters is said in millimeters.
        let (factor, symbol) = match meters_per_unit {
            None => (1.0, "units"),
            Some(meters) => match Unit::of(meters).filter(|unit| ["in", "ft"].contains(&unit.symbol)) {
                Some(unit) => (1.0, unit.symbol),
                None => match longest * meters {
                    long if long >= 2000.0 => (meters / 1000.0, "km"),
                    long if long >= 1.0 => (meters, "m"),
                    long if long >= 0.05 => (meters * 100.0, "cm"),
                    _ => (meters * 1000.0, "mm"),
                },
            },
        };
        let (number, fields) = round_below(longest * factor)?;
        let light = paper.dot(Vec3::new(0.2126, 0.7152, 0.0722)) > 0.2;
        Some(Self {
            length: (number / factor / view_height * f64::from(height)) as f32,
            fields,
            label: format!("{number} {symbol}"),
            scale,
            ink: if light { Vec3::splat(0.01) } else { Vec3::splat(0.9) },
        })
    }

    /// The bar as the device reads it; `None` where it has no room.
    pub fn uniform(&self) -> Option<ScaleBarUniform> {
        let mask = self.mask()?;
        let size = glam::UVec2::new(mask.width(), mask.height());
        let rows = mask.data().chunks(size.x as usize);
        let words = rows.flat_map(|row| {
            row.chunks(4).map(|four| {
                let mut word = [0; 4];
                word.iter_mut().zip(four).for_each(|(byte, coverage)| *byte = *coverage);
                u32::from_le_bytes(word)
            })
        });
        Some(ScaleBarUniform { ink: self.ink.extend(1.0), size, mask: words.collect() })
    }

    /// How much of each pixel it covers.
    fn mask(&self) -> Option<Mask> {
        let s = self.scale;
        let (base, top) = (MARGIN * s, (MARGIN + HEIGHT) * s);
        let mut letters = PathBuilder::new();
        let mut write = |text: &str, left: f32| {
            let text = Text::new(text);
            let at = |index: &u32| {
                let p = text.mesh.positions.get(*index as usize).copied().unwrap_or_default();
                (left + p.x * TEXT * s, top + (GAP + p.y * TEXT) * s)
            };
            for triangle in text.mesh.indices.chunks_exact(3) {
                for (i, (x, y)) in triangle.iter().map(at).enumerate() {
                    if i == 0 { letters.move_to(x, y) } else { letters.line_to(x, y) }
                }
                letters.close();
            }
            left + text.max.x * TEXT * s
        };
        write("0", MARGIN * s);
        let end = write(&self.label, MARGIN * s + self.length);
        let (width, height) = ((end + 2.0).ceil(), (top + (GAP + TEXT) * s).ceil());
        let mut mask = Mask::new(width as u32, height as u32)?;
        // Rows go down, and so does its y.
        let upright = Transform::from_row(1.0, 0.0, 0.0, -1.0, 0.0, height);
        if let Some(path) = letters.finish() {
            mask.fill_path(&path, FillRule::Winding, true, upright);
        }
        let mut fields = PathBuilder::new();
        let mut fill = |left: f32, right: f32, low: f32, high: f32| {
            if let Some(rect) = Rect::from_ltrb(left, low, right, high) {
                fields.push_rect(rect);
            }
        };
        let (left, right) = (MARGIN * s, MARGIN * s + self.length);
        let stroke = (STROKE * s).max(1.0);
        fill(left, right, base, base + stroke);
        fill(left, right, top - stroke, top);
        let field = self.length / self.fields as f32;
        for i in 0..self.fields {
            let (from, to) = (left + field * i as f32, left + field * (i + 1) as f32);
            if i % 2 == 0 {
                fill(from, to, base, top);
            } else {
                fill(to - stroke, to, base, top);
            }
        }
        if let Some(path) = fields.finish() {
            mask.fill_path(&path, FillRule::Winding, true, upright);
        }
        Some(mask)
    }
}

/// The greatest of 1, 2 and 5 times a power of ten that is not above `longest`, and into how many fields it falls.
fn round_below(longest: f64) -> Option<(f64, u32)> {
    if !(longest.is_finite() && longest > 1e-30) {
        return None;
    }
    let power = longest.log10().floor();
    let digits = |digit: f64| {
        let number: f64 = format!("{digit}e{power}").parse().unwrap_or(f64::INFINITY);
        (number <= longest * (1.0 + 1e-9)).then_some(number)
    };
    [(5.0, 5), (2.0, 4), (1.0, 5)].into_iter().find_map(|(digit, fields)| Some((digits(digit)?, fields)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bar(view_height: f64, meters: Option<f64>) -> ScaleBar {
        let camera = Camera { projection: Projection::Orthographic { view_height }, ..Camera::default() };
        ScaleBar::new(&camera, meters, [1000, 500], 0.5, Vec3::ONE).unwrap()
    }

    #[test]
    fn it_says_round_lengths_that_fit() {
        for (view_height, meters, label) in [
            (30.0, Some(1.0), "10 m"),
            (10.0, Some(1.0), "5 m"),
            (4.0, Some(1.0), "2 m"),
            (300.0, Some(0.001), "10 cm"),
            (30.0, Some(0.001), "10 mm"),
            (1.0, Some(0.001), "0.5 mm"),
            (50.0, Some(1000.0), "20 km"),
            (40.0, Some(0.0254), "20 in"),
            (40.0, None, "20 units"),
        ] {
            let bar = bar(view_height, meters);
            assert_eq!(bar.label, label, "{view_height} {meters:?}");
            assert!(bar.length > 100.0 && bar.length <= 300.01, "{}", bar.length);
        }
    }

    #[test]
    fn its_length_is_true_to_scale() {
        // 30 units are 500 px high: 10 of them are a third.
        assert!((bar(30.0, Some(1.0)).length - 500.0 / 3.0).abs() < 1e-3);
        let uniform = bar(30.0, Some(1.0)).uniform().unwrap();
        assert_eq!(uniform.mask.len() as u32, uniform.size.x.div_ceil(4) * uniform.size.y);
        // Its first and third field are filled, the second one is not.
        let row = uniform.size.y - ((MARGIN + HEIGHT * 0.5) * 0.5) as u32;
        let covered = |x: f32| {
            let x = x as u32;
            uniform.mask[(row * uniform.size.x.div_ceil(4) + x / 4) as usize].to_le_bytes()[x as usize % 4]
        };
        let field = 500.0 / 15.0;
        assert_eq!([0.5, 1.5, 2.5].map(|i| covered(MARGIN * 0.5 + field * i)), [255, 0, 255]);
        assert_eq!(covered(MARGIN * 0.5 - 2.0), 0);
    }

    #[test]
    fn perspective_has_no_scale() {
        assert_eq!(ScaleBar::new(&Camera::default(), Some(1.0), [100, 100], 1.0, Vec3::ONE), None);
    }
}
