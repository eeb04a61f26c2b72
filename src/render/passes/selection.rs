//! The outline around selected objects, as a picture of its own that the window lays over the drawing.

use super::resolve::FINAL;
use crate::gpu::{Program, Recorder, Target, inputs};
use crate::render::RenderError;
use crate::render::groups::object_id;
use crate::scene::{NodeId, Scene};

/// One bit per object id, as the shader reads it; what belongs to a selected node is selected with it.
pub fn bits(selected: &[NodeId], scene: &Scene) -> Vec<u32> {
    let mut bits = vec![0u32; (scene.nodes.len() + 1).div_ceil(32)];
    let added =
        (scene.own_nodes().len()..scene.nodes.len()).filter(|n| selected.contains(&scene.meant_by(*n)));
    for node in selected.iter().copied().chain(added) {
        let id = object_id(node);
        if let Some(word) = bits.get_mut(id as usize / 32) {
            *word |= 1 << (id % 32);
        }
    }
    bits
}

/// Draws the outline, transparent elsewhere.
///
/// # Errors
/// [`RenderError`].
pub fn selection(
    rec: &mut Recorder<'_>,
    geometry: &Target,
    selected: &wgpu::Buffer,
) -> Result<Target, RenderError> {
    let out = rec.target("selection", FINAL)?;
    let inputs = inputs! { geometry_tex: geometry, selected: selected };
    rec.fullscreen("selection", Program::new("passes/selection.wgsl", "fs_main"), &inputs, &[&out], None)?;
    Ok(out)
}
