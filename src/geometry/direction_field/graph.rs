//! The neighbors of each vertex of a cut mesh, and coarser and coarser versions of them.

use std::collections::VecDeque;

use glam::Vec3;

use super::cut::{CutMesh, transport};

/// From a vertex to a neighbor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Neighbor {
    /// The neighbor.
    pub(crate) to: u32,
    /// How strongly both are coupled: the cotangent weight of Pinkall and Polthier 1993, or what takes its place in
    /// a coarse graph.
    pub(crate) weight: f32,
}

/// Patches of a surface and their neighbors. In the finest graph a patch is one vertex.
pub(crate) struct Graph {
    /// Middle of each patch, 1 = the extent.
    pub(crate) positions: Vec<Vec3>,
    /// Unit normal.
    pub(crate) normals: Vec<Vec3>,
    /// Area.
    pub(crate) areas: Vec<f32>,
    /// `neighbors[first_neighbor[v]..first_neighbor[v + 1]]` are those of `v`, by ascending neighbor.
    pub(crate) first_neighbor: Vec<u32>,
    /// All of them: two patches are neighbors of each other, with one weight.
    pub(crate) neighbors: Vec<Neighbor>,
    /// The patch of the next coarser graph that each is part of, [`NO_PARENT`] if it has no neighbors; empty if there
    /// is no coarser graph.
    pub(crate) parents: Vec<u32>,
}

/// Stands for "part of no coarser patch".
pub(crate) const NO_PARENT: u32 = u32::MAX;
/// All graphs of a hierarchy together have at most this many times the patches of the finest.
const MAX_PATCHES: usize = 4;
/// Cotangents belong to angles of at least this many radians, so that slivers do not dominate.
const MIN_ANGLE: f32 = 0.05;
/// Least weight of an edge.
const MIN_WEIGHT: f32 = 0.02;
/// Patches whose normals differ by more than the angle with this cosine stay apart.
const MIN_COSINE: f32 = 0.7;

impl Graph {
    /// The graph of a cut mesh.
    pub(crate) fn new(cut: &CutMesh, face_areas: &[f32]) -> Self {
        let mut pairs = Vec::with_capacity(cut.triangles.len() * 6);
        for (triangle, &area) in cut.triangles.iter().zip(face_areas) {
            let [a, b, c] = *triangle;
            if area <= 0.0 || a == b || b == c || c == a {
                continue;
            }
            let corners = triangle.map(|v| cut.positions[v as usize]);
            for k in 0..3 {
                let (p, q, apex) = (corners[(k + 1) % 3], corners[(k + 2) % 3], corners[k]);
                let (u, v) = (p - apex, q - apex);
                let largest = 1.0 / MIN_ANGLE.tan();
                let cotangent = (u.dot(v) / u.cross(v).length()).clamp(-largest, largest);
                let weight = if cotangent.is_finite() { 0.5 * cotangent } else { 0.0 };
                let (i, j) = (triangle[(k + 1) % 3], triangle[(k + 2) % 3]);
                pairs.push((i, Neighbor { to: j, weight }));
                pairs.push((j, Neighbor { to: i, weight }));
            }
        }
        let (first_neighbor, mut neighbors) = gather_neighbors(cut.len(), &pairs);
        for neighbor in &mut neighbors {
            neighbor.weight = neighbor.weight.max(MIN_WEIGHT);
        }
        Self {
            positions: cut.positions.clone(),
            normals: cut.normals.clone(),
            areas: cut.areas.clone(),
            first_neighbor,
            neighbors,
            parents: Vec::new(),
        }
    }

    /// Number of patches.
    pub(crate) fn len(&self) -> usize {
        self.positions.len()
    }

    /// Where the neighbors of a patch are.
    pub(crate) fn range(&self, v: usize) -> std::ops::Range<usize> {
        self.first_neighbor[v] as usize..self.first_neighbor[v + 1] as usize
    }

    /// The patches that have a parent, each with it.
    pub(crate) fn children(&self) -> impl Iterator<Item = (usize, usize)> {
        let pairs = self.parents.iter().enumerate();
        pairs.filter(|(_, parent)| **parent != NO_PARENT).map(|(v, parent)| (v, *parent as usize))
    }

    /// Turns directions around so that neighbors agree, wherever that is possible. Where it is not, the last pairs of
    /// the shortest ways from the first patch of each connected part have one of either kind.
    pub(crate) fn align(&self, directions: &mut [Vec3]) {
        let mut is_done = vec![false; self.len()];
        let mut queue = VecDeque::new();
        for seed in 0..self.len() {
            if is_done[seed] {
                continue;
            }
            is_done[seed] = true;
            queue.push_back(seed);
            while let Some(v) = queue.pop_front() {
                for neighbor in &self.neighbors[self.range(v)] {
                    let to = neighbor.to as usize;
                    if !is_done[to] {
                        is_done[to] = true;
                        let here = transport(directions[to], self.normals[to], self.normals[v]);
                        if here.dot(directions[v]) < 0.0 {
                            directions[to] = -directions[to];
                        }
                        queue.push_back(to);
                    }
                }
            }
        }
    }

    /// This graph and coarser ones, each with a third to a quarter of the patches, down to about `least` patches or
    /// until nothing more can be joined.
    pub(crate) fn hierarchy(self, least: usize) -> Vec<Self> {
        let mut patches_left = self.len() * (MAX_PATCHES - 1);
        let mut graphs = vec![self];
        while let Some(fine) = graphs.last_mut() {
            if fine.len() <= least {
                break;
            }
            let (parents, count) = fine.patches();
            if count == 0 || count >= fine.len() || count > patches_left {
                break;
            }
            patches_left -= count;
            let coarse = fine.joined(&parents, count);
            fine.parents = parents;
            graphs.push(coarse);
        }
        graphs
    }

    /// Joins each patch that is still free with its free neighbors to which it is coupled most, in order.
    fn patches(&self) -> (Vec<u32>, usize) {
        const MAX_MEMBERS: usize = 4;
        let mut parents = vec![NO_PARENT; self.len()];
        let mut count = 0_u32;
        let mut nearest: Vec<(f32, u32)> = Vec::new();
        for v in 0..self.len() {
            if parents[v] != NO_PARENT {
                continue;
            }
            let neighbors = &self.neighbors[self.range(v)];
            if neighbors.is_empty() {
                continue;
            }
            let strongest = neighbors.iter().fold(0.0_f32, |s, neighbor| s.max(neighbor.weight));
            let fits = |neighbor: &&Neighbor| {
                neighbor.weight >= 0.25 * strongest
                    && self.normals[v].dot(self.normals[neighbor.to as usize]) > MIN_COSINE
            };
            nearest.clear();
            nearest.extend(
                neighbors
                    .iter()
                    .filter(fits)
                    .filter(|neighbor| parents[neighbor.to as usize] == NO_PARENT)
                    .map(|neighbor| (neighbor.weight, neighbor.to)),
            );
            nearest.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            if nearest.is_empty()
                && let Some(neighbor) =
                    neighbors.iter().filter(fits).max_by(|a, b| a.weight.total_cmp(&b.weight))
            {
                // What is left over between patches becomes part of one.
                parents[v] = parents[neighbor.to as usize];
                continue;
            }
            parents[v] = count;
            for &(_, neighbor) in nearest.iter().take(MAX_MEMBERS - 1) {
                parents[neighbor as usize] = count;
            }
            count += 1;
        }
        (parents, count as usize)
    }

    fn joined(&self, parents: &[u32], count: usize) -> Self {
        let mut positions = vec![Vec3::ZERO; count];
        let mut normals = vec![Vec3::ZERO; count];
        let mut areas = vec![0.0; count];
        for (v, &parent) in parents.iter().enumerate().filter(|(_, p)| **p != NO_PARENT) {
            let area = self.areas[v].max(1e-30);
            positions[parent as usize] += self.positions[v] * area;
            normals[parent as usize] += self.normals[v] * area;
            areas[parent as usize] += area;
        }
        for ((position, normal), &area) in positions.iter_mut().zip(&mut normals).zip(&areas) {
            *position /= area;
            *normal = normal.normalize_or(Vec3::Z);
        }
        // The weight between neighbors is the length of the border between two patches over the distance of their middles.
        let mut pairs = Vec::with_capacity(self.neighbors.len());
        for v in 0..self.len() {
            for neighbor in &self.neighbors[self.range(v)] {
                let (from, to) = (parents[v], parents[neighbor.to as usize]);
                if from != to {
                    let border =
                        neighbor.weight * self.positions[v].distance(self.positions[neighbor.to as usize]);
                    let distance = positions[from as usize].distance(positions[to as usize]);
                    let weight = (border / distance.max(1e-30)).min(neighbor.weight * 4.0);
                    pairs.push((from, Neighbor { to, weight }));
                }
            }
        }
        let (first_neighbor, neighbors) = gather_neighbors(count, &pairs);
        Self { positions, normals, areas, first_neighbor, neighbors, parents: Vec::new() }
    }
}

/// Sorts neighbors by the patch that they belong to, and adds up those between the same two.
fn gather_neighbors(count: usize, pairs: &[(u32, Neighbor)]) -> (Vec<u32>, Vec<Neighbor>) {
    // A counting sort. Counts are kept two places ahead, so that filling leaves the offsets behind.
    let mut offsets = vec![0_u32; count + 2];
    for &(from, _) in pairs {
        offsets[from as usize + 2] += 1;
    }
    for v in 2..offsets.len() {
        offsets[v] += offsets[v - 1];
    }
    let mut neighbors = vec![Neighbor { to: 0, weight: 0.0 }; pairs.len()];
    for &(from, neighbor) in pairs {
        let slot = &mut offsets[from as usize + 1];
        neighbors[*slot as usize] = neighbor;
        *slot += 1;
    }
    offsets.pop();
    let mut kept = 0;
    let mut begin = 0;
    for v in 0..count {
        let end = offsets[v + 1] as usize;
        // Stable, so that sums do not depend on anything but the order of the triangles.
        neighbors[begin..end].sort_by_key(|neighbor| neighbor.to);
        let first = kept;
        for k in begin..end {
            if kept > first && neighbors[kept - 1].to == neighbors[k].to {
                neighbors[kept - 1].weight += neighbors[k].weight;
            } else {
                neighbors[kept] = neighbors[k];
                kept += 1;
            }
        }
        offsets[v] = first as u32;
        begin = end;
    }
    if let Some(last) = offsets.last_mut() {
        *last = kept as u32;
    }
    neighbors.truncate(kept);
    (offsets, neighbors)
}
