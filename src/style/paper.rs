//! What a drawing is on.

use super::Color;
use super::param::Params;

/// The paper of a drawing whose whole style this is, unless the view has a background of its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paper {
    /// Its color.
    pub color: Color,
}

impl Default for Paper {
    fn default() -> Self {
        Self { color: Color([250, 248, 242]) }
    }
}

impl Paper {
    pub(super) fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        list.color(
            "paper",
            "Paper color",
            "Color of the paper, where this is the style of the whole drawing; `view.background` wins over it.",
            &mut self.color,
        );
    }
}
