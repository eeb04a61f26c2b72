//! The edges of placed meshes in world space, and what kind of line each makes for an eye.

use glam::DVec3;

use super::{LineRules, PlacedMesh};
use crate::geometry::weld::TOLERANCE;
use crate::geometry::{EdgeClass, EdgeKind};

/// Two surfaces that leave an edge in directions closer than this (radians) lie on each other.
const SAME_DIRECTION: f64 = 1e-3;
/// Sine of the angle to the view up to which a surface counts as seen edge-on.
const EDGE_ON: f64 = 1e-9;

/// An edge in world space, or a sub-edge of one.
#[derive(Debug, Clone)]
pub(super) struct WorldEdge {
    pub ends: [DVec3; 2],
    /// Numbers of all triangles at the edge.
    pub faces: Vec<u32>,
    /// The surfaces that leave it, each once; none for an intersection.
    pub wings: Vec<Wing>,
    /// Whether normals say that it is no crease.
    pub is_soft: bool,
    pub object: u32,
    /// Index into the mesh's edges; `None` for an intersection.
    pub edge: Option<u32>,
    /// The edge that it is a part of; `None` for an intersection.
    pub whole: Option<WholeEdge>,
}

/// An edge of a mesh.
#[derive(Debug, Clone, Copy)]
pub(super) struct WholeEdge {
    /// The welded vertices at its ends, counted through all meshes.
    pub points: [u32; 2],
    /// The dihedral angle, degrees; `None` for what is more than a fold.
    pub angle: Option<f32>,
    /// As a share of its mesh's diagonal.
    pub length: f64,
    /// [`crate::geometry::Adjacency::leaves_out_isolated`].
    pub can_be_isolated: bool,
}

/// What makes a fold a crease.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Fold {
    /// Its angle alone.
    ByAngle,
    /// It is isolated: nothing does.
    Isolated,
    /// It goes on in creases on both sides.
    Bridge,
}

/// A surface at an edge.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wing {
    /// From the edge into the surface: a unit vector, perpendicular to the edge.
    away: DVec3,
    material: usize,
}

/// What an edge is for an eye.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Line {
    /// Its class where no other object lies beside it; `None`: there it is no line.
    pub class: Option<EdgeClass>,
    /// Where all surfaces are on one side of it: a vector in world space that leads to the other.
    pub off_surface: Option<DVec3>,
}

impl WorldEdge {
    /// Whether several surfaces meet.
    pub(super) fn is_fold(&self) -> bool {
        self.wings.len() > 1
    }

    /// What it is for an eye in the direction `to_eye` of its first end; `None` if it can be no line.
    pub(super) fn line(&self, to_eye: DVec3, fold: Fold, rules: &LineRules<'_>) -> Option<Line> {
        let wanted = |class: &EdgeClass| rules.classes.contains(class);
        let first = |candidates: &[EdgeClass]| candidates.iter().copied().find(wanted);
        let whole = |class: Option<EdgeClass>| class.map(|_| Line { class, off_surface: None });
        if self.wings.is_empty() {
            return whole(first(&[EdgeClass::Intersection]));
        }
        let along = (self.ends[1] - self.ends[0]).normalize_or_zero();
        // The picture of the edge's cross section: x is aside, y is towards the eye.
        let towards = (to_eye - along * to_eye.dot(along)).normalize_or_zero();
        let aside = along.cross(towards);
        // On each side, the surface that is nearest to the eye: its angle from the direction to the eye.
        let (mut left, mut right): (Option<(f64, usize)>, Option<(f64, usize)>) = (None, None);
        for wing in &self.wings {
            let (x, y) = (wing.away.dot(aside), wing.away.dot(towards));
            let side = match x {
                x if x < -EDGE_ON => &mut left,
                x if x > EDGE_ON => &mut right,
                _ => continue,
            };
            let angle = x.abs().atan2(y);
            if side.is_none_or(|(nearest, _)| angle < nearest) {
                *side = Some((angle, wing.material));
            }
        }
        let outline = if self.is_fold() { EdgeClass::Silhouette } else { EdgeClass::Border };
        let is_outline = wanted(&outline) || wanted(&EdgeClass::Object);
        let off_surface = match (left, right) {
            (Some((left, left_material)), Some((right, right_material))) => {
                let bend = left + right - std::f64::consts::PI;
                let crease = match fold {
                    Fold::ByAngle => rules.ridge_valley_angle.to_radians(),
                    Fold::Isolated => f64::INFINITY,
                    Fold::Bridge => 0.0,
                };
                let is_hard = !self.is_soft;
                let candidates = [
                    (is_hard && bend > crease, EdgeClass::Ridge),
                    (is_hard && bend < -crease, EdgeClass::Valley),
                    (left_material != right_material, EdgeClass::Material),
                ];
                let class = candidates.into_iter().find(|(is, class)| *is && wanted(class));
                return whole(class.map(|(_, class)| class));
            }
            (Some(_), None) => Some(aside),
            (None, Some(_)) => Some(-aside),
            // Everything is seen edge-on.
            (None, None) if !self.is_fold() => None,
            (None, None) => return None,
        };
        is_outline.then(|| Line { class: first(&[outline]), off_surface })
    }
}

/// The edges of a mesh whose first triangle is number `first` of all `triangles`, which are in world space, and whose first vertex
/// is number `first_point` of all.
pub(super) fn edges_of(
    placed: &PlacedMesh<'_>,
    triangles: &[[DVec3; 3]],
    first: usize,
    first_point: u32,
) -> Vec<WorldEdge> {
    let diagonal = placed.mesh.bounds().diagonal();
    let gatherer = Gatherer { placed, triangles, first, first_point, diagonal };
    let adjacency = placed.adjacency;
    let mut overlaps: Vec<(u32, u32)> = (0..)
        .zip(&adjacency.overlaps)
        .flat_map(|(number, overlap)| overlap.edges.map(|edge| (edge, number)))
        .collect();
    overlaps.sort_unstable();
    let mut overlaps = overlaps.as_slice();
    let mut non_manifold = adjacency.non_manifold.as_slice();
    let mut edges = Vec::with_capacity(adjacency.edges.len());
    for (number, edge) in (0..).zip(&adjacency.edges) {
        let own_overlaps = split_front(&mut overlaps, |&(e, _)| e <= number);
        let own_faces = split_front(&mut non_manifold, |&(e, _)| e <= number);
        if !own_overlaps.is_empty() {
            gatherer.sub_edges(number, own_overlaps, &mut edges);
            continue;
        }
        let faces: Vec<(u32, u32)> = match edge.kind {
            EdgeKind::Border | EdgeKind::Stitched => vec![(number, edge.faces[0])],
            EdgeKind::Manifold | EdgeKind::Flipped => edge.faces.map(|face| (number, face)).to_vec(),
            EdgeKind::NonManifold => own_faces.to_vec(),
        };
        edges.extend(gatherer.edge(number, [0.0, 1.0], &faces, edge.is_soft));
    }
    edges
}

/// Cuts off the front of a slice as long as `is_front`.
fn split_front<'a, T>(slice: &mut &'a [T], is_front: impl Fn(&T) -> bool) -> &'a [T] {
    let (front, rest) = slice.split_at(slice.iter().take_while(|item| is_front(item)).count());
    *slice = rest;
    front
}

/// An edge that lies on another one.
struct OverlappingEdge {
    edge: u32,
    face: u32,
    is_soft: bool,
    /// From where to where it lies on the other, 0 to 1.
    span: [f64; 2],
}

struct Gatherer<'a> {
    placed: &'a PlacedMesh<'a>,
    triangles: &'a [[DVec3; 3]],
    first: usize,
    first_point: u32,
    /// Of the mesh, in its own space.
    diagonal: f64,
}

impl Gatherer<'_> {
    /// The ends of an edge in the mesh's own space.
    fn ends(&self, edge: u32) -> Option<[DVec3; 2]> {
        let edge = self.placed.adjacency.edges.get(edge as usize)?;
        Some(edge.vertices.map(|v| self.placed.mesh.positions[v as usize].as_dvec3()))
    }

    /// A border edge that others lie on (T-junctions), cut where one of them begins or ends. Each sub-edge is added
    /// by the first edge that it belongs to.
    fn sub_edges(&self, number: u32, overlaps: &[(u32, u32)], edges: &mut Vec<WorldEdge>) {
        let Some([a, b]) = self.ends(number) else { return };
        let adjacency = self.placed.adjacency;
        let on_edge = |p: DVec3| ((p - a).dot(b - a) / a.distance_squared(b)).clamp(0.0, 1.0);
        // Others, and from where to where they lie on this one.
        let others: Vec<OverlappingEdge> = overlaps
            .iter()
            .filter_map(|&(_, overlap)| {
                let overlap = adjacency.overlaps.get(overlap as usize)?;
                let other = usize::from(overlap.edges[0] == number);
                let [from, to] = self.ends(overlap.edges[other])?.map(on_edge);
                Some(OverlappingEdge {
                    edge: overlap.edges[other],
                    face: overlap.faces[other],
                    is_soft: overlap.is_soft,
                    span: [from.min(to), from.max(to)],
                })
            })
            .collect();
        let mut cuts: Vec<f64> = others.iter().flat_map(|other| other.span).chain([0.0, 1.0]).collect();
        cuts.sort_by(f64::total_cmp);
        let shortest = 4.0 * TOLERANCE * self.diagonal / a.distance(b);
        let own_face = adjacency.edges.get(number as usize).map(|edge| (number, edge.faces[0]));
        let mut from = 0.0;
        for to in cuts {
            if to - from <= shortest {
                continue;
            }
            let middle = 0.5 * (from + to);
            let here: Vec<&OverlappingEdge> =
                others.iter().filter(|other| (other.span[0]..other.span[1]).contains(&middle)).collect();
            let faces: Vec<(u32, u32)> =
                own_face.into_iter().chain(here.iter().map(|other| (other.edge, other.face))).collect();
            if faces.iter().all(|&(edge, _)| edge >= number) {
                let is_soft = matches!(here[..], [only] if only.is_soft);
                edges.extend(self.edge(number, [from, to], &faces, is_soft));
            }
            from = to;
        }
    }

    /// A part of an edge (0 to 1 from its first end to its second) at which these (edge, triangle) meet.
    fn edge(
        &self,
        number: u32,
        [from, to]: [f64; 2],
        faces: &[(u32, u32)],
        is_soft: bool,
    ) -> Option<WorldEdge> {
        let place = |p: DVec3| self.placed.world_from_local.transform_point3(p);
        let [a, b] = self.ends(number)?.map(place);
        let along = (b - a).try_normalize()?;
        let mut wings: Vec<Wing> = Vec::new();
        let own =
            faces.iter().filter_map(|&(edge, face)| Some((self.opposite(edge, face)?, self.material(face))));
        let beyond = self.placed.adjacency.border_link(number);
        let beyond = beyond.and_then(|beyond| self.placed.mesh.border_links.get(beyond as usize));
        let is_soft = is_soft || beyond.is_some_and(|beyond| beyond.is_soft);
        let apex = beyond.map(|beyond| {
            let own = faces.first().map_or(0, |&(_, face)| self.material(face));
            (place(beyond.apex.as_dvec3()), if beyond.materials_differ { usize::MAX } else { own })
        });
        for (corner, material) in own.chain(apex) {
            let Some(away) = ((corner - a) - along * (corner - a).dot(along)).try_normalize() else {
                continue;
            };
            if wings.iter().all(|wing| wing.away.distance(away) > SAME_DIRECTION) {
                wings.push(Wing { away, material });
            }
        }
        (!wings.is_empty()).then(|| WorldEdge {
            ends: [a.lerp(b, from), a.lerp(b, to)],
            faces: faces.iter().map(|&(_, face)| face + self.first as u32).collect(),
            is_soft,
            object: self.placed.object,
            edge: Some(number),
            whole: self.whole(number, &wings),
            wings,
        })
    }

    /// What is known of an edge as a whole.
    fn whole(&self, number: u32, wings: &[Wing]) -> Option<WholeEdge> {
        let adjacency = self.placed.adjacency;
        let edge = adjacency.edges.get(number as usize)?;
        let has_two_sides = matches!(edge.kind, EdgeKind::Manifold | EdgeKind::Flipped);
        let is_boundary = wings.iter().any(|wing| wing.material != wings[0].material);
        let [a, b] = self.ends(number)?;
        Some(WholeEdge {
            points: edge.vertices.map(|v| self.first_point + adjacency.weld.representative[v as usize]),
            angle: (has_two_sides && !is_boundary).then(|| edge.dihedral.to_degrees()),
            length: a.distance(b) / self.diagonal,
            can_be_isolated: adjacency.leaves_out_isolated,
        })
    }

    /// The corner of a triangle that is not on its edge, in world space.
    fn opposite(&self, edge: u32, face: u32) -> Option<DVec3> {
        let PlacedMesh { mesh, adjacency, .. } = self.placed;
        let point = |v: u32| adjacency.weld.representative.get(v as usize).copied();
        let on_edge = adjacency.edges.get(edge as usize)?.vertices.map(point);
        let corners = mesh.triangles().get(face as usize)?;
        let corner = corners.iter().position(|&v| !on_edge.contains(&point(v)))?;
        Some(self.triangles.get(self.first + face as usize)?[corner])
    }

    fn material(&self, face: u32) -> usize {
        let parts = &self.placed.mesh.submeshes;
        let part = parts.partition_point(|part| part.first_index <= 3 * face).saturating_sub(1);
        parts.get(part).map_or(0, |part| part.material)
    }
}
