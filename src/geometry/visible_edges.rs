//! The exact visible edges of meshes for a camera, found without a renderer: what a picture of lines is measured
//! against.
//!
//! Edges come from the welded topology and from triangles that run through each other, visibility from rays, four
//! samples per pixel of length. Winding decides nothing, so flipped triangles and mirrored placements change nothing:
//! a crease is a ridge or a valley as it is seen, so that what is a ridge from outside of an open box is a valley from
//! inside. Triangles that lie on each other at an edge count once.
//!
//! Surfaces that coincide do not hide each other's edges: where two objects touch or share a plane, the edges of both
//! are seen, each as what it is. Where the near plane cuts a surface open, the cut is no edge. A border that lies
//! beside another one without touching it is a border, however narrow the gap.

mod bridges;
mod crossings;
mod sight;
mod world_edge;

use glam::{DMat4, DVec2, DVec3};
use rayon::prelude::*;

use self::sight::{Hiders, Sight};
use self::world_edge::{Fold, WholeEdge, WorldEdge};
use super::feature_edges::isolated::{IsolatedCreases, JoinedEdge};
use super::{Adjacency, Bvh, EdgeClass, Mesh, Projector};

/// Distance between samples along an edge, in pixels.
const SAMPLE_STEP: f64 = 0.25;
/// Most samples on one edge, against absurd picture sizes.
const MAX_SAMPLES: f64 = 1e6;

/// A mesh somewhere in the world.
#[derive(Debug, Clone, Copy)]
pub struct PlacedMesh<'a> {
    /// The mesh; must be clean (see [`super::clean()`]).
    pub mesh: &'a Mesh,
    /// Its edges.
    pub adjacency: &'a Adjacency,
    /// Local coordinates to world space.
    pub world_from_local: DMat4,
    /// A number for the object, returned with its edges.
    pub object: u32,
}

/// What counts as a line.
#[derive(Clone, Copy)]
pub struct LineRules<'a> {
    /// Two surfaces that are seen to meet make a ridge or a valley where they bend by more than this angle, in degrees: twin of the
    /// thresholds of a style.
    pub ridge_valley_angle: f64,
    /// The classes that are looked for. Where several apply, the first one of these counts.
    pub classes: &'a [EdgeClass],
    /// Whether a surface has a hole at a point (alpha masks); `None`: nothing has. Holes hide nothing and have no
    /// edges of their own.
    pub is_hole: Option<&'a (dyn Fn(SurfacePoint) -> bool + Sync)>,
}

impl Default for LineRules<'_> {
    /// Creases from 30°, every class but [`EdgeClass::Material`], no holes.
    fn default() -> Self {
        const CLASSES: [EdgeClass; 6] = [
            EdgeClass::Silhouette,
            EdgeClass::Border,
            EdgeClass::Object,
            EdgeClass::Ridge,
            EdgeClass::Valley,
            EdgeClass::Intersection,
        ];
        Self { ridge_valley_angle: 30.0, classes: &CLASSES, is_hole: None }
    }
}

/// A point on a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// Which of the meshes that [`EdgeScene::new`] was given.
    pub mesh: usize,
    /// Index into [`Mesh::triangles`].
    pub triangle: usize,
    /// Weights of the triangle's corners; they add up to 1.
    pub weights: DVec3,
}

/// A point on a visible edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeSample {
    /// Where it appears, in pixels: (0, 0) is the upper left corner of the picture, y runs down.
    pub position: DVec2,
    /// Length of the edge that it stands for, in pixels; at most a quarter.
    pub length: f64,
}

/// A visible part of an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VisibleSegment {
    /// What kind of line it is.
    pub class: EdgeClass,
    /// [`PlacedMesh::object`]; of an intersection, that of the first triangle.
    pub object: u32,
    /// Index into [`Adjacency::edges`]; `None` for an intersection.
    pub edge: Option<u32>,
    /// Where its ends appear, in pixels as [`EdgeSample::position`].
    pub ends: [DVec2; 2],
    /// Where they lie, in world space.
    pub places: [DVec3; 2],
}

impl VisibleSegment {
    /// Length in world units.
    pub fn world_length(&self) -> f64 {
        self.places[0].distance(self.places[1])
    }
}

/// What is seen of the edges.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct VisibleEdges {
    /// The samples of each class, in the order of [`EdgeClass::ALL`].
    pub samples: [Vec<EdgeSample>; EdgeClass::ALL.len()],
    /// Visible parts, edge by edge.
    pub segments: Vec<VisibleSegment>,
}

/// Placed meshes, ready to be looked at from anywhere.
#[derive(Debug, Clone)]
pub struct EdgeScene {
    tree: Bvh,
    /// Corners of all triangles, mesh after mesh.
    triangles: Vec<[DVec3; 3]>,
    /// For each mesh the number of its first triangle, and its object.
    meshes: Vec<(usize, u32)>,
    edges: Vec<WorldEdge>,
    /// Number of vertices of all meshes.
    point_count: usize,
}

impl EdgeScene {
    /// Gathers triangles, edges and intersections.
    pub fn new(meshes: &[PlacedMesh<'_>]) -> Self {
        let mut triangles: Vec<[DVec3; 3]> = Vec::new();
        let mut firsts = Vec::new();
        let mut first_points = Vec::new();
        let mut point_count = 0;
        for placed in meshes {
            first_points.push(point_count as u32);
            point_count += placed.mesh.positions.len();
            firsts.push((triangles.len(), placed.object));
            let place = |p: glam::Vec3| placed.world_from_local.transform_point3(p.as_dvec3());
            triangles.extend(placed.mesh.triangles().iter().map(|&t| placed.mesh.corners(t).map(place)));
        }
        let tree = Bvh::new(&triangles);
        let mut edges: Vec<WorldEdge> = meshes
            .par_iter()
            .zip(&firsts)
            .zip(&first_points)
            .flat_map_iter(|((placed, &(first, _)), &point)| {
                world_edge::edges_of(placed, &triangles, first, point)
            })
            .collect();
        edges.extend(crossings::find(meshes, &firsts, &tree, &triangles));
        Self { tree, triangles, meshes: firsts, edges, point_count }
    }

    /// The edges that a camera sees.
    pub fn visible(&self, projector: &Projector, rules: &LineRules<'_>) -> VisibleEdges {
        let sight = Sight::new(self, projector, rules);
        let bridges = bridges::find(&self.edges, rules);
        let isolated = self.isolated(rules, &bridges);
        let fold = |i: u32| match () {
            () if isolated.contains(i) => Fold::Isolated,
            () if bridges.binary_search(&i).is_ok() => Fold::Bridge,
            () => Fold::ByAngle,
        };
        let part = |(i, edge): (usize, &WorldEdge)| visible_part(edge, fold(i as u32), &sight);
        let parts: Vec<_> = self.edges.par_iter().enumerate().filter_map(part).collect();
        let mut visible = VisibleEdges::default();
        for (samples, segments) in parts {
            for (class, sample) in samples {
                visible.samples[class as usize].push(sample);
            }
            visible.segments.extend(segments);
        }
        visible
    }

    /// The creases that are isolated, with their bridges, of meshes that leave those out.
    fn isolated(&self, rules: &LineRules<'_>, bridges: &[u32]) -> IsolatedCreases {
        let joined = |(edge, line): (u32, &WorldEdge)| {
            let WholeEdge { points, angle, length, .. } = line.whole.filter(|whole| whole.can_be_isolated)?;
            let sharpness =
                angle.map_or(f32::INFINITY, |angle| angle.abs() / rules.ridge_valley_angle as f32);
            let is_line = sharpness >= 1.0 || bridges.binary_search(&edge).is_ok();
            is_line.then_some(JoinedEdge { edge, points, length, sharpness })
        };
        IsolatedCreases::new((0..).zip(&self.edges).filter_map(joined), self.point_count)
    }

    /// How many holes the center of each pixel is seen through, row by row from the top. Where that changes is the
    /// outline of a hole, which is no edge.
    pub fn holes_before(&self, projector: &Projector, rules: &LineRules<'_>) -> Vec<u32> {
        let sight = Sight::new(self, projector, rules);
        let [width, height] = projector.size;
        let center = |i: u32| DVec2::new(f64::from(i % width) + 0.5, f64::from(i / width) + 0.5);
        (0..width * height).into_par_iter().map(|i| sight.holes_at(center(i))).collect()
    }

    /// The mesh that a triangle belongs to, and the number of the mesh's first triangle.
    fn mesh_of(&self, triangle: usize) -> (usize, usize) {
        let mesh = self.meshes.partition_point(|&(first, _)| first <= triangle).saturating_sub(1);
        (mesh, self.meshes.get(mesh).map_or(0, |&(first, _)| first))
    }
}

/// Samples and visible parts of one edge; `None` if it is no line for this eye or out of the picture.
fn visible_part(
    edge: &WorldEdge,
    fold: Fold,
    sight: &Sight<'_>,
) -> Option<(Vec<(EdgeClass, EdgeSample)>, Vec<VisibleSegment>)> {
    let (projector, rules) = (sight.projector, sight.rules);
    let line = edge.line(sight.to_eye(edge.ends[0]), fold, rules)?;
    let ends = projector.clip(edge.ends.map(|p| projector.view_from_world.transform_point3(p)))?;
    let pixels = ends.map(|p| projector.pixel(p));
    let length = pixels[0].distance(pixels[1]);
    let count = (length / SAMPLE_STEP).ceil().clamp(1.0, MAX_SAMPLES) as u32;
    let world_from_view = projector.view_from_world.inverse();
    let at = |along: f64| ends[0].lerp(ends[1], projector.along_segment(ends, along));
    let step = 1.0 / f64::from(count);
    let outwards = sight.outwards(&line, pixels, ends[0]);

    let mut samples = Vec::new();
    let mut segments = Vec::new();
    let mut hiders = Hiders::default();
    let mut current: Option<(EdgeClass, f64)> = None;
    for i in 0..=count {
        let here = f64::from(i) * step;
        let along = here + 0.5 * step;
        let position = pixels[0].lerp(pixels[1], along);
        let class = if i < count {
            sight.class_at(edge, &line, position, at(along), outwards, &mut hiders)
        } else {
            None
        };
        if let Some(class) = class {
            samples.push((class, EdgeSample { position, length: length * step }));
        }
        if current.map(|(class, _)| class) == class {
            continue;
        }
        if let Some((class, from)) = current {
            segments.push(VisibleSegment {
                class,
                object: edge.object,
                edge: edge.edge,
                ends: [from, here].map(|along| pixels[0].lerp(pixels[1], along)),
                places: [from, here].map(|along| world_from_view.transform_point3(at(along))),
            });
        }
        current = class.map(|class| (class, here));
    }
    Some((samples, segments))
}

#[cfg(test)]
mod class_tests;
#[cfg(test)]
mod tests;
