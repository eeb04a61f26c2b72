//! One side of a seam: a polyline of border edges.

use glam::DVec3;

use super::border_points::BorderPoint;
use super::borders::{Border, Borders};

/// A part of a border edge, in the direction in which a seam is followed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Step {
    pub(super) border: u32,
    /// Where on the edge it starts and ends; the first is larger when the seam is followed against the edge.
    pub(super) shares: [f64; 2],
}

/// Border edges in a row, in the direction in which the seam is followed. The first and the last may be parts of edges.
pub(super) struct Side<'a> {
    borders: &'a Borders,
    steps: Vec<Step>,
    /// Where the vertices are, the ends included: one more than edges.
    pub(super) points: Vec<DVec3>,
    /// How far along the side each vertex is.
    pub(super) along: Vec<f64>,
}

/// The place of a side that is nearest to a point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Nearest {
    /// How far along the side it is.
    pub(super) along: f64,
    /// Distance from the point.
    pub(super) gap: f64,
    /// The step on which it is.
    pub(super) step: usize,
}

impl<'a> Side<'a> {
    /// The side that consists of consecutive edges; `reversed` when the seam is followed against them.
    pub(super) fn new(borders: &'a Borders, row: &[u32], reversed: bool) -> Self {
        let shares = if reversed { [1.0, 0.0] } else { [0.0, 1.0] };
        let mut steps: Vec<Step> = row.iter().map(|&border| Step { border, shares }).collect();
        if reversed {
            steps.reverse();
        }
        Self::of_steps(borders, steps)
    }

    /// The side that consists of these parts, each of which starts where the one before ends.
    pub(super) fn of_steps(borders: &'a Borders, steps: Vec<Step>) -> Self {
        let mut points = Vec::with_capacity(steps.len() + 1);
        let mut along = vec![0.0];
        let mut length = 0.0;
        for Step { border, shares } in &steps {
            let edge = borders.get(*border);
            if points.is_empty() {
                points.push(edge.at(shares[0]));
            }
            points.push(edge.at(shares[1]));
            length += edge.length * (shares[1] - shares[0]).abs();
            along.push(length);
        }
        Self { borders, steps, points, along }
    }

    /// Number of edges.
    pub(super) fn len(&self) -> usize {
        self.steps.len()
    }

    /// Length of the polyline.
    pub(super) fn length(&self) -> f64 {
        self.along.last().copied().unwrap_or_default()
    }

    /// The edges in order.
    pub(super) fn edges(&self) -> impl Iterator<Item = &Border> {
        self.steps.iter().map(|step| self.borders.get(step.border))
    }

    /// The edge of a step.
    pub(super) fn edge(&self, step: usize) -> &Border {
        self.borders.get(self.steps[step].border)
    }

    /// The nearest place to a point that is at a share of the other side's length. Of places about as near, one about as
    /// far along is preferred: a side may come back to where it was.
    pub(super) fn nearest(&self, point: DVec3, share: f64) -> Nearest {
        const PREFERENCE: f64 = 0.05;
        let expected = share * self.length();
        let mut best = Nearest { along: 0.0, gap: f64::INFINITY, step: 0 };
        let mut least = f64::INFINITY;
        for step in 0..self.len() {
            let (from, to) = (self.points[step], self.points[step + 1]);
            let length = self.along[step + 1] - self.along[step];
            let t = ((point - from).dot(to - from) / (length * length)).clamp(0.0, 1.0);
            let gap = point.distance(from.lerp(to, t));
            let along = self.along[step] + t * length;
            let cost = gap + PREFERENCE * (along - expected).abs();
            if cost < least {
                least = cost;
                best = Nearest { along, gap, step };
            }
        }
        best
    }

    /// The vertex of a number, as a place.
    pub(super) fn vertex(&self, number: usize) -> BorderPoint {
        let (step, end) = if number < self.len() { (number, 0) } else { (self.len() - 1, 1) };
        let Step { border, shares } = self.steps[step];
        BorderPoint::On { border, share: shares[end] }
    }

    /// The place on the edge of a step that is this far along the side.
    pub(super) fn cut(&self, step: usize, along: f64) -> BorderPoint {
        let Step { border, shares: [from, to] } = self.steps[step];
        let share = (along - self.along[step]) / (self.along[step + 1] - self.along[step]);
        BorderPoint::On { border, share: from + share * (to - from) }
    }

    /// The shorter one of the edges at an inner vertex.
    pub(super) fn shortest_at(&self, vertex: usize) -> f64 {
        let length = |step: usize| self.along[step + 1] - self.along[step];
        length(vertex - 1).min(length(vertex))
    }
}
