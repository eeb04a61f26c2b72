//! Sketchy drawings: lines and colors that wander, are drawn over again and rubbed onto rough paper (Nienhaus and Döllner,
//! "Sketchy Drawings", 2004). Any surface technique can be drawn so; it is the paper's shade map.

mod fill;
mod grain;
mod pass;
mod strokes;
mod wander;

pub use fill::{Fill, Tone};
pub use grain::{Grain, Tooth};
pub use pass::{MAX_OFFSET, Pass};
pub use strokes::Strokes;
pub use wander::{Anchor, Exterior, Noise, SketchDepth, Wander};

use super::Color;
use super::param::Params;

/// Most times that lines are drawn over each other.
pub const MAX_PASSES: usize = 8;

/// How surfaces and lines are moved and rubbed on as by hand.
///
/// Offsets come from noise whose mean square is 1, multiplied by a matrix: its numbers are reference pixels.
#[derive(Debug, Clone, PartialEq)]
pub struct Sketch {
    /// Whether they are.
    pub enabled: bool,
    /// Where everything goes.
    pub wander: Wander,
    /// How often lines are drawn.
    pub passes: u32,
    /// How lines are drawn each time.
    pub pass: [Pass; MAX_PASSES],
    /// How surfaces are filled.
    pub fill: Fill,
    /// What rough paper makes of it.
    pub grain: Grain,
    /// Straight edges as an architect draws them.
    pub strokes: Strokes,
}

impl Default for Sketch {
    fn default() -> Self {
        Self {
            enabled: false,
            wander: Wander::default(),
            passes: 1,
            pass: std::array::from_fn(Pass::numbered),
            fill: Fill::default(),
            grain: Grain::default(),
            strokes: Strokes::default(),
        }
    }
}

/// Key of what others depend on.
const ENABLED: &str = "sketch.enabled";

/// Whole numbers as they are written, from 1 on.
const COUNTS: [&str; MAX_PASSES] = ["1", "2", "3", "4", "5", "6", "7", "8"];

impl Sketch {
    /// The image of the paper, if it is one.
    pub fn tooth_image(&self) -> Option<&std::path::Path> {
        let is_asked = self.enabled && self.grain.amount > 0.0 && self.grain.texture == Tooth::Image;
        self.grain.image.as_deref().filter(|_| is_asked)
    }

    /// `ink`: the color that lines have without one of their pass.
    pub(super) fn params<'a>(&'a mut self, ink: Color, list: &mut Params<'a>) {
        let Self { enabled, wander, passes, pass, fill, grain, strokes } = self;
        list.head("enabled", "Sketch", "Drawn as by hand: lines and colors wander.", enabled);
        list.when(ENABLED, "true", |list| {
            wander.params(list);
            list.integer(
                "passes",
                "Passes",
                "",
                1..=MAX_PASSES as u32,
                "How often lines are drawn over each other.",
                passes,
            );
            for (number, pass) in pass.iter_mut().enumerate() {
                let name = format!("pass{}", number + 1);
                if number == 0 {
                    list.section(&name, |list| pass.params(ink, list));
                } else {
                    list.when_any("sketch.passes", COUNTS.into_iter().skip(number), |list| {
                        list.detail(&name, |list| pass.params(ink, list));
                    });
                }
            }
            list.section("fill", |list| fill.params(list));
            list.section("grain", |list| grain.params(list));
            list.section("strokes", |list| strokes.params(list));
        });
    }
}
