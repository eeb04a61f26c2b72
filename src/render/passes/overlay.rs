//! One picture over another.

use crate::gpu::recorder::{Draw, Input, Onto};
use crate::gpu::{Program, Recorder, Target};
use crate::render::RenderError;

/// Lays a picture over `color`; both are linear and premultiplied.
///
/// # Errors
/// [`RenderError`].
pub fn overlay(rec: &mut Recorder<'_>, picture: &Target, color: &Target) -> Result<(), RenderError> {
    rec.draw(Draw {
        label: "overlay",
        program: Program::new("passes/overlay.wgsl", "fs_main"),
        inputs: &[Input::Texture(picture)],
        outputs: &[color],
        onto: Onto::Blended,
        depth: None,
    })?;
    Ok(())
}
