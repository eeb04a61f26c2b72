//! The papers' operators: ink per pixel, and whose it is (edge-enhancement paper, section 4.1.2; hatching paper, section 3,
//! "Outline").

use super::gbuffer::GBuffer;
use crate::gpu::recorder::{Draw, Onto};
use crate::gpu::{DepthRule, Program, Recorder, Target, inputs};
use crate::render::base::edge_style::GpuEdgeStyle;
use crate::render::base::edge_styles::EdgeStylesBuffer;
use crate::render::base::error::RenderError;

fn program(entry_point: &'static str, styles: &[GpuEdgeStyle]) -> Program {
    let any = |has: fn(&GpuEdgeStyle) -> bool| styles.iter().any(has);
    let switches = vec![
        ("WITH_C1", entry_point == VALUES || any(GpuEdgeStyle::is_c1)),
        ("WITH_SOBEL", any(GpuEdgeStyle::is_sobel)),
        ("WITH_COLOR", any(GpuEdgeStyle::is_image_space_with_color)),
    ];
    Program { file: "passes/operators.wgsl", entry_point, switches }
}

/// The entry point that tells the operators' own values.
const VALUES: &str = "fs_operators";

/// Adds the ink of the objects that are drawn in image-space mode to the edge map.
///
/// # Errors
/// [`RenderError`].
pub fn operator_edges(
    rec: &mut Recorder<'_>,
    gbuffer: &GBuffer,
    styles: &[GpuEdgeStyle],
    edge_styles: &EdgeStylesBuffer,
    edge_map: &Target,
    onto: Onto,
) -> Result<(), RenderError> {
    rec.draw(Draw {
        label: "operators",
        program: program("fs_main", styles),
        inputs: &inputs! { geometry_tex: &gbuffer.geometry, base_color_tex: &gbuffer.base_color }
            .and(&edge_styles.inputs()),
        outputs: &[edge_map],
        onto,
        depth: Some((&gbuffer.depth, DepthRule::Covered)),
    })?;
    Ok(())
}

/// The operators' own values per pixel: `I_N`, `I_Z`, C1 (no edge: 1, 1, 0).
///
/// # Errors
/// [`RenderError`].
pub fn operators(
    rec: &mut Recorder<'_>,
    gbuffer: &GBuffer,
    edge_styles: &EdgeStylesBuffer,
) -> Result<Target, RenderError> {
    let out = rec.target("operators", wgpu::TextureFormat::Rgba32Float)?;
    let inputs = inputs! { geometry_tex: &gbuffer.geometry }.and(&edge_styles.inputs());
    rec.fullscreen("operators", program(VALUES, &[]), &inputs, &[&out], None)?;
    Ok(out)
}
