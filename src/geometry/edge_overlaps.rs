//! T-junctions: places where one long edge meets several short ones on the same line.
//!
//! No vertex of the long edge's triangle lies where the short edges meet, so that by their ends all of them are
//! borders, though the surface goes on. Modellers leave such places behind, and so does dropping triangles without
//! area.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::edge::{EdgeKind, FOLDED, signed_angle};
use super::soft_edges::SoftNormals;
use super::weld::TOLERANCE;
use super::{Edge, Mesh, Weld};

/// Where two border edges lie on each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeOverlap {
    /// Indices of the two edges, the smaller one first.
    pub edges: [u32; 2],
    /// The triangle of each edge.
    pub faces: [u32; 2],
    /// Angle between the triangles' normals, as [`Edge::dihedral`].
    pub dihedral: f32,
    /// As [`Edge::is_soft`].
    pub is_soft: bool,
    /// Length of what both have in common, in units of the mesh.
    pub length: f64,
}

impl EdgeOverlap {
    /// As [`Edge::is_crease`].
    pub fn is_crease(&self, crease_angle: f32) -> bool {
        !self.is_soft && self.dihedral.abs() > crease_angle
    }
}

/// Finds all overlaps between border edges and marks the edges that are covered by overlaps from end to end as
/// [`EdgeKind::Stitched`].
pub(super) fn find_overlaps(
    mesh: &Mesh,
    weld: &Weld,
    normals: &[Vec3],
    edges: &mut [Edge],
) -> Vec<EdgeOverlap> {
    let borders = Borders::new(mesh, weld, normals, edges);
    let mut overlaps = Vec::new();
    // Chains are short in meshes that people make; hostile ones must not cost quadratic time.
    let mut steps_left = 64 * borders.starts.len();
    let mut ends = borders.ends.as_slice();
    for starts in borders.starts.chunk_by(|a, b| a.0 == b.0) {
        let point = starts[0].0;
        ends = &ends[ends.iter().take_while(|end| end.0 < point).count()..];
        let ends_here = &ends[..ends.iter().take_while(|end| end.0 == point).count()];
        for &(_, outgoing) in starts {
            for &(_, incoming) in &ends_here[..ends_here.len().min(Borders::MAX_AT_A_POINT)] {
                borders.zip(outgoing, incoming, &mut steps_left, &mut overlaps);
            }
        }
    }
    // An overlap between two common points is found from both of them.
    overlaps.sort_unstable_by_key(|overlap| overlap.edges);
    overlaps.dedup_by_key(|overlap| overlap.edges);

    let tolerance = borders.tolerance;
    let mut covered = vec![0.0; if overlaps.is_empty() { 0 } else { edges.len() }];
    for overlap in &overlaps {
        for edge in overlap.edges {
            covered[edge as usize] += overlap.length;
        }
    }
    for (edge, covered) in edges.iter_mut().zip(covered) {
        let [a, b] = edge.vertices.map(|v| mesh.positions[v as usize].as_dvec3());
        if covered > 0.0 && covered >= a.distance(b) - tolerance {
            edge.kind = EdgeKind::Stitched;
        }
    }
    overlaps
}

/// The border edges by their ends. Each runs in the direction of its triangle.
struct Borders<'a> {
    mesh: &'a Mesh,
    weld: &'a Weld,
    normals: &'a [Vec3],
    soft: SoftNormals<'a>,
    edges: &'a [Edge],
    /// (welded point, edge), sorted: the edges that start at the point.
    starts: Vec<(u32, u32)>,
    /// (welded point, edge), sorted: the edges that end at the point.
    ends: Vec<(u32, u32)>,
    /// How far from a line a point on it may lie.
    tolerance: f64,
}

impl<'a> Borders<'a> {
    /// Of very many edges at one point, not all pairs are tried out.
    const MAX_AT_A_POINT: usize = 16;

    fn new(mesh: &'a Mesh, weld: &'a Weld, normals: &'a [Vec3], edges: &'a [Edge]) -> Self {
        let by_end = |end: usize| {
            let borders = edges.iter().zip(0..).filter(|(edge, _)| edge.kind == EdgeKind::Border);
            let mut list: Vec<(u32, u32)> =
                borders.map(|(edge, id)| (weld.representative[edge.vertices[end] as usize], id)).collect();
            list.par_sort_unstable();
            list
        };
        Self {
            mesh,
            weld,
            normals,
            soft: SoftNormals::new(mesh),
            edges,
            starts: by_end(0),
            ends: by_end(1),
            tolerance: 2.0 * TOLERANCE * mesh.bounds().diagonal(),
        }
    }

    /// The part of a sorted list that belongs to a point.
    fn at(list: &[(u32, u32)], point: u32) -> &[(u32, u32)] {
        let first = list.partition_point(|&(p, _)| p < point);
        let count = list[first..].partition_point(|&(p, _)| p == point);
        &list[first..first + count.min(Self::MAX_AT_A_POINT)]
    }

    fn point(&self, edge: u32, end: usize) -> u32 {
        self.weld.representative[self.edges[edge as usize].vertices[end] as usize]
    }

    fn position(&self, edge: u32, end: usize) -> DVec3 {
        self.mesh.positions[self.point(edge, end) as usize].as_dvec3()
    }

    /// Walks along two chains of border edges from a common point, `left` in its direction and `right` against its
    /// own, as long as they stay on one line and until they meet again; notes where they lie on each other.
    fn zip(&self, mut left: u32, mut right: u32, steps_left: &mut usize, overlaps: &mut Vec<EdgeOverlap>) {
        let origin = self.position(left, 0);
        let (to_left, to_right) = (self.position(left, 1) - origin, self.position(right, 0) - origin);
        let along = if to_left.length_squared() > to_right.length_squared() { to_left } else { to_right };
        let Some(direction) = along.try_normalize() else {
            return;
        };
        let along_line = |p: DVec3| {
            let from_origin = p - origin;
            let distance = from_origin.dot(direction);
            let aside = (from_origin - direction * distance).length();
            (aside <= self.tolerance).then_some(distance)
        };
        let mut begin = 0.0;
        while *steps_left > 0 {
            *steps_left -= 1;
            let ends = (along_line(self.position(left, 1)), along_line(self.position(right, 0)));
            let (Some(left_end), Some(right_end)) = ends else {
                return;
            };
            let end = left_end.min(right_end);
            if end <= begin + self.tolerance {
                return;
            }
            overlaps.push(self.overlap(
                left,
                right,
                direction,
                [begin, end].map(|at| origin + direction * at),
            ));
            begin = end;
            if (left_end - right_end).abs() <= self.tolerance {
                return;
            }
            let goes_on = |p: DVec3| along_line(p).is_some_and(|d| d > begin + self.tolerance);
            let next = if left_end < right_end {
                let candidates = Self::at(&self.starts, self.point(left, 1));
                let next = candidates.iter().find(|&&(_, e)| goes_on(self.position(e, 1)));
                next.map(|&(_, edge)| left = edge)
            } else {
                let candidates = Self::at(&self.ends, self.point(right, 0));
                let next = candidates.iter().find(|&&(_, e)| goes_on(self.position(e, 0)));
                next.map(|&(_, edge)| right = edge)
            };
            if next.is_none() {
                return;
            }
        }
    }

    fn overlap(&self, left: u32, right: u32, direction: DVec3, ends: [DVec3; 2]) -> EdgeOverlap {
        let face = |edge: u32| self.edges[edge as usize].faces[0];
        let [n0, n1] = [left, right].map(|edge| self.normals[face(edge) as usize]);
        let [first, second] = [left.min(right), left.max(right)];
        let place = |edge: u32, point: DVec3| {
            let [a, b] = [0, 1].map(|end| self.position(edge, end));
            let share = (point - a).dot(b - a) / a.distance_squared(b);
            (self.edges[edge as usize].vertices, share.clamp(0.0, 1.0) as f32)
        };
        let dihedral = signed_angle(n0, n1, direction.as_vec3());
        let is_soft = dihedral.abs() <= FOLDED
            && ends.iter().all(|&p| self.soft.agree_between([place(left, p), place(right, p)]));
        EdgeOverlap {
            edges: [first, second],
            faces: [face(first), face(second)],
            dihedral,
            is_soft,
            length: ends[0].distance(ends[1]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::primitives::from_triangles;
    use crate::geometry::{Adjacency, clean};

    fn p(x: f32, y: f32) -> Vec3 {
        Vec3::new(x, y, 0.25 * x + y)
    }

    /// Two rectangles that meet along x = 0 with different subdivisions; the second one is tilted by `lift`.
    fn two_sides(left: &[f32], right: &[f32], lift: f32) -> Mesh {
        let mut positions = vec![Vec3::new(-1.0, 0.0, 0.0), Vec3::new(1.0, 0.0, lift)];
        let mut indices = Vec::new();
        for (side, apex) in [(left, 0), (right, 1)] {
            let base = positions.len() as u32;
            positions.extend(side.iter().map(|&y| Vec3::new(0.0, y, 0.0)));
            for k in 0..side.len() as u32 - 1 {
                let (a, b) = (base + k, base + k + 1);
                indices.extend(if apex == 0 { [apex, a, b] } else { [apex, b, a] });
            }
        }
        from_triangles(positions, indices)
    }

    #[test]
    fn unequal_subdivisions_of_one_line_are_stitched() {
        for (left, right) in [
            (&[0.0, 3.0][..], &[0.0, 1.0, 3.0][..]),
            (&[0.0, 3.0], &[0.0, 0.5, 1.0, 2.0, 3.0]),
            (&[0.0, 1.0, 3.0], &[0.0, 2.0, 3.0]),
            (&[0.0, 1.0, 2.5, 3.0], &[0.0, 1.0, 2.0, 3.0]),
        ] {
            let adjacency = Adjacency::new(&two_sides(left, right, 0.1));
            assert_eq!(adjacency.border_count, 4, "{left:?} {right:?}");
            assert_eq!(adjacency.surfaces(0.5).count, 1);
            assert_eq!(adjacency.surfaces(0.01).count, 2);
            for overlap in &adjacency.overlaps {
                assert!(overlap.dihedral < -0.05 && overlap.length > 0.4, "{overlap:?}");
            }
        }
    }

    #[test]
    fn sides_that_only_partly_touch_stay_borders() {
        let adjacency = Adjacency::new(&two_sides(&[0.0, 3.0], &[0.0, 1.0], 0.0));
        assert_eq!(adjacency.overlaps.len(), 1);
        // The short edge is covered; the long one is not.
        assert_eq!(adjacency.border_count, 5);
        let apart = Adjacency::new(&two_sides(&[0.0, 3.0], &[1.0, 2.0], 0.0));
        assert_eq!((apart.overlaps.len(), apart.border_count), (0, 6));
    }

    #[test]
    fn dropping_a_triangle_without_area_opens_no_border() {
        let positions = vec![p(0.0, 0.0), p(1.0, 0.0), p(2.0, 0.0), p(1.0, 1.0), p(1.0, -1.0)];
        // The upper side uses the middle vertex, the lower does not; the third triangle joins them.
        let mesh = from_triangles(positions, vec![0, 1, 3, 1, 2, 3, 0, 4, 2, 0, 2, 1]);
        let (mesh, report) = clean(mesh);
        assert_eq!(report.degenerate, 1);
        let adjacency = Adjacency::new(&mesh);
        assert_eq!((adjacency.border_count, adjacency.surfaces(0.1).count), (4, 1));
    }
}
