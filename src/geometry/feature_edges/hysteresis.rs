//! Hysteresis of creases: what is a little less sharp counts as sharp between what is.
//!
//! Along one fold of a coarse mesh the angle wavers, and a line that ends wherever it falls below the one that makes creases is a
//! row of dashes. As with Canny's edge detector ("A Computational Approach to Edge Detection", 1986), a weaker edge counts where
//! stronger ones go on from it; here on both sides, so that a fold that fades out ends where it is too weak. Nothing of this
//! depends on which angle makes creases: each edge gets the greatest angle up to which it is one.

use glam::Vec3;
use rayon::prelude::*;

use super::pieces::Piece;
use super::{FeatureEdges, Traits};
use crate::geometry::Mesh;
use crate::geometry::edge::FOLDED;
use crate::geometry::line_chains::{ChainLink, Chains, best_partners};

/// So sharp is what is bridged at least, as a share of the sharpness on its sides.
pub(in crate::geometry) const WEAKEST: f32 = 0.75;
/// Flatter edges (radians, 8°) are nothing that goes on: no crease angle below 13° is in use.
const FLATTEST: f32 = 0.14;
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
        let angles: Vec<f32> = links.iter().map(|link| all.dihedral[edge(link)].abs()).collect();
        for (link, angle) in links.iter().zip(bridged(&angles, is_closed)) {
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

/// Up to which angle each edge of a chain is a part of a crease, of their own angles.
fn bridged(angles: &[f32], is_closed: bool) -> Vec<f32> {
    let reach = |angles: &mut dyn DoubleEndedIterator<Item = &f32>, before: f32| {
        angles
            .scan(before, |before, &angle| {
                *before = angle.max(before.min(angle / WEAKEST));
                Some(*before)
            })
            .collect::<Vec<f32>>()
    };
    let both_ways = |before: [f32; 2]| {
        let onwards = reach(&mut angles.iter(), before[0]);
        let mut back = reach(&mut angles.iter().rev(), before[1]);
        back.reverse();
        [onwards, back]
    };
    let [mut onwards, mut back] = both_ways([0.0; 2]);
    if let (true, Some(&last), Some(&first)) = (is_closed, onwards.last(), back.first()) {
        [onwards, back] = both_ways([last, first]);
    }
    onwards.iter().zip(&back).map(|(a, b)| a.min(*b)).collect()
}

#[cfg(test)]
#[path = "hysteresis_tests.rs"]
mod tests;
