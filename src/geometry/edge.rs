//! An edge of a mesh: where triangles meet.

use std::f32::consts::PI;

use glam::Vec3;

use super::angle;

/// Above this angle (radians) two triangles lie on each other: a wall that was modeled twice, with one surface.
pub(super) const FOLDED: f32 = PI - 1e-3;

/// Stands for "no triangle".
pub const NO_FACE: u32 = u32::MAX;

/// What kind of place an edge is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EdgeKind {
    /// One triangle.
    Border,
    /// One triangle, but other edges on the same line continue the surface along all of it (T-junctions).
    Stitched,
    /// Two triangles that agree about inside and outside.
    Manifold,
    /// Two triangles, one of which is turned inside out against the other.
    Flipped,
    /// Three triangles or more; all of them are in [`super::Adjacency::non_manifold`].
    NonManifold,
}

/// One edge, whose ends are welded by position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// Indices of two vertices of the mesh (not of welded points) in the direction in which `faces[0]` runs.
    pub vertices: [u32; 2],
    /// The triangles that meet here, the smallest index first. [`NO_FACE`] where there is no second one. Of a
    /// non-manifold edge, the first two.
    pub faces: [u32; 2],
    /// Angle between the normals of `faces`, in radians, −π to π: 0 flat, positive convex (ridge), negative concave
    /// (valley). A flipped triangle counts as if it were turned. 0 at a border.
    pub dihedral: f32,
    /// Whether the mesh's own vertex normals say that the surface goes on smoothly here, whatever the angle. Never at
    /// borders and non-manifold edges.
    pub is_soft: bool,
    /// How many triangles meet, and whether they agree.
    pub kind: EdgeKind,
}

impl Edge {
    /// The edge of a single triangle.
    pub(super) fn border(vertices: [u32; 2], face: u32) -> Self {
        Self { vertices, faces: [face, NO_FACE], dihedral: 0.0, is_soft: false, kind: EdgeKind::Border }
    }

    /// Whether the angle is above `crease_angle` (radians) and the normals do not say otherwise.
    pub fn is_crease(&self, crease_angle: f32) -> bool {
        !self.is_soft && self.dihedral.abs() > crease_angle
    }
}

/// Angle from one unit normal to the other, positive if the edge is convex when the triangle of `n0` runs along `edge`.
pub(super) fn signed_angle(n0: Vec3, n1: Vec3, edge: Vec3) -> f32 {
    let turn = n0.cross(n1);
    let angle = angle::from_sine_and_cosine(turn.length(), n0.dot(n1));
    if turn.dot(edge) < 0.0 { -angle } else { angle }
}
