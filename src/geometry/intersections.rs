//! Where surfaces run through each other, as curves: the triangles of one mesh, and those of two placed meshes.
//!
//! 1. Trees over the triangles of both meshes give the pairs whose boxes overlap.
//! 2. Two triangles intersect in what the chords of each in the plane of the other share (Möller, "A Fast Triangle-Triangle
//!    Intersection Test", 1997). A corner in that plane counts as lying in front of it, so that of the triangles that touch it from
//!    both sides one intersects it.
//! 3. Each end of such a segment is a point where an edge of one triangle meets the other triangle. The neighbor across that
//!    edge ends there too, and goes on with the curve.

mod triangles;

use glam::{DMat3, DMat4, DVec3, Vec3};
use rayon::prelude::*;

use self::triangles::{Corners, End, intersection, runs_along_an_edge};
use super::line_chains::{ChainEdge, ChainLink, Chains};
use super::{Bounds, Bvh, Mesh, Weld};

/// Share of the diagonal of both meshes within which a corner lies in a plane.
const IN_PLANE: f64 = 1e-6;
/// Below this angle, in radians, surfaces lie on each other, and where they meet is a matter of rounding.
const LEAST_ANGLE: f32 = 0.01;

/// Triangles that one thread takes at a time.
const TRIANGLES_PER_TASK: usize = 1 << 14;

/// A mesh that is searched for intersections.
pub struct SearchedMesh<'a> {
    mesh: &'a Mesh,
    weld: &'a Weld,
    bounds: Bounds,
    /// The triangles that are searched.
    triangles: Vec<u32>,
    /// Over these, local space.
    tree: Bvh,
}

/// A mesh somewhere in the world.
#[derive(Clone, Copy)]
pub struct Placed<'a> {
    /// The mesh.
    pub mesh: &'a SearchedMesh<'a>,
    /// Local coordinates to world space.
    pub world_from_local: DMat4,
}

/// A curve in which surfaces run through each other.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct IntersectionCurve {
    /// Its corners, in the space of the first mesh. A closed one does not repeat the first.
    pub points: Vec<Vec3>,
    /// Of each segment between two corners, the triangles of the first and of the second mesh.
    pub faces: Vec<[u32; 2]>,
    /// Of each segment, the angle between both surfaces in radians, up to π/2: that between the triangles or that between the shading
    /// normals, whichever is smaller. Round surfaces that lie on each other, like a pin and its hole, run through each other
    /// as their triangles do, and yet have no line there.
    pub angles: Vec<f32>,
    /// Whether it ends where it begins.
    pub is_closed: bool,
}

/// A straight part of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IntersectionSegment {
    /// Its ends, in the space of the first mesh.
    pub ends: [Vec3; 2],
    /// The triangles of the first and of the second mesh.
    pub faces: [u32; 2],
    /// See [`IntersectionCurve::angles`].
    pub angle: f32,
}

impl IntersectionCurve {
    /// Its segments, in order.
    pub fn segments(&self) -> impl Iterator<Item = IntersectionSegment> + '_ {
        let next = self.points.iter().skip(1).chain(self.points.first().filter(|_| self.is_closed));
        let ends = self.points.iter().zip(next).map(|(&a, &b)| [a, b]);
        let others = self.faces.iter().zip(&self.angles);
        ends.zip(others).map(|(ends, (&faces, &angle))| IntersectionSegment { ends, faces, angle })
    }
}

impl<'a> SearchedMesh<'a> {
    /// The triangles of a clean mesh (see [`super::clean()`]) that reach into a region of its local space. Its vertices are welded
    /// as `weld` says. Takes about half a second per million triangles there on two cores.
    pub fn new(mesh: &'a Mesh, weld: &'a Weld, region: &Bounds) -> Self {
        let (mut triangles, mut places) = (Vec::new(), Vec::new());
        if !region.is_empty() {
            for (number, &triangle) in (0_u32..).zip(mesh.triangles()) {
                let corners = mesh.corners(triangle).map(|p| p.as_dvec3());
                if !bounds_of(corners).intersection(region).is_empty() {
                    triangles.push(number);
                    places.push(corners);
                }
            }
        }
        Self { mesh, weld, bounds: mesh.bounds(), triangles, tree: Bvh::new(&places) }
    }

    /// Number of triangles that are searched.
    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// Calls `visit` with the number of each of them whose box overlaps or touches `bounds`.
    fn overlapping(&self, bounds: &Bounds, mut visit: impl FnMut(usize)) {
        self.tree.overlapping(bounds, |index| visit(self.triangles[index] as usize));
    }

    fn triangle(&self, number: usize) -> Option<[u32; 3]> {
        self.mesh.triangles().get(number).copied()
    }

    /// The welded corners of a triangle.
    fn points(&self, triangle: [u32; 3]) -> [u32; 3] {
        triangle.map(|v| self.weld.representative.get(v as usize).copied().unwrap_or(v))
    }

    /// The curves in which triangles of this mesh run through others of it that have no corner in common with them. Looks for
    /// the neighbors of each triangle: about half a second per million triangles on two cores. `goes_on` is told of each number of
    /// triangles that are done, and says whether to go on: `None` when it did not.
    pub fn own_intersections(
        &self,
        goes_on: &(dyn Fn(usize) -> bool + Sync),
    ) -> Option<Vec<IntersectionCurve>> {
        let placed = Placed { mesh: self, world_from_local: DMat4::IDENTITY };
        let pair = Pair::new(placed, placed, true);
        let tasks = self.triangles.par_chunks(TRIANGLES_PER_TASK).with_max_len(1).map(|own| {
            goes_on(own.len())
                .then(|| own.iter().flat_map(|&triangle| pair.segments_of(triangle as usize)).collect())
        });
        let found = tasks.collect::<Option<Vec<Vec<Segment>>>>()?;
        Some(curves(&found.into_iter().flatten().collect::<Vec<_>>()))
    }
}

/// The curves in which two meshes run through each other, as far as their triangles are searched.
pub fn intersections(one: Placed<'_>, other: Placed<'_>) -> Vec<IntersectionCurve> {
    let pair = Pair::new(one, other, false);
    let shared = other.mesh.bounds.transformed(&pair.one_from_other);
    let mut candidates = Vec::new();
    if !shared.is_empty() {
        one.mesh.overlapping(&shared, |triangle| candidates.push(triangle));
    }
    candidates.sort_unstable();
    let all = candidates.into_par_iter();
    curves(&all.flat_map_iter(|triangle| pair.segments_of(triangle)).collect::<Vec<_>>())
}

/// Two meshes, which may be the same, in the space of the first.
struct Pair<'a> {
    one: &'a SearchedMesh<'a>,
    other: &'a SearchedMesh<'a>,
    one_from_other: DMat4,
    other_from_one: DMat4,
    /// Of directions in the space of the first mesh to those in the world, up to a factor, and the same for normals of both.
    world_from_one: DMat3,
    normal_matrices: [DMat3; 2],
    tolerance: f64,
    is_same: bool,
}

/// A straight part of a curve, with what its ends are known by.
struct Segment {
    ends: [DVec3; 2],
    names: [u128; 2],
    faces: [u32; 2],
    angle: f32,
}

impl<'a> Pair<'a> {
    fn new(one: Placed<'a>, other: Placed<'a>, is_same: bool) -> Self {
        let one_from_world = one.world_from_local.inverse();
        let one_from_other = if is_same { DMat4::IDENTITY } else { one_from_world * other.world_from_local };
        let in_world = |placed: &Placed<'_>| DMat3::from_mat4(placed.world_from_local);
        let bounds = one.mesh.bounds.union(&other.mesh.bounds.transformed(&one_from_other));
        Self {
            one: one.mesh,
            other: other.mesh,
            one_from_other,
            other_from_one: one_from_other.inverse(),
            world_from_one: in_world(&one),
            normal_matrices: [&one, &other].map(|placed| in_world(placed).inverse().transpose()),
            tolerance: IN_PLANE * bounds.diagonal(),
            is_same,
        }
    }

    /// The segments of one of the first mesh's triangles.
    fn segments_of(&self, number: usize) -> Vec<Segment> {
        let mut found = Vec::new();
        let Some(triangle) = self.one.triangle(number) else { return found };
        let corners = Corners::new(self.one.mesh.corners(triangle).map(|p| p.as_dvec3()));
        let there = corners.at.map(|p| self.other_from_one.transform_point3(p));
        let points = self.one.points(triangle);
        self.other.overlapping(&bounds_of(there), |other| {
            // Each pair once.
            if self.is_same && other <= number {
                return;
            }
            let Some(other_triangle) = self.other.triangle(other) else { return };
            let other_points = self.other.points(other_triangle);
            if self.is_same && points.iter().any(|point| other_points.contains(point)) {
                return;
            }
            let at = self.other.mesh.corners(other_triangle).map(|p| p.as_dvec3());
            let at = if self.is_same { at } else { at.map(|p| self.one_from_other.transform_point3(p)) };
            let both = [corners, Corners::new(at)];
            let Some((ends, origins)) = intersection(&both, self.tolerance) else { return };
            if both.iter().all(|t| runs_along_an_edge(ends, t, 4.0 * self.tolerance)) {
                return;
            }
            let angle = self.angle(&both, [triangle, other_triangle], ends);
            if angle < LEAST_ANGLE {
                return;
            }
            let faces = [number as u32, other as u32];
            let names = origins.map(|end| self.name(end, [points, other_points], faces));
            found.push(Segment { ends, names, faces, angle });
        });
        found
    }

    /// A number for the point where an edge meets a triangle, the same from both sides of the edge.
    fn name(&self, end: End, points: [[u32; 3]; 2], faces: [u32; 2]) -> u128 {
        let of_second = usize::from(end.of_second);
        let corners = points[of_second];
        let (a, b) = (corners[end.edge], corners[(end.edge + 1) % 3]);
        let met = faces[1 - of_second];
        let mesh = if self.is_same { 0 } else { of_second as u128 };
        mesh << 96 | u128::from(a.min(b)) << 64 | u128::from(a.max(b)) << 32 | u128::from(met)
    }

    /// See [`IntersectionCurve::angles`].
    fn angle(&self, both: &[Corners; 2], triangles: [[u32; 3]; 2], ends: [DVec3; 2]) -> f32 {
        let middle = ends[0].midpoint(ends[1]);
        let faces = both.map(|t| {
            let [a, b] = [t.at[1] - t.at[0], t.at[2] - t.at[0]].map(|side| self.world_from_one * side);
            a.cross(b)
        });
        let meshes = [self.one.mesh, self.other.mesh];
        let shading: [DVec3; 2] = std::array::from_fn(|i| {
            let normals = triangles[i].map(|v| meshes[i].normals.get(v as usize));
            let [Some(a), Some(b), Some(c)] = normals else { return faces[i] };
            let weights = both[i].weights(middle);
            let normal = a.as_dvec3() * weights.x + b.as_dvec3() * weights.y + c.as_dvec3() * weights.z;
            self.normal_matrices[i] * normal
        });
        let between = |[one, other]: [DVec3; 2]| {
            let cosine = one.normalize_or_zero().dot(other.normalize_or_zero());
            cosine.abs().min(1.0).acos() as f32
        };
        between(faces).min(between(shading))
    }
}

fn bounds_of([a, b, c]: [DVec3; 3]) -> Bounds {
    Bounds { min: a.min(b).min(c), max: a.max(b).max(c) }
}

/// Joins segments to curves.
fn curves(segments: &[Segment]) -> Vec<IntersectionCurve> {
    let mut names: Vec<u128> = segments.iter().flat_map(|s| s.names).collect();
    names.sort_unstable();
    names.dedup();
    let number = |name: u128| names.binary_search(&name).ok().map(|n| n as u32);
    let edges: Vec<ChainEdge> =
        segments.iter().map(|s| ChainEdge { ends: s.names.map(number), kind: 0 }).collect();
    let chains = Chains::new(&edges, |_, _| true);
    chains.iter().map(|(links, is_closed)| curve(segments, links, is_closed)).collect()
}

fn curve(segments: &[Segment], links: &[ChainLink], is_closed: bool) -> IntersectionCurve {
    let mut all = IntersectionCurve { is_closed, ..IntersectionCurve::default() };
    let mut last = None;
    for link in links {
        let Some(segment) = segments.get(link.link as usize) else { continue };
        let [from, to] = segment.ends;
        all.points.push(if link.reversed { to } else { from }.as_vec3());
        all.faces.push(segment.faces);
        all.angles.push(segment.angle);
        last = Some(if link.reversed { from } else { to }.as_vec3());
    }
    all.points.extend(last.filter(|_| !is_closed));
    all
}

#[cfg(test)]
mod tests;
