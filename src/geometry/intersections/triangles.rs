//! Where two triangles run through each other.

use glam::DVec3;

/// The corners of a triangle, and the normal of its plane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corners {
    pub at: [DVec3; 3],
    normal: Option<DVec3>,
}

/// Which edge an end of an intersection lies on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct End {
    /// Whether it is one of the second triangle.
    pub of_second: bool,
    /// The edge from this corner to the next one.
    pub edge: usize,
}

impl Corners {
    pub(super) fn new(at: [DVec3; 3]) -> Self {
        let [a, b, c] = at;
        Self { at, normal: (b - a).cross(c - a).try_normalize() }
    }

    /// The weights of its corners that make this point of its plane.
    pub(super) fn weights(&self, point: DVec3) -> DVec3 {
        let [a, b, c] = self.at;
        let Some(normal) = self.normal else { return DVec3::splat(1.0 / 3.0) };
        let area = |p: DVec3, q: DVec3| (p - point).cross(q - point).dot(normal);
        let areas = DVec3::new(area(b, c), area(c, a), area(a, b));
        areas / areas.element_sum()
    }

    /// Where the plane of another triangle cuts this one: two points, each with the edge it lies on.
    fn chord(&self, other: &Self, tolerance: f64) -> Option<[(DVec3, usize); 2]> {
        let normal = other.normal?;
        let heights = self.at.map(|p| {
            let height = normal.dot(p - other.at[0]);
            if height.abs() <= tolerance { 0.0 } else { height }
        });
        let mut ends = (0..3).filter_map(|i| {
            let j = (i + 1) % 3;
            let is_cut = (heights[i] < 0.0) != (heights[j] < 0.0);
            is_cut.then(|| (self.at[i].lerp(self.at[j], heights[i] / (heights[i] - heights[j])), i))
        });
        let both = [ends.next()?, ends.next()?];
        (both[0].0.distance(both[1].0) > tolerance).then_some(both)
    }
}

/// The segment that two triangles share, if it is longer than `tolerance`, and what its ends lie on.
pub(super) fn intersection([t, u]: &[Corners; 2], tolerance: f64) -> Option<([DVec3; 2], [End; 2])> {
    let one = t.chord(u, tolerance)?;
    let other = u.chord(t, tolerance)?;
    let start = one[0].0;
    let length = start.distance(one[1].0);
    let along = (one[1].0 - start) / length;
    let of_first = [(0.0, one[0].1), (length, one[1].1)];
    let mut of_second = other.map(|(point, edge)| ((point - start).dot(along), edge));
    if of_second[0].0 > of_second[1].0 {
        of_second.swap(0, 1);
    }
    let pick = |end: usize, is_second: bool| {
        let (at, edge) = if is_second { of_second[end] } else { of_first[end] };
        (at, End { of_second: is_second, edge })
    };
    let from = pick(0, of_second[0].0 > of_first[0].0);
    let to = pick(1, of_second[1].0 < of_first[1].0);
    (to.0 - from.0 > tolerance).then(|| ([from, to].map(|end| start + along * end.0), [from.1, to.1]))
}

/// Whether a segment lies on one of a triangle's edges.
pub(super) fn runs_along_an_edge(ends: [DVec3; 2], triangle: &Corners, tolerance: f64) -> bool {
    (0..3).any(|i| {
        let (a, b) = (triangle.at[i], triangle.at[(i + 1) % 3]);
        let along = (b - a).normalize_or_zero();
        ends.iter().all(|p| ((p - a) - along * (p - a).dot(along)).length() <= tolerance)
    })
}
