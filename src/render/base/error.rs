//! Why there is no picture.

use crate::gpu::{GpuError, ShaderError};
use crate::hatching::tonal_art_map::generator::RecipeError;

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// The device cannot do it.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A shader is missing, wrong, or not given what it reads.
    #[error(transparent)]
    Shader(#[from] ShaderError),
    /// The strokes that a style describes cannot be drawn.
    #[error("hatching.own: {0}")]
    Strokes(#[from] RecipeError),
}
