//! Why there is no picture.

use crate::gpu::{GpuError, ShaderError};

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// The device cannot do it.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A shader is missing, wrong, or not given what it reads.
    #[error(transparent)]
    Shader(#[from] ShaderError),
}
