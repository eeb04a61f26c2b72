//! Depth peeling: what lies behind what has been drawn, layer by layer (blueprints paper, section 3, Fig. 2).

use super::gbuffer::SORT_KEYS;
use crate::gpu::{Gpu, Recorder, Target};
use crate::render::base::error::RenderError;

/// What a layer lies behind, and what others lie behind. The sort key of a fragment is its depth, and the draw and surface it
/// is of, which tell coplanar ones apart; see `passes/peel.wgsl`.
pub struct Peel<'a> {
    /// Sort keys of the layer before.
    pub last: &'a Target,
    /// Those of the layer that is drawn; `None`: it is only counted, and nothing is known of it but its surface ids and depth.
    pub sort_keys: Option<&'a Target>,
    /// Whether it has a base color.
    pub with_color: bool,
}

impl Peel<'_> {
    /// Layout of the bind group that holds the layer before.
    pub fn layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
        gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("last layer"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::FRAGMENT,
                ty: gpu.integer_textures.binding(SORT_KEYS),
                count: None,
            }],
        })
    }

    /// Sort keys as a bind group.
    pub fn group_of(gpu: &Gpu, layout: &wgpu::BindGroupLayout, sort_keys: &Target) -> wgpu::BindGroup {
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("last layer"),
            layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: wgpu::BindingResource::TextureView(sort_keys.view()),
            }],
        })
    }
}

/// Sort keys that everything lies behind.
///
/// # Errors
/// [`RenderError`].
pub fn before_all(rec: &mut Recorder<'_>) -> Result<Target, RenderError> {
    let sort_keys = rec.target("before all layers", SORT_KEYS)?;
    let nearest = wgpu::Color { r: f64::from(1.0_f32.to_bits()), ..wgpu::Color::TRANSPARENT };
    let cleared = wgpu::RenderPassColorAttachment {
        view: sort_keys.view(),
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations { load: wgpu::LoadOp::Clear(nearest), store: wgpu::StoreOp::Store },
    };
    rec.pass("before all layers", &[Some(cleared)], None);
    Ok(sort_keys)
}
