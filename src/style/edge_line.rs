//! The look of one class of lines, which it has from its group as far as it has none of its own; and the ranges of width, opacity
//! and threshold, for classes and groups.

use super::Color;
use super::edge_mode::EdgeMode;
use super::param::{Params, StyleField};
use crate::geometry::EdgeClass;

/// Width of section lines in reference pixels.
const SECTION_WIDTH: f32 = 4.0;

/// The look of a class of lines, complete.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineStyle {
    /// Whether it is drawn.
    pub show: bool,
    /// Color.
    pub color: Color,
    /// Opacity.
    pub opacity: f32,
    /// Width in reference pixels.
    pub width: f32,
    /// Whether it is drawn in dashes.
    pub dashed: bool,
    /// What an edge must reach to be drawn. Profile edges: the step in depth behind them, in widths of a reference pixel at
    /// their depth; creases, intersections and relief: the angle between the surfaces in degrees; textures: the difference of
    /// the colors.
    pub threshold: f32,
}

/// What a person set for one class of lines; what is `None` is as in the class's group.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClassStyle {
    /// Whether it is drawn.
    pub show: Option<bool>,
    /// Color.
    pub color: Option<Color>,
    /// Opacity.
    pub opacity: Option<f32>,
    /// Width in reference pixels.
    pub width: Option<f32>,
    /// Whether it is drawn in dashes.
    pub dashed: Option<bool>,
    /// See [`LineStyle::threshold`].
    pub threshold: f32,
}

impl ClassStyle {
    /// What a class has at first.
    pub(super) fn new(class: EdgeClass) -> Self {
        let threshold = match class {
            EdgeClass::Silhouette
            | EdgeClass::Border
            | EdgeClass::Object
            | EdgeClass::Material
            | EdgeClass::Shadow
            | EdgeClass::Section => 0.0,
            EdgeClass::Ridge | EdgeClass::Valley => 30.0,
            EdgeClass::Intersection => 2.0,
            EdgeClass::Texture => 0.15,
            EdgeClass::Relief => 20.0,
        };
        // Materials and details are many in some files, and what they separate has colors of its own.
        let show = (class == EdgeClass::Material || class.is_detail()).then_some(false);
        // Where something is cut, draftsmen draw the heaviest lines.
        let width = (class == EdgeClass::Section).then_some(SECTION_WIDTH);
        Self { show, color: None, opacity: None, width, dashed: None, threshold }
    }

    /// Fills in from the group what is not set.
    pub(super) fn resolve(&self, group: &LineStyle) -> LineStyle {
        LineStyle {
            show: self.show.unwrap_or(group.show),
            color: self.color.unwrap_or(group.color),
            opacity: self.opacity.unwrap_or(group.opacity),
            width: self.width.unwrap_or(group.width),
            dashed: self.dashed.unwrap_or(group.dashed),
            threshold: self.threshold,
        }
    }

    // Long, as it is a list: the place and the entry of each parameter.
    /// Declares the parameters of `class`, whose group has the key `edges.GROUP` and the look `group`.
    pub(super) fn params<'a>(
        &'a mut self,
        class: EdgeClass,
        group_key: &str,
        group: &LineStyle,
        list: &mut Params<'a>,
    ) {
        let from = |name: &str| format!("edges.{group_key}.{name}");
        let (label, help) = words(class);
        let places = LineFields {
            show: StyleField::Inheriting { own: &mut self.show, inherited: group.show, from: from("show") },
            color: StyleField::Inheriting {
                own: &mut self.color,
                inherited: group.color,
                from: from("color"),
            },
            opacity: StyleField::Inheriting {
                own: &mut self.opacity,
                inherited: group.opacity,
                from: from("opacity"),
            },
            width: StyleField::Inheriting {
                own: &mut self.width,
                inherited: group.width,
                from: from("width"),
            },
            dashed: StyleField::Inheriting {
                own: &mut self.dashed,
                inherited: group.dashed,
                from: from("dashed"),
            },
        };
        list.when("edges.mode", EdgeMode::Exact, |list| {
            list.detail(class.into(), |list| {
                places.declare(label, help, list);
                let threshold = &mut self.threshold;
                match class {
                    EdgeClass::Silhouette | EdgeClass::Border | EdgeClass::Object => list.wide_number(
                        "threshold",
                        "Min. depth step",
                        "px",
                        0.0..=100.0,
                        0.0..=1000.0,
                        "Drawn only where what lies behind is at least this much farther away, in widths of a px at the depth of the edge.",
                        threshold,
                    ),
                    EdgeClass::Ridge | EdgeClass::Valley => list.wide_number(
                        "threshold",
                        "Min. angle",
                        "°",
                        0.0..=90.0,
                        0.0..=180.0,
                        "Flatter folds draw nothing, but where they close a gap between sharper parts of the same fold.",
                        threshold,
                    ),
                    EdgeClass::Intersection => list.wide_number(
                        "threshold",
                        "Min. angle",
                        "°",
                        0.0..=90.0,
                        0.0..=180.0,
                        "Surfaces that meet at a smaller angle draw nothing.",
                        threshold,
                    ),
                    EdgeClass::Texture => list.wide_number(
                        "threshold",
                        "Min. contrast",
                        "",
                        0.0..=0.5,
                        0.0..=1.0,
                        "Colors that differ by less draw nothing; 1 is from black to white.",
                        threshold,
                    ),
                    EdgeClass::Relief => list.wide_number(
                        "threshold",
                        "Min. angle",
                        "°",
                        0.0..=90.0,
                        0.0..=180.0,
                        "Flatter steps of the relief draw nothing.",
                        threshold,
                    ),
                    EdgeClass::Material | EdgeClass::Shadow | EdgeClass::Section => {}
                }
            });
        });
    }
}

/// Name and help of a class in the panel.
fn words(class: EdgeClass) -> (&'static str, &'static str) {
    match class {
        EdgeClass::Silhouette => ("Silhouettes", "Draw lines where a surface turns out of sight."),
        EdgeClass::Border => ("Borders", "Draw lines where a surface ends."),
        EdgeClass::Object => ("Object outlines", "Draw the outlines of objects against objects behind them."),
        EdgeClass::Ridge => ("Ridges", "Draw convex creases."),
        EdgeClass::Valley => ("Valleys", "Draw concave creases."),
        EdgeClass::Material => ("Material borders", "Draw lines where two materials of one object meet."),
        EdgeClass::Intersection => ("Intersections", "Draw lines where two surfaces run through each other."),
        EdgeClass::Texture => ("Texture edges", "Draw lines where the color of a surface changes suddenly."),
        EdgeClass::Shadow => {
            ("Shadow borders", "Draw lines where cast shadows end, in drawings with shadows.")
        }
        EdgeClass::Section => ("Section lines", "Draw lines where the section plane cuts a surface."),
        EdgeClass::Relief => ("Relief edges", "Draw lines where a normal map folds the surface."),
    }
}

/// Where the look of a group or class is kept.
pub(super) struct LineFields<'a> {
    pub show: StyleField<'a, bool>,
    pub color: StyleField<'a, Color>,
    pub opacity: StyleField<'a, f32>,
    pub width: StyleField<'a, f32>,
    pub dashed: StyleField<'a, bool>,
}

impl<'a> LineFields<'a> {
    /// Declares the rows that groups and classes share.
    pub(super) fn declare(self, label: &'static str, help: &'static str, list: &mut Params<'a>) {
        list.head("show", label, help, self.show);
        list.color("color", "Color", "Color of these lines.", self.color);
        list.share("opacity", "Opacity", "Opacity of these lines.", self.opacity);
        list.formerly("strength");
        list.when("edges.mode", EdgeMode::Exact, |list| {
            list.wide_number(
                "width",
                "Width",
                "px",
                0.5..=16.0,
                0.25..=64.0,
                "Width of these lines; a picture of any size has 1080 of these pixels in its height.",
                self.width,
            );
            list.switch("dashed", "Dashed", "Draw these lines in dashes.", self.dashed);
        });
    }
}
