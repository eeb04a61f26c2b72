//! Tangents for normal maps, where the file gives none: the `MikkTSpace` that normal maps are baked for.

use std::collections::HashMap;

use bevy_mikktspace::{Geometry, TangentSpace, generate_tangents};
use glam::Vec4;

use super::block::{Block, gather};

/// The corners of a block's triangles, as the library asks for them.
struct Corners<'a> {
    block: &'a Block,
    indices: &'a [u32],
    tangents: Vec<Option<Vec4>>,
}

impl Corners<'_> {
    fn vertex(&self, face: usize, corner: usize) -> usize {
        self.indices.get(face * 3 + corner).map_or(usize::MAX, |&i| i as usize)
    }
}

impl Geometry for Corners<'_> {
    fn num_faces(&self) -> usize {
        self.indices.len() / 3
    }

    fn num_vertices_of_face(&self, _face: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        let position = self.block.positions.get(self.vertex(face, corner));
        position.copied().unwrap_or_default().to_array()
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        let normal = self.block.normals.get(self.vertex(face, corner));
        normal.copied().unwrap_or_default().to_array()
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        // The library's v runs upwards like a normal map's green, glTF's downwards.
        let uv = self.block.uvs.get(self.vertex(face, corner)).copied().unwrap_or_default();
        [uv.x, 1.0 - uv.y]
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, corner: usize) {
        if let Some(place) = self.tangents.get_mut(face * 3 + corner) {
            *place = space.map(|s| Vec4::from_array(s.tangent_encoded()));
        }
    }
}

/// The library recurses from triangle to triangle around a vertex; more would endanger the stack.
const MAX_TRIANGLES_AT_A_VERTEX: u32 = 2000;

/// Whether so many triangles meet at a vertex that the library must not be asked. As in the library, vertices with
/// equal position, normal and texture coordinates are one.
fn is_crowded(block: &Block, indices: &[u32]) -> bool {
    if indices.len() / 3 <= MAX_TRIANGLES_AT_A_VERTEX as usize {
        return false;
    }
    let mut counts = HashMap::with_capacity(block.positions.len());
    indices.iter().any(|&index| {
        let vertex = index as usize;
        let (position, normal) = (block.positions.get(vertex), block.normals.get(vertex));
        // Adding 0 makes −0 equal to 0.
        let bits = |v: f32| (v + 0.0).to_bits();
        let key = (
            position.map(|p| p.to_array().map(bits)),
            normal.map(|n| n.to_array().map(bits)),
            block.uvs.get(vertex).map(|uv| uv.to_array().map(bits)),
        );
        let count = counts.entry(key).or_insert(0);
        *count += 1;
        *count > MAX_TRIANGLES_AT_A_VERTEX
    })
}

/// Computes tangents for a block that has normals and texture coordinates, and the triangles that use it. Vertices
/// at which tangents differ are split. `indices` must hold whole triangles within the block, with finite positions.
/// `None` when the tangents cannot be computed.
pub(super) fn generate(block: &Block, indices: &[u32]) -> Option<(Block, Vec<u32>)> {
    if is_crowded(block, indices) {
        return None;
    }
    let mut corners = Corners { block, indices, tangents: vec![None; indices.len()] };
    generate_tangents(&mut corners).ok()?;
    let mut split = HashMap::with_capacity(block.positions.len());
    let mut picks = Vec::with_capacity(block.positions.len());
    let mut tangents = Vec::with_capacity(block.positions.len());
    let mut out = Vec::with_capacity(indices.len());
    for (&index, tangent) in indices.iter().zip(corners.tangents) {
        let tangent = tangent.unwrap_or_else(|| {
            let normal = block.normals.get(index as usize).copied();
            normal.unwrap_or(glam::Vec3::Z).any_orthonormal_vector().extend(1.0)
        });
        let key = (index, tangent.to_array().map(f32::to_bits));
        let vertex = *split.entry(key).or_insert_with(|| {
            picks.push(index);
            tangents.push(tangent);
            picks.len() as u32 - 1
        });
        out.push(vertex);
    }
    let block = Block {
        positions: gather(&block.positions, &picks),
        normals: gather(&block.normals, &picks),
        uvs: gather(&block.uvs, &picks),
        colors: gather(&block.colors, &picks),
        tangents,
        skinning: block.skinning.as_ref().map(|s| s.gathered(&picks)),
    };
    Some((block, out))
}
