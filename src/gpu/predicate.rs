//! Passes that the device itself may leave out: the numbers of their draws and dispatches lie in a buffer, which a compute
//! shader sets to 0. The processor never waits for that decision.

use std::collections::HashMap;

use super::{Gpu, GpuError};

/// Words of a draw or dispatch in the buffer; not all use the last ones.
const WORDS: usize = 5;

/// The arguments of all draws and dispatches that stop together. Once disabled, they stay so until they are enabled again.
pub struct Predicate {
    buffer: wgpu::Buffer,
    args: Vec<[u32; WORDS]>,
    offsets: HashMap<Vec<[u32; WORDS]>, u64>,
}

impl Predicate {
    /// Without room for anything.
    pub fn new(gpu: &Gpu) -> Self {
        Self { buffer: create(gpu, 4), args: Vec::new(), offsets: HashMap::new() }
    }

    /// Forgets what has been recorded and makes room for so many different draws and dispatches.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn reset(&mut self, gpu: &Gpu, room: usize) -> Result<(), GpuError> {
        let bytes = (room * WORDS * 4) as u64;
        gpu.check_buffer_size("arguments of draws", bytes)?;
        if self.buffer.size() < bytes {
            self.buffer = create(gpu, bytes.next_power_of_two());
        }
        self.args.clear();
        self.offsets.clear();
        Ok(())
    }

    /// Where these arguments lie, one after the other; `None` if there is no room: then they cannot be stopped.
    pub(super) fn offset(&mut self, args: &[[u32; WORDS]]) -> Option<u64> {
        if let Some(offset) = self.offsets.get(args) {
            return Some(*offset);
        }
        let offset = (self.args.len() * WORDS * 4) as u64;
        if offset + size_of_val(args) as u64 > self.buffer.size() {
            return None;
        }
        self.args.extend(args);
        self.offsets.insert(args.to_vec(), offset);
        Some(offset)
    }

    /// Enables everything that was recorded, which is submitted next.
    pub fn enable(&self, gpu: &Gpu) {
        gpu.queue.write_buffer(&self.buffer, 0, bytemuck::cast_slice(&self.args));
    }

    /// Words that a compute shader sets to 0 to disable them.
    pub fn buffer(&self) -> &wgpu::Buffer {
        &self.buffer
    }
}

fn create(gpu: &Gpu, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("predicate"),
        size,
        usage: wgpu::BufferUsages::INDIRECT | wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}
