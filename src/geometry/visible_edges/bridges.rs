//! Folds that are too weak for creases, but lie between creases that go on in them: lines have no gaps there.
//!
//! What a gap is says [`crate::geometry::feature_edges::hysteresis`]; chains are those of the edges here, for one angle alone.

use glam::Vec3;

use super::LineRules;
use super::world_edge::WorldEdge;
use crate::geometry::feature_edges::hysteresis::{FoldEdge, gaps, rating};
use crate::geometry::line_chains::{ChainEdge, Chains, best_partners};

/// What is flatter, as a share of the angle that makes creases, is no part of a fold.
const LEAST: f32 = 0.5;

/// A fold of which a crease may be made.
struct Candidate {
    edge: u32,
    /// Degrees.
    angle: f32,
    length: f32,
    link: ChainEdge,
    along: Vec3,
}

/// The bridges among some edges: their numbers, sorted.
pub(super) fn find(edges: &[WorldEdge], rules: &LineRules<'_>) -> Vec<u32> {
    let candidates: Vec<Candidate> =
        (0..).zip(edges).filter_map(|(number, edge)| candidate(number, edge, rules)).collect();
    let links: Vec<ChainEdge> = candidates.iter().map(|candidate| candidate.link).collect();
    let candidate = |half: u32| &candidates[half as usize >> 1];
    let leave = |half: u32| if half & 1 == 0 { candidate(half).along } else { -candidate(half).along };
    let partner =
        best_partners(&links, |[a, b]| rating([a, b].map(|half| candidate(half).angle), [a, b].map(leave)));
    let mut bridges = Vec::new();
    for (links, is_closed) in Chains::joined(&partner).iter() {
        let row: Vec<&Candidate> = links.iter().map(|link| &candidates[link.link as usize]).collect();
        let own: Vec<FoldEdge> = row
            .iter()
            .map(|candidate| FoldEdge { angle: candidate.angle, length: candidate.length })
            .collect();
        bridges
            .extend(gaps(&own, is_closed, rules.ridge_valley_angle as f32).into_iter().map(|i| row[i].edge));
    }
    bridges.sort_unstable();
    bridges
}

fn candidate(number: u32, edge: &WorldEdge, rules: &LineRules<'_>) -> Option<Candidate> {
    let whole = edge.whole.filter(|_| !edge.is_soft)?;
    let angle = whole.angle?;
    if angle.abs() < LEAST * rules.ridge_valley_angle as f32 {
        return None;
    }
    let [a, b] = edge.ends;
    Some(Candidate {
        edge: number,
        angle: angle.abs(),
        length: a.distance(b) as f32,
        link: ChainEdge { ends: whole.points.map(Some), kind: u8::from(angle < 0.0) },
        along: (b - a).normalize_or_zero().as_vec3(),
    })
}
