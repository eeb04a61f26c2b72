//! A look at the buffers that the picture is made from.

use super::gbuffer::GBuffer;
use super::resolve::FINAL;
use crate::document::Show;
use crate::gpu::{Program, Recorder, Target, inputs};
use crate::render::base::error::RenderError;

/// The buffers that can be looked at.
#[derive(Clone, Copy)]
pub struct Shown<'a> {
    /// Per-pixel geometry.
    pub gbuffer: &'a GBuffer,
    /// Its edge map.
    pub edge_map: &'a Target,
    /// The operators' values, where one of them is looked at.
    pub operators: Option<&'a Target>,
}

/// Draws one buffer as the final image.
///
/// # Errors
/// [`RenderError`].
pub fn show(rec: &mut Recorder<'_>, what: Show, shown: Shown<'_>) -> Result<Target, RenderError> {
    let Shown { gbuffer, edge_map, operators } = shown;
    let entry_point = match what {
        Show::Picture | Show::EdgeMap | Show::StrokeDirections | Show::Detail => "fs_edge_map",
        Show::Normals => "fs_normals",
        Show::FaceNormals => "fs_face_normals",
        Show::Depth => "fs_depth",
        Show::Objects => "fs_objects",
        Show::Surfaces => "fs_surfaces",
        Show::BaseColor => "fs_base_color",
        Show::NormalOperator => "fs_normal_operator",
        Show::DepthOperator => "fs_depth_operator",
        Show::C1Operator => "fs_c1_operator",
    };
    let image = rec.target("final image", FINAL)?;
    let inputs = inputs! {
        geometry_tex: &gbuffer.geometry,
        surface_id_tex: &gbuffer.surface_id,
        base_color_tex: &gbuffer.base_color,
        edge_map_tex: edge_map,
        operators_tex: operators,
    };
    rec.fullscreen("show", Program::new("passes/show.wgsl", entry_point), &inputs, &[&image], None)?;
    Ok(image)
}
