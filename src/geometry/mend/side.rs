//! One side of a seam: a polyline of border edges.

use glam::DVec3;

use super::borders::{Border, Borders};
use super::places::Place;

/// Border edges in a row, in the direction in which the seam is followed.
pub(super) struct Side<'a> {
    borders: &'a Borders,
    /// The edges, each with whether it runs against the seam.
    steps: Vec<(u32, bool)>,
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
    pub(super) fn new(borders: &'a Borders, run: &[u32], reversed: bool) -> Self {
        let mut steps: Vec<(u32, bool)> = run.iter().map(|&b| (b, reversed)).collect();
        if reversed {
            steps.reverse();
        }
        let mut side = Self { borders, points: Vec::with_capacity(run.len() + 1), along: vec![0.0], steps };
        for &(border, reversed) in &side.steps {
            let [from, to] = side.borders.get(border).positions;
            if side.points.is_empty() {
                side.points.push(if reversed { to } else { from });
            }
            side.points.push(if reversed { from } else { to });
        }
        let mut along = 0.0;
        for &(border, _) in &side.steps {
            along += side.borders.get(border).length;
            side.along.push(along);
        }
        side
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
        self.steps.iter().map(|&(border, _)| self.borders.get(border))
    }

    /// The edge of a step.
    pub(super) fn edge(&self, step: usize) -> &Border {
        self.borders.get(self.steps[step].0)
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
    pub(super) fn vertex(&self, number: usize) -> Place {
        let (step, end) = if number < self.len() { (number, 0) } else { (self.len() - 1, 1) };
        let (border, reversed) = self.steps[step];
        Place::Point(self.borders.get(border).ends[usize::from(reversed) ^ end])
    }

    /// The place on the edge of a step that is this far along the side.
    pub(super) fn cut(&self, step: usize, along: f64) -> Place {
        let (border, reversed) = self.steps[step];
        let share = (along - self.along[step]) / (self.along[step + 1] - self.along[step]);
        Place::On { border, share: if reversed { 1.0 - share } else { share } }
    }

    /// The shorter one of the edges at an inner vertex.
    pub(super) fn shortest_at(&self, vertex: usize) -> f64 {
        let length = |step: usize| self.along[step + 1] - self.along[step];
        length(vertex - 1).min(length(vertex))
    }
}
