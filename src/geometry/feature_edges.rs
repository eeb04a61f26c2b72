//! The edges of a mesh in the form in which they are classified for every camera: small, and without T-junctions.
//!
//! Built once per mesh; [`super::line_segments()`] picks those that a picture shows.

pub(super) mod chains;
pub(super) mod crease_angles;
pub(super) mod hysteresis;
pub(super) mod isolated;
mod pieces;
pub(super) mod straights;
mod sub_edges;

use std::sync::Arc;

use self::chains::FeatureChains;
use self::crease_angles::Cached;
use self::isolated::IsolatedCreases;
use self::straights::Straights;
use self::sub_edges::SubEdge;
use super::edge::{FOLDED, NO_FACE};
use super::weld::TOLERANCE;
use super::{Adjacency, Bounds, EdgeKind, Mesh, Surfaces};

/// What distinguishes an edge: a set of bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Traits(u8);

impl Traits {
    /// One of the two triangles is turned inside out against the other. The lowest bit.
    pub(super) const FLIPPED: Self = Self(1);
    /// The surface ends.
    pub(super) const BORDER: Self = Self(2);
    /// The two triangles have different materials.
    pub(super) const MATERIAL: Self = Self(4);
    /// Three triangles or more, or another mesh goes on; all of them are in [`FeatureEdges::faces_around`].
    pub(super) const NON_MANIFOLD: Self = Self(8);
    /// [`super::Edge::is_soft`], [`super::BorderLink::is_soft`]: no crease, whatever the angle.
    pub(super) const SOFT: Self = Self(16);

    /// All traits of both.
    pub(super) const fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Whether it has at least one of these.
    pub(super) const fn any(self, of: Self) -> bool {
        self.0 & of.0 != 0
    }

    /// 1 for a flipped pair, else 0.
    pub(super) const fn flip(self) -> u8 {
        self.0 & Self::FLIPPED.0
    }

    pub(super) const fn when(self, is: bool) -> Self {
        if is { self } else { Self(0) }
    }
}

/// All edges of a mesh at which a line can be, one entry each: about 21 bytes, and 4 per triangle.
///
/// Where edges meet others only partly (T-junctions), each part with the same triangles on both sides is an edge of
/// its own.
#[derive(Debug, Clone, PartialEq)]
pub struct FeatureEdges {
    /// The two ends, as indices of welded vertices ([`super::Weld::representative`]): edges that meet share them. In the
    /// direction in which the first triangle runs.
    pub(super) ends: Vec<[u32; 2]>,
    /// The two triangles. At a border twice the same one; where more meet the first two.
    pub(super) faces: Vec<[u32; 2]>,
    /// As [`super::Edge::dihedral`], or greater where a crease goes on (`hysteresis.rs`); 0 at a border.
    pub(super) dihedral: Vec<f32>,
    pub(super) traits: Vec<Traits>,
    /// Every (edge, triangle) of the edges at which three triangles or more meet, or another mesh goes on, in order. Numbers from that of the mesh's
    /// triangles on are those of [`Mesh::border_links`].
    pub(super) faces_around: Vec<(u32, u32)>,
    /// The surfaces of the mesh.
    pub(super) surfaces: Arc<Surfaces>,
    /// The box around the mesh, local space.
    pub(super) bounds: Bounds,
    /// As [`Adjacency::slivers`].
    pub(super) slivers: Vec<[u32; 2]>,
    /// As [`Adjacency::leaves_out_isolated`].
    leaves_out_isolated: bool,
    cached_chains: Cached<FeatureChains>,
    cached_straights: Cached<Straights>,
    cached_isolated: Cached<IsolatedCreases>,
}

impl FeatureEdges {
    /// The surfaces of the mesh.
    pub fn surfaces(&self) -> &Surfaces {
        &self.surfaces
    }

    /// Gathers the edges of a mesh. Adjacency and surfaces must be those of the same mesh.
    pub fn new(mesh: &Mesh, adjacency: &Adjacency, surfaces: impl Into<Arc<Surfaces>>) -> Self {
        let count = adjacency.edges.len();
        let mut all = Self {
            ends: Vec::with_capacity(count),
            faces: Vec::with_capacity(count),
            dihedral: Vec::with_capacity(count),
            traits: Vec::with_capacity(count),
            faces_around: Vec::new(),
            surfaces: surfaces.into(),
            bounds: mesh.bounds(),
            slivers: adjacency.slivers.clone(),
            leaves_out_isolated: adjacency.leaves_out_isolated,
            cached_chains: Cached::default(),
            cached_straights: Cached::default(),
            cached_isolated: Cached::default(),
        };
        let point = |v: u32| adjacency.weld.representative.get(v as usize).copied().unwrap_or(v);
        let materials = Materials::new(mesh);
        let overlaps = sub_edges::overlaps_by_edge(adjacency);
        let mut overlaps = overlaps.as_slice();
        let mut non_manifold = adjacency.non_manifold.as_slice();
        let shortest = 4.0 * TOLERANCE * all.bounds.diagonal();
        let mut own_sub_edges = Vec::new();
        for (number, edge) in (0..).zip(&adjacency.edges) {
            let own_overlaps = split_front(&mut overlaps, |&(e, _)| e <= number);
            let own_faces = split_front(&mut non_manifold, |&(e, _)| e <= number);
            let ends = edge.vertices.map(point);
            match edge.kind {
                EdgeKind::Border | EdgeKind::Stitched if !own_overlaps.is_empty() => {
                    sub_edges::split(mesh, adjacency, number, own_overlaps, shortest, &mut own_sub_edges);
                    for sub_edge in own_sub_edges.drain(..) {
                        all.add_sub_edge(&sub_edge, point, &materials);
                    }
                }
                EdgeKind::Border | EdgeKind::Stitched => match adjacency.border_link(number) {
                    Some(beyond) => {
                        let faces = [edge.faces[0], mesh.triangle_count() as u32 + beyond];
                        all.add_non_manifold(ends, [faces[0]; 2], 0.0, faces.into_iter());
                        let is_soft =
                            mesh.border_links.get(beyond as usize).is_some_and(|beyond| beyond.is_soft);
                        if let Some(traits) = all.traits.last_mut() {
                            *traits = traits.union(Traits::SOFT.when(is_soft));
                        }
                    }
                    None => all.add(ends, [edge.faces[0]; 2], 0.0, Traits::BORDER),
                },
                EdgeKind::Manifold | EdgeKind::Flipped => {
                    let flipped = Traits::FLIPPED.when(edge.kind == EdgeKind::Flipped);
                    let traits = flipped.union(Traits::SOFT.when(edge.is_soft));
                    all.add_pair(ends, edge.faces, edge.dihedral, traits, &materials);
                }
                EdgeKind::NonManifold => {
                    let faces = own_faces.iter().map(|&(_, face)| face);
                    all.add_non_manifold(ends, edge.faces, edge.dihedral, faces);
                }
            }
        }
        hysteresis::bridge_gaps(&mut all, mesh);
        all
    }

    /// Number of edges.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// Memory that it takes, in bytes.
    pub fn size_in_bytes(&self) -> usize {
        size_of_val(self.ends.as_slice())
            + size_of_val(self.faces.as_slice())
            + size_of_val(self.dihedral.as_slice())
            + size_of_val(self.traits.as_slice())
            + size_of_val(self.faces_around.as_slice())
            + size_of_val(self.surfaces.of_triangle.as_slice())
    }

    /// All triangles around a non-manifold edge, each with the number of the edge.
    pub(super) fn faces_around(&self, edge: u32) -> &[(u32, u32)] {
        let start = self.faces_around.partition_point(|&(e, _)| e < edge);
        let rest = self.faces_around.get(start..).unwrap_or_default();
        rest.get(..rest.partition_point(|&(e, _)| e == edge)).unwrap_or_default()
    }

    fn add(&mut self, ends: [u32; 2], faces: [u32; 2], dihedral: f32, traits: Traits) {
        self.ends.push(ends);
        self.faces.push(faces);
        self.dihedral.push(dihedral);
        self.traits.push(traits);
    }

    fn add_pair(
        &mut self,
        ends: [u32; 2],
        faces: [u32; 2],
        dihedral: f32,
        traits: Traits,
        materials: &Materials<'_>,
    ) {
        if dihedral.abs() > FOLDED {
            self.add(ends, [faces[0]; 2], 0.0, Traits::BORDER);
        } else {
            let differ = Traits::MATERIAL.when(materials.differ(faces));
            self.add(ends, faces, dihedral, traits.union(differ));
        }
    }

    fn add_non_manifold(
        &mut self,
        ends: [u32; 2],
        faces: [u32; 2],
        dihedral: f32,
        all_faces: impl Iterator<Item = u32>,
    ) {
        let number = self.ends.len() as u32;
        self.faces_around.extend(all_faces.map(|face| (number, face)));
        self.add(ends, faces, dihedral, Traits::NON_MANIFOLD);
    }

    fn add_sub_edge(&mut self, sub_edge: &SubEdge, point: impl Fn(u32) -> u32, materials: &Materials<'_>) {
        let ends = sub_edge.ends.map(point);
        match sub_edge.faces[..] {
            [] => {}
            [face] => self.add(ends, [face; 2], 0.0, Traits::BORDER),
            // Seams join only edges that run against each other: no pair is flipped.
            [a, b] => {
                let soft = Traits::SOFT.when(sub_edge.is_soft);
                self.add_pair(ends, [a, b], sub_edge.dihedral, soft, materials);
            }
            [a, b, ..] => {
                self.add_non_manifold(ends, [a, b], sub_edge.dihedral, sub_edge.faces.iter().copied());
            }
        }
    }
}

/// Which material each triangle has.
pub(super) struct Materials<'a> {
    mesh: &'a Mesh,
}

impl<'a> Materials<'a> {
    pub(super) fn new(mesh: &'a Mesh) -> Self {
        Self { mesh }
    }

    pub(super) fn differ(&self, [a, b]: [u32; 2]) -> bool {
        self.mesh.submeshes.len() > 1 && a != NO_FACE && b != NO_FACE && self.of(a) != self.of(b)
    }

    fn of(&self, face: u32) -> usize {
        let parts = &self.mesh.submeshes;
        let part = parts.partition_point(|part| part.first_index <= 3 * face).saturating_sub(1);
        parts.get(part).map_or(0, |part| part.material)
    }
}

/// Cuts off the front of a slice as long as `is_front`.
fn split_front<'a, T>(slice: &mut &'a [T], is_front: impl Fn(&T) -> bool) -> &'a [T] {
    let (front, rest) = slice.split_at(slice.iter().take_while(|item| is_front(item)).count());
    *slice = rest;
    front
}

#[cfg(test)]
pub(super) mod tests;
