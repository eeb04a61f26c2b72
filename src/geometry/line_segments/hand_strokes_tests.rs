use std::collections::HashMap;

use glam::{DMat4, DQuat, DVec2, DVec3, Vec3, Vec3Swizzles as _};

use super::tests::{EYE, LENSES, Subject, everything, look_from};
use super::*;
use crate::geometry::feature_edges::crease_angles::CreaseAngles;
use crate::geometry::feature_edges::straights::Straights;
use crate::geometry::hand::Hand;
use crate::geometry::{Lens, Mesh, primitives};

const ANGLE: f32 = 0.5;
const HAND: Hand =
    Hand { times: 2, overshoot: 14.0, shift: 1.6, bow: 0.006, tremor: 0.55, scale: 1.0, seed: 3 };
const STEADY: Hand = Hand { times: 1, overshoot: 0.0, shift: 0.0, bow: 0.0, tremor: 0.0, ..HAND };

fn straights(mesh: Mesh) -> Straights {
    let subject = Subject::new(mesh);
    let angles = CreaseAngles { ridge: ANGLE, valley: ANGLE };
    Straights::clone(&subject.edges.straights(&subject.mesh, angles))
}

fn drawn(
    subject: &Subject,
    place: DMat4,
    view: &LineView,
    wanted: &LineSelection,
    hand: &Hand,
) -> SegmentSet {
    let mut out = SegmentSet::default();
    draw_strokes(&subject.at(place), view, wanted, hand, ANGLE, &mut out);
    out.complete();
    assert_eq!(out.segments.len(), out.tested.len());
    out
}

fn px(end: [f32; 2]) -> DVec2 {
    DVec2::from(end.map(f64::from))
}

/// Pieces of strokes and where they are tested.
fn pieces(strokes: &SegmentSet) -> impl Iterator<Item = (&LineSegment, &Tested)> {
    strokes.segments.iter().zip(&strokes.tested).filter(|(_, tested)| tested.is_stroke == 1)
}

/// A box of triangles with so many cells along each side, turned so that coordinates are rounded.
fn fine_box(cells: u32) -> Mesh {
    let mut mesh = Mesh::default();
    let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.3, 0.5, 0.7);
    let faces = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
    for normal in faces {
        let right = normal.yzx();
        let up = normal.cross(right);
        let first = mesh.positions.len() as u32;
        let part = |i: u32| 2.0 * f64::from(i) / f64::from(cells) - 1.0;
        for j in 0..=cells {
            for i in 0..=cells {
                mesh.positions.push((turn * (normal + part(i) * right + part(j) * up)).as_vec3());
            }
        }
        let at = |i: u32, j: u32| first + j * (cells + 1) + i;
        for j in 0..cells {
            for i in 0..cells {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                mesh.indices.extend([a, b, c, a, c, d]);
            }
        }
    }
    primitives::from_triangles(mesh.positions, mesh.indices)
}

#[test]
fn a_box_has_twelve_lines_however_fine_it_is() {
    for mesh in [primitives::cube(1.0), primitives::cube_split(1.0), fine_box(1), fine_box(7)] {
        let lines = straights(mesh).lines;
        assert_eq!(lines.len(), 12);
        assert!(lines.iter().all(|line| line.is_end == [true; 2]));
        let longest = lines.iter().map(|line| line.ends[0].distance(line.ends[1])).fold(0.0, f32::max);
        assert!(lines.iter().all(|line| line.ends[0].distance(line.ends[1]) > 0.999 * longest));
        let mut hashes: Vec<u32> = lines.iter().map(|line| line.hash).collect();
        hashes.sort_unstable();
        hashes.dedup();
        assert_eq!(hashes.len(), 12);
    }
}

#[test]
fn curves_are_no_lines_but_polygons_are() {
    // The rims of cylinders with so many sides; where they bend enough, their sides are lines too.
    let count = |sides: usize| {
        let ring = |z: f32| {
            (0..sides).map(move |i| {
                let (y, x) = (i as f32 / sides as f32 * std::f32::consts::TAU).sin_cos();
                Vec3::new(x, y, z)
            })
        };
        let positions: Vec<Vec3> = ring(0.0).chain(ring(1.0)).chain([Vec3::ZERO, Vec3::Z]).collect();
        let n = sides as u32;
        let indices = (0..n)
            .map(|i| (i, (i + 1) % n))
            .flat_map(|(a, b)| [a, b, n + b, a, n + b, n + a, 2 * n, b, a, 2 * n + 1, n + a, n + b])
            .collect();
        straights(primitives::from_triangles(positions, indices)).lines.len()
    };
    assert_eq!([count(4), count(6), count(8)], [12, 18, 24]);
    assert_eq!([count(64), count(200), count(500)], [0; 3]);
}

#[test]
fn a_line_that_becomes_an_arc_does_not_end_there() {
    // A plate whose border is a straight line and an arc.
    let corner = |i: u32| {
        let (y, x) = (f64::from(i) / 24.0 * std::f64::consts::FRAC_PI_2).sin_cos();
        DVec3::new(x, y, 0.0).as_vec3()
    };
    let positions: Vec<Vec3> = [Vec3::new(0.0, -4.0, 0.0), Vec3::new(1.0, -4.0, 0.0)]
        .into_iter()
        .chain((0..=24).map(corner))
        .collect();
    let indices = (1..positions.len() as u32 - 1).flat_map(|i| [0, i, i + 1]).collect();
    let lines = straights(primitives::from_triangles(positions, indices)).lines;
    assert_eq!(lines.len(), 3);
    // The side that the arc is tangent to.
    let side = lines.iter().find(|line| line.ends.iter().all(|p| p.x > 0.999)).unwrap();
    for end in 0..2 {
        assert_eq!(side.is_end[end], side.ends[end].y < -3.0);
    }
}

#[test]
fn the_order_of_triangles_and_vertices_changes_no_hash() {
    let mesh = fine_box(5);
    let (count, corners) = (mesh.positions.len() as u32, mesh.indices.len());
    let turned = |v: u32| (v * 7 + 3) % count;
    assert!(count % 7 != 0);
    let mut positions = mesh.positions.clone();
    for v in 0..count {
        positions[turned(v) as usize] = mesh.positions[v as usize];
    }
    let indices: Vec<u32> = mesh.indices.iter().map(|&v| turned(v)).collect();
    let indices = [&indices[corners / 2..], &indices[..corners / 2]].concat();
    let ends = |mesh: Mesh| -> HashMap<u32, [[u32; 3]; 2]> {
        let lines = straights(mesh).lines;
        lines.iter().map(|line| (line.hash, line.ends.map(|p| p.to_array().map(f32::to_bits)))).collect()
    };
    assert_eq!(ends(mesh), ends(primitives::from_triangles(positions, indices)));
}

#[test]
fn a_steady_hand_draws_lines_where_they_are() {
    for lens in LENSES {
        for mesh in [primitives::cube(1.0), fine_box(3)] {
            let (subject, view) = (Subject::new(mesh), look_from(EYE, lens));
            let plain = subject.segments(DMat4::IDENTITY, &view, &everything());
            let strokes = drawn(&subject, DMat4::IDENTITY, &view, &everything(), &STEADY);
            let elsewhere: Vec<_> =
                strokes.segments.iter().filter(|s| s.class & LineSegment::ELSEWHERE != 0).collect();
            assert_eq!(elsewhere.len(), plain.len());
            assert!(elsewhere.iter().zip(&plain).all(|(a, b)| a.ends == b.ends && a.is_suppressed()));
            let mut length = 0.0;
            for (segment, tested) in pieces(&strokes) {
                assert!((0..2).all(|end| px(segment.ends[end]).distance(px(tested.ends[end])) < 1e-3));
                length += px(segment.ends[0]).distance(px(segment.ends[1]));
            }
            let expected: f64 = plain.iter().map(|s| px(s.ends[0]).distance(px(s.ends[1]))).sum();
            assert!((length - expected).abs() < 0.01 * expected.max(1.0), "{length}, {expected}");
        }
    }
}

#[test]
fn strokes_are_tested_on_their_edges_and_drawn_within_reach() {
    for lens in LENSES {
        let (subject, view) = (Subject::new(fine_box(3)), look_from(EYE, lens));
        let plain = subject.segments(DMat4::IDENTITY, &view, &everything());
        let strokes = drawn(&subject, DMat4::IDENTITY, &view, &everything(), &HAND);
        let mut farthest = 0.0_f64;
        for (segment, tested) in pieces(&strokes) {
            for end in 0..2 {
                let at = px(tested.ends[end]);
                let depth = f64::from(segment.depths[end]);
                let is_on = plain.iter().any(|edge| {
                    let [a, b] = edge.ends.map(px);
                    let t = (at - a).dot(b - a) / a.distance_squared(b);
                    let [from, to] = edge.depths.map(f64::from);
                    let there = match lens {
                        Lens::Perspective { .. } => 1.0 / (1.0 / from + (1.0 / to - 1.0 / from) * t),
                        Lens::Orthographic { .. } => from + (to - from) * t,
                    };
                    (-1e-3..=1.001).contains(&t)
                        && a.lerp(b, t).distance(at) < 0.01
                        && (there - depth).abs() < 1e-3 * there
                });
                assert!(is_on, "{segment:?} {tested:?}");
                farthest = farthest.max(px(segment.ends[end]).distance(at));
                assert!((0.0..=1.0).contains(&tested.weights[end]));
            }
        }
        assert!(farthest > 5.0 && farthest < HAND.reach() + INSIDE_MOST, "{farthest}");
    }
}

/// As `INSIDE` of strokes, and a little.
const INSIDE_MOST: f64 = 2.1;

#[test]
fn overshoots_lie_beyond_corners() {
    let (subject, view) = (Subject::new(primitives::cube(1.0)), look_from(EYE, LENSES[0]));
    let wanted = LineSelection { classes: ClassSet::of(&[EdgeClass::Silhouette]), ..everything() };
    let plain = subject.segments(DMat4::IDENTITY, &view, &wanted);
    let low = |of: &mut dyn Iterator<Item = [f32; 2]>| of.map(|[_, y]| y).fold(f32::INFINITY, f32::min);
    let top = low(&mut plain.iter().flat_map(|s| s.ends));
    let strokes = drawn(&subject, DMat4::IDENTITY, &view, &wanted, &HAND);
    // Six outlines, each twice, at both ends.
    let tips = pieces(&strokes).filter(|(_, t)| px(t.ends[0]).distance(px(t.ends[1])) < 1.5).count();
    assert_eq!(tips, 24);
    assert!(low(&mut pieces(&strokes).flat_map(|(s, _)| s.ends)) < top - 2.0);
}

#[test]
fn strokes_move_little_when_the_eye_does() {
    for lens in LENSES {
        let subject = Subject::new(fine_box(1));
        for size in [0.03, 0.3, 1.0] {
            let place = DMat4::from_scale(DVec3::splat(size));
            let [one, two] = [EYE, EYE + DVec3::new(1e-4, 2e-4, -1e-4)]
                .map(|eye| drawn(&subject, place, &look_from(eye, lens), &everything(), &HAND));
            // What is drawn along each edge, by where it is tested.
            let mut compared = 0;
            for (segment, tested) in pieces(&one) {
                let off = px(segment.ends[0]) - px(tested.ends[0]);
                let similar = pieces(&two).filter(|(_, t)| {
                    (0..2).all(|end| px(t.ends[end]).distance(px(tested.ends[end])) < 1.0)
                        && t.precedence == tested.precedence
                });
                let nearest = similar
                    .map(|(s, t)| (px(s.ends[0]) - px(t.ends[0]) - off).length())
                    .fold(f64::INFINITY, f64::min);
                compared += usize::from(nearest < 0.2);
            }
            let count = pieces(&one).count();
            assert!(compared as f64 >= 0.99 * count as f64, "{compared} of {count}, {size}");
        }
    }
}

#[test]
fn what_is_too_short_or_hidden_is_drawn_as_it_is() {
    let (subject, view) = (Subject::new(primitives::cube(1.0)), look_from(EYE, LENSES[0]));
    let small = DMat4::from_scale(DVec3::splat(0.01));
    let strokes = drawn(&subject, small, &view, &everything(), &HAND);
    assert_eq!(strokes.segments, subject.segments(small, &view, &everything()));
    assert!(pieces(&strokes).next().is_none());
    let wanted = LineSelection {
        classes: ClassSet::of(&[EdgeClass::Silhouette]),
        suppress_angle: 0.5,
        ..everything()
    };
    let strokes = drawn(&subject, DMat4::IDENTITY, &view, &wanted, &HAND);
    assert!(
        pieces(&strokes).all(|(s, _)| s.edge_class() == Some(EdgeClass::Silhouette) && !s.is_suppressed())
    );
    assert!(strokes.segments.iter().any(|s| s.edge_class() == Some(EdgeClass::Ridge) && s.is_suppressed()));
}
