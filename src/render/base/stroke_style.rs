//! The hand that draws the strokes of a group.

use crate::geometry::hand::Hand;
use crate::style::sketch::Strokes;

/// How the straight lines of a group are drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrokeStyle(pub Hand);

impl StrokeStyle {
    /// That of a style; `None` if nothing is drawn so. `seed`: another number, another drawing; `scale`: pixels per reference
    /// pixel.
    pub fn new(strokes: &Strokes, seed: u32, scale: f32) -> Option<Self> {
        let Strokes { enabled, times, overshoot, shift, bow, tremor } = *strokes;
        enabled.then(|| Self(Hand { times, overshoot, shift, bow: bow / 100.0, tremor, scale, seed }))
    }
}
