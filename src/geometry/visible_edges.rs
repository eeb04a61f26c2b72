//! The exact visible edges of meshes for a camera, found without a renderer: what a picture of lines is measured
//! against.
//!
//! Edges come from the welded topology, visibility from rays, four samples per pixel of length.

use glam::{DMat4, DVec2, DVec3};
use rayon::prelude::*;

use super::{Adjacency, Bvh, EdgeKind, Mesh, Projector};

/// Distance between samples along an edge, in pixels.
const SAMPLE_STEP: f64 = 0.25;
/// How much nearer than a sample a surface must be to hide it: this part of the distance, or in parallel projection of
/// the picture's height.
const DEPTH_SLACK: f64 = 1e-4;
/// How far beside a silhouette, in pixels, is looked at too.
const BESIDE: f64 = 0.5;
/// Most samples on one edge, against absurd picture sizes.
const MOST_SAMPLES: f64 = 1e6;

/// What kind of line an edge is. Where several apply, the first one counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum EdgeClass {
    /// All surfaces at the edge lie on one side of it in the picture; at least two.
    Silhouette,
    /// The surface ends.
    Border,
    /// Convex crease.
    Ridge,
    /// Concave crease.
    Valley,
}

impl EdgeClass {
    /// All classes, in the order of [`VisibleEdges::samples`].
    pub const ALL: [Self; 4] = [Self::Silhouette, Self::Border, Self::Ridge, Self::Valley];
}

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

/// A point on a visible edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Where it appears, in pixels: (0, 0) is the upper left corner of the picture, y runs down.
    pub position: DVec2,
    /// Length of the edge that it stands for, in pixels; at most a quarter.
    pub length: f64,
}

/// A visible stretch of an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VisibleSegment {
    /// What kind of line it is.
    pub class: EdgeClass,
    /// [`PlacedMesh::object`].
    pub object: u32,
    /// Index into [`Adjacency::edges`].
    pub edge: u32,
    /// Where its ends appear, in pixels as [`Sample::position`].
    pub ends: [DVec2; 2],
    /// Length in world units.
    pub world_length: f64,
}

/// What is seen of the edges.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct VisibleEdges {
    /// The samples of each class, in the order of [`EdgeClass::ALL`].
    pub samples: [Vec<Sample>; EdgeClass::ALL.len()],
    /// Visible stretches, edge by edge.
    pub segments: Vec<VisibleSegment>,
}

/// Placed meshes, ready to be looked at from anywhere.
#[derive(Debug, Clone)]
pub struct EdgeScene {
    tree: Bvh,
    edges: Vec<WorldEdge>,
}

#[derive(Debug, Clone)]
struct WorldEdge {
    ends: [DVec3; 2],
    /// Numbers of all triangles at the edge.
    faces: Vec<u32>,
    /// The corner of each of them that is not on the edge.
    opposite: Vec<DVec3>,
    /// Greatest angle between two of them, in radians, negative where concave.
    angle: f64,
    object: u32,
    edge: u32,
}

impl EdgeScene {
    /// Gathers triangles and edges. Edges that other ones continue (T-junctions) are left out.
    pub fn new(meshes: &[PlacedMesh<'_>]) -> Self {
        let mut triangles: Vec<[DVec3; 3]> = Vec::new();
        let mut edges = Vec::new();
        for placed in meshes {
            let first = triangles.len();
            let place = |p: glam::Vec3| placed.world_from_local.transform_point3(p.as_dvec3());
            triangles.extend(placed.mesh.triangles().iter().map(|&t| placed.mesh.corners(t).map(place)));
            let own = &triangles[first..];
            edges.extend((0..placed.adjacency.edges.len()).filter_map(|e| world_edge(placed, e, own, first)));
        }
        Self { tree: Bvh::new(&triangles), edges }
    }

    /// The edges that a camera sees. An edge is a crease where its surfaces meet at more than `crease_angle` degrees.
    pub fn visible(&self, projector: &Projector, crease_angle: f64) -> VisibleEdges {
        let view = View { projector, world_from_view: projector.view_from_world.inverse() };
        let crease = crease_angle.to_radians();
        let stretches: Vec<_> = self
            .edges
            .par_iter()
            .filter_map(|edge| {
                let class = edge.class(&view, crease)?;
                Some((class, self.visible_part(edge, class, &view)?))
            })
            .collect();
        let mut visible = VisibleEdges::default();
        for (class, (samples, segments)) in stretches {
            visible.samples[class as usize].extend(samples);
            visible.segments.extend(segments);
        }
        visible
    }

    fn visible_part(
        &self,
        edge: &WorldEdge,
        class: EdgeClass,
        view: &View<'_>,
    ) -> Option<(Vec<Sample>, Vec<VisibleSegment>)> {
        let projector = view.projector;
        let ends = projector.clip(edge.ends.map(|p| projector.view_from_world.transform_point3(p)))?;
        let pixels = ends.map(|p| projector.pixel(p));
        let length = pixels[0].distance(pixels[1]);
        let count = (length / SAMPLE_STEP).ceil().clamp(1.0, MOST_SAMPLES) as u32;
        let across = (pixels[1] - pixels[0]).perp().normalize_or_zero() * BESIDE;
        let at = |along: f64| ends[0].lerp(ends[1], projector.along_segment(ends, along));
        let step = 1.0 / f64::from(count);

        let mut samples = Vec::new();
        let mut segments = Vec::new();
        let mut start = None;
        for i in 0..=count {
            let here = f64::from(i) * step;
            let along = here + 0.5 * step;
            let position = pixels[0].lerp(pixels[1], along);
            let seen = i < count && {
                let point = at(along);
                self.sees(view, point, &edge.faces)
                    || class == EdgeClass::Silhouette
                        && [across, -across].into_iter().any(|side| {
                            self.sees(view, projector.unproject(position + side, -point.z), &edge.faces)
                        })
            };
            if seen {
                samples.push(Sample { position, length: length * step });
                start.get_or_insert(here);
            } else if let Some(from) = start.take() {
                segments.push(VisibleSegment {
                    class,
                    object: edge.object,
                    edge: edge.edge,
                    ends: [pixels[0].lerp(pixels[1], from), pixels[0].lerp(pixels[1], here)],
                    world_length: at(from).distance(at(here)),
                });
            }
        }
        Some((samples, segments))
    }

    /// Whether nothing but `own` triangles hides a point in view space.
    fn sees(&self, view: &View<'_>, point: DVec3, own: &[u32]) -> bool {
        let (near, depth) = (view.projector.near, -point.z);
        let direction = view.projector.view_direction(point);
        // The ray starts where the depth is 0; with `scale` the parameter runs from there to the point.
        let origin = match view.projector.lens {
            super::Lens::Perspective { .. } => DVec3::ZERO,
            super::Lens::Orthographic { .. } => point.with_z(0.0),
        };
        let (from, to) = match view.projector.lens {
            super::Lens::Perspective { .. } => (near / depth, 1.0 - DEPTH_SLACK),
            super::Lens::Orthographic { half_height } => (near, depth - DEPTH_SLACK * 2.0 * half_height),
        };
        let skip = |triangle: usize| own.contains(&(triangle as u32));
        !self.tree.any_hit(
            view.world_from_view.transform_point3(origin),
            view.world_from_view.transform_vector3(direction),
            from,
            to,
            skip,
        )
    }
}

struct View<'a> {
    projector: &'a Projector,
    world_from_view: DMat4,
}

impl WorldEdge {
    /// What the edge is for this view; `None` if it is no line.
    fn class(&self, view: &View<'_>, crease: f64) -> Option<EdgeClass> {
        if self.opposite.len() == 1 {
            return Some(EdgeClass::Border);
        }
        let [a, b] = self.ends;
        let to_edge = view.projector.view_direction(view.projector.view_from_world.transform_point3(a));
        let plane = (b - a).cross(view.world_from_view.transform_vector3(to_edge)).normalize_or_zero();
        // On which side of the plane through the eye and the edge each surface lies; edge-on counts as either.
        let (mut left, mut right) = (false, false);
        for &corner in &self.opposite {
            let side = plane.dot((corner - a).normalize_or_zero());
            left |= side < -1e-9;
            right |= side > 1e-9;
        }
        if left != right {
            Some(EdgeClass::Silhouette)
        } else if self.angle > crease {
            Some(EdgeClass::Ridge)
        } else {
            (self.angle < -crease).then_some(EdgeClass::Valley)
        }
    }
}

/// Edge `index` of a mesh whose triangles in world space are `triangles`, the first of them being number `first`.
fn world_edge(
    placed: &PlacedMesh<'_>,
    index: usize,
    triangles: &[[DVec3; 3]],
    first: usize,
) -> Option<WorldEdge> {
    let PlacedMesh { mesh, adjacency, .. } = placed;
    let edge = adjacency.edges.get(index)?;
    let faces: Vec<u32> = match edge.kind {
        EdgeKind::Stitched => return None,
        EdgeKind::Border => vec![edge.faces[0]],
        EdgeKind::Manifold | EdgeKind::Flipped => edge.faces.to_vec(),
        EdgeKind::NonManifold => {
            let all = &adjacency.non_manifold;
            let start = all.partition_point(|&(e, _)| (e as usize) < index);
            all[start..].iter().take_while(|&&(e, _)| e as usize == index).map(|&(_, face)| face).collect()
        }
    };
    let point = |v: u32| adjacency.weld.representative.get(v as usize).copied();
    let on_edge = edge.vertices.map(point);
    let opposite = faces
        .iter()
        .filter_map(|&face| {
            let corner =
                mesh.triangles().get(face as usize)?.iter().position(|&v| !on_edge.contains(&point(v)))?;
            Some(triangles.get(face as usize)?[corner])
        })
        .collect();
    let normals: Vec<DVec3> = faces
        .iter()
        .filter_map(|&face| triangles.get(face as usize))
        .map(|&[a, b, c]| (b - a).cross(c - a).normalize_or_zero())
        .collect();
    let mut angle = 0.0_f64;
    for (i, &n) in normals.iter().enumerate() {
        for &m in &normals[i + 1..] {
            let cosine = match edge.kind {
                EdgeKind::Flipped => -n.dot(m),
                // Which of them belong together is not known; as planes they still meet at an angle.
                EdgeKind::NonManifold => n.dot(m).abs(),
                _ => n.dot(m),
            };
            angle = angle.max(n.cross(m).length().atan2(cosine));
        }
    }
    let place = |v: u32| placed.world_from_local.transform_point3(mesh.positions[v as usize].as_dvec3());
    Some(WorldEdge {
        ends: edge.vertices.map(place),
        faces: faces.iter().map(|face| face + first as u32).collect(),
        opposite,
        // A placement, mirrored or not, leaves convex what is convex.
        angle: if edge.dihedral < 0.0 { -angle } else { angle },
        object: placed.object,
        edge: index as u32,
    })
}

#[cfg(test)]
#[path = "visible_edges_tests.rs"]
mod tests;
