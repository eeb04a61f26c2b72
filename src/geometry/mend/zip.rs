//! Matches two sides of a seam that start and end together.

use std::collections::HashSet;

use glam::DVec3;

use super::border_points::{PointOnLine, Tie};
use super::limits::Limits;
use super::side::{Nearest, Side};

/// Sides with a larger product of their numbers of edges are not compared.
const MAX_COMPARISONS: usize = 65_536;
/// Most width of a seam, as a share of the distance of its ends.
const WIDTH_TO_CHORD: f64 = 0.75;
/// A seam is straight if no vertex leaves the line between its ends by more than this many times its width.
const STRAIGHT: f64 = 2.0;
/// How deep in the material a gap may be, as a share of the height of the triangles.
const DEPTH: f64 = 0.9;

/// Two sides of what may be a seam, and how they lie to each other.
pub(super) struct Fit {
    /// Hausdorff distance of the two sides.
    pub(super) width: f64,
    /// For each vertex of each side, where the other side is nearest.
    nearest: [Vec<Nearest>; 2],
}

impl Fit {
    /// Compares two sides with common ends; `None` when they are no seam.
    pub(super) fn new(a: &Side<'_>, b: &Side<'_>, cos_fold: f64, limits: &Limits) -> Option<Self> {
        if a.len() * b.len() > MAX_COMPARISONS || have_common_triangle(a, b) {
            return None;
        }
        let widest = widest(a, b, limits).min(WIDTH_TO_CHORD * extent(a).min(extent(b)));
        let of = |from: &Side<'_>, to: &Side<'_>| {
            let nearest = from.points.iter().zip(&from.along);
            let nearest = nearest.map(|(&point, &along)| {
                let nearest = to.nearest(point, along / from.length());
                (nearest.gap <= widest).then_some(nearest)
            });
            nearest.collect::<Option<Vec<_>>>()
        };
        let nearest = [of(a, b)?, of(b, a)?];
        if misfit(a, b, cos_fold) + misfit(b, a, cos_fold) > 0.5 * (a.length() + b.length()) {
            return None;
        }
        let width = nearest.iter().flatten().map(|n| n.gap).fold(0.0, f64::max);
        Some(Self { width, nearest })
    }

    /// Two sides that are known to be a seam.
    pub(super) fn of_seam(a: &Side<'_>, b: &Side<'_>) -> Option<Self> {
        if a.len() == 0 || b.len() == 0 || a.len() * b.len() > MAX_COMPARISONS {
            return None;
        }
        let of = |from: &Side<'_>, to: &Side<'_>| -> Vec<Nearest> {
            let vertices = from.points.iter().zip(&from.along);
            vertices.map(|(&point, &along)| to.nearest(point, along / from.length())).collect()
        };
        let nearest = [of(a, b), of(b, a)];
        let width = nearest.iter().flatten().map(|n| n.gap).fold(0.0, f64::max);
        Some(Self { width, nearest })
    }

    /// The places that become one, so that afterwards both sides are the same polyline.
    pub(super) fn ties(&self, a: &Side<'_>, b: &Side<'_>, limits: &Limits) -> Vec<Tie> {
        let steps = self.order(a, b, limits);
        let mut along = [vec![0.0; steps.len()], vec![0.0; steps.len()]];
        for (k, side) in [a, b].into_iter().enumerate() {
            let spacing = 2.0 * limits.spacing;
            let mut start = 0;
            while start < steps.len() {
                if let Some(vertex) = steps[start][k] {
                    along[k][start] = side.along[vertex];
                    start += 1;
                    continue;
                }
                // Several vertices of the other side meet one edge of this one.
                let count = steps[start..].iter().take_while(|s| s[k].is_none()).count();
                let wanted = steps[start..start + count].iter().filter_map(|s| s[1 - k]);
                let mut wanted: Vec<f64> = wanted.map(|v| self.nearest[1 - k][v].along).collect();
                let before = steps[start - 1][k].unwrap_or_default();
                spread(&mut wanted, side.along[before], side.along[before + 1], spacing);
                along[k][start..start + count].copy_from_slice(&wanted);
                start += count;
            }
        }
        let mut before = [0; 2];
        let mut ties = Vec::with_capacity(steps.len());
        let last = steps.len() - 1;
        let is_straight = self.is_straight(a, b);
        for (number, step) in steps.iter().enumerate() {
            let place = |k: usize, side: &Side<'_>| match step[k] {
                Some(vertex) => side.vertex(vertex),
                None => side.cut(before[k], along[k][number]),
            };
            let share = along[0][number] / a.length() + along[1][number] / b.length();
            let is_on_line = is_straight && number > 0 && number < last;
            ties.push(Tie {
                sides: [place(0, a), place(1, b)],
                on_line: is_on_line
                    .then(|| PointOnLine { ends: [a.vertex(0), a.vertex(a.len())], share: 0.5 * share }),
            });
            for k in 0..2 {
                before[k] = step[k].unwrap_or(before[k]);
            }
        }
        ties
    }

    /// Whether both sides are straight but for the width of the seam. Then they meet on the line between its ends, where
    /// they turn no triangle that lay along it.
    fn is_straight(&self, a: &Side<'_>, b: &Side<'_>) -> bool {
        let (start, end) = (a.points[0], a.points[a.len()]);
        let chord = end - start;
        let distance = |p: DVec3| {
            let share = (p - start).dot(chord) / chord.length_squared();
            start.lerp(end, share.clamp(0.0, 1.0)).distance(p)
        };
        let reach = STRAIGHT * self.width;
        chord.length() > reach && a.points.iter().chain(&b.points).all(|&p| distance(p) <= reach)
    }

    /// The order in which the vertices of both sides follow each other; an entry has two where they become one.
    fn order(&self, a: &Side<'_>, b: &Side<'_>, limits: &Limits) -> Vec<[Option<usize>; 2]> {
        let sides = [a, b];
        let share = |k: usize, vertex: usize| sides[k].along[vertex] / sides[k].length();
        let key = |k: usize, vertex: usize| {
            share(k, vertex) + self.nearest[k][vertex].along / sides[1 - k].length()
        };
        let mut order = vec![[Some(0); 2]];
        let (mut i, mut j) = (1, 1);
        while i < a.len() || j < b.len() {
            if i < a.len() && j < b.len() && self.are_one(a, i, b, j, limits) {
                order.push([Some(i), Some(j)]);
                i += 1;
                j += 1;
            } else if j >= b.len() || i < a.len() && key(0, i) <= key(1, j) {
                order.push([Some(i), None]);
                i += 1;
            } else {
                order.push([None, Some(j)]);
                j += 1;
            }
        }
        order.push([Some(a.len()), Some(b.len())]);
        order
    }

    fn are_one(&self, a: &Side<'_>, i: usize, b: &Side<'_>, j: usize, limits: &Limits) -> bool {
        let (from_a, from_b) = (self.nearest[0][i], self.nearest[1][j]);
        let apart = (from_a.along - b.along[j]).abs().max((from_b.along - a.along[i]).abs());
        let shortest = a.shortest_at(i).min(b.shortest_at(j));
        limits.is_same_place(apart, from_a.gap.max(from_b.gap), shortest)
            && a.points[i].distance(b.points[j]) <= widest(a, b, limits)
    }
}

/// Sorts values between two others, and moves them apart where they are closer than `spacing`, or than there is room.
fn spread(values: &mut [f64], low: f64, high: f64, spacing: f64) {
    let spacing = spacing.min((high - low) / (2 * values.len() + 2) as f64);
    values.sort_by(f64::total_cmp);
    let mut least = low;
    for value in values.iter_mut() {
        *value = value.max(least + spacing);
        least = *value;
    }
    let mut most = high;
    for value in values.iter_mut().rev() {
        *value = value.min(most - spacing);
        most = *value;
    }
}

/// How far two sides may be apart. Each is the border of one body.
fn widest(a: &Side<'_>, b: &Side<'_>, limits: &Limits) -> f64 {
    limits.widest(a.edge(0), b.edge(0))
}

fn have_common_triangle(a: &Side<'_>, b: &Side<'_>) -> bool {
    let (short, long) = if a.len() < b.len() { (a, b) } else { (b, a) };
    let faces: HashSet<u32> = short.edges().map(|e| e.face).collect();
    long.edges().any(|e| faces.contains(&e.face))
}

/// How far a side leads from its start: the distance of its ends, or that of the farthest vertex of a closed one.
fn extent(side: &Side<'_>) -> f64 {
    let (Some(&first), Some(&last)) = (side.points.first(), side.points.last()) else { return 0.0 };
    let chord = first.distance(last);
    if chord > 1e-3 * side.length() {
        return chord;
    }
    side.points.iter().map(|p| p.distance(first)).fold(0.0, f64::max)
}

/// The length of a side along which the surface would fold back, or where there is material between the sides.
fn misfit(side: &Side<'_>, other: &Side<'_>, cos_fold: f64) -> f64 {
    (0..side.len())
        .map(|step| {
            let edge = side.edge(step);
            let middle = edge.at(0.5);
            let share = 0.5 * (side.along[step] + side.along[step + 1]) / side.length();
            let nearest = other.nearest(middle, share);
            let partner = other.edge(nearest.step);
            let gap = partner.at(partner.nearest(middle)) - middle;
            let fits = edge.is_unfolded(partner, cos_fold) && !edge.has_material_in(partner, gap, DEPTH);
            if fits { 0.0 } else { edge.length }
        })
        .sum()
}
