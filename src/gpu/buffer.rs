//! Uniform and storage buffers whose layout is derived from Rust types.

use encase::internal::WriteInto;
use encase::{ShaderType, StorageBuffer as StorageBytes, UniformBuffer as UniformBytes};

use super::uniform_arrays::UNIFORM_BYTES;
use super::{Gpu, GpuError};

/// A uniform buffer that holds one `T`.
pub struct UniformBuffer<T> {
    buffer: wgpu::Buffer,
    written: Option<T>,
}

impl<T: ShaderType + WriteInto + PartialEq + Clone> UniformBuffer<T> {
    /// An empty buffer of the right size.
    pub fn new(gpu: &Gpu, label: &str) -> Self {
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: T::min_size().get(),
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { buffer, written: None }
    }

    /// Writes a value, unless it is there already.
    pub fn write(&mut self, gpu: &Gpu, value: &T) {
        if self.written.as_ref() == Some(value) {
            return;
        }
        let mut bytes = UniformBytes::new(Vec::new());
        // Writing into a growing vector cannot fail.
        if bytes.write(value).is_ok() {
            gpu.queue.write_buffer(&self.buffer, 0, bytes.as_ref());
        }
        self.written = Some(value.clone());
    }
}

impl<T> UniformBuffer<T> {
    /// The buffer itself.
    pub fn buffer(&self) -> &wgpu::Buffer {
        &self.buffer
    }
}

/// A uniform buffer that holds many `T`, of which a draw sees the one at its dynamic offset; grows with their number.
pub struct DynamicBuffer {
    buffer: wgpu::Buffer,
    stride: u64,
    label: &'static str,
}

impl DynamicBuffer {
    /// The layout of a bind group that holds nothing but one element at a dynamic offset.
    pub fn layout<T: ShaderType>(gpu: &Gpu, label: &str) -> wgpu::BindGroupLayout {
        gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some(label),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: true,
                    min_binding_size: Some(T::min_size()),
                },
                count: None,
            }],
        })
    }

    /// An empty one for elements of type `T`.
    pub fn new<T: ShaderType>(gpu: &Gpu, label: &'static str) -> Self {
        let alignment = u64::from(gpu.device.limits().min_uniform_buffer_offset_alignment);
        let stride = T::min_size().get().next_multiple_of(alignment.max(1));
        Self { buffer: Self::create(gpu, label, stride), stride, label }
    }

    fn create(gpu: &Gpu, label: &str, size: u64) -> wgpu::Buffer {
        gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        })
    }

    /// Writes all elements.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn write<T: ShaderType + WriteInto>(&mut self, gpu: &Gpu, values: &[T]) -> Result<(), GpuError> {
        let mut bytes = vec![0; values.len() * self.stride as usize];
        for (value, slot) in values.iter().zip(bytes.chunks_mut(self.stride as usize)) {
            let mut one = UniformBytes::new(Vec::new());
            if one.write(value).is_ok() {
                let one: &[u8] = one.as_ref();
                slot[..one.len()].copy_from_slice(one);
            }
        }
        gpu.check_buffer_size(self.label, bytes.len() as u64)?;
        if self.buffer.size() < bytes.len() as u64 {
            self.buffer = Self::create(gpu, self.label, (bytes.len() as u64).next_power_of_two());
        }
        gpu.queue.write_buffer(&self.buffer, 0, &bytes);
        Ok(())
    }

    /// The dynamic offset of an element.
    pub fn offset(&self, index: u32) -> u32 {
        index * self.stride as u32
    }

    /// What a bind group has to hold.
    pub fn binding<T: ShaderType>(&self) -> wgpu::BindingResource<'_> {
        wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: &self.buffer,
            offset: 0,
            size: Some(T::min_size()),
        })
    }
}

/// What an array holds, as far as it can be compared with what a shader expects.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Element {
    /// The type, by the name that it has in WGSL if it is a struct.
    pub name: &'static str,
    /// Bytes from one to the next; of a struct that ends with an array, with the first one.
    pub bytes: u64,
}

impl Element {
    /// Of an array, or of a struct that ends with one. `GpuToonStyle` and `ScaleBarUniform` are `ToonStyle` and `ScaleBar` in WGSL.
    fn of<T: ShaderType>() -> Self {
        let path = std::any::type_name::<T>().trim_end_matches(['>', ']']);
        let name = path.rsplit([':', '<', '[']).next().unwrap_or(path);
        let name = name.strip_prefix("Gpu").unwrap_or(name);
        Self { name: name.strip_suffix("Uniform").unwrap_or(name), bytes: T::min_size().get() }
    }
}

/// A read-only buffer that holds an array and grows with it, which shaders read as a uniform where it is short enough.
pub struct ArrayBuffer {
    buffer: wgpu::Buffer,
    /// How many of its bytes have been written.
    written: u64,
    element: Option<Element>,
    label: &'static str,
}

impl ArrayBuffer {
    /// An empty array.
    pub fn new(gpu: &Gpu, label: &'static str) -> Self {
        Self { buffer: Self::create(gpu, label, UNIFORM_BYTES), written: 0, element: None, label }
    }

    fn create(gpu: &Gpu, label: &str, size: u64) -> wgpu::Buffer {
        gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        })
    }

    /// Writes the whole array, or a struct that ends with one; it must not be empty, as WGSL arrays are not.
    pub fn write<T: ShaderType + WriteInto>(&mut self, gpu: &Gpu, values: &T) {
        let mut bytes = StorageBytes::new(Vec::new());
        if bytes.write(values).is_err() {
            return;
        }
        let bytes: &[u8] = bytes.as_ref();
        let needed = bytes.len() as u64;
        if self.buffer.size() < needed {
            self.buffer = Self::create(gpu, self.label, needed.next_power_of_two());
        }
        gpu.queue.write_buffer(&self.buffer, 0, bytes);
        self.written = needed;
        self.element = Some(Element::of::<T>());
    }

    /// Whether it is short enough for a uniform.
    pub(super) fn is_short(&self) -> bool {
        self.written <= UNIFORM_BYTES
    }

    /// What was written; `None`: nothing yet.
    pub(super) fn element(&self) -> Option<Element> {
        self.element
    }

    /// The buffer itself.
    pub(super) fn buffer(&self) -> &wgpu::Buffer {
        &self.buffer
    }
}

/// A buffer of plain records, which shaders read word by word or as vertices; grows with their number.
pub struct RecordBuffer {
    buffer: wgpu::Buffer,
    label: &'static str,
}

impl RecordBuffer {
    /// An empty one.
    pub fn new(gpu: &Gpu, label: &'static str) -> Self {
        Self { buffer: gpu.device.create_buffer(&Self::descriptor(label, 256)), label }
    }

    fn descriptor(label: &'static str, size: u64) -> wgpu::BufferDescriptor<'static> {
        wgpu::BufferDescriptor {
            label: Some(label),
            size,
            usage: wgpu::BufferUsages::STORAGE
                | wgpu::BufferUsages::VERTEX
                | wgpu::BufferUsages::COPY_DST
                | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        }
    }

    /// Writes all records.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn write<T: bytemuck::NoUninit>(&mut self, gpu: &Gpu, records: &[T]) -> Result<(), GpuError> {
        let bytes: &[u8] = bytemuck::cast_slice(records);
        self.reserve(gpu, bytes.len() as u64)?;
        gpu.queue.write_buffer(&self.buffer, 0, bytes);
        Ok(())
    }

    /// Makes room for so many bytes, with undefined contents.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn reserve(&mut self, gpu: &Gpu, bytes: u64) -> Result<(), GpuError> {
        gpu.check_storage_size(self.label, bytes)?;
        if self.buffer.size() < bytes {
            let roomy = bytes.next_power_of_two().min(gpu.max_storage());
            self.buffer = gpu.create_buffer(self.label, &Self::descriptor(self.label, roomy))?;
        }
        Ok(())
    }

    /// The buffer itself.
    pub fn buffer(&self) -> &wgpu::Buffer {
        &self.buffer
    }
}
