//! Where triangles run through each other. Pictures have lines there from [`crate::geometry::intersections`], of which this knows
//! nothing: a measure that shared its mistakes could not see them.

use glam::DVec3;
use rayon::prelude::*;

use super::PlacedMesh;
use super::world_edge::WorldEdge;
use crate::geometry::{Bounds, Bvh};

/// Share of the scene's diagonal below which a corner counts as lying on a plane.
const ON_PLANE: f64 = 1e-6;

/// The intersections between different meshes, and inside one mesh between triangles that have no corner in common.
/// `firsts` are the meshes' first triangles and objects. Triangles in one plane do not intersect, nor do surfaces that
/// touch along an edge of both: what that edge is, its own triangles say.
pub(super) fn find(
    meshes: &[PlacedMesh<'_>],
    firsts: &[(usize, u32)],
    tree: &Bvh,
    triangles: &[[DVec3; 3]],
) -> Vec<WorldEdge> {
    let all = triangles.iter().flatten().filter(|p| p.is_finite());
    let bounds = all.fold(Bounds::EMPTY, |all, &p| all.union(&Bounds { min: p, max: p }));
    let tolerance = ON_PLANE * bounds.diagonal();
    let mesh_of = |triangle: usize| firsts.partition_point(|&(first, _)| first <= triangle) - 1;
    let points = |mesh: usize, triangle: usize| {
        let PlacedMesh { mesh: own, adjacency, .. } = meshes[mesh];
        let point = |v: u32| adjacency.weld.representative.get(v as usize).copied();
        own.triangles().get(triangle - firsts[mesh].0).map(|t| t.map(point))
    };
    (0..triangles.len())
        .into_par_iter()
        .flat_map_iter(|one| {
            let corners = triangles[one];
            let [a, b, c] = corners;
            let mesh = mesh_of(one);
            let own_points = points(mesh, one);
            let mut found = Vec::new();
            tree.overlapping(&Bounds { min: a.min(b).min(c), max: a.max(b).max(c) }, |other| {
                // Each pair once.
                if other <= one {
                    return;
                }
                let is_inside = mesh_of(other) == mesh;
                let are_neighbors = || {
                    let others = points(mesh, other);
                    own_points.zip(others).is_none_or(|(own, others)| own.iter().any(|p| others.contains(p)))
                };
                let Some(ends) = crossing([corners, triangles[other]], tolerance) else { return };
                let is_seam =
                    || [corners, triangles[other]].iter().all(|t| along_an_edge(ends, t, 4.0 * tolerance));
                if (is_inside && are_neighbors()) || is_seam() {
                    return;
                }
                found.push(WorldEdge {
                    ends,
                    faces: vec![one as u32, other as u32],
                    wings: Vec::new(),
                    is_soft: false,
                    object: firsts[mesh].1,
                    edge: None,
                    whole: None,
                });
            });
            found
        })
        .collect()
}

/// The segment in which two triangles intersect (after Möller, "A Fast Triangle-Triangle Intersection Test", 1997).
/// A corner on the other plane counts as lying in front of it, so that of the triangles that touch a plane from both
/// sides one intersects it.
fn crossing([t, u]: [[DVec3; 3]; 2], tolerance: f64) -> Option<[DVec3; 2]> {
    let [p, q] = chord(t, u, tolerance)?;
    let [r, s] = chord(u, t, tolerance)?;
    let length = p.distance(q);
    let along = (q - p) / length;
    let (from, to) = ((r - p).dot(along), (s - p).dot(along));
    let (begin, end) = (from.min(to).max(0.0), from.max(to).min(length));
    (end - begin > tolerance).then(|| [p + along * begin, p + along * end])
}

/// Where a triangle cuts the plane of another one.
fn chord(t: [DVec3; 3], [a, b, c]: [DVec3; 3], tolerance: f64) -> Option<[DVec3; 2]> {
    let normal = (b - a).cross(c - a).try_normalize()?;
    let heights = t.map(|p| {
        let height = normal.dot(p - a);
        if height.abs() <= tolerance { 0.0 } else { height }
    });
    let mut ends = (0..3).filter_map(|i| {
        let j = (i + 1) % 3;
        let is_cut = (heights[i] < 0.0) != (heights[j] < 0.0);
        is_cut.then(|| t[i].lerp(t[j], heights[i] / (heights[i] - heights[j])))
    });
    let (p, q) = (ends.next()?, ends.next()?);
    (p.distance(q) > tolerance).then_some([p, q])
}

/// Whether a segment lies on one of a triangle's edges.
fn along_an_edge(ends: [DVec3; 2], t: &[DVec3; 3], tolerance: f64) -> bool {
    (0..3).any(|i| {
        let (a, b) = (t[i], t[(i + 1) % 3]);
        let along = (b - a).normalize_or_zero();
        ends.iter().all(|p| ((p - a) - along * (p - a).dot(along)).length() <= tolerance)
    })
}
