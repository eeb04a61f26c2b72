//! Flat sides of a model, as opposed to the facets of something round, and the direction of strokes on them.

use glam::{Vec2, Vec3};

use super::cut::Faces;
use crate::geometry::disjoint_sets::DisjointSets;
use crate::geometry::{Edge, EdgeKind};

/// Triangles are parts of one side if the angle between them is at most this, in radians.
const FLAT: f32 = 0.052;
/// Edges above this angle, in radians, are creases; less steep ones only beside large sides.
const CREASE: f32 = 0.26;
/// A side is at least this many times as wide as what continues it across an edge that is not cut. Facets of something
/// round are about equally wide.
const WIDER: f32 = 2.5;
/// Stands for "part of no side".
const NONE: u32 = u32::MAX;

/// The flat sides of a mesh.
pub(crate) struct Planes {
    /// The side of each triangle, as an index into `directions`, or [`u32::MAX`].
    of_face: Vec<u32>,
    /// Direction of the strokes on each side, unit length.
    directions: Vec<Vec3>,
}

/// What is gathered about a region of triangles.
#[derive(Clone, Default)]
struct Region {
    area: f32,
    normal: Vec3,
    /// Length of its outline.
    outline: f32,
    /// How much of that is a crease.
    crease: f32,
    /// Sum of `length * e^(4 i angle)` over the outline, in the frame of the normal.
    star: Vec2,
    /// Length of the outline that goes on smoothly, across either axis.
    smooth: [f32; 2],
    /// Least and largest coordinate along either axis.
    least: Vec2,
    most: Vec2,
}

impl Region {
    /// Its two axes, along most of its outline; of a disc, level and upright.
    fn axes(&self, up: Vec3) -> [Vec3; 2] {
        let (x, y) = self.normal.any_orthonormal_pair();
        if self.star.length() < 0.1 * self.outline {
            let level = up.cross(self.normal).try_normalize().unwrap_or(x);
            return [level, self.normal.cross(level)];
        }
        let (sin, cos) = (0.25 * self.star.to_angle()).sin_cos();
        let first = x * cos + y * sin;
        [first, self.normal.cross(first)]
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
        let joins = |edge: &Edge| edge.kind == EdgeKind::Manifold && edge.dihedral.abs() <= FLAT;
        faces.adjacency.edges.iter().filter(|e| joins(e)).for_each(|e| sets.unite(e.faces[0], e.faces[1]));
        let (region_of, count) = sets.numbered();

        let mut regions = vec![Region::default(); count];
        for (face, &region) in region_of.iter().enumerate() {
            let region = &mut regions[region as usize];
            region.area += faces.areas[face];
            region.normal += faces.normals[face] * faces.areas[face];
        }
        let total: f32 = regions.iter().map(|r| r.area).sum();
        let is_even: Vec<bool> =
            regions.iter().map(|r| r.area > 1e-5 * total && r.normal.length() > 0.999_5 * r.area).collect();
        for region in &mut regions {
            region.normal = region.normal.normalize_or(Vec3::Z);
        }

        // The outlines, seen from either side.
        let areas: Vec<f32> = regions.iter().map(|r| r.area).collect();
        let outlines = |visit: &mut dyn FnMut(usize, Vec3, Option<(f32, f32)>)| {
            for edge in &faces.adjacency.edges {
                let along = faces.along(edge);
                let length = along.length();
                let goes_on = edge.kind == EdgeKind::Manifold && edge.dihedral.abs() <= cut;
                for (side, &face) in edge.faces.iter().enumerate() {
                    let Some(&region) = region_of.get(face as usize) else {
                        continue;
                    };
                    let other = region_of.get(edge.faces[1 - side] as usize);
                    if !is_even[region as usize] || length <= 0.0 || other == Some(&region) {
                        continue;
                    }
                    let other_width = other.filter(|_| goes_on).map(|&o| areas[o as usize] / length);
                    visit(region as usize, along, other_width.map(|width| (width, edge.dihedral.abs())));
                }
            }
        };
        outlines(&mut |region, along, smooth| {
            let region = &mut regions[region];
            let length = along.length();
            let is_large = region.area > 0.003 * total;
            let is_crease = smooth.is_none_or(|(width, angle)| {
                region.area / length > WIDER * width && (angle > CREASE || is_large)
            });
            region.outline += length;
            region.crease += if is_crease { length } else { 0.0 };
            let (x, y) = region.normal.any_orthonormal_pair();
            let angle = 4.0 * along.dot(y).atan2(along.dot(x));
            region.star += Vec2::from_angle(angle) * length;
        });
        let is_side: Vec<bool> =
            regions.iter().zip(&is_even).map(|(r, even)| *even && r.crease > 0.6 * r.outline).collect();

        let axes: Vec<[Vec3; 2]> = regions.iter().map(|r| r.axes(up)).collect();
        for region in &mut regions {
            (region.least, region.most) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
        }
        outlines(&mut |region, along, smooth| {
            if smooth.is_some() {
                // An edge along one axis is to be crossed along the other.
                let [first, second] = axes[region].map(|axis| along.dot(axis).abs());
                regions[region].smooth[usize::from(first > second)] += along.length();
            }
        });
        for (face, &region) in region_of.iter().enumerate() {
            if !is_side[region as usize] {
                continue;
            }
            let [first, second] = axes[region as usize];
            let region = &mut regions[region as usize];
            for p in faces.corners(face) {
                let p = Vec2::new(p.dot(first), p.dot(second));
                (region.least, region.most) = (region.least.min(p), region.most.max(p));
            }
        }

        let mut numbers = vec![NONE; count];
        let mut directions = Vec::new();
        for (region, (r, axes)) in regions.iter().zip(&axes).enumerate() {
            if !is_side[region] {
                continue;
            }
            numbers[region] = directions.len() as u32;
            directions.push(axes[preferred_axis(r)]);
        }
        Self { of_face: region_of.into_iter().map(|r| numbers[r as usize]).collect(), directions }
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
                let turned = super::cut::transport(first, faces.normals[a], faces.normals[b]);
                turned.dot(second).abs() > 0.9
            }
        }
    }
}

/// The axis that crosses the edges behind which the surface goes on, if those are all across one axis; else the one
/// along which the side is longer.
fn preferred_axis(region: &Region) -> usize {
    let [across_first, across_second] = region.smooth;
    let extent = region.most - region.least;
    let enough = 0.2 * region.outline;
    if across_first > enough && across_second < 0.1 * across_first {
        0
    } else if across_second > enough && across_first < 0.1 * across_second {
        1
    } else {
        usize::from(extent.y > extent.x)
    }
}
