//! The lines that topology knows, for one view.

use rayon::prelude::*;

use super::edge_style::GpuEdgeStyle;
use super::gpu_scene::GpuScene;
use super::group::{Group, Visible};
use super::ids::{object_id, surface_id};
use super::intersections::Meeting;
use super::stroke_style::StrokeStyle;
use super::view::View;
use crate::geometry::line_segments::{
    Dashes, LineSelection, LineView, PlacedContours, PlacedEdges, PlacedIntersections, SegmentSet,
    contour_segments, draw_strokes, intersection_segments,
};
use crate::geometry::{ClassSet, EdgeClass, LineSegment, line_segments};

/// Silhouettes, borders, creases, material boundaries and intersections of all objects of a group with exact lines, hidden ones
/// included; straight ones as strokes if the group has any. Empty while topology is not known. `crease_angle` (radians): above it edges separate
/// surfaces.
pub fn feature_lines(scene: &GpuScene, group: &Group, view: &View, crease_angle: f32) -> SegmentSet {
    find(scene, group, view, crease_angle, group.strokes)
}

/// The same without strokes.
pub fn plain_feature_lines(scene: &GpuScene, group: &Group, view: &View, crease_angle: f32) -> SegmentSet {
    find(scene, group, view, crease_angle, None)
}

fn find(
    scene: &GpuScene,
    group: &Group,
    view: &View,
    crease_angle: f32,
    strokes: Option<StrokeStyle>,
) -> SegmentSet {
    let reach = strokes.map_or(0.0, |StrokeStyle(hand)| hand.reach());
    // The vertex shader adds the jitter.
    let view = LineView {
        projector: view.projector(),
        jitter: glam::DVec2::ZERO,
        margin: f64::from(group.greatest_radius() + 2.0) + reach,
        clip_planes: view.clip_planes(),
    };
    let mut shown = vec![false; scene.scene.meshes.len()];
    for mesh in group.visible().iter().filter_map(|object| scene.scene.nodes[object.node].mesh) {
        shown[mesh] = true;
    }
    let finder = Finder { scene, group, view: &view, crease_angle, strokes, shown: &shown };
    // Neighbors share their memory: most objects have few lines.
    let added = |mut found, object| {
        finder.add(object, &mut found);
        found
    };
    let found: Vec<SegmentSet> = group.visible().par_iter().fold(SegmentSet::default, added).collect();
    let mut all = SegmentSet::default();
    all.segments.reserve(found.iter().map(|own| own.segments.len()).sum());
    for own in &found {
        all.append(own);
    }
    add_intersections(scene, group, &view, crease_angle, &mut all.segments);
    if strokes.is_some() {
        all.complete();
    }
    all
}

/// What looks for the lines of objects, each by itself.
struct Finder<'a> {
    scene: &'a GpuScene,
    group: &'a Group,
    view: &'a LineView,
    crease_angle: f32,
    strokes: Option<StrokeStyle>,
    /// Which meshes are seen.
    shown: &'a [bool],
}

impl Finder<'_> {
    /// Adds the lines of an object.
    fn add(&self, object: &Visible, out: &mut SegmentSet) {
        let first = out.segments.len();
        self.add_of_mesh(object, out);
        let id = object_id(object.node);
        for segment in &mut out.segments[first..] {
            let [one, two] = segment.surfaces;
            segment.surfaces = [surface_id(id, one), surface_id(id, two)];
        }
    }

    /// The same with surfaces numbered as in its mesh.
    fn add_of_mesh(&self, object: &Visible, out: &mut SegmentSet) {
        let Self { scene, group, view, crease_angle, .. } = *self;
        let (node, enhanced) = (object.node, object.enhanced);
        let id = object_id(node);
        let Some(style) = group.edge_styles.of(id).filter(|s| enhanced && s.is_exact()) else {
            return;
        };
        let found = &scene.scene.nodes[node];
        let Some((index, mesh)) = found.mesh.and_then(|m| Some((m, scene.scene.meshes.get(m)?))) else {
            return;
        };
        let Some(edges) = scene.edges(index) else { return };
        let placed = PlacedEdges {
            edges,
            mesh,
            world_from_local: found.world_from_local,
            object: id,
            // What a solid hides is left out.
            is_solid: scene.shows_no_inside(node) && object.is_whole() && !group.is_unculled,
            shown: self.shown,
        };
        let wanted = wanted(style, crease_angle);
        match self.strokes {
            Some(StrokeStyle(hand)) => draw_strokes(&placed, view, &wanted, &hand, crease_angle, out),
            None => line_segments(&placed, view, &wanted, &mut out.segments),
        }
        if let Some((section, sectioned)) = scene.section.as_ref().and_then(|s| Some((s, s.sectioned(node)?)))
        {
            let placed = PlacedContours {
                contours: &sectioned.contours,
                world_from_plane: section.world_from_cap(sectioned),
                edges,
                object: id,
                cap: sectioned.cap.map(|cap| cap.surface),
            };
            contour_segments(&placed, view, &wanted, &mut out.segments);
        }
    }
}

/// An object of a group.
#[derive(Clone, Copy)]
struct Member {
    object: u32,
    /// What its style asks for, if that has intersections.
    drawn: Option<LineSelection>,
}

/// Where objects of a group run through each other. The first of both draws the line, if it has intersections at all.
fn add_intersections(
    scene: &GpuScene,
    group: &Group,
    view: &LineView,
    crease_angle: f32,
    out: &mut Vec<LineSegment>,
) {
    let Some(intersections) = scene.intersections() else { return };
    let mut members = vec![None; scene.model().nodes.len()];
    for object in group.visible() {
        let style = group.edge_styles.of(object_id(object.node));
        let wanted = style.filter(|s| object.enhanced && s.is_exact()).map(|s| wanted(s, crease_angle));
        if let Some(member) = members.get_mut(object.node) {
            let drawn = wanted.filter(|wanted| wanted.classes.contains(EdgeClass::Intersection));
            *member = Some(Member { object: object_id(object.node), drawn });
        }
    }
    for Meeting { nodes, curves } in intersections.iter(scene.model()) {
        let [Some(Some(one)), Some(Some(other))] = nodes.map(|node| members.get(node)) else { continue };
        let drawn_by = |member: &Member| member.drawn.map(|wanted| (member.object, wanted));
        let owner = drawn_by(one).or_else(|| drawn_by(other));
        let found = nodes.map(|node| scene.scene.nodes.get(node)?.mesh.and_then(|mesh| scene.edges(mesh)));
        let (Some((object, wanted)), [Some(edges), Some(other_edges)]) = (owner, found) else { continue };
        let placed = PlacedIntersections {
            curves,
            world_from_local: scene.scene.nodes[nodes[0]].world_from_local,
            edges: [edges, other_edges],
            object,
        };
        let first = out.len();
        intersection_segments(&placed, view, &wanted, out);
        for segment in out.iter_mut().skip(first) {
            let [surface, other_surface] = segment.surfaces;
            segment.surfaces = [surface_id(one.object, surface), surface_id(other.object, other_surface)];
        }
    }
}

/// What an object's style asks for. Creases that separate surfaces are found even where they are not drawn: they tell
/// that there is no intersection, nor a step in depth where one of the surfaces is steep.
fn wanted(style: &GpuEdgeStyle, crease_angle: f32) -> LineSelection {
    let of = |class: EdgeClass| &style.lines[class as usize];
    let classes = style.drawn().fold(ClassSet::NONE, |classes, (class, _)| classes.with(class));
    let dashed = style.drawn().filter(|(_, line)| line.dashed == 1);
    let dashed = dashed.fold(ClassSet::NONE, |classes, (class, _)| classes.with(class));
    let with_discontinuities = [EdgeClass::Silhouette, EdgeClass::Object, EdgeClass::Intersection]
        .into_iter()
        .any(|class| classes.contains(class));
    LineSelection {
        dashes: (!dashed.is_empty()).then_some(Dashes { classes: dashed, period: style.dash_period }),
        classes,
        ridge_angle: of(EdgeClass::Ridge).threshold,
        valley_angle: of(EdgeClass::Valley).threshold,
        intersection_angle: of(EdgeClass::Intersection).threshold,
        suppress_angle: if with_discontinuities { crease_angle } else { f32::INFINITY },
    }
}
