//! How the lines of a sketch are drawn, each time that they are.

use crate::style::param::{Params, StyleField};
use crate::style::{Color, Matrix};

/// Greatest number of a matrix, reference pixels.
pub const MAX_OFFSET: f32 = 32.0;

/// How lines are drawn one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pass {
    /// From noise to offsets, reference pixels.
    pub matrix: Matrix,
    /// Color; `None`: that of the lines.
    pub color: Option<Color>,
    /// Width as a share of the lines'.
    pub relative_width: f32,
    /// Opacity as a share of the lines'.
    pub opacity: f32,
    /// Number of its noise.
    pub seed: u32,
}

impl Pass {
    /// The pass of that number, from 0.
    pub(super) fn numbered(number: usize) -> Self {
        Self {
            // Neither of them moves like another one.
            matrix: match number {
                0 => Matrix([[1.5, 0.3], [-0.3, 1.5]]),
                n if n % 2 == 1 => Matrix([[-0.5, 2.5], [-2.5, -0.5]]),
                _ => Matrix([[2.0, -1.5], [1.5, 2.0]]),
            },
            color: None,
            relative_width: 1.0,
            opacity: if number == 0 { 1.0 } else { 0.55 },
            seed: number as u32 + 1,
        }
    }

    pub(super) fn params<'a>(&'a mut self, ink: Color, list: &mut Params<'a>) {
        list.matrix(
            "matrix",
            "Offsets",
            "px",
            MAX_OFFSET,
            "How far lines go: each row times two noises, whose mean square is 1, is an offset, to the right and down.",
            &mut self.matrix,
        );
        list.color(
            "color",
            "Color",
            "Color of the lines in this pass.",
            StyleField::Inheriting {
                own: &mut self.color,
                inherited: ink,
                from: "edges.profile.color".to_owned(),
            },
        );
        list.wide_number(
            "relative_width",
            "Relative width",
            "",
            0.25..=2.0,
            0.1..=4.0,
            "Width as a share of the lines' own.",
            &mut self.relative_width,
        );
        list.formerly("width");
        list.share("opacity", "Opacity", "Opacity as a share of the lines' own.", &mut self.opacity);
        list.formerly("density");
        list.integer("seed", "Seed", "", 0..=9999, "Number of its noise.", &mut self.seed);
    }
}
