use super::*;
use crate::geometry::CreaseRule;
use crate::geometry::primitives::{cube, cube_split, plane, sphere, torus};

const DEGREE: f32 = std::f32::consts::PI / 180.0;

/// Checks the promise of [`provoking`] and returns the number of duplicated vertices.
fn check(mesh: &Mesh, surfaces: &Surfaces) -> usize {
    let out = provoking(mesh, surfaces);
    assert_eq!(out.surface_of_vertex.len(), mesh.positions.len() + out.duplicates.len());
    let mut extended = mesh.clone();
    extended.append_copies(&out.duplicates);
    extended.indices.clone_from(&out.indices);
    for (t, &surface) in surfaces.of_triangle.iter().enumerate() {
        let triangle = extended.triangles()[t];
        assert_eq!(out.surface_of_vertex[triangle[0] as usize], surface);
        let before = mesh.corners(mesh.triangles()[t]);
        let after = extended.corners(triangle);
        assert!((0..3).any(|k| {
            let mut rotated = before;
            rotated.rotate_left(k);
            rotated == after
        }));
    }
    out.duplicates.len()
}

#[test]
fn a_cube_has_six_surfaces_until_the_crease_angle_exceeds_its_own() {
    for mesh in [cube(1.0), cube_split(1.0)] {
        let adjacency = Adjacency::new(&mesh);
        let surfaces = adjacency.surfaces(30.0 * DEGREE);
        assert_eq!(surfaces.count, 6);
        assert_eq!(surfaces.of_triangle, [0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5]);
        assert_eq!(adjacency.surfaces(91.0 * DEGREE).count, 1);
    }
}

#[test]
fn smooth_shapes_are_one_surface_and_two_shapes_are_two() {
    let mesh = torus(2.0, 0.5, 48, 24);
    assert_eq!(Adjacency::new(&mesh).surfaces(30.0 * DEGREE).count, 1);
    let mut both = sphere(1.0, 24, 48);
    let other = sphere(0.5, 24, 48);
    let base = both.positions.len() as u32;
    both.positions.extend(&other.positions);
    both.indices.extend(other.indices.iter().map(|v| v + base));
    assert_eq!(Adjacency::new(&both).surfaces(30.0 * DEGREE).count, 2);
}

#[test]
fn a_flipped_triangle_stays_in_its_surface() {
    let mut mesh = plane(1.0);
    mesh.indices.swap(0, 1);
    assert_eq!(Adjacency::new(&mesh).surfaces(1.0 * DEGREE).count, 1);
}

#[test]
fn first_vertices_carry_the_surface_with_few_duplicates() {
    let shared = cube(1.0);
    let surfaces = Adjacency::new(&shared).surfaces(30.0 * DEGREE);
    assert!(check(&shared, &surfaces) <= 2);

    let split = cube_split(1.0);
    let surfaces = Adjacency::new(&split).surfaces(30.0 * DEGREE);
    assert_eq!(check(&split, &surfaces), 0);

    let round = sphere(1.0, 24, 48);
    let surfaces = Adjacency::new(&round).surfaces(30.0 * DEGREE);
    assert_eq!(check(&round, &surfaces), 0);

    // Every triangle its own surface: far more surfaces than vertices.
    let surfaces = Adjacency::new(&round).with_rule(CreaseRule::Angle).surfaces(-1.0);
    assert_eq!(surfaces.count, round.triangle_count());
    check(&round, &surfaces);
}
