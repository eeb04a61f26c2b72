//! Indication: strokes that are left out where a draftsman leaves the rest to the viewer (Bu et al. 2006, section 3,
//! "Indication").

use super::param::Params;
use super::slot::choice;

/// Strokes that are left out away from edges.
#[derive(Debug, Clone, PartialEq)]
pub struct Indication {
    /// How much is left out.
    pub amount: f32,
    /// How it is found where details are.
    pub by: DetailBy,
    /// How far from edges that begins, reference pixels.
    pub distance: f32,
    /// How fast strokes become fewer beyond.
    pub falloff: f32,
    /// How many times as far the edges of this object keep strokes around them, on other objects too.
    pub attraction: f32,
    /// By the general field map: w1, of the distance x to the border of a flat part, 0 on it and 0.5 in the middle of the square
    /// that the part is mapped to.
    pub patches: FieldWeight,
    /// By silhouettes nearby.
    pub silhouettes: SilhouetteField,
}

choice! {
    /// How it is found where details are.
    pub enum DetailBy {
        /// By the exact distance to the nearest line that is drawn.
        #[default]
        Lines,
        /// By the fields of the paper: from the borders of flat parts, and from silhouettes nearby.
        Fields,
    }
}

/// The weight (a + b · x)^−c of a field x, and its share in the whole.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldWeight {
    /// Share in the whole.
    pub share: f32,
    /// a.
    pub offset: f32,
    /// b.
    pub slope: f32,
    /// c.
    pub power: f32,
}

/// w2, of x = α / (n^β + λ), by the number n of 16 pixels around, at a distance, that lie beyond a
/// silhouette.
#[derive(Debug, Clone, PartialEq)]
pub struct SilhouetteField {
    /// Of x.
    pub weight: FieldWeight,
    /// Distance of the pixels, reference pixels.
    pub radius: f32,
    /// Step off the plane of the surface that is a silhouette, reference pixels.
    pub step: f32,
    /// α.
    pub alpha: f32,
    /// β.
    pub beta: f32,
    /// λ.
    pub lambda: f32,
}

impl Default for Indication {
    fn default() -> Self {
        Self {
            amount: 0.0,
            by: DetailBy::default(),
            distance: 30.0,
            falloff: 1.3,
            attraction: 1.0,
            patches: FieldWeight { share: 0.6, offset: 1.0, slope: 12.0, power: 1.3 },
            silhouettes: SilhouetteField {
                weight: FieldWeight { share: 0.8, offset: 1.0, slope: 1.0, power: 1.3 },
                radius: 16.0,
                step: 4.0,
                alpha: 1.0,
                beta: 1.0,
                lambda: 0.05,
            },
        }
    }
}

impl Indication {
    pub(super) fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        list.share(
            "amount",
            "Amount",
            "How many strokes are left out away from edges; darks keep theirs.",
            &mut self.amount,
        );
        list.choice(
            "by",
            "Indication by",
            "Where strokes stay: near the nearest line that is drawn, or near the borders of flat parts and silhouettes.",
            &mut self.by,
        );
        list.when("hatching.indication.by", DetailBy::Lines, |list| {
            list.wide_number(
                "distance",
                "Distance",
                "px",
                5.0..=120.0,
                1.0..=300.0,
                "How far from edges strokes become fewer.",
                &mut self.distance,
            );
            let help = "How fast they do.";
            list.wide_number("falloff", "Falloff", "", 0.3..=3.0, 0.1..=4.0, help, &mut self.falloff);
            list.wide_number(
                "attraction",
                "Attraction",
                "",
                0.0..=4.0,
                0.0..=8.0,
                "How many times as far the edges of this object keep strokes, on others too: details attract details.",
                &mut self.attraction,
            );
        });
        list.when("hatching.indication.by", DetailBy::Fields, |list| {
            list.detail("patches", |list| self.patches.params(PATCH_HELPS, list));
            list.detail("silhouettes", |list| self.silhouettes.params(list));
        });
    }
}

impl FieldWeight {
    /// `helps`: what share, offset, slope and power are.
    fn params<'a>(&'a mut self, helps: [&'static str; 4], list: &mut Params<'a>) {
        let [share, offset, slope, power] = helps;
        list.wide_number("share", "Strength", "", 0.0..=1.5, 0.0..=2.0, share, &mut self.share);
        list.wide_number("offset", "Offset", "", 0.5..=2.0, 0.1..=4.0, offset, &mut self.offset);
        list.wide_number("slope", "Falloff rate", "", 0.0..=20.0, 0.0..=50.0, slope, &mut self.slope);
        list.wide_number("power", "Falloff power", "", 0.0..=3.0, 0.0..=4.0, power, &mut self.power);
    }
}

/// What a person is told about the weight of the field of flat parts.
const PATCH_HELPS: [&str; 4] = [
    "How much the borders of flat parts count: factor of (a + b · x)^−c.",
    "a of (a + b · x)^−c; x is the distance to the border of a flat part, 0 on it and 0.5 in its middle.",
    "b of (a + b · x)^−c: how fast strokes become fewer away from the borders of flat parts.",
    "c of (a + b · x)^−c: more leaves out more strokes in the middle of flat parts.",
];

impl SilhouetteField {
    fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        let Self { weight, radius, step, alpha, beta, lambda } = self;
        let helps = [
            "How much silhouettes nearby count: factor of (a + b · x)^−c.",
            "a of (a + b · x)^−c; x = α / (n^β + λ), where n of 16 pixels around lie beyond a silhouette.",
            "b of (a + b · x)^−c: how fast strokes become fewer where fewer pixels lie beyond a silhouette.",
            "c of (a + b · x)^−c: more leaves out more strokes away from silhouettes.",
        ];
        weight.params(helps, list);
        let help = "How far away the 16 pixels around lie, of which n lie beyond a silhouette.";
        list.wide_number("radius", "Radius", "px", 2.0..=60.0, 1.0..=200.0, help, radius);
        let help = "Step off the plane of the surface that is a silhouette, in widths of a px at that depth.";
        list.wide_number("step", "Step", "px", 0.5..=20.0, 0.1..=100.0, help, step);
        list.wide_number(
            "alpha",
            "Distance scale",
            "",
            0.0..=4.0,
            0.0..=10.0,
            "α of x = α / (n^β + λ).",
            alpha,
        );
        list.wide_number("beta", "Count exponent", "", 0.1..=3.0, 0.1..=4.0, "β of x = α / (n^β + λ).", beta);
        list.wide_number(
            "lambda",
            "Softening",
            "",
            0.0..=2.0,
            0.0..=10.0,
            "λ of x = α / (n^β + λ): where n is 0, x is α / λ.",
            lambda,
        );
    }
}
