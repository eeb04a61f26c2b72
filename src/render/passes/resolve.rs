//! The final image.

use crate::gpu::{Program, Recorder, Target, inputs};
use crate::render::RenderError;

/// What the window, PNG files and tests see: sRGB with straight alpha.
pub const FINAL: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Lays the drawing over the paper, a scale bar (`ScaleBarUniform`), if it is shown, over both, and applies the sRGB curve.
///
/// # Errors
/// [`RenderError`].
pub fn resolve(
    rec: &mut Recorder<'_>,
    color: &Target,
    (scale_bar, is_shown): (&wgpu::Buffer, bool),
) -> Result<Target, RenderError> {
    let image = rec.target("final image", FINAL)?;
    let program = Program {
        file: "passes/resolve.wgsl",
        entry_point: "fs_main",
        switches: vec![("WITH_SCALE_BAR", is_shown)],
    };
    let inputs = inputs! { color_tex: color, scale_bar: scale_bar };
    rec.fullscreen("resolve", program, &inputs, &[&image], None)?;
    Ok(image)
}
