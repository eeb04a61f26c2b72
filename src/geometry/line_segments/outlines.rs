//! Lengths along a chain of smooth silhouettes in the picture.
//!
//! The silhouette of triangles goes to and fro around that of the surface they stand for; counted along a smoothed
//! curve, dashes keep their length.

use glam::DVec2;

use super::scale::Scale;

/// A chain in the picture.
pub(super) struct Outline {
    /// The smoothed points, in pixels; the last one of a loop is the first one again.
    points: Vec<DVec2>,
    /// Length along them up to each.
    lengths: Vec<f64>,
    is_closed: bool,
}

impl Outline {
    /// Smooths points, in pixels, over `reach` pixels of length to both sides. The last point of a loop is its first.
    pub(super) fn new(points: &[DVec2], is_closed: bool, reach: f64) -> Self {
        let points = Integral::new(points).smoothed(is_closed, reach);
        let lengths = lengths(&points);
        Self { points, lengths, is_closed }
    }

    fn whole(&self) -> f64 {
        self.lengths.last().copied().unwrap_or(0.0)
    }

    /// Length at a part (0 to 1) of the line after point `i`; `backwards` from the other end.
    pub(super) fn length_at(&self, i: usize, part: f64, backwards: bool) -> f64 {
        let at = |i: usize| self.lengths.get(i).copied().unwrap_or(0.0);
        let length = at(i) + (at(i + 1) - at(i)) * part;
        if backwards { self.whole() - length } else { length }
    }

    /// How arcs are counted along it.
    pub(super) fn scale(&self, period: f64, backwards: bool) -> Scale {
        let whole = self.whole();
        if !self.is_closed {
            return Scale { anchor: 0.5 * whole, around: None, period };
        }
        let anchor = self.highest_above_middle();
        let anchor = if backwards { whole - anchor } else { anchor };
        Scale { anchor, around: Some(whole), period }
    }

    /// Length at the highest point straight above (or below) the middle of the loop. It moves little when the loop
    /// does; its highest point would jump from vertex to vertex.
    fn highest_above_middle(&self) -> f64 {
        let (low, high) = self
            .points
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| (low.min(p.x), high.max(p.x)));
        let middle = 0.5 * (low + high);
        let crossings = self.points.windows(2).zip(0..).filter_map(|(ends, i)| {
            let &[a, b] = ends else { return None };
            if (a.x < middle) == (b.x < middle) {
                return None;
            }
            let part = (middle - a.x) / (b.x - a.x);
            Some((a.y + (b.y - a.y) * part, self.length_at(i, part, false)))
        });
        crossings.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(0.0, |(_, length)| length)
    }
}

/// Length along points up to each.
fn lengths(points: &[DVec2]) -> Vec<f64> {
    let mut at = 0.0;
    let mut last = points.first().copied().unwrap_or_default();
    points
        .iter()
        .map(|&p| {
            at += last.distance(p);
            last = p;
            at
        })
        .collect()
}

/// The integral of a polyline over its length.
struct Integral<'a> {
    points: &'a [DVec2],
    lengths: Vec<f64>,
    sums: Vec<DVec2>,
}

impl<'a> Integral<'a> {
    fn new(points: &'a [DVec2]) -> Self {
        let lengths = lengths(points);
        let mut sum = DVec2::ZERO;
        let mut sums = vec![sum];
        for (ends, along) in points.windows(2).zip(lengths.windows(2)) {
            sum += 0.5 * (ends[0] + ends[1]) * (along[1] - along[0]);
            sums.push(sum);
        }
        Self { points, lengths, sums }
    }

    /// Each point replaced by the mean over `reach` of length to both sides, less at open ends.
    fn smoothed(&self, is_closed: bool, reach: f64) -> Vec<DVec2> {
        let whole = self.lengths.last().copied().unwrap_or(0.0);
        let mean = |at: f64, point: DVec2| {
            let room = if is_closed { 0.5 * whole } else { at.min(whole - at) };
            let reach = reach.min(room);
            let mean = (self.up_to(at + reach, whole) - self.up_to(at - reach, whole)) / (2.0 * reach);
            if mean.is_finite() { mean } else { point }
        };
        self.lengths.iter().zip(self.points).map(|(&at, &point)| mean(at, point)).collect()
    }

    /// The integral from the start; beyond both ends a loop goes on.
    fn up_to(&self, length: f64, whole: f64) -> DVec2 {
        let total = self.sums.last().copied().unwrap_or_default();
        if length < 0.0 {
            return self.within(length + whole) - total;
        }
        if length > whole { total + self.within(length - whole) } else { self.within(length) }
    }

    fn within(&self, length: f64) -> DVec2 {
        let i = self.lengths.partition_point(|&at| at < length).clamp(1, self.lengths.len().max(2) - 1);
        let at = |list: &[f64], i: usize| list.get(i).copied().unwrap_or(0.0);
        let point = |i: usize| self.points.get(i).copied().unwrap_or_default();
        let (from, to) = (at(&self.lengths, i - 1), at(&self.lengths, i));
        let part = if to > from { ((length - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 };
        let there = point(i - 1).lerp(point(i), part);
        self.sums.get(i - 1).copied().unwrap_or_default()
            + 0.5 * (point(i - 1) + there) * (part * (to - from))
    }
}
