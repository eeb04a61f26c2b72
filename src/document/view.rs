//! How the picture is shown, whatever the styles are.

use crate::geometry::CreaseRule;
use crate::geometry::mend::SeamTolerance;
use crate::style::Color;
use crate::style::choice;
use crate::style::param::{Param, Params, StyleField};

/// View settings of a document.
#[derive(Debug, Clone, PartialEq)]
pub struct ViewSettings {
    /// Color of the paper behind everything; `None`: that of the document's style.
    pub background: Option<Color>,
    /// The picture, or one of the buffers it is made from.
    pub show: Show,
    /// Which depth layer of everything visible such a buffer is of; 1: the nearest.
    pub layer: u32,
    /// Dihedral angle above which an edge separates two surfaces; degrees.
    pub crease_angle: f32,
    /// Which of those edges are creases.
    pub creases: CreasesBy,
    /// How far the seams of separately tessellated faces may be apart.
    pub seams: Seams,
    /// The same where it is a number: ‰ of the diagonal of a body.
    pub seam_gap: f32,
    /// Whether parallel views show how long things are.
    pub scale_bar: bool,
    /// How many mirrors in a row a line of sight follows; the nearest whole number counts.
    pub reflections: f32,
    /// How depth layers are made; the picture is the same.
    pub layer_method: LayersBy,
}

choice! {
    /// What the picture shows: the drawing, or an intermediate result for a closer look.
    pub enum Show {
        /// The drawing.
        #[default]
        Picture,
        /// Eye-space shading normals as colors, 0.5 + 0.5 n.
        Normals,
        /// Eye-space face normals as colors.
        FaceNormals,
        /// Linear depth over the range of the enhanced objects: black near, white far.
        Depth,
        /// A color per object.
        Objects,
        /// A color per connected smooth surface.
        Surfaces,
        /// Unlit base color.
        BaseColor,
        /// Normal discontinuities `I_N` (1 = none).
        NormalOperator,
        /// Depth discontinuities `I_Z` by the diagonal operator (1 = none).
        DepthOperator,
        /// Depth discontinuities by the C1 operator, as 1 − C1.
        C1Operator,
        /// The edge map: profile and inner ink, black on white.
        EdgeMap,
        /// Lines where the strokes of hatching run, or would run.
        StrokeDirections,
        /// How much detail hatching gives to each place by indication: white all, black none.
        Detail,
    }
}

/// What the picture may show beside the drawing.
const BUFFERS: [Show; 10] = [
    Show::Normals,
    Show::FaceNormals,
    Show::Depth,
    Show::Objects,
    Show::Surfaces,
    Show::BaseColor,
    Show::NormalOperator,
    Show::DepthOperator,
    Show::C1Operator,
    Show::EdgeMap,
];
choice! {
    /// Which edges above the crease angle are creases.
    pub enum CreasesBy {
        /// Those where the file's own normals part; where it has none, all but short ones that are hardly sharp and meet no others.
        #[default]
        Normals,
        /// All of them.
        Angle,
    }
}

choice! {
    /// How far the two sides of a seam may be apart. CAD programs tessellate each face by itself, and leave cracks between them.
    pub enum Seams {
        /// As the mesh itself says.
        #[default]
        Auto,
        /// Not at all: nothing is mended.
        Exact,
        /// As far as a number says.
        Gap,
    }
}

choice! {
    /// How depth layers are made.
    pub enum LayersBy {
        /// From lists where the device can and there is memory enough, otherwise by peeling.
        #[default]
        Auto,
        /// From lists of all fragments, which one traversal of the scene collects.
        Lists,
        /// By peeling: one traversal of the scene for each layer.
        Peeling,
    }
}

impl Default for ViewSettings {
    fn default() -> Self {
        Self {
            background: None,
            show: Show::Picture,
            layer: 1,
            crease_angle: 30.0,
            creases: CreasesBy::Normals,
            seams: Seams::Auto,
            seam_gap: 1.0,
            scale_bar: false,
            reflections: 2.0,
            layer_method: LayersBy::Auto,
        }
    }
}

/// What decides which edges are creases.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Creases {
    /// Dihedral angle above which an edge may be one, degrees.
    pub angle: f32,
    /// Which of those are.
    pub rule: CreaseRule,
}

impl ViewSettings {
    /// What decides which edges are creases.
    pub fn creases(&self) -> Creases {
        let rule = match self.creases {
            CreasesBy::Normals => CreaseRule::Normals,
            CreasesBy::Angle => CreaseRule::Angle,
        };
        Creases { angle: self.crease_angle, rule }
    }

    /// How far the two sides of a seam may be apart.
    pub fn seam_tolerance(&self) -> SeamTolerance {
        match self.seams {
            Seams::Auto => SeamTolerance::Automatic,
            Seams::Exact => SeamTolerance::Fraction(0.0),
            Seams::Gap => SeamTolerance::Fraction(self.seam_gap * 1e-3),
        }
    }

    /// Every parameter, like [`crate::style::Style::params`]; `paper`: that of the document's style.
    pub fn params(&mut self, paper: Color) -> Vec<Param<'_>> {
        let mut list = Params::default();
        self.declare(paper, &mut list);
        list.finish()
    }

    /// The same with every number in the range of its parameter, however it was set.
    #[must_use]
    pub fn clamped(&self) -> Self {
        let mut clamped = self.clone();
        clamped.declare(Color::default(), &mut Params::clamping());
        clamped
    }

    fn declare<'a>(&'a mut self, paper: Color, list: &mut Params<'a>) {
        list.section("view", |list| {
            list.color(
                "background",
                "Background",
                "Color of the paper behind everything.",
                StyleField::Inheriting {
                    own: &mut self.background,
                    inherited: paper,
                    from: "paper".to_owned(),
                },
            );
            list.wide_number(
                "crease_angle",
                "Crease angle",
                "°",
                5.0..=90.0,
                0.0..=180.0,
                "Folds sharper than this separate smooth surfaces, drawn or not; in files without normals they are hard (after a reload).",
                &mut self.crease_angle,
            );
            list.choice(
                "creases",
                "Creases from",
                "Which folds are creases: those where the file's own normals part, and without normals all but stray ones; or all that are sharp enough.",
                &mut self.creases,
            );
            list.choice(
                "seams",
                "Mend seams",
                "Closes cracks between separately made faces, as CAD programs leave them: auto as wide as the mesh suggests, gap up to a width; exact mends nothing.",
                &mut self.seams,
            );
            list.when("view.seams", Seams::Gap, |list| {
                list.wide_number(
                    "seam_gap",
                    "Seam width",
                    "‰",
                    0.0..=2.0,
                    0.0..=5.0,
                    "How far a vertex may move to the middle of a crack, in thousandths of the body's diagonal.",
                    &mut self.seam_gap,
                );
            });
            list.wide_number(
                "reflections",
                "Reflections",
                "",
                0.0..=4.0,
                0.0..=8.0,
                "How many mirrors in a row are followed: 1 shows no mirror in a mirror, 0 switches mirrors off.",
                &mut self.reflections,
            );
            list.choice(
                "layer_method",
                "Depth layers",
                "How depth layers are made, of blueprints, hidden lines and glass: from lists of fragments, which is faster but takes memory, or by peeling.",
                &mut self.layer_method,
            );
            list.formerly("layers");
            list.switch(
                "scale_bar",
                "Scale bar",
                "Shows how long things are; in parallel projection only.",
                &mut self.scale_bar,
            );
            list.choice("show", "Show", "The picture, or a buffer that it is made from.", &mut self.show);
            list.when_any("view.show", BUFFERS, |list| {
                list.integer(
                    "layer",
                    "Layer",
                    "",
                    1..=64,
                    "Which depth layer the buffer is of: 1 is what is visible, 2 what lies behind it, and so on.",
                    &mut self.layer,
                );
            });
        });
    }
}
