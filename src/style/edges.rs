//! Lines from the edge map (edge-enhancement paper, sections 3 and 4).

use super::Color;
use super::param::Params;

/// How edges are found and drawn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Edges {
    /// The operator that finds depth discontinuities.
    pub operator: DepthOperator,
    /// Profile edges: silhouettes and borders, found in depth.
    pub profile: EdgeGroup<Profile>,
    /// Inner edges: creases, found in normals.
    pub inner: EdgeGroup<Inner>,
}

/// Operator on the depth buffer (paper, section 4.1.2).
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    Hash,
    Default,
    strum::EnumString,
    strum::IntoStaticStr,
    strum::VariantNames,
)]
#[strum(serialize_all = "snake_case")]
pub enum DepthOperator {
    /// Two diagonal pairs: finer edges, softer intensities.
    #[default]
    Diagonal,
    /// Eight neighbours against the centre.
    C1,
}

/// What the profile group has beyond [`EdgeGroup`].
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// Ink per unit of C1; takes the place of `gain` with that operator.
    pub gain_c1: f32,
}

/// What the inner group has beyond [`EdgeGroup`]: nothing.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Inner;

/// One of the two groups of edges.
#[derive(Debug, Clone, PartialEq)]
pub struct EdgeGroup<More> {
    /// Whether the group is drawn.
    pub show: bool,
    /// Colour of the lines.
    pub color: Color,
    /// Opacity of full ink, 0 to 1.
    pub strength: f32,
    /// Ink per unit of discontinuity (1 − I), 0 to 100.
    pub gain: f32,
    /// Ink at or below this share is dropped, the rest is stretched to 0..1; 0 to 0.99.
    pub threshold: f32,
    /// What only this group has.
    pub more: More,
}

impl Default for Profile {
    fn default() -> Self {
        // A straight step of 0.1 gives C1 = 0.1 · (1 + 2 + 1) / 8.
        Self { gain_c1: 20.0 }
    }
}

impl Default for EdgeGroup<Profile> {
    fn default() -> Self {
        Self {
            show: true,
            color: Color::BLACK,
            strength: 1.0,
            // A step of 0.1 in one diagonal pair gives 1 − I_Z = 1 − 0.95², about 1 / 10.3.
            gain: 10.3,
            threshold: 0.2,
            more: Profile::default(),
        }
    }
}

impl Default for EdgeGroup<Inner> {
    fn default() -> Self {
        Self {
            show: true,
            color: Color::BLACK,
            strength: 1.0,
            // Full ink at a dihedral angle of about 41°, none below about 18° (1 − cos).
            gain: 4.0,
            threshold: 0.2,
            more: Inner,
        }
    }
}

impl Edges {
    pub(super) fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        list.choice(
            "operator",
            "Operator",
            "How depth discontinuities are found: two diagonal pairs, or eight neighbours (C1).",
            &mut self.operator,
        );
        let profile = &mut self.profile;
        list.section("profile", None, |list| {
            list.switch("show", "Profile edges", "Draw silhouettes and borders.", &mut profile.show);
            list.color("color", "Colour", "Colour of profile edges.", &mut profile.color);
            list.number("strength", "Strength", "", 0.0..=1.0, 0.0..=1.0, "Opacity of profile edges.", &mut profile.strength);
            list.number("threshold", "Threshold", "", 0.0..=0.95, 0.0..=0.99, "Weaker discontinuities in depth draw nothing.", &mut profile.threshold);
            list.number("gain", "Gain", "", 1.0..=40.0, 0.0..=1000.0, "Ink per discontinuity with the diagonal operator; 10.3 makes a step of a tenth of the depth range full ink.", &mut profile.gain);
            list.number("gain_c1", "Gain (C1)", "", 1.0..=80.0, 0.0..=1000.0, "Ink per discontinuity with the C1 operator; 20 makes a step of a tenth of the depth range full ink.", &mut profile.more.gain_c1);
        });
        let inner = &mut self.inner;
        list.section("inner", None, |list| {
            list.switch("show", "Inner edges", "Draw creases.", &mut inner.show);
            list.color("color", "Colour", "Colour of inner edges.", &mut inner.color);
            list.number(
                "strength",
                "Strength",
                "",
                0.0..=1.0,
                0.0..=1.0,
                "Opacity of inner edges.",
                &mut inner.strength,
            );
            list.number(
                "threshold",
                "Threshold",
                "",
                0.0..=0.95,
                0.0..=0.99,
                "Weaker discontinuities in normals draw nothing.",
                &mut inner.threshold,
            );
            list.number(
                "gain",
                "Gain",
                "",
                0.5..=20.0,
                0.0..=1000.0,
                "Ink per discontinuity: 4 makes a fold of 41° full ink.",
                &mut inner.gain,
            );
        });
    }
}
