//! Lines: how edges are found (edge-enhancement paper, sections 3 and 4, or exactly) and how they are drawn.

use super::edge_group::{EdgeGroup, Inner, Profile};
use super::edge_line::{ClassStyle, LineStyle};
use super::edge_mode::{Alignment, EdgeMode, EdgeOperator};
use super::hidden::Hidden;
use super::param::Params;
use crate::geometry::EdgeClass;

/// How edges are found and drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Edges {
    /// How edges are found.
    pub mode: EdgeMode,
    /// Where the width of profile edges lies; inner edges are centered. Exact mode.
    pub alignment: Alignment,
    /// Shorter pieces of lines that nothing continues are left out, in reference pixels; 0: none. Exact mode.
    pub min_length: f32,
    /// The operator that finds depth discontinuities. Image-space mode.
    pub operator: EdgeOperator,
    /// What Sobel operators look at. Image-space mode.
    pub sobel: Sobel,
    /// Profile edges: silhouettes, borders, the outlines of objects and of sections.
    pub profile: EdgeGroup<Profile>,
    /// Inner edges: creases, borders of materials, intersections.
    pub inner: EdgeGroup<Inner>,
    /// What each class has of its own, in the order of [`EdgeClass::ALL`]. Exact mode.
    classes: [ClassStyle; EdgeClass::ALL.len()],
    /// Dashes of the lines that have them. Exact mode.
    pub dash: Dash,
    /// Share of the surface's color in the lines; 0: the constant color, 1: the surface's own. Exact mode.
    pub object_color: f32,
    /// How much the surface's color is darkened in lines; 0: not, 1: black. Exact mode.
    pub darken: f32,
    /// What makes lines thinner. Exact mode.
    pub variation: Variation,
    /// How the width changes along a line. Exact mode.
    pub pressure: Pressure,
    /// Lines behind other surfaces.
    pub hidden: Hidden,
}

/// Dashes, in reference pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dash {
    /// Length of a dash.
    pub length: f32,
    /// Length of the gap behind it.
    pub gap: f32,
}

/// What Sobel operators look at. Where the gradient of an image reaches a threshold there is an edge, elsewhere none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sobel {
    /// Profile edges where the z of the normals around a pixel differs in sign, the background's being negative.
    pub silhouettes: bool,
    /// Inner edges by normals.
    pub normals: bool,
    /// Gradient of unit normals.
    pub normal_threshold: f32,
    /// Profile edges by depth.
    pub depth: bool,
    /// Gradient of depth, of which 1 is the range of the enhanced objects.
    pub depth_threshold: f32,
    /// Inner edges by base colors.
    pub color: bool,
    /// Gradient of the luminance.
    pub color_threshold: f32,
    /// Whether the gradient is the sum of the changes in both directions instead of the length of both.
    pub sum: bool,
}

impl Default for Sobel {
    fn default() -> Self {
        Self {
            silhouettes: true,
            normals: true,
            // A fold of 20° gives 4 · 2 sin 10°.
            normal_threshold: 1.4,
            depth: true,
            depth_threshold: 0.15,
            color: true,
            color_threshold: 0.6,
            sum: false,
        }
    }
}

/// What makes lines thinner; each 0 (nothing) to 1.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Variation {
    /// Distance from the eye.
    pub distance: f32,
    /// Light on the surface.
    pub light: f32,
}

/// How the width changes along a line, as under a hand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pressure {
    /// How much.
    pub amount: f32,
    /// Length of the changes in reference pixels.
    pub scale: f32,
}

impl Default for Edges {
    fn default() -> Self {
        Self {
            mode: EdgeMode::default(),
            alignment: Alignment::default(),
            min_length: 4.0,
            operator: EdgeOperator::default(),
            sobel: Sobel::default(),
            profile: EdgeGroup::default(),
            inner: EdgeGroup::default(),
            classes: EdgeClass::ALL.map(ClassStyle::new),
            dash: Dash { length: 12.0, gap: 6.0 },
            object_color: 0.0,
            darken: 0.6,
            variation: Variation::default(),
            pressure: Pressure { amount: 0.0, scale: 60.0 },
            hidden: Hidden::default(),
        }
    }
}

impl Edges {
    /// The look of a class: what it has of its own, the rest from its group.
    pub fn line(&self, class: EdgeClass) -> LineStyle {
        let group = if class.is_profile() { self.profile.line() } else { self.inner.line() };
        self.class(class).resolve(&group)
    }

    /// What a class has of its own.
    pub fn class(&self, class: EdgeClass) -> &ClassStyle {
        &self.classes[class as usize]
    }

    /// What a class has of its own, to be changed.
    pub fn class_mut(&mut self, class: EdgeClass) -> &mut ClassStyle {
        &mut self.classes[class as usize]
    }

    pub(super) fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        let (profile, inner) = (self.profile.line(), self.inner.line());
        let (profile_classes, inner_classes): (Vec<_>, Vec<_>) =
            EdgeClass::ALL.into_iter().zip(&mut self.classes).partition(|(class, _)| class.is_profile());

        list.choice(
            "mode",
            "Mode",
            "How edges are found: exactly, from the model, or in image space, by operators on the picture.",
            &mut self.mode,
        );
        list.former_value("paper", EdgeMode::ImageSpace);
        list.when("edges.mode", EdgeMode::ImageSpace, |list| {
            list.choice(
                "operator",
                "Operator",
                "How discontinuities are found: two diagonal pairs, eight neighbors (C1), or Sobel operators.",
                &mut self.operator,
            );
            list.when("edges.operator", EdgeOperator::Sobel, |list| {
                list.detail("sobel", |list| self.sobel.params(list));
            });
        });
        list.when("edges.mode", EdgeMode::Exact, |list| {
            list.choice(
                "alignment",
                "Alignment",
                "Where the width of profile edges lies: half on either side, outside of the object, or on it.",
                &mut self.alignment,
            );
            list.wide_number(
                "min_length",
                "Min. length",
                "px",
                0.0..=12.0,
                0.0..=32.0,
                "Shorter pieces of lines that nothing continues are left out; 0 draws all.",
                &mut self.min_length,
            );
            list.formerly("shortest");
            let help = "Share of the surface's own color in the lines; 0 leaves the colors below.";
            list.share("object_color", "Object color", help, &mut self.object_color);
            list.formerly("surface_color");
            let help = "How much darker than the surface its color is in the lines.";
            list.share("darken", "Darken color", help, &mut self.darken);
        });
        list.section("profile", |list| self.profile.params(list));
        for (class, style) in profile_classes {
            style.params(class, "profile", &profile, list);
        }
        list.section("inner", |list| self.inner.params(list));
        for (class, style) in inner_classes {
            style.params(class, "inner", &inner, list);
        }
        list.when("edges.mode", EdgeMode::Exact, |list| {
            list.detail("dash", |list| self.dash.params(list));
            list.detail("variation", |list| self.variation.params(list));
            list.detail("pressure", |list| self.pressure.params(list));
        });
        list.section("hidden", |list| self.hidden.params(list));
    }
}

impl Dash {
    fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        let (soft, hard) = (1.0..=64.0, 1.0..=512.0);
        list.wide_number(
            "length",
            "Length",
            "px",
            soft.clone(),
            hard.clone(),
            "Length of a dash.",
            &mut self.length,
        );
        list.wide_number("gap", "Gap", "px", soft, hard, "Length of the gap behind a dash.", &mut self.gap);
    }
}

impl Sobel {
    fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        let number = |list: &mut Params<'a>, key, label, most, help, value: &'a mut f32| {
            list.wide_number(key, label, "", 0.01..=most, 0.001..=8.0, help, value);
        };
        list.switch(
            "silhouettes",
            "Silhouettes",
            "Profile edges where normals turn away, and against the background.",
            &mut self.silhouettes,
        );
        list.switch("normals", "Normals", "Inner edges where normals change.", &mut self.normals);
        let help = "Gradient of normals that makes an edge; 1.4 is a fold of 20°.";
        number(list, "normal_threshold", "Normals above", 4.0, help, &mut self.normal_threshold);
        list.switch("depth", "Depth", "Profile edges where depth changes.", &mut self.depth);
        let help = "Gradient of depth that makes an edge; a step through the whole range gives 4.";
        number(list, "depth_threshold", "Depth above", 2.0, help, &mut self.depth_threshold);
        list.switch("color", "Color", "Inner edges where the object's own color changes.", &mut self.color);
        let help = "Gradient of brightness that makes an edge; a step from black to white gives 4.";
        number(list, "color_threshold", "Color above", 2.0, help, &mut self.color_threshold);
        list.switch(
            "sum",
            "L1 gradient",
            "Adds the changes in both directions instead of taking the length of both.",
            &mut self.sum,
        );
    }
}

impl Variation {
    fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        list.share("distance", "By distance", "How much thinner far lines are.", &mut self.distance);
        let help = "How much thinner lines are on the side that faces the light.";
        list.share("light", "By light", help, &mut self.light);
    }
}

impl Pressure {
    fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        list.share(
            "amount",
            "Amount",
            "How much the width changes along a line, as under a hand.",
            &mut self.amount,
        );
        list.wide_number(
            "scale",
            "Scale",
            "px",
            8.0..=400.0,
            4.0..=2000.0,
            "How long a change of the width is.",
            &mut self.scale,
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::style::Color;

    #[test]
    fn a_class_is_as_its_group_until_it_is_set() {
        let mut edges = Edges::default();
        for class in EdgeClass::ALL {
            let (group, width) =
                if class.is_profile() { (edges.profile.line(), 2.5) } else { (edges.inner.line(), 2.2) };
            let line = edges.line(class);
            let width = if class == EdgeClass::Section { 4.0 } else { width };
            assert_eq!((line.color, line.opacity, line.width), (group.color, 1.0, width), "{class:?}");
            assert_eq!(line.show, class != EdgeClass::Material && !class.is_detail());
        }
        edges.inner.color = Color::WHITE;
        edges.inner.width = 1.0;
        edges.class_mut(EdgeClass::Valley).width = Some(3.0);
        edges.class_mut(EdgeClass::Valley).dashed = Some(true);
        let (ridge, valley) = (edges.line(EdgeClass::Ridge), edges.line(EdgeClass::Valley));
        assert_eq!((ridge.width, ridge.dashed, ridge.color), (1.0, false, Color::WHITE));
        assert_eq!((valley.width, valley.dashed, valley.color), (3.0, true, Color::WHITE));
        assert_eq!(edges.line(EdgeClass::Silhouette), edges.profile.line());
        assert_eq!((valley.threshold, edges.line(EdgeClass::Intersection).threshold), (30.0, 2.0));
    }
}
