//! Blueprints: the outlines of what is visible and of what is hidden, in depth order (Nienhaus and Döllner, "Blueprints –
//! Illustrating Architecture and Technical Parts using Hardware-Accelerated Non-Photorealistic Rendering", 2004).

use super::Color;
use super::param::{Params, Scope};

/// Parameters of the technique `blueprint`.
///
/// Objects of equal style are split together into depth layers, each with its own lines over a fill. Which lines, and
/// how wide they are, is up to `edges`; their color runs from `near` to `far` by the share
/// `1 − (1 − by_layer)ⁿ · (1 − by_distance · d)`, n the number of layers before, d the depth, 0 (nearest) to 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Blueprint {
    /// Color of the nearest lines.
    pub near: Color,
    /// Color of the farthest lines.
    pub far: Color,
    /// How far lines fade with each layer before them; 0: not at all.
    pub by_layer: f32,
    /// How far lines fade with the distance; 0: not at all.
    pub by_distance: f32,
    /// Lines of ink fainter than this are left out and all others are full, as in a wire frame (section 4.2); 0: ink stays as
    /// it is. Flat folds have faint ink: 0.5 is one of 29°, 1 one of 41°.
    pub threshold: f32,
    /// Whether lines are drawn again where a nearer layer has one at the same place (section 4.1, Fig. 5).
    pub repeated: bool,
    /// Color of the surfaces.
    pub fill: Color,
    /// Opacity of the fill of each layer.
    pub fill_opacity: f32,
    /// The first layer that is drawn.
    pub from: u32,
    /// The last layer that is drawn, also where more would uncover more.
    pub to: u32,
    /// Most layers, where nothing is to be uncovered; never more than `to`.
    pub max_layers: u32,
    /// Layers end before one with fewer pixels; percent of the picture's.
    pub min_coverage: f32,
    /// Layers end with the one that leaves this share of the depth mask uncovered (section 4.3).
    pub fraction: f32,
    /// Whether what lies farther than the depth mask is drawn.
    pub beyond: bool,
    /// Color of designated objects of this style, which are no blueprints.
    pub designated_color: Color,
}

impl Default for Blueprint {
    fn default() -> Self {
        Self {
            near: Color([12, 52, 140]),
            far: Color([170, 194, 232]),
            by_layer: 0.35,
            by_distance: 0.3,
            threshold: 0.0,
            repeated: false,
            fill: Color([70, 120, 200]),
            fill_opacity: 0.05,
            from: 1,
            to: 64,
            max_layers: 8,
            min_coverage: 0.1,
            fraction: 0.9,
            beyond: true,
            designated_color: Color([226, 110, 44]),
        }
    }
}

impl Blueprint {
    // Long, as it is a list: one entry per parameter.
    pub(super) fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        list.color("near", "Near color", "Color of the nearest lines.", &mut self.near);
        list.color("far", "Far color", "Color of the farthest lines.", &mut self.far);
        list.share(
            "by_layer",
            "Layer fade",
            "How far lines go over to the far color with each layer before them.",
            &mut self.by_layer,
        );
        list.share(
            "by_distance",
            "Distance fade",
            "How far lines go over to the far color with the distance.",
            &mut self.by_distance,
        );
        list.share("threshold", "Threshold", "As in a wire frame, lines fainter than this, such as flat folds, are left out and all others are full; 0 leaves \
             ink as it is.", &mut self.threshold);
        list.switch(
            "repeated",
            "Repeat lines",
            "Draws lines again where a nearer layer has one at the same place.",
            &mut self.repeated,
        );
        list.color("fill", "Fill", "Color of the surfaces between the lines.", &mut self.fill);
        list.wide_number(
            "fill_opacity",
            "Fill opacity",
            "",
            0.0..=0.5,
            0.0..=1.0,
            "Opacity of the fill of each layer; 0 draws lines only.",
            &mut self.fill_opacity,
        );
        list.formerly("opacity");
        list.span("Layers", |list| {
            list.integer(
                "from",
                "From layer",
                "",
                1..=64,
                "The first layer that is drawn; nearer ones are left out.",
                &mut self.from,
            );
            list.integer(
                "to",
                "To layer",
                "",
                1..=64,
                "The last layer that is drawn, whatever else asks for more.",
                &mut self.to,
            );
        });
        list.integer(
            "max_layers",
            "Max. layers",
            "",
            1..=64,
            "Layers end after so many, or after To layer if that is less; to uncover designated objects they go on to there.",
            &mut self.max_layers,
        );
        list.formerly("layers");
        list.wide_number(
            "min_coverage",
            "Min. coverage",
            "%",
            0.0..=1.0,
            0.0..=100.0,
            "Layers end before one that covers a smaller share of the picture.",
            &mut self.min_coverage,
        );
        list.formerly("least");
        list.only(Scope::Masks, |list| {
            list.share(
                "fraction",
                "Uncover target",
                "Layers go on until this share of the designated objects is uncovered: 1 is all that can be.",
                &mut self.fraction,
            );
            list.switch(
                "beyond",
                "Draw beyond",
                "Draws what lies farther away than the designated objects.",
                &mut self.beyond,
            );
            list.color(
                "designated_color",
                "Designated",
                "Color of designated objects of this style, which are drawn as surfaces.",
                &mut self.designated_color,
            );
            list.formerly("highlight");
        });
    }
}
