//! Isolated creases: short folds in a smooth surface that are hardly sharp enough and meet no other line.
//!
//! Where a mesh has no normals of its own, the angle alone tells creases. Round parts of coarse meshes exceed it here and
//! there, and the line would be a stray mark. As with Canny's edge detector, what is weak counts where it goes on from
//! something strong: a component of creases that is open, short and nowhere much above the angle is left out.

use crate::geometry::disjoint_sets::DisjointSets;

/// So often the angle that makes creases, a component has none that are sharp beyond doubt.
const MAX_SHARPNESS: f32 = 2.0;
/// How long a component is at most, all its edges together, as a share of the mesh's diagonal.
const MAX_LENGTH: f64 = 0.1;

/// An edge that is a line from all sides.
#[derive(Debug, Clone, Copy)]
pub(in crate::geometry) struct JoinedEdge {
    pub edge: u32,
    /// The points at its ends.
    pub points: [u32; 2],
    /// As a share of the mesh's diagonal.
    pub length: f64,
    /// How often its angle is that which makes creases; infinite for what is more than a crease.
    pub sharpness: f32,
}

impl JoinedEdge {
    fn is_weak(&self) -> bool {
        self.sharpness < MAX_SHARPNESS
    }
}

/// The isolated creases among some edges: their numbers, sorted.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(in crate::geometry) struct IsolatedCreases(Vec<u32>);

impl IsolatedCreases {
    /// Those of these edges, in order; `point_count`: points have smaller numbers.
    pub(in crate::geometry) fn new(
        edges: impl Iterator<Item = JoinedEdge> + Clone,
        point_count: usize,
    ) -> Self {
        if !edges.clone().any(|edge| edge.is_weak()) {
            return Self::default();
        }
        let sets = DisjointSets::new(point_count);
        for [a, b] in edges.clone().map(|edge| edge.points) {
            sets.unite(a, b);
        }
        let (set_of, count) = sets.numbered();
        let mut components = vec![Component::default(); count];
        for set in &set_of {
            components[*set as usize].points += 1;
        }
        let set = |edge: &JoinedEdge| set_of[edge.points[0] as usize] as usize;
        for edge in edges.clone() {
            components[set(&edge)].add(&edge);
        }
        Self(edges.filter(|edge| components[set(edge)].is_isolated()).map(|edge| edge.edge).collect())
    }

    /// Whether an edge is one.
    pub(in crate::geometry) fn contains(&self, edge: u32) -> bool {
        self.0.binary_search(&edge).is_ok()
    }
}

/// Edges that hang together.
#[derive(Debug, Clone, Copy, Default)]
struct Component {
    edges: usize,
    points: usize,
    length: f64,
    has_strong: bool,
}

impl Component {
    fn add(&mut self, edge: &JoinedEdge) {
        self.edges += 1;
        self.length += edge.length;
        self.has_strong |= !edge.is_weak();
    }

    /// What encloses a part of the surface is the outline of a small thing.
    fn is_isolated(&self) -> bool {
        let is_open = self.edges < self.points;
        is_open && !self.has_strong && self.length <= MAX_LENGTH
    }
}

#[cfg(test)]
#[path = "isolated_tests.rs"]
mod tests;
