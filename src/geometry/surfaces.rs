//! Smooth surfaces: triangles that are connected without crossing a crease.

use std::collections::HashMap;

use rayon::prelude::*;

use super::disjoint_sets::DisjointSets;
use super::edge::NO_FACE;
use super::{Adjacency, Edge, EdgeKind, Mesh};

/// The surfaces of a mesh for one crease angle.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Surfaces {
    /// The surface of each triangle, 0 to `count - 1`, numbered by their first triangle.
    pub of_triangle: Vec<u32>,
    /// Number of surfaces.
    pub count: usize,
}

impl Edge {
    /// Whether a surface goes on across this edge: two triangles, and no crease above `crease_angle` (radians).
    pub fn is_smooth(&self, crease_angle: f32) -> bool {
        matches!(self.kind, EdgeKind::Manifold | EdgeKind::Flipped) && !self.is_crease(crease_angle)
    }
}

impl Adjacency {
    /// The connected surfaces when creases above `crease_angle` (radians), borders and non-manifold edges separate
    /// them.
    pub fn surfaces(&self, crease_angle: f32) -> Surfaces {
        let sets = DisjointSets::new(self.face_count);
        self.edges.par_iter().with_min_len(16_384).for_each(|edge| {
            if edge.is_smooth(crease_angle) {
                sets.unite(edge.faces[0], edge.faces[1]);
            }
        });
        for overlap in &self.overlaps {
            if !overlap.is_crease(crease_angle) {
                sets.unite(overlap.faces[0], overlap.faces[1]);
            }
        }
        // A triangle that welding made a line belongs to whatever it borders on.
        for &(face, neighbor) in &self.collapsed {
            if neighbor != NO_FACE {
                sets.unite(face, neighbor);
            }
        }
        let (of_triangle, count) = sets.numbered();
        Surfaces { of_triangle, count }
    }
}

/// A mesh's indices, arranged so that the first vertex of every triangle (the provoking vertex of WebGPU's flat
/// interpolation) carries the triangle's surface.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Provoking {
    /// The mesh's indices, each triangle rotated (never mirrored); some refer to the appended vertices.
    pub indices: Vec<u32>,
    /// Vertices to copy, in order, behind the mesh's own ([`Mesh::append_copies`]).
    pub duplicates: Vec<u32>,
    /// The surface of each vertex, the mesh's own and then the copies; 0 where no triangle asks.
    pub surface_of_vertex: Vec<u32>,
}

/// Gives every triangle a first vertex that belongs to its surface, with as few new vertices as a greedy choice finds.
///
/// # Panics
/// When an index is out of range, or `surfaces` was made from another mesh.
pub fn provoking(mesh: &Mesh, surfaces: &Surfaces) -> Provoking {
    const FREE: u32 = u32::MAX;
    const SHARED: u32 = u32::MAX - 1;
    let triangles = mesh.triangles();
    let mut owner = vec![FREE; mesh.positions.len()];
    if surfaces.count <= 1 {
        owner.fill(0);
        return Provoking { indices: mesh.indices.clone(), duplicates: Vec::new(), surface_of_vertex: owner };
    }

    // A vertex that only one surface uses is that surface's; only the others are contested.
    for (triangle, &surface) in triangles.iter().zip(&surfaces.of_triangle) {
        for &v in triangle {
            let owner = &mut owner[v as usize];
            *owner = match *owner {
                FREE => surface,
                other if other == surface => surface,
                _ => SHARED,
            };
        }
    }
    for owner in &mut owner {
        if *owner == SHARED {
            *owner = FREE;
        }
    }

    let mut indices = mesh.indices.clone();
    let mut duplicates = Vec::new();
    let mut copies: HashMap<(u32, u32), u32> = HashMap::new();
    for (triangle, &surface) in indices.as_chunks_mut::<3>().0.iter_mut().zip(&surfaces.of_triangle) {
        let owned_by = |o: u32| triangle.iter().position(|&v| owner[v as usize] == o);
        let corner = owned_by(surface).or_else(|| owned_by(FREE));
        if let Some(corner) = corner {
            owner[triangle[corner] as usize] = surface;
            triangle.rotate_left(corner);
            continue;
        }
        let copied = (0..3).find(|&k| copies.contains_key(&(triangle[k], surface)));
        triangle.rotate_left(copied.unwrap_or(0));
        triangle[0] = *copies.entry((triangle[0], surface)).or_insert_with(|| {
            duplicates.push(triangle[0]);
            owner.push(surface);
            owner.len() as u32 - 1
        });
    }
    for owner in &mut owner {
        if *owner == FREE {
            *owner = 0;
        }
    }
    Provoking { indices, duplicates, surface_of_vertex: owner }
}

#[cfg(test)]
#[path = "surfaces_tests.rs"]
mod tests;
