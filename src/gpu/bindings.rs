//! Bindings by name: what a pass gives to a shader finds its place by the name of the shader's variable, and is checked against
//! that variable's type. Bind group 1 of every shader is numbered by [`number`]; its variables carry no numbers in WGSL.

use std::collections::HashMap;
use std::num::NonZeroU64;

use wgpu::naga::valid::ModuleInfo;
use wgpu::naga::{
    AddressSpace, GlobalVariable, ImageClass, ImageDimension, Module, ResourceBinding, ScalarKind,
    StorageAccess, StorageFormat, TypeInner,
};

use super::buffer::Element;
use super::inputs::{Inputs, Resource};
use super::placeholders::Placeholders;
use super::uniform_arrays::{UNIFORM_BYTES, can_be_uniform};
use super::{Gpu, ShaderError};

/// The bind group of what a pass reads and writes.
pub const INPUTS: u32 = 1;

/// A variable of a shader that a pass has to give something to.
#[derive(Debug, Clone)]
pub struct Binding {
    name: String,
    number: u32,
    ty: wgpu::BindingType,
    /// Of the type of the variable; of an array that grows, of one element.
    bytes: u64,
    /// The struct that it is, or whose array it is.
    struct_name: Option<String>,
    /// Whether it may be a uniform, although it is written as a storage buffer.
    can_be_uniform: bool,
}

/// The bindings of group 1 of a shader.
#[derive(Debug, Clone, Default)]
pub struct Bindings {
    /// All of them.
    all: Vec<Binding>,
    /// Which of them an entry point uses.
    used: HashMap<String, Vec<usize>>,
}

/// Gives the resources of a module that have no number yet theirs in group 1.
pub fn number(module: &mut Module) {
    let is_resource = |variable: &GlobalVariable| {
        matches!(variable.space, AddressSpace::Uniform | AddressSpace::Storage { .. } | AddressSpace::Handle)
    };
    let mut next = 0;
    for (_, variable) in module.global_variables.iter_mut() {
        if variable.binding.is_none() && is_resource(variable) {
            variable.binding = Some(ResourceBinding { group: INPUTS, binding: next });
            next += 1;
        }
    }
}

impl Bindings {
    /// Those of a module with numbers.
    ///
    /// # Errors
    /// The name of a variable of a kind that no pass can give.
    pub fn of(module: &Module, info: &ModuleInfo) -> Result<Self, String> {
        let mut bindings = Self::default();
        let mut handles = Vec::new();
        for (handle, variable) in module.global_variables.iter() {
            let Some(place) = variable.binding.as_ref().filter(|place| place.group == INPUTS) else {
                continue;
            };
            let name = variable.name.clone().unwrap_or_default();
            let inner = &module.types[variable.ty].inner;
            let ty = type_of(variable, inner).ok_or_else(|| name.clone())?;
            let bytes = u64::from(inner.size(module.to_ctx()));
            let element = match *inner {
                TypeInner::Array { base, .. } => base,
                _ => variable.ty,
            };
            let struct_name = module.types[element].name.clone();
            let can_be_uniform = can_be_uniform(module, variable);
            let number = place.binding;
            bindings.all.push(Binding { name, number, ty, bytes, struct_name, can_be_uniform });
            handles.push(handle);
        }
        for (number, entry_point) in module.entry_points.iter().enumerate() {
            let uses = info.get_entry_point(number);
            let used = (0..).zip(&handles).filter(|(_, handle)| !uses[**handle].is_empty());
            bindings.used.insert(entry_point.name.clone(), used.map(|(index, _)| index).collect());
        }
        Ok(bindings)
    }

    /// Those that an entry point uses, whatever its switches.
    fn used_by(&self, entry_point: &str) -> impl Iterator<Item = &Binding> {
        let used = self.used.get(entry_point).map_or(&[][..], Vec::as_slice);
        used.iter().filter_map(|&index| self.all.get(index))
    }

    /// Numbers of the arrays an entry point uses that are bound as uniforms, with these inputs.
    pub fn uniforms(&self, entry_point: &str, inputs: &Inputs<'_>) -> Vec<u32> {
        let is_short = |binding: &&Binding| match inputs.find(&binding.name) {
            Some(Some(Resource::Array(array))) => binding.can_be_uniform && array.is_short(),
            _ => false,
        };
        self.used_by(entry_point).filter(is_short).map(|binding| binding.number).collect()
    }

    /// The layout of what an entry point uses; `uniforms`: numbers of the arrays that are bound as such.
    pub fn layout(
        &self,
        gpu: &Gpu,
        label: &str,
        entry_point: &str,
        visibility: wgpu::ShaderStages,
        uniforms: &[u32],
    ) -> wgpu::BindGroupLayout {
        let entries: Vec<_> = self
            .used_by(entry_point)
            .map(|binding| wgpu::BindGroupLayoutEntry {
                binding: binding.number,
                visibility,
                ty: if uniforms.contains(&binding.number) {
                    buffer_type(wgpu::BufferBindingType::Uniform)
                } else {
                    binding.ty
                },
                count: None,
            })
            .collect();
        gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some(label),
            entries: &entries,
        })
    }

    /// The bind group of what an entry point of `file` uses.
    ///
    /// # Errors
    /// [`ShaderError::Input`]: one is missing, of another type, or there is no such variable.
    pub fn group(
        &self,
        gpu: &Gpu,
        placeholders: &mut Placeholders,
        file: &str,
        entry_point: &str,
        layout: &wgpu::BindGroupLayout,
        uniforms: &[u32],
        inputs: &Inputs<'_>,
    ) -> Result<wgpu::BindGroup, ShaderError> {
        let wrong = |name: &str, problem: String| ShaderError::Input {
            file: file.to_owned(),
            entry_point: entry_point.to_owned(),
            name: name.to_owned(),
            problem,
        };
        if let Some(name) = inputs.names().find(|name| !self.all.iter().any(|b| b.name == *name)) {
            return Err(wrong(name, "the shader has no such variable".to_owned()));
        }
        for binding in self.used_by(entry_point) {
            match inputs.find(&binding.name) {
                None => return Err(wrong(&binding.name, "nothing is given for it".to_owned())),
                Some(None) => placeholders.make(gpu, binding.ty),
                Some(Some(resource)) => {
                    if let Some(problem) = mismatch(binding, resource) {
                        return Err(wrong(&binding.name, problem));
                    }
                }
            }
        }
        let placeholders = &*placeholders;
        let entries: Vec<_> = self
            .used_by(entry_point)
            .filter_map(|binding| {
                let resource = match inputs.find(&binding.name)? {
                    Some(Resource::Target(target)) => wgpu::BindingResource::TextureView(target.view()),
                    Some(Resource::Buffer(buffer)) => buffer.as_entire_binding(),
                    Some(Resource::Array(array)) => {
                        let is_uniform = uniforms.contains(&binding.number);
                        wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                            buffer: array.buffer(),
                            offset: 0,
                            size: NonZeroU64::new(UNIFORM_BYTES).filter(|_| is_uniform),
                        })
                    }
                    Some(Resource::Layers(view)) => wgpu::BindingResource::TextureView(view),
                    Some(Resource::Sampler(sampler)) => wgpu::BindingResource::Sampler(sampler),
                    None => placeholders.find(binding.ty)?,
                };
                Some(wgpu::BindGroupEntry { binding: binding.number, resource })
            })
            .collect();
        Ok(gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(file),
            layout,
            entries: &entries,
        }))
    }
}

fn buffer_type(ty: wgpu::BufferBindingType) -> wgpu::BindingType {
    wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None }
}

/// What a variable is bound as; `None`: as nothing that a pass can give.
fn type_of(variable: &GlobalVariable, inner: &TypeInner) -> Option<wgpu::BindingType> {
    Some(match (variable.space, inner) {
        (AddressSpace::Uniform, _) => buffer_type(wgpu::BufferBindingType::Uniform),
        (AddressSpace::Storage { access }, _) => buffer_type(wgpu::BufferBindingType::Storage {
            read_only: !access.contains(StorageAccess::STORE),
        }),
        (_, TypeInner::Sampler { comparison: false }) => {
            wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering)
        }
        (_, TypeInner::Image { dim: ImageDimension::D2, arrayed, class }) => image_type(*class, *arrayed)?,
        _ => return None,
    })
}

fn image_type(class: ImageClass, arrayed: bool) -> Option<wgpu::BindingType> {
    let view_dimension =
        if arrayed { wgpu::TextureViewDimension::D2Array } else { wgpu::TextureViewDimension::D2 };
    let sampled =
        |sample_type| wgpu::BindingType::Texture { sample_type, view_dimension, multisampled: false };
    Some(match class {
        // Arrays are read through samplers, other textures texel by texel.
        ImageClass::Sampled { kind: ScalarKind::Float, multi: false } => {
            sampled(wgpu::TextureSampleType::Float { filterable: arrayed })
        }
        ImageClass::Sampled { kind: ScalarKind::Uint, multi: false } => {
            sampled(wgpu::TextureSampleType::Uint)
        }
        ImageClass::Depth { multi: false } => sampled(wgpu::TextureSampleType::Depth),
        ImageClass::Storage { format, access } => wgpu::BindingType::StorageTexture {
            access: match (access.contains(StorageAccess::LOAD), access.contains(StorageAccess::STORE)) {
                (true, true) => wgpu::StorageTextureAccess::ReadWrite,
                (true, false) => wgpu::StorageTextureAccess::ReadOnly,
                _ => wgpu::StorageTextureAccess::WriteOnly,
            },
            format: match format {
                StorageFormat::R32Uint => wgpu::TextureFormat::R32Uint,
                StorageFormat::Rg32Uint => wgpu::TextureFormat::Rg32Uint,
                StorageFormat::Rgba32Uint => wgpu::TextureFormat::Rgba32Uint,
                _ => return None,
            },
            view_dimension,
        },
        _ => return None,
    })
}

/// What is wrong with a resource for a variable.
fn mismatch(binding: &Binding, resource: Resource<'_>) -> Option<String> {
    let ty = binding.ty;
    let (kind, fits) = match (ty, resource) {
        (wgpu::BindingType::Texture { sample_type, view_dimension, .. }, Resource::Target(target)) => {
            let own = target.format().sample_type(None, None);
            let same = match sample_type {
                wgpu::TextureSampleType::Float { .. } => {
                    matches!(own, Some(wgpu::TextureSampleType::Float { .. }))
                }
                other => own == Some(other),
            };
            (format!("{:?}", target.format()), same && view_dimension == wgpu::TextureViewDimension::D2)
        }
        (wgpu::BindingType::StorageTexture { format, .. }, Resource::Target(target)) => {
            (format!("{:?}", target.format()), format == target.format())
        }
        (wgpu::BindingType::Texture { view_dimension, .. }, Resource::Layers(_)) => {
            ("an array of images".to_owned(), view_dimension == wgpu::TextureViewDimension::D2Array)
        }
        // A uniform buffer holds one struct, so that another one's is told by its size. Of what is counted in a storage buffer a
        // shader may read the beginning.
        (
            wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, .. },
            Resource::Buffer(buffer),
        ) => {
            let is_longer =
                buffer.size() > binding.bytes && buffer.usage().contains(wgpu::BufferUsages::STORAGE);
            (format!("{} bytes", buffer.size()), buffer.size() == binding.bytes || is_longer)
        }
        (
            wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Storage { .. }, .. },
            Resource::Array(array),
        ) => return array.element().and_then(|element| wrong_element(binding, element)),
        (wgpu::BindingType::Buffer { .. }, Resource::Buffer(_))
        | (wgpu::BindingType::Sampler(_), Resource::Sampler(_)) => return None,
        (_, Resource::Target(target)) => (format!("{:?}", target.format()), false),
        (_, Resource::Buffer(_)) => ("a buffer".to_owned(), false),
        (_, Resource::Array(_)) => ("an array".to_owned(), false),
        (_, Resource::Layers(_)) => ("an array of images".to_owned(), false),
        (_, Resource::Sampler(_)) => ("a sampler".to_owned(), false),
    };
    (!fits).then(|| format!("it is given {kind}, and has the type {ty:?}"))
}

/// What is wrong with what an array holds.
fn wrong_element(binding: &Binding, element: Element) -> Option<String> {
    let Element { name, bytes } = element;
    let expected = binding.struct_name.as_deref();
    let fits = bytes == binding.bytes && expected.is_none_or(|expected| expected == name);
    (!fits).then(|| {
        let expected = expected.unwrap_or("plain numbers");
        format!(
            "it is given an array of {name}, {bytes} bytes each, and is one of {expected}, {} bytes each",
            binding.bytes
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::{ArrayBuffer, Pipelines, Program, Shaders, Target, TargetPool, UniformBuffer, inputs};

    const SHADER: &str = "
        override WITH_OTHER: bool = false;
        var first_tex: texture_storage_2d<r32uint, read>;
        var other_tex: texture_2d<f32>;
        var<storage, read_write> sums: array<u32>;
        var<uniform> place: vec4<f32>;
        struct Vec4 { by: vec4<f32> }
        var<storage, read> turns: array<Vec4>;
        var<storage, read> numbers: array<u32>;
        @compute @workgroup_size(1)
        fn cs_main() {
            sums[0] = textureLoad(first_tex, vec2(0)).x;
            if WITH_OTHER { sums[1] = u32(textureLoad(other_tex, vec2(0), 0).x); }
        }
        @compute @workgroup_size(1)
        fn cs_sums() { sums[0] = 1u; }
        @compute @workgroup_size(1)
        fn cs_place() { sums[0] = u32(place.x); }
        @compute @workgroup_size(1)
        fn cs_turns() { sums[0] = u32(turns[0].by.x); }
        @compute @workgroup_size(1)
        fn cs_numbers() { sums[0] = numbers[0]; }
    ";

    #[test]
    fn inputs_find_their_variables_by_name_and_are_checked() {
        let gpu = Gpu::headless().unwrap();
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a.wgsl"), SHADER).unwrap();
        let shaders = Shaders::in_folder(folder.path());
        shaders.validate("a.wgsl").unwrap();
        let mut pipelines = Pipelines::of(&gpu, shaders);
        let mut pool = TargetPool::default();
        let mut target = |format| pool.get(&gpu, "test", [4, 4], format).unwrap();
        let numbers = target(wgpu::TextureFormat::R32Uint);
        let colors = target(wgpu::TextureFormat::Rgba16Float);
        let sums = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: 64,
            usage: wgpu::BufferUsages::STORAGE,
            mapped_at_creation: false,
        });
        let place = UniformBuffer::<glam::Vec4>::new(&gpu, "place");
        let camera = UniformBuffer::<glam::Mat4>::new(&gpu, "camera");
        let mut bind = |entry_point, inputs: Inputs<'_>| {
            let bound = pipelines.compute(&gpu, &Program::new("a.wgsl", entry_point), &inputs);
            bound.map(|_| ()).map_err(|error| error.to_string())
        };
        // In any order; what there is not is replaced where the shader allows for it.
        let all = inputs! { sums: &sums, other_tex: &colors, first_tex: &numbers };
        assert_eq!(bind("cs_main", all), Ok(()));
        let none = inputs! { first_tex: &numbers, other_tex: None::<&Target>, sums: &sums };
        assert_eq!(bind("cs_main", none), Ok(()));
        // An entry point asks for no more than it reads.
        assert_eq!(bind("cs_sums", inputs! { sums: &sums }), Ok(()));
        assert_eq!(bind("cs_place", inputs! { sums: &sums, place: &place }), Ok(()));
        // Another struct's buffer is told by its size.
        let other = bind("cs_place", inputs! { sums: &sums, place: &camera }).unwrap_err();
        assert!(other.contains("place: it is given 64 bytes"), "{other}");
        // Another struct's array is told by its name, even if its elements are as large.
        let mut turns = ArrayBuffer::new(&gpu, "turns");
        assert_eq!(bind("cs_turns", inputs! { sums: &sums, turns: &turns }), Ok(()), "nothing is in it yet");
        turns.write(&gpu, &vec![glam::Vec4::ONE; 2]);
        assert_eq!(bind("cs_turns", inputs! { sums: &sums, turns: &turns }), Ok(()));
        turns.write(&gpu, &vec![glam::UVec4::ONE; 2]);
        let other = bind("cs_turns", inputs! { sums: &sums, turns: &turns }).unwrap_err();
        let expected =
            "turns: it is given an array of UVec4, 16 bytes each, and is one of Vec4, 16 bytes each";
        assert!(other.contains(expected), "{other}");
        // Plain numbers are told by their size.
        turns.write(&gpu, &vec![1_u32; 2]);
        assert_eq!(bind("cs_numbers", inputs! { sums: &sums, numbers: &turns }), Ok(()));
        turns.write(&gpu, &vec![glam::Vec2::ONE; 2]);
        let other = bind("cs_numbers", inputs! { sums: &sums, numbers: &turns }).unwrap_err();
        let expected =
            "numbers: it is given an array of Vec2, 8 bytes each, and is one of plain numbers, 4 bytes each";
        assert!(other.contains(expected), "{other}");
        let wrong = [
            (inputs! { first_tex: &numbers, sums: &sums }, "other_tex: nothing is given for it"),
            (inputs! { third_tex: &numbers }, "third_tex: the shader has no such variable"),
            (
                inputs! { first_tex: &colors, other_tex: &colors, sums: &sums },
                "first_tex: it is given Rgba16Float",
            ),
            (
                inputs! { first_tex: &numbers, other_tex: &numbers, sums: &sums },
                "other_tex: it is given R32Uint",
            ),
            (
                inputs! { first_tex: &sums, other_tex: &colors, sums: &sums },
                "first_tex: it is given a buffer",
            ),
        ];
        for (inputs, expected) in wrong {
            let message = bind("cs_main", inputs).unwrap_err();
            assert!(
                message.starts_with("shaders/a.wgsl, cs_main, ") && message.contains(expected),
                "{message}"
            );
        }
    }
}
