//! The contours of a section as lines in the picture.

use std::f32::consts::FRAC_PI_2;

use glam::{DMat4, DVec2, Vec3};

use super::clip::PictureMap;
use super::polyline_arcs::PolylineArcs;
use super::segment::{LineSegment, LineSelection, LineView, NO_SURFACE};
use crate::geometry::section::Contour;
use crate::geometry::{EdgeClass, FeatureEdges};

/// The contours of an object somewhere in the world.
#[derive(Debug, Clone, Copy)]
pub struct PlacedContours<'a> {
    /// The contours.
    pub contours: &'a [Contour],
    /// Where their plane lies.
    pub world_from_plane: DMat4,
    /// The edges of the mesh that was cut.
    pub edges: &'a FeatureEdges,
    /// A number for the object, returned with its segments.
    pub object: u32,
    /// The surface of the cap, if there is one.
    pub cap: Option<u32>,
}

/// Appends the segments of contours, which are [`LineSegment::SUPPRESSED`] unless sections are wanted.
pub fn contour_segments(
    placed: &PlacedContours<'_>,
    view: &LineView,
    wanted: &LineSelection,
    out: &mut Vec<LineSegment>,
) {
    let picture = PictureMap::new(view, &(view.projector.view_from_world * placed.world_from_plane));
    let is_wanted = wanted.classes.contains(EdgeClass::Section);
    if !is_wanted && wanted.suppress_angle == f32::INFINITY {
        return;
    }
    let class = EdgeClass::Section as u32 | if is_wanted { 0 } else { LineSegment::SUPPRESSED };
    let dashes = wanted.dashes.filter(|d| d.classes.contains(EdgeClass::Section));
    for contour in placed.contours {
        let ends = || contour.segments().map(|(ends, _)| ends.map(in_plane));
        let scale = dashes.map(|dashes| PolylineArcs::new(ends(), contour.is_closed, &picture, &dashes));
        for (number, (ends, triangle)) in contour.segments().enumerate() {
            let Some([from, to]) = picture.segment(ends.map(in_plane)) else { continue };
            let surface = placed.edges.surfaces.of_triangle.get(triangle as usize).copied();
            out.push(LineSegment {
                ends: [from.px.as_vec2().to_array(), to.px.as_vec2().to_array()],
                depths: [from.depth as f32, to.depth as f32],
                arcs: scale.as_ref().map_or([0.0; 2], |scale| scale.arcs(number, [from.px, to.px])),
                angle: FRAC_PI_2,
                class,
                object: placed.object,
                surfaces: [surface.unwrap_or(NO_SURFACE), placed.cap.unwrap_or(NO_SURFACE)],
            });
        }
    }
}

/// Of a contour's point, as the device has those of caps.
fn in_plane(point: DVec2) -> Vec3 {
    point.as_vec2().extend(0.0)
}
