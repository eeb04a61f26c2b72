//! Finding an adapter and opening a device.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Why there is no device to draw with, or why it could not do something.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    /// The system offers no adapter.
    #[error(
        "no graphics driver was found ({reason}). Install one: on Debian or Ubuntu `apt install mesa-vulkan-drivers` \
         gives a software driver that always works; with a graphics card, its Vulkan driver"
    )]
    NoAdapter {
        /// What wgpu said.
        reason: String,
    },
    /// An adapter exists but gives no device.
    #[error("the graphics driver {adapter} refused to start: {reason}")]
    NoDevice {
        /// Name of the adapter.
        adapter: String,
        /// What wgpu said.
        reason: String,
    },
    /// Something is larger than the device allows.
    #[error("{what} needs {needed}, but {adapter} allows at most {allowed}")]
    TooLarge {
        /// The picture or buffer.
        what: String,
        /// Its size.
        needed: u64,
        /// The limit.
        allowed: u64,
        /// Name of the adapter.
        adapter: String,
    },
    /// The device stopped working.
    #[error("the graphics device failed: {0}")]
    Lost(String),
}

/// An open device with its queue. Clones share both.
#[derive(Debug, Clone)]
pub struct Gpu {
    /// Makes resources.
    pub device: wgpu::Device,
    /// Runs work.
    pub queue: wgpu::Queue,
    /// Name of the adapter, for people.
    pub adapter_name: String,
    /// Whether fragment shaders can write into buffers.
    pub writes_in_fragments: bool,
}

impl Gpu {
    /// Opens the system's best adapter without a window. Takes 20 to 40 ms.
    ///
    /// # Errors
    /// [`GpuError::NoAdapter`] or [`GpuError::NoDevice`].
    pub fn headless() -> Result<Self, GpuError> {
        let instance = wgpu::Instance::new(instance_descriptor());
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            ..Default::default()
        }))
        .map_err(|e| GpuError::NoAdapter { reason: e.to_string() })?;
        let (device, queue) = pollster::block_on(adapter.request_device(&device_descriptor(&adapter)))
            .map_err(|e| GpuError::NoDevice { adapter: adapter.get_info().name, reason: e.to_string() })?;
        Ok(Self::new(&adapter, device, queue))
    }

    /// Takes over a device that somebody else opened with [`device_descriptor`].
    pub fn new(adapter: &wgpu::Adapter, device: wgpu::Device, queue: wgpu::Queue) -> Self {
        let info = adapter.get_info();
        let flags = adapter.get_downlevel_capabilities().flags;
        let writes_in_fragments = flags.contains(wgpu::DownlevelFlags::FRAGMENT_WRITABLE_STORAGE);
        if info.device_type == wgpu::DeviceType::Cpu {
            keep_freed_memory();
        }
        Self { device, queue, adapter_name: info.name, writes_in_fragments }
    }

    /// Fails if a texture of this size cannot exist.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn check_texture_size(&self, what: &str, size: [u32; 2]) -> Result<(), GpuError> {
        let allowed = self.device.limits().max_texture_dimension_2d;
        let needed = size[0].max(size[1]);
        if needed > allowed {
            return Err(self.too_large(what, u64::from(needed), u64::from(allowed)));
        }
        Ok(())
    }

    /// Fails if a buffer of this many bytes cannot exist.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn check_buffer_size(&self, what: &str, bytes: u64) -> Result<(), GpuError> {
        let allowed = self.device.limits().max_buffer_size;
        if bytes > allowed {
            return Err(self.too_large(what, bytes, allowed));
        }
        Ok(())
    }

    fn too_large(&self, what: &str, needed: u64, allowed: u64) -> GpuError {
        GpuError::TooLarge { what: what.to_owned(), needed, allowed, adapter: self.adapter_name.clone() }
    }

    /// Takes note of what the device has done, without waiting.
    pub fn poll(&self) {
        // A lost device shows elsewhere.
        let _ = self.device.poll(wgpu::PollType::Poll);
    }

    /// Waits until all submitted work is done.
    ///
    /// # Errors
    /// [`GpuError::Lost`].
    pub fn wait(&self) -> Result<(), GpuError> {
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .map(|_status| ())
            .map_err(|e| GpuError::Lost(e.to_string()))
    }

    /// All work submitted so far, to be waited for in another thread.
    pub fn submitted(&self) -> Submitted {
        let done = Arc::new(AtomicBool::new(false));
        let signal = Arc::clone(&done);
        self.queue.on_submitted_work_done(move || signal.store(true, Ordering::Release));
        Submitted { done, device: self.device.clone() }
    }
}

/// Work that was submitted to a device.
pub struct Submitted {
    done: Arc<AtomicBool>,
    device: wgpu::Device,
}

impl Submitted {
    /// Waits for it, or until nobody is interested any more. Unlike [`Gpu::wait`], that does not keep other threads
    /// from submitting work.
    pub fn wait(&self, is_cancelled: impl Fn() -> bool) {
        while !self.done.load(Ordering::Acquire) && !is_cancelled() {
            std::thread::sleep(Duration::from_millis(1));
            // A lost device shows elsewhere.
            let _ = self.device.poll(wgpu::PollType::Poll);
        }
    }
}

/// How instances are made: native backends only, no validation layers unless `WGPU_*` variables ask for them.
pub fn instance_descriptor() -> wgpu::InstanceDescriptor {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::from_env()
        .unwrap_or(wgpu::Backends::VULKAN | wgpu::Backends::METAL | wgpu::Backends::DX12);
    descriptor.flags = wgpu::InstanceFlags::empty().with_env();
    descriptor
}

/// So many textures of whole numbers the shader that reads most of them takes.
const STORAGE_TEXTURES: u32 = 6;

/// What is asked of a device: all that the adapter can do in size, and timers and the choice of instances in indirect draws
/// where it has them.
pub fn device_descriptor(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
    let limits = adapter.limits();
    wgpu::DeviceDescriptor {
        label: Some("hachure"),
        required_features: adapter.features()
            & (wgpu::Features::TIMESTAMP_QUERY | wgpu::Features::INDIRECT_FIRST_INSTANCE),
        required_limits: wgpu::Limits {
            max_storage_textures_per_shader_stage: limits
                .max_storage_textures_per_shader_stage
                .max(STORAGE_TEXTURES),
            ..limits
        },
        ..Default::default()
    }
}

/// Takes and frees a block of memory. A software driver takes megabytes for each frame; glibc gives what is freed back to the
/// system, and a twentieth of a frame is spent on getting it again, unless as large a block has been freed before
/// (`man mallopt`, `M_MMAP_THRESHOLD`). Where memory is managed otherwise it makes no difference.
fn keep_freed_memory() {
    // glibc takes no notice of 32 MiB and more.
    drop(std::hint::black_box(Vec::<u8>::with_capacity(31 << 20)));
}
