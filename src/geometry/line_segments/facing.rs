//! Which triangles face the eye.

use glam::{DMat4, DVec3, Vec3, Vec4};
use rayon::prelude::*;

use crate::geometry::{Bounds, Lens, Mesh};

/// Triangles that one thread takes at a time; fewer are not worth a thread.
const TRIANGLES_PER_TASK: usize = 1 << 14;
/// Determinant of a placement, relative to the lengths of its axes, below which it has no use as an inverse.
const FLAT: f64 = 1e-9;
/// Error of a volume that was computed in `f32`, relative to the lengths of its factors: about 50 roundings.
const ROUNDING: f32 = 3.2e-6;
/// Sine of the angle up to which a triangle counts as seen edge-on. Less than what `f32` decides alone.
const EDGE_ON: f64 = 1e-6;

/// For each triangle whether it faces the eye. Mirrored placements change nothing.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Facings(Vec<u8>);

impl Facings {
    /// Asks all triangles of a mesh with these bounds.
    pub(super) fn new(mesh: &Mesh, bounds: &Bounds, view_from_local: &DMat4, lens: Lens) -> Self {
        match Eye::new(view_from_local, lens) {
            Eye::At(eye) => Self::quickly(mesh, bounds, eye, 1.0),
            Eye::Towards(direction) => Self::quickly(mesh, bounds, direction, 0.0),
            Eye::Nowhere => {
                let (eye, weight) = match lens {
                    Lens::Perspective { .. } => (DVec3::ZERO, 1.0),
                    Lens::Orthographic { .. } => (DVec3::Z, 0.0),
                };
                let place = |p: Vec3| view_from_local.transform_point3(p.as_dvec3());
                let ask = |t: &[u32; 3]| u8::from(faces_exactly(mesh.corners(*t).map(place), eye, weight));
                Self(mesh.triangles().iter().map(ask).collect())
            }
        }
    }

    /// Asks all triangles in `f32`, and in `f64` where rounding could have decided. `weight` is 0 for an eye that is
    /// infinitely far, in the direction `eye`.
    fn quickly(mesh: &Mesh, bounds: &Bounds, eye: DVec3, weight: f32) -> Self {
        let quick = QuickEye::new(bounds, eye, weight);
        let exactly = |triangle: &[u32; 3]| {
            faces_exactly(mesh.corners(*triangle).map(Vec3::as_dvec3), eye, f64::from(weight))
        };
        let triangles = mesh.triangles();
        let mut facings = vec![0; triangles.len()];
        let ask = |(triangles, out): (&[[u32; 3]], &mut [u8])| {
            let (fours, rest) = triangles.as_chunks();
            let (out_fours, out_rest) = out.as_chunks_mut();
            for (four, out) in fours.iter().zip(out_fours) {
                if !quick.ask(&mesh.positions, four, out) {
                    *out = four.each_ref().map(|triangle| u8::from(exactly(triangle)));
                }
            }
            for (triangle, out) in rest.iter().zip(out_rest) {
                *out = u8::from(exactly(triangle));
            }
        };
        if triangles.len() <= 2 * TRIANGLES_PER_TASK {
            ask((triangles, &mut facings));
        } else {
            let tasks = triangles.par_chunks(TRIANGLES_PER_TASK);
            tasks.zip(facings.par_chunks_mut(TRIANGLES_PER_TASK)).for_each(ask);
        }
        Self(facings)
    }

    /// The same where the first triangle of each of these pairs faces as the second one does.
    pub(super) fn with_slivers(mut self, slivers: &[[u32; 2]]) -> Self {
        for &[sliver, other] in slivers {
            let facing = self.of(other);
            if let Some(own) = self.0.get_mut(sliver as usize) {
                *own = facing;
            }
        }
        self
    }

    /// 1 if one of two triangles faces the eye and the other one does not, else 0.
    pub(super) fn differ(&self, [one, two]: [u32; 2]) -> u8 {
        self.of(one) ^ self.of(two)
    }

    /// 1 if a triangle faces the eye, else 0.
    pub(super) fn of(&self, face: u32) -> u8 {
        self.0.get(face as usize).copied().unwrap_or(0)
    }
}

/// The eye in local space.
enum Eye {
    At(DVec3),
    /// Infinitely far in this direction (of any length).
    Towards(DVec3),
    /// The placement is flat, so that the eye has no place there.
    Nowhere,
}

impl Eye {
    fn new(view_from_local: &DMat4, lens: Lens) -> Self {
        let axes = [view_from_local.x_axis, view_from_local.y_axis, view_from_local.z_axis];
        let size: f64 = axes.iter().map(|axis| axis.truncate().length()).product();
        let determinant = view_from_local.determinant().abs();
        // Not a number: flat as well.
        if !(determinant.is_normal() && determinant > FLAT * size) {
            return Self::Nowhere;
        }
        let local_from_view = view_from_local.inverse();
        match lens {
            Lens::Perspective { .. } => Self::At(local_from_view.w_axis.truncate()),
            Lens::Orthographic { .. } => Self::Towards(local_from_view.z_axis.truncate().normalize_or_zero()),
        }
    }
}

/// An eye that is asked in `f32` about four triangles at a time.
struct QuickEye {
    /// The eye in two parts, so that no digits are lost where the mesh is far from its origin.
    near: Vec3,
    rest: Vec3,
    weight: f32,
    /// Greatest error, relative to the sum of the squared lengths of two sides.
    error: f32,
}

impl QuickEye {
    fn new(bounds: &Bounds, eye: DVec3, weight: f32) -> Self {
        let near = eye.as_vec3();
        let farthest = (bounds.min - eye).abs().max((bounds.max - eye).abs()).length() as f32;
        let distance = if weight > 0.0 { farthest } else { near.length() };
        // The product of two lengths is at most half the sum of their squares.
        Self { near, rest: (eye - near.as_dvec3()).as_vec3(), weight, error: 0.5 * ROUNDING * distance }
    }

    /// Writes 1 for each triangle that faces the eye, else 0; returns whether rounding has decided none of it.
    fn ask(&self, positions: &[Vec3], triangles: &[[u32; 3]; 4], out: &mut [u8; 4]) -> bool {
        let [p, q, r, s] = triangles;
        // One coordinate of four triangles in each vector.
        let corner = |k: usize| {
            let at = |triangle: &[u32; 3]| positions[triangle[k] as usize];
            let (p, q, r, s) = (at(p), at(q), at(r), at(s));
            (Vec4::new(p.x, q.x, r.x, s.x), Vec4::new(p.y, q.y, r.y, s.y), Vec4::new(p.z, q.z, r.z, s.z))
        };
        let ((ax, ay, az), (bx, by, bz), (cx, cy, cz)) = (corner(0), corner(1), corner(2));
        let (ux, uy, uz) = (bx - ax, by - ay, bz - az);
        let (vx, vy, vz) = (cx - ax, cy - ay, cz - az);
        let to_eye =
            |near: f32, rest: f32, a: Vec4| (Vec4::splat(near) - a * self.weight) + Vec4::splat(rest);
        let volume = (uy * vz - uz * vy) * to_eye(self.near.x, self.rest.x, ax)
            + (uz * vx - ux * vz) * to_eye(self.near.y, self.rest.y, ay)
            + (ux * vy - uy * vx) * to_eye(self.near.z, self.rest.z, az);
        let size = (ux * ux + uy * uy + uz * uz) + (vx * vx + vy * vy + vz * vz);
        let facing = volume.cmpgt(Vec4::ZERO).bitmask() as u8;
        *out = [facing & 1, facing >> 1 & 1, facing >> 2 & 1, facing >> 3];
        volume.abs().cmpgt(size * self.error).all()
    }
}

/// Whether a triangle faces the eye. `weight` is 0 for an eye that is infinitely far, in the direction `eye`.
///
/// What is seen edge-on does not: in standard views of machines such faces are many, and the last digit of the camera
/// is not to decide which of their edges are outlines.
fn faces_exactly([a, b, c]: [DVec3; 3], eye: DVec3, weight: f64) -> bool {
    let (normal, to_eye) = ((b - a).cross(c - a), eye - a * weight);
    normal.dot(to_eye) > EDGE_ON * normal.length() * to_eye.length()
}
