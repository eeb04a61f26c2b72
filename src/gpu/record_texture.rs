//! Plain records in a texture. Where each invocation reads another record, software devices read textures many times faster
//! than buffers.

use super::{Gpu, GpuError, Recorder, Target};

/// Texels per row, as in `shaders/gpu/record_texture.wgsl`.
const COLUMNS: u32 = 2048;

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Uint;
const TEXEL_BYTES: usize = 16;
const ROW_BYTES: usize = COLUMNS as usize * TEXEL_BYTES;

/// Records of whole texels; grows with their number.
pub struct RecordTexture {
    target: Target,
    label: &'static str,
}

impl RecordTexture {
    /// An empty one.
    pub fn new(gpu: &Gpu, label: &'static str) -> Self {
        Self { target: create(gpu, label, 1), label }
    }

    /// Writes all records, each of whole texels.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn write<T: bytemuck::NoUninit>(&mut self, gpu: &Gpu, records: &[T]) -> Result<(), GpuError> {
        const { assert!(size_of::<T>().is_multiple_of(TEXEL_BYTES)) };
        let bytes: &[u8] = bytemuck::cast_slice(records);
        self.reserve(gpu, bytes.len() / TEXEL_BYTES)?;
        let (rows, rest) = bytes.as_chunks::<ROW_BYTES>();
        self.write_rect(gpu, 0, [COLUMNS, rows.len() as u32], rows.as_flattened());
        self.write_rect(gpu, rows.len() as u32, [(rest.len() / TEXEL_BYTES) as u32, 1], rest);
        Ok(())
    }

    /// Writes so many columns and rows, from this row on.
    fn write_rect(&self, gpu: &Gpu, first_row: u32, [width, height]: [u32; 2], bytes: &[u8]) {
        if bytes.is_empty() {
            return;
        }
        let origin = wgpu::Origin3d { x: 0, y: first_row, z: 0 };
        gpu.queue.write_texture(
            wgpu::TexelCopyTextureInfo { origin, ..self.target.texture().as_image_copy() },
            bytes,
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(ROW_BYTES as u32),
                rows_per_image: None,
            },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
    }

    /// Writes records of two words, two of them to a texel; what is left of the last one is 0. Shaders read them by `pair_at`.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn write_pairs(&mut self, gpu: &Gpu, records: &[[u32; 2]]) -> Result<(), GpuError> {
        let (texels, rest) = records.as_chunks::<2>();
        match rest {
            [] => self.write(gpu, texels),
            [last, ..] => self.write(gpu, &[texels, &[[*last, [0; 2]]]].concat()),
        }
    }

    /// Makes room for so many texels that shaders write; what is in it is lost if it has to grow.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn reserve(&mut self, gpu: &Gpu, texels: usize) -> Result<(), GpuError> {
        let [_, rows] = size_of_texels(texels);
        gpu.check_texture_size(self.label, [COLUMNS, rows])?;
        if self.target.size()[1] < rows {
            let roomy = rows.next_power_of_two().min(gpu.device.limits().max_texture_dimension_2d);
            self.target = Target::new(gpu.create_texture(self.label, &descriptor(self.label, roomy))?);
        }
        Ok(())
    }

    /// The most texels that a device can keep.
    pub fn max_texels(gpu: &Gpu) -> u64 {
        u64::from(COLUMNS) * u64::from(gpu.device.limits().max_texture_dimension_2d)
    }

    /// Gives its memory back.
    pub fn clear(&mut self, gpu: &Gpu) {
        self.target = create(gpu, self.label, 1);
    }

    /// Capacity in texels.
    pub fn capacity(&self) -> u64 {
        self.target.size().map(u64::from).iter().product()
    }

    /// The texture.
    pub fn target(&self) -> &Target {
        &self.target
    }
}

/// A texture of the pool for so many records, of a texel each, that shaders write for one frame.
///
/// # Errors
/// [`GpuError::TooLarge`].
pub fn frame_records(rec: &mut Recorder<'_>, label: &str, records: u32) -> Result<Target, GpuError> {
    // Sizes that change little find the texture of an earlier frame.
    rec.target_of(label, FORMAT, size_of_texels(records as usize).map(u32::next_power_of_two))
}

/// Width and height of a texture of so many texels.
fn size_of_texels(texels: usize) -> [u32; 2] {
    let rows = texels.div_ceil(COLUMNS as usize).max(1);
    [COLUMNS, u32::try_from(rows).unwrap_or(u32::MAX)]
}

fn create(gpu: &Gpu, label: &str, rows: u32) -> Target {
    Target::new(gpu.device.create_texture(&descriptor(label, rows)))
}

fn descriptor(label: &str, rows: u32) -> wgpu::TextureDescriptor<'_> {
    wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width: COLUMNS, height: rows, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::STORAGE_BINDING
            | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    }
}
