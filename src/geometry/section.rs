//! Where a plane cuts a mesh: the contours of the cut, exact, and the cap that fills those of solid bodies.
//!
//! All is computed in the coordinates of the plane: x and y run in it, z runs along its normal. What lies before the
//! plane (z < 0) is kept, what lies in it or beyond it is cut away; each welded vertex is asked once, so that neighboring
//! triangles agree and contours of closed meshes are closed.

mod cap;

use glam::{DMat4, DVec2, DVec3, DVec4};
use rayon::prelude::*;

pub use self::cap::{Cap, Filling, fill};
use super::{Mesh, Plane, Weld};

/// Triangles that one thread takes at a time.
const TRIANGLES_PER_TASK: usize = 1 << 15;

/// Vertices that one thread takes at a time.
const VERTICES_PER_TASK: usize = 1 << 14;

/// A line along which a plane cuts a mesh, in the plane's coordinates. Material lies to its left, seen from above, where
/// the triangles face outwards.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Contour {
    /// Its corners. A closed one does not repeat the first.
    pub points: Vec<DVec2>,
    /// The triangle that each segment between two corners lies in.
    pub triangles: Vec<u32>,
    /// Whether it ends where it begins.
    pub is_closed: bool,
}

impl Contour {
    /// The ends of each segment, and its triangle.
    pub fn segments(&self) -> impl Iterator<Item = ([DVec2; 2], u32)> + '_ {
        let next = self.points.iter().skip(1).chain(self.points.first().filter(|_| self.is_closed));
        self.points.iter().zip(next).zip(&self.triangles).map(|((&a, &b), &t)| ([a, b], t))
    }
}

impl Plane {
    /// Coordinates with the origin in its point: z runs along its normal, x along `right` as far as that lies in the plane.
    pub fn world_from_plane(&self, right: DVec3) -> DMat4 {
        let n = self.normal;
        let x = (right - n * n.dot(right)).try_normalize().unwrap_or_else(|| n.any_orthonormal_vector());
        DMat4::from_cols(x.extend(0.0), n.cross(x).extend(0.0), n.extend(0.0), self.point.extend(1.0))
    }
}

/// Where an edge meets the plane: its two welded vertices, the smaller one first.
type Crossing = u64;

/// A triangle that is cut.
#[derive(Clone, Copy)]
struct CutTriangle {
    from: Crossing,
    to: Crossing,
    triangle: u32,
}

/// The contours of a clean mesh (see [`super::clean()`]), whose vertices are welded as `weld` says. Takes about 5 ms per
/// million triangles on two cores.
pub fn contours(mesh: &Mesh, weld: &Weld, plane_from_local: &DMat4) -> Vec<Contour> {
    let plane = PlaneOf { mesh, plane_from_local };
    let height = plane_from_local.row(2);
    let is_kept: Vec<bool> = weld
        .representative
        .par_iter()
        .with_min_len(VERTICES_PER_TASK)
        .map(|&point| plane.corner(point).is_some_and(|p| height.dot(p) < 0.0))
        .collect();
    // Turned inside out by its place, a mesh has its material on the other side of each contour.
    let is_mirrored = plane_from_local.determinant() < 0.0;
    let segments: Vec<CutTriangle> = mesh
        .triangles()
        .par_chunks(TRIANGLES_PER_TASK)
        .enumerate()
        .flat_map_iter(|(task, triangles)| {
            let (is_kept, weld) = (&is_kept, weld);
            (task * TRIANGLES_PER_TASK..).zip(triangles).filter_map(move |(number, &triangle)| {
                let segment = segment(triangle, number as u32, is_kept, weld)?;
                Some(if is_mirrored {
                    CutTriangle { from: segment.to, to: segment.from, ..segment }
                } else {
                    segment
                })
            })
        })
        .collect();
    chained(&segments).iter().map(|(chain, is_closed)| plane.contour(&segments, chain, *is_closed)).collect()
}

/// Where the plane runs through a triangle, if it does.
fn segment(triangle: [u32; 3], number: u32, is_kept: &[bool], weld: &Weld) -> Option<CutTriangle> {
    let mut kept = [false; 3];
    for (kept, v) in kept.iter_mut().zip(triangle) {
        *kept = *is_kept.get(v as usize)?;
    }
    // The corner that is alone on its side.
    let alone = match kept {
        [a, b, c] if a == b && b == c => return None,
        [a, b, c] if b == c && a != b => 0,
        [a, b, c] if a == c && b != a => 1,
        _ => 2,
    };
    let mut points = [0_u32; 3];
    for (i, point) in points.iter_mut().enumerate() {
        *point = *weld.representative.get(triangle[(alone + i) % 3] as usize)?;
    }
    let [a, b, c] = points;
    let crossing = |i: u32, j: u32| u64::from(i.min(j)) << 32 | u64::from(i.max(j));
    let (one, two) = (crossing(a, b), crossing(c, a));
    let (from, to) = if kept[alone] { (two, one) } else { (one, two) };
    Some(CutTriangle { from, to, triangle: number })
}

/// Segments that follow each other, as indices, and whether the last one ends where the first begins.
fn chained(segments: &[CutTriangle]) -> Vec<(Vec<u32>, bool)> {
    let sorted = |end: fn(&CutTriangle) -> Crossing| {
        let mut order: Vec<(Crossing, u32)> = segments.iter().map(end).zip(0..).collect();
        order.par_sort_unstable();
        order
    };
    let (starts, ends) = (sorted(|s| s.from), sorted(|s| s.to));
    let mut is_taken = vec![false; segments.len()];
    let mut chains = Vec::new();
    let has_before = |s: &CutTriangle| ends.binary_search_by_key(&s.from, |&(at, _)| at).is_ok();
    // Open lines from their beginnings first; what is left are loops.
    for only_beginnings in [true, false] {
        for (first, segment) in (0_u32..).zip(segments) {
            if is_taken[first as usize] || (only_beginnings && has_before(segment)) {
                continue;
            }
            let mut chain = Vec::new();
            let (mut next, mut end) = (Some(first), segment.from);
            while let Some(i) = next {
                is_taken[i as usize] = true;
                chain.push(i);
                end = segments[i as usize].to;
                if end == segment.from {
                    break;
                }
                let at = starts.partition_point(|&(from, _)| from < end);
                let following = starts.iter().skip(at).take_while(|&&(from, _)| from == end);
                next = following.map(|&(_, i)| i).find(|&i| !is_taken[i as usize]);
            }
            chains.push((chain, end == segment.from));
        }
    }
    chains
}

/// A mesh before a plane.
struct PlaneOf<'a> {
    mesh: &'a Mesh,
    plane_from_local: &'a DMat4,
}

impl PlaneOf<'_> {
    fn corner(&self, point: u32) -> Option<DVec4> {
        self.mesh.positions.get(point as usize).map(|p| p.as_dvec3().extend(1.0))
    }

    /// Where an edge meets the plane; the same for all triangles at the edge.
    fn point(&self, crossing: Crossing) -> DVec2 {
        let corner = |point| self.corner(point).map_or(DVec4::ZERO, |p| *self.plane_from_local * p);
        let (a, b) = (corner((crossing >> 32) as u32), corner(crossing as u32));
        let share = a.z / (a.z - b.z);
        let along = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.5 };
        a.truncate().truncate().lerp(b.truncate().truncate(), along)
    }

    fn contour(&self, segments: &[CutTriangle], chain: &[u32], is_closed: bool) -> Contour {
        let of_chain = || chain.iter().filter_map(|&i| segments.get(i as usize));
        let last = of_chain().next_back().filter(|_| !is_closed).map(|s| s.to);
        Contour {
            points: of_chain().map(|s| s.from).chain(last).map(|crossing| self.point(crossing)).collect(),
            triangles: of_chain().map(|s| s.triangle).collect(),
            is_closed,
        }
    }
}

#[cfg(test)]
#[path = "section_tests.rs"]
mod tests;
