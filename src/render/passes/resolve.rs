//! The final image.

use crate::gpu::recorder::Input;
use crate::gpu::{Program, Recorder, Target};
use crate::render::RenderError;

/// What the window, PNG files and tests see: sRGB with straight alpha.
pub const FINAL: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Lays the drawing over the paper and applies the sRGB curve.
///
/// # Errors
/// [`RenderError`].
pub fn resolve(rec: &mut Recorder<'_>, color: &Target) -> Result<Target, RenderError> {
    let image = rec.target("final image", FINAL)?;
    rec.fullscreen(
        "resolve",
        Program::new("passes/resolve.wgsl", "fs_main"),
        &[Input::Texture(color)],
        &[&image],
        None,
    )?;
    Ok(image)
}
