//! Step 4: border edges that lie near each other, wherever their ends are.

use glam::DVec3;
use rayon::prelude::*;

use super::super::{Bounds, Bvh};
use super::borders::{Border, Borders};
use super::limits::{COS_FOLD, Limits};
use super::open::Open;

/// Of more edges near one, only the nearest are looked at.
const MAX_CANDIDATES: usize = 48;
/// Cosine of the largest angle between the directions of two edges that lie along each other.
const COS_ALONG: f64 = 0.5;
/// How deep in the material a gap may be, as a share of the height of the triangles.
const DEPTH: f64 = 0.5;

/// A part of a border edge that has one nearest partner, or none.
#[derive(Debug, Clone, Copy)]
pub(super) struct SubEdge {
    pub(super) border: u32,
    /// Where it begins and ends, as shares of the edge.
    pub(super) shares: [f64; 2],
    pub(super) partner: Option<Partner>,
}

/// The edge on the other side of a gap.
#[derive(Debug, Clone, Copy)]
pub(super) struct Partner {
    pub(super) border: u32,
    /// Distance to it from the middle of the sub-edge.
    pub(super) gap: f64,
    /// Distances to it from both ends of the sub-edge.
    pub(super) end_gaps: [f64; 2],
    /// By how much the two sides are apart along their conormals, from the middle of the sub-edge; negative where they
    /// overlap.
    pub(super) opening: f64,
}

impl Partner {
    /// The largest of the distances.
    pub(super) fn widest(&self) -> f64 {
        self.gap.max(self.end_gaps[0]).max(self.end_gaps[1])
    }
}

impl SubEdge {
    /// Length in units of the mesh.
    pub(super) fn length(&self, borders: &Borders) -> f64 {
        (self.shares[1] - self.shares[0]) * borders.get(self.border).length
    }

    fn middle(&self, borders: &Borders) -> DVec3 {
        borders.get(self.border).at(self.shares[0].midpoint(self.shares[1]))
    }
}

/// The sub-edges of all open border edges.
pub(super) struct SubEdges {
    pub(super) list: Vec<SubEdge>,
    /// Sub-edges of border edge `b` are `list[first[b]..first[b + 1]]`; joined edges have none.
    first: Vec<u32>,
}

impl SubEdges {
    /// Finds the partners, with all tests but that for closure.
    pub(super) fn new(borders: &Borders, open: &Open, limits: &Limits) -> Self {
        let segments: Vec<[DVec3; 3]> =
            open.edges.iter().map(|&e| borders.get(e).positions).map(|[a, b]| [a, b, b]).collect();
        let tree = Bvh::new(&segments);
        let found: Vec<Vec<SubEdge>> = open
            .edges
            .par_iter()
            .map_init(Vec::new, |candidates, &edge| {
                near(borders, open, &tree, edge, limits, candidates);
                sub_edges(borders, edge, candidates)
            })
            .collect();
        let mut first = vec![0; borders.list.len() + 1];
        for (&edge, sub_edges) in open.edges.iter().zip(&found) {
            first[edge as usize + 1] = sub_edges.len() as u32;
        }
        for b in 1..first.len() {
            first[b] += first[b - 1];
        }
        let mut all = Self { list: found.into_iter().flatten().collect(), first };
        all.drop_one_sided(borders);
        all
    }

    /// Indices of the sub-edges of a border edge.
    pub(super) fn of(&self, border: u32) -> std::ops::Range<usize> {
        self.first[border as usize] as usize..self.first[border as usize + 1] as usize
    }

    /// Takes away partners that have another partner themselves.
    fn drop_one_sided(&mut self, borders: &Borders) {
        let is_mutual: Vec<bool> = self
            .list
            .par_iter()
            .map(|sub_edge| {
                sub_edge.partner.is_some_and(|partner| self.leads_back(borders, sub_edge, &partner))
            })
            .collect();
        for (sub_edge, is_mutual) in self.list.iter_mut().zip(is_mutual) {
            sub_edge.partner = sub_edge.partner.filter(|_| is_mutual);
        }
    }

    fn leads_back(&self, borders: &Borders, sub_edge: &SubEdge, partner: &Partner) -> bool {
        let middle = sub_edge.middle(borders);
        let other = borders.get(partner.border);
        let share = other.nearest(middle);
        let opposite = &self.list[self.of(partner.border)];
        let opposite = opposite.iter().find(|s| s.shares[0] <= share && share <= s.shares[1]);
        let Some(back) = opposite.and_then(|s| s.partner) else { return false };
        let returned = borders.get(back.border);
        let place = returned.at(returned.nearest(other.at(share)));
        back.border == sub_edge.border || place.distance(middle) <= 2.0 * (partner.gap + back.gap)
    }
}

/// A border edge near another one.
struct Candidate {
    border: u32,
    gap: f64,
    /// The part of the edge along which it lies, as shares.
    shares: [f64; 2],
    /// The share at which they are nearest.
    closest: f64,
    reach: f64,
}

fn near(
    borders: &Borders,
    open: &Open,
    tree: &Bvh,
    edge: u32,
    limits: &Limits,
    candidates: &mut Vec<Candidate>,
) {
    candidates.clear();
    let border = borders.get(edge);
    let [a, b] = border.positions;
    let reach = limits.reach(border);
    let bounds = Bounds { min: a.min(b) - reach, max: a.max(b) + reach };
    tree.overlapping(&bounds, |number| {
        let other = open.edges[number];
        let partner = borders.get(other);
        let reach = limits.tolerance(border, partner).min(0.5 * border.length.max(partner.length));
        let follows = [borders.next[edge as usize], borders.previous[edge as usize]].contains(&other);
        if partner.face == border.face
            || follows
            || border.direction.dot(partner.direction).abs() < COS_ALONG
            || !border.is_unfolded(partner, COS_FOLD)
        {
            return;
        }
        let (closest, gap) = closest(border, partner);
        if gap <= reach {
            let [s, t] = partner.positions.map(|p| border.nearest(p));
            candidates.push(Candidate { border: other, gap, shares: [s.min(t), s.max(t)], closest, reach });
        }
    });
    if candidates.len() > MAX_CANDIDATES {
        candidates.sort_by(|a, b| a.gap.total_cmp(&b.gap).then(a.border.cmp(&b.border)));
        candidates.truncate(MAX_CANDIDATES);
    }
    candidates.sort_by_key(|c| c.border);
}

/// The share of `a` at which it is closest to `b`, and the distance there.
fn closest(a: &Border, b: &Border) -> (f64, f64) {
    let along = a.direction.dot(b.direction);
    let between = b.positions[0] - a.positions[0];
    let sine2 = 1.0 - along * along;
    let crossing = if sine2 > 1e-12 {
        (between.dot(a.direction) - between.dot(b.direction) * along) / (sine2 * a.length)
    } else {
        0.0
    };
    let shares = [crossing.clamp(0.0, 1.0), 0.0, 1.0, a.nearest(b.positions[0]), a.nearest(b.positions[1])];
    let distances = shares.map(|share| (share, b.distance(a.at(share))));
    distances.into_iter().min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0.0, f64::INFINITY))
}

fn sub_edges(borders: &Borders, edge: u32, candidates: &[Candidate]) -> Vec<SubEdge> {
    let border = borders.get(edge);
    let mut cuts = vec![0.0, 1.0];
    cuts.extend(candidates.iter().flat_map(|c| [c.shares[0], c.shares[1], c.closest]));
    cuts.sort_by(f64::total_cmp);
    cuts.dedup_by(|a, b| *a - *b < 1e-9);
    let whole = [0.0, 1.0];
    if cuts.len() < 2 {
        return vec![SubEdge { border: edge, shares: whole, partner: None }];
    }
    let last = cuts.len() - 1;
    cuts[last] = 1.0;
    cuts.windows(2)
        .map(|ends| {
            let shares = [ends[0], ends[1]];
            SubEdge { border: edge, shares, partner: partner(borders, border, shares, candidates) }
        })
        .collect()
}

/// The nearest candidate at the middle of a sub-edge, if nothing but the triangles' own material is on the way.
fn partner(
    borders: &Borders,
    border: &Border,
    shares: [f64; 2],
    candidates: &[Candidate],
) -> Option<Partner> {
    let share = shares[0].midpoint(shares[1]);
    let middle = border.at(share);
    let mut best: Option<(f64, u32)> = None;
    for candidate in candidates {
        // Beside its ends an edge is near to what follows on the same border.
        if share < candidate.shares[0] || share > candidate.shares[1] {
            continue;
        }
        let gap = borders.get(candidate.border).distance(middle);
        if gap <= candidate.reach && best.is_none_or(|best| (gap, candidate.border) < best) {
            best = Some((gap, candidate.border));
        }
    }
    let (gap, number) = best?;
    let other = borders.get(number);
    let across = other.at(other.nearest(middle)) - middle;
    border.is_outside(other, across, DEPTH).then(|| Partner {
        border: number,
        gap,
        end_gaps: shares.map(|s| other.distance(border.at(s))),
        opening: 0.5 * (across.dot(border.outward) - across.dot(other.outward)),
    })
}
