//! Pieces of lines that are too short to tell anything, and that nothing continues.

use super::edge_map::EdgeMap;
use super::gbuffer::GBuffer;
use super::repeated::SPINES;
use crate::gpu::recorder::{Draw, Onto};
use crate::gpu::{DepthRule, Program, Recorder, STENCIL, inputs};
use crate::render::base::edge_style::EdgeUniform;
use crate::render::base::error::RenderError;

/// Leaves them out of an edge map of opaque surfaces. (Of layers, what is a piece in one may go on in the next.)
///
/// # Errors
/// [`RenderError`].
pub fn without_dots(
    rec: &mut Recorder<'_>,
    edge_map: EdgeMap,
    gbuffer: &GBuffer,
    styles: &[EdgeUniform],
    edge_styles: &wgpu::Buffer,
) -> Result<EdgeMap, RenderError> {
    let Some(spines) = edge_map.spines.as_ref() else { return Ok(edge_map) };
    if !styles.iter().any(|s| s.is_exact() && s.shortest > 0.0) {
        return Ok(edge_map);
    }
    let kept = rec.target("spines without dots", SPINES)?;
    let pixels = rec.target("pixels of lines", STENCIL)?;
    rec.draw(Draw {
        label: "dots",
        program: Program::new("passes/dots.wgsl", "fs_main"),
        inputs: &inputs! {
            spine_tex: spines,
            edge_map_tex: &edge_map.edges,
            geometry_tex: &gbuffer.geometry,
            edge_styles: edge_styles,
        },
        outputs: &[&kept],
        onto: Onto::Clear,
        depth: Some((&pixels, DepthRule::Where("fs_lines"))),
    })?;
    Ok(EdgeMap { spines: Some(kept), ..edge_map })
}
