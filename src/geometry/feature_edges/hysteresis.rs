//! Hysteresis of creases: what is a little less sharp counts as sharp between what is.
//!
//! Along one fold of a coarse mesh the angle wavers, and a line that ends wherever it falls below the one that makes creases is a
//! row of dashes. As with Canny's edge detector ("A Computational Approach to Edge Detection", 1986), a weaker edge counts where
//! stronger ones go on from it; here on both sides and no longer than these, so that a fold that fades out ends where it is too weak.
//! Nothing of this depends on which angle makes creases: each edge gets the greatest angle up to which it is one.

use glam::Vec3;
use rayon::prelude::*;

use super::pieces::Piece;
use super::{FeatureEdges, Traits};
use crate::geometry::Mesh;
use crate::geometry::edge::FOLDED;
use crate::geometry::line_chains::{ChainLink, Chains, best_partners};

/// So sharp is what is bridged at least, as a share of the sharpness on its sides.
const WEAKEST: f32 = 0.75;
/// Flatter edges (radians, 8°) are nothing that goes on: no crease angle below 13° is in use.
const FLATTEST: f32 = 0.14;
/// Up to this angle (radians, 60°) gaps are closed.
const SHARPEST: f32 = std::f32::consts::FRAC_PI_3;
/// Cosine of the angle by which a fold may turn at a point: 45°.
const MAX_TURN: f32 = std::f32::consts::FRAC_1_SQRT_2;

/// Gives edges between sharper ones of the same fold the angle up to which those go on.
pub(super) fn bridge_gaps(all: &mut FeatureEdges, mesh: &Mesh) {
    let pieces: Vec<Piece> =
        (0..all.len()).into_par_iter().filter_map(|edge| piece(all, mesh, edge)).collect();
    if pieces.is_empty() {
        return;
    }
    let links: Vec<_> = pieces.iter().map(Piece::chain_edge).collect();
    let angle = |half: u32| all.dihedral[pieces[half as usize >> 1].edge as usize].abs();
    let leave = |half: u32| pieces[half as usize >> 1].leave(half & 1);
    let partner = best_partners(&links, |[a, b]| rating([angle(a), angle(b)], [leave(a), leave(b)]));
    // Of two edges none is between others.
    for (links, is_closed) in Chains::joined(&partner).iter().filter(|(links, _)| links.len() > 2) {
        let edge = |link: &ChainLink| pieces[link.link as usize].edge as usize;
        let of = |link: &ChainLink| FoldEdge {
            angle: all.dihedral[edge(link)].abs(),
            length: pieces[link.link as usize].span().length(),
        };
        let own: Vec<FoldEdge> = links.iter().map(of).collect();
        for (link, angle) in links.iter().zip(bridged(&own, is_closed)) {
            let dihedral = &mut all.dihedral[edge(link)];
            *dihedral = angle.copysign(*dihedral);
        }
    }
}

/// How well one edge goes on in another: the sharper and straighter the better. Of their angles and the directions in which they leave
/// the point where they meet; `None`: they turn too much there.
pub(in crate::geometry) fn rating(angles: [f32; 2], leaving: [Vec3; 2]) -> Option<f32> {
    let cosine = -leaving[0].dot(leaving[1]);
    (cosine >= MAX_TURN).then(|| cosine * angles[0].min(angles[1]))
}

/// An edge that can be a part of a fold: of a ridge or of a valley.
fn piece(all: &FeatureEdges, mesh: &Mesh, edge: usize) -> Option<Piece> {
    let (angle, traits) = (all.dihedral[edge], all.traits[edge]);
    let other = Traits::BORDER.union(Traits::NON_MANIFOLD).union(Traits::SOFT);
    if !(FLATTEST..=FOLDED).contains(&angle.abs()) || traits.any(other) {
        return None;
    }
    let vertices = all.ends[edge];
    let [a, b] = vertices.map(|v| mesh.positions.get(v as usize).copied());
    let ends: [Vec3; 2] = [a?, b?];
    Some(Piece { edge: edge as u32, kind: u8::from(angle < 0.0), vertices, ends })
}

/// An edge of a chain: its angle, in the unit of the crease angle, and its length, in any unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::geometry) struct FoldEdge {
    pub angle: f32,
    pub length: f32,
}

/// Up to which angle each edge of a chain is a part of a crease, by whole degrees; at least its own.
fn bridged(chain: &[FoldEdge], is_closed: bool) -> Vec<f32> {
    let mut angles: Vec<f32> = chain.iter().map(|edge| edge.angle).collect();
    let sharpest = angles.iter().fold(0.0_f32, |a, b| a.max(*b)).min(SHARPEST);
    let flattest = angles.iter().fold(SHARPEST, |a, b| a.min(*b));
    for degrees in flattest.to_degrees().ceil() as u32..=sharpest.to_degrees() as u32 {
        let crease = (degrees as f32).to_radians();
        for gap in gaps(chain, is_closed, crease) {
            angles[gap] = angles[gap].max(crease);
        }
    }
    angles
}

/// Which edges of a chain are bridges for a crease angle: what is little weaker between two rows of creases that are, together, at
/// least as long. Single sharp edges of a soft fold, such as slivers, do not make a crease of all of it.
pub(in crate::geometry) fn gaps(chain: &[FoldEdge], is_closed: bool, crease: f32) -> Vec<usize> {
    let is_crease = |i: usize| chain[i].angle >= crease;
    let kind = |i: usize| (is_crease(i), chain[i].angle >= WEAKEST * crease);
    let length = |row: &[usize]| row.iter().map(|&i| chain[i].length).sum::<f32>();
    let count = chain.len();
    // A loop is cut where one row ends.
    let cut = if is_closed { (1..count).find(|&i| kind(i) != kind(i - 1)).unwrap_or(0) } else { 0 };
    let order: Vec<usize> = (0..count).map(|i| (cut + i) % count).collect();
    let rows: Vec<&[usize]> = order.chunk_by(|&a, &b| kind(a) == kind(b)).collect();
    let ends: [&[usize]; 2] = match (rows.first(), rows.last()) {
        (Some(first), Some(last)) if is_closed => [last, first],
        _ => [&[]; 2],
    };
    let rows: Vec<&[usize]> = [&ends[..1], &rows, &ends[1..]].concat();
    let mut found = Vec::new();
    for window in rows.windows(3) {
        let [before, row, after] = [window[0], window[1], window[2]];
        let is_between = [before, after].iter().all(|row| row.first().is_some_and(|&i| is_crease(i)));
        // Of a loop it may be the same row.
        let both = length(before) + if before == after { 0.0 } else { length(after) };
        if is_between && kind(row[0]) == (false, true) && length(row) <= both {
            found.extend_from_slice(row);
        }
    }
    found
}

#[cfg(test)]
#[path = "hysteresis_tests.rs"]
mod tests;
