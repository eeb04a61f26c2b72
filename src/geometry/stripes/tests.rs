use std::sync::Mutex;

use glam::Vec3;

use super::lift::{gradient, sign_between, wrap};
use super::*;
use crate::geometry::primitives::{cube, from_triangles, plane, torus};
use crate::geometry::{Adjacency, DirectionSource, EdgeKind};

fn solve(mesh: &Mesh, options: &FieldOptions) -> StripeField {
    let field = StripeField::solve(mesh, options, &|_| true).unwrap();
    assert_eq!(field.corner_vertices.len(), mesh.indices.len());
    field
}

fn frequency(field: &StripeField, level: usize) -> f32 {
    field.cycles_per_unit * (level as f32 - BASE_LEVEL as f32).exp2()
}

/// The gradient of a lifted phase on a triangle, in cycles per unit.
fn slope(corners: &[Corner; 3], phases: [f32; 3]) -> Vec3 {
    let (e1, e2) = (corners[1].position - corners[0].position, corners[2].position - corners[0].position);
    let normal = e1.cross(e2);
    let area = normal.length();
    let normal = normal / area;
    (e2.cross(normal) * (phases[1] - phases[0]) + normal.cross(e1) * (phases[2] - phases[0])) / area
}

/// Whether lines of a family end or part inside of a triangle: the side opposite to the first corner does not agree.
fn is_singular(field: &StripeField, corners: &[Corner; 3], family: usize, level: usize) -> bool {
    let lifted = lift(corners, field.cycles_per_unit);
    let [_, p, q] = lifted.phases[family][level];
    let x = |k: usize| gradient(corners[k].direction, corners[k].normal, family) * lifted.signs[k];
    let way = corners[2].position - corners[1].position;
    let foretold = p + 0.5 * frequency(field, level) * (x(1) + x(2)).dot(way);
    (q - foretold).abs() > 0.5
        || lifted.signs[1] * lifted.signs[2] * sign_between(&corners[1], &corners[2]) < 0.0
}

/// A bumpy ring of about 8,000 triangles.
fn bumpy() -> Mesh {
    let mut mesh = torus(2.0, 0.9, 80, 50);
    for (p, n) in mesh.positions.iter_mut().zip(&mesh.normals) {
        *p += *n * 0.12 * ((3.0 * p.x).sin() + (4.0 * p.z).sin() * (3.0 * p.y).cos());
    }
    Mesh { normals: Vec::new(), ..mesh }
}

#[test]
fn on_a_plane_all_levels_are_straight_and_nest() {
    for scale in [1e-3, 1.0, 1e4] {
        let mesh = plane(scale);
        let field = solve(&mesh, &FieldOptions::default());
        assert!((field.cycles_per_unit * scale * 2_f32.sqrt() / CYCLES_PER_EXTENT - 1.0).abs() < 1e-4);
        for triangle in 0..2 {
            let corners = field.corners(&mesh, triangle).unwrap();
            let lifted = lift(&corners, field.cycles_per_unit);
            for family in 0..FAMILIES {
                let expected = gradient(corners[0].direction, corners[0].normal, family) * lifted.signs[0];
                for level in 0..LEVELS {
                    let phases = lifted.phases[family][level];
                    let error = slope(&corners, phases) / frequency(&field, level) - expected;
                    // Phases are rounded to 1/128, of which a coarse level has few on the way.
                    assert!(error.length() < 5e-3, "{family} {level} {error}");
                    if level > 0 {
                        let before = lifted.phases[family][level - 1];
                        assert!((0..3).all(|k| wrap(phases[k] - 2.0 * before[k]).abs() < 1.5 / 128.0 + 1e-3));
                    }
                }
            }
        }
        assert!(field.corners(&mesh, 2).is_none());
    }
}

#[test]
fn families_cross_at_sixty_degrees() {
    let angle =
        |a, b| gradient(Vec3::X, Vec3::Z, a).angle_between(gradient(Vec3::X, Vec3::Z, b)).to_degrees();
    assert!((angle(0, 1) - 60.0).abs() < 1e-3 && (angle(1, 2) - 60.0).abs() < 1e-3);
    assert!((angle(0, 2) - 120.0).abs() < 1e-3);
    // Lines of family 0 run along the direction.
    assert!(gradient(Vec3::X, Vec3::Z, 0).dot(Vec3::Y) > 0.999);
}

#[test]
fn phases_agree_across_every_edge_within_a_chart() {
    let mesh = bumpy();
    let field = solve(&mesh, &FieldOptions::default());
    let adjacency = Adjacency::new(&mesh);
    let (mut compared, mut torn) = (0, 0);
    for edge in adjacency.edges.iter().filter(|e| e.kind == EdgeKind::Manifold) {
        let sides = edge.faces.map(|face| field.corners(&mesh, face as usize).unwrap());
        let lifted = sides.map(|corners| lift(&corners, field.cycles_per_unit));
        for family in 0..FAMILIES {
            for level in 0..LEVELS {
                if sides.iter().any(|corners| is_singular(&field, corners, family, level)) {
                    continue;
                }
                // How the phase changes along the edge, seen from either side.
                let change = [0, 1].map(|side| {
                    let ends = edge.vertices.map(|v| {
                        let at = mesh.positions[v as usize];
                        sides[side].iter().position(|c| c.position.distance(at) < 1e-6).unwrap()
                    });
                    let [from, to] = ends.map(|corner| lifted[side].phases[family][level][corner]);
                    to - from
                });
                compared += 1;
                // Both may count in opposite directions.
                if (change[0] - change[1]).abs().min((change[0] + change[1]).abs()) > 1e-3 {
                    torn += 1;
                }
            }
        }
    }
    assert!(compared > 100_000 && torn == 0, "{torn} of {compared}");
}

#[test]
fn turning_a_corner_around_changes_no_line() {
    let mesh = bumpy();
    let field = solve(&mesh, &FieldOptions::default());
    for triangle in (0..mesh.triangle_count()).step_by(7) {
        let corners = field.corners(&mesh, triangle).unwrap();
        let lifted = lift(&corners, field.cycles_per_unit);
        for turned in 0..3 {
            let mut other = corners;
            other[turned].direction = -other[turned].direction;
            other[turned].phases = other[turned].phases.map(|levels| levels.map(u16::wrapping_neg));
            let again = lift(&other, field.cycles_per_unit);
            assert_eq!(again.signs[turned.max(1)], -lifted.signs[turned.max(1)]);
            let sign = if turned == 0 { -1.0 } else { 1.0 };
            for (a, b) in lifted.phases.as_flattened().iter().zip(again.phases.as_flattened()) {
                assert!((1..3).all(|k| ((a[k] - a[0]) - sign * (b[k] - b[0])).abs() < 2e-3), "{a:?} {b:?}");
            }
        }
    }
}

#[test]
fn lines_follow_the_field_and_few_of_them_end() {
    let mesh = bumpy();
    let field = solve(&mesh, &FieldOptions::default());
    // Largest 90th percentile of the angle in degrees, and most singular triangles, at levels −3, −1 and 1.
    for (level, max_degrees, max_singular) in [(2, 40.0, 40), (4, 28.0, 150), (6, 18.0, 900)] {
        for family in 0..FAMILIES {
            let mut angles = Vec::new();
            let mut singular = 0;
            for triangle in 0..mesh.triangle_count() {
                let corners = field.corners(&mesh, triangle).unwrap();
                if is_singular(&field, &corners, family, level) {
                    singular += 1;
                    continue;
                }
                let lifted = lift(&corners, field.cycles_per_unit);
                let x: Vec3 = (0..3)
                    .map(|k| gradient(corners[k].direction, corners[k].normal, family) * lifted.signs[k])
                    .sum();
                angles.push(slope(&corners, lifted.phases[family][level]).angle_between(x).to_degrees());
            }
            angles.sort_unstable_by(f32::total_cmp);
            let p90 = angles[angles.len() * 9 / 10];
            assert!(p90 < max_degrees, "level {level}, family {family}: {p90} degrees");
            assert!(singular < max_singular, "level {level}, family {family}: {singular} singular triangles");
        }
    }
}

#[test]
fn dense_levels_have_the_lines_of_the_level_before() {
    let mesh = bumpy();
    let field = solve(&mesh, &FieldOptions::default());
    for level in 3..LEVELS {
        let mut errors: Vec<i16> = field
            .vertices
            .iter()
            .map(|v| {
                v.phases()[0][level]
                    .wrapping_sub(v.phases()[0][level - 1].wrapping_mul(2))
                    .cast_signed()
                    .saturating_abs()
            })
            .collect();
        errors.sort_unstable();
        // Independent levels would have a median of a quarter of a cycle.
        let median = f32::from(errors[errors.len() / 2]) / 65536.0;
        assert!(median < 0.08, "level {level}: {median}");
    }
}

#[test]
fn a_coarse_cylinder_is_ringed_evenly() {
    let mut positions = Vec::new();
    let mut indices = Vec::new();
    for k in 0..12 {
        let (sin, cos) = (k as f32 / 12.0 * std::f32::consts::TAU).sin_cos();
        positions.extend([Vec3::new(-2.0, cos, sin), Vec3::new(2.0, cos, sin)]);
        let (a, b) = (2 * k, 2 * ((k + 1) % 12));
        indices.extend([a, a + 1, b + 1, a, b + 1, b]);
    }
    let mesh = from_triangles(positions, indices);
    let field = solve(&mesh, &FieldOptions::default());
    for triangle in 0..mesh.triangle_count() {
        let corners = field.corners(&mesh, triangle).unwrap();
        let lifted = lift(&corners, field.cycles_per_unit);
        for level in 0..LEVELS {
            let slope = slope(&corners, lifted.phases[0][level]) / frequency(&field, level);
            assert!((slope.x.abs() - 1.0).abs() < 1e-2 && slope.length() < 1.01, "{level} {slope}");
        }
    }
}

#[test]
fn lines_around_thin_tubes_are_as_many_as_asked() {
    const FACETS: u32 = 20;
    for radius in [0.02_f32, 0.04, 0.08, 0.16] {
        let at = |facet: u32, y: f32| {
            let (sin, cos) = (std::f32::consts::TAU * facet as f32 / FACETS as f32).sin_cos();
            Vec3::new(radius * cos, y, radius * sin)
        };
        let positions = (0..FACETS).flat_map(|facet| [at(facet, 0.0), at(facet, 4.0)]).collect();
        let facet = |i: u32| {
            let j = (i + 1) % FACETS;
            [2 * i, 2 * i + 1, 2 * j + 1, 2 * i, 2 * j + 1, 2 * j]
        };
        let mesh = from_triangles(positions, (0..FACETS).flat_map(facet).collect());
        let field = solve(&mesh, &FieldOptions { extent: 6.0, ..FieldOptions::default() });
        for (family, level) in (1..FAMILIES).flat_map(|family| (0..LEVELS).map(move |l| (family, l))) {
            // Along the lower end, which the second triangle of each facet has as its last side.
            let (mut found, mut asked) = (0.0, 0.0);
            for triangle in (1..2 * FACETS as usize).step_by(2) {
                let corners = field.corners(&mesh, triangle).unwrap();
                let lifted = lift(&corners, field.cycles_per_unit);
                let [start, _, end] = lifted.phases[family][level];
                let x =
                    |k: usize| gradient(corners[k].direction, corners[k].normal, family) * lifted.signs[k];
                let way = corners[2].position - corners[0].position;
                // In one sense all around.
                let sense = (x(0).y + 1e-6).signum();
                found += sense * (end - start);
                asked += sense * 0.5 * frequency(&field, level) * (x(0) + x(2)).dot(way);
            }
            let most = 0.6 + 0.25 * asked.abs();
            assert!((found - asked).abs() < most, "{radius} {family} {level}: {found} of {asked}");
        }
    }
}

#[test]
fn the_extent_sets_the_distance_of_lines() {
    let mesh = cube(2.0);
    let of = |extent| solve(&mesh, &FieldOptions { extent, ..FieldOptions::default() }).cycles_per_unit;
    assert!((of(7.0) - 10.0).abs() < 1e-4 && (of(70.0) - 1.0).abs() < 1e-5);
}

#[test]
fn hostile_meshes_have_stripes() {
    let corner = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X];
    let loose = |positions: &[Vec3], indices: &[u32]| Mesh {
        positions: positions.to_vec(),
        indices: indices.to_vec(),
        ..Mesh::default()
    };
    for mesh in [
        Mesh::default(),
        loose(&corner, &[]),
        loose(&corner, &[0, 1, 2]),
        loose(&corner, &[0, 1, 2, 1, 0, 3, 0, 1, 4, 0, 1, 2]),
        loose(&corner, &[0, 0, 1, 2, 2, 2]),
        loose(&corner, &[0, 1, 9]),
        loose(&corner, &[0, 1, 2, 3]),
        loose(&[Vec3::NAN, Vec3::X, Vec3::Y], &[0, 1, 2]),
        loose(&[Vec3::ONE; 3], &[0, 1, 2]),
    ] {
        for source in [DirectionSource::Curvature, DirectionSource::TextureV, DirectionSource::Axis(Vec3::Z)]
        {
            let field = solve(&mesh, &FieldOptions { source, ..FieldOptions::default() });
            for triangle in 0..mesh.triangle_count() {
                if let Some(corners) = field.corners(&mesh, triangle) {
                    lift(&corners, field.cycles_per_unit);
                }
            }
        }
    }
    for scale in [1e-30, 1e-12, 1e12, 1e30] {
        let mut mesh = torus(2.0, 0.5, 24, 16);
        mesh.positions.iter_mut().for_each(|p| *p *= scale);
        solve(&mesh, &FieldOptions::default());
    }
}

#[test]
fn thousands_of_loose_triangles_beside_a_surface_cost_little_and_do_it_no_harm() {
    let mut mesh = bumpy();
    mesh.uvs.clear();
    let alone = solve(&mesh, &FieldOptions { extent: 8.0, ..FieldOptions::default() });
    for k in 0..20_000_u16 {
        let at = Vec3::new(f32::from(k % 100) * 0.1, 5.0, f32::from(k / 100) * 0.1);
        let first = mesh.positions.len() as u32;
        mesh.positions.extend([at, at + Vec3::X * 0.05, at + Vec3::Z * 0.05]);
        mesh.indices.extend([first, first + 1, first + 2]);
    }
    let both = solve(&mesh, &FieldOptions { extent: 8.0, ..FieldOptions::default() });
    let singular = |field: &StripeField| {
        let all = (0..8000).filter(|t| is_singular(field, &field.corners(&mesh, *t).unwrap(), 0, 3));
        all.count()
    };
    assert!(singular(&both) <= singular(&alone) + 20, "{} {}", singular(&both), singular(&alone));
}

#[test]
fn stripes_can_be_canceled_and_do_not_depend_on_threads() {
    let mesh = bumpy();
    let calls = Mutex::new(Vec::new());
    let progress = |done| {
        calls.lock().unwrap().push(done);
        true
    };
    let options = FieldOptions::default();
    let field = StripeField::solve(&mesh, &options, &progress).unwrap();
    let calls = calls.into_inner().unwrap();
    assert!(calls.is_sorted() && calls.len() > 8 && calls.iter().all(|done| (0.0..=1.0).contains(done)));
    for limit in [0.0, 0.1, 0.5, 0.8] {
        assert!(StripeField::solve(&mesh, &options, &|done| done < limit).is_none());
    }
    for count in [1, 4] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build().unwrap();
        assert!(pool.install(|| solve(&mesh, &options)) == field);
    }
}
