//! Arrays of structs that shaders read as uniforms.
//!
//! In WGSL an array that a pass writes for its shader is a storage buffer, as it may be of any length. Software devices read such
//! buffers number by number for each pixel of a block, and uniform buffers several times as fast. So an array that fits into a uniform
//! buffer is bound as one: the variable of the shader becomes an array of as many elements as there is room for.

use std::num::NonZeroU32;

use wgpu::naga::{
    AddressSpace, ArraySize, GlobalVariable, Handle, Module, Span, StorageAccess, Type, TypeInner,
    UniqueArena,
};

/// Bytes of a uniform array: what WebGPU promises of every device (`maxUniformBufferBindingSize`).
pub const UNIFORM_BYTES: u64 = 1 << 16;

/// What rows and arrays of uniform structs lie apart, bytes.
const ALIGNMENT: u32 = 16;

/// Whether a variable is an array of structs that is only read, as uniform structs may lie.
pub fn can_be_uniform(module: &Module, variable: &GlobalVariable) -> bool {
    let is_read = variable.space == AddressSpace::Storage { access: StorageAccess::LOAD };
    match module.types[variable.ty].inner {
        TypeInner::Array { base, size: ArraySize::Dynamic, .. } => {
            let is_struct = matches!(module.types[base].inner, TypeInner::Struct { .. });
            is_read
                && is_struct
                && u64::from(stride(module, variable)) <= UNIFORM_BYTES
                && lies_well(&module.types, variable.ty)
        }
        _ => false,
    }
}

fn stride(module: &Module, variable: &GlobalVariable) -> u32 {
    match module.types[variable.ty].inner {
        TypeInner::Array { stride, .. } => stride,
        _ => 0,
    }
}

/// Whether a type is laid out as the uniform address space demands (WGSL, section "Address Space Layout Constraints").
fn lies_well(types: &UniqueArena<Type>, ty: Handle<Type>) -> bool {
    match &types[ty].inner {
        TypeInner::Array { base, stride, .. } => stride % ALIGNMENT == 0 && lies_well(types, *base),
        TypeInner::Struct { members, .. } => {
            let mut free_from = 0;
            members.iter().all(|member| {
                let starts_well = match types[member.ty].inner {
                    TypeInner::Struct { .. } | TypeInner::Array { .. } => member.offset % ALIGNMENT == 0,
                    _ => true,
                };
                let is_apart = member.offset >= free_from;
                if let TypeInner::Struct { span, .. } = types[member.ty].inner {
                    free_from = member.offset + span.next_multiple_of(ALIGNMENT);
                }
                starts_well && is_apart && lies_well(types, member.ty)
            })
        }
        _ => true,
    }
}

/// Makes uniforms of the variables of group 1 with these numbers, which [can be](can_be_uniform).
pub fn make_uniform(module: &mut Module, group: u32, numbers: &[u32]) {
    let Module { global_variables, types, .. } = module;
    for (_, variable) in global_variables.iter_mut() {
        let is_meant =
            |place: &wgpu::naga::ResourceBinding| place.group == group && numbers.contains(&place.binding);
        let TypeInner::Array { base, stride, .. } = types[variable.ty].inner else { continue };
        let Some(count) = NonZeroU32::new(UNIFORM_BYTES as u32 / stride) else { continue };
        if variable.binding.as_ref().is_some_and(is_meant) {
            let inner = TypeInner::Array { base, size: ArraySize::Constant(count), stride };
            variable.ty = types.insert(Type { name: None, inner }, Span::UNDEFINED);
            variable.space = AddressSpace::Uniform;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::bindings::INPUTS;
    use crate::gpu::{ArrayBuffer, Gpu, Pipelines, Program, Shaders, UniformBuffer, inputs, readback};

    const SHADER: &str = "
        struct Vec4 { by: vec4<f32> }
        var<storage, read> turns: array<Vec4>;
        var<storage, read_write> last: array<f32>;
        @compute @workgroup_size(1)
        fn cs_main() { last[0] = turns[u32(turns[0].by.x)].by.w; }
    ";

    #[test]
    fn arrays_are_uniforms_as_long_as_they_fit() {
        let gpu = Gpu::headless().unwrap();
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a.wgsl"), SHADER).unwrap();
        let mut pipelines = Pipelines::of(&gpu, Shaders::in_folder(folder.path()));
        let program = Program::new("a.wgsl", "cs_main");
        let last = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: 4,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let place = UniformBuffer::<glam::Vec4>::new(&gpu, "place");
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor::default());
        let frame = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: pipelines.frame_layout(),
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: place.buffer().as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::Sampler(&sampler) },
            ],
        });
        let mut turns = ArrayBuffer::new(&gpu, "turns");
        let fitting = UNIFORM_BYTES as usize / 16;
        for (count, is_uniform) in [(3, true), (fitting, true), (fitting + 1, false), (2, true)] {
            let mut values = vec![glam::Vec4::ZERO; count];
            values[0].x = (count - 1) as f32;
            values[count - 1].w = count as f32;
            turns.write(&gpu, &values);
            let inputs = inputs! { turns: &turns, last: &last };
            assert_eq!(pipelines.uniforms(&gpu, &program, &inputs).unwrap().len(), usize::from(is_uniform));
            let bound = pipelines.compute(&gpu, &program, &inputs).unwrap();
            let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&bound.pipeline);
            pass.set_bind_group(0, &frame, &[]);
            pass.set_bind_group(INPUTS, &bound.inputs, &[]);
            pass.dispatch_workgroups(1, 1, 1);
            drop(pass);
            gpu.queue.submit([encoder.finish()]);
            let bytes = readback::read_buffer(&gpu, &last).unwrap();
            assert_eq!(bytemuck::pod_read_unaligned::<f32>(&bytes), count as f32, "{count} elements");
        }
    }
}
