//! What is bound in place of inputs that there are not.

use std::collections::HashMap;

use super::Gpu;

/// What stands for inputs that there are not.
#[derive(Clone, Default)]
pub struct Placeholders(HashMap<wgpu::BindingType, Placeholder>);

#[derive(Clone)]
enum Placeholder {
    Texture(wgpu::TextureView),
    Buffer(wgpu::Buffer),
    Sampler(wgpu::Sampler),
}

/// More bytes than any struct or array element of a shader has.
const PLACEHOLDER_BYTES: u64 = 1 << 14;

impl Placeholders {
    /// Makes what can be bound as that.
    pub fn make(&mut self, gpu: &Gpu, ty: wgpu::BindingType) {
        self.0.entry(ty).or_insert_with(|| placeholder(gpu, ty));
    }

    /// What was made for that.
    pub fn find(&self, ty: wgpu::BindingType) -> Option<wgpu::BindingResource<'_>> {
        Some(match self.0.get(&ty)? {
            Placeholder::Texture(view) => wgpu::BindingResource::TextureView(view),
            Placeholder::Buffer(buffer) => buffer.as_entire_binding(),
            Placeholder::Sampler(sampler) => wgpu::BindingResource::Sampler(sampler),
        })
    }
}

fn placeholder(gpu: &Gpu, ty: wgpu::BindingType) -> Placeholder {
    let texture = |format, usage, view_dimension| {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("placeholder"),
            size: wgpu::Extent3d { width: 1, height: 1, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage,
            view_formats: &[],
        });
        let dimension = Some(view_dimension);
        Placeholder::Texture(
            texture.create_view(&wgpu::TextureViewDescriptor { dimension, ..Default::default() }),
        )
    };
    match ty {
        wgpu::BindingType::Texture { sample_type, view_dimension, .. } => {
            let format = match sample_type {
                wgpu::TextureSampleType::Uint => wgpu::TextureFormat::R32Uint,
                wgpu::TextureSampleType::Sint => wgpu::TextureFormat::R32Sint,
                wgpu::TextureSampleType::Depth => wgpu::TextureFormat::Depth32Float,
                wgpu::TextureSampleType::Float { .. } => wgpu::TextureFormat::Rgba8Unorm,
            };
            texture(format, wgpu::TextureUsages::TEXTURE_BINDING, view_dimension)
        }
        wgpu::BindingType::StorageTexture { format, view_dimension, .. } => {
            texture(format, wgpu::TextureUsages::STORAGE_BINDING, view_dimension)
        }
        wgpu::BindingType::Sampler(_) => {
            Placeholder::Sampler(gpu.device.create_sampler(&wgpu::SamplerDescriptor::default()))
        }
        _ => Placeholder::Buffer(gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("placeholder"),
            size: PLACEHOLDER_BYTES,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::UNIFORM,
            mapped_at_creation: false,
        })),
    }
}
