//! A look at the buffers that the picture is made from.

use super::gbuffer::GBuffer;
use super::resolve::FINAL;
use crate::document::Show;
use crate::gpu::{Program, Recorder, Target, inputs};
use crate::render::RenderError;

/// Draws one buffer as the final image.
///
/// # Errors
/// [`RenderError`].
pub fn show(
    rec: &mut Recorder<'_>,
    what: Show,
    gbuffer: &GBuffer,
    edge_map: &Target,
    operators: &Target,
) -> Result<Target, RenderError> {
    let entry_point = match what {
        Show::Picture | Show::EdgeMap => "fs_edge_map",
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
        region_tex: &gbuffer.region,
        base_color_tex: &gbuffer.base_color,
        edge_map_tex: edge_map,
        operators_tex: operators,
    };
    rec.fullscreen("show", Program::new("passes/show.wgsl", entry_point), &inputs, &[&image], None)?;
    Ok(image)
}
