//! A round tube along a polyline, with arrow heads.

use std::f64::consts::{PI, TAU};

use glam::{DQuat, DVec3, Vec3};

use super::Mesh;
use super::primitives::from_triangles;

/// Sides of the tube: at a width of 40 px its outline is within 0.2 px of a circle.
const SIDES: usize = 24;

/// Radius and length of a head, in radii of the tube.
const HEAD_RADIUS: f64 = 2.6;
const HEAD_LENGTH: f64 = 7.0;

/// Greatest radius of a rounded corner, in radii of the tube.
const CORNER_RADIUS: f64 = 4.0;

/// Most that the direction turns from ring to ring in a corner, radians.
const TURN: f64 = 0.2;

/// Of a segment a head takes at most this share.
const HEAD_SHARE: f64 = 0.8;

/// Segments this many heads long have one in their middle, where that is asked for.
const MIDDLE_FROM: f64 = 3.0;

/// Where arrow heads are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Heads {
    /// At the first point, pointing back.
    pub at_start: bool,
    /// At the last point.
    pub at_end: bool,
    /// In the middle of each long segment too, pointing forward.
    pub along: bool,
}

/// A cross-section of the tube: a circle.
#[derive(Debug, Clone, Copy)]
struct Ring {
    center: DVec3,
    /// Unit vector along the tube.
    forward: DVec3,
    radius: f64,
}

/// A closed mesh along `points` (at least two different neighbors, finite; equal neighbors count once), smooth in its
/// corners, with sharp heads whose tips are the first and the last point. `radius`: that of the tube, above 0. Empty if there
/// is nothing to be drawn.
pub fn arrow(points: &[DVec3], radius: f64, heads: Heads) -> Mesh {
    let mut points = points.to_vec();
    points.dedup_by(|a, b| a.distance(*b) <= 1e-3 * radius);
    if points.len() < 2 {
        return Mesh::default();
    }
    let rings = rings(&points, radius, heads);
    // About the origin of the caller, in single precision.
    let mut skin = Skin::default();
    let mut side = rings.first().map_or(DVec3::X, |r| r.forward.any_orthonormal_vector());
    for pair in rings.windows(2) {
        let [a, b] = pair else { continue };
        let turned = DQuat::from_rotation_arc(a.forward, b.forward) * side;
        let next = (turned - b.forward * turned.dot(b.forward)).normalize_or(turned);
        skin.band(a, side, b, next);
        side = next;
    }
    skin.finish()
}

/// A straight part of a path.
#[derive(Clone, Copy)]
struct Segment {
    from: DVec3,
    to: DVec3,
    /// Unit vector along it.
    forward: DVec3,
    length: f64,
}

impl Segment {
    fn new(from: DVec3, to: DVec3) -> Self {
        Self { from, to, forward: (to - from).normalize_or(DVec3::X), length: from.distance(to) }
    }
}

fn rings(points: &[DVec3], radius: f64, heads: Heads) -> Vec<Ring> {
    let mut rings = Vec::new();
    let segments: Vec<Segment> = points.windows(2).map(|pair| Segment::new(pair[0], pair[1])).collect();
    let last = segments.len() - 1;
    // What corners and heads at its ends leave of each segment.
    let head = |length: f64| (radius * HEAD_LENGTH).min(length * HEAD_SHARE);
    let mut at_start = 0.0;
    for (i, &Segment { from, to, forward, length }) in segments.iter().enumerate() {
        let ring = |along: f64, radius: f64| Ring { center: from + forward * along, forward, radius };
        let head_radius = |head: f64| (head * HEAD_RADIUS / HEAD_LENGTH).max(radius * 1.3);
        if i == 0 {
            rings.push(Ring { center: from, forward, radius: 0.0 });
            if heads.at_start {
                let shares = if heads.at_end && last == 0 { 0.5 } else { 1.0 };
                at_start = head(length * shares);
                rings.push(ring(at_start, head_radius(at_start)));
                rings.push(ring(at_start, radius));
            } else {
                rings.push(ring(0.0, radius));
            }
        }
        let shares = if heads.at_start && last == 0 { 0.5 } else { 1.0 };
        let at_end = if i == last && heads.at_end { head(length * shares) } else { 0.0 };
        let next = segments.get(i + 1);
        let corner = next.map(|next| {
            let angle = forward.angle_between(next.forward);
            // A head needs its straight end.
            let room = |length: f64, reserved: f64| ((length - reserved) * 0.5).max(0.0);
            let reserved = if i + 1 == last && heads.at_end { head(next.length) } else { 0.0 };
            let most = room(length, at_start).min(room(next.length, reserved));
            let is_back = angle > PI - 0.05;
            let trimmed =
                if is_back { 0.0 } else { (radius * CORNER_RADIUS * (angle * 0.5).tan()).min(most) };
            Corner { at: to, before: forward, after: next.forward, angle, trimmed }
        });
        let trimmed = corner.as_ref().map_or(0.0, |corner| corner.trimmed);
        let (begin, end) = (at_start, length - at_end - trimmed);
        let own = radius * HEAD_LENGTH;
        if heads.along && end - begin > own * MIDDLE_FROM {
            let middle = (begin + end - own) * 0.5;
            rings.extend([
                ring(middle, radius),
                ring(middle, head_radius(own)),
                ring(middle + own * (1.0 - 1.0 / HEAD_RADIUS), radius),
            ]);
        }
        match corner {
            Some(corner) => corner.rings(radius, &mut rings),
            None if at_end > 0.0 => {
                rings.push(ring(length - at_end, radius));
                rings.push(ring(length - at_end, head_radius(at_end)));
                rings.push(Ring { center: to, forward, radius: 0.0 });
            }
            None => {
                rings.push(Ring { center: to, forward, radius });
                rings.push(Ring { center: to, forward, radius: 0.0 });
            }
        }
        at_start = trimmed;
    }
    rings
}

/// Where a path turns.
struct Corner {
    at: DVec3,
    /// Unit vectors along the path.
    before: DVec3,
    after: DVec3,
    /// Between both, radians.
    angle: f64,
    /// So far from the corner its arc begins and ends.
    trimmed: f64,
}

impl Corner {
    /// The rings of its arc.
    fn rings(&self, radius: f64, rings: &mut Vec<Ring>) {
        let Self { at, before, after, angle, trimmed } = *self;
        let steps = (angle / TURN).ceil().max(1.0) as u32;
        let axis = before.cross(after).normalize_or(before.any_orthonormal_vector());
        let inward = axis.cross(before);
        // Nearly straight and nearly back have no arc.
        let bend = if angle > 1e-6 && angle < PI - 1e-6 { trimmed / (angle * 0.5).tan() } else { 0.0 };
        let center = at - before * trimmed + inward * bend;
        for step in 0..=steps {
            let turn = DQuat::from_axis_angle(axis, angle * f64::from(step) / f64::from(steps));
            let center = if bend > 0.0 { center - turn * inward * bend } else { at };
            rings.push(Ring { center, forward: turn * before, radius });
        }
    }
}

/// Triangles with normals, band after band; neighbors share no vertices, so that edges between them can be sharp.
#[derive(Default)]
struct Skin {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    indices: Vec<u32>,
}

impl Skin {
    /// The surface between two rings, each with the direction from its center to its first point.
    fn band(&mut self, a: &Ring, a_side: DVec3, b: &Ring, b_side: DVec3) {
        let along = (b.center - a.center).length();
        if along <= 0.0 && a.radius == b.radius && a.forward == b.forward {
            return;
        }
        // Outwards, and forwards as much as the tube gets thinner: flat ends are disks.
        let slope = a.radius - b.radius;
        let first = self.positions.len() as u32;
        for (ring, side) in [(a, a_side), (b, b_side)] {
            for k in 0..SIDES {
                let out = DQuat::from_axis_angle(ring.forward, TAU * k as f64 / SIDES as f64) * side;
                self.positions.push((ring.center + out * ring.radius).as_vec3());
                self.normals.push((out * along + ring.forward * slope).normalize_or(out).as_vec3());
            }
        }
        let sides = SIDES as u32;
        for k in 0..sides {
            let (a0, a1) = (first + k, first + (k + 1) % sides);
            let (b0, b1) = (a0 + sides, a1 + sides);
            if a.radius > 0.0 {
                self.indices.extend([a0, a1, b1]);
            }
            if b.radius > 0.0 {
                self.indices.extend([a0, b1, b0]);
            } else if a.radius > 0.0 {
                continue;
            }
        }
    }

    fn finish(self) -> Mesh {
        let Self { positions, normals, indices } = self;
        Mesh { normals, ..from_triangles(positions, indices) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Bounds, CreaseRule, Topology};

    const END: Heads = Heads { at_start: false, at_end: true, along: false };
    const ALL: Heads = Heads { at_start: true, at_end: true, along: true };
    const NONE: Heads = Heads { at_start: false, at_end: false, along: false };

    fn zigzag() -> Vec<DVec3> {
        vec![DVec3::ZERO, DVec3::X * 3.0, DVec3::new(3.0, 2.0, 0.0), DVec3::new(2.0, 2.0, 4.0)]
    }

    #[test]
    fn arrows_are_closed_and_face_outwards() {
        let back = vec![DVec3::ZERO, DVec3::X * 2.0, DVec3::ZERO, DVec3::Y];
        let short = vec![DVec3::ZERO, DVec3::X * 0.05, DVec3::new(0.05, 0.02, 0.0)];
        for points in [zigzag(), zigzag()[..2].to_vec(), back, short] {
            for heads in [END, ALL, NONE] {
                let mesh = arrow(&points, 0.05, heads);
                assert!(mesh.positions.iter().chain(&mesh.normals).all(|v| v.is_finite()));
                // A tube that bends more sharply than it is thick runs into itself, one that goes back has no inside.
                let is_back = points.len() == 4 && points[0] == points[2];
                let is_folded = is_back || points[1].x < 0.1;
                assert!(
                    is_back || Topology::new(&mesh, 0.5, CreaseRule::Normals).is_solid,
                    "{points:?} {heads:?}"
                );
                for (t, n) in mesh.triangles().iter().map(|t| (mesh.corners(*t), mesh.normals[t[0] as usize]))
                {
                    let face = (t[1] - t[0]).cross(t[2] - t[0]);
                    assert!(is_folded || face.length() < 1e-9 || face.normalize().dot(n) > 0.5, "{t:?} {n}");
                }
            }
        }
    }

    #[test]
    fn tips_are_the_points_and_heads_are_wider_than_the_tube() {
        let (from, to) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(1.0, 2.0, 5.0));
        let radius_at = |mesh: &Mesh, z: f32| {
            let near = mesh.positions.iter().filter(|p| (p.z - z).abs() < 1e-4);
            near.map(|p| p.truncate().distance(glam::vec2(1.0, 2.0))).fold(0.0, f32::max)
        };
        let mesh = arrow(&[from, to], 0.05, END);
        let bounds = Bounds::of_points(&mesh.positions);
        assert!((bounds.min.z - 3.0).abs() < 1e-6 && (bounds.max.z - 5.0).abs() < 1e-6);
        assert!(radius_at(&mesh, 5.0) == 0.0, "the tip is sharp");
        assert!((radius_at(&mesh, 5.0 - 0.35) - 0.13).abs() < 1e-4, "the head begins 7 radii before");
        assert!((radius_at(&mesh, 3.0) - 0.05).abs() < 1e-4, "the other end is blunt");
        let both = arrow(&[from, to], 0.05, ALL);
        assert!(radius_at(&both, 3.0) == 0.0 && (radius_at(&both, 3.35) - 0.13).abs() < 1e-4);
        assert!((radius_at(&both, 4.0 - 0.175) - 0.13).abs() < 1e-4, "one in the middle");
        let blunt = arrow(&[from, to], 0.05, NONE);
        assert!((Bounds::of_points(&blunt.positions).max.x - 1.05).abs() < 1e-5);
    }

    #[test]
    fn the_tube_follows_the_line() {
        let points = zigzag();
        let mesh = arrow(&points, 0.05, END);
        let distance = |p: DVec3| {
            let to_segment = |pair: &[DVec3]| {
                let along = pair[1] - pair[0];
                let t = ((p - pair[0]).dot(along) / along.length_squared()).clamp(0.0, 1.0);
                p.distance(pair[0] + along * t)
            };
            points.windows(2).map(to_segment).fold(f64::MAX, f64::min)
        };
        let farthest = mesh.positions.iter().map(|p| distance(p.as_dvec3())).fold(0.0, f64::max);
        // A rounded corner of 90° cuts off √2 − 1 radii at most.
        assert!(farthest < 0.14, "{farthest}");
        let covered = |p: DVec3| mesh.positions.iter().any(|q| q.as_dvec3().distance(p) < 0.3);
        assert!(points.iter().all(|p| covered(*p)));
    }

    #[test]
    fn nothing_comes_of_less_than_two_points() {
        for points in [vec![], vec![DVec3::ONE], vec![DVec3::ONE; 5]] {
            assert_eq!(arrow(&points, 0.1, ALL), Mesh::default());
        }
    }
}
