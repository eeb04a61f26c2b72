//! Records that a shader appends, and that others work through.

use wgpu::util::{BufferInitDescriptor, DeviceExt};

use super::{Gpu, GpuError, RecordBuffer, Recorder};

/// No workgroups, and no records.
const NONE: [u32; 4] = [0, 1, 1, 0];

/// A buffer of records, and how many of them there are.
pub struct RecordList {
    records: RecordBuffer,
    count: wgpu::Buffer,
    /// What `count` begins with.
    none: wgpu::Buffer,
}

impl RecordList {
    /// Without room for any.
    pub fn new(gpu: &Gpu, label: &'static str) -> Self {
        let counter = |usage| {
            let contents = bytemuck::bytes_of(&NONE);
            gpu.device.create_buffer_init(&BufferInitDescriptor { label: Some(label), contents, usage })
        };
        let used = wgpu::BufferUsages::INDIRECT | wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
        Self {
            records: RecordBuffer::new(gpu, label),
            count: counter(used),
            none: counter(wgpu::BufferUsages::COPY_SRC),
        }
    }

    /// Makes room for so many bytes, with undefined contents.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn reserve(&mut self, gpu: &Gpu, bytes: u64) -> Result<(), GpuError> {
        self.records.reserve(gpu, bytes)
    }

    /// Takes all records out of it.
    pub fn empty(&self, rec: &mut Recorder<'_>) {
        rec.encoder.copy_buffer_to_buffer(&self.none, 0, &self.count, 0, None);
    }

    /// The records.
    pub fn buffer(&self) -> &wgpu::Buffer {
        self.records.buffer()
    }

    /// How many they are, and the workgroups for them: `ListHead` in `shaders/gpu/record_list.wgsl`.
    pub fn count(&self) -> &wgpu::Buffer {
        &self.count
    }
}
