//! Lines with their width and color, over the shaded surfaces.

use super::edge_map::EdgeMap;
use super::gbuffer::GBuffer;
use super::line_distance::LineDistance;
use crate::gpu::inputs::NOTHING;
use crate::gpu::recorder::{Draw, Onto};
use crate::gpu::{DepthRule, Inputs, Program, Recorder, STENCIL, Target, inputs};
use crate::render::base::edge_style::GpuEdgeStyle;
use crate::render::base::edge_styles::EdgeStylesBuffer;
use crate::render::base::error::RenderError;

/// The lines of an edge map.
#[derive(Clone, Copy)]
pub struct Lines<'a> {
    /// What the edge map was made of.
    pub gbuffer: &'a GBuffer,
    /// Where lines run.
    pub edge_map: &'a EdgeMap,
    /// Which line reaches each pixel; needed where any object is drawn in exact mode.
    pub line_distance: Option<&'a LineDistance>,
    /// The edge styles of its objects.
    pub styles: &'a [GpuEdgeStyle],
    /// The same on the device.
    pub edge_styles: &'a EdgeStylesBuffer,
}

/// What draws lines: a shader that imports `passes/lines.wgsl`.
#[derive(Clone, Copy)]
pub struct LineShader<'a> {
    /// File below `shaders/`.
    pub file: &'static str,
    /// Its entry point.
    pub entry_point: &'static str,
    /// What it reads more than `passes/lines.wgsl`.
    pub inputs: &'a Inputs<'a>,
    /// Switches of its own.
    pub switches: &'a [(&'static str, bool)],
    /// Where ink goes.
    pub onto: Onto,
}

impl LineShader<'_> {
    /// Lines in the colors of their styles, over everything.
    pub const PLAIN: Self = Self {
        file: "passes/lines.wgsl",
        entry_point: "fs_main",
        inputs: &NOTHING,
        switches: &[("ON_SURFACES", true)],
        onto: Onto::Over,
    };
}

impl<'a> Lines<'a> {
    /// What `passes/lines.wgsl` reads of them.
    pub fn inputs(&self) -> Inputs<'a> {
        let Lines { gbuffer, edge_map, line_distance, edge_styles, .. } = *self;
        let (farthest, nearest) = match line_distance {
            Some(LineDistance::Narrow { spines, near, .. }) => (Some(spines), Some(near)),
            Some(LineDistance::Wide { farthest, nearest }) => (Some(farthest), nearest.as_ref()),
            None => (None, None),
        };
        inputs! {
            geometry_tex: &gbuffer.geometry,
            edge_map_tex: &edge_map.edges,
            base_color_tex: &gbuffer.base_color,
            spine_tex: edge_map.spines.as_ref(),
            farthest_tex: farthest,
            nearest_tex: nearest,
            // Lines that have been moved have some.
            source_tex: None::<&Target>,
        }
        .and(&edge_styles.inputs())
    }

    /// Its switches.
    pub fn switches(&self) -> Vec<(&'static str, bool)> {
        let any = |has: fn(&GpuEdgeStyle) -> bool| self.styles.iter().any(has);
        vec![
            ("WITH_OPERATORS", any(GpuEdgeStyle::is_image_space)),
            ("WITH_EXACT", self.line_distance.is_some()),
            ("WITH_WIDTHS", matches!(self.line_distance, Some(LineDistance::Wide { nearest: Some(_), .. }))),
            ("NARROW", matches!(self.line_distance, Some(LineDistance::Narrow { .. }))),
            ("NARROW_BY_TWO", matches!(self.line_distance, Some(LineDistance::Narrow { by_two: true, .. }))),
            ("WITH_DASHES", any(|s| s.drawn().any(|(_, l)| l.dashed == 1))),
            ("WITH_OBJECT_COLOR", any(GpuEdgeStyle::takes_object_color)),
        ]
    }
}

/// Draws lines onto `color` (linear, premultiplied).
///
/// # Errors
/// [`RenderError`].
pub fn lines(
    rec: &mut Recorder<'_>,
    lines: &Lines<'_>,
    shader: &LineShader<'_>,
    color: &Target,
) -> Result<(), RenderError> {
    let covered = rec.target("covered by lines", STENCIL)?;
    let switches = [&lines.switches()[..], shader.switches].concat();
    rec.draw(Draw {
        label: "lines",
        program: Program { file: shader.file, entry_point: shader.entry_point, switches },
        inputs: &lines.inputs().and(shader.inputs),
        outputs: &[color],
        onto: shader.onto,
        depth: Some((&covered, DepthRule::Where("fs_covered"))),
    })?;
    Ok(())
}
