//! How the surfaces of a sketch are filled.

use super::pass::MAX_OFFSET;
use super::wander::wave_param;
use crate::style::param::Params;
use crate::style::slot::choice;
use crate::style::{Color, Matrix};

/// How surfaces are filled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fill {
    /// Whether they are; otherwise they are paper.
    pub show: bool,
    /// From noise to offsets, reference pixels.
    pub matrix: Matrix,
    /// Length of a wave, reference pixels.
    pub wave: f32,
    /// Opacity of the pigment.
    pub opacity: f32,
    /// What is rubbed on more densely.
    pub tone: Tone,
    /// Color of the pigment.
    pub color: Color,
    /// Share of the surface's own color in it.
    pub object_color: f32,
    /// How visible the strokes of the hand are.
    pub strokes: f32,
    /// Width of a stroke, reference pixels.
    pub stroke_width: f32,
    /// Direction of the strokes, degrees.
    pub angle: f32,
}

choice! {
    /// What is rubbed on more densely.
    pub enum Tone {
        /// Nothing: all of the surface alike.
        #[default]
        Flat,
        /// What is dark.
        Darkness,
    }
}

impl Default for Fill {
    fn default() -> Self {
        Self {
            show: true,
            matrix: Matrix([[1.5, -5.0], [5.0, 1.5]]),
            wave: 240.0,
            opacity: 1.0,
            tone: Tone::default(),
            color: Color([40, 40, 44]),
            object_color: 1.0,
            strokes: 0.0,
            stroke_width: 7.0,
            angle: -40.0,
        }
    }
}

impl Fill {
    pub(super) fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        list.head("show", "Fill", "Surfaces are filled; otherwise they are paper.", &mut self.show);
        list.when("sketch.fill.show", "true", |list| {
            list.matrix(
                "matrix",
                "Offsets",
                "px",
                MAX_OFFSET,
                "How far color goes: each row times two noises, whose mean square is 1, is an offset, to the right and down.",
                &mut self.matrix,
            );
            wave_param(list, &mut self.wave);
            list.share("opacity", "Opacity", "Opacity of the pigment.", &mut self.opacity);
            list.formerly("density");
            list.choice(
                "tone",
                "Tone",
                "Whether all of a surface is filled alike, or the more the darker it is.",
                &mut self.tone,
            );
            list.color("color", "Pigment", "Color of the pigment.", &mut self.color);
            list.share(
                "object_color",
                "Object color",
                "Share of the surface's own color in the pigment.",
                &mut self.object_color,
            );
            list.formerly("surface_color");
            list.share("strokes", "Strokes", "How visible the strokes of the hand are.", &mut self.strokes);
            list.wide_number(
                "stroke_width",
                "Stroke width",
                "px",
                2.0..=24.0,
                1.0..=64.0,
                "Width of a stroke of the hand.",
                &mut self.stroke_width,
            );
            list.wide_number(
                "angle",
                "Angle",
                "°",
                -90.0..=90.0,
                -180.0..=180.0,
                "Direction of the strokes.",
                &mut self.angle,
            );
        });
    }
}
