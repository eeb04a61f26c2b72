//! How long passes take, by timestamps of the device.

use super::{Gpu, GpuError};

/// More passes in a frame than this are not timed.
const MAX_TIMED: u32 = 1024;

/// Timestamps around the passes of a frame.
pub struct Timers {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    labels: Vec<&'static str>,
    nanoseconds_per_tick: f32,
}

/// The timestamps of one pass.
pub struct Timestamps<'a> {
    /// Where they are written.
    pub query_set: &'a wgpu::QuerySet,
    /// Index of the one at the beginning.
    pub begin: u32,
    /// Index of the one at the end.
    pub end: u32,
}

impl Timers {
    /// Timers, if the device has them.
    pub fn new(gpu: &Gpu) -> Option<Self> {
        if !gpu.device.features().contains(wgpu::Features::TIMESTAMP_QUERY) {
            return None;
        }
        Some(Self {
            queries: gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("timers"),
                ty: wgpu::QueryType::Timestamp,
                count: MAX_TIMED * 2,
            }),
            resolved: gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("timers"),
                size: u64::from(MAX_TIMED) * 16,
                usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            }),
            labels: Vec::new(),
            nanoseconds_per_tick: gpu.queue.get_timestamp_period(),
        })
    }

    /// What a pass of this name has to write.
    pub fn pass(&mut self, label: &'static str) -> Option<Timestamps<'_>> {
        let index = self.labels.len() as u32;
        if index >= MAX_TIMED {
            return None;
        }
        self.labels.push(label);
        Some(Timestamps { query_set: &self.queries, begin: index * 2, end: index * 2 + 1 })
    }

    /// Records the end of the frame.
    pub fn resolve(&self, encoder: &mut wgpu::CommandEncoder) {
        if !self.labels.is_empty() {
            encoder.resolve_query_set(&self.queries, 0..self.labels.len() as u32 * 2, &self.resolved, 0);
        }
    }

    /// Waits for the frame and returns the milliseconds of each pass, in order, from the end of the one before it: copies and
    /// waits that lie between belong to it, and software devices note when a compute pass begins only once it has run. The next
    /// frame starts anew.
    ///
    /// # Errors
    /// [`GpuError::Lost`].
    pub fn take(&mut self, gpu: &Gpu) -> Result<Vec<(&'static str, f64)>, GpuError> {
        let labels = std::mem::take(&mut self.labels);
        if labels.is_empty() {
            return Ok(Vec::new());
        }
        let bytes = labels.len() as u64 * 16;
        let copy = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("timers"),
            size: bytes,
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_buffer_to_buffer(&self.resolved, 0, &copy, 0, bytes);
        gpu.queue.submit([encoder.finish()]);
        copy.map_async(wgpu::MapMode::Read, .., |_result| {});
        gpu.wait()?;
        let view = copy.get_mapped_range(..).map_err(|e| GpuError::Lost(e.to_string()))?;
        let ticks: Vec<u64> = bytemuck::pod_collect_to_vec(&view);
        let scale = f64::from(self.nanoseconds_per_tick) * 1e-6;
        let begin = ticks.iter().copied().take(1);
        let ends = || ticks.chunks_exact(2).map(|pass| pass[1]);
        let times = begin.chain(ends()).zip(ends()).map(|(from, to)| to.saturating_sub(from) as f64 * scale);
        Ok(labels.into_iter().zip(times).collect())
    }
}
