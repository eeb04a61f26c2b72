//! Which of the gaps between border edges are cracks.
//!
//! Polylines of one curve touch or cross again and again. A clearance, a tile joint or a slot does not.

use rayon::prelude::*;

use super::borders::{Borders, NO_BORDER};
use super::limits::Limits;
use super::proximity::Stretches;

/// The gap must fall to this share of what it is.
const FALL: f64 = 0.25;
/// Unmatched pieces up to this many times the gap are stepped over.
const STEP: f64 = 3.0;
/// Of a longer walk along a border, the end is not looked for.
const MAX_STEPS: usize = 600;
/// Cosine of the sharpest turn of a border that is walked along.
const COS_TURN: f64 = -0.5;
/// Length share of overlapping stretches, among those that do not close, from which on they are cracks too.
const CRACKED: f64 = 0.2;
/// Least share of the gap by which two sides must overlap to count.
const OVERLAP: f64 = 0.1;
/// The largest gap that a cracked mesh is given, as a multiple of the 95th percentile.
const MARGIN: f64 = 2.0;

/// The stretches that are joined, and how many times wider than usual gaps may be that need no closure.
pub(super) struct Closed {
    pub(super) is_closed: Vec<bool>,
    pub(super) opening: f64,
}

/// A stretch that is not closed.
struct OpenStretch {
    /// In usual open gaps.
    gap: f64,
    is_overlap: bool,
    length: f64,
}

/// Decides for each stretch. Where many of the gaps that do not close are overlaps, which no designer leaves, the mesh
/// is cracked also where the corners of patches should meet, and its own gaps tell how wide cracks are (step 5).
pub(super) fn closed(borders: &Borders, stretches: &Stretches, limits: &Limits) -> Closed {
    let is_closed = decide(borders, stretches, limits, 1.0);
    let mut left: Vec<OpenStretch> = stretches
        .list
        .iter()
        .zip(&is_closed)
        .filter(|(_, closed)| !**closed)
        .filter_map(|(stretch, _)| {
            let partner = stretch.partner?;
            let usual = limits.open_gap(borders.get(stretch.border), borders.get(partner.border));
            Some(OpenStretch {
                gap: partner.gap / usual,
                is_overlap: partner.opening < -OVERLAP * partner.gap,
                length: stretch.length(borders),
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
    Closed { is_closed: decide(borders, stretches, limits, opening), opening }
}

fn decide(borders: &Borders, stretches: &Stretches, limits: &Limits, opening: f64) -> Vec<bool> {
    (0..stretches.list.len())
        .into_par_iter()
        .map(|number| {
            let Some(partner) = stretches.list[number].partner else { return false };
            let ends = [stretches.list[number].border, partner.border].map(|b| borders.get(b));
            let open_gap =
                (opening * limits.open_gap(ends[0], ends[1])).min(limits.tolerance(ends[0], ends[1]));
            let target = limits.spacing.max(FALL * partner.gap);
            let [before, after] = partner.end_gaps;
            partner.widest() <= open_gap
                || (before <= target || falls(borders, stretches, number, false, partner.gap, target))
                    && (after <= target || falls(borders, stretches, number, true, partner.gap, target))
        })
        .collect()
}

/// Whether the gap falls to `target` on a walk along the border from a stretch, before the other side is lost.
fn falls(
    borders: &Borders,
    stretches: &Stretches,
    number: usize,
    forward: bool,
    gap: f64,
    target: f64,
) -> bool {
    let mut border = stretches.list[number].border;
    let mut number = number;
    let mut unmatched = 0.0;
    for _ in 0..MAX_STEPS {
        let range = stretches.of(border);
        let at_end = if forward { number + 1 == range.end } else { number == range.start };
        if at_end {
            let next = if forward { &borders.next } else { &borders.previous }[border as usize];
            if next == NO_BORDER
                || borders.get(next).direction.dot(borders.get(border).direction) < COS_TURN
                || stretches.of(next).is_empty()
            {
                return false;
            }
            border = next;
            number = if forward { stretches.of(next).start } else { stretches.of(next).end - 1 };
        } else {
            number = if forward { number + 1 } else { number - 1 };
        }
        let stretch = &stretches.list[number];
        if let Some(partner) = stretch.partner {
            if partner.end_gaps[0].min(partner.end_gaps[1]) <= target {
                return true;
            }
            unmatched = 0.0;
        } else {
            unmatched += stretch.length(borders);
            if unmatched > STEP * gap {
                return false;
            }
        }
    }
    false
}
