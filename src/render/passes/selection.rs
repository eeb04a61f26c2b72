//! The outline around selected objects, as a picture of its own that the window lays over the drawing.

use super::front::Front;
use super::resolve::FINAL;
use crate::gpu::{ArrayBuffer, Gpu, Program, Recorder, Target, inputs};
use crate::render::base::error::RenderError;
use crate::render::base::ids::object_id;
use crate::render::base::sample::Sample;
use crate::render::base::stage::Stage;
use crate::scene::{NodeId, Scene};

/// The outline across frames.
pub struct SelectionOutline {
    bits: ArrayBuffer,
    /// The geometry of the picture's first sample: outlines do not follow the jitter.
    unmoved: Vec<u64>,
    stage: Stage<(Vec<u64>, Vec<u32>), Target>,
}

impl SelectionOutline {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self { bits: ArrayBuffer::new(gpu, "selected"), unmoved: Vec::new(), stage: Stage::default() }
    }

    /// The outline of what is selected in front, of which `revisions` change when it does; `None`: nothing is.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn run(
        &mut self,
        rec: &mut Recorder<'_>,
        front: &Front,
        revisions: Vec<u64>,
        selected: &[NodeId],
        scene: &Scene,
        sample: Sample,
    ) -> Result<Option<Target>, RenderError> {
        if selected.is_empty() {
            self.stage.clear();
            return Ok(None);
        }
        if sample.index == 0 {
            self.unmoved = revisions;
        }
        let Self { bits: buffer, unmoved, stage } = self;
        let found = stage.run((unmoved.clone(), bits(selected, scene)), |(_, bits)| {
            buffer.write(rec.gpu, bits);
            let front = front.nearest(rec)?;
            outline(rec, &front, buffer)
        })?;
        Ok(Some(found.value))
    }
}

/// One bit per object id, as the shader reads it; what belongs to a selected node is selected with it.
fn bits(selected: &[NodeId], scene: &Scene) -> Vec<u32> {
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
fn outline(rec: &mut Recorder<'_>, geometry: &Target, selected: &ArrayBuffer) -> Result<Target, RenderError> {
    let out = rec.target("selection", FINAL)?;
    let inputs = inputs! { geometry_tex: geometry, selected: selected };
    rec.fullscreen("selection", Program::new("passes/selection.wgsl", "fs_main"), &inputs, &[&out], None)?;
    Ok(out)
}
