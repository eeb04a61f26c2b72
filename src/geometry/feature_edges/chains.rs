//! Chains of the edges that are lines from all sides: creases, borders and where materials meet.

use std::sync::Arc;

use glam::Vec3;

use super::crease_angles::CreaseAngles;
use super::isolated::{IsolatedCreases, JoinedEdge};
use super::pieces::Piece;
use super::{FeatureEdges, Traits};
use crate::geometry::Mesh;
use crate::geometry::line_chains::{ChainEdge, Chains};

/// Cosine of the angle by which a chain may turn at a point: 60°.
const MAX_TURN: f32 = 0.5;

/// An edge that is in a chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::geometry) struct ChainedEdge {
    pub edge: u32,
    pub chain: u32,
    /// Its number in [`FeatureChains::chains`].
    pub link: u32,
}

/// The chains for some angles. Their links are counted along the chains.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::geometry) struct FeatureChains {
    /// Sorted.
    pub by_edge: Vec<ChainedEdge>,
    /// The edge of each link.
    pub edges: Vec<u32>,
    /// The links of these are indices into `edges`.
    pub chains: Chains,
    /// The fixed point of each chain, its middle: the place of a link in the chain, and a part of that link from where
    /// the chain enters it, 0 to 1.
    pub anchors: Vec<(u32, f32)>,
}

impl FeatureEdges {
    /// The chains for these angles; made when they are asked for first.
    pub(in crate::geometry) fn chains(&self, mesh: &Mesh, angles: CreaseAngles) -> Arc<FeatureChains> {
        self.cached_chains.get(angles, || FeatureChains::new(self, mesh, angles))
    }

    /// The isolated creases for these angles; made when they are asked for first. None where
    /// [`crate::geometry::Adjacency::leaves_out_isolated`] says so.
    pub(in crate::geometry) fn isolated(&self, mesh: &Mesh, angles: CreaseAngles) -> Arc<IsolatedCreases> {
        self.cached_isolated.get(angles, || {
            if !self.leaves_out_isolated {
                return IsolatedCreases::default();
            }
            let diagonal = self.bounds.diagonal();
            let joined = |edge: u32| {
                let points = self.ends[edge as usize];
                let [a, b] = points.map(|v| mesh.positions[v as usize].as_dvec3());
                let length = a.distance(b) / diagonal;
                JoinedEdge { edge, points, length, sharpness: self.sharpness(edge, angles) }
            };
            let is_line = |edge: &u32| self.kind(*edge as usize, angles).is_some();
            IsolatedCreases::new((0..self.len() as u32).filter(is_line).map(joined), mesh.positions.len())
        })
    }

    /// As [`JoinedEdge::sharpness`].
    fn sharpness(&self, edge: u32, angles: CreaseAngles) -> f32 {
        let more = Traits::BORDER.union(Traits::MATERIAL).union(Traits::NON_MANIFOLD);
        let angle = self.dihedral[edge as usize];
        let least = if angle < 0.0 { angles.valley } else { angles.ridge };
        if self.traits[edge as usize].any(more) { f32::INFINITY } else { angle.abs() / least }
    }

    /// All edges that are lines from all sides, for these angles.
    pub(super) fn pieces(&self, mesh: &Mesh, angles: CreaseAngles) -> Vec<Piece> {
        (0..self.len())
            .filter_map(|edge| {
                let kind = self.kind(edge, angles)?;
                let vertices = *self.ends.get(edge)?;
                let [a, b] = vertices.map(|v| mesh.positions.get(v as usize).copied());
                Some(Piece { edge: edge as u32, kind, vertices, ends: [a?, b?] })
            })
            .collect()
    }

    /// `None` for edges that are lines only as silhouettes.
    fn kind(&self, edge: usize, angles: CreaseAngles) -> Option<u8> {
        let (&traits, &dihedral) = (self.traits.get(edge)?, self.dihedral.get(edge)?);
        let is_hard = !traits.any(Traits::SOFT);
        let kinds = [
            traits.any(Traits::NON_MANIFOLD),
            traits.any(Traits::BORDER),
            is_hard && dihedral >= angles.ridge,
            is_hard && dihedral <= -angles.valley,
            traits.any(Traits::MATERIAL),
        ];
        kinds.iter().position(|is| *is).map(|kind| kind as u8)
    }
}

impl FeatureChains {
    fn new(all: &FeatureEdges, mesh: &Mesh, angles: CreaseAngles) -> Self {
        let pieces = all.pieces(mesh, angles);
        let edges: Vec<u32> = pieces.iter().map(|piece| piece.edge).collect();
        let links: Vec<ChainEdge> = pieces.iter().map(Piece::chain_edge).collect();
        let leave =
            |half: u32| pieces.get(half as usize >> 1).map_or(Vec3::ZERO, |piece| piece.leave(half & 1));
        let chains = Chains::new(&links, |a, b| leave(a).dot(leave(b)) <= -MAX_TURN);
        let mut by_edge = Vec::with_capacity(edges.len());
        let mut anchors = Vec::with_capacity(chains.starts.len());
        let mut link = 0;
        for (chain, (own, is_closed)) in (0..).zip(chains.iter()) {
            let lengths: Vec<f32> = own
                .iter()
                .filter_map(|l| pieces.get(l.link as usize))
                .map(|piece| piece.span().length())
                .collect();
            // A loop is held where it begins.
            anchors.push(if is_closed { (0, 0.0) } else { middle(&lengths) });
            for l in own {
                let edge = edges.get(l.link as usize).copied().unwrap_or(0);
                by_edge.push(ChainedEdge { edge, chain, link });
                link += 1;
            }
        }
        by_edge.sort_unstable();
        Self { by_edge, edges, chains, anchors }
    }
}

/// Where half of the whole length is reached: an index and a part of that length.
fn middle(lengths: &[f32]) -> (u32, f32) {
    let mut left = 0.5 * lengths.iter().sum::<f32>();
    for (i, &length) in (0..).zip(lengths) {
        if left <= length && length > 0.0 {
            return (i, left / length);
        }
        left -= length;
    }
    (0, 0.0)
}
