//! What is asked for, and what is found: lines of a view as segments in the picture.

use glam::{DMat4, DVec2, DVec4};

use crate::geometry::{ClassSet, EdgeClass, FeatureEdges, Mesh, Projector};

/// Stands for "no second surface".
pub const NO_SURFACE: u32 = u32::MAX;

/// A straight line in the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineSegment {
    /// Both ends, in pixels: (0, 0) is the upper left corner of the picture, y runs down.
    pub ends: [[f32; 2]; 2],
    /// Distance of both ends from the eye along the view, in world units. Its inverse (in parallel projection itself)
    /// is linear along the segment.
    pub depths: [f32; 2],
    /// Length of the line up to both ends, in pixels and never negative; 0 without dashes. Differences and what is left
    /// after whole periods have a meaning; along a line it goes on from segment to segment.
    pub arcs: [f32; 2],
    /// Angle between the two surfaces as they are placed, in radians, −π to π: positive if they are convex as seen from
    /// the eye's side (at a silhouette, from the first triangle's front), 0 at a border, without a sign at an intersection.
    pub angle: f32,
    /// [`EdgeClass`] as a number; plus [`LineSegment::SUPPRESSED`], [`LineSegment::ELSEWHERE`]. Never [`EdgeClass::Object`].
    pub class: u32,
    /// [`PlacedEdges::object`].
    pub object: u32,
    /// The surfaces that meet here ([`crate::geometry::Surfaces::of_triangle`]); [`NO_SURFACE`] as the second at a border.
    pub surfaces: [u32; 2],
}

impl LineSegment {
    /// A bit of `class`: nobody asked for this line, but two surfaces meet in it. It is not drawn, and keeps the search for
    /// discontinuities (`passes/discontinuities.wgsl`) from taking its pixels for an intersection or a step in depth.
    pub const SUPPRESSED: u32 = 1 << 31;
    /// A bit of `class`: this line is drawn by others, see [`super::draw_strokes`]. Always with [`Self::SUPPRESSED`].
    pub const ELSEWHERE: u32 = 1 << 30;

    /// What kind of line it is, suppressed or not.
    pub fn edge_class(&self) -> Option<EdgeClass> {
        EdgeClass::ALL.get((self.class & !(Self::SUPPRESSED | Self::ELSEWHERE)) as usize).copied()
    }

    /// Whether nobody asked for it.
    pub fn is_suppressed(&self) -> bool {
        self.class & Self::SUPPRESSED != 0
    }
}

/// A camera and the picture that it makes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineView {
    /// The camera.
    pub projector: Projector,
    /// Added to all positions in the picture, in pixels (anti-aliasing by several slightly shifted pictures).
    pub jitter: DVec2,
    /// How far beyond the sides of the picture segments go on, in pixels; at least half of the widest line.
    pub margin: f64,
    /// What lies behind one of these planes is left out: view space, the product with (point, 1) is the distance before
    /// it. 0: no plane.
    pub clip_planes: [DVec4; 2],
}

/// Which lines are looked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineSelection {
    /// The classes. With [`EdgeClass::Object`], silhouettes and borders are found too.
    pub classes: ClassSet,
    /// Creases of at least this angle that are convex as seen from the eye are ridges; radians.
    pub ridge_angle: f32,
    /// Concave ones of at least this angle are valleys; radians.
    pub valley_angle: f32,
    /// Surfaces that run through each other at this angle at least make intersections; radians.
    pub intersection_angle: f32,
    /// Creases of at least this angle (radians), and all edges between different surfaces, are found as
    /// [`LineSegment::SUPPRESSED`] if they are nothing that is wanted. Infinite: none.
    pub suppress_angle: f32,
    /// Which lines have [`LineSegment::arcs`]; `None`: no line has.
    pub dashes: Option<Dashes>,
}

/// Lines that are interrupted regularly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dashes {
    /// The classes that are dashed; [`EdgeClass::Object`] stands for all silhouettes and borders.
    pub classes: ClassSet,
    /// After how many pixels dashes repeat, greater than 0. Loops are stretched by up to a tenth, so that a whole
    /// number of periods fits.
    pub period: f32,
}

/// A mesh's edges somewhere in the world.
#[derive(Debug, Clone, Copy)]
pub struct PlacedEdges<'a> {
    /// The edges.
    pub edges: &'a FeatureEdges,
    /// The mesh from which they were made.
    pub mesh: &'a Mesh,
    /// Local coordinates to world space.
    pub world_from_local: DMat4,
    /// A number for the object, returned with its segments.
    pub object: u32,
    /// [`crate::geometry::Topology::is_solid`].
    pub is_solid: bool,
    /// For each mesh of the scene whether it is drawn alike. Where one goes on at a border ([`Mesh::border_links`]) and is not,
    /// the surface ends.
    pub shown: &'a [bool],
}
