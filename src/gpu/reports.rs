//! What the device reports: small buffers, read a frame or more after they were written and never waited for.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::Recorder;

/// The reports that are on their way; `T` is what the processor has to know to understand one when it arrives.
pub struct Reports<T> {
    sent: VecDeque<InFlight<T>>,
    free: Vec<wgpu::Buffer>,
}

struct InFlight<T> {
    copy: wgpu::Buffer,
    /// Held by the device, too, until it is decided.
    has_arrived: Arc<AtomicBool>,
    about: T,
}

impl<T> Default for Reports<T> {
    fn default() -> Self {
        Self { sent: VecDeque::new(), free: Vec::new() }
    }
}

impl<T> Reports<T> {
    /// Reports what a buffer, which can be copied from, holds at this point of the frame.
    pub fn send(&mut self, rec: &mut Recorder<'_>, buffer: &wgpu::Buffer, about: T) {
        let free = self.free.pop().filter(|free| free.size() == buffer.size());
        let copy = free.unwrap_or_else(|| {
            rec.gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("report"),
                size: buffer.size(),
                usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
                mapped_at_creation: false,
            })
        });
        rec.encoder.copy_buffer_to_buffer(buffer, 0, &copy, 0, buffer.size());
        let has_arrived = Arc::new(AtomicBool::new(false));
        let signal = Arc::clone(&has_arrived);
        rec.encoder.map_buffer_on_submit(&copy, wgpu::MapMode::Read, .., move |result| {
            signal.store(result.is_ok(), Ordering::Release);
        });
        self.sent.push_back(InFlight { copy, has_arrived, about });
    }

    /// The latest report that has arrived since the last call; earlier ones are out of date. Never waits: somebody has to
    /// poll the device.
    pub fn take(&mut self) -> Option<(T, Vec<u8>)> {
        let mut latest = None;
        while let Some(sent) = self.sent.front_mut() {
            // Of a frame that was never submitted nobody else knows any more.
            let Some(has_arrived) = Arc::get_mut(&mut sent.has_arrived) else { break };
            let has_arrived = *has_arrived.get_mut();
            let Some(sent) = self.sent.pop_front() else { break };
            if !has_arrived {
                continue;
            }
            if let Ok(bytes) = sent.copy.get_mapped_range(..) {
                latest = Some((sent.about, bytes.to_vec()));
            }
            sent.copy.unmap();
            self.free.push(sent.copy);
        }
        latest
    }

    /// Whether any is still on its way.
    pub fn is_waiting(&self) -> bool {
        !self.sent.is_empty()
    }
}
