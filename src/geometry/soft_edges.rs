//! Soft edges: those across which the vertex normals say that the surface goes on smoothly, whatever its angle.
//!
//! An edge is soft if the normals of its two sides agree at both of its ends. Up to 60° that is believed. Above, it is
//! believed of a mesh whose author parts the normals where it is sharp: along at least half of the length of all edges
//! above 60°. Boxes and cylinders with averaged normals part them nowhere, and keep their edges.

use glam::{DVec3, Vec3};

use super::edge::FOLDED;
use super::{Edge, EdgeKind, EdgeOverlap, Mesh};

/// Cosine of the angle between two normals up to which they agree: 5°.
const AGREE: f32 = 0.996_195;
/// Angle between triangles (radians) above which agreeing normals alone do not make an edge soft: 60°.
const STEEP: f32 = std::f32::consts::FRAC_PI_3;
/// Share of the length of steep edges at which the normals must differ for those that agree to be believed.
const MIN_PARTED: f64 = 0.5;

/// Which of the edges above the crease angle are creases.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum CreaseRule {
    /// Those that are not soft: where the mesh has vertex normals of its own, and they agree, there is no crease.
    #[default]
    Normals,
    /// All of them.
    Angle,
}

/// The vertex normals that decide; none if nobody chose them.
#[derive(Clone, Copy)]
pub(super) struct SoftNormals<'a>(&'a [Vec3]);

impl<'a> SoftNormals<'a> {
    pub(super) fn new(mesh: &'a Mesh) -> Self {
        let is_usable = mesh.has_own_normals() && mesh.normals.len() == mesh.positions.len();
        Self(if is_usable { &mesh.normals } else { &[] })
    }

    /// Whether the normals at two vertices, which lie at one point, agree. `turned`: one of the triangles is turned
    /// inside out against the other, and its normal may be as well.
    pub(super) fn agree(self, [one, other]: [u32; 2], turned: bool) -> bool {
        if one == other {
            return !self.0.is_empty();
        }
        let normal = |v: u32| self.0.get(v as usize);
        let (Some(one), Some(other)) = (normal(one), normal(other)) else { return false };
        is_alike(*one, *other, turned)
    }

    /// Whether the normals of two edges agree at some point of each, given as (vertices, share of the way from the
    /// first to the second).
    pub(super) fn agree_between(self, places: [([u32; 2], f32); 2]) -> bool {
        let normal = |([a, b], share): ([u32; 2], f32)| {
            let [a, b] = [a, b].map(|v| self.0.get(v as usize));
            Some(a?.lerp(*b?, share))
        };
        let [Some(one), Some(other)] = places.map(normal) else { return false };
        is_alike(one, other, false)
    }
}

/// Whether two vectors have about the same direction. What has none agrees with nothing.
fn is_alike(one: Vec3, other: Vec3, turned: bool) -> bool {
    let product = one.dot(other);
    let product = if turned { product.abs() } else { product };
    product > AGREE * (one.length_squared() * other.length_squared()).sqrt()
}

/// Makes soft edges above 60° hard unless the mesh parts its normals along most of those.
pub(super) fn judge_steep(mesh: &Mesh, edges: &mut [Edge], overlaps: &mut [EdgeOverlap]) {
    let point = |v: u32| mesh.positions.get(v as usize).map_or(DVec3::ZERO, |p| p.as_dvec3());
    let (mut parted, mut all) = (0.0, 0.0);
    let mut count = |length: f64, is_soft: bool| {
        all += length;
        parted += if is_soft { 0.0 } else { length };
    };
    let is_steep = |dihedral: f32| dihedral.abs() > STEEP && dihedral.abs() <= FOLDED;
    let has_two_sides = |edge: &Edge| matches!(edge.kind, EdgeKind::Manifold | EdgeKind::Flipped);
    for edge in edges.iter().filter(|edge| has_two_sides(edge) && is_steep(edge.dihedral)) {
        let [a, b] = edge.vertices.map(point);
        count(a.distance(b), edge.is_soft);
    }
    for overlap in overlaps.iter().filter(|overlap| is_steep(overlap.dihedral)) {
        count(overlap.length, overlap.is_soft);
    }
    if parted >= MIN_PARTED * all {
        return;
    }
    for edge in edges {
        edge.is_soft &= edge.dihedral.abs() <= STEEP;
    }
    for overlap in overlaps {
        overlap.is_soft &= overlap.dihedral.abs() <= STEEP;
    }
}

#[cfg(test)]
#[path = "soft_edges_tests.rs"]
mod tests;
