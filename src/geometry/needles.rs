//! Angles at needles: triangles so narrow that a small error of their corners turns them far.
//!
//! Where vertices may lie off their places, as mended seams leave them, the angle at an edge is doubtful if both
//! triangles, turned as far as that error can, could lie in one plane. Then each side gets the normal of the nearest
//! triangles that are wide enough to be believed. Nearest is what is reached with the least turning, without crossing the
//! edge itself: so creases beside it are not crossed. Angles are only ever made smaller; errors make creases, and hardly
//! ever hide one.

use std::f32::consts::PI;

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::edge::{NO_FACE, signed_angle};
use super::{Adjacency, EdgeKind, Mesh};

/// Angles up to this (radians) are no creases anyway.
const FLAT: f32 = 0.1;
/// How far both ends of a triangle's height may lie off in opposite directions, in errors.
const ERRORS: f32 = 2.0;
/// A triangle that errors turn by less than this (radians) is believed.
const BELIEVED: f32 = 0.3;
/// Of so many triangles the normals are averaged if none of them is believed. More would lead around creases.
const MAX_TRIANGLES: usize = 8;
/// What one pass has made smaller shows the next one the way.
const PASSES: usize = 2;

/// Makes the angles smaller that only errors of the positions have made.
pub(super) fn judge_needles(mesh: &Mesh, normals: &[Vec3], adjacency: &mut Adjacency) {
    if mesh.position_errors.iter().any(|&error| error > 0.0) {
        for _ in 0..PASSES {
            pass(mesh, normals, adjacency);
        }
    }
}

/// Each triangle that errors of the positions may have turned over, with the nearest one that is believed: it faces as that does.
pub(super) fn slivers(mesh: &Mesh, normals: &[Vec3], adjacency: &Adjacency) -> Vec<[u32; 2]> {
    if mesh.position_errors.iter().all(|&error| error <= 0.0) {
        return Vec::new();
    }
    let sides = Sides { mesh, normals, adjacency };
    let believed = |face: u32| sides.nearest_believed(face).map(|believed| [face, believed]);
    let narrow = (0..mesh.triangle_count() as u32).into_par_iter().filter(|&face| sides.tilt(face) >= PI);
    narrow.filter_map(believed).collect()
}

fn pass(mesh: &Mesh, normals: &[Vec3], adjacency: &mut Adjacency) {
    let sides = Sides { mesh, normals, adjacency };
    let edges: Vec<(usize, f32)> = adjacency
        .edges
        .par_iter()
        .enumerate()
        .filter(|(_, edge)| edge.kind == EdgeKind::Manifold)
        .filter_map(|(number, edge)| {
            Some((number, sides.angle(edge.faces, edge.dihedral, edge.vertices, number)?))
        })
        .collect();
    let seams: Vec<(usize, f32)> = adjacency
        .overlaps
        .par_iter()
        .enumerate()
        .filter_map(|(number, overlap)| {
            let edge = overlap.edges[0] as usize;
            let vertices = adjacency.edges.get(edge)?.vertices;
            Some((number, sides.angle(overlap.faces, overlap.dihedral, vertices, edge)?))
        })
        .collect();
    for (number, angle) in edges {
        adjacency.edges[number].dihedral = angle;
    }
    for (number, angle) in seams {
        adjacency.overlaps[number].dihedral = angle;
    }
}

/// A triangle that can be reached.
#[derive(Clone, Copy)]
struct Reached {
    face: u32,
    /// Sum of the angles of all edges that were crossed.
    turning: f32,
    is_visited: bool,
}

struct Sides<'a> {
    mesh: &'a Mesh,
    normals: &'a [Vec3],
    adjacency: &'a Adjacency,
}

impl Sides<'_> {
    /// The angle between the sides of an edge if that of its triangles is doubtful, and larger.
    fn angle(&self, faces: [u32; 2], dihedral: f32, vertices: [u32; 2], edge: usize) -> Option<f32> {
        if dihedral.abs() <= FLAT || dihedral.abs() > faces.iter().map(|&face| self.tilt(face)).sum() {
            return None;
        }
        let [n0, n1] = faces.map(|face| self.side_normal(face, edge));
        let [a, b] = vertices.map(|v| self.mesh.positions[v as usize]);
        let angle = signed_angle(n0, n1, b - a);
        (angle.abs() < dihedral.abs()).then_some(angle)
    }

    /// The two sides of a triangle from its first corner.
    fn spans(&self, face: u32) -> [Vec3; 2] {
        let triangle = self.mesh.triangles().get(face as usize).copied().unwrap_or_default();
        let [a, b, c] = self.mesh.corners(triangle);
        [b - a, c - a]
    }

    /// Twice the area of a triangle, and its smallest height.
    fn area_and_height(&self, face: u32) -> [f32; 2] {
        let [u, v] = self.spans(face);
        let area = u.cross(v).length();
        let longest = u.length().max(v.length()).max(u.distance(v));
        [area, if longest > 0.0 { area / longest } else { 0.0 }]
    }

    /// How far errors can turn a triangle, in radians: one that is narrower than they are, in any direction.
    fn tilt(&self, face: u32) -> f32 {
        let [_, height] = self.area_and_height(face);
        let triangle = self.mesh.triangles().get(face as usize).copied().unwrap_or_default();
        let errors = triangle.map(|v| self.mesh.position_errors.get(v as usize).copied().unwrap_or(0.0));
        let error = ERRORS * errors.into_iter().fold(0.0, f32::max);
        if error < height { (error / height).asin() } else { PI }
    }

    /// The normal on a triangle's side of an edge.
    fn side_normal(&self, face: u32, edge: usize) -> Vec3 {
        let mut reached = vec![Reached { face, turning: 0.0, is_visited: false }];
        let mut sum = DVec3::ZERO;
        for _ in 0..MAX_TRIANGLES {
            let open = reached.iter_mut().filter(|r| !r.is_visited);
            let Some(next) = open.min_by(|a, b| a.turning.total_cmp(&b.turning)) else { break };
            next.is_visited = true;
            let Reached { face, turning, .. } = *next;
            let [area, height] = self.area_and_height(face);
            let [area, height] = [area, height].map(f64::from);
            sum += self.normals[face as usize].as_dvec3() * (area * height * height);
            if self.tilt(face) <= BELIEVED {
                break;
            }
            self.reach(face, turning, edge, &mut reached);
        }
        sum.try_normalize().map_or(self.normals[face as usize], |normal| normal.as_vec3())
    }

    /// The nearest triangle that is believed.
    fn nearest_believed(&self, face: u32) -> Option<u32> {
        let mut reached = vec![Reached { face, turning: 0.0, is_visited: false }];
        for _ in 0..MAX_TRIANGLES {
            let open = reached.iter_mut().filter(|r| !r.is_visited);
            let next = open.min_by(|a, b| a.turning.total_cmp(&b.turning))?;
            next.is_visited = true;
            let Reached { face, turning, .. } = *next;
            if self.tilt(face) <= BELIEVED {
                return Some(face);
            }
            self.reach(face, turning, usize::MAX, &mut reached);
        }
        None
    }

    /// Adds the neighbors of a triangle, except across `barrier`.
    fn reach(&self, face: u32, turning: f32, barrier: usize, reached: &mut Vec<Reached>) {
        let Some(&[a, b, c]) = self.mesh.triangles().get(face as usize) else { return };
        for [from, to] in [[a, b], [b, c], [c, a]] {
            let Some(number) = self.adjacency.edge_between(from, to).filter(|&number| number != barrier)
            else {
                continue;
            };
            let edge = self.adjacency.edges[number];
            let other = if edge.faces[0] == face { edge.faces[1] } else { edge.faces[0] };
            if edge.kind != EdgeKind::Manifold || other == NO_FACE {
                continue;
            }
            let turning = turning + edge.dihedral.abs();
            match reached.iter_mut().find(|r| r.face == other) {
                Some(known) => known.turning = known.turning.min(turning),
                None => reached.push(Reached { face: other, turning, is_visited: false }),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::primitives::from_triangles;

    const CREASE: f32 = 0.4;

    fn with_error(mesh: Mesh, error: f32) -> Mesh {
        Mesh { position_errors: vec![error; mesh.positions.len()], ..mesh }
    }

    /// Two walls at an angle that meet along y = 0, with a row of vertices close to the edge on either side and some of
    /// them off their places.
    fn walls(angle: f32, error: f32) -> Mesh {
        let columns = 24_u32;
        let (sin, cos) = angle.sin_cos();
        let mut positions = Vec::new();
        for (row, distance) in [-1.0, -2.0 * error, 0.0, 2.0 * error, 1.0].into_iter().enumerate() {
            for column in 0..=columns {
                let x = column as f32 / columns as f32;
                let off = if row == 2 && column % 2 == 1 { error } else { 0.0 };
                let [along, up] = if distance > 0.0 { [cos, sin] } else { [1.0, 0.0] };
                positions.push(Vec3::new(x, distance * along, distance * up + off));
            }
        }
        let quads = (0..4).flat_map(|row| (0..columns).map(move |column| row * (columns + 1) + column));
        let triangles = quads.flat_map(|a| {
            let b = a + columns + 1;
            [a, a + 1, b, b, a + 1, b + 1]
        });
        let mesh = from_triangles(positions, triangles.collect());
        with_error(mesh, error)
    }

    /// The length of the creases, in units of the mesh.
    fn creases(mesh: &Mesh) -> f32 {
        let adjacency = Adjacency::new(mesh);
        let creases = adjacency.edges.iter().filter(|edge| edge.is_crease(CREASE));
        creases
            .map(|edge| edge.vertices.map(|v| mesh.positions[v as usize]))
            .map(|[a, b]| a.distance(b))
            .sum()
    }

    #[test]
    fn what_errors_can_turn_over_faces_as_what_is_wide_beside_it() {
        let mesh = walls(0.5, 0.004);
        let slivers = Adjacency::new(&mesh).slivers;
        // Of the 96 in the two narrow rows.
        assert!(slivers.len() > 48, "{}", slivers.len());
        let middle = |face: u32| {
            let [a, b, c] = mesh.corners(mesh.triangles()[face as usize]);
            (a + b + c) / 3.0
        };
        for [sliver, other] in slivers {
            let [sliver, other] = [sliver, other].map(middle);
            assert!(sliver.y.abs() < 0.02 && other.y.abs() > 0.2, "{sliver} faces as {other}");
        }
        assert!(Adjacency::new(&with_error(mesh, 0.0)).slivers.is_empty());
    }

    #[test]
    fn errors_make_few_creases_and_hide_none() {
        for error in [1e-5, 1e-3] {
            let flat = walls(0.0, error);
            let believed = creases(&with_error(flat.clone(), 0.0));
            assert!(believed > 0.5 && creases(&flat) < 0.25 * believed, "{error}: {believed}");
            for angle in [1.3, -1.3] {
                let length = creases(&walls(angle, error));
                assert!((length - 1.0).abs() < 0.05, "{error} {angle}: {length}");
            }
        }
    }

    #[test]
    fn what_is_wide_keeps_its_angle_and_odd_errors_do_no_harm() {
        let cube = crate::geometry::primitives::cube(1.0);
        for error in [0.01, f32::NAN, -1.0] {
            let mesh = with_error(cube.clone(), error);
            assert_eq!(Adjacency::new(&mesh).edges, Adjacency::new(&cube).edges);
        }
        for error in [1e30, f32::INFINITY] {
            let found = Adjacency::new(&with_error(cube.clone(), error));
            assert!(found.edges.iter().all(|edge| edge.dihedral.is_finite()));
        }
    }
}
