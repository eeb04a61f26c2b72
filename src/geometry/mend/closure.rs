//! Which of the gaps between border edges are cracks.
//!
//! Polylines of one curve touch or cross again and again. A clearance, a tile joint or a slot does not.

use rayon::prelude::*;

use super::borders::{Borders, NO_BORDER};
use super::limits::Limits;
use super::proximity::SubEdges;

/// The gap must fall to this share of what it is.
const FALL: f64 = 0.25;
/// Unmatched pieces up to this many times the gap are stepped over.
const STEP: f64 = 3.0;
/// Of a longer walk along a border, the end is not looked for.
const MAX_STEPS: usize = 600;
/// Cosine of the sharpest turn of a border that is walked along.
const COS_TURN: f64 = -0.5;
/// Length share of overlapping sub-edges, among those that do not close, from which on they are cracks too.
const CRACKED: f64 = 0.2;
/// Least share of the gap by which two sides must overlap to count.
const OVERLAP: f64 = 0.1;
/// The largest gap that a cracked mesh is given, as a multiple of the 95th percentile.
const MARGIN: f64 = 2.0;

/// The sub-edges that are joined, and how many times wider than usual gaps may be that need no closure.
pub(super) struct Closed {
    pub(super) is_closed: Vec<bool>,
    pub(super) opening: f64,
}

/// A sub-edge that is not closed.
struct OpenSubEdge {
    /// In usual open gaps.
    gap: f64,
    is_overlap: bool,
    length: f64,
}

/// Decides for each sub-edge. Where many of the gaps that do not close are overlaps, which no designer leaves, the mesh
/// is cracked also where the corners of patches should meet, and its own gaps tell how wide cracks are (step 5).
pub(super) fn closed(borders: &Borders, sub_edges: &SubEdges, limits: &Limits) -> Closed {
    let is_closed = decide(borders, sub_edges, limits, 1.0);
    let mut left: Vec<OpenSubEdge> = sub_edges
        .list
        .iter()
        .zip(&is_closed)
        .filter(|(_, closed)| !**closed)
        .filter_map(|(sub_edge, _)| {
            let partner = sub_edge.partner?;
            let usual = limits.open_gap(borders.get(sub_edge.border), borders.get(partner.border));
            Some(OpenSubEdge {
                gap: partner.gap / usual,
                is_overlap: partner.opening < -OVERLAP * partner.gap,
                length: sub_edge.length(borders),
            })
        })
        .collect();
    let all: f64 = left.iter().map(|open| open.length).sum();
    let overlapping: f64 = left.iter().filter(|open| open.is_overlap).map(|open| open.length).sum();
    if all == 0.0 || overlapping < CRACKED * all {
        return Closed { is_closed, opening: 1.0 };
    }
    left.sort_by(|a, b| a.gap.total_cmp(&b.gap));
    let mut so_far = 0.0;
    let percentile = left.iter().find(|open| {
        so_far += open.length;
        so_far >= 0.95 * all
    });
    let opening = percentile.map_or(1.0, |open| (MARGIN * open.gap).max(1.0));
    Closed { is_closed: decide(borders, sub_edges, limits, opening), opening }
}

fn decide(borders: &Borders, sub_edges: &SubEdges, limits: &Limits, opening: f64) -> Vec<bool> {
    (0..sub_edges.list.len())
        .into_par_iter()
        .map(|number| {
            let Some(partner) = sub_edges.list[number].partner else { return false };
            let ends = [sub_edges.list[number].border, partner.border].map(|b| borders.get(b));
            let open_gap =
                (opening * limits.open_gap(ends[0], ends[1])).min(limits.tolerance(ends[0], ends[1]));
            let target = limits.spacing.max(FALL * partner.gap);
            let [before, after] = partner.end_gaps;
            partner.widest() <= open_gap
                || (before <= target || falls(borders, sub_edges, number, false, partner.gap, target))
                    && (after <= target || falls(borders, sub_edges, number, true, partner.gap, target))
        })
        .collect()
}

/// Whether the gap falls to `target` on a walk along the border from a sub-edge, before the other side is lost.
fn falls(
    borders: &Borders,
    sub_edges: &SubEdges,
    number: usize,
    forward: bool,
    gap: f64,
    target: f64,
) -> bool {
    let mut border = sub_edges.list[number].border;
    let mut number = number;
    let mut unmatched = 0.0;
    for _ in 0..MAX_STEPS {
        let range = sub_edges.of(border);
        let at_end = if forward { number + 1 == range.end } else { number == range.start };
        if at_end {
            let next = if forward { &borders.next } else { &borders.previous }[border as usize];
            if next == NO_BORDER
                || borders.get(next).direction.dot(borders.get(border).direction) < COS_TURN
                || sub_edges.of(next).is_empty()
            {
                return false;
            }
            border = next;
            number = if forward { sub_edges.of(next).start } else { sub_edges.of(next).end - 1 };
        } else {
            number = if forward { number + 1 } else { number - 1 };
        }
        let sub_edge = &sub_edges.list[number];
        if let Some(partner) = sub_edge.partner {
            if partner.end_gaps[0].min(partner.end_gaps[1]) <= target {
                return true;
            }
            unmatched = 0.0;
        } else {
            unmatched += sub_edge.length(borders);
            if unmatched > STEP * gap {
                return false;
            }
        }
    }
    false
}
