//! Segments against the exact visible edges.

use glam::{DMat4, DVec2, DVec3, Vec3};

use super::tests::{EYE, LENSES, Subject, everything, look_from};
use super::{LineSegment, LineView, PlacedEdges, line_segments};
use crate::geometry::feature_edges::tests::junction;
use crate::geometry::visible_edges::{EdgeScene, LineRules, PlacedMesh};
use crate::geometry::{EdgeClass, Mesh, primitives};

/// How far a sample may lie from its line, in pixels.
const TOLERANCE: f64 = 0.05;

const CLASSES: [EdgeClass; 4] =
    [EdgeClass::Silhouette, EdgeClass::Border, EdgeClass::Ridge, EdgeClass::Valley];

/// Where lines are seen, for each of [`CLASSES`].
fn truth(subject: &Subject, place: DMat4, view: &LineView) -> [Vec<DVec2>; 4] {
    let placed =
        PlacedMesh { mesh: &subject.mesh, adjacency: &subject.adjacency, world_from_local: place, object: 7 };
    let rules = LineRules { classes: &CLASSES, ..LineRules::default() };
    let visible = EdgeScene::new(&[placed]).visible(&view.projector, &rules);
    CLASSES.map(|class| visible.samples[class as usize].iter().map(|s| s.position).collect())
}

fn distance(segment: &LineSegment, p: DVec2) -> f64 {
    let [a, b] = segment.ends.map(|end| DVec2::from(end.map(f64::from)));
    let along = ((p - a).dot(b - a) / a.distance_squared(b)).clamp(0.0, 1.0);
    p.distance(if along.is_finite() { a.lerp(b, along) } else { a })
}

/// The same without and with what a solid hides: the truth sees the very ends of creases that face away, where they
/// meet the outline.
#[track_caller]
fn check(name: &str, subject: &Subject, place: DMat4, eye: DVec3) -> [usize; 4] {
    if subject.is_solid {
        check_placed(name, subject, &subject.at(place), eye, 0.5);
    }
    check_placed(name, subject, &PlacedEdges { is_solid: false, ..subject.at(place) }, eye, TOLERANCE)
}

/// Every visible sample lies on a segment of its class. Returns the number of samples of each class.
#[track_caller]
fn check_placed(
    name: &str,
    subject: &Subject,
    placed: &PlacedEdges<'_>,
    eye: DVec3,
    tolerance: f64,
) -> [usize; 4] {
    let mut counts = [0; 4];
    for lens in LENSES {
        let view = look_from(eye, lens);
        let mut segments = Vec::new();
        line_segments(placed, &view, &everything(), &mut segments);
        let found = truth(subject, placed.world_from_local, &view);
        for ((class, samples), count) in CLASSES.into_iter().zip(found).zip(&mut counts) {
            let own: Vec<_> =
                segments.iter().filter(|s| placed.is_solid || s.class == class as u32).collect();
            for &sample in &samples {
                let nearest = own.iter().map(|s| distance(s, sample)).fold(f64::INFINITY, f64::min);
                assert!(
                    nearest < tolerance,
                    "{name}, {lens:?}, {eye}, {:?}, {}: {class:?} at {sample} is {nearest} px off",
                    placed.world_from_local.to_cols_array(),
                    placed.is_solid
                );
            }
            *count += samples.len();
        }
    }
    counts
}

/// From several sides, none of them along an axis.
fn eyes() -> impl Iterator<Item = DVec3> {
    (0..6).map(|i| {
        let (sin, cos) = (0.4 + 1.1 * f64::from(i)).sin_cos();
        DVec3::new(4.5 * cos, 1.3 * f64::from(i) - 3.0, 4.5 * sin)
    })
}

fn flipped(mut mesh: Mesh, step: usize) -> Mesh {
    mesh.indices.chunks_exact_mut(3).step_by(step).for_each(|t| t.swap(1, 2));
    mesh
}

/// A cube without one of its walls.
fn open_cube() -> Mesh {
    let mesh = primitives::cube(1.0);
    primitives::from_triangles(mesh.positions.clone(), mesh.indices[..30].to_vec())
}

/// Each wall once more from behind, with the other diagonal.
fn doubled(mesh: Mesh) -> Mesh {
    let mut indices = mesh.indices.clone();
    for quad in mesh.indices.chunks_exact(6) {
        let [a, b, c, d] = [quad[0], quad[1], quad[2], quad[5]];
        indices.extend([d, c, b, d, b, a]);
    }
    primitives::from_triangles(mesh.positions, indices)
}

/// A sheet with a wave in it, open on all sides.
fn sheet() -> Mesh {
    let n = 24;
    let point = |i: u32| -1.0 + 2.0 * i as f32 / n as f32;
    let positions = (0..=n)
        .flat_map(|i| (0..=n).map(move |j| Vec3::new(point(i), 0.3 * (3.0 * point(i)).sin(), point(j))))
        .collect();
    let quad = |i: u32, j: u32| {
        let a = i * (n + 1) + j;
        [a, a + 1, a + n + 2, a, a + n + 2, a + n + 1]
    };
    let indices = (0..n).flat_map(|i| (0..n).flat_map(move |j| quad(i, j))).collect();
    primitives::from_triangles(positions, indices)
}

#[test]
fn every_visible_edge_is_found() {
    let subjects = [
        ("cube", primitives::cube(1.0)),
        ("split cube", primitives::cube_split(1.0)),
        ("sphere", primitives::sphere(1.0, 24, 48)),
        ("coarse sphere", primitives::sphere(1.0, 3, 5)),
        ("torus", primitives::torus(0.8, 0.3, 40, 20)),
        ("coarse torus", primitives::torus(0.8, 0.3, 6, 4)),
        ("sheet", sheet()),
        ("plane", primitives::plane(1.0)),
        ("partly flipped cube", flipped(primitives::cube(1.0), 3)),
        ("partly flipped torus", flipped(primitives::torus(0.8, 0.3, 12, 8), 2)),
        ("T-junction, valley", junction(1.0)),
        ("T-junction, ridge", junction(-0.8)),
        ("T-junction, sharp", junction(2.2)),
        ("doubled walls", doubled(open_cube())),
        ("partly flipped open cube", flipped(open_cube(), 2)),
        ("inside out", flipped(primitives::torus(0.8, 0.3, 12, 8), 1)),
    ];
    let places = [
        DMat4::IDENTITY,
        DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0)),
        DMat4::from_rotation_x(0.4) * DMat4::from_scale(DVec3::new(0.5, -1.2, 0.9)),
    ];
    let mut counts = [0; 4];
    for (name, mesh) in subjects {
        let subject = Subject::new(mesh);
        for (eye, place) in eyes().flat_map(|eye| places.map(|place| (eye, place))) {
            let found = check(name, &subject, place, eye);
            (0..4).for_each(|k| counts[k] += found[k]);
        }
    }
    assert!(counts.iter().all(|&n| n > 10_000), "{counts:?}");
}

#[test]
fn far_from_the_origin_too() {
    let mut mesh = primitives::torus(0.8, 0.3, 40, 20);
    mesh.positions.iter_mut().for_each(|p| *p += Vec3::new(3000.0, -2000.0, 500.0));
    let back = DMat4::from_translation(DVec3::new(-3000.0, 2000.0, -500.0));
    let [silhouette, ..] = check("far torus", &Subject::new(mesh), back, EYE);
    assert!(silhouette > 1000);
}

#[test]
fn fans_look_as_they_do() {
    // Four walls at one edge, and a floor: seen from all sides.
    let mut positions = vec![Vec3::NEG_Y * 0.5, Vec3::Y * 0.5];
    positions.extend([Vec3::X, Vec3::new(0.3, 0.1, 0.9), Vec3::NEG_X, Vec3::new(-0.2, 0.0, -0.8)]);
    let mesh = primitives::from_triangles(positions, vec![0, 1, 2, 1, 0, 3, 0, 1, 4, 0, 1, 5]);
    let subject = Subject::new(mesh);
    for eye in eyes() {
        let [_, border, ..] = check("three leaves", &subject, DMat4::IDENTITY, eye);
        assert!(border > 100);
    }
}
