//! Dashes keep their length along lines and their place when the camera moves.

use std::f64::consts::TAU;

use glam::{DMat4, DVec2, DVec3, Vec3};

use super::tests::{EYE, LENSES, Subject, everything, look_from};
use super::{Dashes, LineSegment, LineSelection, LineView};
use crate::geometry::{ClassSet, EdgeClass, Lens, Mesh, Projector, primitives};

const PERIOD: f64 = 14.0;

fn dashed() -> LineSelection {
    LineSelection { dashes: Some(Dashes { classes: ClassSet::ALL, period: PERIOD as f32 }), ..everything() }
}

fn ends(segment: &LineSegment) -> [DVec2; 2] {
    segment.ends.map(|end| DVec2::from(end.map(f64::from)))
}

/// The length at the point of a segment that is nearest to a point, in periods, and how far away that is.
fn nearest<'a>(segments: impl Iterator<Item = &'a LineSegment>, p: DVec2) -> (f64, f64) {
    let at = |segment: &LineSegment| {
        let [a, b] = ends(segment);
        let along = ((p - a).dot(b - a) / a.distance_squared(b)).clamp(0.0, 1.0);
        let along = if along.is_finite() { along } else { 0.0 };
        let [from, to] = segment.arcs.map(f64::from);
        ((from + (to - from) * along) / PERIOD, p.distance(a.lerp(b, along)))
    };
    segments.map(at).min_by(|a, b| a.1.total_cmp(&b.1)).unwrap()
}

/// The difference of two phases, −0.5 to 0.5 periods.
fn difference(a: f64, b: f64) -> f64 {
    (a - b) - (a - b).round()
}

/// A tube around the Y axis, open at both ends and bent: its rims are not flat.
fn tube() -> Mesh {
    let (sides, rings) = (48, 8);
    let mut positions = Vec::new();
    for ring in 0..=rings {
        for side in 0..sides {
            let (sin, cos) = (side as f32 * std::f32::consts::TAU / sides as f32).sin_cos();
            let y = -0.7 + 1.4 * ring as f32 / rings as f32;
            positions.push(Vec3::new(0.6 * cos, y + 0.3 * cos, 0.6 * sin));
        }
    }
    let indices = (0..rings)
        .flat_map(|ring| (0..sides).map(move |side| (ring * sides, side, (side + 1) % sides)))
        .flat_map(|(base, a, b)| {
            let (a, b, c, d) = (base + a, base + b, base + sides + a, base + sides + b);
            [a, c, d, a, d, b]
        })
        .collect();
    primitives::from_triangles(positions, indices)
}

#[test]
fn no_dashes_no_arcs() {
    let cube = Subject::new(primitives::cube(1.0));
    let view = look_from(EYE, LENSES[0]);
    let plain = cube.segments(DMat4::IDENTITY, &view, &everything());
    assert!(plain.iter().all(|s| s.arcs == [0.0; 2]));
    let classes = ClassSet::of(&[EdgeClass::Ridge]);
    let some = LineSelection { dashes: Some(Dashes { classes, period: 10.0 }), ..everything() };
    for segment in cube.segments(DMat4::IDENTITY, &view, &some) {
        assert_eq!(segment.arcs != [0.0; 2], segment.edge_class() == Some(EdgeClass::Ridge));
    }
    for period in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        let broken =
            LineSelection { dashes: Some(Dashes { classes: ClassSet::ALL, period }), ..everything() };
        assert_eq!(cube.segments(DMat4::IDENTITY, &view, &broken), plain);
    }
}

#[test]
fn along_straight_edges_arcs_are_pixels() {
    for lens in LENSES {
        for subject in [primitives::cube(1.0), primitives::plane(1.0)].map(Subject::new) {
            let segments = subject.segments(DMat4::IDENTITY, &look_from(EYE, lens), &dashed());
            assert!(segments.len() >= 4);
            for segment in segments {
                let [a, b] = ends(&segment);
                let [from, to] = segment.arcs;
                assert!((f64::from((from - to).abs()) - a.distance(b)).abs() < 1e-3, "{segment:?}");
                // Held in the middle, which perspective moves a little in the picture.
                let middle = 0.5 * f64::from(from + to) / PERIOD;
                let off = difference(middle, 0.0).abs() * PERIOD;
                assert!(from.min(to) >= 0.0 && off < 0.04 * a.distance(b), "{segment:?}");
            }
        }
    }
}

#[test]
fn around_a_rim_arcs_go_on_and_meet() {
    let tube = Subject::new(tube());
    for lens in LENSES {
        let segments = tube.segments(DMat4::IDENTITY, &look_from(EYE, lens), &dashed());
        let borders: Vec<_> = segments.iter().filter(|s| s.class == EdgeClass::Border as u32).collect();
        assert_eq!(borders.len(), 96);
        let mut joints = 0;
        for (i, one) in borders.iter().enumerate() {
            let [a, b] = ends(one);
            let along = f64::from((one.arcs[0] - one.arcs[1]).abs());
            assert!((along / a.distance(b) - 1.0).abs() < 0.1, "{along} of {}", a.distance(b));
            for other in &borders[i + 1..] {
                for (p, q) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    if ends(one)[p].distance(ends(other)[q]) < 1e-3 {
                        let apart = f64::from(one.arcs[p] - other.arcs[q]) / PERIOD;
                        assert!(difference(apart, 0.0).abs() < 1e-3, "{apart}");
                        joints += 1;
                    }
                }
            }
        }
        assert_eq!(joints, 96);
    }
}

#[test]
fn arcs_go_on_beyond_the_sides_and_the_near_plane() {
    // A long ridge, cut into pieces, that passes the eye.
    let n = 40;
    let corners = (0..=n).flat_map(|i| {
        let z = 3.0 - 12.0 * i as f32 / n as f32;
        [Vec3::new(-1.0, -2.0, z), Vec3::new(0.3, -1.0, z), Vec3::new(1.6, -2.0, z)]
    });
    let quads = (0..n).flat_map(|i| [3 * i, 3 * i + 1]).flat_map(|a| [a, a + 1, a + 4, a, a + 4, a + 3]);
    let roof = Subject::new(primitives::from_triangles(corners.collect(), quads.collect()));
    let lens = Lens::Perspective { tan_half_angle: 0.5 };
    let projector =
        Projector { view_from_world: DMat4::IDENTITY, lens, size: [400, 300], near: 0.1, far: 100.0 };
    let found = |margin: f64| {
        let view = LineView { projector, jitter: DVec2::ZERO, margin, clip_planes: [glam::DVec4::ZERO; 2] };
        let segments = roof.segments(DMat4::IDENTITY, &view, &dashed());
        segments.into_iter().filter(|s| s.class == EdgeClass::Ridge as u32).collect::<Vec<_>>()
    };
    let (near, far) = (found(0.0), found(5000.0));
    assert!(near.len() > 10 && far.len() > near.len());
    for segment in &near {
        for (end, arc) in ends(segment).into_iter().zip(segment.arcs) {
            let (there, off) = nearest(far.iter(), end);
            assert!(off < 1e-3 && (there - f64::from(arc) / PERIOD).abs() < 1e-3, "{there} {segment:?}");
        }
    }
}

/// Positions around the outline of a unit sphere at the origin, in pixels, for an eye at `distance`.
fn circle(lens: Lens, distance: f64) -> (f64, impl Iterator<Item = DVec2>) {
    let radius = match lens {
        Lens::Perspective { tan_half_angle } => 400.0 / tan_half_angle / (distance * distance - 1.0).sqrt(),
        Lens::Orthographic { half_height } => 400.0 / half_height,
    };
    (
        radius,
        (0..720).map(move |i| DVec2::splat(400.0) + DVec2::from_angle(TAU * f64::from(i) / 720.0) * radius),
    )
}

#[test]
fn periods_are_as_long_around_a_sphere_as_along_a_line() {
    for (rings, segments) in [(24, 48), (64, 128), (300, 500)] {
        let sphere = Subject::new(primitives::sphere(1.0, rings, segments));
        for lens in LENSES {
            let found = sphere.segments(DMat4::IDENTITY, &look_from(EYE, lens), &dashed());
            let (radius, positions) = circle(lens, EYE.length());
            let phases: Vec<f64> = positions.map(|p| nearest(found.iter(), p).0).collect();
            let expected = TAU * radius / PERIOD;
            // Over every twelfth of the circle, and all around.
            let steps: Vec<f64> = (0..720).map(|i| difference(phases[(i + 1) % 720], phases[i])).collect();
            let around = steps.iter().sum::<f64>().abs();
            assert!((around / expected - 1.0).abs() < 0.1, "{rings}: {around} of {expected}");
            assert!((around - around.round()).abs() < 1e-2, "{around}");
            for twelfth in steps.chunks(60) {
                let part = twelfth.iter().sum::<f64>().abs() * 12.0 / expected;
                assert!((part - 1.0).abs() < 0.1, "{rings}, {lens:?}: {part}");
            }
        }
    }
}

/// The share of points whose dashes move by less than a tenth of a period when the eye orbits by half a degree, over
/// some steps. `points` are looked at in the picture.
fn steadiness(
    subject: &Subject,
    place: DMat4,
    lens: Lens,
    points: impl Fn(&LineView) -> Vec<DVec2>,
    wanted: impl Fn(&LineSegment) -> bool,
) -> f64 {
    let phases = |step: u32| {
        let (sin, cos) = (0.4 + 0.5_f64.to_radians() * f64::from(step)).sin_cos();
        let view = look_from(DVec3::new(4.5 * cos, 2.4, 4.5 * sin), lens);
        let found = subject.segments(place, &view, &dashed());
        let phase = |p: DVec2| {
            let (phase, off) = nearest(found.iter().filter(|s| wanted(s)), p);
            (off < 6.0).then_some(phase)
        };
        points(&view).into_iter().map(phase).collect::<Vec<_>>()
    };
    let (mut steady, mut all) = (0, 0);
    let mut last = phases(0);
    for step in 1..60 {
        let now = phases(step);
        for (a, b) in last.iter().zip(&now) {
            if let (Some(a), Some(b)) = (a, b) {
                all += 1;
                steady += usize::from(difference(*a, *b).abs() < 0.1);
            }
        }
        last = now;
    }
    assert!(all > 1000, "{all}");
    f64::from(steady as u32) / f64::from(all as u32)
}

/// The point farthest from the middle of the picture in a direction (radians).
fn outermost(segments: &[LineSegment], angle: f64) -> Option<DVec2> {
    let direction = DVec2::from_angle(angle);
    let crossing = |segment: &LineSegment| {
        let [a, b] = ends(segment).map(|p| p - DVec2::splat(400.0));
        let (left, right) = (direction.perp_dot(a), direction.perp_dot(b));
        let there = a.lerp(b, left / (left - right)).dot(direction);
        ((left < 0.0) != (right < 0.0) && there > 0.0).then_some(there)
    };
    let farthest = segments.iter().filter_map(crossing).max_by(f64::total_cmp)?;
    Some(DVec2::splat(400.0) + direction * farthest)
}

#[test]
fn dashes_stay_when_the_eye_orbits() {
    let is = |class: EdgeClass| move |s: &LineSegment| s.class == class as u32;
    let sphere = Subject::new(primitives::sphere(1.0, 48, 96));
    let torus = Subject::new(primitives::torus(0.9, 0.35, 96, 48));
    // So that its outline changes its shape.
    let tilted = DMat4::from_rotation_x(0.6);
    let (cube, tube) = (Subject::new(primitives::cube(1.0)), Subject::new(tube()));
    // Points of the mesh itself, on its creases and borders.
    let on = |subject: &Subject, view: &LineView| {
        let edges = &subject.edges;
        let pixel = |p: DVec3| view.projector.pixel(view.projector.view_from_world.transform_point3(p));
        let sharp = (0..edges.len())
            .filter(|&e| edges.dihedral[e].abs() > 0.6 || edges.faces[e][0] == edges.faces[e][1]);
        sharp
            .flat_map(|e| {
                let [a, b] = edges.ends[e].map(|v| subject.mesh.positions[v as usize].as_dvec3());
                [0.1, 0.3, 0.5, 0.7, 0.9].map(|t| pixel(a.lerp(b, t)))
            })
            .collect::<Vec<_>>()
    };
    for lens in LENSES {
        let around = |view: &LineView| {
            let distance = view.projector.view_from_world.w_axis.truncate().length();
            circle(lens, distance).1.collect::<Vec<_>>()
        };
        let shares = [
            steadiness(&sphere, DMat4::IDENTITY, lens, around, is(EdgeClass::Silhouette)),
            steadiness(&cube, DMat4::IDENTITY, lens, |view| on(&cube, view), |_| true),
            steadiness(&tube, DMat4::IDENTITY, lens, |view| on(&tube, view), is(EdgeClass::Border)),
            steadiness(
                &torus,
                tilted,
                lens,
                // The outermost points in fixed directions.
                |view| {
                    let found = torus.segments(tilted, view, &everything());
                    (0..360).filter_map(|i| outermost(&found, TAU * f64::from(i) / 360.0)).collect()
                },
                is(EdgeClass::Silhouette),
            ),
        ];
        assert!(shares.iter().all(|share| *share > 0.85), "{lens:?}: {shares:?}");
    }
}
