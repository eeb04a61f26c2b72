//! Finding an adapter and opening a device.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use super::clears::Zeros;
use super::faults::{Fault, Faults};
use super::integer_textures::IntegerTextures;

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
    /// A picture needs more than the device allows, although its sides are not too long.
    #[error(
        "a picture of {} × {} pixels {what} is too large for {adapter}: the largest one {what} has {} megapixels, for \
         example {} × {} pixels", size[0], size[1], megapixels(*pixels), largest[0], largest[1]
    )]
    PictureTooLarge {
        /// What is in it that needs so much: `with lines`.
        what: &'static str,
        /// Its size.
        size: [u32; 2],
        /// The most pixels that are possible.
        pixels: u64,
        /// The largest size of the same shape.
        largest: [u32; 2],
        /// Name of the adapter.
        adapter: String,
    },
    /// The device has no memory left.
    #[error(
        "{adapter} has not enough memory left for {what}; a smaller picture, a smaller model or fewer layers need less"
    )]
    OutOfMemory {
        /// The picture or buffer.
        what: String,
        /// Name of the adapter.
        adapter: String,
    },
    /// The device stopped working.
    #[error("the graphics device failed: {0}")]
    Lost(String),
}

/// See [`Gpu::max_listed`]: 64 MiB.
const MAX_LISTED: u64 = 1 << 22;

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
    /// Most layers of groups, ink and fill of each pixel counted by itself, that are put in order at a time: 16 bytes each.
    pub max_listed: u64,
    /// How shaders read textures of whole numbers.
    pub integer_textures: IntegerTextures,
    pub(super) zeros: Option<Zeros>,
    faults: Faults,
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
        let faults = Faults::of(&device);
        let integer_textures = IntegerTextures::of(info.device_type, &device.limits());
        let zeros = Zeros::of(info.device_type, &device);
        Self {
            device,
            queue,
            adapter_name: info.name,
            writes_in_fragments,
            max_listed: MAX_LISTED,
            integer_textures,
            zeros,
            faults,
        }
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

    /// Fails if shaders cannot be given a buffer of this many bytes.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn check_storage_size(&self, what: &str, bytes: u64) -> Result<(), GpuError> {
        let allowed = self.max_storage();
        if bytes > allowed {
            return Err(self.too_large(what, bytes, allowed));
        }
        Ok(())
    }

    /// Fails if shaders cannot be given a buffer with so many bytes for each pixel of a picture; `what` says which
    /// pictures need one: `with lines`.
    ///
    /// # Errors
    /// [`GpuError::PictureTooLarge`].
    pub fn check_bytes_of_pixels(
        &self,
        what: &'static str,
        size: [u32; 2],
        bytes: u64,
    ) -> Result<(), GpuError> {
        let pixels = self.max_storage() / bytes.max(1);
        match largest_of_shape(size, pixels) {
            Some(largest) => Err(GpuError::PictureTooLarge {
                what,
                size,
                pixels,
                largest,
                adapter: self.adapter_name.clone(),
            }),
            None => Ok(()),
        }
    }

    /// Whether a pass can have outputs of these formats.
    pub fn has_room_for(&self, outputs: &[wgpu::TextureFormat]) -> bool {
        let bytes = outputs.iter().fold(0, |bytes: u32, format| {
            let aligned = bytes.next_multiple_of(format.target_component_alignment().unwrap_or(1));
            aligned + format.target_pixel_byte_cost().unwrap_or(0)
        });
        let limits = self.device.limits();
        outputs.len() <= limits.max_color_attachments as usize
            && bytes <= limits.max_color_attachment_bytes_per_sample
    }

    /// The most bytes that shaders can be given in one buffer.
    pub fn max_storage(&self) -> u64 {
        let limits = self.device.limits();
        limits.max_buffer_size.min(limits.max_storage_buffer_binding_size)
    }

    /// Makes a texture.
    ///
    /// # Errors
    /// [`GpuError::OutOfMemory`].
    pub fn create_texture(
        &self,
        what: &str,
        descriptor: &wgpu::TextureDescriptor<'_>,
    ) -> Result<wgpu::Texture, GpuError> {
        self.within_memory(what, || self.device.create_texture(descriptor))
    }

    /// Makes a buffer.
    ///
    /// # Errors
    /// [`GpuError::OutOfMemory`].
    pub fn create_buffer(
        &self,
        what: &str,
        descriptor: &wgpu::BufferDescriptor<'_>,
    ) -> Result<wgpu::Buffer, GpuError> {
        self.within_memory(what, || self.device.create_buffer(descriptor))
    }

    fn within_memory<T>(&self, what: &str, make: impl FnOnce() -> T) -> Result<T, GpuError> {
        let scope = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let made = make();
        match pollster::block_on(scope.pop()) {
            Some(_) => Err(self.out_of_memory(what)),
            None => Ok(made),
        }
    }

    fn out_of_memory(&self, what: &str) -> GpuError {
        GpuError::OutOfMemory { what: what.to_owned(), adapter: self.adapter_name.clone() }
    }

    /// Fails if the device could not do something since this was last asked.
    ///
    /// # Errors
    /// [`GpuError::OutOfMemory`] or [`GpuError::Lost`].
    pub fn check(&self) -> Result<(), GpuError> {
        match self.faults.take() {
            Some(Fault::OutOfMemory) => Err(self.out_of_memory("the picture")),
            Some(Fault::Refused(words)) => Err(GpuError::Lost(words)),
            None => Ok(()),
        }
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
    /// [`GpuError::Lost`], and what [`Self::check`] says.
    pub fn wait(&self) -> Result<(), GpuError> {
        self.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|e| GpuError::Lost(e.to_string()))?;
        self.check()
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
    pub fn wait(&self, is_canceled: impl Fn() -> bool) {
        while !self.done.load(Ordering::Acquire) && !is_canceled() {
            std::thread::sleep(Duration::from_millis(1));
            // A lost device shows elsewhere.
            let _ = self.device.poll(wgpu::PollType::Poll);
        }
    }
}

/// The largest picture of the same shape with so many pixels at most; `None` if the picture itself has no more.
fn largest_of_shape(size: [u32; 2], pixels: u64) -> Option<[u32; 2]> {
    let needed = size.map(u64::from).iter().product::<u64>();
    if needed <= pixels {
        return None;
    }
    let shrink = (pixels as f64 / needed as f64).sqrt();
    Some(size.map(|side| (f64::from(side) * shrink).floor().max(1.0) as u32))
}

/// Never more than there are.
fn megapixels(pixels: u64) -> f64 {
    (pixels as f64 * 1e-5).floor() * 0.1
}

/// How much of a device's memory is used before what is asked for is refused, in percent. A software device would take it
/// until the system ends the program.
const MAX_MEMORY: u8 = 95;

/// How instances are made: native backends only, no validation layers unless `WGPU_*` variables ask for them.
pub fn instance_descriptor() -> wgpu::InstanceDescriptor {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::from_env()
        .unwrap_or(wgpu::Backends::VULKAN | wgpu::Backends::METAL | wgpu::Backends::DX12);
    descriptor.flags = wgpu::InstanceFlags::empty().with_env();
    descriptor.memory_budget_thresholds.for_resource_creation = Some(MAX_MEMORY);
    descriptor
}

/// What is asked of a device: all that the adapter can do in size, and timers, the choice of instances in indirect draws and
/// numbers of triangles where it has them.
pub fn device_descriptor(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
    wgpu::DeviceDescriptor {
        label: Some("hachure"),
        required_features: adapter.features()
            & (wgpu::Features::TIMESTAMP_QUERY
                | wgpu::Features::INDIRECT_FIRST_INSTANCE
                | wgpu::Features::PRIMITIVE_INDEX),
        required_limits: adapter.limits(),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_that_is_too_large_is_told_how_large_it_may_be() {
        assert_eq!(largest_of_shape([8192, 4096], 1 << 25), None);
        let [width, height] = largest_of_shape([8192, 4320], 1 << 25).unwrap();
        assert!(u64::from(width) * u64::from(height) <= 1 << 25);
        assert!(u64::from(width + 2) * u64::from(height + 2) > 1 << 25, "{width} × {height}");
        assert!((f64::from(width) / f64::from(height) - 8192.0 / 4320.0).abs() < 1e-3);
        let error = GpuError::PictureTooLarge {
            what: "with lines",
            size: [8192, 4320],
            pixels: 1 << 25,
            largest: [width, height],
            adapter: "llvmpipe".to_owned(),
        };
        let text = error.to_string();
        assert!(text.contains("8192 × 4320 pixels with lines is too large for llvmpipe"), "{text}");
        assert!(text.contains("has 33.5 megapixels, for example 79"), "{text}");
    }

    #[test]
    fn what_does_not_fit_into_memory_is_an_error() {
        let gpu = Gpu::headless().unwrap();
        let other = gpu.clone();
        // Terabytes.
        let limits = gpu.device.limits();
        let descriptor = wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d {
                width: limits.max_texture_dimension_2d,
                height: limits.max_texture_dimension_2d,
                depth_or_array_layers: limits.max_texture_array_layers,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba32Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        };
        let error = gpu.create_texture("the lines", &descriptor).unwrap_err().to_string();
        assert!(error.contains("not enough memory left for the lines"), "{error}");
        gpu.check().unwrap();

        // Where nobody looks for it, it is told to whoever waits, and nothing panics.
        let texture = gpu.device.create_texture(&descriptor);
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_texture_to_texture(
            texture.as_image_copy(),
            texture.as_image_copy(),
            wgpu::Extent3d { width: 1, height: 1, depth_or_array_layers: 1 },
        );
        gpu.queue.submit([encoder.finish()]);
        assert!(matches!(gpu.wait(), Err(GpuError::OutOfMemory { .. })));
        assert!(matches!(other.check(), Err(GpuError::OutOfMemory { .. })));
        gpu.wait().unwrap();
    }
}
