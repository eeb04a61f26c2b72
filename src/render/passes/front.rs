//! What is in front of all: opaque surfaces, and the first layers of blueprints before them. It is what a click means and
//! what an outline is drawn around.

use crate::gpu::recorder::Input;
use crate::gpu::{Program, Recorder, Target};
use crate::render::RenderError;

/// The nearest at each pixel of some geometries (see `shaders/common/gbuffer.wgsl`).
///
/// # Errors
/// [`RenderError`].
pub fn front(rec: &mut Recorder<'_>, surfaces: &Target, layers: &[Target]) -> Result<Target, RenderError> {
    let mut nearest = surfaces.clone();
    for layer in layers {
        let both = rec.target("front", nearest.format())?;
        let inputs = [Input::Texture(&nearest), Input::Texture(layer)];
        rec.fullscreen("front", Program::new("passes/front.wgsl", "fs_main"), &inputs, &[&both], None)?;
        nearest = both;
    }
    Ok(nearest)
}
