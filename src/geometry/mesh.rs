//! The triangle mesh that importers fill and the renderer uploads.

use std::sync::Arc;

use glam::{Vec2, Vec3, Vec4};

use super::mend::Mended;
use super::{BorderLink, Bounds, Rig};

/// Triangles in their node's local coordinates (the file's units).
///
/// Every attribute is either empty or as long as `positions`. Importers guarantee that indices are in range, that
/// positions are finite and that no triangle is degenerate.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Vertex positions, local space, file units.
    pub positions: Vec<Vec3>,
    /// How far each vertex may lie from its place, in units of the mesh, where seams were mended. Empty: no farther than
    /// by rounding.
    pub position_errors: Vec<f32>,
    /// What was done to its seams when it was read, if anything.
    pub mended: Option<Mended>,
    /// Shading normals, unit length, local space. Empty: every face is flat and uses its own geometric normal.
    pub normals: Vec<Vec3>,
    /// Whether `normals` were computed from the triangles. Then they say nothing about the shape that those do not.
    pub has_computed_normals: bool,
    /// Texture coordinates, (0,0) = upper left of the image as in glTF. Empty: none.
    pub uvs: Vec<Vec2>,
    /// Vertex colors, linear RGBA as 8-bit unorm, multiplied into the base color. Empty: white.
    pub colors: Vec<[u8; 4]>,
    /// Tangents (xyz, unit length) and the sign of the bitangent (w, ±1). Empty: none.
    pub tangents: Vec<Vec4>,
    /// Three vertex indices per triangle, counter-clockwise seen from the front.
    pub indices: Vec<u32>,
    /// Consecutive ranges of `indices`, one per material, that cover all of it.
    pub submeshes: Vec<Submesh>,
    /// Its border edges at which another mesh goes on.
    pub border_links: Vec<BorderLink>,
    /// What a skinned mesh needs to be posed again; `None` for all others.
    pub rig: Option<Arc<Rig>>,
}

/// A range of a mesh's triangles that share one material.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Submesh {
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

    /// Whether somebody chose its normals, so that they say more about the shape than the triangles do.
    pub fn has_own_normals(&self) -> bool {
        !self.normals.is_empty() && !self.has_computed_normals
    }

    /// The outermost vertices in evenly spread directions, local space: together nearly the hull of the mesh. Of large
    /// meshes a part of the vertices is looked at, so that it takes a few milliseconds at most; what that misses,
    /// framing finds.
    pub fn extremes(&self) -> Vec<Vec3> {
        const DIRECTIONS: usize = 96;
        const MAX_VERTICES: usize = 20_000;
        let step = (self.positions.len() / MAX_VERTICES).max(1);
        let mut outermost: Vec<usize> = (0..DIRECTIONS)
            .filter_map(|i| {
                // Spherical Fibonacci points.
                let y = 1.0 - (2.0 * i as f32 + 1.0) / DIRECTIONS as f32;
                let (sin, cos) = (i as f32 * 2.399_963).sin_cos();
                let direction = Vec3::new((1.0 - y * y).sqrt() * cos, y, (1.0 - y * y).sqrt() * sin);
                let along = |v: &usize| self.positions.get(*v).map_or(f32::MIN, |p| p.dot(direction));
                (0..self.positions.len()).step_by(step).max_by(|a, b| along(a).total_cmp(&along(b)))
            })
            .collect();
        outermost.sort_unstable();
        outermost.dedup();
        outermost.into_iter().filter_map(|v| self.positions.get(v).copied()).collect()
    }

    /// The box around all positions, local space.
    pub fn bounds(&self) -> Bounds {
        Bounds::of_points(&self.positions)
    }

    /// Corners of each triangle, as indices of vertices.
    pub fn triangles(&self) -> &[[u32; 3]] {
        self.indices.as_chunks().0
    }

    /// The three corner positions of a triangle given by its vertex indices, which must be in range.
    pub fn corners(&self, triangle: [u32; 3]) -> [Vec3; 3] {
        triangle.map(|v| self.positions[v as usize])
    }

    /// The mesh whose vertex `i` is this mesh's vertex `sources[i]`, with all attributes; indices, parts and what is beyond
    /// are left empty. Every source must be in range.
    #[must_use]
    pub fn gather(&self, sources: &[u32]) -> Self {
        fn pick<T: Copy>(from: &[T], sources: &[u32]) -> Vec<T> {
            if from.is_empty() { Vec::new() } else { sources.iter().map(|&v| from[v as usize]).collect() }
        }
        Self {
            positions: pick(&self.positions, sources),
            position_errors: pick(&self.position_errors, sources),
            mended: self.mended,
            normals: pick(&self.normals, sources),
            has_computed_normals: self.has_computed_normals,
            uvs: pick(&self.uvs, sources),
            colors: pick(&self.colors, sources),
            tangents: pick(&self.tangents, sources),
            indices: Vec::new(),
            submeshes: Vec::new(),
            border_links: Vec::new(),
            rig: self.rig.as_ref().map(|r| Arc::new(r.gather(sources))),
        }
    }

    /// Appends a copy of each of these vertices, with all attributes.
    pub fn append_copies(&mut self, sources: &[u32]) {
        let copies = self.gather(sources);
        self.positions.extend(copies.positions);
        self.position_errors.extend(copies.position_errors);
        self.normals.extend(copies.normals);
        self.uvs.extend(copies.uvs);
        self.colors.extend(copies.colors);
        self.tangents.extend(copies.tangents);
        if let (Some(rig), Some(copies)) = (&mut self.rig, copies.rig) {
            Arc::make_mut(rig).append_vertices(&copies);
        }
    }

    /// The same triangles without the vertices that none of them uses; the order of the vertices is kept.
    #[must_use]
    pub fn without_unused_vertices(mut self) -> Self {
        let mut new_index = vec![u32::MAX; self.positions.len()];
        for &v in &self.indices {
            new_index[v as usize] = 0;
        }
        let mut sources = Vec::new();
        for (v, new) in new_index.iter_mut().enumerate() {
            if *new == 0 {
                *new = sources.len() as u32;
                sources.push(v as u32);
            }
        }
        if sources.len() == self.positions.len() {
            return self;
        }
        for v in &mut self.indices {
            *v = new_index[*v as usize];
        }
        Self {
            indices: std::mem::take(&mut self.indices),
            submeshes: std::mem::take(&mut self.submeshes),
            ..self.gather(&sources)
        }
    }
}
