//! Hidden lines: those of what lies behind, drawn over what hides it.

use super::Color;
use super::edge_mode::EdgeMode;
use super::param::Params;
use super::slot::choice;

/// How the hidden lines of an object are drawn, whatever hides them. Details of surfaces (images, relief, shadows) have
/// none.
#[derive(Debug, Clone, PartialEq)]
pub struct Hidden {
    /// How they look.
    pub mode: HiddenMode,
    /// Of which layers they are.
    pub layers: HiddenLayers,
    /// With [`HiddenLayers::All`]: the greatest number of layers behind the visible one.
    pub max_layers: u32,
    /// They end before a layer with fewer pixels; percent of the picture's.
    pub min_coverage: f32,
    /// Opacity as a share of the visible lines'.
    pub opacity: f32,
    /// Width as a share of the visible lines'. Exact mode.
    pub relative_width: f32,
    /// Their own color.
    pub color: Color,
    /// Their own width in reference pixels. Exact mode.
    pub width: f32,
    /// Whether lines in their own color and width have dashes. Exact mode.
    pub dashed: bool,
    /// Length of a dash in reference pixels. Exact mode.
    pub dash: f32,
    /// Length of the gap behind it in reference pixels. Exact mode.
    pub gap: f32,
}

choice! {
    /// How hidden lines look.
    pub enum HiddenMode {
        /// Not drawn.
        #[default]
        Off,
        /// As the visible ones, but paler and narrower.
        Faint,
        /// The same in dashes; in image-space mode, whose edges have no direction, without.
        Dashed,
        /// In a color and width of their own.
        Own,
    }
}

choice! {
    /// Of which layers hidden lines are.
    pub enum HiddenLayers {
        /// The surfaces next behind the visible ones.
        Next,
        /// All.
        #[default]
        All,
    }
}

impl Default for Hidden {
    fn default() -> Self {
        Self {
            mode: HiddenMode::default(),
            layers: HiddenLayers::default(),
            max_layers: 12,
            min_coverage: 0.1,
            opacity: 0.6,
            // ISO 128-2: hidden edges are narrow dashed lines, half as wide as visible ones.
            relative_width: 0.5,
            color: Color([80, 110, 160]),
            width: 1.2,
            dashed: true,
            dash: 9.0,
            gap: 4.5,
        }
    }
}

impl Hidden {
    /// How many layers behind the visible one have lines of this object.
    pub fn depth(&self) -> u32 {
        match (self.mode, self.layers) {
            (HiddenMode::Off, _) => 0,
            (_, HiddenLayers::Next) => 1,
            (_, HiddenLayers::All) => self.max_layers.max(1),
        }
    }

    // Long, as it is a list: one entry per parameter.
    pub(super) fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        use HiddenMode::{Dashed, Faint, Own};
        const MODE: &str = "edges.hidden.mode";
        list.choice("mode", "Hidden lines", "How lines behind other surfaces are drawn.", &mut self.mode);
        list.when_any(MODE, [Faint, Dashed, Own], |list| {
            list.choice(
                "layers",
                "Layers",
                "The lines of the surfaces next behind the visible ones, or of all.",
                &mut self.layers,
            );
            list.when("edges.hidden.layers", HiddenLayers::All, |list| {
                list.integer(
                    "max_layers",
                    "Max. layers",
                    "",
                    1..=63,
                    "So many layers behind the visible one have lines.",
                    &mut self.max_layers,
                );
                list.formerly("most");
            });
            list.wide_number(
                "min_coverage",
                "Min. coverage",
                "%",
                0.0..=1.0,
                0.0..=100.0,
                "They end before a layer that covers a smaller share of the picture.",
                &mut self.min_coverage,
            );
            list.formerly("least");
        });
        list.when_any(MODE, [Faint, Dashed], |list| {
            list.share(
                "opacity",
                "Opacity",
                "Opacity of hidden lines as a share of the visible ones'.",
                &mut self.opacity,
            );
            list.formerly("strength");
        });
        list.when(MODE, Own, |list| {
            list.color("color", "Color", "Color of hidden lines.", &mut self.color);
        });
        list.when("edges.mode", EdgeMode::Exact, |list| {
            list.when_any(MODE, [Faint, Dashed], |list| {
                list.number(
                    "relative_width",
                    "Relative width",
                    "",
                    0.1..=1.0,
                    "Width of hidden lines as a share of the visible ones'.",
                    &mut self.relative_width,
                );
                list.formerly("narrow");
            });
            list.when(MODE, Own, |list| {
                list.wide_number(
                    "width",
                    "Width",
                    "px",
                    0.5..=16.0,
                    0.25..=64.0,
                    "Width of hidden lines.",
                    &mut self.width,
                );
                list.switch("dashed", "Dashed", "Draw hidden lines in dashes.", &mut self.dashed);
            });
            list.when_any(MODE, [Dashed, Own], |list| {
                let (soft, hard) = (1.0..=64.0, 1.0..=512.0);
                list.wide_number(
                    "dash",
                    "Dash",
                    "px",
                    soft.clone(),
                    hard.clone(),
                    "Length of a dash of hidden lines.",
                    &mut self.dash,
                );
                list.wide_number(
                    "gap",
                    "Gap",
                    "px",
                    soft,
                    hard,
                    "Length of the gap behind it.",
                    &mut self.gap,
                );
            });
        });
    }
}
