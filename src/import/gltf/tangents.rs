//! Tangents for normal maps, where the file gives none: the MikkTSpace that normal maps are baked for.

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
        let uv = self.block.uvs.get(self.vertex(face, corner));
        uv.copied().unwrap_or_default().to_array()
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, corner: usize) {
        if let Some(place) = self.tangents.get_mut(face * 3 + corner) {
            *place = space.map(|s| Vec4::from_array(s.tangent_encoded()));
        }
    }
}

/// Computes tangents for a block that has normals and texture coordinates, and the triangles that use it. Vertices
/// at which tangents differ are split. `indices` must hold whole triangles within the block.
pub(super) fn generate(block: &Block, indices: &[u32]) -> Option<(Block, Vec<u32>)> {
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
