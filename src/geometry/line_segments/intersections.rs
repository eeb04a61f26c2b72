//! The curves in which surfaces run through each other as lines in the picture.

use glam::DMat4;

use super::clip::PictureMap;
use super::polyline_arcs::PolylineArcs;
use super::segment::{LineSegment, LineSelection, LineView, NO_SURFACE};
use crate::geometry::{EdgeClass, FeatureEdges, IntersectionCurve};

/// Where two objects, or one with itself, run through each other somewhere in the world.
#[derive(Debug, Clone, Copy)]
pub struct PlacedIntersections<'a> {
    /// The curves.
    pub curves: &'a [IntersectionCurve],
    /// From the space of the first object, in which they are given.
    pub world_from_local: DMat4,
    /// The edges of both meshes.
    pub edges: [&'a FeatureEdges; 2],
    /// A number for the object that draws them, returned with the segments.
    pub object: u32,
}

/// Appends the segments of intersections, if they are wanted. Of their surfaces the first is one of the first object, the
/// other one of the second.
pub fn intersection_segments(
    placed: &PlacedIntersections<'_>,
    view: &LineView,
    wanted: &LineSelection,
    out: &mut Vec<LineSegment>,
) {
    if !wanted.classes.contains(EdgeClass::Intersection) {
        return;
    }
    let picture = PictureMap::new(view, &(view.projector.view_from_world * placed.world_from_local));
    let dashes = wanted.dashes.filter(|d| d.classes.contains(EdgeClass::Intersection));
    for curve in placed.curves {
        let ends = || curve.segments().map(|segment| segment.ends);
        let arcs = dashes.map(|dashes| PolylineArcs::new(ends(), curve.is_closed, &picture, &dashes));
        for (number, segment) in curve.segments().enumerate() {
            if segment.angle < wanted.intersection_angle {
                continue;
            }
            let Some([from, to]) = picture.segment(segment.ends) else { continue };
            let surface =
                |i: usize| placed.edges[i].surfaces.of_triangle.get(segment.faces[i] as usize).copied();
            out.push(LineSegment {
                ends: [from.px.as_vec2().to_array(), to.px.as_vec2().to_array()],
                depths: [from.depth as f32, to.depth as f32],
                arcs: arcs.as_ref().map_or([0.0; 2], |arcs| arcs.arcs(number, [from.px, to.px])),
                angle: segment.angle,
                class: EdgeClass::Intersection as u32,
                object: placed.object,
                surfaces: [surface(0).unwrap_or(NO_SURFACE), surface(1).unwrap_or(NO_SURFACE)],
            });
        }
    }
}
