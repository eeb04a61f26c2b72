//! The bodies of a mesh: its parts that are connected across edges of any kind, and which of them enclose a volume.
//!
//! A body is closed if at every edge as many triangles run one way as the other. That holds too where four triangles
//! meet because bodies touch along an edge, whichever of them belong together. Where it does not hold, the sides that are
//! left over form rims; a body is still closed if they run around slits only, as where one edge lies on several others or
//! where faces were tessellated apart. A closed body that encloses a positive volume is solid; one that encloses a
//! negative volume within a solid one is a cavity of that.
//!
//! Bodies are made of whole surfaces, so that only edges between surfaces have to be followed.

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use super::disjoint_sets::DisjointSets;
use super::{Adjacency, Bounds, EdgeKind, Mesh, Surfaces, touching};

/// Width of the widest gap in a closed body, as a share of the diagonal of the mesh.
const WIDEST_GAP: f64 = 2e-3;
/// Of very many sides that begin at one point, not all are tried out.
const MAX_AT_A_POINT: usize = 64;
/// Stands for "no point".
const NO_POINT: u32 = u32::MAX;
/// Pairs of bodies that are compared to find cavities; of those beyond nothing is believed.
const MAX_PAIRS: usize = 1 << 22;
/// Bodies of which each is compared with those around it.
const MAX_BODIES: usize = 4096;
/// Triangles that one thread takes at a time.
const TRIANGLES_PER_TASK: usize = 1 << 15;

/// What a body is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BodyKind {
    /// Closed, and its triangles face outwards.
    Solid,
    /// Closed and turned inside out, within a solid one.
    Cavity,
    /// Not closed, or turned inside out.
    Open,
}

/// The bodies of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Bodies {
    surfaces: Arc<Surfaces>,
    of_surface: Vec<u32>,
    kinds: Vec<BodyKind>,
    widest_gap: f64,
}

impl Bodies {
    /// Finds them. Adjacency and surfaces must be those of the same mesh.
    pub fn new(mesh: &Mesh, adjacency: &Adjacency, surfaces: Arc<Surfaces>) -> Self {
        let (of_surface, count) = connected(adjacency, &surfaces);
        let mut all = Self {
            surfaces,
            of_surface,
            kinds: Vec::new(),
            widest_gap: mesh.bounds().diagonal() * WIDEST_GAP,
        };
        let is_closed = closed(mesh, adjacency, &all, count);
        let volumes = if is_closed.contains(&true) { all.volumes(mesh, count) } else { vec![0.0; count] };
        all.kinds = is_closed
            .into_iter()
            .zip(&volumes)
            .map(|(is_closed, &volume)| match volume {
                v if is_closed && v > 0.0 => BodyKind::Solid,
                v if is_closed && v < 0.0 => BodyKind::Cavity,
                _ => BodyKind::Open,
            })
            .collect();
        all.open_what_no_solid_surrounds(mesh);
        all
    }

    /// What each body is; in the order of their first triangles.
    pub fn kinds(&self) -> &[BodyKind] {
        &self.kinds
    }

    /// Number of bodies that enclose no volume, and so get no caps.
    pub fn open_count(&self) -> usize {
        self.kinds.iter().filter(|kind| **kind == BodyKind::Open).count()
    }

    /// The body of a triangle, an index into [`Self::kinds`]; 0 if there is no such triangle.
    pub fn of_triangle(&self, triangle: u32) -> usize {
        let surface = self.surfaces.of_triangle.get(triangle as usize);
        let body = surface.and_then(|&surface| self.of_surface.get(surface as usize));
        body.map_or(0, |&body| body as usize)
    }

    /// Width of the widest gap in a closed body, in units of the mesh.
    pub fn widest_gap(&self) -> f64 {
        self.widest_gap
    }

    /// Six times the volume of each body, if it is closed.
    fn volumes(&self, mesh: &Mesh, count: usize) -> Vec<f64> {
        let corners = |triangle: &[u32; 3]| mesh.corners(*triangle).map(|p| p.as_dvec3());
        // Seen from a corner of the body, so that no digits are lost far from the origin.
        let mut origins = vec![None; count];
        let mut missing = count;
        for (triangle, number) in mesh.triangles().iter().zip(0..) {
            if missing == 0 {
                break;
            }
            let origin: &mut Option<DVec3> = &mut origins[self.of_triangle(number)];
            missing -= usize::from(origin.is_none());
            origin.get_or_insert(corners(triangle)[0]);
        }
        // Neighbors in the list mostly belong to one body; their sum is added at once.
        let sums: Vec<Vec<(usize, f64)>> = mesh
            .triangles()
            .par_chunks(TRIANGLES_PER_TASK)
            .enumerate()
            .map(|(task, triangles)| {
                let mut sums: Vec<(usize, f64)> = Vec::new();
                for (triangle, number) in triangles.iter().zip((task * TRIANGLES_PER_TASK) as u32..) {
                    let body = self.of_triangle(number);
                    let origin = origins[body].unwrap_or_default();
                    let [a, b, c] = corners(triangle).map(|p| p - origin);
                    let volume = a.dot(b.cross(c));
                    match sums.last_mut() {
                        Some((last, sum)) if *last == body => *sum += volume,
                        _ => sums.push((body, volume)),
                    }
                }
                sums
            })
            .collect();
        let mut volumes = vec![0.0; count];
        for (body, sum) in sums.into_iter().flatten() {
            volumes[body] += sum;
        }
        volumes
    }

    /// The box around each body.
    fn boxes(&self, mesh: &Mesh) -> Vec<Bounds> {
        let mut boxes = vec![Bounds::EMPTY; self.kinds.len()];
        for (&triangle, number) in mesh.triangles().iter().zip(0..) {
            let bounds = &mut boxes[self.of_triangle(number)];
            *bounds = bounds.union(&Bounds::of_points(&mesh.corners(triangle)));
        }
        boxes
    }

    /// The box around all places where boxes of different bodies overlap, local space: only there may one run through another. Of
    /// very many bodies the box around the mesh. They must be those of this mesh.
    pub fn shared_region(&self, mesh: &Mesh) -> Bounds {
        if self.kinds.len() <= 1 {
            return Bounds::EMPTY;
        }
        if self.kinds.len() > MAX_BODIES {
            return mesh.bounds();
        }
        let boxes = self.boxes(mesh);
        let shared = touching(&boxes, 0.0).into_iter().map(|[a, b]| boxes[a].intersection(&boxes[b]));
        shared.fold(Bounds::EMPTY, |all, bounds| all.union(&bounds))
    }

    /// Of the bodies that are inside out, leaves only those to be cavities that lie in the box around a solid one.
    fn open_what_no_solid_surrounds(&mut self, mesh: &Mesh) {
        if !self.kinds.contains(&BodyKind::Cavity) {
            return;
        }
        let boxes = self.boxes(mesh);
        let solids: Vec<Bounds> = self
            .kinds
            .iter()
            .zip(&boxes)
            .filter(|(kind, _)| **kind == BodyKind::Solid)
            .map(|(_, bounds)| *bounds)
            .collect();
        let mut pairs_left = MAX_PAIRS;
        for (kind, bounds) in self.kinds.iter_mut().zip(&boxes) {
            if *kind != BodyKind::Cavity {
                continue;
            }
            let compared = &solids[..solids.len().min(pairs_left)];
            pairs_left -= compared.len();
            if !compared.iter().any(|solid| solid.union(bounds) == *solid) {
                *kind = BodyKind::Open;
            }
        }
    }
}

/// The body of each surface, and their number.
fn connected(adjacency: &Adjacency, surfaces: &Surfaces) -> (Vec<u32>, usize) {
    if surfaces.count <= 1 {
        return (vec![0; surfaces.count], surfaces.count);
    }
    let sets = DisjointSets::new(surfaces.count);
    let unite = |[a, b]: [u32; 2]| {
        let [a, b] = [a, b].map(|face| surfaces.of_triangle.get(face as usize));
        if let (Some(&a), Some(&b)) = (a, b)
            && a != b
        {
            sets.unite(a, b);
        }
    };
    adjacency.edges.par_iter().with_min_len(16_384).for_each(|edge| unite(edge.faces));
    for same in adjacency.non_manifold.chunk_by(|a, b| a.0 == b.0) {
        same.windows(2).for_each(|pair| unite([pair[0].1, pair[1].1]));
    }
    adjacency.overlaps.iter().for_each(|overlap| unite(overlap.faces));
    sets.numbered()
}

/// A side of a triangle, or several alike, that no other one meets in the opposite direction.
struct OpenSide {
    /// Welded points.
    ends: [u32; 2],
    count: u32,
    face: u32,
}

/// All open sides of a mesh. They form closed curves: the rims of its holes.
fn open_sides(mesh: &Mesh, adjacency: &Adjacency) -> Vec<OpenSide> {
    let Adjacency { edges, weld, .. } = adjacency;
    let is_balanced =
        adjacency.border_count == 0 && adjacency.flipped_count == 0 && adjacency.overlaps.is_empty();
    if is_balanced && adjacency.non_manifold.is_empty() {
        return Vec::new();
    }
    let point = |v: u32| weld.representative.get(v as usize).copied().unwrap_or(v);
    let mut open = Vec::new();
    for edge in edges {
        let count = match edge.kind {
            EdgeKind::Border | EdgeKind::Stitched => 1,
            EdgeKind::Flipped => 2,
            EdgeKind::Manifold | EdgeKind::NonManifold => continue,
        };
        open.push(OpenSide { ends: edge.vertices.map(point), count, face: edge.faces[0] });
    }
    for same in adjacency.non_manifold.chunk_by(|a, b| a.0 == b.0) {
        let (number, face) = same[0];
        let Some([start, end]) = edges.get(number as usize).map(|edge| edge.vertices.map(point)) else {
            continue;
        };
        let runs_along = |face: u32| {
            let Some(&triangle) = mesh.triangles().get(face as usize) else { return false };
            let [a, b, c] = triangle.map(point);
            [[a, b], [b, c], [c, a]].contains(&[start, end])
        };
        let along = same.iter().filter(|(_, face)| runs_along(*face)).count();
        let against = same.len() - along;
        let ends = if along > against { [start, end] } else { [end, start] };
        if along != against {
            open.push(OpenSide { ends, count: along.abs_diff(against) as u32, face });
        }
    }
    open
}

/// For each of `count` bodies whether its rims run around nothing but slits.
fn closed(mesh: &Mesh, adjacency: &Adjacency, bodies: &Bodies, count: usize) -> Vec<bool> {
    let mut is_closed = vec![true; count];
    let open = open_sides(mesh, adjacency);
    let mut starts: Vec<(u32, u32)> = Vec::with_capacity(open.len());
    for (side, number) in open.iter().zip(0..) {
        starts.extend(std::iter::repeat_n((side.ends[0], number), side.count as usize));
    }
    if starts.is_empty() {
        return is_closed;
    }
    starts.par_sort_unstable();
    // Those at a point are `starts[first_at[point]..first_at[point + 1]]`.
    let mut first_at = vec![0; mesh.positions.len() + 1];
    for &(point, _) in &starts {
        first_at[point as usize + 1] += 1;
    }
    for point in 1..first_at.len() {
        first_at[point] += first_at[point - 1];
    }
    let mut is_taken = vec![false; starts.len()];
    let position = |point: u32| mesh.positions.get(point as usize).map_or(DVec3::ZERO, |p| p.as_dvec3());
    let side_of = |start: usize| &open[starts[start].1 as usize];
    let body_of = |start: usize| bodies.of_triangle(side_of(start).face);
    let direction = |side: &OpenSide| (position(side.ends[1]) - position(side.ends[0])).normalize_or_zero();
    for first in 0..starts.len() {
        let (start, body) = (starts[first].0, body_of(first));
        if is_taken[first] || !is_closed[body] {
            continue;
        }
        let origin = position(start);
        // Twice the area that the rim runs around, as a vector: of slits next to nothing.
        let (mut area, mut length) = (DVec3::ZERO, 0.0);
        let mut next = Some(first);
        let mut end = NO_POINT;
        while let Some(at) = next {
            is_taken[at] = true;
            let side = side_of(at);
            let [a, b] = side.ends.map(|point| position(point) - origin);
            area += a.cross(b);
            length += a.distance(b);
            end = side.ends[1];
            if end == start {
                break;
            }
            // Where several go on, the one that turns back most: the other side of a slit.
            let along = direction(side);
            let turned = |&start: &usize| along.dot(direction(side_of(start)));
            next = (first_at[end as usize]..first_at[end as usize + 1])
                .take(MAX_AT_A_POINT)
                .filter(|&start| !is_taken[start] && body_of(start) == body)
                .min_by(|a, b| turned(a).total_cmp(&turned(b)));
        }
        let is_slit = area.length() <= bodies.widest_gap * length.min(bodies.widest_gap / WIDEST_GAP);
        is_closed[body] = end == start && is_slit;
    }
    is_closed
}

#[cfg(test)]
#[path = "bodies_tests.rs"]
mod tests;
