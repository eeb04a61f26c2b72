//! Strokes that a person describes, or paints, for hatching with textures.

use std::path::PathBuf;

use super::param::Params;

/// What strokes look like: lines that are drawn by numbers, or a painted stroke.
#[derive(Debug, Clone, PartialEq)]
pub struct OwnStrokes {
    /// A picture of one stroke from left to right, dark on light.
    pub image: Option<PathBuf>,
    /// Length as a share of the tile that repeats; 0: dots.
    pub length: f32,
    /// Strokes are longer or shorter by up to this share.
    pub length_spread: f32,
    /// Width in reference pixels where strokes are 6 apart.
    pub width: f32,
    /// Strokes are wider or narrower by up to this share.
    pub width_spread: f32,
    /// Share of the length over which a stroke gets wider.
    pub taper_in: f32,
    /// Share of the length over which it gets thinner.
    pub taper_out: f32,
    /// How far strokes swing to either side, as a share of their length.
    pub waviness: f32,
    /// Strokes are turned by up to this to either side, degrees.
    pub turn_spread: f32,
    /// Ink of a single stroke.
    pub pressure: f32,
    /// How much ink the paper's valleys take away.
    pub grain: f32,
    /// Another number gives other strokes.
    pub seed: u32,
}

impl Default for OwnStrokes {
    fn default() -> Self {
        Self {
            image: None,
            length: 0.3,
            length_spread: 0.4,
            width: 1.6,
            width_spread: 0.2,
            taper_in: 0.1,
            taper_out: 0.3,
            waviness: 0.01,
            turn_spread: 2.0,
            pressure: 1.0,
            grain: 0.0,
            seed: 1,
        }
    }
}

impl OwnStrokes {
    pub(super) fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        let number = |list: &mut Params<'a>,
                      key,
                      label,
                      unit,
                      range: std::ops::RangeInclusive<f32>,
                      help,
                      value: &'a mut f32| {
            list.wide_number(key, label, unit, range.clone(), range, help, value);
        };
        list.when("hatching.set", super::hatching::Set::Painted, |list| {
            list.file(
                "image",
                "Stroke",
                "A picture of one stroke from left to right, dark on light; about 256 by 16.",
                &mut self.image,
            );
        });
        let help = "As a share of the tile that repeats; 0: dots.";
        number(list, "length", "Length", "", 0.0..=1.0, help, &mut self.length);
        let help = "How much lengths vary.";
        number(list, "length_spread", "Lengths vary", "", 0.0..=1.0, help, &mut self.length_spread);
        let help = "Width of strokes that are 6 apart; more with the spacing.";
        number(list, "width", "Width", "px", 0.5..=16.0, help, &mut self.width);
        let help = "How much widths vary.";
        number(list, "width_spread", "Widths vary", "", 0.0..=1.0, help, &mut self.width_spread);
        list.when("hatching.set", super::hatching::Set::Own, |list| {
            let help = "Over which share of its length a stroke gets wider.";
            number(list, "taper_in", "Taper in", "", 0.0..=1.0, help, &mut self.taper_in);
            list.formerly("begin");
            let help = "Over which share of its length it gets thinner.";
            number(list, "taper_out", "Taper out", "", 0.0..=1.0, help, &mut self.taper_out);
            list.formerly("end");
        });
        let help = "How far strokes swing, as a share of their length.";
        number(list, "waviness", "Waviness", "", 0.0..=0.25, help, &mut self.waviness);
        let help = "How far strokes are turned against each other.";
        number(list, "turn_spread", "Directions vary", "°", 0.0..=28.0, help, &mut self.turn_spread);
        let help = "Ink of a single stroke.";
        number(list, "pressure", "Pressure", "", 0.3..=1.0, help, &mut self.pressure);
        let help = "How much ink the valleys of the paper take away.";
        number(list, "grain", "Grain", "", 0.0..=0.7, help, &mut self.grain);
        list.integer("seed", "Seed", "", 0..=999, "Another number gives other strokes.", &mut self.seed);
    }
}
