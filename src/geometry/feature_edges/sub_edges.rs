//! Border edges on which others lie (T-junctions), cut where one of them begins or ends.

use glam::DVec3;

use crate::geometry::{Adjacency, Mesh};

/// A part of an edge with the same triangles on both sides all along.
pub(super) struct SubEdge {
    /// Vertices at its ends.
    pub ends: [u32; 2],
    /// All triangles that meet here.
    pub faces: Vec<u32>,
    /// Of two triangles, the angle between them.
    pub dihedral: f32,
    /// Of two triangles, [`crate::geometry::Edge::is_soft`].
    pub is_soft: bool,
}

/// Another edge on one that is being cut.
struct OverlappingEdge {
    edge: u32,
    face: u32,
    dihedral: f32,
    is_soft: bool,
    /// From where to where it lies on the edge, 0 to 1.
    span: [f64; 2],
}

/// (edge, number of an overlap that it takes part in), sorted.
pub(super) fn overlaps_by_edge(adjacency: &Adjacency) -> Vec<(u32, u32)> {
    let mut overlaps: Vec<(u32, u32)> = (0..)
        .zip(&adjacency.overlaps)
        .flat_map(|(number, overlap)| overlap.edges.map(|edge| (edge, number)))
        .collect();
    overlaps.sort_unstable();
    overlaps
}

/// The sub-edges of edge `number`, whose overlaps are given, without those shorter than `shortest` (units of the mesh). A
/// sub-edge is listed for the first edge that it belongs to.
pub(super) fn split(
    mesh: &Mesh,
    adjacency: &Adjacency,
    number: u32,
    overlaps: &[(u32, u32)],
    shortest: f64,
    out: &mut Vec<SubEdge>,
) {
    let position = |v: u32| mesh.positions.get(v as usize).map_or(DVec3::ZERO, |p| p.as_dvec3());
    let Some(own) = adjacency.edges.get(number as usize) else { return };
    let [a, b] = own.vertices.map(position);
    let along = |v: u32| ((position(v) - a).dot(b - a) / a.distance_squared(b)).clamp(0.0, 1.0);
    // Where sub-edges may begin and end, and the vertex that is there.
    let mut splits: Vec<(f64, u32)> = vec![(1.0, own.vertices[1])];
    let mut others = Vec::with_capacity(overlaps.len());
    for overlap in overlaps.iter().filter_map(|&(_, overlap)| adjacency.overlaps.get(overlap as usize)) {
        let which = usize::from(overlap.edges[0] == number);
        let edge = overlap.edges[which];
        let Some(vertices) = adjacency.edges.get(edge as usize).map(|e| e.vertices) else { continue };
        let [from, to] = vertices.map(along);
        others.push(OverlappingEdge {
            edge,
            face: overlap.faces[which],
            dihedral: overlap.dihedral,
            is_soft: overlap.is_soft,
            span: [from.min(to), from.max(to)],
        });
        splits.extend(vertices.map(|v| (along(v), v)).into_iter().filter(|&(t, _)| t > 0.0 && t < 1.0));
    }
    splits.sort_by(|a, b| a.0.total_cmp(&b.0));
    let shortest = shortest / a.distance(b);
    let (mut from, mut start) = (0.0, own.vertices[0]);
    for (to, end) in splits {
        if to - from <= shortest {
            continue;
        }
        let middle = 0.5 * (from + to);
        let here: Vec<&OverlappingEdge> =
            others.iter().filter(|o| o.span[0] <= middle && middle < o.span[1]).collect();
        if here.iter().all(|other| other.edge >= number) {
            out.push(SubEdge {
                ends: [start, end],
                faces: std::iter::once(own.faces[0]).chain(here.iter().map(|other| other.face)).collect(),
                dihedral: here.first().map_or(0.0, |other| other.dihedral),
                is_soft: here.first().is_some_and(|other| other.is_soft),
            });
        }
        (from, start) = (to, end);
    }
}
