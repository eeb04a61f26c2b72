//! Strips that are too narrow for strokes across them, as moldings are: their strokes run lengthwise.

use std::f32::consts::FRAC_2_PI;
use std::ops::Range;

use glam::Vec3;

use super::curvature::Curvature;
use super::cut::{CutMesh, Faces, transport};
use crate::geometry::Edge;
use crate::geometry::disjoint_sets::DisjointSets;

/// Mean length of strokes across a strip, in extents. On what is narrower a line that runs lengthwise would be there or not by chance,
/// whatever the tone.
const SHORT: Range<f32> = 0.008..0.03;
/// Strokes along it are at least so many times as long.
const LONGER: f32 = 4.0;
/// Least share of the ends of strokes that lie on its borders. What is closed, as a pole, has none along its sides: the lines around it
/// would have to be a whole number at every density.
const BORDERED: f32 = 0.25;

/// Triangles of the cut mesh that are connected.
#[derive(Clone, Copy, Default)]
struct Part {
    area: f32,
    /// Across what length strokes end: of those in the directions of the field, and of those across them.
    ends: [f32; 2],
    /// Of those in the directions of the field, at borders.
    border_ends: f32,
}

impl Part {
    /// Whether strokes across the directions of the field would be so much longer that they should be drawn instead.
    fn is_narrow_strip(&self) -> bool {
        // Each stroke has two ends.
        let [along, across] = self.ends.map(|ends| 2.0 * self.area / ends);
        SHORT.contains(&along) && across > LONGER * along && self.border_ends > BORDERED * self.ends[0]
    }
}

/// Turns the directions of vertices by a right angle on narrow strips.
pub(crate) fn turn_on_narrow_strips(
    faces: &Faces<'_>,
    cut: &CutMesh,
    curvatures: &[Curvature],
    directions: &mut [Vec3],
) {
    let sets = DisjointSets::new(cut.len());
    for &[a, b, c] in &cut.triangles {
        sets.unite(a, b);
        sets.unite(b, c);
    }
    let (part_of, count) = sets.numbered();
    let mut parts = vec![Part::default(); count];
    for (face, curvature) in curvatures.iter().enumerate() {
        let part = &mut parts[part_of[cut.triangles[face][0] as usize] as usize];
        let area = faces.areas[face];
        part.area += area;
        let [along, across] = curvature.bends;
        for v in cut.triangles[face].map(|v| v as usize) {
            let direction = transport(directions[v], cut.normals[v], faces.normals[face]);
            let share = curvature.direction.dot(direction).powi(2).min(1.0);
            // Of what bends around half is hidden: a stroke is seen over half a turn.
            let ends = |bend: f32| FRAC_2_PI * bend * area / 3.0;
            part.ends[0] += ends(along * share + across * (1.0 - share));
            part.ends[1] += ends(across * share + along * (1.0 - share));
        }
    }
    for edge in &faces.adjacency.edges {
        let corners = edge.faces.map(|face| corners_of(faces, cut, edge, face));
        if corners[0] == corners[1] {
            continue;
        }
        let along = faces.along(edge);
        for v in corners.into_iter().flatten().flatten().map(|v| v as usize) {
            let part = &mut parts[part_of[v] as usize];
            let ends = 0.5 * along.cross(directions[v]).length();
            part.ends[0] += ends;
            part.border_ends += ends;
            part.ends[1] += 0.5 * along.dot(directions[v]).abs();
        }
    }
    for (v, direction) in directions.iter_mut().enumerate() {
        if parts[part_of[v] as usize].is_narrow_strip() {
            *direction = cut.normals[v].cross(*direction);
        }
    }
}

/// The vertices of the cut mesh at both ends of an edge, in one of its triangles; `None` if there is no such triangle.
fn corners_of(faces: &Faces<'_>, cut: &CutMesh, edge: &Edge, face: u32) -> Option<[u32; 2]> {
    let triangle = faces.mesh.triangles().get(face as usize)?;
    let at = |v: u32| faces.adjacency.weld.representative[v as usize];
    let corner = |end: u32| triangle.iter().position(|&v| at(v) == at(end));
    let [a, b] = edge.vertices.map(corner);
    Some([cut.triangles[face as usize][a?], cut.triangles[face as usize][b?]])
}
