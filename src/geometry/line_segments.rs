//! The edges of a mesh that are lines for one camera, as segments in the picture.
//!
//! Hidden ones are among them: what lies in front is decided per pixel, against the depth buffer. Silhouettes are
//! edges between a triangle that faces the eye and one that does not; every triangle is asked once per view, so that
//! the outlines of closed meshes are closed.

mod angles;
mod arcs;
mod clip;
mod contours;
mod facing;
mod hand_strokes;
mod intersections;
mod non_manifold;
mod outlines;
mod polyline_arcs;
mod scale;
mod segment;

use std::sync::Arc;

use glam::DMat4;
use rayon::prelude::*;

use self::angles::Angles;
use self::clip::PictureMap;
pub use self::contours::{PlacedContours, contour_segments};
use self::facing::Facings;
pub use self::hand_strokes::{SegmentSet, Tested, draw_strokes};
pub use self::intersections::{PlacedIntersections, intersection_segments};
use self::non_manifold::NonManifoldEdges;
pub use self::segment::{Dashes, LineSegment, LineSelection, LineView, NO_SURFACE, PlacedEdges};
use super::feature_edges::Traits;
use super::feature_edges::crease_angles::CreaseAngles;
use super::feature_edges::isolated::IsolatedCreases;
use super::{ClassSet, EdgeClass};

/// Edges that one thread takes at a time; fewer are not worth a thread.
const EDGES_PER_TASK: usize = 1 << 14;

/// Edges that are looked at side by side.
const BLOCK: usize = 64;

/// Appends the segments of an object that are lines for a camera, in the order of its edges: the same for any number of
/// threads. Costs one look at each triangle and edge, about 4 ms per million triangles on two cores.
pub fn line_segments(
    placed: &PlacedEdges<'_>,
    view: &LineView,
    wanted: &LineSelection,
    out: &mut Vec<LineSegment>,
) {
    find_segments(placed, view, wanted, false, out);
}

/// The same, and who found them with where each comes from if that `is_traced` or anything is dashed.
fn find_segments<'a>(
    placed: &'a PlacedEdges<'a>,
    view: &LineView,
    wanted: &'a LineSelection,
    is_traced: bool,
    out: &mut Vec<LineSegment>,
) -> Option<(Finder<'a>, Trace)> {
    if wanted.classes.is_empty() && wanted.suppress_angle == f32::INFINITY {
        return None;
    }
    let view_from_local = view.projector.view_from_world * placed.world_from_local;
    let picture = PictureMap::new(view, &view_from_local).within(&placed.edges.bounds)?;
    let mut finder = Finder::new(placed, view, wanted, &view_from_local, picture);
    finder.is_traced |= is_traced;
    let first = out.len();
    let mut trace = Trace::default();
    let count = placed.edges.len();
    if count <= 2 * EDGES_PER_TASK {
        finder.find(0..count, out, &mut trace);
    } else {
        let found: Vec<(Vec<LineSegment>, Trace)> = (0..count.div_ceil(EDGES_PER_TASK))
            .into_par_iter()
            .map(|task| {
                let start = task * EDGES_PER_TASK;
                let (mut found, mut trace) = (Vec::new(), Trace::default());
                finder.find(start..(start + EDGES_PER_TASK).min(count), &mut found, &mut trace);
                (found, trace)
            })
            .collect();
        out.reserve(found.iter().map(|(segments, _)| segments.len()).sum());
        for (segments, own) in found {
            out.extend_from_slice(&segments);
            trace.edges.extend_from_slice(&own.edges);
            trace.unseen.extend_from_slice(&own.unseen);
        }
    }
    if let (Some(dashes), Some(segments)) = (&wanted.dashes, out.get_mut(first..)) {
        finder.measure(dashes, &trace, segments);
    }
    Some((finder, trace))
}

/// Where segments come from. Kept only for dashes and strokes.
#[derive(Default)]
struct Trace {
    /// The edge of each segment.
    edges: Vec<u32>,
    /// Silhouettes beyond the picture, in order.
    unseen: Vec<u32>,
}

/// What an edge is for a view.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Line {
    class: u32,
    angle: f32,
    /// Triangles whose surfaces are seen, the same one twice at a border.
    faces: [u32; 2],
}

/// One object before one camera.
struct Finder<'a> {
    placed: &'a PlacedEdges<'a>,
    wanted: &'a LineSelection,
    picture: PictureMap,
    facings: Facings,
    non_manifold: NonManifoldEdges<'a>,
    angles: Angles<'a>,
    isolated: Arc<IsolatedCreases>,
    /// Edges with these traits are looked at closely, whatever their angle.
    special: Traits,
    /// No edge that bends less than this (radians, local space) can be a crease.
    min_angle: f32,
    /// Whether creases that face away are hidden by their own object.
    hides_its_back: bool,
    /// Whether it is kept where segments come from.
    is_traced: bool,
}

impl<'a> Finder<'a> {
    fn new(
        placed: &'a PlacedEdges<'a>,
        view: &LineView,
        wanted: &'a LineSelection,
        view_from_local: &DMat4,
        picture: PictureMap,
    ) -> Self {
        let PlacedEdges { edges, mesh, .. } = *placed;
        let lens = view.projector.lens;
        let angles = Angles::new(mesh, view_from_local);
        let crease_angles = CreaseAngles { ridge: wanted.ridge_angle, valley: wanted.valley_angle };
        let asked = |class: EdgeClass, angle: f32| {
            if wanted.classes.contains(class) { angle } else { f32::INFINITY }
        };
        let min_angle = asked(EdgeClass::Ridge, wanted.ridge_angle)
            .min(asked(EdgeClass::Valley, wanted.valley_angle))
            .min(wanted.suppress_angle);
        let outlines = ClassSet::of(&[EdgeClass::Border, EdgeClass::Object]);
        let mut special = Traits::NON_MANIFOLD;
        if EdgeClass::ALL.iter().any(|&class| outlines.contains(class) && wanted.classes.contains(class)) {
            special = special.union(Traits::BORDER);
        }
        if wanted.classes.contains(EdgeClass::Material) {
            special = special.union(Traits::MATERIAL);
        }
        Self {
            placed,
            wanted,
            picture,
            facings: Facings::new(mesh, &edges.bounds, view_from_local, lens).with_slivers(&edges.slivers),
            non_manifold: NonManifoldEdges::new(placed, *view_from_local, lens),
            min_angle: angles.min_local(min_angle),
            angles,
            isolated: edges.isolated(mesh, crease_angles),
            special,
            is_traced: wanted.dashes.is_some(),
            hides_its_back: placed.is_solid && clip::is_before_the_eye(&edges.bounds, view_from_local, lens),
        }
    }

    /// Appends the segments of a range of edges.
    fn find(&self, range: std::ops::Range<usize>, out: &mut Vec<LineSegment>, trace: &mut Trace) {
        let edges = self.placed.edges;
        let (Some(faces), Some(dihedral), Some(traits)) = (
            edges.faces.get(range.clone()),
            edges.dihedral.get(range.clone()),
            edges.traits.get(range.clone()),
        ) else {
            return;
        };
        let blocks = faces.chunks(BLOCK).zip(dihedral.chunks(BLOCK)).zip(traits.chunks(BLOCK));
        for (start, ((faces, dihedral), traits)) in (range.start..).step_by(BLOCK).zip(blocks) {
            // Most edges are no lines. That is found without a branch for each of them.
            let mut marks = [0_u8; BLOCK];
            for (mark, &faces) in marks.iter_mut().zip(faces) {
                *mark = self.facings.differ(faces);
            }
            for ((mark, dihedral), traits) in marks.iter_mut().zip(dihedral).zip(traits) {
                let is_sharp = dihedral.abs() >= self.min_angle;
                *mark = *mark ^ traits.flip() | u8::from(is_sharp) | u8::from(traits.any(self.special));
            }
            let words: [u64; BLOCK / 8] = bytemuck::cast(marks);
            for (word, start_of_word) in words.into_iter().zip((0..).step_by(8)) {
                if word == 0 {
                    continue;
                }
                for i in start_of_word..(start_of_word + 8).min(faces.len()) {
                    if marks[i] == 0 {
                        continue;
                    }
                    if let Some(line) = self.line((start + i) as u32, faces[i], dihedral[i], traits[i]) {
                        self.push((start + i) as u32, &line, out, trace);
                    }
                }
            }
        }
    }

    /// What an edge is; `None` if it is nothing.
    fn line(&self, edge: u32, faces: [u32; 2], dihedral: f32, traits: Traits) -> Option<Line> {
        if traits.any(Traits::NON_MANIFOLD) {
            let seen = self.non_manifold.look(edge)?;
            return match seen.outline {
                Some(outline) => self.outline(outline, seen.angle, seen.faces),
                None => {
                    let soft = Traits::SOFT.when(traits.any(Traits::SOFT));
                    let traits = soft.union(Traits::MATERIAL.when(seen.materials_differ));
                    self.crease(seen.angle, seen.faces, traits)
                }
            };
        }
        if traits.any(Traits::BORDER) {
            return self.outline(EdgeClass::Border, 0.0, faces);
        }
        let is_away = self.facings.of(faces[0]) == 0;
        let is_silhouette = self.facings.differ(faces) != traits.flip();
        if is_away && !is_silhouette && self.hides_its_back {
            return None;
        }
        let angle = self.angles.of(faces, dihedral, traits);
        if is_silhouette {
            // In a hollow of a solid, what lies before a silhouette hides it.
            if self.hides_its_back && angle < -1e-3 {
                return None;
            }
            return self.outline(EdgeClass::Silhouette, angle, faces);
        }
        let traits = traits.union(Traits::SOFT.when(self.isolated.contains(edge)));
        // From behind, what is convex looks concave.
        self.crease(if is_away { -angle } else { angle }, faces, traits)
    }

    /// A line with all surfaces on one side of it.
    fn outline(&self, class: EdgeClass, angle: f32, faces: [u32; 2]) -> Option<Line> {
        let is_wanted =
            self.wanted.classes.contains(class) || self.wanted.classes.contains(EdgeClass::Object);
        let class = if is_wanted { class as u32 } else { self.suppressed(class, angle, faces)? };
        Some(Line { class, angle, faces })
    }

    /// A line with a surface on either side.
    fn crease(&self, angle: f32, faces: [u32; 2], traits: Traits) -> Option<Line> {
        let is_hard = !traits.any(Traits::SOFT);
        let candidates = [
            (is_hard && angle >= self.wanted.ridge_angle, EdgeClass::Ridge),
            (is_hard && angle <= -self.wanted.valley_angle, EdgeClass::Valley),
            (traits.any(Traits::MATERIAL), EdgeClass::Material),
        ];
        let first = candidates.into_iter().find(|&(is, class)| is && self.wanted.classes.contains(class));
        let class = match first {
            Some((_, class)) => class as u32,
            None if angle < 0.0 => self.suppressed(EdgeClass::Valley, angle, faces)?,
            None => self.suppressed(EdgeClass::Ridge, angle, faces)?,
        };
        Some(Line { class, angle, faces })
    }

    /// The class of a line that nobody wants, if it has to be known.
    fn suppressed(&self, class: EdgeClass, angle: f32, faces: [u32; 2]) -> Option<u32> {
        let [one, two] = faces.map(|face| self.surface(face));
        let is_boundary = angle.abs() >= self.wanted.suppress_angle
            || one != two && self.wanted.suppress_angle < f32::INFINITY;
        is_boundary.then_some(class as u32 | LineSegment::SUPPRESSED)
    }

    fn surface(&self, face: u32) -> u32 {
        self.placed.edges.surfaces.of_triangle.get(face as usize).copied().unwrap_or(NO_SURFACE)
    }

    fn push(&self, edge: u32, line: &Line, out: &mut Vec<LineSegment>, trace: &mut Trace) {
        let PlacedEdges { edges, mesh, object, .. } = self.placed;
        let Some(ends) = edges.ends.get(edge as usize) else { return };
        let [Some(&a), Some(&b)] = ends.map(|v| mesh.positions.get(v as usize)) else { return };
        let Some([from, to]) = self.picture.segment([a, b]) else {
            if self.is_traced && line.class == EdgeClass::Silhouette as u32 {
                trace.unseen.push(edge);
            }
            return;
        };
        if self.is_traced {
            trace.edges.push(edge);
        }
        let [one, two] = line.faces;
        out.push(LineSegment {
            ends: [from.px.as_vec2().to_array(), to.px.as_vec2().to_array()],
            depths: [from.depth as f32, to.depth as f32],
            arcs: [0.0; 2],
            angle: line.angle,
            class: line.class,
            object: *object,
            surfaces: [self.surface(one), if one == two { NO_SURFACE } else { self.surface(two) }],
        });
    }
}

#[cfg(test)]
mod arc_tests;
#[cfg(test)]
mod hand_strokes_tests;
#[cfg(test)]
mod speed;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod truth_tests;
