//! Gooch shading: cool-to-warm technical illustration (Gooch et al. 1998; edge-enhancement paper, section 5).

use super::Color;
use super::param::Params;
use super::slot::choice;

/// Parameters of the technique `gooch`.
///
/// The shade runs from `cool + alpha · base` where the surface turns away from the light to `warm + beta · base`
/// where it faces it.
#[derive(Debug, Clone, PartialEq)]
pub struct Gooch {
    /// Blue that is mixed into the side turned away from the light.
    pub cool: Color,
    /// Yellow that is mixed into the side that faces the light.
    pub warm: Color,
    /// Share of the base color on the cool side.
    pub alpha: f32,
    /// Share of the base color on the warm side.
    pub beta: f32,
    /// How far blue and yellow are multiplied by the base color, 0 (added as they are) to 1: dark and saturated ones keep
    /// their hue.
    pub object_hue: f32,
    /// How far the key light is turned to the side; 0: where it is, 1: across the line of sight.
    pub side_light: f32,
    /// Strength of the highlight; 0: none, 1: white.
    pub highlight: f32,
    /// Phong exponent of the highlight; 1: wide, 256: small.
    pub shininess: f32,
    /// Strength of the stripes of milled metal; 0: none (section 3.2).
    pub metal: f32,
    /// The axis around which the stripes lie.
    pub metal_axis: MetalAxis,
    /// Number of stripes around it.
    pub stripes: u32,
}

choice! {
    /// The axis around which the stripes of milled metal lie.
    pub enum MetalAxis {
        /// The object's own first axis.
        X,
        /// Its second one.
        #[default]
        Y,
        /// Its third one.
        Z,
        /// That of each turned or extruded form: what is none has no stripes.
        Form,
    /// The vertical of the picture: stripes follow the eye.
        View,
    }
}

impl Default for Gooch {
    fn default() -> Self {
        Self {
            cool: Color([66, 84, 166]),
            warm: Color([168, 142, 62]),
            alpha: 0.3,
            beta: 0.65,
            object_hue: 0.0,
            side_light: 0.0,
            highlight: 0.45,
            shininess: 32.0,
            metal: 0.0,
            metal_axis: MetalAxis::default(),
            stripes: 20,
        }
    }
}

impl Gooch {
    pub(super) fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        list.color("cool", "Cool", "Blue of the side turned away from the light.", &mut self.cool);
        list.color("warm", "Warm", "Yellow of the side that faces the light.", &mut self.warm);
        list.share(
            "alpha",
            "Cool tint",
            "Share of the object's own color on the cool side.",
            &mut self.alpha,
        );
        list.share("beta", "Warm tint", "Share of the object's own color on the warm side.", &mut self.beta);
        list.share("object_hue", "Object hue", "How far blue and yellow are multiplied by the object's own color: dark and saturated ones keep their hue.", &mut self.object_hue);
        list.formerly("own_hue");
        list.share("side_light", "Side light", "How far the key is turned to the side: at 1 it shines across the line of sight and sets faces apart.", &mut self.side_light);
        list.formerly("aside");
        list.share(
            "highlight",
            "Highlight",
            "Strength of the highlight; 0 switches it off.",
            &mut self.highlight,
        );
        list.wide_number(
            "shininess",
            "Shininess",
            "",
            1.0..=128.0,
            1.0..=256.0,
            "Phong exponent: a larger one makes the highlight smaller.",
            &mut self.shininess,
        );
        list.share(
            "metal",
            "Metal",
            "Strength of the stripes of milled metal; 0 switches them off.",
            &mut self.metal,
        );
        list.choice(
            "metal_axis",
            "Stripe axis",
            "The object's axis around which the stripes lie, that of each turned or extruded form, or the vertical of the view.",
            &mut self.metal_axis,
        );
        list.integer(
            "stripes",
            "Stripes",
            "",
            2..=64,
            "Number of stripes around the axis.",
            &mut self.stripes,
        );
    }
}
