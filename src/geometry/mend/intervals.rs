//! Where two borders run along each other: rows of joined sub-edges, with what lies opposite.

use super::border_points::Tie;
use super::borders::{Borders, NO_BORDER};
use super::closure::Closed;
use super::limits::Limits;
use super::proximity::{Partner, SubEdges};
use super::side::{Side, Step};
use super::zip::Fit;

/// Longer rows are taken in pieces.
const MAX_EDGES: usize = 128;
/// So many edges of the other border may be passed by at once.
const MAX_PASSED: usize = 8;
/// Rows that are shorter than this many times their width are chance: other borders end near a corner.
const SHORTEST: f64 = 4.0;
/// A row that ends within four times this share of the tolerance from a vertex ends at the vertex: near the corner of
/// a patch, the border of a third one may be nearer.
const CORNER: f64 = 0.0625;
/// Unmatched pieces up to this many times the gap are stepped over.
const STEP: f64 = 3.0;

/// The places on both sides of joined sub-edges that become one.
pub(super) fn ties(borders: &Borders, sub_edges: &SubEdges, closed: &Closed, limits: &Limits) -> Vec<Tie> {
    let mut all =
        Intervals { borders, sub_edges, closed, limits, is_done: vec![false; sub_edges.list.len()] };
    let mut ties = Vec::new();
    for number in 0..sub_edges.list.len() {
        if let Some([side, other]) = all.from(number)
            && let Some(fit) = Fit::of_seam(&side, &other)
        {
            ties.extend(fit.ties(&side, &other, limits));
        }
    }
    // Where rows end at a corner, the vertices there belong together before anything is cut.
    ties.sort_by_key(|tie| !tie.is_between_vertices());
    ties
}

struct Intervals<'a> {
    borders: &'a Borders,
    sub_edges: &'a SubEdges,
    closed: &'a Closed,
    limits: &'a Limits,
    is_done: Vec<bool>,
}

impl<'a> Intervals<'a> {
    /// The two sides of the row that begins with a sub-edge, unless that was seen from the other side.
    fn from(&mut self, first: usize) -> Option<[Side<'a>; 2]> {
        let first_partner = self.joined(first)?;
        let mut last = (first, first_partner);
        let mut width = first_partner.widest();
        let mut length = self.sub_edges.list[first].length(self.borders);
        let mut edges = vec![self.sub_edges.list[first].border];
        let mut opposite = vec![first_partner.border];
        self.is_done[first] = true;
        let is_reversed = self.direction(first, &first_partner) < 0.0;
        while let Some((number, passed)) = self.next(last.0, &last.1, is_reversed)
            && let Some(partner) = self.joined(number)
            && edges.len() + opposite.len() < MAX_EDGES
        {
            self.is_done[number] = true;
            let border = self.sub_edges.list[number].border;
            if edges.last() != Some(&border) {
                edges.push(border);
            }
            opposite.extend(passed);
            width = width.max(partner.widest());
            length += self.sub_edges.list[number].length(self.borders);
            last = (number, partner);
        }
        let [start, end] = [(first, first_partner, 0), (last.0, last.1, 1)].map(|(number, partner, end)| {
            let sub_edge = &self.sub_edges.list[number];
            let edge = self.borders.get(sub_edge.border);
            let share = sub_edge.shares[end];
            let opposite = self.borders.get(partner.border).nearest(edge.at(share));
            [self.snap(sub_edge.border, share, width), self.snap(partner.border, opposite, width)]
        });
        if length < SHORTEST * width {
            return None;
        }
        self.finish_opposite(&opposite, start[1], end[1], is_reversed);
        Some([
            self.side(&edges, [start[0], end[0]], false)?,
            self.side(&opposite, [start[1], end[1]], is_reversed)?,
        ])
    }

    /// The partner of a sub-edge that is joined and not part of a row yet.
    fn joined(&self, number: usize) -> Option<Partner> {
        let is_wanted = self.closed.is_closed[number] && !self.is_done[number];
        self.sub_edges.list[number].partner.filter(|_| is_wanted)
    }

    /// Cosine of the angle between a sub-edge's edge and its partner.
    fn direction(&self, number: usize, partner: &Partner) -> f64 {
        let edge = self.borders.get(self.sub_edges.list[number].border);
        edge.direction.dot(self.borders.get(partner.border).direction)
    }

    /// The sub-edge with which the row goes on, and the edges on the other side that come with it.
    fn next(&self, number: usize, partner: &Partner, is_reversed: bool) -> Option<(usize, Vec<u32>)> {
        let mut number = number;
        let mut unmatched = 0.0;
        loop {
            let border = self.sub_edges.list[number].border;
            number += 1;
            if number == self.sub_edges.of(border).end {
                let next = self.borders.next[border as usize];
                if next == NO_BORDER || self.sub_edges.of(next).is_empty() {
                    return None;
                }
                number = self.sub_edges.of(next).start;
            }
            if let Some(next) = self.joined(number) {
                let passed = self.passed(partner.border, next.border, is_reversed)?;
                return ((self.direction(number, &next) < 0.0) == is_reversed).then_some((number, passed));
            }
            unmatched += self.sub_edges.list[number].length(self.borders);
            if self.is_done[number] || unmatched > STEP * partner.gap.max(self.limits.spacing) {
                return None;
            }
        }
    }

    /// The edges after one edge up to another.
    fn passed(&self, from: u32, to: u32, is_reversed: bool) -> Option<Vec<u32>> {
        let links = if is_reversed { &self.borders.previous } else { &self.borders.next };
        let mut passed = Vec::new();
        let mut at = from;
        while at != to {
            at = links[at as usize];
            if at == NO_BORDER || passed.len() == MAX_PASSED || self.sub_edges.of(at).is_empty() {
                return None;
            }
            passed.push(at);
        }
        Some(passed)
    }

    /// The end of the edge if it is about there, else the place itself.
    fn snap(&self, border: u32, share: f64, width: f64) -> f64 {
        let length = self.borders.get(border).length;
        let end = share.round();
        let width = width.max(CORNER * self.limits.reach(self.borders.get(border)));
        if self.limits.is_same_place((share - end).abs() * length, width, length) { end } else { share }
    }

    /// Notes the sub-edges on the other side, so that no row begins there.
    fn finish_opposite(&mut self, edges: &[u32], start: f64, end: f64, is_reversed: bool) {
        for (k, &edge) in edges.iter().enumerate() {
            let [mut low, mut high] = [0.0, 1.0];
            if k == 0 {
                *(if is_reversed { &mut high } else { &mut low }) = start;
            }
            if k + 1 == edges.len() {
                *(if is_reversed { &mut low } else { &mut high }) = end;
            }
            for number in self.sub_edges.of(edge) {
                let [from, to] = self.sub_edges.list[number].shares;
                let middle = from.midpoint(to);
                self.is_done[number] |= low <= middle && middle <= high;
            }
        }
    }

    /// The side that runs along these edges, from a share of the first to one of the last.
    fn side(&self, edges: &[u32], ends: [f64; 2], is_reversed: bool) -> Option<Side<'a>> {
        let whole = if is_reversed { [1.0, 0.0] } else { [0.0, 1.0] };
        let mut steps: Vec<Step> = edges.iter().map(|&border| Step { border, shares: whole }).collect();
        steps.first_mut()?.shares[0] = ends[0];
        steps.last_mut()?.shares[1] = ends[1];
        // Parts at the ends that are next to nothing would be edges of no direction.
        let is_long = |step: &Step| {
            let along = step.shares[1] - step.shares[0];
            let along = if is_reversed { -along } else { along };
            along * self.borders.get(step.border).length > self.limits.spacing
        };
        while steps.last().is_some_and(|step| !is_long(step)) {
            steps.pop();
        }
        let first = steps.iter().position(is_long)?;
        Some(Side::of_steps(self.borders, steps.split_off(first)))
    }
}
