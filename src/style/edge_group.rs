//! The two groups of lines: what their classes inherit, and how the paper's operators find them.

use super::Color;
use super::edge_line::{LineFields, LineStyle};
use super::edge_mode::{EdgeMode, EdgeOperator};
use super::param::Params;

/// One of the two groups of edges.
#[derive(Debug, Clone, PartialEq)]
pub struct EdgeGroup<More> {
    /// Whether the group is drawn.
    pub show: bool,
    /// Color of the lines.
    pub color: Color,
    /// Opacity of full ink.
    pub opacity: f32,
    /// Width in reference pixels. Exact mode.
    pub width: f32,
    /// Whether the lines are drawn in dashes. Exact mode.
    pub dashed: bool,
    /// Ink per unit of discontinuity (1 − I). Image-space mode.
    pub gain: f32,
    /// Ink at or below this share is dropped, the rest is stretched to 0..1. Image-space mode.
    pub threshold: f32,
    /// What only this group has.
    pub more: More,
}

/// What the profile group has beyond [`EdgeGroup`].
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// Ink per unit of C1; takes the place of `gain` with that operator. Image-space mode.
    pub gain_c1: f32,
}

/// What the inner group has beyond [`EdgeGroup`].
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Inner {
    /// How far the dihedral angle weighs the strength of creases; 0: all alike. Exact mode.
    pub by_angle: f32,
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
            opacity: 1.0,
            width: 2.5,
            dashed: false,
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
            opacity: 1.0,
            width: 2.2,
            dashed: false,
            // Full ink at a dihedral angle of about 41°, none below about 18° (1 − cos).
            gain: 4.0,
            threshold: 0.2,
            more: Inner::default(),
        }
    }
}

impl<More> EdgeGroup<More> {
    /// What the classes of the group inherit.
    pub(super) fn line(&self) -> LineStyle {
        LineStyle {
            show: self.show,
            color: self.color,
            opacity: self.opacity,
            width: self.width,
            dashed: self.dashed,
            threshold: 0.0,
        }
    }
}

const THRESHOLD: &str = "Weaker discontinuities draw nothing.";

impl EdgeGroup<Profile> {
    pub(super) fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        let places = LineFields {
            show: (&mut self.show).into(),
            color: (&mut self.color).into(),
            opacity: (&mut self.opacity).into(),
            width: (&mut self.width).into(),
            dashed: (&mut self.dashed).into(),
        };
        places.declare("Profile edges", "Draw silhouettes, borders and the outlines of objects.", list);
        list.when("edges.mode", EdgeMode::ImageSpace, |list| {
            list.when_any("edges.operator", ["diagonal", "c1"], |list| {
                list.wide_number(
                    "threshold",
                    "Threshold",
                    "",
                    0.0..=0.95,
                    0.0..=0.99,
                    THRESHOLD,
                    &mut self.threshold,
                );
            });
            list.when("edges.operator", EdgeOperator::Diagonal, |list| {
                list.wide_number(
                    "gain",
                    "Gain",
                    "",
                    1.0..=40.0,
                    0.0..=1000.0,
                    "How much ink a change of depth has: with 10.3 a step of a tenth of the depth range has full ink.",
                    &mut self.gain,
                );
            });
            list.when("edges.operator", EdgeOperator::C1, |list| {
                list.wide_number(
                    "gain_c1",
                    "Gain",
                    "",
                    1.0..=80.0,
                    0.0..=1000.0,
                    "How much ink a change of depth has: with 20 a step of a tenth of the depth range has full ink.",
                    &mut self.more.gain_c1,
                );
            });
        });
    }
}

impl EdgeGroup<Inner> {
    pub(super) fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        let places = LineFields {
            show: (&mut self.show).into(),
            color: (&mut self.color).into(),
            opacity: (&mut self.opacity).into(),
            width: (&mut self.width).into(),
            dashed: (&mut self.dashed).into(),
        };
        places.declare("Inner edges", "Draw creases, borders of materials and intersections.", list);
        list.when("edges.mode", EdgeMode::Exact, |list| {
            list.share(
                "by_angle",
                "By angle",
                "How much weaker flat creases are than sharp ones; 0 draws all alike.",
                &mut self.more.by_angle,
            );
        });
        list.when("edges.mode", EdgeMode::ImageSpace, |list| {
            list.when_any("edges.operator", ["diagonal", "c1"], |list| {
                list.wide_number(
                    "threshold",
                    "Threshold",
                    "",
                    0.0..=0.95,
                    0.0..=0.99,
                    THRESHOLD,
                    &mut self.threshold,
                );
                list.wide_number(
                    "gain",
                    "Gain",
                    "",
                    0.5..=20.0,
                    0.0..=1000.0,
                    "How much ink a change of normals has: with 4 a fold of 41° has full ink.",
                    &mut self.gain,
                );
            });
        });
    }
}
