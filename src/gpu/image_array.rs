//! Square images of one size as layers of one texture, each at several resolutions.

use super::Gpu;

/// Images on the device.
pub struct ImageArray {
    texture: wgpu::Texture,
    view: wgpu::TextureView,
}

impl ImageArray {
    /// So many images, empty; each level has half the side of the one before.
    pub fn new(
        gpu: &Gpu,
        label: &'static str,
        format: wgpu::TextureFormat,
        side: u32,
        count: u32,
        levels: u32,
    ) -> Self {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size: wgpu::Extent3d { width: side, height: side, depth_or_array_layers: count.max(1) },
            mip_level_count: levels,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..Default::default()
        });
        Self { texture, view }
    }

    /// For shaders that read none.
    pub fn none(gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        Self::new(gpu, "no images", format, 1, 1, 1)
    }

    /// Uploads a level of an image, row by row; nothing if it has another number of texels.
    pub fn write(&self, gpu: &Gpu, number: u32, level: u32, texels: &[u8]) {
        let side = self.texture.width() >> level;
        let bytes = self.texture.format().block_copy_size(None).unwrap_or(0);
        if texels.len() as u32 != side * side * bytes {
            return;
        }
        gpu.queue.write_texture(
            wgpu::TexelCopyTextureInfo {
                texture: &self.texture,
                mip_level: level,
                origin: wgpu::Origin3d { x: 0, y: 0, z: number },
                aspect: wgpu::TextureAspect::All,
            },
            texels,
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(side * bytes),
                rows_per_image: Some(side),
            },
            wgpu::Extent3d { width: side, height: side, depth_or_array_layers: 1 },
        );
    }

    /// All of them.
    pub fn view(&self) -> &wgpu::TextureView {
        &self.view
    }

    /// Reads them as tiles: again and again, smoothly within and between levels.
    pub fn tile_sampler(gpu: &Gpu) -> wgpu::Sampler {
        gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("tiles"),
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        })
    }
}
