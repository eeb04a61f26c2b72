//! The outline around selected objects, as a picture of its own that the window lays over the drawing.

use super::resolve::FINAL;
use crate::gpu::recorder::Input;
use crate::gpu::{Program, Recorder, Target};
use crate::render::RenderError;
use crate::render::groups::object_id;
use crate::scene::NodeId;

/// One bit per object id, as the shader reads it.
pub fn bits(selected: &[NodeId], node_count: usize) -> Vec<u32> {
    let mut bits = vec![0u32; (node_count + 1).div_ceil(32)];
    for &node in selected {
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
    let inputs = [Input::Texture(geometry), Input::Storage(selected)];
    rec.fullscreen("selection", Program::new("passes/selection.wgsl", "fs_main"), &inputs, &[&out], None)?;
    Ok(out)
}
