//! A mesh cut open at its creases, and where strips of long triangles turn: the vertices on which directions and stripes live.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use crate::geometry::Adjacency;
use crate::geometry::disjoint_sets::DisjointSets;
use crate::geometry::edge::NO_FACE;
use crate::geometry::normals::face_normals;
use crate::geometry::{Edge, EdgeKind, Mesh};

/// A mesh in units of the extent, with what is known of its triangles.
pub(crate) struct Faces<'a> {
    /// The mesh as it was given.
    pub(crate) mesh: &'a Mesh,
    /// Its edges.
    pub(crate) adjacency: &'a Adjacency,
    /// Position of each vertex relative to the middle of the mesh, 1 = the extent.
    pub(crate) positions: Vec<Vec3>,
    /// Unit normal of each triangle.
    pub(crate) normals: Vec<Vec3>,
    /// Area of each triangle; 0 for those that welding made a line.
    pub(crate) areas: Vec<f32>,
}

impl<'a> Faces<'a> {
    /// Of a clean mesh whose extent is `extent`, in units of the mesh.
    pub(crate) fn new(mesh: &'a Mesh, adjacency: &'a Adjacency, extent: f64) -> Self {
        let center = mesh.bounds().center();
        let scaled = |p: &Vec3| ((p.as_dvec3() - center) / extent).as_vec3();
        let positions: Vec<Vec3> = mesh.positions.par_iter().with_min_len(4096).map(scaled).collect();
        let area = |&[a, b, c]: &[u32; 3]| {
            let [a, b, c]: [DVec3; 3] = [a, b, c].map(|v| positions[v as usize].as_dvec3());
            (0.5 * (b - a).cross(c - a).length()) as f32
        };
        let mut areas: Vec<f32> = mesh.triangles().par_iter().with_min_len(4096).map(area).collect();
        for &(face, _) in &adjacency.collapsed {
            areas[face as usize] = 0.0;
        }
        Self { mesh, adjacency, positions, normals: face_normals(mesh), areas }
    }

    /// Where a vertex is: the position of the point to which it is welded.
    pub(crate) fn point(&self, vertex: u32) -> Vec3 {
        self.positions[self.adjacency.weld.representative[vertex as usize] as usize]
    }

    /// The three corners' points of a triangle.
    pub(crate) fn corners(&self, face: usize) -> [Vec3; 3] {
        self.mesh.triangles()[face].map(|v| self.point(v))
    }

    /// The vector along an edge, in units of the extent.
    pub(crate) fn along(&self, edge: &Edge) -> Vec3 {
        self.point(edge.vertices[1]) - self.point(edge.vertices[0])
    }
}

/// A triangle is part of a strip if it is at least so many times as long as the edge at its end.
const LONG: f32 = 8.0;
/// Cosine of the angle from which on a strip turns.
const STRAIGHT: f32 = 0.9;

/// Whether a strip of long triangles turns at an edge between two, as a molding does at the corner of a frame: directions
/// are known at the ends of a triangle only, and one for both legs would be right for neither.
pub(crate) fn turns(faces: &Faces<'_>, edge: &Edge) -> bool {
    let along = faces.along(edge);
    let middle = faces.point(edge.vertices[0]) + 0.5 * along;
    let to_end = |face: u32| {
        let ways = faces.corners(face as usize).map(|corner| corner - middle);
        ways.into_iter().max_by(|a, b| a.length_squared().total_cmp(&b.length_squared())).unwrap_or_default()
    };
    let legs = edge.faces.map(to_end);
    if legs.iter().any(|leg| leg.length() <= LONG * along.length()) {
        return false;
    }
    let [n0, n1] = edge.faces.map(|face| faces.normals[face as usize]);
    let [first, second] = legs.map(Vec3::normalize_or_zero);
    -transport(first, n0, n1).dot(second) < STRAIGHT
}

/// Vertices of which each is all corners of triangles around a point that are connected without crossing a cut.
pub(crate) struct CutMesh {
    /// The three vertices of each triangle of the mesh.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Position, 1 = the extent.
    pub(crate) positions: Vec<Vec3>,
    /// Unit normal of the surface, from the triangles and their angles alone.
    pub(crate) normals: Vec<Vec3>,
    /// A third of the area of the triangles around it.
    pub(crate) areas: Vec<f32>,
}

impl CutMesh {
    /// Connects triangles across the edges for which `is_open` is true; it is asked for edges between two triangles
    /// that agree about inside and outside, all others are cuts.
    pub(crate) fn new(faces: &Faces<'_>, is_open: impl Fn(&Edge) -> bool + Sync) -> Self {
        let mesh = faces.mesh;
        let point = |corner: u32| faces.adjacency.weld.representative[mesh.indices[corner as usize] as usize];
        let sets = DisjointSets::new(mesh.triangles().len() * 3);
        faces.adjacency.edges.par_iter().with_min_len(4096).for_each(|edge| {
            if edge.kind != EdgeKind::Manifold || edge.faces[1] == NO_FACE || !is_open(edge) {
                return;
            }
            for end in edge.vertices {
                let end = faces.adjacency.weld.representative[end as usize];
                let corner_at_end = |face: u32| (3 * face..3 * face + 3).find(|&c| point(c) == end);
                if let (Some(a), Some(b)) = (corner_at_end(edge.faces[0]), corner_at_end(edge.faces[1])) {
                    sets.unite(a, b);
                }
            }
        });
        let (of_corner, count) = sets.numbered();
        let mut cut = Self {
            triangles: of_corner.as_chunks().0.to_vec(),
            positions: vec![Vec3::ZERO; count],
            normals: vec![Vec3::ZERO; count],
            areas: vec![0.0; count],
        };
        for (face, triangle) in cut.triangles.iter().enumerate() {
            let corners = faces.corners(face);
            let normal = faces.normals[face];
            for k in 0..3 {
                let v = triangle[k] as usize;
                cut.positions[v] = corners[k];
                cut.areas[v] += faces.areas[face] / 3.0;
                let angle =
                    (corners[(k + 1) % 3] - corners[k]).angle_between(corners[(k + 2) % 3] - corners[k]);
                // The first triangle counts even if it has no angle, so that every vertex has a normal.
                cut.normals[v] += normal * if angle.is_finite() { angle.max(1e-6) } else { 1e-6 };
            }
        }
        for normal in &mut cut.normals {
            *normal = normal.normalize_or(Vec3::Z);
        }
        cut
    }

    /// One vertex at all corners of this many triangles, for meshes that are not clean.
    pub(crate) fn of_no_use(triangle_count: usize) -> Self {
        Self {
            triangles: vec![[0; 3]; triangle_count],
            positions: vec![Vec3::ZERO],
            normals: vec![Vec3::Z],
            areas: vec![0.0],
        }
    }

    /// Number of vertices.
    pub(crate) fn len(&self) -> usize {
        self.positions.len()
    }
}

/// A vector of the plane across `from`, turned with the least rotation that takes the unit vector `from` to `to`.
pub(crate) fn transport(v: Vec3, from: Vec3, to: Vec3) -> Vec3 {
    v - (from + to) * (v.dot(to) / (1.0 + from.dot(to)).max(1e-3))
}
