//! Straight edges of a sketch, as an architect draws them.

use crate::style::param::Params;

/// Straight edges as strokes of a hand that has practiced them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strokes {
    /// Whether straight edges are drawn so.
    pub enabled: bool,
    /// How often each is drawn.
    pub times: u32,
    /// How far they go on beyond their ends, reference pixels.
    pub overshoot: f32,
    /// How far their ends are off, reference pixels.
    pub shift: f32,
    /// How bowed they are, percent of their length.
    pub bow: f32,
    /// How the hand trembles, reference pixels.
    pub tremor: f32,
}

impl Default for Strokes {
    fn default() -> Self {
        Self { enabled: false, times: 2, overshoot: 14.0, shift: 1.6, bow: 0.6, tremor: 0.55 }
    }
}

impl Strokes {
    pub(super) fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        list.head(
            "enabled",
            "Straight strokes",
            "Straight edges as an architect draws them.",
            &mut self.enabled,
        );
        list.when("sketch.strokes.enabled", "true", |list| {
            list.integer("times", "Repetitions", "", 1..=4, "How often each edge is drawn.", &mut self.times);
            list.wide_number(
                "overshoot",
                "Overshoot",
                "px",
                0.0..=40.0,
                0.0..=64.0,
                "How far strokes go on beyond corners at most.",
                &mut self.overshoot,
            );
            list.wide_number(
                "shift",
                "End offset",
                "px",
                0.0..=6.0,
                0.0..=16.0,
                "How far the ends of strokes are from those of edges.",
                &mut self.shift,
            );
            list.wide_number(
                "bow",
                "Bow",
                "%",
                0.0..=3.0,
                0.0..=10.0,
                "How far strokes are bowed, of their length.",
                &mut self.bow,
            );
            list.wide_number(
                "tremor",
                "Tremor",
                "px",
                0.0..=2.0,
                0.0..=8.0,
                "How the hand trembles.",
                &mut self.tremor,
            );
        });
    }
}
