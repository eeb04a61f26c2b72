//! The bodies of a mesh: its parts that are connected across edges of any kind, and which of them enclose a volume.
//!
//! A body is closed if at every edge as many triangles run one way as the other, and if next to nothing of its borders
//! is uncovered. That holds too where four triangles meet because bodies touch along an edge, whichever of them belong
//! together. A closed body that encloses a positive volume is solid; one that encloses a negative volume within a solid
//! one is a cavity of that.
//!
//! Bodies are made of whole surfaces, so that only edges between surfaces have to be followed.

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use super::disjoint_sets::DisjointSets;
use super::feature_edges::stretches::seams_by_edge;
use super::{Adjacency, Bounds, EdgeKind, Mesh, Surfaces};

/// Share of the length of a body's borders that may be uncovered although it counts as closed.
const UNCOVERED: f64 = 0.005;
/// Width of the widest gap in a closed body, as a share of the diagonal of the mesh.
const WIDEST_GAP: f64 = 2e-3;
/// A border edge that others cover more often than this has more triangles on one side than on the other.
const OVERFULL: f64 = 1.25;
/// Pairs of bodies that are compared to find cavities; of those beyond nothing is believed.
const MOST_PAIRS: usize = 1 << 22;
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
        let is_closed = Rims::new(mesh, adjacency, &all, count).closed();
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
        // Neighbours in the list mostly belong to one body; their sum is added at once.
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

    /// Of the bodies that are inside out, leaves only those to be cavities that lie in the box around a solid one.
    fn open_what_no_solid_surrounds(&mut self, mesh: &Mesh) {
        if !self.kinds.contains(&BodyKind::Cavity) {
            return;
        }
        let mut boxes = vec![Bounds::EMPTY; self.kinds.len()];
        for (&triangle, number) in mesh.triangles().iter().zip(0..) {
            let bounds = &mut boxes[self.of_triangle(number)];
            *bounds = bounds.union(&Bounds::of_points(&mesh.corners(triangle)));
        }
        let solids: Vec<Bounds> = self
            .kinds
            .iter()
            .zip(&boxes)
            .filter(|(kind, _)| **kind == BodyKind::Solid)
            .map(|(_, bounds)| *bounds)
            .collect();
        let mut pairs_left = MOST_PAIRS;
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
    adjacency.seams.iter().for_each(|seam| unite(seam.faces));
    sets.numbered()
}

/// How the edges of a body close it.
#[derive(Clone, Copy, Default)]
struct Rim {
    /// At some edge more triangles run one way than the other.
    is_unbalanced: bool,
    /// Length of all border edges, units of the mesh.
    length: f64,
    /// Length of them on which no other lies.
    uncovered: f64,
}

/// The edges of all bodies.
struct Rims(Vec<Rim>);

impl Rims {
    fn new(mesh: &Mesh, adjacency: &Adjacency, bodies: &Bodies, count: usize) -> Self {
        let mut rims = vec![Rim::default(); count];
        let Adjacency { edges, seams, weld, .. } = adjacency;
        let touches = |kind| edges.iter().filter(move |edge| edge.kind == kind);
        if adjacency.flipped_count > 0 {
            for edge in touches(EdgeKind::Flipped) {
                rims[bodies.of_triangle(edge.faces[0])].is_unbalanced = true;
            }
        }
        // Of the triangles at an edge, one less for each that runs the other way.
        for same in adjacency.non_manifold.chunk_by(|a, b| a.0 == b.0) {
            let point = |v: u32| weld.representative.get(v as usize).copied();
            let start_and_end = edges.get(same[0].0 as usize).map(|edge| edge.vertices.map(point));
            let runs_along = |face: u32| {
                let Some(&[a, b, c]) = mesh.triangles().get(face as usize) else { return false };
                [[a, b], [b, c], [c, a]].iter().any(|side| Some(side.map(point)) == start_and_end)
            };
            let along = same.iter().filter(|(_, face)| runs_along(*face)).count();
            if 2 * along != same.len() {
                rims[bodies.of_triangle(same[0].1)].is_unbalanced = true;
            }
        }
        if adjacency.border_count == 0 && seams.is_empty() {
            return Self(rims);
        }
        let by_edge = seams_by_edge(adjacency);
        let mut by_edge = by_edge.chunk_by(|a, b| a.0 == b.0).peekable();
        for (edge, number) in edges.iter().zip(0..) {
            if !matches!(edge.kind, EdgeKind::Border | EdgeKind::Stitched) {
                continue;
            }
            let own = by_edge.next_if(|own| own[0].0 == number).unwrap_or_default();
            let lengths =
                own.iter().filter_map(|&(_, seam)| seams.get(seam as usize)).map(|seam| seam.length);
            let covered: f64 = lengths.sum();
            let [a, b] = edge.vertices.map(|v| mesh.positions.get(v as usize).copied().unwrap_or_default());
            let length = a.as_dvec3().distance(b.as_dvec3());
            let rim = &mut rims[bodies.of_triangle(edge.faces[0])];
            rim.length += length;
            rim.is_unbalanced |= covered > OVERFULL * length + bodies.widest_gap;
            if edge.kind == EdgeKind::Border {
                rim.uncovered += (length - covered).max(0.0);
            }
        }
        Self(rims)
    }

    fn closed(self) -> Vec<bool> {
        self.0.iter().map(|rim| !rim.is_unbalanced && rim.uncovered <= UNCOVERED * rim.length).collect()
    }
}

#[cfg(test)]
#[path = "bodies_tests.rs"]
mod tests;
