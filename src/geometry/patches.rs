//! Flat parts of a mesh and coordinates in each: the planes to which the general field map of indication is attached (Bu et al.
//! 2006, section 3, "Indication").
//!
//! 1. Triangles that continue each other in one plane are a part.
//! 2. A part counts if it really is flat and if most of its outline is a fold or a border: not a facet of what is curved.
//! 3. A rectangle along the longest edge of the outline is put around it: 0 to 1 in both directions.

use glam::{Vec3, Vec4};

use super::disjoint_sets::DisjointSets;
use super::feature_edges::Traits;
use super::{FeatureEdges, Mesh};

/// Triangles with a smaller angle between them (radians) continue each other.
const SAME_PLANE: f32 = 0.01;
/// Cosine of the angle by which a triangle may leave the plane of its part.
const FLAT: f32 = 0.9994;
/// From this angle on (radians) an edge is a fold.
const FOLD: f32 = 0.3;

/// The flat parts of a mesh.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Patches {
    /// The part of each triangle, counted from 1; 0: none.
    pub of_triangle: Vec<u32>,
    /// Two planes each: the dot product with a place in local space (and 1) is a coordinate, 0 to 1.
    pub planes: Vec<[Vec4; 2]>,
}

/// What is gathered about a part.
#[derive(Clone, Copy, Default)]
struct FlatPart {
    /// Twice the area times the normal.
    normal: Vec3,
    /// The longest edge of the outline, and the length of all of it.
    longest: Vec3,
    outline: f32,
    /// How much of that is a fold or a border.
    folds: f32,
    is_bent: bool,
}

impl Patches {
    /// Finds them; the edges must be those of the mesh. Takes about 50 ms per million triangles.
    pub fn new(mesh: &Mesh, edges: &FeatureEdges) -> Self {
        let sets = DisjointSets::new(mesh.triangle_count());
        let is_pair = |e: usize| !edges.traits[e].any(Traits::BORDER.union(Traits::NON_MANIFOLD));
        for e in 0..edges.len() {
            if is_pair(e) && edges.dihedral[e].abs() < SAME_PLANE {
                let [a, b] = edges.faces[e];
                sets.unite(a, b);
            }
        }
        let (part_of, count) = sets.numbered();
        let mut parts = vec![FlatPart::default(); count];
        let normal_of = |t: usize| {
            let [a, b, c] = mesh.corners(mesh.triangles()[t]);
            (b - a).cross(c - a)
        };
        for (t, part) in part_of.iter().enumerate() {
            parts[*part as usize].normal += normal_of(t);
        }
        for (t, part) in part_of.iter().enumerate() {
            let part = &mut parts[*part as usize];
            let (all, own) = (part.normal.normalize_or_zero(), normal_of(t).normalize_or(part.normal));
            part.is_bent |= all.dot(own.normalize_or_zero()) < FLAT;
        }
        for e in 0..edges.len() {
            let [a, b] = edges.faces[e].map(|t| part_of[t as usize]);
            let is_pair = is_pair(e);
            if is_pair && a == b {
                continue;
            }
            let [from, to] = edges.ends[e].map(|v| mesh.positions[v as usize]);
            let is_fold = !is_pair || edges.dihedral[e].abs() > FOLD;
            parts[a as usize].add_outline(to - from, is_fold);
            if a != b {
                parts[b as usize].add_outline(to - from, is_fold);
            }
        }
        Self::mapped(mesh, part_of, &parts)
    }

    fn mapped(mesh: &Mesh, mut part_of: Vec<u32>, parts: &[FlatPart]) -> Self {
        let mut planes = Vec::new();
        let numbers: Vec<u32> = parts
            .iter()
            .map(|part| {
                let Some(directions) = part.directions() else { return 0 };
                planes.push(directions.map(|d| d.extend(0.0)));
                planes.len() as u32
            })
            .collect();
        let mut ranges = vec![[[f32::MAX, f32::MIN]; 2]; planes.len()];
        for (part, triangle) in part_of.iter_mut().zip(mesh.triangles()) {
            *part = numbers[*part as usize];
            let Some(number) = (*part as usize).checked_sub(1) else { continue };
            for (range, plane) in ranges[number].iter_mut().zip(&planes[number]) {
                for corner in mesh.corners(*triangle) {
                    let along = plane.truncate().dot(corner);
                    *range = [range[0].min(along), range[1].max(along)];
                }
            }
        }
        for (planes, ranges) in planes.iter_mut().zip(ranges) {
            for (plane, [least, most]) in planes.iter_mut().zip(ranges) {
                let size = (most - least).max(f32::MIN_POSITIVE);
                *plane = (plane.truncate() / size).extend(-least / size);
            }
        }
        Self { of_triangle: part_of, planes }
    }
}

impl FlatPart {
    fn add_outline(&mut self, edge: Vec3, is_fold: bool) {
        let length = edge.length();
        self.outline += length;
        self.folds += if is_fold { length } else { 0.0 };
        if edge.length_squared() > self.longest.length_squared() {
            self.longest = edge;
        }
    }

    /// Two directions in its plane, if it counts.
    fn directions(&self) -> Option<[Vec3; 2]> {
        let normal = self.normal.try_normalize()?;
        let along = self.longest.try_normalize()?;
        (!self.is_bent && self.folds > 0.5 * self.outline).then(|| [along, normal.cross(along)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{CreaseRule, Topology, primitives};

    fn patches(mesh: &Mesh) -> Patches {
        Patches::new(mesh, &Topology::new(mesh, 0.5, CreaseRule::default()).edges)
    }

    #[test]
    fn each_side_of_a_box_is_a_square_of_its_own() {
        let mesh = primitives::cube(3.0);
        let found = patches(&mesh);
        assert_eq!(found.planes.len(), 6);
        for (triangle, part) in mesh.triangles().iter().zip(&found.of_triangle) {
            for corner in mesh.corners(*triangle) {
                for plane in found.planes[*part as usize - 1] {
                    let at = plane.dot(corner.extend(1.0));
                    assert!(at.abs() < 1e-5 || (at - 1.0).abs() < 1e-5, "{at}");
                }
            }
        }
    }

    #[test]
    fn facets_of_what_is_curved_are_none() {
        assert!(patches(&primitives::sphere(1.0, 24, 48)).planes.is_empty());
        assert!(patches(&primitives::torus(1.0, 0.4, 48, 24)).planes.is_empty());
    }

    #[test]
    fn nothing_and_less_are_no_parts() {
        assert_eq!(patches(&Mesh::default()), Patches::default());
        let needle = Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::X * 2.0],
            indices: vec![0, 1, 2],
            ..Mesh::default()
        };
        assert!(patches(&needle).planes.is_empty());
    }
}
