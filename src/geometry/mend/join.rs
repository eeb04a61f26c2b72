//! Gives both sides of every seam the same vertices, at the same places.

use std::collections::{HashMap, HashSet};

use glam::Vec4;

use super::super::{Mesh, Submesh};
use super::border_points::{Insertion, PointGroups};
use super::borders::Borders;
use super::settle::{Settled, settle};
use super::split::CutTriangle;

/// What joining did.
pub(super) struct Outcome {
    pub(super) mesh: Mesh,
    /// Length of the border edges that have a partner now, in units of the old mesh.
    pub(super) joined_length: f64,
    pub(super) added_vertices: usize,
    pub(super) dropped_triangles: usize,
    /// How far a vertex moved at most, or a new one lies from its edge.
    pub(super) farthest_move: f64,
}

/// A mesh with cut triangles whose vertices have not moved yet.
pub(super) struct Draft {
    pub(super) mesh: Mesh,
    pub(super) triangles: Vec<[u32; 3]>,
    /// For each triangle the one of the old mesh that it is a part of.
    pub(super) sources: Vec<u32>,
    /// For each vertex its place.
    pub(super) places: Vec<u32>,
    /// For each vertex a welded point of its body: its own or, of new ones, that at an end of the edge.
    corners: Vec<u32>,
}

pub(super) fn join(mesh: &Mesh, weld: &[u32], borders: &Borders, places: &PointGroups) -> Outcome {
    let mut draft = cut(mesh, weld, borders, places);
    let settled = settle(mesh, borders, &draft, places);
    let moves = draft.mesh.positions.iter().zip(&settled.positions).map(|(a, b)| a.distance(*b));
    let moves: Vec<f32> = moves.collect();
    let farthest_move = f64::from(moves.iter().copied().fold(0.0, f32::max));
    let (joined_length, is_open) = joined(borders, places, &settled.points);
    let errors = errors(borders, &draft, &settled, &is_open, &moves);
    let dropped = without_area(&draft, &settled);
    let kept = (0..).zip(&draft.triangles).zip(&draft.sources).filter(|((t, _), _)| !dropped.contains(t));
    let (triangles, sources): (Vec<[u32; 3]>, Vec<u32>) = kept.map(|((_, t), source)| (*t, *source)).unzip();
    draft.mesh.positions = settled.positions;
    draft.mesh.position_errors = errors;
    draft.mesh.submeshes = parts(&mesh.submeshes, &sources);
    draft.mesh.indices = triangles.into_flattened();
    Outcome {
        joined_length,
        added_vertices: places.insertions.len(),
        dropped_triangles: dropped.len(),
        farthest_move,
        mesh: if dropped.is_empty() { draft.mesh } else { draft.mesh.without_unused_vertices() },
    }
}

/// The triangles of which joining left nothing: those two of whose corners became one point, and pairs that lie on each
/// other back to back.
fn without_area(draft: &Draft, settled: &Settled) -> HashSet<usize> {
    let mut dropped = HashSet::new();
    let mut by_corners: HashMap<[u32; 3], Vec<usize>> = HashMap::new();
    let places_of = |triangle: usize| draft.triangles[triangle].map(|v| draft.places[v as usize]);
    let points_of = |places: [u32; 3]| places.map(|place| settled.points[place as usize]);
    for &number in &settled.touched {
        let places = places_of(number);
        let [a, b, c] = points_of(places);
        let same = |i: usize, j: usize| [a, b, c][i] == [a, b, c][j] && places[i] != places[j];
        if same(0, 1) || same(1, 2) || same(2, 0) {
            dropped.insert(number);
            continue;
        }
        let mut corners = [a, b, c];
        corners.sort_unstable();
        let others = by_corners.entry(corners).or_default();
        let is_opposite = |&other: &usize| {
            let other_places = places_of(other);
            let other = points_of(other_places);
            // Two sides of a sheet that were there before stay.
            ![[a, b, c], [b, c, a], [c, a, b]].contains(&other)
                && !other_places.iter().all(|p| places.contains(p))
        };
        match others.iter().position(is_opposite) {
            Some(other) => dropped.extend([number, others.swap_remove(other)]),
            None => others.push(number),
        }
    }
    dropped
}

/// Cuts the border edges at their new vertices, which get their attributes from their own edge.
fn cut(mesh: &Mesh, weld: &[u32], borders: &Borders, places: &PointGroups) -> Draft {
    let mut new = Mesh { indices: Vec::new(), submeshes: Vec::new(), ..mesh.clone() };
    let mut place_of_vertex = weld.to_vec();
    let mut corners_of_vertex = weld.to_vec();
    let mut cut_triangles: HashMap<u32, CutTriangle> = HashMap::new();
    for (number, border) in (0..).zip(&borders.list) {
        let mut cuts: Vec<(u32, &Insertion)> = places
            .insertions_on(number)
            .iter()
            .filter_map(|&place| Some((place, places.cut(place)?)))
            .collect();
        if cuts.is_empty() {
            continue;
        }
        cuts.sort_by(|a, b| a.1.share.total_cmp(&b.1.share));
        let corners = mesh.triangles()[border.face as usize];
        let triangle = cut_triangles
            .entry(border.face)
            .or_insert_with(|| CutTriangle { corners, on_edges: [const { Vec::new() }; 3] });
        let Some(corner) = corners.iter().position(|&v| v == border.vertices[0]) else { continue };
        for (place, cut) in cuts {
            triangle.on_edges[corner].push(place_of_vertex.len() as u32);
            place_of_vertex.push(place);
            corners_of_vertex.push(border.ends[0]);
            append_between(&mut new, border.vertices, cut.share as f32);
        }
    }
    let mut triangles = Vec::with_capacity(mesh.triangle_count() + 2 * places.insertions.len());
    let mut sources = Vec::with_capacity(triangles.capacity());
    for (number, &triangle) in (0..).zip(mesh.triangles()) {
        match cut_triangles.remove(&number) {
            Some(cut) => cut.split(&mut triangles),
            None => triangles.push(triangle),
        }
        sources.resize(triangles.len(), number);
    }
    Draft { mesh: new, triangles, sources, places: place_of_vertex, corners: corners_of_vertex }
}

/// Appends a vertex between two others, at a share of the way.
fn append_between(mesh: &mut Mesh, ends: [u32; 2], share: f32) {
    fn append<T: Copy>(list: &mut Vec<T>, ends: [u32; 2], mix: impl Fn(T, T) -> T) {
        if let [Some(&a), Some(&b)] = ends.map(|v| list.get(v as usize)) {
            list.push(mix(a, b));
        }
    }
    append(&mut mesh.positions, ends, |a, b| a.as_dvec3().lerp(b.as_dvec3(), f64::from(share)).as_vec3());
    append(&mut mesh.position_errors, ends, f32::max);
    append(&mut mesh.normals, ends, |a, b| a.lerp(b, share).normalize_or(a));
    append(&mut mesh.uvs, ends, |a, b| a.lerp(b, share));
    append(&mut mesh.colors, ends, |a, b| {
        let mix = |a: u8, b: u8| (f32::from(a) + (f32::from(b) - f32::from(a)) * share).round() as u8;
        std::array::from_fn(|k| mix(a[k], b[k]))
    });
    append(&mut mesh.tangents, ends, |a: Vec4, b: Vec4| {
        let direction = a.truncate().lerp(b.truncate(), share).normalize_or(a.truncate());
        direction.extend(a.w)
    });
}

/// The same materials for the triangles that came from each part.
fn parts(old: &[Submesh], sources: &[u32]) -> Vec<Submesh> {
    let index = |first_index: u32| 3 * sources.partition_point(|&s| 3 * s < first_index) as u32;
    old.iter()
        .map(|part| {
            let first_index = index(part.first_index);
            let end = index(part.first_index + part.index_count);
            Submesh { first_index, index_count: end - first_index, ..*part }
        })
        .filter(|part| part.index_count > 0)
        .collect()
}

/// [`Mesh::position_errors`]: what is left open or does not meet on a straight line may be off its place by as much as
/// anything of its body was moved.
fn errors(borders: &Borders, draft: &Draft, settled: &Settled, is_open: &[bool], moves: &[f32]) -> Vec<f32> {
    let mut farthest: HashMap<u32, f32> = HashMap::new();
    let body = |v: usize| borders.body_of_point[draft.corners[v] as usize];
    for (v, &length) in moves.iter().enumerate().filter(|(_, length)| **length > 0.0) {
        let farthest = farthest.entry(body(v)).or_default();
        *farthest = farthest.max(length);
    }
    let old = &draft.mesh.position_errors;
    (0..moves.len())
        .map(|v| {
            let point = settled.points[draft.places[v] as usize];
            let is_doubtful = settled.is_doubtful[v] || is_open[point as usize];
            let error = farthest.get(&body(v)).copied().filter(|_| is_doubtful).unwrap_or(0.0);
            error.max(old.get(v).copied().unwrap_or(0.0))
        })
        .collect()
}

/// Length of the parts of border edges both of whose ends became those of another one, and for each place whether it is an
/// end of one of the others.
fn joined(borders: &Borders, places: &PointGroups, points: &[u32]) -> (f64, Vec<bool>) {
    let point = |place: u32| points[place as usize];
    let mut pieces: Vec<([u32; 2], f64)> = Vec::with_capacity(borders.list.len());
    for (number, border) in (0..).zip(&borders.list) {
        let cuts = places.insertions_on(number).iter();
        let mut cuts: Vec<(f64, u32)> =
            cuts.filter_map(|&place| Some((places.cut(place)?.share, point(place)))).collect();
        cuts.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut from = (0.0, point(border.ends[0]));
        for to in cuts.into_iter().chain([(1.0, point(border.ends[1]))]) {
            let ends = [from.1.min(to.1), from.1.max(to.1)];
            pieces.push((ends, (to.0 - from.0) * border.length));
            from = to;
        }
    }
    pieces.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut joined = 0.0;
    let mut is_open = vec![false; points.len()];
    for same in pieces.chunk_by(|a, b| a.0 == b.0) {
        match same {
            [(ends, _)] => ends.iter().for_each(|&end| is_open[end as usize] = true),
            _ => joined += same.iter().map(|piece| piece.1).sum::<f64>(),
        }
    }
    (joined, is_open)
}
