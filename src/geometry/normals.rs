//! Normals of triangles, and smooth vertex normals that leave creases sharp.

use glam::Vec3;
use rayon::prelude::*;

use super::{Mesh, Weld, angle};

/// Unit normal of a counter-clockwise triangle; +Z if it has no area.
pub fn face_normal([a, b, c]: [Vec3; 3]) -> Vec3 {
    let normal = (b - a).cross(c - a);
    let length2 = normal.length_squared();
    if length2 > 1e-24 && length2 < 1e24 {
        return normal / length2.sqrt();
    }
    // Very small or very large triangles need the range of double precision.
    let [a, b, c] = [a, b, c].map(Vec3::as_dvec3);
    (b - a).cross(c - a).normalize_or(glam::DVec3::Z).as_vec3()
}

/// The unit normal of every triangle. Indices must be in range.
pub fn face_normals(mesh: &Mesh) -> Vec<Vec3> {
    mesh.triangles().par_iter().with_min_len(4096).map(|&t| face_normal(mesh.corners(t))).collect()
}

/// The mesh without vertex normals: every face is flat.
#[must_use]
pub fn flat(mesh: Mesh) -> Mesh {
    Mesh { normals: Vec::new(), has_computed_normals: false, ..mesh }
}

/// The mesh with smooth normals: at each point, the triangles that are connected across edges with a dihedral angle of
/// at most `degrees` (0 to 180) share the mean of their normals, weighted by their angle at the point. A vertex on a
/// crease is split, with all its attributes; vertices that differ in texture coordinates or color stay apart but get
/// the same normal. Points are welded by position first. The mesh must be clean (see [`super::clean()`]). The normals are
/// marked as computed.
///
/// # Panics
/// When an index is out of range.
#[must_use]
pub fn by_crease_angle(mut mesh: Mesh, degrees: f32) -> Mesh {
    let (weld, faces) = rayon::join(|| Weld::near(&mesh.positions), || face_normals(&mesh));
    let incidence = Incidence::new(&mesh, &weld);
    let smoother = Smoother {
        mesh: &mesh,
        weld: &weld,
        faces: &faces,
        cos_crease: degrees.clamp(0.0, 180.0).to_radians().cos() - 1e-6,
    };
    let points = mesh.positions.len();
    let per_job = points / (rayon::current_num_threads() * 8) + 256;
    let results: Vec<Smoothed> = (0..points)
        .into_par_iter()
        .step_by(per_job)
        .map(|start| {
            let mut out = Smoothed::default();
            let mut scratch = Scratch::default();
            for point in start..(start + per_job).min(points) {
                smoother.smooth(incidence.of(point), &mut scratch, &mut out);
            }
            out
        })
        .collect();

    let mut normals = vec![Vec3::Z; points];
    let mut copies = Vec::new();
    for result in results {
        for (vertex, normal) in result.kept {
            normals[vertex as usize] = normal;
        }
        let base = (points + copies.len()) as u32;
        for (corner, copy) in result.moved {
            mesh.indices[corner as usize] = base + copy;
        }
        for (source, normal) in result.copies {
            copies.push(source);
            normals.push(normal);
        }
    }
    mesh.normals.clear();
    mesh.append_copies(&copies);
    mesh.has_computed_normals = !normals.is_empty();
    mesh.normals = normals;
    mesh
}

/// The corners (positions in `Mesh::indices`) at each welded point.
struct Incidence {
    corners: Vec<u32>,
    offsets: Vec<u32>,
}

impl Incidence {
    fn new(mesh: &Mesh, weld: &Weld) -> Self {
        let points = mesh.positions.len();
        let point_of = |v: u32| weld.representative[v as usize] as usize;
        // A counting sort. Counts are kept two places ahead, so that filling leaves the offsets behind.
        let mut offsets = vec![0_u32; points + 2];
        for &v in &mesh.indices {
            offsets[point_of(v) + 2] += 1;
        }
        for v in 2..offsets.len() {
            offsets[v] += offsets[v - 1];
        }
        let mut corners = vec![0_u32; mesh.indices.len()];
        for (corner, &v) in mesh.indices.iter().enumerate() {
            let slot = &mut offsets[point_of(v) + 1];
            corners[*slot as usize] = corner as u32;
            *slot += 1;
        }
        Self { corners, offsets }
    }

    fn of(&self, point: usize) -> &[u32] {
        &self.corners[self.offsets[point] as usize..self.offsets[point + 1] as usize]
    }
}

/// Normals found by one job.
#[derive(Default)]
struct Smoothed {
    /// (vertex, normal) of vertices that stay.
    kept: Vec<(u32, Vec3)>,
    /// (source vertex, normal) of vertices to append.
    copies: Vec<(u32, Vec3)>,
    /// (corner, index into `copies`) of corners that move to a copy.
    moved: Vec<(u32, u32)>,
}

/// Buffers that are used again from point to point.
#[derive(Default)]
struct Scratch {
    /// The other two points of each corner's triangle: the point (high 32 bits) and the local corner (low 32 bits).
    spokes: Vec<u64>,
    /// Union-find over the local corners.
    parent: Vec<u32>,
    /// Sum of weighted normals, at the root of each group.
    sums: Vec<Vec3>,
    /// (vertex, group root, local corner).
    uses: Vec<(u32, u32, u32)>,
}

impl Scratch {
    fn root(&mut self, mut local: u32) -> u32 {
        while self.parent[local as usize] != local {
            let above = self.parent[self.parent[local as usize] as usize];
            self.parent[local as usize] = above;
            local = above;
        }
        local
    }
}

struct Smoother<'a> {
    mesh: &'a Mesh,
    weld: &'a Weld,
    faces: &'a [Vec3],
    cos_crease: f32,
}

impl Smoother<'_> {
    /// The next and the previous vertex around the corner's triangle.
    fn others(&self, corner: u32) -> [u32; 2] {
        let (triangle, k) = (corner as usize / 3, corner as usize % 3);
        let t = &self.mesh.indices[3 * triangle..3 * triangle + 3];
        [t[(k + 1) % 3], t[(k + 2) % 3]]
    }

    /// The triangle's normal, weighted by its angle at this corner.
    fn weighted_normal(&self, corner: u32) -> Vec3 {
        let at = self.mesh.positions[self.mesh.indices[corner as usize] as usize];
        let [next, previous] = self.others(corner).map(|v| self.mesh.positions[v as usize] - at);
        // Not the arc cosine, which loses the small angles of a fan.
        let sine = next.cross(previous).length();
        let angle = if sine > 1e-12 && sine < 1e12 {
            angle::from_sine_and_cosine(sine, next.dot(previous))
        } else {
            let (u, v) = (next.as_dvec3(), previous.as_dvec3());
            u.cross(v).length().atan2(u.dot(v)) as f32
        };
        self.faces[corner as usize / 3] * angle
    }

    fn smooth(&self, corners: &[u32], scratch: &mut Scratch, out: &mut Smoothed) {
        if corners.is_empty() {
            return;
        }
        scratch.spokes.clear();
        scratch.parent.clear();
        for (local, &corner) in corners.iter().enumerate() {
            scratch.parent.push(local as u32);
            for v in self.others(corner) {
                let point = self.weld.representative[v as usize];
                scratch.spokes.push(u64::from(point) << 32 | local as u64);
            }
        }
        // Corners that share an edge at this point stand together.
        scratch.spokes.sort_unstable();
        let mut start = 0;
        while start < scratch.spokes.len() {
            let point = scratch.spokes[start] >> 32;
            let mut end = start + 1;
            while end < scratch.spokes.len() && scratch.spokes[end] >> 32 == point {
                end += 1;
            }
            // Of many triangles at one edge, neighbors in the list are compared, to stay linear.
            let reach = if end - start <= 8 { end - start } else { 2 };
            for i in start..end {
                for j in i + 1..(i + reach).min(end) {
                    self.unite(corners, scratch, i, j);
                }
            }
            start = end;
        }
        self.emit(corners, scratch, out);
    }

    fn unite(&self, corners: &[u32], scratch: &mut Scratch, i: usize, j: usize) {
        let (a, b) = (scratch.spokes[i] as u32, scratch.spokes[j] as u32);
        let normal = |local: u32| self.faces[corners[local as usize] as usize / 3];
        if normal(a).dot(normal(b)) >= self.cos_crease {
            let (a, b) = (scratch.root(a), scratch.root(b));
            scratch.parent[a.max(b) as usize] = a.min(b);
        }
    }

    /// Sums up the groups and gives each vertex its normal, or copies of it theirs.
    fn emit(&self, corners: &[u32], scratch: &mut Scratch, out: &mut Smoothed) {
        scratch.sums.clear();
        scratch.sums.resize(corners.len(), Vec3::ZERO);
        scratch.uses.clear();
        for (local, &corner) in corners.iter().enumerate() {
            let root = scratch.root(local as u32);
            scratch.parent[local] = root;
            scratch.sums[root as usize] += self.weighted_normal(corner);
            let vertex = self.mesh.indices[corner as usize];
            scratch.uses.push((vertex, root, local as u32));
        }
        scratch.uses.sort_unstable();
        let mut previous = None;
        let mut copied = false;
        for &(vertex, root, local) in &scratch.uses {
            let same_vertex = previous.is_some_and(|(v, _)| v == vertex);
            if previous != Some((vertex, root)) {
                let fallback = self.faces[corners[local as usize] as usize / 3];
                let normal = scratch.sums[root as usize].normalize_or(fallback);
                copied = same_vertex;
                if copied {
                    out.copies.push((vertex, normal));
                } else {
                    out.kept.push((vertex, normal));
                }
            }
            if copied {
                let copy = out.copies.len() as u32 - 1;
                out.moved.push((corners[local as usize], copy));
            }
            previous = Some((vertex, root));
        }
    }
}

#[cfg(test)]
#[path = "normals_tests.rs"]
mod tests;
