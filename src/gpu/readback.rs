//! Copying textures back to the processor, now or later.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::{Gpu, GpuError, Target};

/// A copy that is on its way. Never waits unless asked to.
pub struct Readback {
    buffer: wgpu::Buffer,
    mapped: Arc<AtomicBool>,
    row_bytes: usize,
    padded_row_bytes: usize,
}

impl Readback {
    /// Starts to copy the rectangle at `origin` (pixels from the upper left) with `size`, which must lie inside.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn start(gpu: &Gpu, target: &Target, origin: [u32; 2], size: [u32; 2]) -> Result<Self, GpuError> {
        let texel = target.format().block_copy_size(None).unwrap_or(4) as usize;
        let row_bytes = size[0] as usize * texel;
        let padded_row_bytes = row_bytes.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT as usize);
        let bytes = padded_row_bytes as u64 * u64::from(size[1]);
        gpu.check_buffer_size("reading back the picture", bytes)?;
        let descriptor = wgpu::BufferDescriptor {
            label: Some("read-back"),
            size: bytes,
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        };
        let buffer = gpu.create_buffer("reading back the picture", &descriptor)?;
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_texture_to_buffer(
            wgpu::TexelCopyTextureInfo {
                texture: target.texture(),
                mip_level: 0,
                origin: wgpu::Origin3d { x: origin[0], y: origin[1], z: 0 },
                aspect: wgpu::TextureAspect::All,
            },
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(padded_row_bytes as u32),
                    rows_per_image: Some(size[1]),
                },
            },
            wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        );
        gpu.queue.submit([encoder.finish()]);
        let mapped = Arc::new(AtomicBool::new(false));
        let done = Arc::clone(&mapped);
        buffer.map_async(wgpu::MapMode::Read, .., move |result| {
            done.store(result.is_ok(), Ordering::Release);
        });
        Ok(Self { buffer, mapped, row_bytes, padded_row_bytes })
    }

    /// The bytes, row by row without padding, once they have arrived.
    pub fn poll(&self, gpu: &Gpu) -> Option<Vec<u8>> {
        gpu.poll();
        self.bytes()
    }

    /// Waits for the bytes.
    ///
    /// # Errors
    /// [`GpuError::Lost`].
    pub fn wait(&self, gpu: &Gpu) -> Result<Vec<u8>, GpuError> {
        gpu.wait()?;
        self.bytes().ok_or_else(|| GpuError::Lost("a picture could not be read back".to_owned()))
    }

    fn bytes(&self) -> Option<Vec<u8>> {
        if !self.mapped.load(Ordering::Acquire) {
            return None;
        }
        let view = self.buffer.get_mapped_range(..).ok()?;
        let rows = view.chunks(self.padded_row_bytes);
        Some(rows.flat_map(|row| row.iter().take(self.row_bytes)).copied().collect())
    }
}

/// Copies a whole buffer and waits for it.
///
/// # Errors
/// [`GpuError`].
pub fn read_buffer(gpu: &Gpu, buffer: &wgpu::Buffer) -> Result<Vec<u8>, GpuError> {
    let copy = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("read-back"),
        size: buffer.size(),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.copy_buffer_to_buffer(buffer, 0, &copy, 0, buffer.size());
    gpu.queue.submit([encoder.finish()]);
    copy.map_async(wgpu::MapMode::Read, .., |_| {});
    gpu.wait()?;
    let view = copy.get_mapped_range(..).map_err(|e| GpuError::Lost(e.to_string()))?;
    Ok(view.to_vec())
}

/// Copies a whole target and waits for it.
///
/// # Errors
/// [`GpuError`].
pub fn read(gpu: &Gpu, target: &Target) -> Result<Vec<u8>, GpuError> {
    Readback::start(gpu, target, [0, 0], target.size())?.wait(gpu)
}
