//! One picture over another.

use crate::gpu::recorder::{Draw, Onto};
use crate::gpu::{Program, Recorder, Target, inputs};
use crate::render::base::error::RenderError;

/// Lays a picture over `color`; both are linear and premultiplied.
///
/// # Errors
/// [`RenderError`].
pub fn overlay(rec: &mut Recorder<'_>, picture: &Target, color: &Target) -> Result<(), RenderError> {
    rec.draw(Draw {
        label: "overlay",
        program: Program::new("passes/overlay.wgsl", "fs_main"),
        inputs: &inputs! { overlay_tex: picture },
        outputs: &[color],
        onto: Onto::Over,
        depth: None,
    })?;
    Ok(())
}
