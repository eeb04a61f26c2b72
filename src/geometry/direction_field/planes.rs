//! Flat sides of a model, as opposed to the facets of something round, and the direction of strokes on them.

use glam::{Vec2, Vec3};
use rayon::prelude::*;

use super::cut::{Faces, transport};
use crate::geometry::disjoint_sets::DisjointSets;
use crate::geometry::{Edge, EdgeKind};

/// Triangles are parts of one side if the angle between them is at most this, in radians.
const FLAT: f32 = 0.052;
/// Edges above this angle, in radians, are creases; less steep ones only beside large sides.
const CREASE: f32 = 0.26;
/// A side is at least this many times as wide as what continues it across an edge that is not cut. Facets of something
/// round are about equally wide.
const WIDER: f32 = 2.5;
/// A side is large from this share of the area of all triangles on.
const LARGE: f32 = 0.003;
/// Below this share one that is not mostly surrounded by cuts is just a few triangles.
const SMALL: f32 = 3e-4;
/// Stands for "part of no side".
const NONE: u32 = u32::MAX;

/// The flat sides of a mesh.
pub(crate) struct Planes {
    /// The side of each triangle, as an index into `directions`, or [`u32::MAX`].
    of_face: Vec<u32>,
    /// Direction of the strokes on each side, unit length.
    directions: Vec<Vec3>,
}

/// Triangles that are connected without an angle between them.
#[derive(Clone, Default)]
struct Region {
    area: f32,
    /// Sum of the normals times areas, then a unit vector.
    normal: Vec3,
    /// Whether it lies in one plane.
    is_even: bool,
    /// Sum of `length * e^(4 i angle)` over the outline, in the frame of the normal.
    star: Vec2,
    /// Along most of the outline, and across that.
    axes: [Vec3; 2],
    /// Size along either axis.
    extent: Vec2,
    /// Length of its outline; how much of that is a cut, and how much a cut or a crease.
    outline: f32,
    cut: f32,
    crease: f32,
    /// Length of the outline that goes on smoothly, to be crossed along either axis.
    smooth: [f32; 2],
}

impl Region {
    /// Chooses the axes: of a disc, level and upright.
    fn choose_axes(&mut self, up: Vec3) {
        let (x, y) = self.normal.any_orthonormal_pair();
        let first = if self.star.length() < 0.1 * self.outline {
            up.cross(self.normal).try_normalize().unwrap_or(x)
        } else {
            let (sin, cos) = (0.25 * self.star.to_angle()).sin_cos();
            x * cos + y * sin
        };
        self.axes = [first, self.normal.cross(first)];
    }

    /// How far it reaches away from an edge of this length and unit direction.
    fn width(&self, along: Vec3, length: f32) -> f32 {
        if !self.is_even {
            return self.area / length;
        }
        let across = along.cross(self.normal);
        self.axes[0].dot(across).abs() * self.extent.x + self.axes[1].dot(across).abs() * self.extent.y
    }

    /// Whether it is a side of the model. Irregular triangles are wider than some of their neighbors by chance, but not
    /// than all.
    fn is_side(&self, total_area: f32) -> bool {
        let share = self.area / total_area;
        let needed = if share > LARGE { 0.6 } else { 0.9 };
        let is_set_off = share > SMALL && self.crease > needed * self.outline;
        self.is_even && (self.cut > 0.6 * self.outline || is_set_off)
    }

    /// The axis that crosses the edges behind which the surface goes on, if those are all across one axis; else the one
    /// along which the side is longer.
    fn direction(&self) -> Vec3 {
        let [first, second] = self.smooth;
        let enough = 0.2 * self.outline;
        if first > enough && second < 0.1 * first {
            self.axes[0]
        } else if second > enough && first < 0.1 * second {
            self.axes[1]
        } else {
            self.axes[usize::from(self.extent.y > self.extent.x)]
        }
    }
}

impl Planes {
    /// No sides at all.
    pub(crate) fn none(face_count: usize) -> Self {
        Self { of_face: vec![NONE; face_count], directions: Vec::new() }
    }

    /// Finds them. Edges above `cut` (radians) are cut anyway.
    pub(crate) fn new(faces: &Faces<'_>, cut: f32, up: Vec3) -> Self {
        let sets = DisjointSets::new(faces.areas.len());
        let edges = &faces.adjacency.edges;
        let joins = |edge: &Edge| edge.kind == EdgeKind::Manifold && edge.dihedral.abs() <= FLAT;
        edges
            .par_iter()
            .with_min_len(4096)
            .filter(|e| joins(e))
            .for_each(|e| sets.unite(e.faces[0], e.faces[1]));
        let (region_of, count) = sets.numbered();
        // The regions on both sides of an edge that does not lie inside of one.
        let sides = |edge: &Edge| {
            let [first, second] = edge.faces.map(|face| region_of.get(face as usize).map(|&r| r as usize));
            if first == second { [None, None] } else { [first, second] }
        };

        let mut regions = vec![Region::default(); count];
        for (face, &region) in region_of.iter().enumerate() {
            let region = &mut regions[region as usize];
            region.area += faces.areas[face];
            region.normal += faces.normals[face] * faces.areas[face];
        }
        let total: f32 = regions.iter().map(|r| r.area).sum();
        for region in &mut regions {
            region.is_even = region.area > 1e-5 * total && region.normal.length() > 0.999_5 * region.area;
            region.normal = region.normal.normalize_or(Vec3::Z);
        }
        for edge in edges {
            let along = faces.along(edge);
            let length = along.length();
            for region in sides(edge).into_iter().flatten() {
                let region = &mut regions[region];
                let (x, y) = region.normal.any_orthonormal_pair();
                let once = Vec2::new(along.dot(x), along.dot(y)).normalize_or_zero();
                let twice = once.rotate(once);
                region.star += twice.rotate(twice) * length;
                region.outline += length;
            }
        }
        measure(&mut regions, &region_of, faces, up);

        for edge in edges {
            let vector = faces.along(edge);
            let length = vector.length();
            let Some(along) = vector.try_normalize() else {
                continue;
            };
            let goes_on = edge.kind == EdgeKind::Manifold && !edge.is_crease(cut);
            let [first, second] = sides(edge);
            for (region, other) in [(first, second), (second, first)] {
                let Some(region) = region else {
                    continue;
                };
                let other_width = other.filter(|_| goes_on).map(|other| regions[other].width(along, length));
                let region = &mut regions[region];
                let Some(other_width) = other_width else {
                    region.cut += length;
                    region.crease += length;
                    continue;
                };
                let is_steep = edge.dihedral.abs() > CREASE || region.area > LARGE * total;
                if is_steep && region.width(along, length) > WIDER * other_width {
                    region.crease += length;
                }
                let [first, second] = region.axes.map(|axis| along.dot(axis).abs());
                region.smooth[usize::from(first > second)] += length;
            }
        }

        let mut directions = Vec::new();
        let number = |region: &Region| {
            if !region.is_side(total) {
                return NONE;
            }
            directions.push(region.direction());
            directions.len() as u32 - 1
        };
        let numbers: Vec<u32> = regions.iter().map(number).collect();
        Self { of_face: region_of.iter().map(|&r| numbers[r as usize]).collect(), directions }
    }

    /// The direction of the strokes on the side to which a triangle belongs.
    pub(crate) fn direction(&self, face: usize) -> Option<Vec3> {
        self.directions.get(self.of_face[face] as usize).copied()
    }

    /// Whether strokes of a flat side may run on across one of its edges: they do where they cross it, into what is
    /// round, or where those of another side continue them.
    pub(crate) fn goes_on(&self, faces: &Faces<'_>, edge: &Edge) -> bool {
        let [a, b] = edge.faces.map(|f| f as usize);
        let along = faces.along(edge).normalize_or_zero();
        let crosses = |direction: Vec3| along.dot(direction).abs() < 0.5;
        match (self.direction(a), self.direction(b)) {
            (None, None) => true,
            (Some(direction), None) | (None, Some(direction)) => crosses(direction),
            (Some(first), Some(second)) => {
                let turned = transport(first, faces.normals[a], faces.normals[b]);
                turned.dot(second).abs() > 0.9
            }
        }
    }
}

/// Finds the axes of the regions that lie in one plane, and their sizes along them.
fn measure(regions: &mut [Region], region_of: &[u32], faces: &Faces<'_>, up: Vec3) {
    let mut least = vec![Vec2::INFINITY; regions.len()];
    let mut most = vec![Vec2::NEG_INFINITY; regions.len()];
    for region in regions.iter_mut() {
        region.choose_axes(up);
    }
    for (face, &region) in region_of.iter().enumerate() {
        let region = region as usize;
        let [first, second] = regions[region].axes;
        for p in faces.corners(face) {
            let p = Vec2::new(p.dot(first), p.dot(second));
            (least[region], most[region]) = (least[region].min(p), most[region].max(p));
        }
    }
    for (region, (least, most)) in regions.iter_mut().zip(least.iter().zip(most)) {
        region.extent = most - least;
    }
}
