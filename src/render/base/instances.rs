//! What is drawn: instances, and the draw calls that draw them. Consecutive calls that need nothing else bound make up batches;
//! one that the predicate may stop is recorded as one call, which software devices rasterize in one go.

use bytemuck::{Pod, Zeroable};
use glam::{Mat3, Mat4};

use crate::gpu::material::MaterialUniform;
use crate::gpu::{DynamicBuffer, Gpu, GpuError, RecordBuffer, Recorder};
use crate::render::base::gpu_scene::Origin;
use crate::render::base::view::Extent;
use crate::style::color::rgba_from_linear;

/// One part of one object, as it is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instance {
    /// Local to view space.
    pub view_from_local: Mat4,
    /// Inverse transpose of its linear part, up to a positive factor.
    pub normal_from_local: Mat3,
    /// What it is made of.
    pub material: MaterialUniform,
    /// Object id with the enhanced flag.
    pub object: u32,
    /// It has no normals, faces are flat.
    pub is_flat: bool,
    /// Order of its first surface among those of all instances; at least 1.
    pub first_surface: u32,
    /// Number of its first triangle in its mesh.
    pub first_triangle: u32,
    /// How far vertices move along their normals where surfaces are drawn enlarged, px.
    pub enlarged: f32,
}

/// An instance as a vertex shader reads it; twin of `Instance` in `shaders/common/instance.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct Record {
    view_from_local: [[f32; 4]; 4],
    normal_from_local: [[f32; 3]; 3],
    base_color: [f32; 4],
    ids: [u32; 4],
    enlarged: f32,
}

impl From<&Instance> for Record {
    fn from(instance: &Instance) -> Self {
        let base_color = instance.material.base_color();
        let color = u32::from_le_bytes(rgba_from_linear(base_color));
        let normal_from_local = if instance.is_flat { Mat3::ZERO } else { instance.normal_from_local };
        Self {
            view_from_local: instance.view_from_local.to_cols_array_2d(),
            normal_from_local: normal_from_local.to_cols_array_2d(),
            base_color: base_color.to_array(),
            ids: [instance.object, instance.first_surface, color, instance.first_triangle],
            enlarged: instance.enlarged,
        }
    }
}

/// How much the shaders of a draw have to read; less is faster.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Detail {
    /// Positions only: no mesh of the scene has anything more.
    Lean,
    /// Normals too.
    Smooth,
    /// Colors of vertices too.
    Colored,
    /// Images too, and holes.
    Full,
}

/// One draw call.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DrawCall {
    /// Index of its instance.
    pub instance: u32,
    /// The buffers that hold it.
    pub origin: Origin,
    /// Range of the index buffer.
    pub first_index: u32,
    /// Number of indices.
    pub index_count: u32,
    /// Number of its surfaces.
    pub surfaces: u32,
    /// First vertex of the mesh.
    pub base_vertex: i32,
    /// Bind group of the material.
    pub material_group: usize,
    /// Which vertex and fragment shader it needs.
    pub detail: Detail,
    /// The side of its triangles that is left out.
    pub culled_face: Option<wgpu::Face>,
    /// What it covers of the picture at most; `None`: anything.
    pub extent: Option<Extent>,
}

impl DrawCall {
    /// The same with no more than positions, where nobody asks for colors and shading normals. Holes need images.
    #[must_use]
    pub fn without_attributes(&self) -> Self {
        let detail = if self.detail == Detail::Full { Detail::Full } else { Detail::Lean };
        Self { detail, ..*self }
    }

    /// Whether another one needs nothing else bound.
    fn joins(&self, other: &Self) -> bool {
        self.detail != Detail::Full
            && (self.detail, self.origin, self.culled_face) == (other.detail, other.origin, other.culled_face)
    }
}

const RECORD_BYTES: u64 = size_of::<Record>() as u64;

/// The layout of instances, which lie in the first vertex buffer.
pub const INSTANCES: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: RECORD_BYTES,
    step_mode: wgpu::VertexStepMode::Instance,
    attributes: &wgpu::vertex_attr_array![
        6 => Float32x4, 7 => Float32x4, 8 => Float32x4, 9 => Float32x4,
        10 => Float32x3, 11 => Float32x3, 12 => Float32x3, 13 => Float32x4, 14 => Uint32x4, 15 => Float32,
    ],
};

/// Instances on the device.
pub struct InstanceBuffer {
    records: RecordBuffer,
    materials: DynamicBuffer,
}

/// A batch of so many indices is not made longer: software devices rasterize it while they place the next one.
const ENOUGH: u32 = 3 << 12;

/// Calls that need nothing bound between them.
pub struct Batch {
    /// The first of them.
    pub call: DrawCall,
    /// Where in the buffer of instances their own begin to be counted.
    first: u32,
    /// Arguments of each as the device reads them.
    args: Vec<[u32; 5]>,
    /// Where they lie if the predicate may stop them.
    predicated: Option<(wgpu::Buffer, u64)>,
}

impl InstanceBuffer {
    /// Without any.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            records: RecordBuffer::new(gpu, "instances"),
            materials: DynamicBuffer::new::<MaterialUniform>(gpu, "materials"),
        }
    }

    /// The layout of the bind group of the material of an instance.
    pub fn material_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
        DynamicBuffer::layout::<MaterialUniform>(gpu, "material")
    }

    /// Writes all of them; their materials only where one of these calls reads its own.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn write(&mut self, gpu: &Gpu, instances: &[Instance], calls: &[DrawCall]) -> Result<(), GpuError> {
        let records: Vec<Record> = instances.iter().map(Record::from).collect();
        self.records.write(gpu, &records)?;
        if calls.iter().any(|call| call.detail == Detail::Full) {
            let materials: Vec<MaterialUniform> =
                instances.iter().map(|instance| instance.material).collect();
            self.materials.write(gpu, &materials)?;
        }
        Ok(())
    }

    /// The bind group of their materials, of which a draw of full detail binds its own.
    pub fn material_group(&self, gpu: &Gpu, layout: &wgpu::BindGroupLayout) -> wgpu::BindGroup {
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("material"),
            layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: self.materials.binding::<MaterialUniform>(),
            }],
        })
    }

    /// The offset of the material of a call in that group.
    pub fn material_of(&self, call: &DrawCall) -> u32 {
        self.materials.offset(call.instance)
    }

    /// Records a batch. Its vertices are bound already.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, batch: &Batch) {
        pass.set_vertex_buffer(0, self.records.buffer().slice(u64::from(batch.first) * RECORD_BYTES..));
        if let Some((buffer, offset)) = &batch.predicated {
            pass.multi_draw_indexed_indirect(buffer, *offset, batch.args.len() as u32);
            return;
        }
        for [count, _, first, base, instance] in batch.args.iter().copied() {
            pass.draw_indexed(first..first + count, base as i32, instance..instance + 1);
        }
    }
}

/// Groups draw calls into batches. Where the device cannot choose instances in indirect draws, each call is one.
pub fn batches(rec: &mut Recorder<'_>, calls: &[DrawCall]) -> Vec<Batch> {
    let chooses = rec.gpu.device.features().contains(wgpu::Features::INDIRECT_FIRST_INSTANCE);
    let mut batches: Vec<Batch> = Vec::new();
    let mut indices = 0;
    for call in calls {
        let joined = batches.last_mut().filter(|batch| chooses && indices < ENOUGH && batch.call.joins(call));
        indices = if joined.is_some() { indices + call.index_count } else { call.index_count };
        let first = if chooses { 0 } else { call.instance };
        let args = [call.index_count, 1, call.first_index, call.base_vertex as u32, call.instance - first];
        match joined {
            Some(batch) => batch.args.push(args),
            None => batches.push(Batch { call: *call, first, args: vec![args], predicated: None }),
        }
    }
    for batch in &mut batches {
        batch.predicated = rec.predicated(&batch.args);
    }
    batches
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn attributes_lie_where_records_have_them() {
        let offsets: Vec<u64> = INSTANCES.attributes.iter().map(|attribute| attribute.offset).collect();
        let columns = |first: usize, bytes: usize, count: usize| (0..count).map(move |i| first + i * bytes);
        let fields = columns(std::mem::offset_of!(Record, view_from_local), 16, 4)
            .chain(columns(std::mem::offset_of!(Record, normal_from_local), 12, 3))
            .chain([std::mem::offset_of!(Record, base_color), std::mem::offset_of!(Record, ids)])
            .chain([std::mem::offset_of!(Record, enlarged)]);
        assert_eq!(offsets, fields.map(|at| at as u64).collect::<Vec<_>>());
        let last = INSTANCES.attributes.last().unwrap();
        assert_eq!(last.offset + last.format.size(), RECORD_BYTES);
    }
}
