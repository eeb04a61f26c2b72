//! Lines with their width and colour, over the shaded surfaces.

use super::edge_map::EdgeMap;
use super::edge_style::EdgeUniform;
use super::gbuffer::GBuffer;
use super::line_distance::Reach;
use crate::gpu::recorder::{Draw, Input, Onto};
use crate::gpu::{DepthRule, Program, Recorder, Target};
use crate::render::RenderError;

/// Draws the lines of an edge map over `color` (linear, premultiplied). `reach` is needed where any object is
/// drawn in exact mode.
///
/// # Errors
/// [`RenderError`].
pub fn lines(
    rec: &mut Recorder<'_>,
    gbuffer: &GBuffer,
    edge_map: &EdgeMap,
    reach: Option<&Reach>,
    styles: &[EdgeUniform],
    edge_styles: &wgpu::Buffer,
    color: &Target,
) -> Result<(), RenderError> {
    let (farthest, nearest) = match reach {
        Some(Reach::Narrow(spines)) => (spines, spines),
        Some(Reach::Wide { farthest, nearest }) => (farthest, nearest.as_ref().unwrap_or(farthest)),
        // Unread: any texture of its kind.
        None => (&edge_map.edges, &edge_map.edges),
    };
    let any = |has: fn(&EdgeUniform) -> bool| styles.iter().any(has);
    let program = |entry_point| Program {
        file: "passes/lines.wgsl",
        entry_point,
        switches: vec![
            ("WITH_PAPER", any(EdgeUniform::is_paper)),
            ("WITH_EXACT", reach.is_some()),
            ("WITH_WIDTHS", matches!(reach, Some(Reach::Wide { nearest: Some(_), .. }))),
            ("NARROW", matches!(reach, Some(Reach::Narrow(_)))),
            ("WITH_DASHES", any(|s| s.drawn().any(|(_, l)| l.dashed == 1))),
            ("WITH_SURFACE_COLOR", any(|s| s.is_exact() && s.surface_color > 0.0)),
        ],
    };
    let inputs = [
        Input::Texture(&gbuffer.geometry),
        Input::Texture(&edge_map.edges),
        Input::Texture(&gbuffer.base_color),
        Input::Texture(farthest),
        Input::Texture(nearest),
        Input::Storage(edge_styles),
    ];
    let reached = rec.target("reached by lines", wgpu::TextureFormat::Depth32Float)?;
    rec.draw(Draw {
        label: "reached by lines",
        program: program("fs_reached"),
        inputs: &inputs,
        outputs: &[],
        onto: Onto::Nothing,
        depth: Some((&reached, DepthRule::Mark)),
        lines: None,
    })?;
    rec.draw(Draw {
        label: "lines",
        program: program("fs_main"),
        inputs: &inputs,
        outputs: &[color],
        onto: Onto::Blended,
        depth: Some((&reached, DepthRule::Marked)),
        lines: None,
    })?;
    Ok(())
}
