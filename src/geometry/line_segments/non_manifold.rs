//! Edges at which three triangles or more meet, or at which another mesh goes on. Winding decides nothing there.

use glam::{DMat4, DVec3};

use super::PlacedEdges;
use crate::geometry::feature_edges::Materials;
use crate::geometry::{BorderLink, EdgeClass, FeatureEdges, Lens, Mesh};

/// Two surfaces that leave an edge in directions closer than this (radians) lie on each other.
const SAME_DIRECTION: f64 = 1e-3;
/// Sine of the angle to the view up to which a surface counts as seen edge-on.
const EDGE_ON: f64 = 1e-9;

/// What is seen of such an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct NonManifoldView {
    /// The class, if all surfaces are on one side.
    pub outline: Option<EdgeClass>,
    /// Angle between the two surfaces that are seen, positive convex; 0 at a border.
    pub angle: f32,
    /// The triangles that are seen on either side, or twice the same one.
    pub faces: [u32; 2],
    pub materials_differ: bool,
}

/// Such edges of one object before an eye.
pub(super) struct NonManifoldEdges<'a> {
    edges: &'a FeatureEdges,
    mesh: &'a Mesh,
    /// Which meshes are shown.
    shown: &'a [bool],
    view_from_local: DMat4,
    lens: Lens,
}

impl<'a> NonManifoldEdges<'a> {
    pub(super) fn new(placed: &PlacedEdges<'a>, view_from_local: DMat4, lens: Lens) -> Self {
        let PlacedEdges { edges, mesh, shown, .. } = *placed;
        Self { edges, mesh, shown, view_from_local, lens }
    }

    /// What is seen of an edge; `None`: nothing, or it has no extent.
    pub(super) fn look(&self, edge: u32) -> Option<NonManifoldView> {
        let ends = self.edges.ends.get(edge as usize)?;
        let [a, b] = ends.map(|v| self.view_position(v));
        let (a, b) = (a?, b?);
        let along = (b - a).try_normalize()?;
        let to_eye = match self.lens {
            Lens::Perspective { .. } => -a,
            Lens::Orthographic { .. } => DVec3::Z,
        };
        // The picture of the cross section: x is aside, y is towards the eye.
        let towards = (to_eye - along * to_eye.dot(along)).normalize_or_zero();
        let aside = along.cross(towards);
        // On each side, the surface that is nearest to the eye: its angle from the direction to the eye.
        let (mut left, mut right): (Option<(f64, u32)>, Option<(f64, u32)>) = (None, None);
        let mut first: Option<(DVec3, u32)> = None;
        let mut is_fold = false;
        for &(_, face) in self.edges.faces_around(edge) {
            let Some(away) = self.away(face, a, along) else { continue };
            let (other, _) = *first.get_or_insert((away, face));
            is_fold |= other.distance(away) > SAME_DIRECTION;
            let (x, y) = (away.dot(aside), away.dot(towards));
            let side = match x {
                x if x < -EDGE_ON => &mut left,
                x if x > EDGE_ON => &mut right,
                _ => continue,
            };
            let angle = x.abs().atan2(y);
            if side.is_none_or(|(nearest, _)| angle < nearest) {
                *side = Some((angle, face));
            }
        }
        let outline = if is_fold { EdgeClass::Silhouette } else { EdgeClass::Border };
        match (left, right) {
            (Some((left, one)), Some((right, two))) => Some(NonManifoldView {
                outline: None,
                angle: (left + right - std::f64::consts::PI) as f32,
                faces: [one, two],
                materials_differ: match self.border_link(one).or(self.border_link(two)) {
                    Some(beyond) => beyond.materials_differ,
                    None => Materials::new(self.mesh).differ([one, two]),
                },
            }),
            // The other mesh draws it.
            (Some((_, face)), None) | (None, Some((_, face))) if self.border_link(face).is_some() => None,
            (Some((_, face)), None) | (None, Some((_, face))) => Some(NonManifoldView {
                outline: Some(outline),
                angle: 0.0,
                faces: [face; 2],
                materials_differ: false,
            }),
            (None, None) if is_fold => None,
            (None, None) => {
                let (_, face) = first?;
                Some(NonManifoldView {
                    outline: Some(outline),
                    angle: 0.0,
                    faces: [face; 2],
                    materials_differ: false,
                })
            }
        }
    }

    /// From an edge into a triangle: a unit vector in view space, perpendicular to the edge.
    fn away(&self, face: u32, start: DVec3, along: DVec3) -> Option<DVec3> {
        let aside = |p: DVec3| (p - start) - along * (p - start).dot(along);
        if let Some(beyond) = self.border_link(face) {
            let is_shown = self.shown.get(beyond.mesh).copied().unwrap_or(false);
            let apex = self.view_from_local.transform_point3(beyond.apex.as_dvec3());
            return aside(apex).try_normalize().filter(|_| is_shown);
        }
        let corners = self.mesh.triangles().get(face as usize)?.map(|v| self.view_position(v));
        // The corner that is not on the edge.
        let corners = corners.into_iter().flatten().map(aside);
        corners.max_by(|p, q| p.length_squared().total_cmp(&q.length_squared()))?.try_normalize()
    }

    /// How the mesh goes on, if that is the number of no triangle of its own.
    fn border_link(&self, face: u32) -> Option<&BorderLink> {
        self.mesh.border_links.get((face as usize).checked_sub(self.mesh.triangle_count())?)
    }

    fn view_position(&self, vertex: u32) -> Option<DVec3> {
        let position = self.mesh.positions.get(vertex as usize)?;
        Some(self.view_from_local.transform_point3(position.as_dvec3()))
    }
}
