//! Takes meshes apart into patches, each with vertices of its own and with its border tessellated by itself: what
//! exporters of solids leave behind.
//!
//! The module that includes this one names `Adjacency`, `Mesh` and `Submesh`.

use std::collections::{BTreeMap, BTreeSet};

use glam::Vec3;

use super::{Adjacency, Mesh, Submesh};

/// Which vertices the patches still have in common.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Common {
    /// All vertices of the mesh; only what is cut anew differs.
    Vertices,
    /// The points where three patches or more meet.
    Corners,
    /// None: all are displaced, each patch by itself.
    Nothing,
}

/// How a mesh is taken apart.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Repatch {
    /// Angle of the edges that separate patches, in radians.
    pub(crate) crease_angle: f32,
    /// Number of planes at random places that separate patches besides.
    pub(crate) planes: usize,
    /// An edge between patches gets up to so many vertices on each side, at different places.
    pub(crate) max_cuts: u32,
    /// How far a vertex of a border lies from the original edge at most, as a share of the diagonal of its body: of all
    /// that has points in common.
    pub(crate) crack: f32,
    pub(crate) common: Common,
    pub(crate) seed: u64,
}

impl Default for Repatch {
    fn default() -> Self {
        Self { crease_angle: 0.5, planes: 3, max_cuts: 1, crack: 0.0, common: Common::Vertices, seed: 1 }
    }
}

/// A mesh in patches.
pub(crate) struct Repatched {
    pub(crate) mesh: Mesh,
    /// The patch of each triangle; the triangles are sorted by it.
    pub(crate) patch_of_triangle: Vec<u32>,
    /// The pairs of patches, the smaller number first, that had an edge in common.
    pub(crate) neighbors: BTreeSet<[u32; 2]>,
}

impl Repatch {
    /// Takes a clean mesh apart. Normals and texture coordinates are kept.
    pub(crate) fn apply(&self, mesh: &Mesh) -> Repatched {
        let adjacency = Adjacency::new(mesh);
        let mut random = Random(self.seed);
        let patches = self.patches(mesh, &adjacency, &mut random);
        let mut neighbors = BTreeSet::new();
        let mut patches_at: BTreeMap<u32, BTreeSet<u32>> = BTreeMap::new();
        let mut is_seam = BTreeSet::new();
        let point = |v: u32| adjacency.weld.representative[v as usize];
        for edge in &adjacency.edges {
            let Some(&other) = patches.get(edge.faces[1] as usize) else { continue };
            let patch = patches[edge.faces[0] as usize];
            if patch != other {
                neighbors.insert([patch.min(other), patch.max(other)]);
                let ends = edge.vertices.map(point);
                is_seam.insert([ends[0].min(ends[1]), ends[0].max(ends[1])]);
                for end in ends {
                    patches_at.entry(end).or_default().extend([patch, other]);
                }
            }
        }

        let sizes = sizes_of_bodies(mesh, &adjacency.weld.representative);
        let mut order: Vec<usize> = (0..patches.len()).collect();
        order.sort_by_key(|&t| patches[t]);
        let mut new = Mesh { has_computed_normals: mesh.has_computed_normals, ..Mesh::default() };
        let mut patch_of_triangle = Vec::new();
        let mut vertices: BTreeMap<(u32, u32), u32> = BTreeMap::new();
        let mut displaced: BTreeMap<(u32, u32), Vec3> = BTreeMap::new();
        for triangle in order {
            let patch = patches[triangle];
            let old = mesh.triangles()[triangle];
            let reach = self.crack * sizes[point(old[0]) as usize];
            let corners = old.map(|v| {
                *vertices.entry((patch, v)).or_insert_with(|| {
                    let around = patches_at.get(&point(v)).map_or(0, BTreeSet::len);
                    let stays = match self.common {
                        Common::Vertices => true,
                        Common::Corners => around != 2,
                        Common::Nothing => around == 0,
                    };
                    append(&mut new, mesh, [v, v], 0.0);
                    let offset = *displaced
                        .entry((patch, point(v)))
                        .or_insert_with(|| if stays { Vec3::ZERO } else { random.in_ball() * reach });
                    let last = new.positions.len() - 1;
                    new.positions[last] += offset;
                    last as u32
                })
            });
            let on_edges = std::array::from_fn(|k| {
                let ends = [old[k], old[(k + 1) % 3]];
                let points = ends.map(point);
                if !is_seam.contains(&[points[0].min(points[1]), points[0].max(points[1])]) {
                    return Vec::new();
                }
                let mut shares: Vec<f32> =
                    (0..random.below(self.max_cuts + 1)).map(|_| 0.1 + 0.8 * random.unit()).collect();
                shares.sort_by(f32::total_cmp);
                shares.dedup_by(|a, b| *a - *b < 0.05);
                let moved = |v: usize| new.positions[corners[v] as usize];
                let (from, to) = (moved(k), moved((k + 1) % 3));
                let places: Vec<Vec3> =
                    shares.iter().map(|&s| from.lerp(to, s) + random.in_ball() * reach).collect();
                shares
                    .iter()
                    .zip(places)
                    .map(|(&share, place)| {
                        append(&mut new, mesh, ends, share);
                        let last = new.positions.len() - 1;
                        new.positions[last] = place;
                        last as u32
                    })
                    .collect()
            });
            cover(corners, on_edges, &mut new.indices);
            patch_of_triangle.resize(new.indices.len() / 3, patch);
        }
        new.submeshes = vec![Submesh { first_index: 0, index_count: new.indices.len() as u32, material: 0 }];
        Repatched { mesh: new, patch_of_triangle, neighbors }
    }

    /// The patch of each triangle: surfaces between creases, cut further by planes.
    fn patches(&self, mesh: &Mesh, adjacency: &Adjacency, random: &mut Random) -> Vec<u32> {
        let bounds = mesh.bounds();
        let planes: Vec<(Vec3, Vec3)> = (0..self.planes)
            .map(|_| {
                let at = Vec3::new(random.unit(), random.unit(), random.unit());
                let (low, high) = (bounds.min.as_vec3(), bounds.max.as_vec3());
                (random.in_ball(), low + (high - low) * (0.2 + 0.6 * at))
            })
            .collect();
        let surfaces = adjacency.surfaces(self.crease_angle);
        let mut numbers: BTreeMap<(u32, u64), u32> = BTreeMap::new();
        mesh.triangles()
            .iter()
            .zip(surfaces.of_triangle)
            .map(|(&triangle, surface)| {
                let middle = mesh.corners(triangle).into_iter().sum::<Vec3>() / 3.0;
                let sides =
                    planes.iter().fold(0, |s, (n, p)| s << 1 | u64::from((middle - *p).dot(*n) > 0.0));
                let next = numbers.len() as u32;
                *numbers.entry((surface, sides)).or_insert(next)
            })
            .collect()
    }
}

/// For each point the diagonal of the box around all that is connected with it.
fn sizes_of_bodies(mesh: &Mesh, weld: &[u32]) -> Vec<f32> {
    let mut parent: Vec<usize> = (0..weld.len()).collect();
    let root = |parent: &mut Vec<usize>, mut point: usize| {
        while parent[point] != point {
            parent[point] = parent[parent[point]];
            point = parent[point];
        }
        point
    };
    for triangle in mesh.triangles() {
        let [a, b, c] = triangle.map(|v| root(&mut parent, weld[v as usize] as usize));
        parent[b] = a;
        let c = root(&mut parent, c);
        parent[c] = a;
    }
    let mut boxes = vec![[Vec3::INFINITY, Vec3::NEG_INFINITY]; weld.len()];
    for &v in &mesh.indices {
        let body = root(&mut parent, weld[v as usize] as usize);
        let [low, high] = boxes[body];
        let position = mesh.positions[v as usize];
        boxes[body] = [low.min(position), high.max(position)];
    }
    (0..weld.len())
        .map(|point| boxes[root(&mut parent, point)])
        .map(|[low, high]| if low.x <= high.x { low.distance(high) } else { 0.0 })
        .collect()
}

/// Appends a vertex of another mesh, at a share of the way between two of its vertices.
fn append(new: &mut Mesh, old: &Mesh, ends: [u32; 2], share: f32) {
    let [a, b] = ends.map(|v| v as usize);
    new.positions.push(old.positions[a].lerp(old.positions[b], share));
    if !old.normals.is_empty() {
        new.normals.push(old.normals[a].lerp(old.normals[b], share).normalize_or(old.normals[a]));
    }
    if !old.uvs.is_empty() {
        new.uvs.push(old.uvs[a].lerp(old.uvs[b], share));
    }
}

/// Triangles that cover one with further vertices on its edges.
fn cover([a, b, c]: [u32; 3], on_edges: [Vec<u32>; 3], indices: &mut Vec<u32>) {
    let [mut ab, bc, ca] = on_edges;
    if ab.is_empty() && bc.is_empty() && ca.is_empty() {
        indices.extend([a, b, c]);
    } else if ab.is_empty() {
        cover([b, c, a], [bc, ca, ab], indices);
    } else {
        let first = ab.remove(0);
        cover([a, first, c], [Vec::new(), Vec::new(), ca], indices);
        cover([first, b, c], [ab, bc, Vec::new()], indices);
    }
}

/// The generator `SplitMix64`.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    /// From 0 to 1.
    pub(crate) fn unit(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / (1_u64 << 24) as f32
    }

    pub(crate) fn below(&mut self, limit: u32) -> u32 {
        (self.bits() % u64::from(limit)) as u32
    }

    /// In the ball around the origin with radius 1.
    pub(crate) fn in_ball(&mut self) -> Vec3 {
        loop {
            let point = Vec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - 1.0;
            if point.length_squared() <= 1.0 {
                return point;
            }
        }
    }
}
