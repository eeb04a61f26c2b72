//! The edges that are lines from all sides, with their ends in space: what chains and straight lines are made of.

use glam::Vec3;

use crate::geometry::line_chains::ChainEdge;

/// An edge with its ends in space.
#[derive(Clone, Copy)]
pub(super) struct Piece {
    /// Index of the edge.
    pub edge: u32,
    /// Only edges of one kind follow each other.
    pub kind: u8,
    pub vertices: [u32; 2],
    /// Local space.
    pub ends: [Vec3; 2],
}

impl Piece {
    /// From its first end to its second one.
    pub(super) fn span(&self) -> Vec3 {
        self.ends[1] - self.ends[0]
    }

    /// The direction from one of its ends along it.
    pub(super) fn leave(&self, end: u32) -> Vec3 {
        let along = self.span().normalize_or_zero();
        if end == 0 { along } else { -along }
    }

    pub(super) fn chain_edge(&self) -> ChainEdge {
        ChainEdge { ends: self.vertices.map(Some), kind: self.kind }
    }
}
