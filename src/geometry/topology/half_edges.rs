//! Half-edges in buckets, so that those of one edge stand together.

use rayon::prelude::*;

use crate::geometry::{Mesh, Weld};

/// Half-edge `3 t + k` runs from corner `k` of triangle `t` to the next.
pub(super) fn next_in_triangle(half_edge: u32) -> u32 {
    if half_edge % 3 == 2 { half_edge - 2 } else { half_edge + 1 }
}

/// All half-edges in buckets by their smaller welded end.
pub(super) struct HalfEdges {
    /// Per half-edge: the larger welded end (high 32 bits) and the half-edge (low 32 bits).
    entries: Vec<u64>,
    /// Bucket `v` is `entries[offsets[v]..offsets[v + 1]]`.
    offsets: Vec<u32>,
    pub(super) collapsed: Vec<u32>,
}

/// A range of buckets that one thread works on.
pub(super) struct Chunk {
    pub(super) vertices: std::ops::Range<usize>,
    pub(super) edge_count: usize,
}

impl HalfEdges {
    pub(super) fn new(mesh: &Mesh, weld: &Weld) -> Self {
        let vertex_count = mesh.positions.len();
        let points = |t: &[u32; 3]| t.map(|v| weld.representative[v as usize]);
        let is_collapsed = |[a, b, c]: [u32; 3]| a == b || b == c || c == a;

        // A counting sort. Counts are kept two places ahead, so that filling leaves the offsets behind.
        let mut offsets = vec![0_u32; vertex_count + 2];
        let mut collapsed = Vec::new();
        for (t, triangle) in mesh.triangles().iter().enumerate() {
            let [a, b, c] = points(triangle);
            if is_collapsed([a, b, c]) {
                collapsed.push(t as u32);
                continue;
            }
            for low in [a.min(b), b.min(c), c.min(a)] {
                offsets[low as usize + 2] += 1;
            }
        }
        for v in 2..offsets.len() {
            offsets[v] += offsets[v - 1];
        }
        let mut entries = vec![0_u64; offsets[vertex_count + 1] as usize];
        for (t, triangle) in mesh.triangles().iter().enumerate() {
            let [a, b, c] = points(triangle);
            if is_collapsed([a, b, c]) {
                continue;
            }
            for (k, (from, to)) in [(a, b), (b, c), (c, a)].into_iter().enumerate() {
                let slot = &mut offsets[from.min(to) as usize + 1];
                entries[*slot as usize] = u64::from(from.max(to)) << 32 | (3 * t + k) as u64;
                *slot += 1;
            }
        }
        offsets.pop();
        Self { entries, offsets, collapsed }
    }

    pub(super) fn of(&self, v: usize) -> &[u64] {
        &self.entries[self.offsets[v] as usize..self.offsets[v + 1] as usize]
    }

    /// Sorts every bucket, and counts the edges of ranges of about equal work.
    pub(super) fn sorted_chunks(&mut self) -> Vec<Chunk> {
        let vertex_count = self.offsets.len() - 1;
        let wanted = rayon::current_num_threads() * 8;
        let per_chunk = self.entries.len() / wanted + 1024;
        let mut jobs = Vec::with_capacity(wanted);
        let mut entries = self.entries.as_mut_slice();
        let mut start = 0;
        while start < vertex_count {
            let begin = self.offsets[start] as usize;
            let end = (start
                + 1
                + self.offsets[start + 1..vertex_count]
                    .partition_point(|&o| (o as usize) < begin + per_chunk))
            .min(vertex_count);
            let (own, rest) = entries.split_at_mut(self.offsets[end] as usize - begin);
            entries = rest;
            jobs.push((start..end, begin, own));
            start = end;
        }
        let offsets = &self.offsets;
        jobs.into_par_iter()
            .map(|(vertices, begin, entries)| {
                let mut edge_count = 0;
                for v in vertices.clone() {
                    let bucket = &mut entries[offsets[v] as usize - begin..offsets[v + 1] as usize - begin];
                    bucket.sort_unstable();
                    edge_count += bucket.chunk_by(|a, b| a >> 32 == b >> 32).count();
                }
                Chunk { vertices, edge_count }
            })
            .collect()
    }
}
