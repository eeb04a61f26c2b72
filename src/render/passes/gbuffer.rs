//! The G-buffer: what is known of the surface at each pixel (edge-enhancement paper, section 4.1.1).

use crate::gpu::{Recorder, Target};
use crate::render::base::error::RenderError;

/// Shading and face normal, linear depth, object id: see `shaders/common/gbuffer.wgsl`.
pub(super) const GEOMETRY: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Uint;
/// Unlit base color.
pub(super) const BASE_COLOR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
/// Which surface of which object.
pub(super) const SURFACE_ID: wgpu::TextureFormat = wgpu::TextureFormat::R32Uint;
/// Of a depth layer: depth of each pixel, and which draw and surface it is of, see [`crate::render::base::instances::Instance::first_surface`].
pub(super) const SORT_KEYS: wgpu::TextureFormat = wgpu::TextureFormat::Rg32Uint;
/// Reversed: 1 at the near plane.
pub const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Per-pixel geometry of everything visible.
#[derive(Debug, Clone)]
pub struct GBuffer {
    /// Shading and face normal, linear depth, object id with the enhanced flag.
    pub geometry: Target,
    /// Unlit base color.
    pub base_color: Target,
    /// A number for each surface of each object; 0: background.
    pub surface_id: Target,
    /// Reversed depth. Of a layer from fragment lists of which it was not asked for, only 0 where no layer has anything.
    pub depth: Target,
}

impl GBuffer {
    /// With undefined contents.
    pub(super) fn new(rec: &mut Recorder<'_>) -> Result<Self, RenderError> {
        Ok(Self {
            geometry: rec.target("geometry", GEOMETRY)?,
            base_color: rec.target("base color", BASE_COLOR)?,
            surface_id: rec.target("surface ids", SURFACE_ID)?,
            depth: rec.target("depth", DEPTH)?,
        })
    }
}
