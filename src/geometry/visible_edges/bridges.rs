//! Folds that are too weak for creases, but lie between creases that go on in them: lines have no gaps there.
//!
//! A second way beside that of [`crate::geometry::feature_edges::hysteresis`], for one angle alone: from crease to crease along
//! each fold.

use std::ops::Range;

use glam::Vec3;

use super::LineRules;
use super::world_edge::WorldEdge;
use crate::geometry::feature_edges::hysteresis::{WEAKEST, rating};
use crate::geometry::line_chains::{ChainEdge, Chains, best_partners};

/// A fold of which a crease may be made.
struct Candidate {
    edge: u32,
    /// Degrees.
    angle: f32,
    is_crease: bool,
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
        let creases = row.iter().enumerate().filter(|(_, candidate)| candidate.is_crease).map(|(i, _)| i);
        let between: Range<usize> = match (is_closed, creases.clone().min(), creases.max()) {
            (_, None, _) | (_, _, None) => continue,
            (true, ..) => 0..row.len(),
            (false, Some(first), Some(last)) => first..last,
        };
        bridges.extend(row[between].iter().filter(|candidate| !candidate.is_crease).map(|c| c.edge));
    }
    bridges.sort_unstable();
    bridges
}

fn candidate(number: u32, edge: &WorldEdge, rules: &LineRules<'_>) -> Option<Candidate> {
    let whole = edge.whole.filter(|_| !edge.is_soft)?;
    let (angle, crease) = (whole.angle?, rules.ridge_valley_angle as f32);
    if angle.abs() < WEAKEST * crease {
        return None;
    }
    let [a, b] = edge.ends;
    Some(Candidate {
        edge: number,
        angle: angle.abs(),
        is_crease: angle.abs() >= crease,
        link: ChainEdge { ends: whole.points.map(Some), kind: u8::from(angle < 0.0) },
        along: (b - a).normalize_or_zero().as_vec3(),
    })
}
