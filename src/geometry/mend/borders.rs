//! The border edges of a mesh, and how they follow each other around its patches.

use glam::DVec3;

use rayon::prelude::*;

use super::super::disjoint_sets::DisjointSets;
use super::super::edge::NO_FACE;
use super::super::{Adjacency, Bounds, EdgeKind, Mesh};

/// Stands for "no border edge".
pub(super) const NO_BORDER: u32 = u32::MAX;

/// Of more border edges at one point, not all are tried out.
pub(super) const MAX_AT_A_POINT: usize = 16;

/// Of more triangles around a point, the border edge on their other side is not looked for.
const MAX_TURNS: usize = 256;

/// An edge of one triangle only.
#[derive(Debug, Clone, Copy)]
pub(super) struct Border {
    /// Index of the edge in [`Adjacency::edges`].
    pub(super) edge: u32,
    /// Its triangle.
    pub(super) face: u32,
    /// The vertices at its ends, in the direction of its triangle.
    pub(super) vertices: [u32; 2],
    /// The welded points of its ends.
    pub(super) ends: [u32; 2],
    /// Where its ends are.
    pub(super) positions: [DVec3; 2],
    /// Unit vector from the first end to the second.
    pub(super) direction: DVec3,
    /// Conormal: the unit vector in the plane of the triangle that leaves the triangle across this edge.
    pub(super) outward: DVec3,
    /// Height of the triangle above this edge, in units of the mesh.
    pub(super) height: f64,
    /// Length of the edge, in units of the mesh.
    pub(super) length: f64,
    /// What its triangle belongs to: all that is connected by common points.
    pub(super) body: u32,
    /// Diagonal of the box around that, in units of the mesh.
    pub(super) body_size: f64,
}

impl Border {
    /// The point at a share of the edge, 0 to 1.
    pub(super) fn at(&self, share: f64) -> DVec3 {
        self.positions[0].lerp(self.positions[1], share)
    }

    /// The share of the edge, 0 to 1, at which it is nearest to a point.
    pub(super) fn nearest(&self, point: DVec3) -> f64 {
        ((point - self.positions[0]).dot(self.direction) / self.length).clamp(0.0, 1.0)
    }

    /// Distance of a point from the edge.
    pub(super) fn distance(&self, point: DVec3) -> f64 {
        self.at(self.nearest(point)).distance(point)
    }

    /// Whether the surface goes on from this edge to the other one without turning by more than an angle, given by the
    /// cosine of its supplement. Sheets that lie on each other turn by 180° at any distance.
    pub(super) fn is_unfolded(&self, other: &Self, cos_limit: f64) -> bool {
        self.outward.dot(other.outward) <= cos_limit
    }

    /// Whether the gap between a point of this edge and one of the other is inside of both triangles, by more than a
    /// share of their heights: these are the two sides of a narrow strip.
    pub(super) fn has_material_in(&self, other: &Self, gap: DVec3, share: f64) -> bool {
        gap.dot(self.outward) < -share * self.height && -gap.dot(other.outward) < -share * other.height
    }

    /// Whether the gap between a point of this edge and one of the other is outside of both triangles, or at most a
    /// share of the triangles' heights inside.
    pub(super) fn is_outside(&self, other: &Self, gap: DVec3, share: f64) -> bool {
        gap.dot(self.outward) >= -share * self.height && -gap.dot(other.outward) >= -share * other.height
    }
}

/// All border edges, sorted by [`Border::edge`].
pub(super) struct Borders {
    pub(super) list: Vec<Border>,
    /// The border edge that follows each around the same fan of triangles, or [`NO_BORDER`].
    pub(super) next: Vec<u32>,
    /// The inverse of `next`.
    pub(super) previous: Vec<u32>,
    /// Total length, in units of the mesh.
    pub(super) length: f64,
    /// For each welded point [`Border::body`].
    pub(super) body_of_point: Vec<u32>,
    starts: PointList,
    ends: PointList,
}

impl Borders {
    pub(super) fn new(mesh: &Mesh, adjacency: &Adjacency) -> Self {
        let weld = &adjacency.weld.representative;
        let is_border = |kind| matches!(kind, EdgeKind::Border | EdgeKind::Stitched);
        let (body_of_point, sizes) = bodies(mesh, weld);
        let list: Vec<Border> = (0..)
            .zip(&adjacency.edges)
            .filter(|(_, edge)| is_border(edge.kind))
            .map(|(number, edge)| {
                let ends = edge.vertices.map(|v| weld[v as usize]);
                let positions = ends.map(|v| mesh.positions[v as usize].as_dvec3());
                let corners = mesh.triangles()[edge.faces[0] as usize];
                let apex = corners.into_iter().find(|v| !ends.contains(&weld[*v as usize]));
                let apex = apex.map_or(positions[0], |v| mesh.positions[v as usize].as_dvec3());
                let length = positions[0].distance(positions[1]);
                let direction = (positions[1] - positions[0]).normalize_or_zero();
                let inward = (apex - positions[0]).reject_from_normalized(direction);
                let body = body_of_point[ends[0] as usize];
                Border {
                    edge: number,
                    face: edge.faces[0],
                    vertices: edge.vertices,
                    ends,
                    positions,
                    direction,
                    outward: -inward.normalize_or_zero(),
                    height: inward.length(),
                    length: length.max(f64::MIN_POSITIVE),
                    body,
                    body_size: sizes[body as usize],
                }
            })
            .collect();
        let point_count = mesh.positions.len();
        let mut all = Self {
            starts: PointList::new(point_count, list.iter().map(|b| b.ends[0])),
            ends: PointList::new(point_count, list.iter().map(|b| b.ends[1])),
            next: vec![NO_BORDER; list.len()],
            previous: vec![NO_BORDER; list.len()],
            length: list.iter().map(|b| b.length).sum(),
            body_of_point,
            list,
        };
        for number in 0..all.list.len() {
            let next = all.find_next(mesh, adjacency, number);
            all.next[number] = next;
            if let Some(previous) = all.previous.get_mut(next as usize) {
                *previous = number as u32;
            }
        }
        all
    }

    /// The border edges that start at a welded point.
    pub(super) fn starting_at(&self, point: u32) -> &[u32] {
        self.starts.of(point)
    }

    /// The border edges that end at a welded point.
    pub(super) fn ending_at(&self, point: u32) -> &[u32] {
        self.ends.of(point)
    }

    pub(super) fn get(&self, border: u32) -> &Border {
        &self.list[border as usize]
    }

    fn find_next(&self, mesh: &Mesh, adjacency: &Adjacency, border: usize) -> u32 {
        let [from, pivot] = self.list[border].ends;
        if let &[only] = self.starting_at(pivot) {
            return only;
        }
        if self.starting_at(pivot).is_empty() {
            return NO_BORDER;
        }
        let weld = &adjacency.weld.representative;
        let (mut face, mut rim) = (self.list[border].face, from);
        for _ in 0..MAX_TURNS {
            let corners = mesh.triangles()[face as usize].map(|v| weld[v as usize]);
            let Some(other_rim) = corners.into_iter().find(|&v| v != pivot && v != rim) else { break };
            let Some(number) = adjacency.edge_between(pivot, other_rim) else { break };
            let edge = &adjacency.edges[number];
            match edge.kind {
                EdgeKind::Manifold | EdgeKind::Flipped => {
                    face = if edge.faces[0] == face { edge.faces[1] } else { edge.faces[0] };
                }
                EdgeKind::NonManifold => break,
                EdgeKind::Border | EdgeKind::Stitched => {
                    let found = self.list.binary_search_by_key(&(number as u32), |b| b.edge);
                    let forward = found.ok().filter(|&next| self.list[next].ends[0] == pivot);
                    return forward.map_or(NO_BORDER, |next| next as u32);
                }
            }
            if face == NO_FACE {
                break;
            }
            rim = other_rim;
        }
        NO_BORDER
    }
}

/// The body of each point, and the diagonal of each body.
fn bodies(mesh: &Mesh, weld: &[u32]) -> (Vec<u32>, Vec<f64>) {
    let sets = DisjointSets::new(mesh.positions.len());
    mesh.triangles().par_iter().with_min_len(16_384).for_each(|triangle| {
        let [a, b, c] = triangle.map(|v| weld[v as usize]);
        sets.unite(a, b);
        sets.unite(a, c);
    });
    let (body_of_point, count) = sets.numbered();
    let mut boxes = vec![Bounds::EMPTY; count];
    for (&body, &position) in body_of_point.iter().zip(&mesh.positions) {
        let bounds = &mut boxes[body as usize];
        let point = position.as_dvec3();
        *bounds = bounds.union(&Bounds { min: point, max: point });
    }
    (body_of_point, boxes.iter().map(Bounds::diagonal).collect())
}

/// For each welded point a list of border edges.
struct PointList {
    offsets: Vec<u32>,
    borders: Vec<u32>,
}

impl PointList {
    fn new(point_count: usize, points: impl Iterator<Item = u32> + Clone) -> Self {
        let mut offsets = vec![0_u32; point_count + 2];
        for p in points.clone() {
            offsets[p as usize + 2] += 1;
        }
        for p in 2..offsets.len() {
            offsets[p] += offsets[p - 1];
        }
        let mut borders = vec![0; offsets.last().map_or(0, |&n| n as usize)];
        for (border, p) in (0..).zip(points) {
            let slot = &mut offsets[p as usize + 1];
            borders[*slot as usize] = border;
            *slot += 1;
        }
        offsets.pop();
        Self { offsets, borders }
    }

    fn of(&self, point: u32) -> &[u32] {
        let range = self.offsets[point as usize] as usize..self.offsets[point as usize + 1] as usize;
        &self.borders[range]
    }
}
