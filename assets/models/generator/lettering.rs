//! Capital letters, written with a broad nib: strokes on a height of 1, and the ink that they leave.

use std::f64::consts::FRAC_PI_2;

use glam::{DMat2, DVec2, dvec2};

use crate::picture::Canvas;

/// A line that the nib follows.
type Stroke = Vec<DVec2>;

/// A pen point: an ellipse.
#[derive(Clone, Copy)]
pub(crate) struct Nib {
    /// Its largest and its smallest width in millimeters.
    pub(crate) widths: [f64; 2],
    /// How far its large axis is turned from the horizontal, in radians.
    pub(crate) angle: f64,
}

impl Nib {
    /// A round one.
    pub(crate) fn round(width: f64) -> Self {
        Self { widths: [width; 2], angle: 0.0 }
    }
}

/// How much ink lies on each texel of a canvas, 0 to 1.
pub(crate) struct Ink {
    canvas: Canvas,
    coverage: Vec<f64>,
}

impl Ink {
    /// A clean sheet.
    pub(crate) fn on(canvas: Canvas) -> Self {
        let [width, height] = canvas.texels;
        Self { canvas, coverage: vec![0.0; (width * height) as usize] }
    }

    /// The ink at a texel.
    pub(crate) fn at(&self, column: u32, row: u32) -> f64 {
        self.coverage[(row * self.canvas.texels[0] + column) as usize]
    }

    /// Draws a line through points, in millimeters from the canvas's lower left.
    pub(crate) fn line(&mut self, points: &[DVec2], nib: Nib) {
        let [long, short] = nib.widths.map(|width| width * 0.5);
        // To the space in which the nib is the unit circle.
        let to_nib = DMat2::from_diagonal(dvec2(1.0 / long, 1.0 / short)) * DMat2::from_angle(-nib.angle);
        let texel = self.canvas.texel();
        let [width, height] = self.canvas.texels;
        for pair in points.windows(2) {
            let margin = DVec2::splat(long) + texel;
            let low = (pair[0].min(pair[1]) - margin) / texel;
            let high = (pair[0].max(pair[1]) + margin) / texel;
            let rows = (f64::from(height) - high.y).max(0.0) as u32
                ..=((f64::from(height) - low.y) as u32).min(height - 1);
            for row in rows {
                for column in low.x.max(0.0) as u32..=(high.x as u32).min(width - 1) {
                    let p = to_nib * self.canvas.place(column, row);
                    let far = distance(p, to_nib * pair[0], to_nib * pair[1]);
                    let ink = 0.5 + (1.0 - far) * (long * short).sqrt() / texel.x;
                    let place = &mut self.coverage[(row * width + column) as usize];
                    *place = place.max(ink.clamp(0.0, 1.0));
                }
            }
        }
    }

    /// Writes a line of capitals, its middle at `middle`; `height` and the gap between letters in millimeters.
    pub(crate) fn write(&mut self, text: &str, middle: DVec2, height: f64, gap: f64, nib: Nib) {
        let letters: Vec<(f64, Vec<Stroke>)> = text.chars().map(strokes).collect();
        let width = letters.iter().map(|l| l.0 * height + gap).sum::<f64>() - gap;
        let mut pen = middle - dvec2(width, height) * 0.5;
        for (advance, strokes) in letters {
            for stroke in strokes {
                let points: Vec<DVec2> = stroke.iter().map(|&p| pen + p * height).collect();
                self.line(&points, nib);
            }
            pen.x += advance * height + gap;
        }
    }
}

/// The distance from a point to a line between two others.
fn distance(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    let along = b - a;
    let t = ((p - a).dot(along) / along.length_squared().max(1e-12)).clamp(0.0, 1.0);
    p.distance(a + along * t)
}

/// An arc of an ellipse; angles in quarter turns from the right, counter-clockwise.
fn arc(center: (f64, f64), radii: (f64, f64), from: f64, to: f64) -> Stroke {
    let n = 20;
    let point = |i: i32| {
        let angle = (from + (to - from) * f64::from(i) / f64::from(n)) * FRAC_PI_2;
        DVec2::from(center) + DVec2::from(radii) * DVec2::from_angle(angle)
    };
    (0..=n).map(point).collect()
}

/// The width of a letter and its strokes; a blank for what cannot be written.
fn strokes(letter: char) -> (f64, Vec<Stroke>) {
    let line = |points: &[(f64, f64)]| -> Stroke { points.iter().map(|&p| p.into()).collect() };
    let stem = || line(&[(0.0, 0.0), (0.0, 1.0)]);
    let chain = |parts: &[Stroke]| parts.concat();
    match letter {
        'A' => {
            (0.74, vec![line(&[(0.0, 0.0), (0.37, 1.0), (0.74, 0.0)]), line(&[(0.13, 0.36), (0.61, 0.36)])])
        }
        'C' => (0.76, vec![arc((0.45, 0.5), (0.45, 0.5), 0.55, 3.45)]),
        'D' => {
            let bowl = arc((0.28, 0.5), (0.44, 0.5), 1.0, -1.0);
            (0.72, vec![stem(), chain(&[line(&[(0.0, 1.0)]), bowl, line(&[(0.0, 0.0)])])])
        }
        'E' => (
            0.54,
            vec![
                line(&[(0.54, 1.0), (0.0, 1.0), (0.0, 0.0), (0.54, 0.0)]),
                line(&[(0.0, 0.52), (0.44, 0.52)]),
            ],
        ),
        'F' => (0.5, vec![line(&[(0.5, 1.0), (0.0, 1.0), (0.0, 0.0)]), line(&[(0.0, 0.52), (0.4, 0.52)])]),
        'G' => {
            let bowl = arc((0.45, 0.5), (0.45, 0.5), 0.55, 3.5);
            (0.8, vec![chain(&[bowl, line(&[(0.77, 0.14), (0.77, 0.45), (0.5, 0.45)])])])
        }
        'H' => (0.68, vec![stem(), line(&[(0.68, 0.0), (0.68, 1.0)]), line(&[(0.0, 0.51), (0.68, 0.51)])]),
        'I' => (0.0, vec![stem()]),
        'K' => (0.62, vec![stem(), line(&[(0.58, 1.0), (0.0, 0.4)]), line(&[(0.19, 0.6), (0.62, 0.0)])]),
        'L' => (0.5, vec![line(&[(0.0, 1.0), (0.0, 0.0), (0.5, 0.0)])]),
        'N' => (0.7, vec![line(&[(0.0, 0.0), (0.0, 1.0), (0.7, 0.0), (0.7, 1.0)])]),
        'O' => (0.92, vec![arc((0.46, 0.5), (0.46, 0.5), 0.0, 4.0)]),
        'R' => {
            let bowl = arc((0.28, 0.75), (0.28, 0.25), 1.0, -1.0);
            let top = chain(&[line(&[(0.0, 1.0)]), bowl, line(&[(0.0, 0.5)])]);
            (0.62, vec![stem(), top, line(&[(0.26, 0.5), (0.62, 0.0)])])
        }
        'S' => {
            let upper = arc((0.28, 0.75), (0.26, 0.25), 0.4, 3.0);
            (0.58, vec![chain(&[upper, arc((0.28, 0.25), (0.29, 0.25), 1.0, -1.6)])])
        }
        'T' => (0.66, vec![line(&[(0.0, 1.0), (0.66, 1.0)]), line(&[(0.33, 1.0), (0.33, 0.0)])]),
        'U' => {
            let bowl = arc((0.33, 0.33), (0.33, 0.33), 2.0, 4.0);
            (0.66, vec![chain(&[line(&[(0.0, 1.0)]), bowl, line(&[(0.66, 1.0)])])])
        }
        'W' => (1.0, vec![line(&[(0.0, 1.0), (0.25, 0.0), (0.5, 1.0), (0.75, 0.0), (1.0, 1.0)])]),
        'Y' => {
            (0.68, vec![line(&[(0.0, 1.0), (0.34, 0.48), (0.34, 0.0)]), line(&[(0.68, 1.0), (0.34, 0.48)])])
        }
        '0' => (0.58, vec![arc((0.29, 0.5), (0.29, 0.5), 0.0, 4.0)]),
        '5' => {
            let bowl = arc((0.24, 0.31), (0.29, 0.31), 1.4, -1.6);
            (0.53, vec![chain(&[line(&[(0.5, 1.0), (0.08, 1.0)]), bowl])])
        }
        '7' => (0.52, vec![line(&[(0.0, 1.0), (0.52, 1.0), (0.17, 0.0)])]),
        '.' => (0.0, vec![line(&[(0.0, 0.0), (0.0, 0.01)])]),
        _ => (0.35, Vec::new()),
    }
}
