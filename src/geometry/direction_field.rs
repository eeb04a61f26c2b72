//! The direction of strokes on a surface: around what is round, along what is long, and as parallel as possible.
//!
//! Directions have no front and back. They are found on the mesh cut open at its creases and at the corners of moldings,
//! so that strokes may change their direction there.

pub(crate) mod curvature;
pub(crate) mod cut;
pub(crate) mod graph;
mod narrow_strips;
mod planes;
mod smooth;
mod sources;

use glam::Vec3;

use self::curvature::{Curvature, curvatures};
use self::cut::{CutMesh, Faces};
use self::graph::Graph;
use self::narrow_strips::turn_on_narrow_strips;
use self::planes::Planes;
use self::smooth::{Data, smooth};
use super::{Adjacency, CreaseRule, Mesh};

/// Where directions come from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DirectionSource {
    /// The direction of the largest absolute curvature; on flat sides along the longer axis. Lengthwise on narrow strips,
    /// as moldings are.
    Curvature,
    /// The direction in which the first texture coordinate grows.
    TextureU,
    /// The direction in which the second texture coordinate grows.
    TextureV,
    /// The projection of an axis of local space on the surface; its length does not matter.
    Axis(Vec3),
}

/// What a direction field depends on besides the mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FieldOptions {
    /// Size of the whole scene in units of the mesh, to which all lengths are relative: its diagonal, say. What is not
    /// positive stands for the diagonal of the mesh.
    pub extent: f32,
    /// Where directions come from.
    pub source: DirectionSource,
    /// How far directions that are certain reach into places where they are not, in extents, above 0 to 1: about 0.08
    /// for what grew, 0.05 for what was constructed.
    pub smoothing: f32,
    /// Edges with a larger angle between their triangles are cut: radians, 0 to π.
    pub crease_angle: f32,
    /// Which of those are cut.
    pub crease_rule: CreaseRule,
    /// Upwards in local space; where nothing else is known, strokes are level.
    pub up: Vec3,
    /// How much strokes prefer to be level where the form bends nearly the same in all directions, 0 to 1: a belly gets
    /// hoops. Does not matter on flat sides, and with other sources than curvature.
    pub level: f32,
}

impl Default for FieldOptions {
    fn default() -> Self {
        Self {
            extent: 0.0,
            source: DirectionSource::Curvature,
            smoothing: 0.08,
            crease_angle: 38_f32.to_radians(),
            crease_rule: CreaseRule::default(),
            up: Vec3::Y,
            level: 0.4,
        }
    }
}

/// How far directions that were asked for reach into places that have none, in extents.
const REACH: f32 = 0.01;
/// Weights of the directions of flat sides, of those that were asked for, and of level ones where nothing else is
/// known, relative to that of a certain direction of curvature.
const PLANE_WEIGHT: f32 = 20.0;
const SOURCE_WEIGHT: f32 = 1.0;
const FALLBACK_WEIGHT: f32 = 1e-3;
/// Confidence below the first is noise; from the second on it is believed.
const NOISE: [f32; 2] = [0.02, 0.15];

/// A direction for each vertex of a mesh that is cut open at its creases.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct DirectionField {
    /// Direction of the strokes per vertex of the cut mesh: a unit vector in the plane across `normals`. The opposite
    /// one means the same.
    pub directions: Vec<Vec3>,
    /// Unit normal of the surface per vertex of the cut mesh, from its triangles alone.
    pub normals: Vec<Vec3>,
    /// The vertex of the cut mesh at each corner of the mesh's triangles; as long as [`Mesh::indices`].
    pub corner_vertices: Vec<u32>,
}

impl DirectionField {
    /// The field of a clean mesh; the same bits for the same input. `progress` is given the share that is done, 0 to 1,
    /// and says whether to go on: `None` when it did not.
    pub fn solve(
        mesh: &Mesh,
        options: &FieldOptions,
        progress: &(dyn Fn(f32) -> bool + Sync),
    ) -> Option<Self> {
        let solved = Solved::new(mesh, options, progress)?;
        let corner_vertices = solved.corner_vertices(mesh);
        Some(Self { directions: solved.directions, normals: solved.cut.normals, corner_vertices })
    }
}

/// A field, and what stripes on it need to know.
pub(crate) struct Solved {
    pub(crate) cut: CutMesh,
    pub(crate) graphs: Vec<Graph>,
    pub(crate) directions: Vec<Vec3>,
    /// Length of the unit of `cut`, in units of the mesh.
    pub(crate) extent: f64,
}

impl Solved {
    pub(crate) fn new(
        mesh: &Mesh,
        options: &FieldOptions,
        progress: &(dyn Fn(f32) -> bool + Sync),
    ) -> Option<Self> {
        let extent = extent(mesh, options);
        if !is_usable(mesh) {
            let cut = CutMesh::of_no_use(mesh.indices.len() / 3);
            let graphs = vec![Graph::new(&cut, &[])];
            return Some(Self { directions: vec![Vec3::X; cut.len()], cut, graphs, extent });
        }
        let adjacency = Adjacency::new(mesh).with_rule(options.crease_rule);
        let faces = Faces::new(mesh, &adjacency, extent);
        let crease = if options.crease_angle.is_finite() { options.crease_angle.abs() } else { 0.0 };
        let up = options.up.normalize_or(Vec3::Y);
        if !progress(0.2) {
            return None;
        }
        let planes = match options.source {
            DirectionSource::Curvature => Planes::new(&faces, crease, up),
            _ => Planes::none(mesh.triangle_count()),
        };
        let follows_form = options.source == DirectionSource::Curvature;
        let cut = CutMesh::new(&faces, |edge| {
            // A flat side has one direction, however it is made of triangles.
            let is_flat = || edge.faces.iter().any(|&face| planes.direction(face as usize).is_some());
            let turns = || follows_form && !is_flat() && cut::turns(&faces, edge);
            !edge.is_crease(crease) && planes.goes_on(&faces, edge) && !turns()
        });
        if !progress(0.4) {
            return None;
        }
        let (found, graph) = rayon::join(
            || {
                let curvatures = if follows_form { curvatures(&faces, &cut) } else { Vec::new() };
                (data(&faces, &cut, &planes, &curvatures, options, up), curvatures)
            },
            || Graph::new(&cut, &faces.areas),
        );
        let (data, curvatures) = found;
        let graphs = graph.hierarchy(64);
        if !progress(0.6) {
            return None;
        }
        let mut directions = smooth(&graphs, data, &|| progress(0.8))?;
        if follows_form {
            turn_on_narrow_strips(&faces, &cut, &curvatures, &mut directions);
        }
        if let Some(finest) = graphs.first() {
            finest.align(&mut directions);
        }
        Some(Self { cut, graphs, directions, extent })
    }

    /// The vertex of the cut mesh at each corner of the mesh.
    pub(crate) fn corner_vertices(&self, mesh: &Mesh) -> Vec<u32> {
        let mut corners = self.cut.triangles.as_flattened().to_vec();
        // The mesh may have corners that make no triangle.
        corners.resize(mesh.indices.len(), 0);
        corners
    }
}

/// What is known about the direction at each vertex.
fn data(
    faces: &Faces<'_>,
    cut: &CutMesh,
    planes: &Planes,
    curvatures: &[Curvature],
    options: &FieldOptions,
    up: Vec3,
) -> Data {
    let reach = match options.source {
        DirectionSource::Curvature if options.smoothing.is_finite() => options.smoothing.clamp(1e-4, 1.0),
        _ => REACH,
    };
    let per_area = 1.0 / (reach * reach);
    let mut data = Data::new(cut.len());
    let mut add_face = |face: usize, direction: Vec3, weight: f32| {
        for &v in &cut.triangles[face] {
            data.add(v as usize, cut.normals[v as usize], direction, weight * per_area / 3.0);
        }
    };
    match options.source {
        DirectionSource::Curvature => {
            for face in 0..cut.triangles.len() {
                if let Some(direction) = planes.direction(face) {
                    add_face(face, direction, PLANE_WEIGHT * faces.areas[face]);
                }
            }
            let [low, high] = NOISE;
            let level = if options.level.is_finite() { options.level.clamp(0.0, 1.0) } else { 0.0 };
            for (face, curvature) in curvatures.iter().enumerate() {
                let certain = curvature.confidence;
                let trust = ((certain - low) / (high - low)).clamp(0.0, 1.0);
                add_face(face, curvature.direction, trust * certain * faces.areas[face]);
                if planes.direction(face).is_none() {
                    let across = up.cross(faces.normals[face]);
                    let weight = level * (1.0 - certain).powi(2) * across.length_squared();
                    add_face(face, across, weight * faces.areas[face]);
                }
            }
        }
        DirectionSource::TextureU => {
            sources::along_texture(faces, 0, |f, d, a| add_face(f, d, SOURCE_WEIGHT * a));
        }
        DirectionSource::TextureV => {
            sources::along_texture(faces, 1, |f, d, a| add_face(f, d, SOURCE_WEIGHT * a));
        }
        DirectionSource::Axis(axis) => {
            for (v, direction) in sources::along_axis(cut, axis).enumerate() {
                let weight = SOURCE_WEIGHT * direction.length_squared() * cut.areas[v] * per_area;
                data.add(v, cut.normals[v], direction, if direction.length() > 1e-3 { weight } else { 0.0 });
            }
        }
    }
    for v in 0..cut.len() {
        let normal = cut.normals[v];
        // On what lies level no direction is level in this sense; any fixed one will do.
        let across = up.cross(normal);
        let across = if across.length() > 0.05 { across } else { up.any_orthonormal_vector() };
        data.add(v, normal, across, (FALLBACK_WEIGHT * cut.areas[v] * per_area).max(1e-30));
    }
    data
}

/// The length to which others are relative, in units of the mesh; above 0.
fn extent(mesh: &Mesh, options: &FieldOptions) -> f64 {
    let given = f64::from(options.extent);
    let diagonal = mesh.bounds().diagonal();
    [given, diagonal].into_iter().find(|e| *e > 0.0 && e.is_finite()).unwrap_or(1.0)
}

/// Whether a mesh is as importers promise: only then are its edges known.
fn is_usable(mesh: &Mesh) -> bool {
    let count = mesh.positions.len();
    mesh.indices.len().is_multiple_of(3)
        && mesh.indices.iter().all(|&v| (v as usize) < count)
        && mesh.positions.iter().all(|p| p.is_finite())
}

#[cfg(test)]
#[path = "direction_field/tests.rs"]
mod tests;
