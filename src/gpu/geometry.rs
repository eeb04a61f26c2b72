//! Meshes on the device.

use std::borrow::Cow;

use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3};

use super::{Gpu, GpuError};
use crate::geometry::octahedron::to_octahedron;
use crate::geometry::{Mesh, Provoking};

/// All vertices and indices of a scene in one set of buffers.
#[derive(Clone)]
pub struct GeometryBuffers {
    /// `vec3<f32>` per vertex.
    pub positions: wgpu::Buffer,
    /// `u32` per vertex: the surface id of every triangle that begins with it.
    pub surfaces: wgpu::Buffer,
    /// [`Attributes`] per vertex; `None` when no mesh has any, so that the lean vertex shader does.
    pub attributes: Option<wgpu::Buffer>,
    /// `u32` indices, relative to the mesh's first vertex.
    pub indices: wgpu::Buffer,
    /// Where each mesh lies.
    pub meshes: Vec<MeshRange>,
}

/// Where a mesh lies in the buffers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MeshRange {
    /// Index of its first vertex.
    pub base_vertex: i32,
    /// Index of its first index.
    pub first_index: u32,
}

/// The layout of positions, shader location 0.
pub const POSITIONS: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: 12,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Float32x3],
};

/// The layout of surfaces, shader location 1.
pub const SURFACES: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: 4,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![1 => Uint32],
};

/// A mesh together with what topology found out about it.
#[derive(Clone, Copy)]
pub struct MeshSource<'a> {
    /// The mesh.
    pub mesh: &'a Mesh,
    /// Its surfaces, where they are known.
    pub surfaces: Option<&'a Provoking>,
}

/// What a vertex has beyond its position.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct Attributes {
    /// Octahedral normal; unread where the draw is flat.
    normal: [i16; 2],
    /// Octahedral tangent, sign of the bitangent (0: no tangent), padding.
    tangent: [i16; 4],
    uv: Vec2,
    color: [u8; 4],
}

impl Attributes {
    /// Their layout, shader locations 2 to 5.
    pub const LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
        array_stride: size_of::<Self>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &wgpu::vertex_attr_array![2 => Snorm16x2, 3 => Snorm16x4, 4 => Float32x2, 5 => Unorm8x4],
    };

    fn of(mesh: &Mesh, vertex: usize) -> Self {
        let tangent = mesh.tangents.get(vertex).map_or([0; 4], |t| {
            let [x, y] = to_octahedron(t.truncate());
            [x, y, if t.w < 0.0 { -i16::MAX } else { i16::MAX }, 0]
        });
        Self {
            normal: mesh.normals.get(vertex).map_or([0; 2], |n| to_octahedron(*n)),
            tangent,
            uv: mesh.uvs.get(vertex).copied().unwrap_or(Vec2::ZERO),
            color: mesh.colors.get(vertex).copied().unwrap_or([255; 4]),
        }
    }
}

impl GeometryBuffers {
    /// Binds its indices, and those of its vertex buffers that a pass reads, from a slot on.
    pub fn bind(&self, pass: &mut wgpu::RenderPass<'_>, slot: u32, vertices: &[Option<&wgpu::Buffer>]) {
        for (slot, buffer) in (slot..).zip(vertices) {
            if let Some(buffer) = buffer {
                pass.set_vertex_buffer(slot, buffer.slice(..));
            }
        }
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
    }

    /// Uploads all meshes.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn new(gpu: &Gpu, sources: &[MeshSource<'_>]) -> Result<Self, GpuError> {
        let vertex_count =
            |s: &MeshSource<'_>| s.mesh.positions.len() + s.surfaces.map_or(0, |f| f.duplicates.len());
        let vertices: usize = sources.iter().map(vertex_count).sum();
        let indices: usize = sources.iter().map(|s| s.mesh.indices.len()).sum();
        let vertex_usage = wgpu::BufferUsages::VERTEX;
        let position_buffer = mapped(gpu, "positions", vertices * 12, vertex_usage)?;
        let surface_buffer = mapped(gpu, "surfaces", vertices * 4, vertex_usage)?;
        let index_buffer = mapped(gpu, "indices", indices * 4, wgpu::BufferUsages::INDEX)?;
        let has_attributes = sources.iter().any(|s| {
            let m = s.mesh;
            !(m.normals.is_empty() && m.uvs.is_empty() && m.colors.is_empty())
        });
        let attribute_buffer = has_attributes
            .then(|| mapped(gpu, "attributes", vertices * size_of::<Attributes>(), vertex_usage))
            .transpose()?;

        let mut position_view = view(&position_buffer)?;
        let mut surface_view = view(&surface_buffer)?;
        let mut index_view = view(&index_buffer)?;
        let mut attribute_view = attribute_buffer.as_ref().map(view).transpose()?;
        let mut meshes = Vec::with_capacity(sources.len());
        let (mut vertex, mut index) = (0, 0);
        for source in sources {
            meshes.push(MeshRange { base_vertex: vertex as i32, first_index: index as u32 });
            let mesh = source.mesh;
            let duplicated = source.surfaces.map_or(&[][..], |s| &s.duplicates);
            let own = mesh.positions.len();
            write(&mut position_view, vertex * 12, bytemuck::cast_slice(&mesh.positions));
            let copies: Vec<Vec3> =
                duplicated.iter().filter_map(|v| mesh.positions.get(*v as usize).copied()).collect();
            write(&mut position_view, (vertex + own) * 12, bytemuck::cast_slice(&copies));
            if let Some(surfaces) = source.surfaces {
                write(&mut surface_view, vertex * 4, bytemuck::cast_slice(&surfaces.surface_of_vertex));
            }
            if let Some(buffer) = &mut attribute_view {
                let all: Vec<Attributes> = (0..own)
                    .chain(duplicated.iter().map(|v| *v as usize))
                    .map(|v| Attributes::of(mesh, v))
                    .collect();
                write(buffer, vertex * size_of::<Attributes>(), bytemuck::cast_slice(&all));
            }
            let ordered = source.surfaces.map(|surfaces| by_surface(mesh, surfaces));
            let source_indices = ordered.as_deref().unwrap_or(&mesh.indices);
            write(&mut index_view, index * 4, bytemuck::cast_slice(source_indices));
            vertex += own + duplicated.len();
            index += mesh.indices.len();
        }
        drop((position_view, surface_view, index_view, attribute_view));
        for buffer in [&position_buffer, &surface_buffer, &index_buffer].into_iter().chain(&attribute_buffer)
        {
            buffer.unmap();
        }
        Ok(Self {
            positions: position_buffer,
            surfaces: surface_buffer,
            attributes: attribute_buffer,
            indices: index_buffer,
            meshes,
        })
    }
}

/// The indices of a mesh with the triangles of each part ordered by surface, so that of coplanar surfaces the one with the
/// least id is drawn first: depth layers tell them apart by that.
fn by_surface<'a>(mesh: &Mesh, surfaces: &'a Provoking) -> Cow<'a, [u32]> {
    let surface = |triangle: &[u32; 3]| surfaces.surface_of_vertex.get(triangle[0] as usize).copied();
    let is_ordered = |triangles: &[[u32; 3]]| triangles.is_sorted_by_key(surface);
    let mut ordered = Cow::Borrowed(surfaces.indices.as_slice());
    for part in &mesh.submeshes {
        let range = part.first_index as usize..(part.first_index + part.index_count) as usize;
        let triangles = ordered.get(range.clone()).map(|indices| indices.as_chunks().0);
        if triangles.is_none_or(is_ordered) {
            continue;
        }
        if let Some(indices) = ordered.to_mut().get_mut(range) {
            indices.as_chunks_mut().0.sort_by_key(surface);
        }
    }
    ordered
}

/// Of each triangle of a mesh, in the order in which it is drawn, the corners (indices of [`Mesh::indices`]) as they are drawn.
pub fn triangle_corners(mesh: &Mesh, surfaces: Option<&Provoking>) -> Vec<[u32; 3]> {
    let mut order: Vec<u32> = (0..mesh.triangle_count() as u32).collect();
    let Some(surfaces) = surfaces else {
        return order.iter().map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    };
    let drawn: &[[u32; 3]] = surfaces.indices.as_chunks().0;
    let first = |t: &u32| drawn.get(*t as usize).map_or(0, |triangle| triangle[0]);
    for part in &mesh.submeshes {
        let range = part.first_index as usize / 3..(part.first_index + part.index_count) as usize / 3;
        if let Some(order) = order.get_mut(range) {
            order.sort_by_key(|t| surfaces.surface_of_vertex.get(first(t) as usize).copied());
        }
    }
    let own = mesh.positions.len();
    let source = |v: u32| match (v as usize).checked_sub(own) {
        Some(copy) => surfaces.duplicates.get(copy).copied().unwrap_or(v),
        None => v,
    };
    // Triangles have been rotated.
    let rotation = |t: u32| {
        let triangle = mesh.triangles().get(t as usize);
        triangle.and_then(|triangle| triangle.iter().position(|v| *v == source(first(&t)))).unwrap_or(0)
    };
    let corners = |t: u32| {
        let rotation = rotation(t) as u32;
        [0, 1, 2].map(|c| 3 * t + (c + rotation) % 3)
    };
    order.into_iter().map(corners).collect()
}

fn mapped(gpu: &Gpu, label: &str, bytes: usize, usage: wgpu::BufferUsages) -> Result<wgpu::Buffer, GpuError> {
    let size = (bytes as u64).max(4).next_multiple_of(4);
    let what = format!("the model ({label})");
    gpu.check_buffer_size(&what, size)?;
    gpu.create_buffer(
        &what,
        &wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: true },
    )
}

fn view(buffer: &wgpu::Buffer) -> Result<wgpu::BufferViewMut, GpuError> {
    buffer.get_mapped_range_mut(..).map_err(|e| GpuError::Lost(e.to_string()))
}

fn write(view: &mut wgpu::BufferViewMut, offset: usize, bytes: &[u8]) {
    view.slice(offset..offset + bytes.len()).copy_from_slice(bytes);
}
