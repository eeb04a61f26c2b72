//! The triangle mesh that importers fill and the renderer uploads.

use glam::{Vec2, Vec3, Vec4};

use super::Bounds;

/// Triangles in their node's local coordinates (the file's units).
///
/// Every attribute is either empty or as long as `positions`. Importers guarantee that indices are in range, that
/// positions are finite and that no triangle is degenerate.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Vertex positions, local space, file units.
    pub positions: Vec<Vec3>,
    /// Shading normals, unit length, local space. Empty: every face is flat and uses its own geometric normal.
    pub normals: Vec<Vec3>,
    /// Texture coordinates, (0,0) = upper left of the image as in glTF. Empty: none.
    pub uvs: Vec<Vec2>,
    /// Vertex colours, linear RGBA as 8-bit unorm, multiplied into the base colour. Empty: white.
    pub colors: Vec<[u8; 4]>,
    /// Tangents (xyz, unit length) and the sign of the bitangent (w, ±1). Empty: none.
    pub tangents: Vec<Vec4>,
    /// Three vertex indices per triangle, counter-clockwise seen from the front.
    pub indices: Vec<u32>,
    /// Consecutive ranges of `indices`, one per material, that cover all of it.
    pub parts: Vec<MeshPart>,
}

/// A range of a mesh's triangles that share one material.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MeshPart {
    /// First element of `Mesh::indices`, a multiple of 3.
    pub first_index: u32,
    /// Number of elements of `Mesh::indices`, a multiple of 3.
    pub index_count: u32,
    /// Index into `Scene::materials`.
    pub material: usize,
}

impl Mesh {
    /// Number of triangles.
    pub fn triangle_count(&self) -> usize {
        self.indices.len() / 3
    }

    /// The box around all positions, local space.
    pub fn bounds(&self) -> Bounds {
        Bounds::of_points(&self.positions)
    }
}
