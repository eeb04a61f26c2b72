//! Drops triangles that nothing can be drawn from, so that everything after it can trust a mesh.

use glam::{Vec2, Vec3};
use rayon::prelude::*;

use super::normals::face_normal;
use super::{Mesh, Submesh};

/// What [`clean`] dropped or repaired.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct CleanReport {
    /// Triangles dropped because an index points behind the last vertex.
    pub out_of_range: usize,
    /// Triangles dropped because a corner is NaN or infinite.
    pub not_finite: usize,
    /// Triangles dropped because they have no area: repeated, coincident or collinear corners.
    pub degenerate: usize,
    /// Triangles dropped because an earlier one has the same three corners, in whatever order.
    pub duplicate: usize,
    /// Vertex normals that had no direction and were replaced by the normal of a triangle.
    pub bad_normals: usize,
    /// Attributes (normals, texture coordinates, …) dropped because their number differs from that of the vertices.
    pub bad_attributes: usize,
}

impl CleanReport {
    /// Whether nothing was wrong.
    pub fn is_clean(&self) -> bool {
        *self == Self::default()
    }

    /// Number of triangles dropped.
    pub fn dropped(&self) -> usize {
        self.out_of_range + self.not_finite + self.degenerate + self.duplicate
    }

    /// One sentence for a person per kind of fault.
    pub fn messages(&self) -> Vec<String> {
        let triangles = |n: usize, why: &str| {
            let s = if n == 1 { "" } else { "s" };
            (n > 0).then(|| format!("left out {n} triangle{s} {why}"))
        };
        [
            triangles(self.out_of_range, "with a vertex index out of range"),
            triangles(self.not_finite, "with a NaN or infinite coordinate"),
            triangles(self.degenerate, "without area (degenerate)"),
            triangles(self.duplicate, "that repeat another one (duplicate)"),
            (self.bad_normals > 0)
                .then(|| format!("replaced vertex normals without a direction: {}", self.bad_normals)),
            (self.bad_attributes > 0)
                .then(|| format!("ignored vertex attributes of the wrong length: {}", self.bad_attributes)),
        ]
        .into_iter()
        .flatten()
        .collect()
    }
}

/// A triangle's fate: a hash of its corners when it stays (the top bit is set), else one of the reasons below.
type Verdict = u64;
const STAYS: Verdict = 1 << 63;
const OUT_OF_RANGE: Verdict = 0;
const NOT_FINITE: Verdict = 1;
const DEGENERATE: Verdict = 2;
const DUPLICATE: Verdict = 3;

/// Drops what cannot be drawn; afterwards indices are in range, positions finite, triangles have an area and differ,
/// normals are unit vectors, and `parts` cover all indices. A mesh without faults is returned as it is; else vertices
/// that no triangle uses are dropped too. Empty parts go.
pub fn clean(mut mesh: Mesh) -> (Mesh, CleanReport) {
    let mut report = CleanReport { bad_attributes: drop_misfits(&mut mesh), ..CleanReport::default() };
    let whole = mesh.indices.len() / 3 * 3;
    if whole < mesh.indices.len() {
        mesh.indices.truncate(whole);
        report.out_of_range += 1;
    }

    let all_finite = mesh.positions.par_iter().all(|p| p.is_finite());
    let mut verdicts: Vec<Verdict> = mesh
        .triangles()
        .par_iter()
        .with_min_len(8192)
        .map(|&triangle| judge(&mesh.positions, all_finite, triangle))
        .collect();
    for duplicate in duplicates(&mesh, &verdicts) {
        verdicts[duplicate as usize] = DUPLICATE;
    }

    let fates: [usize; 4] = verdicts
        .par_chunks(65_536)
        .map(|verdicts| {
            let mut counts = [0; 4];
            for &v in verdicts.iter().filter(|&&v| v < STAYS) {
                counts[v as usize] += 1;
            }
            counts
        })
        .reduce(|| [0; 4], |a, b| std::array::from_fn(|i| a[i] + b[i]));
    report.out_of_range += fates[OUT_OF_RANGE as usize];
    report.not_finite = fates[NOT_FINITE as usize];
    report.degenerate = fates[DEGENERATE as usize];
    report.duplicate = fates[DUPLICATE as usize];

    if report.dropped() > 0 {
        keep(&mut mesh, &verdicts);
    }
    mesh.submeshes.retain(|part| part.index_count > 0);
    if report.dropped() > 0 || !all_finite {
        mesh = mesh.without_unused_vertices();
    }
    report.bad_normals = repair_normals(&mut mesh);
    for uv in &mut mesh.uvs {
        if !uv.is_finite() {
            *uv = Vec2::ZERO;
        }
    }
    (mesh, report)
}

/// Empties attributes that are not one per vertex; returns how many.
fn drop_misfits(mesh: &mut Mesh) -> usize {
    fn check<T>(attribute: &mut Vec<T>, vertices: usize) -> usize {
        let misfit = !attribute.is_empty() && attribute.len() != vertices;
        if misfit {
            attribute.clear();
        }
        usize::from(misfit)
    }
    let n = mesh.positions.len();
    check(&mut mesh.normals, n)
        + check(&mut mesh.uvs, n)
        + check(&mut mesh.colors, n)
        + check(&mut mesh.tangents, n)
}

#[inline]
fn judge(positions: &[Vec3], all_finite: bool, [a, b, c]: [u32; 3]) -> Verdict {
    let corner = |v: u32| positions.get(v as usize).copied();
    let (Some(a), Some(b), Some(c)) = (corner(a), corner(b), corner(c)) else {
        return OUT_OF_RANGE;
    };
    if !(all_finite || [a, b, c].iter().all(|p| p.is_finite())) {
        return NOT_FINITE;
    }
    if is_degenerate(a, b, c) {
        return DEGENERATE;
    }
    // The sum does not depend on the order of the corners.
    corner_hash(a).wrapping_add(corner_hash(b)).wrapping_add(corner_hash(c)) | STAYS
}

/// Whether the height of the triangle is less than 1e-9 of its longest side.
#[inline]
fn is_degenerate(a: Vec3, b: Vec3, c: Vec3) -> bool {
    let (u, v) = (b - a, c - a);
    let longest = u.length_squared().max(v.length_squared());
    let area = u.cross(v).length_squared();
    // Most triangles are far from the limit, and single precision tells.
    if area > 1e-4 * longest * longest && area > 1e-30 && area < 1e30 {
        return false;
    }
    let [a, b, c] = [a, b, c].map(Vec3::as_dvec3);
    let (u, v) = (b - a, c - a);
    let longest = u.length_squared().max(v.length_squared()).max((c - b).length_squared());
    u.cross(v).length_squared() <= 1e-18 * longest * longest
}

#[inline]
fn corner_hash(p: Vec3) -> u64 {
    // Adding 0 makes −0 equal to 0.
    let [x, y, z] = (p + Vec3::ZERO).to_array().map(|c| u64::from(c.to_bits()));
    let h = (x | y << 32) ^ z.wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29);
    let h = (h ^ h >> 32).wrapping_mul(0xd6e8_feb8_6659_fd93);
    (h ^ h >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9)
}

/// Triangles that have the same corners as an earlier one, in whatever order.
fn duplicates(mesh: &Mesh, verdicts: &[Verdict]) -> Vec<u32> {
    // Each shard looks at its share of the hashes, in filters that fit into a core's cache.
    (0..SHARDS).into_par_iter().flat_map_iter(|shard| duplicates_in_shard(mesh, verdicts, shard)).collect()
}

const SHARD_BITS: u32 = 2;
const SHARDS: u64 = 1 << SHARD_BITS;

fn duplicates_in_shard(mesh: &Mesh, verdicts: &[Verdict], shard: u64) -> Vec<u32> {
    // Two small Bloom filters, of 8 to 16 bits per triangle, tell which hashes may have occurred more than once.
    let words = (verdicts.len() >> (SHARD_BITS + 3)).next_power_of_two();
    let (mut once, mut twice) = (vec![0_u64; words], vec![0_u64; words]);
    let place = |triangle: u32| {
        let v = verdicts[triangle as usize];
        let word = (v >> (SHARD_BITS + 6)) as usize & (words - 1);
        (word, 1 << (v >> SHARD_BITS & 63))
    };
    let mine = select(0..verdicts.len() as u32, |triangle| {
        let v = verdicts[triangle as usize];
        v >= STAYS && v % SHARDS == shard
    });
    for &triangle in &mine {
        let (word, bit) = place(triangle);
        twice[word] |= once[word] & bit;
        once[word] |= bit;
    }
    let suspects = select(mine.iter().copied(), |triangle| {
        let (word, bit) = place(triangle);
        twice[word] & bit != 0
    });
    let mut suspects: Vec<(Verdict, u32)> =
        suspects.into_iter().map(|triangle| (verdicts[triangle as usize], triangle)).collect();
    suspects.sort_unstable();

    let corners = |t: u32| {
        let mut corners =
            mesh.corners(mesh.triangles()[t as usize]).map(|p| (p + Vec3::ZERO).to_array().map(f32::to_bits));
        corners.sort_unstable();
        corners
    };
    let mut found = Vec::new();
    for same_hash in suspects.chunk_by(|a, b| a.0 == b.0) {
        if same_hash.len() < 2 {
            continue;
        }
        let mut by_corners: Vec<_> = same_hash.iter().map(|&(_, t)| (corners(t), t)).collect();
        by_corners.sort_unstable();
        for pair in by_corners.windows(2) {
            if pair[0].0 == pair[1].0 {
                found.push(pair[1].1);
            }
        }
    }
    found
}

/// `items.filter(wanted)` without a branch per item, which a processor could not predict here.
fn select(items: impl ExactSizeIterator<Item = u32>, wanted: impl Fn(u32) -> bool) -> Vec<u32> {
    let mut selected = vec![0; items.len() + 1];
    let mut count = 0;
    for item in items {
        selected[count] = item;
        count += usize::from(wanted(item));
    }
    selected.truncate(count);
    selected
}

/// Drops the triangles that do not stay.
fn keep(mesh: &mut Mesh, verdicts: &[Verdict]) {
    let mut indices = Vec::with_capacity(mesh.indices.len());
    let triangles = mesh.indices.as_chunks::<3>().0;
    for part in &mut mesh.submeshes {
        let first = (part.first_index as usize / 3).min(triangles.len());
        let end = (first + part.index_count as usize / 3).min(triangles.len());
        let new_first = indices.len();
        for (triangle, &verdict) in triangles[first..end].iter().zip(&verdicts[first..end]) {
            if verdict >= STAYS {
                indices.extend_from_slice(triangle);
            }
        }
        *part = Submesh {
            first_index: new_first as u32,
            index_count: (indices.len() - new_first) as u32,
            ..*part
        };
    }
    mesh.indices = indices;
}

/// Makes every normal a unit vector; returns how many had no direction.
fn repair_normals(mesh: &mut Mesh) -> usize {
    let is_unit = |n: &Vec3| (n.length_squared() - 1.0).abs() < 1e-3;
    if mesh.normals.par_iter().all(is_unit) {
        return 0;
    }
    let mut lost = vec![false; mesh.normals.len()];
    for (normal, lost) in mesh.normals.iter_mut().zip(&mut lost) {
        let unit = normal.as_dvec3().normalize_or_zero().as_vec3();
        *lost = unit == Vec3::ZERO || !unit.is_finite();
        *normal = if *lost { Vec3::Z } else { unit };
    }
    let count = lost.iter().filter(|&&l| l).count();
    if count > 0 {
        for t in 0..mesh.triangle_count() {
            let triangle = mesh.triangles()[t];
            for v in triangle {
                if std::mem::take(&mut lost[v as usize]) {
                    mesh.normals[v as usize] = face_normal(mesh.corners(triangle));
                }
            }
        }
    }
    count
}

#[cfg(test)]
#[path = "clean_tests.rs"]
mod tests;
