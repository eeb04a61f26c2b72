//! Indication: strokes that are left out where a draftsman leaves the rest to the viewer (Bu et al. 2006, section 3,
//! "Indication").

use super::param::Params;
use super::slot::choice;

/// Strokes that are left out away from edges.
#[derive(Debug, Clone, PartialEq)]
pub struct Indication {
    /// How much is left out, 0 to 1.
    pub amount: f32,
    /// How it is found where details are.
    pub by: DetailBy,
    /// How far from edges that begins, reference pixels, 1 to 300.
    pub distance: f32,
    /// How fast strokes become fewer beyond, 0.1 to 4.
    pub falloff: f32,
    /// How many times as far the edges of this object keep strokes around them, on other objects too, 0 to 8.
    pub attraction: f32,
    /// By the general field map.
    pub patches: PatchField,
    /// By silhouettes nearby.
    pub silhouettes: SilhouetteField,
}

choice! {
    /// How it is found where details are.
    pub enum DetailBy {
        /// By the exact distance to the nearest line that is drawn.
        #[default]
        Lines,
        /// As in the paper: by the borders of flat parts, and by silhouettes nearby.
        Fields,
    }
}

/// w1 = (a + b · distance)^−c, by the distance to the border of a flat part: 0, in the middle of the square that the part is mapped
/// to 0.5.
#[derive(Debug, Clone, PartialEq)]
pub struct PatchField {
    /// Share of w1 in the whole, 0 to 2.
    pub share: f32,
    /// a, 0.1 to 4.
    pub offset: f32,
    /// b, 0 to 50.
    pub slope: f32,
    /// c, 0 to 4.
    pub power: f32,
}

/// w2 = (a + b · α / (n^β + λ))^−c, by the number n of 16 pixels around, at a distance, that lie beyond a silhouette.
#[derive(Debug, Clone, PartialEq)]
pub struct SilhouetteField {
    /// Share of w2 in the whole, 0 to 2.
    pub share: f32,
    /// Distance of the pixels, reference pixels, 1 to 200.
    pub radius: f32,
    /// Step off the plane of the surface that is a silhouette, reference pixels, 0.1 to 100.
    pub step: f32,
    /// α, 0 to 10.
    pub alpha: f32,
    /// β, 0.1 to 4.
    pub beta: f32,
    /// λ, 0 to 10.
    pub lambda: f32,
    /// a, 0.1 to 4.
    pub offset: f32,
    /// b, 0 to 50.
    pub slope: f32,
    /// c, 0 to 4.
    pub power: f32,
}

impl Default for Indication {
    fn default() -> Self {
        Self {
            amount: 0.0,
            by: DetailBy::default(),
            distance: 30.0,
            falloff: 1.3,
            attraction: 1.0,
            patches: PatchField { share: 0.6, offset: 1.0, slope: 12.0, power: 1.3 },
            silhouettes: SilhouetteField {
                share: 0.8,
                radius: 16.0,
                step: 4.0,
                alpha: 1.0,
                beta: 1.0,
                lambda: 0.05,
                offset: 1.0,
                slope: 1.0,
                power: 1.3,
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
            "Where strokes stay: by the distance to the nearest line, or by the fields of the hatching paper.",
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
            list.detail("patches", |list| self.patches.params(list));
            list.detail("silhouettes", |list| self.silhouettes.params(list));
        });
    }
}

/// The share of a field and its (offset + slope · x)^−power.
struct Weight<'a> {
    share: &'a mut f32,
    offset: &'a mut f32,
    slope: &'a mut f32,
    power: &'a mut f32,
}

impl<'a> Weight<'a> {
    fn params(self, list: &mut Params<'a>, share: &'static str) {
        list.wide_number("share", "Share", "", 0.0..=1.5, 0.0..=2.0, share, self.share);
        let help = "a of (a + b · x)^−c.";
        list.wide_number("offset", "Offset", "", 0.5..=2.0, 0.1..=4.0, help, self.offset);
        let help = "b of (a + b · x)^−c: how fast details become fewer.";
        list.wide_number("slope", "Slope", "", 0.0..=20.0, 0.0..=50.0, help, self.slope);
        list.wide_number("power", "Power", "", 0.0..=3.0, 0.0..=4.0, "c of (a + b · x)^−c.", self.power);
    }
}

impl PatchField {
    fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        let Self { share, offset, slope, power } = self;
        Weight { share, offset, slope, power }.params(list, "How much the borders of flat parts count.");
    }
}

impl SilhouetteField {
    fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        let Self { share, radius, step, alpha, beta, lambda, offset, slope, power } = self;
        Weight { share, offset, slope, power }.params(list, "How much silhouettes nearby count.");
        let help = "How far around silhouettes are looked for.";
        list.wide_number("radius", "Radius", "px", 2.0..=60.0, 1.0..=200.0, help, radius);
        let help = "Step in depth that is a silhouette.";
        list.wide_number("step", "Step", "px", 0.5..=20.0, 0.1..=100.0, help, step);
        list.wide_number("alpha", "α", "", 0.0..=4.0, 0.0..=10.0, "α of α / (n^β + λ).", alpha);
        list.wide_number("beta", "β", "", 0.1..=3.0, 0.1..=4.0, "β of α / (n^β + λ).", beta);
        list.wide_number("lambda", "λ", "", 0.0..=2.0, 0.0..=10.0, "λ of α / (n^β + λ).", lambda);
    }
}
