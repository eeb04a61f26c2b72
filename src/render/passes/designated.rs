//! What is known of the designated objects, which layers are to uncover (blueprints paper, section 4.3).

use encase::ShaderType;

use crate::gpu::Target;

/// What is counted of a depth mask. Twin of `Masked` in `shaders/common/depth_mask.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType)]
pub struct Masked {
    /// Its pixels, the paper's Q; 0: nothing designated is in the picture.
    pub pixels: u32,
    /// Those of them that opaque surfaces hide, which no layer uncovers.
    pub hidden: u32,
    /// Its greatest linear depth, as a number in the same order.
    pub farthest: u32,
}

/// How far layers are cut to uncover the designated objects.
#[derive(Debug, Clone, Copy)]
pub struct Uncover<'a> {
    /// The objects.
    pub mask: &'a DepthMask,
    /// The first layer that leaves this share of them uncovered, 0 to 1, is the last.
    pub fraction: f32,
    /// So many layers there are where nothing of them is in the picture.
    pub max_without: u32,
}

/// The depth texture of the designated objects, hidden by nothing but themselves.
#[derive(Debug, Clone)]
pub struct DepthMask {
    /// Reversed depth; 0 where there is none of them.
    pub depth: Target,
    /// [`Masked`] on the device.
    pub count: wgpu::Buffer,
}
