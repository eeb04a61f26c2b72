//! Where a plane cuts a mesh: the contours of the cut, exact, and the cap that fills those of a solid.
//!
//! All is computed in the coordinates of the plane: x and y run in it, z is the height over it. What lies below the plane
//! is kept, what lies in it or over it is cut away; each welded vertex is asked once, so that neighbouring triangles agree
//! and contours of closed meshes are closed.

use glam::{DMat4, DVec2, DVec3, DVec4};
use i_triangle::float::custom::CustomTriangulatable as _;
use i_triangle::i_overlay::core::fill_rule::FillRule;
use i_triangle::int::validation::Validation;
use rayon::prelude::*;

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
    /// The triangle that each stretch between two corners lies in.
    pub triangles: Vec<u32>,
    /// Whether it ends where it begins.
    pub is_closed: bool,
}

impl Contour {
    /// The ends of each stretch, and its triangle.
    pub fn stretches(&self) -> impl Iterator<Item = ([DVec2; 2], u32)> + '_ {
        let next = self.points.iter().skip(1).chain(self.points.first().filter(|_| self.is_closed));
        self.points.iter().zip(next).zip(&self.triangles).map(|((&a, &b), &t)| ([a, b], t))
    }
}

/// The inside of contours as triangles, in the plane's coordinates.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Cap {
    /// Corners.
    pub points: Vec<DVec2>,
    /// Counter-clockwise seen from above.
    pub triangles: Vec<[u32; 3]>,
}

impl Cap {
    /// The area that it covers.
    pub fn area(&self) -> f64 {
        let corner = |i: u32| self.points.get(i as usize).copied().unwrap_or(DVec2::ZERO);
        self.triangles
            .iter()
            .map(|&[a, b, c]| 0.5 * (corner(b) - corner(a)).perp_dot(corner(c) - corner(a)))
            .sum()
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
struct Stretch {
    from: Crossing,
    to: Crossing,
    triangle: u32,
}

/// The contours of a clean mesh (see [`super::clean()`]), whose vertices are welded as `weld` says. Takes about 5 ms per
/// million triangles on two cores.
pub fn contours(mesh: &Mesh, weld: &Weld, plane_from_local: &DMat4) -> Vec<Contour> {
    let cut = Cut { mesh, plane_from_local };
    let height = plane_from_local.row(2);
    let is_kept: Vec<bool> = weld
        .representative
        .par_iter()
        .with_min_len(VERTICES_PER_TASK)
        .map(|&point| cut.corner(point).is_some_and(|p| height.dot(p) < 0.0))
        .collect();
    // Turned inside out by its place, a mesh has its material on the other side of each contour.
    let is_mirrored = plane_from_local.determinant() < 0.0;
    let stretches: Vec<Stretch> = mesh
        .triangles()
        .par_chunks(TRIANGLES_PER_TASK)
        .enumerate()
        .flat_map_iter(|(task, triangles)| {
            let (is_kept, weld) = (&is_kept, weld);
            (task * TRIANGLES_PER_TASK..).zip(triangles).filter_map(move |(number, &triangle)| {
                let stretch = stretch(triangle, number as u32, is_kept, weld)?;
                Some(if is_mirrored {
                    Stretch { from: stretch.to, to: stretch.from, ..stretch }
                } else {
                    stretch
                })
            })
        })
        .collect();
    chained(&stretches).iter().map(|(chain, is_closed)| cut.contour(&stretches, chain, *is_closed)).collect()
}

/// Where the plane runs through a triangle, if it does.
fn stretch(triangle: [u32; 3], number: u32, is_kept: &[bool], weld: &Weld) -> Option<Stretch> {
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
    Some(Stretch { from, to, triangle: number })
}

/// Stretches that follow each other, as indices, and whether the last one ends where the first begins.
fn chained(stretches: &[Stretch]) -> Vec<(Vec<u32>, bool)> {
    let sorted = |end: fn(&Stretch) -> Crossing| {
        let mut order: Vec<(Crossing, u32)> = stretches.iter().map(end).zip(0..).collect();
        order.par_sort_unstable();
        order
    };
    let (starts, ends) = (sorted(|s| s.from), sorted(|s| s.to));
    let mut is_taken = vec![false; stretches.len()];
    let mut chains = Vec::new();
    let has_before = |s: &Stretch| ends.binary_search_by_key(&s.from, |&(at, _)| at).is_ok();
    // Open lines from their beginnings first; what is left are loops.
    for only_beginnings in [true, false] {
        for (first, stretch) in (0_u32..).zip(stretches) {
            if is_taken[first as usize] || (only_beginnings && has_before(stretch)) {
                continue;
            }
            let mut chain = Vec::new();
            let (mut next, mut end) = (Some(first), stretch.from);
            while let Some(i) = next {
                is_taken[i as usize] = true;
                chain.push(i);
                end = stretches[i as usize].to;
                if end == stretch.from {
                    break;
                }
                let at = starts.partition_point(|&(from, _)| from < end);
                let following = starts.iter().skip(at).take_while(|&&(from, _)| from == end);
                next = following.map(|&(_, i)| i).find(|&i| !is_taken[i as usize]);
            }
            chains.push((chain, end == stretch.from));
        }
    }
    chains
}

/// A mesh before a plane.
struct Cut<'a> {
    mesh: &'a Mesh,
    plane_from_local: &'a DMat4,
}

impl Cut<'_> {
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

    fn contour(&self, stretches: &[Stretch], chain: &[u32], is_closed: bool) -> Contour {
        let of_chain = || chain.iter().filter_map(|&i| stretches.get(i as usize));
        let last = of_chain().next_back().filter(|_| !is_closed).map(|s| s.to);
        Contour {
            points: of_chain().map(|s| s.from).chain(last).map(|crossing| self.point(crossing)).collect(),
            triangles: of_chain().map(|s| s.triangle).collect(),
            is_closed,
        }
    }
}

/// What the contours of one solid enclose: every place around which they run more often to the left than to the right, so
/// that a shell within a shell is hollow if it faces inwards, and bodies that reach into each other are one. `None` unless
/// all of them are closed, and when nothing is enclosed.
pub fn cap(contours: &[Contour]) -> Option<Cap> {
    if contours.is_empty() || !contours.iter().all(|c| c.is_closed) {
        return None;
    }
    let points = || contours.iter().flat_map(|c| &c.points);
    let low = points().fold(DVec2::INFINITY, |low, p| low.min(*p));
    let high = points().fold(DVec2::NEG_INFINITY, |high, p| high.max(*p));
    let (middle, size) = ((low + high) * 0.5, (high - low).max_element());
    if !(points().all(|p| p.is_finite()) && size.is_finite() && size > 0.0) {
        return None;
    }
    let outlines: Vec<Vec<[f64; 2]>> = contours
        .iter()
        .map(|contour| contour.points.iter().map(|p| ((*p - middle) / size).to_array()).collect())
        .collect();
    let validation = Validation::with_fill_rule(FillRule::Positive);
    let filled = outlines.custom_triangulate(validation).to_triangulation::<u32>();
    let points = filled.points.into_iter().map(|p| DVec2::from_array(p) * size + middle).collect();
    let cap = Cap { points, triangles: filled.indices.as_chunks().0.to_vec() };
    (!cap.triangles.is_empty()).then_some(cap)
}

#[cfg(test)]
#[path = "section_tests.rs"]
mod tests;
