//! Where lines and colors of a sketch go.

use crate::style::param::Params;
use crate::style::slot::choice;

/// Key of what others depend on.
const ANCHOR: &str = "sketch.anchor";

/// Where lines and colors go: what all passes and the fill have in common.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wander {
    /// Factor of all offsets.
    pub amount: f32,
    /// What the noise follows.
    pub anchor: Anchor,
    /// Where values beyond the outline come from, unless the noise follows the picture.
    pub exterior: Exterior,
    /// How far surfaces are enlarged for [`Exterior::Enlarged`], reference pixels; at least the largest offset.
    pub enlarge: f32,
    /// What the noise is like.
    pub noise: Noise,
    /// Length of a wave of the lines, reference pixels.
    pub wave: f32,
    /// How much longer waves on surfaces are for a moment, those of colors too; 1 but where a camera that comes nearer leaves them
    /// behind. No parameter.
    pub wave_scale: f32,
    /// Share of a finer wave, a quarter as long.
    pub detail: f32,
    /// How many waves, each half as long as the one before, are added where the noise follows the picture.
    pub octaves: u32,
    /// Number of the noise.
    pub seed: u32,
    /// Whether each object has noise of its own, so that equal objects differ.
    pub by_object: bool,
    /// How the depth of what is drawn is found.
    pub depth: SketchDepth,
    /// How much paler lines and colors are in places.
    pub pressure: f32,
    /// How often the picture is drawn anew, times per second; 0: never.
    pub boil: f32,
}

choice! {
    /// What the noise follows.
    pub enum Anchor {
        /// The picture: lines swim when the model turns.
        Screen,
        /// Places on the surface.
        #[default]
        Surface,
        /// Directions of the surface: what faces alike is off alike.
        Normal,
        /// Places on the surface, more where it is curved.
        Curvature,
        /// Places on the surface, more where it is far.
        Depth,
    }
}

choice! {
    /// Where values beyond the outline come from.
    pub enum Exterior {
        /// From the nearest line or surface.
        #[default]
        Nearest,
        /// From surfaces that are enlarged along their normals.
        Enlarged,
    }
}

choice! {
    /// What the noise is like.
    pub enum Noise {
        /// Smooth waves.
        #[default]
        Smooth,
        /// Sums of absolute values, with kinks.
        Turbulence,
    }
}

choice! {
    /// How the depth of what is drawn is found.
    pub enum SketchDepth {
        /// Ink and color have one each.
        #[default]
        Separate,
        /// They have the nearer of both.
        Nearer,
    }
}

impl Default for Wander {
    fn default() -> Self {
        Self {
            amount: 1.0,
            anchor: Anchor::default(),
            exterior: Exterior::default(),
            enlarge: 16.0,
            noise: Noise::default(),
            wave: 140.0,
            wave_scale: 1.0,
            detail: 0.1,
            octaves: 4,
            seed: 1,
            by_object: true,
            depth: SketchDepth::default(),
            pressure: 0.0,
            boil: 0.0,
        }
    }
}

impl Wander {
    pub(super) fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        list.wide_number(
            "amount",
            "Amount",
            "",
            0.0..=2.0,
            0.0..=4.0,
            "Factor of all offsets; 0 draws everything in its place.",
            &mut self.amount,
        );
        list.choice(
            "anchor",
            "Anchored to",
            "What offsets belong to: the picture (lines swim when the model turns), the places or directions of surfaces, or \
             places with more where they are curved or far.",
            &mut self.anchor,
        );
        list.choice("noise", "Noise", "Smooth waves, or turbulence, which has kinks.", &mut self.noise);
        wave_param(list, &mut self.wave);
        list.when(ANCHOR, Anchor::Screen, |list| {
            list.integer(
                "octaves",
                "Octaves",
                "",
                1..=8,
                "How many waves are added, each half as long as the one before.",
                &mut self.octaves,
            );
        });
        list.when_any(ANCHOR, [Anchor::Surface, Anchor::Normal, Anchor::Curvature, Anchor::Depth], |list| {
            list.share("detail", "Detail", "Share of a wave a quarter as long.", &mut self.detail);
            list.switch(
                "by_object",
                "Vary by object",
                "Each object wanders by itself, so that equal ones differ.",
                &mut self.by_object,
            );
            list.choice(
                "exterior",
                "Beyond outlines",
                "Whose offsets hold beyond an outline: those of the nearest line or surface, or of surfaces that are enlarged.",
                &mut self.exterior,
            );
            list.when("sketch.exterior", Exterior::Enlarged, |list| {
                list.wide_number(
                    "enlarge",
                    "Enlargement",
                    "px",
                    0.0..=32.0,
                    0.0..=64.0,
                    "How far surfaces are enlarged along their normals; never less than the largest offset.",
                    &mut self.enlarge,
                );
            });
        });
        list.integer("seed", "Seed", "", 0..=9999, "Another number, another drawing.", &mut self.seed);
        list.choice(
            "depth",
            "Depth",
            "Whether ink and color are hidden each by its own depth, or both by the nearer of the two.",
            &mut self.depth,
        );
        list.share(
            "pressure",
            "Pressure",
            "How much lines and colors lose of their opacity in places, as where a hand presses less.",
            &mut self.pressure,
        );
        list.wide_number(
            "boil",
            "Boil",
            "/s",
            0.0..=12.0,
            0.0..=24.0,
            "Drawn anew so often per second, as animators do; 0 stands still.",
            &mut self.boil,
        );
    }
}

/// Declares the length of a wave.
pub(super) fn wave_param<'a>(list: &mut Params<'a>, wave: &'a mut f32) {
    list.wide_number(
        "wave",
        "Wavelength",
        "px",
        40.0..=400.0,
        8.0..=1000.0,
        "Length of a wave; offsets greater than a fiftieth of it look like jelly.",
        wave,
    );
}
