//! How large texels are cleared. Mesa's software device fills those of more than 4 bytes one by one, each by a call, but copies
//! whole rows of zeros: a tenth of the time of a picture with many layers.

use super::recorder::color_attachment;
use super::{Gpu, Target};

/// Zeros that targets are cleared with.
#[derive(Debug, Clone)]
pub(super) struct Zeros(wgpu::Buffer);

/// Few enough to stay in a processor's cache, and at least a row of the largest texture of 16 bytes per texel.
const BYTES: u32 = 1 << 19;

impl Zeros {
    /// Those that suit a device; `None`: it clears faster by itself.
    pub(super) fn of(device_type: wgpu::DeviceType, device: &wgpu::Device) -> Option<Self> {
        let is_software = device_type == wgpu::DeviceType::Cpu;
        // A new buffer is full of zeros.
        is_software.then(|| {
            Self(device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("zeros"),
                size: u64::from(BYTES),
                usage: wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            }))
        })
    }

    /// Copies rows of them over all of a target.
    fn copy(&self, encoder: &mut wgpu::CommandEncoder, target: &Target, texel_bytes: u32) {
        let [width, height] = target.size();
        let bytes_per_row = (width * texel_bytes).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let rows = (BYTES / bytes_per_row).max(1);
        for top in (0..height).step_by(rows as usize) {
            let zeros = wgpu::TexelCopyBufferInfo {
                buffer: &self.0,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(bytes_per_row),
                    rows_per_image: None,
                },
            };
            let mut below = target.texture().as_image_copy();
            below.origin.y = top;
            let size = wgpu::Extent3d { width, height: rows.min(height - top), depth_or_array_layers: 1 };
            encoder.copy_buffer_to_texture(zeros, below, size);
        }
    }
}

/// Targets as outputs of a pass that finds them cleared to 0.
pub(super) fn cleared<'t>(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    outputs: &[&'t Target],
) -> Vec<Option<wgpu::RenderPassColorAttachment<'t>>> {
    let attachment = |output: &&'t Target| {
        let texel_bytes = output.format().block_copy_size(None).unwrap_or(0);
        let load = match &gpu.zeros {
            Some(zeros) if texel_bytes > 4 => {
                zeros.copy(encoder, output, texel_bytes);
                wgpu::LoadOp::Load
            }
            _ => wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
        };
        Some(color_attachment(output, load))
    };
    outputs.iter().map(attachment).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::{TargetPool, readback};

    #[test]
    fn every_texel_is_cleared() {
        let gpu = Gpu::headless().unwrap();
        // Rows that are padded, and more of them than fit into the zeros a whole number of times.
        let size = [333, 200];
        for format in [
            wgpu::TextureFormat::R32Uint,
            wgpu::TextureFormat::Rgba16Float,
            wgpu::TextureFormat::Rg32Uint,
            wgpu::TextureFormat::Rgba32Uint,
        ] {
            let target = TargetPool::default().get(&gpu, "cleared", size, format).unwrap();
            let row = size[0] * format.block_copy_size(None).unwrap();
            let (ones, extent) = (vec![1; (row * size[1]) as usize], target.texture().size());
            let layout = wgpu::TexelCopyBufferLayout {
                bytes_per_row: Some(row),
                ..wgpu::TexelCopyBufferLayout::default()
            };
            gpu.queue.write_texture(target.texture().as_image_copy(), &ones, layout, extent);
            let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            let color_attachments = cleared(&gpu, &mut encoder, &[&target]);
            encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                color_attachments: &color_attachments,
                ..wgpu::RenderPassDescriptor::default()
            });
            gpu.queue.submit([encoder.finish()]);
            assert!(readback::read(&gpu, &target).unwrap().iter().all(|&byte| byte == 0), "{format:?}");
        }
    }
}
