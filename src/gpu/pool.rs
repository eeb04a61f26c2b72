//! Render targets by descriptor: a pass asks for what it needs, the pool finds or makes it.

use std::sync::Arc;

use super::{Gpu, GpuError};

/// A texture to draw into and to read from. Clones share it; when the last one is gone, the pool may hand it out
/// again.
#[derive(Debug, Clone)]
pub struct Target(Arc<Inner>);

#[derive(Debug)]
struct Inner {
    texture: wgpu::Texture,
    view: wgpu::TextureView,
    attachment: wgpu::TextureView,
}

impl Target {
    pub(super) fn new(texture: wgpu::Texture) -> Self {
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let format = drawn_as(texture.format());
        let attachment = if format == texture.format() {
            view.clone()
        } else {
            texture.create_view(&wgpu::TextureViewDescriptor { format: Some(format), ..Default::default() })
        };
        Self(Arc::new(Inner { texture, view, attachment }))
    }

    /// The texture.
    pub fn texture(&self) -> &wgpu::Texture {
        &self.0.texture
    }

    /// What shaders read.
    pub fn view(&self) -> &wgpu::TextureView {
        &self.0.view
    }

    /// What shaders draw into, see [`drawn_as`].
    pub fn attachment(&self) -> &wgpu::TextureView {
        &self.0.attachment
    }

    /// Its format.
    pub fn format(&self) -> wgpu::TextureFormat {
        self.0.texture.format()
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        [self.0.texture.width(), self.0.texture.height()]
    }
}

/// All targets of a renderer.
#[derive(Debug, Default)]
pub struct TargetPool {
    targets: Vec<Target>,
}

impl TargetPool {
    /// A target of this size and format with undefined contents.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn get(
        &mut self,
        gpu: &Gpu,
        label: &str,
        size: [u32; 2],
        format: wgpu::TextureFormat,
    ) -> Result<Target, GpuError> {
        let free = |t: &&Target| t.size() == size && t.format() == format && Arc::strong_count(&t.0) == 1;
        if let Some(target) = self.targets.iter().find(free) {
            return Ok(target.clone());
        }
        gpu.check_texture_size(&format!("the picture ({label})"), size)?;
        let descriptor = wgpu::TextureDescriptor {
            label: Some(label),
            size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: usage(format),
            view_formats: if drawn_as(format) == format { &[] } else { &[drawn_as(format)] },
        };
        let texture = gpu.create_texture(&format!("the picture ({label})"), &descriptor)?;
        let target = Target::new(texture);
        self.targets.push(target.clone());
        Ok(target)
    }

    /// Forgets targets that nobody holds and that have none of these sizes.
    pub fn shrink_to(&mut self, sizes: &[[u32; 2]]) {
        self.targets.retain(|t| Arc::strong_count(&t.0) > 1 || sizes.contains(&t.size()));
    }
}

/// The format in which targets of this format are drawn into: shaders apply the sRGB curve themselves where what is read has
/// it taken off. Mesa's software device does so more slowly, and reads again all that it writes with it.
pub fn drawn_as(format: wgpu::TextureFormat) -> wgpu::TextureFormat {
    format.remove_srgb_suffix()
}

/// Everything is drawn into, read and copied; integers are also written by compute shaders.
fn usage(format: wgpu::TextureFormat) -> wgpu::TextureUsages {
    let usage = wgpu::TextureUsages::RENDER_ATTACHMENT
        | wgpu::TextureUsages::TEXTURE_BINDING
        | wgpu::TextureUsages::COPY_SRC
        | wgpu::TextureUsages::COPY_DST;
    match format {
        wgpu::TextureFormat::R32Uint => usage | wgpu::TextureUsages::STORAGE_BINDING,
        wgpu::TextureFormat::Rg32Uint | wgpu::TextureFormat::Rgba32Uint => {
            usage | wgpu::TextureUsages::STORAGE_BINDING
        }
        wgpu::TextureFormat::Depth32Float => usage | wgpu::TextureUsages::COPY_DST,
        _ => usage,
    }
}
