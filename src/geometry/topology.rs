//! The edges of a mesh: which triangles meet where, and at what angle.
//!
//! Built once per mesh; what depends on the crease angle is in [`super::surfaces`].

mod half_edges;

use glam::Vec3;
use rayon::prelude::*;

use self::half_edges::{HalfEdges, next_in_triangle};
use super::edge::{Edge, EdgeKind, FOLDED, NO_FACE, signed_angle};
use super::edge_overlaps::{EdgeOverlap, find_overlaps};
use super::needles::{judge_needles, slivers};
use super::normals::face_normals;
use super::soft_edges::{SoftNormals, judge_steep};
use super::{BorderLink, CreaseRule, Mesh, Weld};

/// All edges of a mesh, sorted by their smaller, then their larger welded end.
#[derive(Debug, Clone, PartialEq)]
pub struct Adjacency {
    /// Which vertices are one point.
    pub weld: Weld,
    /// The edges.
    pub edges: Vec<Edge>,
    /// `edges[first_edge[v]..first_edge[v + 1]]` are the edges whose smaller end is the welded vertex `v`
    /// ([`Weld::representative`]). One entry more than there are vertices.
    pub first_edge: Vec<u32>,
    /// Where border edges lie on each other without sharing both ends.
    pub overlaps: Vec<EdgeOverlap>,
    /// Every (edge, triangle) of the non-manifold edges, in order.
    pub non_manifold: Vec<(u32, u32)>,
    /// The border edges at which other meshes go on, each with an index into [`Mesh::border_links`], in order.
    pub border_links: Vec<(u32, u32)>,
    /// Triangles with two corners at one welded point, which take part in no edge, each with a triangle that it
    /// borders on ([`NO_FACE`] if there is none).
    pub collapsed: Vec<(u32, u32)>,
    /// Triangles that errors of the positions may have turned over, each with one that faces the eye when it should.
    pub slivers: Vec<[u32; 2]>,
    /// Number of triangles.
    pub face_count: usize,
    /// Number of border edges, without the stitched ones.
    pub border_count: usize,
    /// Number of edges with more than two triangles.
    pub non_manifold_count: usize,
    /// Number of edges between triangles that disagree about inside and outside.
    pub flipped_count: usize,
    /// Whether isolated creases (`feature_edges/isolated.rs`) are none: the mesh has no normals of its own, so that nothing but
    /// the angle tells creases.
    pub leaves_out_isolated: bool,
}

impl Adjacency {
    /// Finds the edges of a clean mesh (indices in range, positions finite; see [`super::clean()`]).
    ///
    /// # Panics
    /// When an index is out of range.
    pub fn new(mesh: &Mesh) -> Self {
        let (weld, normals) = rayon::join(|| Weld::near(&mesh.positions), || face_normals(mesh));
        let mut half_edges = HalfEdges::new(mesh, &weld);
        let chunks = half_edges.sorted_chunks();
        let mut edges = vec![Edge::border([0; 2], NO_FACE); chunks.iter().map(|c| c.edge_count).sum()];
        let mut first_edge = vec![edges.len() as u32; mesh.positions.len() + 1];

        // Each chunk fills its own range of both arrays.
        let mut jobs = Vec::with_capacity(chunks.len());
        let (mut edges_left, mut first_left) = (edges.as_mut_slice(), first_edge.as_mut_slice());
        let mut base = 0;
        for chunk in &chunks {
            let (own_edges, rest) = edges_left.split_at_mut(chunk.edge_count);
            edges_left = rest;
            let (own_first, rest) = first_left.split_at_mut(chunk.vertices.len());
            first_left = rest;
            jobs.push((chunk.vertices.clone(), base, own_edges, own_first));
            base += chunk.edge_count as u32;
        }
        let context = Context { mesh, weld: &weld, normals: &normals, soft: SoftNormals::new(mesh) };
        let tallies: Vec<Tally> = jobs
            .into_par_iter()
            .map(|(vertices, base, edges, first)| {
                let mut tally = Tally::default();
                let mut next = 0;
                for (v, first) in vertices.zip(first) {
                    *first = base + next as u32;
                    for same in half_edges.of(v).chunk_by(|a, b| a >> 32 == b >> 32) {
                        edges[next] = context.edge(v as u32, same);
                        tally.add(base + next as u32, edges[next].kind, same);
                        next += 1;
                    }
                }
                tally
            })
            .collect();

        let mut all = Self {
            weld,
            edges,
            first_edge,
            overlaps: Vec::new(),
            non_manifold: Vec::new(),
            border_links: Vec::new(),
            collapsed: Vec::new(),
            slivers: Vec::new(),
            face_count: mesh.triangle_count(),
            border_count: 0,
            non_manifold_count: 0,
            flipped_count: 0,
            leaves_out_isolated: !mesh.has_own_normals(),
        };
        for tally in tallies {
            all.border_count += tally.border;
            all.non_manifold_count += tally.non_manifold;
            all.flipped_count += tally.flipped;
            all.non_manifold.extend(tally.faces);
        }
        if all.border_count > 0 {
            all.overlaps = find_overlaps(mesh, &all.weld, &normals, &mut all.edges);
            let stitched = all.edges.iter().filter(|e| e.kind == EdgeKind::Stitched).count();
            all.border_count -= stitched;
        }
        all.border_links = (0..)
            .zip(&mesh.border_links)
            .filter_map(|(number, BorderLink { vertices: [a, b], .. })| {
                Some((all.edge_between(*a, *b)? as u32, number))
            })
            .filter(|&(edge, _)| all.edges[edge as usize].kind == EdgeKind::Border)
            .collect();
        all.border_links.sort_unstable();
        judge_needles(mesh, &normals, &mut all);
        all.slivers = slivers(mesh, &normals, &all);
        judge_steep(mesh, &mut all.edges, &mut all.overlaps);
        all.collapsed = half_edges
            .collapsed
            .iter()
            .map(|&face| (face, all.neighbor_of(mesh.triangles()[face as usize])))
            .collect();
        all
    }

    /// Makes every edge above the crease angle a crease, if the rule says so.
    #[must_use]
    pub fn with_rule(mut self, rule: CreaseRule) -> Self {
        if rule == CreaseRule::Angle {
            self.edges.iter_mut().for_each(|edge| edge.is_soft = false);
            self.overlaps.iter_mut().for_each(|overlap| overlap.is_soft = false);
            self.leaves_out_isolated = false;
        }
        self
    }

    /// Whether the mesh encloses a volume: no borders and nothing non-manifold.
    pub fn is_closed(&self) -> bool {
        !self.edges.is_empty() && self.border_count == 0 && self.non_manifold_count == 0
    }

    /// Index of the edge between two vertices, which may be any copies of its ends.
    pub fn edge_between(&self, a: u32, b: u32) -> Option<usize> {
        let point = |v: u32| self.weld.representative.get(v as usize).copied();
        let (a, b) = (point(a)?, point(b)?);
        if a == b {
            return None;
        }
        let (low, high) = (a.min(b), a.max(b));
        let mut range =
            *self.first_edge.get(low as usize)? as usize..*self.first_edge.get(low as usize + 1)? as usize;
        range.find(|&e| {
            let [u, v] = self.edges[e].vertices;
            point(u) == Some(high) || point(v) == Some(high)
        })
    }

    /// How a border edge goes on in another mesh, if it does: an index into [`Mesh::border_links`].
    pub fn border_link(&self, edge: u32) -> Option<u32> {
        let found = self.border_links.binary_search_by_key(&edge, |&(edge, _)| edge).ok()?;
        self.border_links.get(found).map(|&(_, beyond)| beyond)
    }

    /// A triangle on any edge between these vertices.
    fn neighbor_of(&self, [a, b, c]: [u32; 3]) -> u32 {
        [(a, b), (b, c), (c, a)]
            .into_iter()
            .find_map(|(from, to)| self.edge_between(from, to))
            .map_or(NO_FACE, |edge| self.edges[edge].faces[0])
    }
}

#[derive(Default)]
struct Tally {
    border: usize,
    non_manifold: usize,
    flipped: usize,
    faces: Vec<(u32, u32)>,
}

impl Tally {
    fn add(&mut self, edge: u32, kind: EdgeKind, half_edges: &[u64]) {
        match kind {
            EdgeKind::Border => self.border += 1,
            EdgeKind::Manifold | EdgeKind::Stitched => {}
            EdgeKind::Flipped => self.flipped += 1,
            EdgeKind::NonManifold => {
                self.non_manifold += 1;
                let faces = half_edges.iter().map(|&h| (edge, h as u32 / 3));
                self.faces.extend(faces);
            }
        }
    }
}

/// What is needed to describe one edge.
struct Context<'a> {
    mesh: &'a Mesh,
    weld: &'a Weld,
    normals: &'a [Vec3],
    soft: SoftNormals<'a>,
}

impl Context<'_> {
    /// The edge made of these half-edges, whose smaller end is the welded vertex `low`.
    fn edge(&self, low: u32, half_edges: &[u64]) -> Edge {
        let start = |h: u32| self.mesh.indices[h as usize];
        let runs_up = |h: u32| self.weld.representative[start(h) as usize] == low;
        let first = half_edges[0] as u32;
        let vertices = [start(first), start(next_in_triangle(first))];
        let Some(&second) = half_edges.get(1) else {
            return Edge::border(vertices, first / 3);
        };
        let second = second as u32;
        let flipped = runs_up(first) == runs_up(second);
        let kind = match (half_edges.len(), flipped) {
            (2, false) => EdgeKind::Manifold,
            (2, true) => EdgeKind::Flipped,
            _ => EdgeKind::NonManifold,
        };
        let faces = [first / 3, second / 3];
        let [n0, n1] = faces.map(|f| self.normals[f as usize]);
        let n1 = if flipped { -n1 } else { n1 };
        let [a, b] = vertices.map(|v| self.mesh.positions[v as usize]);
        let dihedral = signed_angle(n0, n1, b - a);
        let is_soft = kind != EdgeKind::NonManifold && dihedral.abs() <= FOLDED && {
            let across = [start(second), start(next_in_triangle(second))];
            let [same, opposite] = if flipped { across } else { [across[1], across[0]] };
            let agree = |ends| self.soft.agree(ends, flipped);
            agree([vertices[0], same]) && agree([vertices[1], opposite])
        };
        Edge { vertices, faces, dihedral, is_soft, kind }
    }
}

#[cfg(test)]
#[path = "topology_tests.rs"]
mod tests;
